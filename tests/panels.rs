//! The panels around the canvas, used as an artist uses them: by pressing and dragging, in both languages and themes.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

#[path = "panels/pictures.rs"]
mod pictures;
#[path = "panels/stage.rs"]
mod stage;

use egui::{Rect, Role, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use penstemon::app::action::{Action, CanvasTool};
use penstemon::app::messages::{Language, Messages, Msg};
use penstemon::app::panels::snapshot::{
    Dialog, ExportChoice, ExportFormat, Notice, ParamValues, PartMenu, PathPurpose, PathRequest, Recovered,
    ReferenceState, Shading, Task,
};
use penstemon::app::panels::toolbar::TOOLS;
use penstemon::app::presets::Listed;
use penstemon::app::settings::{Handedness, Stabiliser, ThemeChoice};
use penstemon::app::theme::{DARK, LIGHT, TARGET};
use penstemon::plant::OrganKind;
use penstemon::sketch::Tool;
use serde_json::{Map, Value};
use stage::{Stage, asked, busy, stage};

const ROLES: [Role; 6] = [
    Role::Button,
    Role::RadioButton,
    Role::CheckBox,
    Role::Slider,
    Role::TextInput,
    Role::DisclosureTriangle,
];

/// A state of the interface to be looked at: name, language, page of the side panel, what is different.
type Shot = (&'static str, Language, Option<Msg>, fn(&mut penstemon::app::panels::Snapshot));

/// States whose pictures are written for people to look at.
const SHOTS: [Shot; 12] = [
    ("chinese", Language::Chinese, None, |_| ()),
    ("shape", Language::English, Some(Msg::TabShape), |s| {
        s.params.own =
            [("depth.world.height".to_owned(), 0.8), ("anatomy.flowers.min_petals".to_owned(), 5.0)].into();
    }),
    ("view", Language::Chinese, Some(Msg::TabView), |s| {
        s.reference = Some(ReferenceState { opacity: 0.5, locked: true });
    }),
    ("settings", Language::English, Some(Msg::SettingsTitle), |_| ()),
    ("files", Language::Chinese, Some(Msg::FileMenu), |_| ()),
    ("textures", Language::English, None, |s| {
        s.textures.insert("petal".into(), "petal_rose".into());
        s.presets = vec![Listed { name: "Evening".into(), path: "/presets/evening.toml".into() }];
        s.part_menu = Some(PartMenu { stroke: Some(9), tool: Tool::Petal, at: [400.0, 300.0] });
    }),
    ("export", Language::English, None, |s| {
        s.dialog = Some(Dialog::Export);
        s.export_bytes = Some(3_400_000);
    }),
    ("png", Language::Chinese, None, |s| {
        s.dialog = Some(Dialog::Export);
        s.export.format = ExportFormat::Png;
    }),
    ("about", Language::English, None, |s| s.dialog = Some(Dialog::About)),
    ("recovery", Language::English, None, |s| {
        let one = |name: &str| Recovered {
            path: name.into(),
            name: name.into(),
            strokes: 12,
            when: "yesterday, 18:03".into(),
            thumbnail: None,
        };
        s.dialog = Some(Dialog::Recovery(vec![one("Rose"), one("Meadow")]));
    }),
    ("path", Language::English, None, |s| {
        s.dialog = Some(Dialog::Path(PathRequest {
            purpose: PathPurpose::SaveDrawing,
            folder: concat!(env!("CARGO_MANIFEST_DIR"), "/assets/sketches").into(),
            name: "meadow".into(),
            extensions: vec!["penstemon"],
        }));
    }),
    ("menus", Language::English, None, |s| {
        s.selected = 3;
        s.notices = vec![
            Notice::error(
                "The disk is full; the drawing stays in memory.",
                "free some space, or save elsewhere",
            ),
            Notice::warning("No Chinese font was found.", "install one"),
        ];
        s.handedness = Handedness::Left;
    }),
];

/// Presses what has this name.
fn press(harness: &mut Harness<'_, Stage>, label: &str) {
    let touched = |node: &egui_kittest::Node<'_>| ROLES.contains(&node.accesskit_node().role());
    let found: Vec<_> = harness.query_all_by_label(label).filter(touched).collect();
    assert_eq!(found.len(), 1, "there should be one {label}");
    found[0].click();
    drop(found);
    harness.run();
}

/// Every widget that can be touched, with its name and the part of it that is in the window.
fn targets(harness: &Harness<'_, Stage>) -> Vec<(String, Rect)> {
    let all =
        harness.get_all(egui_kittest::kittest::By::new().predicate(|node| ROLES.contains(&node.role())));
    let named = |node: egui_kittest::Node<'_>| {
        let node_rect = node.rect();
        let label = node.accesskit_node().label().unwrap_or_default();
        (label, node_rect)
    };
    all.map(named).collect()
}

fn english() -> Messages {
    Messages::new(Language::English)
}

#[test]
fn every_tool_is_one_tap() {
    let mut harness = stage(busy(), Language::English);
    for tool in TOOLS {
        let name = english().get(tool.name).to_owned();
        press(&mut harness, &name);
        assert_eq!(asked(&mut harness), [Action::SetTool(tool.tool)], "{name}");
    }
}

#[test]
fn tools_have_keys_of_their_own() {
    let mut keys: Vec<_> = TOOLS.iter().map(|tool| tool.key).collect();
    keys.sort_unstable();
    keys.dedup();
    assert_eq!(keys.len(), TOOLS.len());
}

#[test]
fn the_bar_asks_for_what_its_buttons_say() {
    let mut harness = stage(busy(), Language::English);
    for (label, action) in [
        ("New", Action::New),
        ("Open", Action::Open),
        ("Save", Action::Save),
        ("Undo", Action::Undo),
        ("Show all", Action::FitCanvas),
        ("Front view", Action::FrontView),
        ("Reference picture", Action::OpenReference),
        ("Export", Action::ShowExport),
        ("Help", Action::ShowDialog(Dialog::About)),
        ("Hide the side panel", Action::ShowSide(false)),
    ] {
        press(&mut harness, label);
        assert_eq!(asked(&mut harness), [action], "{label}");
    }
    // nothing to redo
    press(&mut harness, "Redo");
    assert_eq!(asked(&mut harness), []);
}

#[test]
fn the_menu_opens_recent_drawings() {
    let mut harness = stage(busy(), Language::English);
    press(&mut harness, "Menu");
    press(&mut harness, "rose");
    assert_eq!(asked(&mut harness), [Action::OpenPath("/home/ada/rose.penstemon".into())]);
    press(&mut harness, "Menu");
    press(&mut harness, "Save as");
    assert_eq!(asked(&mut harness), [Action::SaveAs]);
}

#[test]
fn settings_are_a_tap_each() {
    let mut harness = stage(busy(), Language::English);
    press(&mut harness, "Settings");
    for (label, action) in [
        ("Dark", Action::SetTheme(ThemeChoice::Dark)),
        ("Left", Action::SetHandedness(Handedness::Left)),
        ("Strong", Action::SetStabiliser(Stabiliser::Strong)),
        ("Stabiliser: Light", Action::SetStabiliser(Stabiliser::Strong)),
    ] {
        press(&mut harness, label);
        assert_eq!(asked(&mut harness), [action], "{label}");
    }
    press(&mut harness, "Settings");
    let chinese = if stage::chinese_font().is_some() { "简体中文" } else { "Chinese (Zhongwen)" };
    press(&mut harness, chinese);
    assert_eq!(asked(&mut harness), [Action::SetLanguage(Language::Chinese)]);
}

#[test]
fn another_language_changes_every_label_at_once() {
    let mut harness = stage(busy(), Language::English);
    assert!(harness.query_all_by_label("Petal").next().is_some());
    harness.state_mut().messages = Messages::new(Language::Chinese);
    harness.run();
    for english in ["Petal", "Undo", "Export", "Daisy", "Plant", "Roll the dice"] {
        assert!(harness.query_all_by_label(english).next().is_none(), "{english} is still there");
    }
    for chinese in ["花瓣", "撤销", "导出", "雏菊", "植物", "掷骰子"] {
        assert!(harness.query_all_by_label(chinese).next().is_some(), "{chinese} is missing");
    }
}

#[test]
fn species_textures_and_seed_are_chosen_by_tapping() {
    let mut harness = stage(busy(), Language::English);
    press(&mut harness, "Plumeria");
    assert_eq!(asked(&mut harness), [Action::SetSpecies("plumeria".into())]);
    harness.get_by_label("Roll the dice").scroll_to_me();
    harness.run();
    press(&mut harness, "Roll the dice");
    assert_eq!(asked(&mut harness), [Action::RollSeed]);
    press(&mut harness, "Next seed");
    assert_eq!(asked(&mut harness), [Action::SetSeed(18)]);
    harness.get_by_label("petal rose").scroll_to_me();
    harness.run();
    press(&mut harness, "petal rose");
    let texture = Some("petal_rose.png".to_owned());
    assert_eq!(asked(&mut harness), [Action::SetTexture { organ: Some(OrganKind::Petal), texture }]);
    harness.get_by_label("Branches").scroll_to_me();
    harness.run();
    press(&mut harness, "Branches");
    press(&mut harness, "Picture file…");
    assert_eq!(asked(&mut harness), [Action::ChooseFile(PathPurpose::Texture(None))]);
}

#[test]
fn a_chosen_texture_can_be_given_back() {
    let mut snapshot = busy();
    snapshot.textures.insert("petal".into(), "petal_rose".into());
    let mut harness = stage(snapshot, Language::English);
    harness.get_by_label("Species' own").scroll_to_me();
    harness.run();
    press(&mut harness, "Species' own");
    assert_eq!(asked(&mut harness), [Action::SetTexture { organ: Some(OrganKind::Petal), texture: None }]);
}

/// Shows the page of parameters and searches it.
fn searched(text: &str) -> Harness<'static, Stage> {
    let mut harness = stage(busy(), Language::English);
    press(&mut harness, "Shape");
    harness.get_by_role(Role::TextInput).click();
    harness.run();
    harness.get_by_role(Role::TextInput).type_text(text);
    harness.run();
    harness
}

/// Moves the pointer from a rail's middle by this much, held down, in small steps.
fn drag(harness: &mut Harness<'_, Stage>, label: &str, by: Vec2) {
    let from = harness.get_by_label(label).rect().center();
    harness.drag_at(from);
    harness.step();
    for step in 1..=10 {
        harness.hover_at(from + by * (step as f32 / 10.0));
        harness.step();
    }
    harness.drop_at(from + by);
    harness.run();
}

#[test]
fn a_rail_dragged_sideways_sets_its_parameter() {
    let mut harness = searched("opening prior");
    drag(&mut harness, "Opening prior", vec2(60.0, 3.0));
    let actions = asked(&mut harness);
    let Some(Action::SetParam { path, value: Some(value) }) = actions.last() else { panic!("{actions:?}") };
    assert_eq!(path, "depth.cone.opening_prior");
    let value = value.as_f64().unwrap();
    // 10 to 85 degrees over about 250 pixels, from the middle 60 to the right
    assert!((60.0..75.0).contains(&value), "{value}");
    assert!(actions.len() > 3, "the plant follows while the rail is dragged: {actions:?}");
}

#[test]
fn a_rail_dragged_up_or_down_scrolls_and_sets_nothing() {
    let mut harness = searched("opening prior");
    drag(&mut harness, "Opening prior", vec2(4.0, 80.0));
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
    press(&mut harness, "Flip");
    let value = Some(Value::Bool(true));
    assert_eq!(asked(&mut harness), [Action::SetParam { path: "depth.cone.flip".into(), value }]);
}

#[test]
fn every_value_that_a_rail_gives_is_accepted_by_the_pipeline() {
    use penstemon::params::{Overrides, Parameters};
    use penstemon::pipeline::Params;
    let described = Params::describe();
    let mut groups: Vec<&str> = described.iter().filter_map(|d| Some(d.path.rsplit_once('.')?.0)).collect();
    groups.dedup();
    let mut moved = 0;
    for group in groups {
        let mut harness = searched(&format!("{group}."));
        for description in
            described.iter().filter(|d| d.path.rsplit_once('.').is_some_and(|(g, _)| g == group))
        {
            let label = english().param_name(&description.path);
            if harness.query_by_role_and_label(Role::Slider, &label).is_none() {
                continue;
            }
            harness.get_by_label(&label).scroll_to_me();
            harness.run();
            drag(&mut harness, &label, vec2(-37.0, 0.0));
            let mut actions = asked(&mut harness);
            if actions.is_empty() {
                // it stood there already
                drag(&mut harness, &label, vec2(90.0, 0.0));
                actions = asked(&mut harness);
            }
            assert!(!actions.is_empty(), "{} does not move", description.path);
            moved += 1;
            for action in actions {
                let Action::SetParam { path, value: Some(value) } = action else { panic!("{action:?}") };
                assert_eq!(path, description.path);
                let tree = Map::from_iter([(path.clone(), value.clone())]);
                let mut overrides = Overrides::new::<Params>();
                overrides.merge(&tree).unwrap_or_else(|e| panic!("{path} = {value}: {e}"));
                overrides.finish::<Params>().unwrap_or_else(|e| panic!("{path} = {value}: {e}"));
            }
        }
    }
    assert!(moved + 2 >= described.len(), "only {moved} of {} rails were moved", described.len());
}

#[test]
fn search_shows_what_matches_and_only_that() {
    let harness = searched("pressure");
    assert!(harness.query_by_label("Pressure gain").is_some());
    assert!(harness.query_by_label("Pressure curl").is_some());
    assert!(harness.query_by_label("Opening prior").is_none());
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
    assert!(harness.query_by_label("Changed (1)").is_some());
    press(&mut harness, "Reset Height to 0.6");
    assert_eq!(asked(&mut harness), [Action::SetParam { path: "depth.world.height".into(), value: None }]);
    press(&mut harness, "Reset all");
    assert_eq!(asked(&mut harness), [Action::SetParams(Map::new())]);
}

#[test]
fn presets_are_saved_under_a_proposed_name_without_a_keyboard() {
    let mut snapshot = busy();
    snapshot.presets = vec![Listed { name: "Daisy 1".into(), path: "/presets/daisy-1.toml".into() }];
    let mut harness = stage(snapshot, Language::English);
    harness.get_by_label("Save this look").scroll_to_me();
    harness.run();
    press(&mut harness, "Save this look");
    assert_eq!(asked(&mut harness), [Action::SavePreset("Daisy 2".into())]);
    press(&mut harness, "Daisy 1");
    assert_eq!(asked(&mut harness), [Action::ApplyPreset("/presets/daisy-1.toml".into())]);
    press(&mut harness, "Delete Daisy 1");
    assert_eq!(asked(&mut harness), [Action::DeletePreset("/presets/daisy-1.toml".into())]);
}

#[test]
fn the_view_is_set_by_tapping_and_dragging() {
    let mut snapshot = busy();
    snapshot.reference = Some(ReferenceState { opacity: 0.5, locked: false });
    let mut harness = stage(snapshot, Language::English);
    press(&mut harness, "View");
    for (label, action) in [
        ("Mesh", Action::SetShading(Shading::Wireframe)),
        ("Without perspective", Action::SetOrthographic(true)),
        ("Turntable", Action::SetTurntable(true)),
        ("Copy picture", Action::CopyPicture),
        ("Lock", Action::LockReference(true)),
        ("Remove", Action::RemoveReference),
    ] {
        harness.get_by_label(label).scroll_to_me();
        harness.run();
        press(&mut harness, label);
        assert_eq!(asked(&mut harness), [action], "{label}");
    }
    drag(&mut harness, "Opacity", vec2(50.0, 0.0));
    let actions = asked(&mut harness);
    assert!(
        matches!(actions.last(), Some(Action::SetReferenceOpacity(o)) if *o > 0.55 && *o < 0.9),
        "{actions:?}"
    );
    drag(&mut harness, "Strength", vec2(-30.0, 0.0));
    let actions = asked(&mut harness);
    assert!(matches!(actions.last(), Some(Action::SetLight(l)) if l.strength < 1.0), "{actions:?}");
}

#[test]
fn a_wrong_guess_is_corrected_by_one_tap() {
    let mut snapshot = busy();
    snapshot.part_menu = Some(PartMenu { stroke: Some(9), tool: Tool::Auto, at: [1270.0, 790.0] });
    let mut harness = stage(snapshot, Language::English);
    let leaf = harness.query_all_by_label("Leaf").find(|node| node.rect().left() > 200.0).unwrap();
    assert!(harness.state().canvas.contains_rect(leaf.rect()), "the menu stays inside the canvas");
    leaf.click();
    harness.run();
    let actions = asked(&mut harness);
    assert!(actions.contains(&Action::SetStrokePart { stroke: 9, tool: Tool::Leaf }), "{actions:?}");
    assert!(actions.contains(&Action::ClosePartMenu));
}

#[test]
fn selected_strokes_offer_what_can_be_done() {
    let mut snapshot = busy();
    snapshot.selected = 3;
    let mut harness = stage(snapshot, Language::English);
    for (label, action) in [("Duplicate", Action::DuplicateSelected), ("Delete", Action::DeleteSelected)] {
        press(&mut harness, label);
        assert_eq!(asked(&mut harness), [action]);
    }
}

fn with_dialog(dialog: Dialog) -> Harness<'static, Stage> {
    let mut snapshot = busy();
    snapshot.dialog = Some(dialog);
    stage(snapshot, Language::English)
}

/// Presses the last thing of this name: dialogs stand above everything else.
fn press_last(harness: &mut Harness<'_, Stage>, label: &str) {
    let touched = |node: &egui_kittest::Node<'_>| ROLES.contains(&node.accesskit_node().role());
    harness.query_all_by_label(label).rfind(touched).unwrap().click();
    harness.run();
}

#[test]
fn unsaved_changes_have_three_answers() {
    for (label, action) in [
        ("Save", Action::SaveAndContinue),
        ("Don't save", Action::DiscardAndContinue),
        ("Cancel", Action::CloseDialog),
    ] {
        let mut harness = with_dialog(Dialog::Unsaved);
        press_last(&mut harness, label);
        assert_eq!(asked(&mut harness), [action]);
    }
    // a tap beside the dialog is no answer, and nothing below it is reached
    let mut harness = with_dialog(Dialog::Unsaved);
    press(&mut harness, "Petal");
    assert_eq!(asked(&mut harness), []);
}

#[test]
fn found_drawings_are_discarded_only_after_asking() {
    let one = Recovered {
        path: "/state/1.journal".into(),
        name: "Rose".into(),
        strokes: 12,
        when: "yesterday, 18:03".into(),
        thumbnail: None,
    };
    let mut harness = with_dialog(Dialog::Recovery(vec![one]));
    press(&mut harness, "Discard Rose");
    assert_eq!(asked(&mut harness), []);
    press(&mut harness, "Really discard?");
    assert_eq!(asked(&mut harness), [Action::DiscardRecovery("/state/1.journal".into())]);
}

#[test]
fn the_export_dialog_keeps_what_is_chosen_and_refuses_nothing_at_all() {
    let mut harness = with_dialog(Dialog::Export);
    press_last(&mut harness, "Leaves");
    let without = ExportChoice { leaves: false, ..ExportChoice::default() };
    assert_eq!(asked(&mut harness), [Action::SetExport(without.clone())]);
    harness.state_mut().snapshot.export = without.clone();
    harness.run();
    press(&mut harness, "Export…");
    assert_eq!(asked(&mut harness), [Action::Export(without)]);
    press(&mut harness, "PNG");
    assert_eq!(
        asked(&mut harness),
        [Action::SetExport(ExportChoice {
            format: ExportFormat::Png,
            leaves: false,
            ..ExportChoice::default()
        })]
    );
    harness.state_mut().snapshot.export = ExportChoice {
        branches: false,
        leaves: false,
        flowers: false,
        extras: false,
        ..ExportChoice::default()
    };
    harness.run();
    press(&mut harness, "Export…");
    assert_eq!(asked(&mut harness), []);
}

#[test]
fn a_long_export_shows_progress_and_can_be_stopped() {
    let mut snapshot = busy();
    snapshot.dialog = Some(Dialog::Export);
    snapshot.task = Some(Task { name: "rose.glb".into(), progress: 0.4 });
    let mut harness = stage(snapshot, Language::English);
    assert!(harness.query_by_label("Writing rose.glb: 40 %").is_some());
    press(&mut harness, "Stop");
    assert_eq!(asked(&mut harness), [Action::CancelTask]);
}

#[test]
fn a_file_is_chosen_and_one_replaced_only_after_a_second_press() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("daisy.penstemon"), "").unwrap();
    let request = |purpose, name: &str| PathRequest {
        purpose,
        folder: folder.path().to_owned(),
        name: name.to_owned(),
        extensions: vec!["penstemon"],
    };
    let path = folder.path().join("daisy.penstemon");
    let mut harness = with_dialog(Dialog::Path(request(PathPurpose::OpenDrawing, "")));
    press(&mut harness, "daisy.penstemon");
    press_last(&mut harness, "Open");
    assert_eq!(
        asked(&mut harness),
        [Action::PathChosen { purpose: PathPurpose::OpenDrawing, path: path.clone() }]
    );

    let mut harness = with_dialog(Dialog::Path(request(PathPurpose::SaveDrawing, "daisy")));
    press_last(&mut harness, "Save");
    assert_eq!(asked(&mut harness), []);
    press(&mut harness, "Replace the existing file");
    assert_eq!(asked(&mut harness), [Action::PathChosen { purpose: PathPurpose::SaveDrawing, path }]);
}

#[test]
fn notices_say_what_to_do_and_go_away_by_a_tap() {
    let mut snapshot = busy();
    let what = "The disk is full; the drawing stays in memory.";
    snapshot.notices = vec![Notice { id: 5, ..Notice::error(what, "free some space, or save elsewhere") }];
    let mut harness = stage(snapshot, Language::English);
    assert!(harness.query_by_label(what).is_some());
    assert!(harness.query_by_label_contains("save elsewhere").is_some());
    press(&mut harness, "Dismiss");
    assert_eq!(asked(&mut harness), [Action::DismissNotice(5)]);
}

/// Every state whose measures are checked.
fn states() -> Vec<(&'static str, Stage)> {
    let state = |change: &dyn Fn(&mut Stage)| {
        let mut stage =
            Stage { snapshot: busy(), messages: english(), actions: Vec::new(), canvas: Rect::NOTHING };
        change(&mut stage);
        stage
    };
    let mut found = vec![("right-handed", state(&|_| ()))];
    found.push(("left-handed", state(&|s| s.snapshot.handedness = Handedness::Left)));
    found.push(("without side panel", state(&|s| s.snapshot.side_shown = false)));
    found
}

#[test]
fn everything_that_can_be_touched_is_large_enough() {
    for language in Language::ALL {
        for page in [Msg::TabPlant, Msg::TabShape, Msg::TabView] {
            let mut snapshot = busy();
            snapshot.reference = Some(ReferenceState { opacity: 0.5, locked: false });
            let mut harness = stage(snapshot, language);
            press(&mut harness, Messages::new(language).get(page));
            check_sizes(&harness);
        }
        for dialog in [Dialog::Unsaved, Dialog::Export, Dialog::About] {
            let mut snapshot = busy();
            snapshot.dialog = Some(dialog);
            check_sizes(&stage(snapshot, language));
        }
        let mut harness = stage(busy(), language);
        let menus = [Msg::FileMenu, Msg::SettingsTitle];
        for menu in menus {
            press(&mut harness, Messages::new(language).get(menu));
            check_sizes(&harness);
        }
    }
}

fn check_sizes(harness: &Harness<'_, Stage>) {
    let all = targets(harness);
    assert!(all.len() > 15, "only {} targets", all.len());
    for (label, rect) in all {
        let enough = rect.width() >= TARGET - 0.5 && rect.height() >= TARGET - 0.5;
        assert!(enough, "{label:?} is {} × {}", rect.width(), rect.height());
    }
}

#[test]
fn nothing_overlaps_and_nothing_leaves_the_window() {
    for language in Language::ALL {
        for (name, state) in states() {
            let harness = stage(state.snapshot, language);
            let window = Rect::from_min_size(egui::Pos2::ZERO, vec2(1280.0, 800.0));
            let canvas = harness.state().canvas;
            assert!(canvas.width() > 700.0 && canvas.height() > 600.0, "{name}: {canvas:?}");
            let bottom = window.bottom();
            // what a scrolled page holds below the window's edge is not seen
            let all: Vec<_> =
                targets(&harness).into_iter().filter(|(_, rect)| rect.bottom() <= bottom - 30.0).collect();
            for (i, (label, rect)) in all.iter().enumerate() {
                assert!(
                    window.expand(0.5).contains_rect(*rect),
                    "{name}: {label} leaves the window: {rect:?}"
                );
                assert!(
                    !canvas.shrink(1.0).intersects(*rect),
                    "{name}: {label} lies on the canvas: {rect:?}"
                );
                for (other, place) in &all[i + 1..] {
                    let common = rect.intersect(*place);
                    let apart = common.width() <= 1.0 || common.height() <= 1.0;
                    assert!(apart, "{name}, {language:?}: {label} {rect:?} lies on {other} {place:?}");
                }
            }
        }
    }
}

#[test]
fn left_handed_is_the_mirror_image() {
    let mut snapshot = busy();
    let right = stage(snapshot.clone(), Language::English);
    snapshot.handedness = Handedness::Left;
    let left = stage(snapshot, Language::English);
    let tool = |harness: &Harness<'_, Stage>| harness.get_by_label("Partial eraser").rect().center().x;
    assert!(tool(&right) < 80.0 && tool(&left) > 1200.0);
}

#[test]
fn a_small_window_still_reaches_everything() {
    let harness = stage::stage_of(busy(), Language::English, vec2(800.0, 480.0), 1.0, None);
    assert!(harness.state().canvas.width() >= 300.0);
    assert!(harness.get_by_label("Export").rect().right() <= 800.0);
    let mut harness = harness;
    harness.get_by_label("Hand").scroll_to_me();
    harness.run();
    press(&mut harness, "Hand");
    assert_eq!(asked(&mut harness), [Action::SetTool(CanvasTool::Pan)]);
}

#[test]
fn an_idle_interface_asks_for_no_more_frames() {
    let mut harness = stage(busy(), Language::English);
    harness.run();
    harness.step();
    let wait = harness.output().viewport_output.values().map(|v| v.repaint_delay).min().unwrap();
    assert!(wait > std::time::Duration::from_secs(1), "{wait:?}");
}

#[test]
fn chinese_has_no_boxes_where_a_font_was_found() {
    let Some(font) = stage::chinese_font() else {
        eprintln!(
            "no Chinese font on this machine: {}",
            Messages::new(Language::English).get(Msg::NoticeInstallFont)
        );
        return;
    };
    let context = egui::Context::default();
    context.set_fonts(penstemon::app::fonts::definitions(Some(font)));
    let mut output = context.run_ui(egui::RawInput::default(), |_| ());
    output.textures_delta.clear();
    let chinese = Messages::new(Language::Chinese);
    for msg in Msg::ALL {
        for letter in chinese.get(*msg).chars() {
            let known = context.fonts_mut(|fonts| fonts.has_glyph(&egui::FontId::proportional(14.0), letter));
            assert!(known, "{letter:?} of {:?} is missing in {}", msg.name(), font.family);
        }
    }
}

#[test]
fn the_graphics_card_draws_the_interface_in_both_themes() {
    use pictures::{Painter, Textures, write};
    use std::{cell::RefCell, rc::Rc};
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let painter = Rc::new(RefCell::new(Painter::new()));
    for (theme, p) in [(ThemeChoice::Light, LIGHT), (ThemeChoice::Dark, DARK)] {
        let mut snapshot = busy();
        snapshot.theme = theme;
        let textures = Some(Textures(painter.clone()));
        let harness = stage::stage_of(snapshot, Language::English, vec2(1280.0, 800.0), 1.0, textures);
        let (size, pixels) = painter.borrow_mut().draw(&harness, p.paper);
        assert_eq!(size, [1280, 800]);
        write(&folder.join(format!("panels-{theme:?}.png")), size, &pixels);
        let at = |x: usize, y: usize| &pixels[(y * 1280 + x) * 4..][..3];
        for (x, y) in [(500, 300), (900, 700), (40, 700)] {
            assert_eq!(at(x, y), &p.panel.to_array()[..3], "nothing is drawn at {x}, {y}");
        }
        let accent =
            pixels.as_chunks::<4>().0.iter().filter(|pixel| pixel[..3] == p.accent.to_array()[..3]).count();
        assert!(accent > 500, "the loud button is seen: {accent}");
        for (name, language, page, change) in SHOTS {
            let mut snapshot = busy();
            snapshot.theme = theme;
            change(&mut snapshot);
            let textures = Some(Textures(painter.clone()));
            let mut harness = stage::stage_of(snapshot, language, vec2(1280.0, 800.0), 1.0, textures);
            if let Some(page) = page {
                press(&mut harness, Messages::new(language).get(page));
            }
            if name == "textures" {
                harness.get_by_label("Save this look").scroll_to_me();
                harness.run();
            }
            let (size, pixels) = painter.borrow_mut().draw(&harness, p.paper);
            write(&folder.join(format!("panels-{theme:?}-{name}.png")), size, &pixels);
        }
        let mut snapshot = busy();
        snapshot.theme = theme;
        let textures = Some(Textures(painter.clone()));
        let harness = stage::stage_of(snapshot, Language::English, vec2(1280.0, 800.0), 2.0, textures);
        let (size, pixels) = painter.borrow_mut().draw(&harness, p.paper);
        assert_eq!(size, [2560, 1600]);
        write(&folder.join(format!("panels-{theme:?}-2x.png")), size, &pixels);
    }
}

#[test]
fn the_desktop_files_agree_with_each_other() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/desktop");
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    let (id, mime) = ("org.penstemon.Penstemon", "application/x-penstemon");
    let entry = read("org.penstemon.Penstemon.desktop");
    assert!(entry.contains(&format!("StartupWMClass={id}\n")) && entry.contains(&format!("Icon={id}\n")));
    assert!(entry.lines().any(|line| line.starts_with("MimeType=") && line.contains(mime)));
    let types = read("org.penstemon.Penstemon.mime.xml");
    let types = roxmltree::Document::parse(&types).unwrap();
    assert!(types.descendants().any(|node| node.attribute("type") == Some(mime)));
    assert!(types.descendants().any(|node| node.attribute("pattern") == Some("*.penstemon")));
    let about = read("org.penstemon.Penstemon.metainfo.xml");
    let about = roxmltree::Document::parse(&about).unwrap();
    let text =
        |name: &str| about.descendants().find(|node| node.has_tag_name(name)).and_then(|node| node.text());
    assert_eq!((text("id"), text("mediatype")), (Some(id), Some(mime)));
    let icon = read("penstemon.svg");
    let icon = roxmltree::Document::parse(&icon).unwrap();
    assert_eq!(icon.root_element().attribute("viewBox"), Some("0 0 256 256"));
}
