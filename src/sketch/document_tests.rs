//! Tests of documents: history, merging, and what a document does not let in.

use super::*;
use crate::sketch::settings::Settings;
use crate::sketch::{Canvas, StrokePoint, TextureChoice, Textures, Tool};
use glam::{Vec2, vec2};
use serde_json::{Map, Value, json};

fn stroke(id: StrokeId, x: f32) -> Stroke {
    Stroke {
        id,
        tool: Tool::Auto,
        points: vec![StrokePoint::at(vec2(x, 0.0)), StrokePoint::at(vec2(x, 9.0))],
        brush: None,
    }
}

/// Strokes 1 to `count`.
fn drawn(count: u64) -> Document {
    let strokes = (1..=count).map(|id| Arc::new(stroke(id, id as f32))).collect();
    Document::new(Sketch { strokes, ..Sketch::empty() })
}

fn ids(document: &Document) -> Vec<StrokeId> {
    document.sketch().strokes.iter().map(|s| s.id).collect()
}

fn params(value: f64) -> Change {
    let Value::Object(params) = json!({ "depth.spread": value }) else { panic!() };
    Change::params(params)
}

#[test]
fn removed_strokes_come_back_to_their_places() {
    let mut document = drawn(6);
    document.apply(Change::remove([5, 2, 3])).unwrap().unwrap();
    assert_eq!(ids(&document), [1, 4, 6]);
    document.apply(Change::put(stroke(7, 0.0))).unwrap().unwrap();
    document.undo().unwrap();
    document.undo().unwrap();
    assert_eq!(ids(&document), [1, 2, 3, 4, 5, 6]);
    document.redo().unwrap();
    assert_eq!(ids(&document), [1, 4, 6]);
    assert!(document.can_undo() && document.can_redo());
}

#[test]
fn a_stroke_put_again_keeps_its_place_and_a_new_one_lies_on_top() {
    let mut document = drawn(3);
    let changes = vec![StrokeChange::Put(stroke(2, 50.0).into()), StrokeChange::Put(stroke(9, 1.0).into())];
    document.apply(Change::strokes(changes)).unwrap();
    assert_eq!(ids(&document), [1, 2, 3, 9]);
    assert_eq!(document.sketch().strokes[1].points[0].position.x, 50.0);
    assert_eq!(document.next_id(), 10);
    document.undo();
    assert_eq!(document.next_id(), 10, "ids are not used twice");
}

#[test]
fn what_changes_nothing_is_no_step() {
    let mut document = drawn(2);
    for change in [
        Change::default(),
        Change::seed(1),
        Change::species(None),
        Change::remove([77]),
        Change::put(stroke(1, 1.0)),
        Change::params(Map::new()),
    ] {
        assert_eq!(document.apply(change.clone()), Ok(None), "{change:?}");
    }
    assert_eq!((document.revision(), document.can_undo()), (0, false));
}

#[test]
fn one_drag_of_a_slider_is_one_step_and_the_next_another() {
    let mut document = drawn(1);
    for value in [0.1, 0.2, 0.3] {
        document.apply_merging(params(value), "depth.spread").unwrap().unwrap();
    }
    document.end_merging();
    document.apply_merging(params(0.4), "depth.spread").unwrap();
    document.apply_merging(Change::seed(5), "seed").unwrap();
    document.apply_merging(params(0.5), "depth.spread").unwrap();
    let mut values = Vec::new();
    while document.undo().is_some() {
        values.push(document.sketch().params.get("depth.spread").and_then(Value::as_f64));
    }
    assert_eq!(values, [Some(0.4), Some(0.4), Some(0.3), None]);
    document.redo();
    document.apply_merging(params(0.9), "depth.spread").unwrap();
    document.undo();
    assert_eq!(document.sketch().params["depth.spread"], 0.3, "a step that was undone is closed");
}

#[test]
fn dragging_strokes_keeps_only_both_ends() {
    let mut document = drawn(3);
    let start = document.sketch().clone();
    for k in 1..100 {
        let moved = [1, 3].map(|id| StrokeChange::Put(stroke(id, 100.0 + k as f32).into()));
        document.apply_merging(Change::strokes(moved.to_vec()), "move").unwrap();
    }
    assert_eq!(document.undo.len(), 1);
    assert_eq!(document.undo[0].step.strokes.len(), 2);
    let end = document.sketch().clone();
    document.undo();
    assert_eq!(document.sketch(), &start);
    document.redo();
    assert_eq!(document.sketch(), &end);
}

#[test]
fn undo_comes_back_to_what_was_saved() {
    let mut document = Document::empty();
    assert!(document.is_saved());
    document.apply(Change::put(stroke(1, 0.0))).unwrap();
    assert!(!document.is_saved());
    document.mark_saved();
    document.apply_merging(Change::seed(2), "seed").unwrap();
    assert!(!document.is_saved());
    document.undo();
    assert!(document.is_saved());
    document.undo();
    assert!(!document.is_saved());
    document.apply(Change::seed(9)).unwrap();
    assert!(!document.is_saved(), "another way cannot lead to the saved state");
    document.undo();
    assert!(!document.is_saved());
    assert!(!Document::unsaved(Sketch::empty()).is_saved());
}

#[test]
fn what_is_drawn_while_saving_is_not_saved() {
    let mut document = Document::empty();
    document.apply(Change::seed(2)).unwrap();
    let point = document.save_point();
    document.apply(Change::seed(3)).unwrap();
    document.mark_saved_at(point);
    assert!(!document.is_saved());
    document.undo();
    assert!(document.is_saved());
}

#[test]
fn saving_in_the_middle_of_a_drag_begins_a_new_step() {
    let mut document = Document::empty();
    document.apply_merging(Change::seed(2), "seed").unwrap();
    document.mark_saved();
    document.apply_merging(Change::seed(3), "seed").unwrap();
    document.undo();
    assert!(document.is_saved());
    assert_eq!(document.sketch().seed, 2);
}

#[test]
fn samples_that_are_no_numbers_stay_out() {
    let mut document = Document::empty();
    let mut odd = stroke(1, 0.0);
    odd.points[0].position.y = f32::NAN;
    odd.points[1].pressure = 7.0;
    odd.points[1].tilt_deg = vec2(f32::NAN, -100.0);
    odd.points.push(StrokePoint::at(Vec2::splat(1e9)));
    document.apply(Change::put(odd)).unwrap();
    let kept = &document.sketch().strokes[0].points;
    let expected =
        StrokePoint { pressure: 1.0, tilt_deg: vec2(0.0, -90.0), ..StrokePoint::at(vec2(0.0, 9.0)) };
    assert_eq!(kept, &[expected]);
    let nothing = Stroke { id: 2, tool: Tool::Leaf, points: vec![StrokePoint::at(Vec2::NAN)], brush: None };
    assert_eq!(document.apply(Change::put(nothing)), Ok(None));
    assert_eq!(document.sketch().check_invariants(), Ok(()));
}

#[test]
fn settings_that_no_file_can_hold_are_refused_in_words() {
    let mut document = drawn(1);
    let refused = |document: &mut Document, change| document.apply(change).unwrap_err().to_string();
    let canvas = Canvas { width: f32::NAN, height: 3.0 };
    let message = refused(&mut document, Settings { canvas: Some(canvas), ..Settings::default() }.into());
    assert!(message.contains("NaN by 3"), "{message}");
    let Value::Object(bad) = json!({ "anatomy": { "x": [1] } }) else { panic!() };
    assert!(refused(&mut document, Change::params(bad)).contains("`anatomy.x`"));
    let textures = Textures::from([("stem".to_owned(), TextureChoice::Named("oak".to_owned()))]);
    assert!(refused(&mut document, Change::textures(textures)).contains("`stem`"));
    let many = (0..=limits::MAX_PARAMS).map(|i| (i.to_string(), Value::from(1))).collect();
    assert!(refused(&mut document, Change::params(many)).contains("4096 parameters"));
    assert_eq!(document.revision(), 0);
}

#[test]
fn a_full_drawing_takes_no_more_but_lets_go() {
    let points = vec![StrokePoint::at(Vec2::ONE); limits::MAX_POINTS - 1];
    let mut document = Document::empty();
    document.apply(Change::put(Stroke { id: 1, tool: Tool::Auto, points, brush: None })).unwrap();
    let error = document.apply(Change::put(stroke(2, 0.0))).unwrap_err().to_string();
    assert!(error.contains("10000000 points") && error.contains("new one"), "{error}");
    let many = vec![
        StrokeChange::Remove(7),
        StrokeChange::Put(stroke(3, 0.0).into()),
        StrokeChange::Put(stroke(4, 0.0).into()),
    ];
    let change =
        Change { settings: Settings { seed: Some(99), ..Settings::default() }, ..Change::strokes(many) };
    let before = document.sketch().clone();
    document.apply(change).unwrap_err();
    assert_eq!(document.sketch(), &before, "a refused change does nothing at all");
    assert_eq!(ids(&document), [1]);
    document.apply(Change::remove([1])).unwrap();
    document.apply(Change::put(stroke(2, 0.0))).unwrap();
}

#[test]
fn the_largest_id_is_no_dead_end() {
    let strokes = vec![Arc::new(stroke(u64::MAX, 0.0)), Arc::new(stroke(1, 0.0))];
    let mut document = Document::new(Sketch { strokes, ..Sketch::empty() });
    assert_eq!(document.next_id(), 2);
    document.apply(Change::put(stroke(2, 0.0))).unwrap();
    document.undo();
    assert_eq!(document.next_id(), 3);
}
