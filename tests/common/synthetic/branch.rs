//! Skeletons of branches, stems, veins and tendrils.
//!
//! Smooth families are given by how the direction turns along a line of unit length; cornered ones by their corners.

use super::Family;
use glam::Vec2;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use std::f32::consts::{PI, TAU};

/// Every family, each with the same share of the branches.
pub(crate) const FAMILIES: &[Family] = &[
    ("straight", straight),
    ("C arc", arc),
    ("S curve", s_curve),
    ("hook", hook),
    ("wavy", wavy),
    ("zigzag", zigzag),
    ("gnarled", gnarled),
    ("tendril", tendril),
    ("spiral", spiral),
    ("doubling back", doubling_back),
    ("elbow", elbow),
    ("drooping", drooping),
];

const STEPS: usize = 240;
/// Smallest distance between the ends of a gnarled twig, as a share of its length.
const GNARLED_REACH: f32 = 0.45;
/// The same for a spiral; one that ends nearer to its beginning looks like the outline of a flower.
const SPIRAL_REACH: f32 = 0.2;

/// A line of unit length whose direction at the share s of its length is `heading(s)` (radians).
fn curve(heading: impl Fn(f32) -> f32) -> Vec<Vec2> {
    let mut at = Vec2::ZERO;
    let mut line = vec![at];
    for i in 0..STEPS {
        at += Vec2::from_angle(heading((i as f32 + 0.5) / STEPS as f32)) / STEPS as f32;
        line.push(at);
    }
    line
}

/// Draws curves of unit length until one ends at least `reach` from where it began.
fn reaching(reach: f32, rng: &mut Pcg64Mcg, shape: impl Fn(&mut Pcg64Mcg) -> Vec<Vec2>) -> Vec<Vec2> {
    loop {
        let line = shape(rng);
        if line[0].distance(line[STEPS]) >= reach {
            return line;
        }
    }
}

fn straight(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let bow = rng.random_range(0.0..0.5);
    curve(|s| bow * s)
}

fn arc(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let (turn, evenness) = (rng.random_range(0.4..3.5), rng.random_range(0.7..1.5));
    curve(|s| turn * s.powf(evenness))
}

fn s_curve(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let (first, second, change) =
        (rng.random_range(0.4..2.4), rng.random_range(0.4..2.4), rng.random_range(0.3..0.7));
    curve(|s: f32| first * (s / change).min(1.0) - second * ((s - change) / (1.0 - change)).max(0.0))
}

fn hook(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let (turn, reach) = (rng.random_range(1.4..3.4), rng.random_range(0.12..0.4));
    let bow = rng.random_range(-0.4..0.4);
    curve(|s: f32| bow * s + turn * ((s - 1.0 + reach) / reach).max(0.0))
}

fn wavy(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let (waves, sway, bow) =
        (rng.random_range(1.0..6.0), rng.random_range(0.3..1.2), rng.random_range(-0.6..0.6));
    curve(|s| bow * s + sway * (TAU * waves * s).sin())
}

fn zigzag(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let corners = rng.random_range(3..10);
    let swing = rng.random_range(0.3..1.0);
    let corner = |i: i32| {
        let side = if i % 2 == 0 { 1.0 } else { -1.0 };
        let at = i as f32 + rng.random_range(-0.25..0.25);
        Vec2::new(at, side * swing * rng.random_range(0.4..1.0))
    };
    (0..corners).map(corner).collect()
}

/// An old twig that keeps changing its mind, but gets away from where it began.
fn gnarled(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    reaching(GNARLED_REACH, rng, |rng| {
        let waves: Vec<(f32, f32, f32)> =
            (1..=5).map(|k| (k as f32, rng.random_range(0.0..1.6), rng.random_range(0.0..TAU))).collect();
        curve(|s| waves.iter().map(|&(k, sway, phase)| sway * (phase + TAU * k * s / 2.0).sin()).sum())
    })
}

fn tendril(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let (lead, turns, tightening) =
        (rng.random_range(0.25..0.6), rng.random_range(1.2..2.5), rng.random_range(1.0..1.8));
    let bow = rng.random_range(-0.5..0.5);
    curve(|s: f32| bow * s + TAU * turns * ((s - lead) / (1.0 - lead)).max(0.0).powf(tightening))
}

fn spiral(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    reaching(SPIRAL_REACH, rng, |rng| {
        let (turns, tightening) = (rng.random_range(1.3..3.0), rng.random_range(1.6..2.6));
        curve(|s| TAU * turns * s.powf(tightening))
    })
}

/// A stem whose last part is drawn back over itself.
fn doubling_back(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let bow = rng.random_range(0.0..1.5);
    let mut line = curve(|s| bow * s);
    let back = (line.len() as f32 * rng.random_range(0.03..0.2)) as usize;
    let sideways = Vec2::from_angle(bow + PI / 2.0) * rng.random_range(-0.02..0.02);
    let retraced: Vec<Vec2> = line.iter().rev().take(back).map(|&p| p + sideways).collect();
    line.extend(retraced);
    line
}

/// Two straight legs at an angle of at least 65°: a forked vein, the foot of a trunk.
fn elbow(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let angle = rng.random_range(65_f32..160.0).to_radians();
    vec![Vec2::X, Vec2::ZERO, Vec2::from_angle(angle) * rng.random_range(0.1..1.0)]
}

/// A stem that rises straight and hangs over at the end, as under a heavy flower.
fn drooping(rng: &mut Pcg64Mcg) -> Vec<Vec2> {
    let (turn, late) = (rng.random_range(1.0..2.9), rng.random_range(1.5..5.0));
    curve(|s| turn * s.powf(late))
}
