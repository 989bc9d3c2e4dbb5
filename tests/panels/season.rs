//! The time of the year: a slider with names, and the way back.

use super::stage::{asked, busy, drag, press, stage};
use egui::vec2;
use egui_kittest::kittest::Queryable;
use penstemon::app::action::Action;
use penstemon::app::messages::Language;
use penstemon::app::panels::Snapshot;
use penstemon::app::panels::season::TIME;
use penstemon::app::panels::snapshot::ParamValues;

fn at(time: f64) -> Snapshot {
    let own = [(TIME.to_owned(), time)].into();
    Snapshot { params: ParamValues { own, ..ParamValues::default() }, ..busy() }
}

#[test]
fn the_season_is_dragged_and_given_back() {
    let mut harness = stage(busy(), Language::English);
    harness.get_by_label("Time of the year").scroll_to_me();
    harness.run();
    let usual = "As the species is described";
    assert!(harness.query_by_label(usual).is_none(), "nothing to give back yet");
    drag(&mut harness, "Time of the year", vec2(60.0, 0.0));
    let actions = asked(&mut harness);
    let is_later = |action: &Action| match action {
        Action::SetParam { path, value: Some(value) } if path == TIME => value.as_f64().unwrap() > 2.0,
        other => panic!("{other:?}"),
    };
    assert!(!actions.is_empty() && actions.iter().all(is_later), "{actions:?}");

    let mut harness = stage(at(4.2), Language::English);
    harness.get_by_label(usual).scroll_to_me();
    harness.run();
    press(&mut harness, usual);
    assert_eq!(asked(&mut harness), [Action::SetParam { path: TIME.into(), value: None }]);
}
