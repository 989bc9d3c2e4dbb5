//! How far flowers have opened: a slider, and their opening replayed.

use super::stage::{asked, busy, drag, press, stage};
use egui::vec2;
use egui_kittest::kittest::Queryable;
use penstemon::app::action::Action;
use penstemon::app::messages::Language;
use penstemon::app::panels::Snapshot;
use penstemon::app::panels::opening::OPEN;
use penstemon::app::panels::snapshot::OpeningState;

fn opening(open: f32, chosen: bool, playing: bool) -> Snapshot {
    Snapshot { opening: Some(OpeningState { open, chosen, playing }), species: "peony".into(), ..busy() }
}

#[test]
fn the_opening_is_dragged_and_given_back() {
    let mut harness = stage(opening(1.0, false, false), Language::English);
    harness.get_by_label("Opening").scroll_to_me();
    harness.run();
    drag(&mut harness, "Opening", vec2(-60.0, 0.0));
    let actions = asked(&mut harness);
    let is_less = |action: &Action| match action {
        Action::SetParam { path, value: Some(value) } if path == OPEN => value.as_f64().unwrap() < 1.0,
        other => panic!("{other:?}"),
    };
    assert!(!actions.is_empty() && actions.iter().all(is_less), "{actions:?}");

    let mut harness = stage(opening(0.4, true, false), Language::English);
    let given_back = "As far as the species opens them";
    harness.get_by_label(given_back).scroll_to_me();
    harness.run();
    press(&mut harness, given_back);
    assert_eq!(asked(&mut harness), [Action::SetParam { path: OPEN.into(), value: None }]);
}

#[test]
fn flowers_open_and_pause_by_one_button() {
    for (playing, label) in [(false, "Let them open"), (true, "Pause")] {
        let mut harness = stage(opening(1.0, false, playing), Language::English);
        harness.get_by_label(label).scroll_to_me();
        harness.run();
        press(&mut harness, label);
        assert_eq!(asked(&mut harness), [Action::PlayOpening(!playing)]);
    }
}

#[test]
fn plants_without_flowers_that_open_have_no_slider_for_it() {
    let harness = stage(busy(), Language::English);
    assert!(harness.query_by_label("Opening").is_none() && harness.query_by_label("Let them open").is_none());
}
