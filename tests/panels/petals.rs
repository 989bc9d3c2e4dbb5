//! The tool over the plant that shapes petals.

use super::stage::{asked, busy, drag, press, stage};
use egui::vec2;
use egui_kittest::kittest::Queryable;
use glam::Vec3;
use penstemon::app::action::Action;
use penstemon::app::messages::Language;
use penstemon::app::panels::Snapshot;
use penstemon::app::panels::snapshot::{PetalPoint, PetalState};

fn with(petals: PetalState) -> Snapshot {
    Snapshot { petals, ..busy() }
}

/// A shaped petal, one of whose points was touched.
pub(super) fn at_work() -> PetalState {
    let point = Some(PetalPoint { row: 3, column: 1, offset: Vec3::new(0.1, -0.2, 0.5) });
    PetalState { any: true, on: true, mirrored: true, chosen: true, shaped: true, point }
}

#[test]
fn the_tool_is_there_where_petals_are_and_is_taken_up() {
    let harness = stage(with(PetalState::default()), Language::English);
    assert!(harness.query_by_label("Shape petals").is_none());
    let any = PetalState { any: true, mirrored: true, ..PetalState::default() };
    let mut harness = stage(with(any), Language::English);
    press(&mut harness, "Shape petals");
    assert_eq!(asked(&mut harness), [Action::ShapePetals(true)]);
    let mut harness = stage(with(PetalState { on: true, ..any }), Language::English);
    assert!(harness.query_by_label("Tap a petal that you drew.").is_some());
    press(&mut harness, "Left and right alike");
    assert_eq!(asked(&mut harness), [Action::MirrorPetals(false)]);
    press(&mut harness, "Shape petals");
    assert_eq!(asked(&mut harness), [Action::ShapePetals(false)]);
}

#[test]
fn a_point_has_numbers_and_the_petals_are_given_back() {
    let state = at_work();
    let before = state.point.unwrap().offset;
    let mut harness = stage(with(state), Language::English);
    drag(&mut harness, "Toward the face", vec2(-20.0, 0.0));
    match asked(&mut harness).pop() {
        Some(Action::SetPetalPoint(offset)) => {
            assert!(offset.z < 0.5 && offset.truncate() == before.truncate(), "{offset}");
        }
        other => panic!("{other:?}"),
    }
    press(&mut harness, "As drawn");
    assert_eq!(asked(&mut harness), [Action::ResetPetals]);
    let harness = stage(with(state), Language::Chinese);
    assert!(harness.query_by_label("朝向正面").is_some());
}
