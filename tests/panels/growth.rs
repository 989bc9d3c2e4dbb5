//! The age of plants that grow: a slider, and growth replayed.

use super::stage::{asked, busy, drag, press, stage};
use egui::vec2;
use egui_kittest::kittest::Queryable;
use penstemon::app::action::Action;
use penstemon::app::messages::Language;
use penstemon::app::panels::Snapshot;
use penstemon::app::panels::growth::YEARS;
use penstemon::app::panels::snapshot::GrowthState;
use penstemon::growth::habit::Resource;
use penstemon::growth::overlay::Wanted;
use penstemon::species::Species;

fn growing(state: GrowthState) -> Snapshot {
    Snapshot { growth: Some(state), species: "oak".into(), ..busy() }
}

const STATE: GrowthState = GrowthState {
    age: 20.0,
    most: 40.0,
    chosen: false,
    crown: true,
    playing: false,
    resource: Some(Resource::Space),
};

#[test]
fn the_age_is_dragged_and_given_back() {
    let mut harness = stage(growing(STATE), Language::English);
    harness.get_by_label("Age").scroll_to_me();
    harness.run();
    assert!(harness.query_by_label("Until the crown is full").is_none(), "nothing to give back yet");
    drag(&mut harness, "Age", vec2(-40.0, 0.0));
    let actions = asked(&mut harness);
    let years: Vec<f64> = actions
        .iter()
        .map(|action| match action {
            Action::SetParam { path, value: Some(value) } if path == YEARS => value.as_f64().unwrap(),
            other => panic!("{other:?}"),
        })
        .collect();
    assert!(!years.is_empty() && years.iter().all(|y| (0.0..20.0).contains(y)), "{years:?}");

    let mut harness = stage(growing(GrowthState { chosen: true, ..STATE }), Language::English);
    harness.get_by_label("Until the crown is full").scroll_to_me();
    harness.run();
    press(&mut harness, "Until the crown is full");
    assert_eq!(asked(&mut harness), [Action::SetParam { path: YEARS.into(), value: None }]);
}

#[test]
fn growth_is_replayed_and_paused_by_one_button() {
    for (playing, label) in [(false, "Let it grow"), (true, "Pause")] {
        let mut harness = stage(growing(GrowthState { playing, ..STATE }), Language::English);
        harness.get_by_label(label).scroll_to_me();
        harness.run();
        press(&mut harness, label);
        assert_eq!(asked(&mut harness), [Action::PlayGrowth(!playing)]);
    }
}

#[test]
fn plants_that_do_not_grow_have_no_age() {
    let harness = stage(busy(), Language::English);
    assert!(harness.query_by_label("Age").is_none() && harness.query_by_label("Let it grow").is_none());
}

#[test]
fn every_species_that_grows_can_be_chosen() {
    let mut harness = stage(busy(), Language::English);
    for species in Species::growing() {
        let label = penstemon::app::messages::Messages::new(Language::English)
            .name(penstemon::app::messages::Named::Species, species);
        harness.get_by_label(&label).scroll_to_me();
        harness.run();
        press(&mut harness, &label);
        assert_eq!(asked(&mut harness), [Action::SetSpecies(species.to_owned())]);
    }
}

#[test]
fn growth_is_seen_from_inside_by_three_switches() {
    let all = Wanted { markers: true, buds: true, light: true };
    let of = |label: &str, on: bool| {
        let mut wanted = if on { Wanted::default() } else { all };
        match label {
            "Markers of space" => wanted.markers = on,
            "Buds" => wanted.buds = on,
            _ => wanted.light = on,
        }
        wanted
    };
    for label in ["Markers of space", "Buds", "Light and shade"] {
        for on in [true, false] {
            let mut snapshot = growing(STATE);
            snapshot.view.overlay = if on { Wanted::default() } else { all };
            let mut harness = stage(snapshot, Language::English);
            press(&mut harness, "View");
            press(&mut harness, label);
            assert_eq!(asked(&mut harness), [Action::SetOverlay(of(label, on))]);
        }
    }
}

#[test]
fn what_a_plant_does_not_compete_for_is_said_and_others_have_nothing_to_see() {
    let says = |resource: Resource, text: &str| {
        let mut snapshot = growing(GrowthState { resource: Some(resource), ..STATE });
        snapshot.view.overlay = Wanted { markers: true, buds: true, light: true };
        let mut harness = stage(snapshot, Language::English);
        press(&mut harness, "View");
        harness.query_by_label_contains(text).is_some()
    };
    assert!(says(Resource::Light, "no markers") && !says(Resource::Space, "no markers"));
    assert!(says(Resource::Space, "not for light") && !says(Resource::Light, "not for light"));
    let mut harness = stage(busy(), Language::English);
    press(&mut harness, "View");
    assert!(harness.query_by_label("Buds").is_none(), "a daisy does not grow");
}
