//! Every parameter: rails, switches, search, and the way back.

use super::stage::{Stage, asked, busy, drag, drag_rail, english, press, stage};
use egui::{Role, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable};
use penstemon::app::action::Action;
use penstemon::app::messages::Language;
use penstemon::app::panels::Snapshot;
use penstemon::app::panels::snapshot::ParamValues;
use penstemon::growth::habit::{ClimbHabit, CrownHabit};
use penstemon::growth::{Habit, Schedule};
use serde_json::{Map, Value};

/// Somebody in the middle of work on a plant that grows.
fn growing() -> Snapshot {
    let (crown, climb) = (Some(CrownHabit::default()), Some(ClimbHabit::default()));
    let habit = Habit { crown, climb, ..Habit::default() };
    let params = ParamValues::default().growing(&habit, 12.0);
    Snapshot { params, ..busy() }
}

/// Shows the page of parameters and searches it.
fn searched(text: &str) -> Harness<'static, Stage> {
    searched_in(busy(), text)
}

fn searched_in(snapshot: Snapshot, text: &str) -> Harness<'static, Stage> {
    let mut harness = stage(snapshot, Language::English);
    press(&mut harness, "Shape");
    harness.get_by_role(Role::TextInput).click();
    harness.run();
    harness.get_by_role(Role::TextInput).type_text(text);
    harness.run();
    harness
}

#[test]
fn a_rail_dragged_sideways_sets_its_parameter() {
    let mut harness = searched("opening_prior");
    drag(&mut harness, "Default opening", vec2(60.0, 3.0));
    let actions = asked(&mut harness);
    let Some(Action::SetParam { path, value: Some(value) }) = actions.last() else { panic!("{actions:?}") };
    assert_eq!(path, "depth.cone.opening_prior");
    let value = value.as_f64().unwrap();
    // 10 to 85 degrees over about 150 pixels, from the middle 60 to the right
    assert!((70.0..85.0).contains(&value), "{value}");
    assert!(actions.len() > 3, "the plant follows while the rail is dragged: {actions:?}");
}

#[test]
fn a_rail_dragged_up_or_down_scrolls_and_sets_nothing() {
    let mut harness = searched("opening_prior");
    drag(&mut harness, "Default opening", vec2(4.0, 80.0));
    assert_eq!(asked(&mut harness), []);
}

#[test]
fn whole_numbers_and_switches_keep_their_kind() {
    let mut harness = searched("min petals");
    drag(&mut harness, "Min petals", vec2(40.0, 0.0));
    let actions = asked(&mut harness);
    assert!(
        matches!(actions.last(), Some(Action::SetParam { value: Some(v), .. }) if v.is_u64()),
        "{actions:?}"
    );
    let mut harness = searched("cone.flip");
    press(&mut harness, "Flowers turned away");
    let value = Some(Value::Bool(true));
    assert_eq!(asked(&mut harness), [Action::SetParam { path: "depth.cone.flip".into(), value }]);
}

#[test]
fn every_value_that_a_rail_gives_is_accepted_by_the_pipeline() {
    use penstemon::params::{Description, Kind, Overrides, Parameters};
    use penstemon::pipeline::Params;
    let every = Params::of_any_species();
    let described = every.describe();
    // One search for each group, by paths; names repeat within the sections of a habit and of flowers.
    let mut searches: Vec<(String, Vec<&Description>)> = Vec::new();
    for description in &described {
        let (group, _) = description.path.rsplit_once('.').unwrap();
        let repeats = group == "habit" || group.starts_with("flower");
        let text = if repeats { description.path.clone() } else { format!("{group}.") };
        match searches.last_mut().filter(|(last, _)| *last == text) {
            Some((_, found)) => found.push(description),
            None => searches.push((text, vec![description])),
        }
    }
    let mut moved = 0;
    for (text, found) in searches {
        let all = growing();
        let mut params = all.params.clone().with_garden(true);
        // A wall, so that its sizes mean something.
        params.own.insert("obstacle.kind".to_owned(), 1.0);
        let mut harness = searched_in(Snapshot { params, ..all }, &text);
        for description in found {
            let label = english().param_name(&description.path);
            if harness.query_by_role_and_label(Role::Slider, &label).is_none() {
                continue;
            }
            harness.get_by_role_and_label(Role::Slider, &label).scroll_to_me();
            harness.run();
            drag_rail(&mut harness, &label, vec2(-37.0, 0.0));
            let mut actions = asked(&mut harness);
            if actions.is_empty() {
                // it stood there already
                drag_rail(&mut harness, &label, vec2(90.0, 0.0));
                actions = asked(&mut harness);
            }
            assert!(!actions.is_empty(), "{} does not move", description.path);
            moved += 1;
            for action in actions {
                let Action::SetParam { path, value: Some(value) } = action else { panic!("{action:?}") };
                assert_eq!(path, description.path);
                let tree = Map::from_iter([(path.clone(), value.clone())]);
                let mut overrides = Overrides::over(&every);
                overrides.merge(&tree).unwrap_or_else(|e| panic!("{path} = {value}: {e}"));
                overrides.finish::<Params>().unwrap_or_else(|e| panic!("{path} = {value}: {e}"));
            }
        }
    }
    let has_rail = |of: &&Description| !matches!(of.kind, Kind::Switch | Kind::Choice(_));
    let rails = described.iter().filter(has_rail).count();
    assert_eq!(moved, rails, "not every rail was moved");
}

#[test]
fn one_of_a_few_is_chosen_from_a_list_and_given_back() {
    let mut harness = searched_in(growing(), "habit.resource");
    press(&mut harness, "Buds compete for: Light");
    press(&mut harness, "Space");
    let (path, value) = ("habit.resource".to_owned(), Some(Value::from("space")));
    assert_eq!(asked(&mut harness), [Action::SetParam { path: path.clone(), value }]);

    let own = serde_json::json!({"habit": {"resource": "space"}});
    let params = ParamValues::of(&Map::new(), own.as_object().unwrap()).growing(&Habit::default(), 10.0);
    let mut harness = stage(Snapshot { params, ..busy() }, Language::English);
    press(&mut harness, "Shape");
    press(&mut harness, "Changed (1)");
    assert!(harness.query_by_label("Buds compete for: Space").is_some());
    press(&mut harness, "Reset Buds compete for to Light");
    assert_eq!(asked(&mut harness), [Action::SetParam { path, value: None }]);
}

#[test]
fn search_shows_what_matches_and_only_that() {
    let harness = searched("pressure");
    assert!(harness.query_by_label("Pressure gain").is_some());
    assert!(harness.query_by_label("Pressure curl").is_some());
    assert!(harness.query_by_label("Default opening").is_none());
    let harness = searched("xyzzy");
    assert!(harness.query_by_label_contains("xyzzy").is_some(), "says that nothing was found");
    assert_eq!(harness.query_all_by_role(Role::Slider).count(), 0);
}

#[test]
fn changed_parameters_stand_first_and_go_back_by_a_tap() {
    let mut snapshot = busy();
    let own = serde_json::json!({"depth": {"world": {"height": 2.5}}});
    let species = serde_json::json!({"depth.world.height": 0.6});
    snapshot.params = ParamValues::of(species.as_object().unwrap(), own.as_object().unwrap());
    let mut harness = stage(snapshot, Language::English);
    press(&mut harness, "Shape");
    press(&mut harness, "Changed (1)");
    press(&mut harness, "Reset Height to 0.6");
    assert_eq!(asked(&mut harness), [Action::SetParam { path: "depth.world.height".into(), value: None }]);
    press(&mut harness, "Reset all");
    assert_eq!(asked(&mut harness), [Action::SetParams(Map::new())]);
}

#[test]
fn growth_habits_are_shown_for_plants_that_grow_only() {
    let title = "Growth habit: leaves";
    let mut harness = stage(busy(), Language::English);
    press(&mut harness, "Shape");
    assert!(harness.query_by_label(title).is_none(), "a daisy does not grow");
    assert!(searched("habit.lambda").query_by_label("Trunk's share").is_none());

    let mut harness = stage(growing(), Language::English);
    press(&mut harness, "Shape");
    assert!(harness.query_by_label("Growth habit: crown").is_some());
    harness.get_by_label(title).scroll_to_me();
    harness.run();
    press(&mut harness, title);
    drag(&mut harness, "Length", vec2(30.0, 0.0));
    let actions = asked(&mut harness);
    let Some(Action::SetParam { path, value: Some(value) }) = actions.last() else { panic!("{actions:?}") };
    assert!(path == "habit.leaf.length" && value.is_f64(), "{actions:?}");

    let params = ParamValues::default().growing(&Habit::default(), 0.0);
    let mut harness = stage(Snapshot { params, ..busy() }, Language::English);
    press(&mut harness, "Shape");
    assert!(harness.query_by_label("Growth habit: crown").is_none(), "it has no crown of its own");
}

#[test]
fn habits_are_shown_at_the_plants_age_and_given_back() {
    let lambda = Schedule::new(vec![(0.0, 0.6), (20.0, 0.4)], 0.0, 1.0).unwrap();
    let habit = Habit { lambda, ..Habit::default() };
    let own = serde_json::json!({"habit": {"lambda": 0.75}});
    let params = ParamValues::of(&Map::new(), own.as_object().unwrap()).growing(&habit, 10.0);
    let mut harness = stage(Snapshot { params, ..busy() }, Language::English);
    press(&mut harness, "Shape");
    press(&mut harness, "Changed (1)");
    press(&mut harness, "Reset Trunk's share to 0.5");
    assert_eq!(asked(&mut harness), [Action::SetParam { path: "habit.lambda".into(), value: None }]);

    // Another species was chosen since: it rests.
    let params = ParamValues::of(&Map::new(), own.as_object().unwrap());
    let mut harness = stage(Snapshot { params, ..busy() }, Language::English);
    press(&mut harness, "Shape");
    assert!(harness.query_by_label("Changed (0)").is_some());
}

/// The number beside a rail.
fn number<'a>(harness: &'a Harness<'_, Stage>, label: &'a str) -> egui_kittest::Node<'a> {
    let is_it = |node: &egui_kittest::Node<'_>| {
        node.accesskit_node().label().is_some_and(|name| name.starts_with(label))
    };
    harness.query_all_by_role(Role::SpinButton).find(is_it).unwrap()
}

#[test]
fn a_number_is_typed_and_a_tap_on_it_changes_nothing() {
    let path = "depth.cone.opening_prior".to_owned();
    for (text, key, expected) in [
        ("33", egui::Key::Enter, Some(33.0)),
        ("33,5°", egui::Key::Enter, Some(33.5)),
        ("1000", egui::Key::Enter, Some(85.0)),
        ("33", egui::Key::Escape, None),
        ("much", egui::Key::Enter, None),
    ] {
        let mut harness = searched("opening_prior");
        number(&harness, "Default opening").click();
        harness.run();
        assert_eq!(asked(&mut harness), [], "a tap on the number");
        harness.event(egui::Event::Text(text.to_owned()));
        harness.run();
        harness.key_press(key);
        harness.run();
        let action =
            expected.map(|value| Action::SetParam { path: path.clone(), value: Some(Value::from(value)) });
        assert_eq!(asked(&mut harness), action.into_iter().collect::<Vec<_>>(), "{text} {key:?}");
    }
    // Looked at and left as it is, it stays exactly what it is.
    let mut harness = searched("opening_prior");
    number(&harness, "Default opening").click();
    harness.run();
    harness.key_press(egui::Key::Enter);
    harness.run();
    assert_eq!(asked(&mut harness), []);
}

#[test]
fn a_press_on_the_name_does_not_jump() {
    let mut harness = searched("opening_prior");
    let rail = harness.get_by_role_and_label(Role::Slider, "Default opening").rect();
    let name = rail.left_top() + vec2(12.0, 8.0);
    harness.drag_at(name);
    harness.step();
    harness.drop_at(name);
    harness.run();
    assert_eq!(asked(&mut harness), [], "a tap");
}

#[test]
fn a_rail_is_moved_by_keys() {
    let mut harness = searched("min petals");
    harness.get_by_role_and_label(Role::Slider, "Min petals").focus();
    harness.run();
    harness.key_press(egui::Key::ArrowRight);
    harness.run();
    let actions = asked(&mut harness);
    assert!(matches!(&actions[..], [Action::SetParam { value: Some(v), .. }] if v.is_u64()), "{actions:?}");
}

#[test]
fn the_first_change_moves_nothing_under_the_pointer() {
    let mut harness = stage(busy(), Language::English);
    press(&mut harness, "Shape");
    // The number's name says its value, which may change.
    let name = |label: String| label.split(':').next().unwrap_or_default().to_owned();
    let places = |harness: &Harness<'_, Stage>| -> Vec<(String, egui::Rect)> {
        let all = harness.get_all(egui_kittest::kittest::By::new().predicate(|node| {
            matches!(node.role(), Role::Slider | Role::SpinButton | Role::DisclosureTriangle | Role::CheckBox)
        }));
        all.map(|node| (name(node.accesskit_node().label().unwrap_or_default()), node.rect())).collect()
    };
    press(&mut harness, "Size of the plant");
    let before = places(&harness);
    assert!(before.iter().any(|(label, _)| label == "Height"), "{before:?}");
    let own = serde_json::json!({"depth.world.height": 2.5});
    harness.state_mut().snapshot.params = ParamValues::of(&Map::new(), own.as_object().unwrap());
    harness.run();
    assert!(harness.query_by_label_contains("Reset Height to").is_some());
    assert_eq!(places(&harness), before);
}
