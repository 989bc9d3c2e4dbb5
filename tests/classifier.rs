//! How well the shipped classifier tells blades from branches: on known shapes, on synthetic strokes it was not trained
//! on, and on people's drawings.

#[path = "common/confusion.rs"]
mod confusion;
#[path = "common/real_strokes.rs"]
mod real_strokes;
#[path = "common/synthetic/mod.rs"]
mod synthetic;

use confusion::Confusion;
use glam::Vec2;
use penstemon::anatomy::classify::{Classifier, Verdict};
use std::f32::consts::PI;
use synthetic::{HELD_OUT_SEED, LabelledStroke, TRAINING_SEED};

fn verdict(points: &[Vec2]) -> Verdict {
    Classifier::built_in().classify(points)
}

/// `f` over 0 to 1, in pixels.
fn drawn(f: impl Fn(f32) -> (f32, f32)) -> Vec<Vec2> {
    (0..=60).map(|i| Vec2::from(f(i as f32 / 60.0)) * 300.0 + Vec2::new(200.0, 100.0)).collect()
}

fn arc(degrees: f32) -> Vec<Vec2> {
    drawn(|s| (s * degrees).to_radians().sin_cos())
}

/// A leaf of unit length and this width, both ends pointed, as one closed stroke.
fn leaf(width: f32) -> Vec<Vec2> {
    drawn(|s| {
        let (t, side) = if s < 0.5 { (2.0 * s, -0.5) } else { (2.0 - 2.0 * s, 0.5) };
        (side * width * (PI * t).sin(), t)
    })
}

/// A petal that is `gap` wide at its open root and twice as long as that is wide.
fn open_petal(gap: f32) -> Vec<Vec2> {
    drawn(|s| (-gap / 2.0 * (PI * s).cos(), 2.0 * gap * (PI * s).sin().max(0.0).sqrt()))
}

#[test]
fn shapes_that_an_artist_would_call_blades() {
    let blades = [
        ("willow leaf", leaf(0.1)),
        ("broad leaf", leaf(0.6)),
        ("round petal", arc(360.0)),
        ("petal with a small gap", arc(330.0)),
        ("daisy petal", drawn(|s| (0.1 * (2.0 * PI * s).sin(), 0.5 - 0.5 * (2.0 * PI * s).cos()))),
        ("petal left open as a U", open_petal(0.3)),
        ("petal left open as a V", drawn(|s| (0.3 * s, if s < 0.5 { 2.0 * s } else { 2.0 - 2.0 * s }))),
    ];
    for (name, points) in blades {
        let Verdict { blade, confidence } = verdict(&points);
        assert!(blade && confidence > 0.9, "{name}: blade {blade}, confidence {confidence}");
    }
}

#[test]
fn shapes_that_an_artist_would_call_branches() {
    let branches = [
        ("ruler-straight line", vec![Vec2::new(0.0, 0.0), Vec2::new(0.0, 500.0)]),
        ("slanted line of many samples", drawn(|s| (s, 0.3 * s))),
        ("quarter arc", arc(90.0)),
        ("C arc", arc(170.0)),
        ("S curve", drawn(|s| (0.2 * (2.0 * PI * s).sin(), s))),
        ("wave", drawn(|s| (0.1 * (8.0 * PI * s).sin(), s))),
        ("zigzag", drawn(|s| ((6.0 * s).fract().min(1.0 - (6.0 * s).fract()) * 0.2, s))),
        (
            "cane",
            drawn(|s| {
                if s < 0.7 {
                    (0.0, s)
                } else {
                    (0.1 - 0.1 * (10.0 * (s - 0.7)).cos(), 0.7 + 0.1 * (10.0 * (s - 0.7)).sin())
                }
            }),
        ),
    ];
    for (name, points) in branches {
        let Verdict { blade, confidence } = verdict(&points);
        assert!(!blade && confidence > 0.9, "{name}: blade {blade}, confidence {confidence}");
    }
}

#[test]
fn the_same_seed_draws_the_same_strokes_and_another_draws_others() {
    let points = |seed| synthetic::strokes(30, seed).into_iter().map(|s| s.points).collect::<Vec<_>>();
    assert_eq!(points(TRAINING_SEED), points(TRAINING_SEED));
    let held_out = points(HELD_OUT_SEED);
    assert!(points(TRAINING_SEED).iter().all(|stroke| !held_out.contains(stroke)));
}

#[test]
fn strokes_of_another_seed_are_classified_and_confidence_is_honest() {
    let mut confusion = Confusion::default();
    let mut confidence = 0.0;
    let strokes: Vec<LabelledStroke> = synthetic::strokes(1430, HELD_OUT_SEED);
    for stroke in &strokes {
        let verdict = verdict(&stroke.points);
        confusion.add(stroke.blade, verdict.blade);
        confidence += f64::from(verdict.confidence) / strokes.len() as f64;
    }
    assert!(confusion.accuracy() >= 0.97, "\n{confusion}");
    assert!((confidence - confusion.accuracy()).abs() < 0.02, "confidence {confidence}\n{confusion}");
}

#[test]
fn verdicts_do_not_depend_on_scale_place_angle_or_sense() {
    let turn = Vec2::from_angle(1.1);
    for stroke in synthetic::strokes(100, HELD_OUT_SEED) {
        let first = verdict(&stroke.points);
        for scale in [0.1, 10.0] {
            let moved: Vec<Vec2> =
                stroke.points.iter().rev().map(|&p| turn.rotate(p) * scale + Vec2::new(50.0, 9.0)).collect();
            let change = (verdict(&moved).confidence - first.confidence).abs();
            assert!(change < 0.02, "{} at scale {scale}: confidence changes by {change}", stroke.family);
        }
    }
}

/// A person's strokes that are a blade or a branch; `neither` has no right answer.
#[test]
fn agreement_with_labels_of_peoples_strokes() {
    let strokes = real_strokes::load().unwrap();
    for (half, least) in [("development", 0.97), ("held_out", 0.95)] {
        let mut confusion = Confusion::default();
        let mut wrong = Vec::new();
        for stroke in strokes.iter().filter(|s| s.half == half && s.label != "neither") {
            let (is_blade, taken_for_blade) = (stroke.label == "blade", verdict(&stroke.points).blade);
            confusion.add(is_blade, taken_for_blade);
            wrong.extend((is_blade != taken_for_blade).then(|| format!("{} ({})", stroke.name, stroke.kind)));
        }
        assert!(confusion.right() + confusion.wrong() >= 100, "too few strokes in the {half} half");
        assert!(confusion.accuracy() >= least, "{half}\n{confusion}wrong: {wrong:?}");
    }
}
