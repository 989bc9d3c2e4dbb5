//! Areas that are no crowns, to judge whether the network recognises them: those that it was trained on, now on trunks with limbs too, and
//! others that it has never seen, as hedges are cut to and as people draw.

use crate::shapes::{self, Bar};
use anyhow::{Context as _, Result};
use glam::Vec2;
use penstemon::learned_depth::picture::{self, Frame, Line, Picture, SIDE};
use penstemon::random::{mix, unit};
use std::f32::consts::TAU;

/// Kinds of shapes; the first four were trained on, without limbs.
pub(crate) const KINDS: [&str; 9] =
    ["letter", "animal", "star", "box", "rabbit", "lobed", "heart", "hand", "fish"];

type Area = Box<[bool; SIDE * SIDE]>;

/// The picture of a shape, on a trunk, on a trunk with limbs, or on nothing.
pub(crate) fn picture_of(kind: &str, seed: u64) -> Result<Picture> {
    let mut state = seed;
    let mut lot = |low: f32, high: f32| {
        state = mix(state, 1);
        low + (high - low) * unit(state)
    };
    let area = match kind {
        "letter" => shapes::of_bars(&shapes::letter(&mut lot)),
        "animal" => shapes::of_bars(&shapes::animal(&mut lot)),
        "star" => shapes::star(&mut lot),
        "box" => shapes::boxed(&mut lot),
        "rabbit" => shapes::of_bars(&rabbit(&mut lot)),
        "lobed" => lobed(&mut lot),
        "heart" => heart(&mut lot),
        "hand" => shapes::of_bars(&hand(&mut lot)),
        _ => shapes::of_bars(&fish(&mut lot)),
    };
    let frame = Frame::around(Vec2::ZERO, [Vec2::new(0.0, -1.0)].into_iter()).context("an extent of 1")?;
    Ok(Picture::new(&area, &frame, &wood(&mut lot)))
}

/// Nothing, a trunk, or a trunk with up to four limbs; in the frame's unit, the foot at the origin.
fn wood(lot: &mut impl FnMut(f32, f32) -> f32) -> Vec<Line> {
    let limbs = lot(-2.0, 5.0);
    if limbs < -1.0 {
        return Vec::new();
    }
    let (top, lean) = (lot(0.3, 0.8), lot(-0.1, 0.1));
    let mut lines = Vec::new();
    for k in 0..limbs.max(0.0) as usize {
        let from = Vec2::new(lean, -top) * lot(0.4, 0.9);
        let side = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        let to = from + Vec2::new(side * lot(0.1, 0.35), -lot(0.05, 0.3));
        lines.push(Line { points: vec![from, to], is_trunk: false });
    }
    lines.push(Line { points: vec![Vec2::ZERO, Vec2::new(lean, -top)], is_trunk: true });
    lines
}

/// A sitting animal: body, head, two ears, a tail.
fn rabbit(lot: &mut impl FnMut(f32, f32) -> f32) -> Vec<Bar> {
    let (x, y, half) = (lot(0.42, 0.58), lot(0.6, 0.72), lot(0.13, 0.2));
    let (body, side) = (Vec2::new(x, y), if lot(0.0, 1.0) < 0.5 { 1.0 } else { -1.0 });
    let head = body + Vec2::new(side * lot(0.0, 0.12), -half - lot(0.05, 0.12));
    let mut bars = vec![
        (body, body - Vec2::Y * lot(0.0, 0.1), half),
        (head, head + Vec2::X * side * lot(0.0, 0.06), lot(0.07, 0.11)),
    ];
    for _ in 0..2 {
        let root = head + Vec2::new(lot(-0.06, 0.06), -0.06);
        bars.push((root, root + Vec2::new(lot(-0.1, 0.1), -lot(0.12, 0.28)), lot(0.02, 0.045)));
    }
    let tail = body - Vec2::new(side * half, lot(-0.06, 0.04));
    bars.push((tail, tail, lot(0.03, 0.06)));
    bars
}

/// A flower of round lobes, or a cogwheel.
fn lobed(lot: &mut impl FnMut(f32, f32) -> f32) -> Area {
    let (lobes, deep, radius, turn) = (lot(3.0, 7.99).floor(), lot(0.2, 0.5), lot(0.2, 0.36), lot(0.0, TAU));
    let (middle, wide) = (Vec2::new(0.5, lot(0.38, 0.5)), lot(0.8, 1.25));
    let inside = |i: usize| {
        let p = (picture::middle(i) - middle) / Vec2::new(wide, 1.0);
        p.length() < radius * (1.0 + deep * (lobes * p.y.atan2(p.x) + turn).sin())
    };
    Box::new(std::array::from_fn(inside))
}

fn heart(lot: &mut impl FnMut(f32, f32) -> f32) -> Area {
    let (middle, size) = (Vec2::new(0.5, lot(0.35, 0.5)), Vec2::new(lot(0.2, 0.34), lot(0.2, 0.34)));
    let inside = |i: usize| {
        let p = (picture::middle(i) - middle) / size;
        let (x, y) = (p.x, -p.y + 0.15);
        (x * x + y * y - 0.75).powi(3) < x * x * y.powi(3)
    };
    Box::new(std::array::from_fn(inside))
}

/// A palm with five fingers.
fn hand(lot: &mut impl FnMut(f32, f32) -> f32) -> Vec<Bar> {
    let palm = Vec2::new(0.5, lot(0.5, 0.65));
    let mut bars = vec![(palm, palm + Vec2::Y * 0.1, lot(0.1, 0.15))];
    for k in 0..5 {
        let way = Vec2::from_angle(-TAU / 4.0 + 0.42 * (k as f32 - 2.0) + lot(-0.08, 0.08));
        bars.push((palm, palm + way * lot(0.25, 0.4), lot(0.025, 0.045)));
    }
    bars
}

/// A body that tapers to a forked tail.
fn fish(lot: &mut impl FnMut(f32, f32) -> f32) -> Vec<Bar> {
    let (y, long, half) = (lot(0.35, 0.55), lot(0.22, 0.32), lot(0.09, 0.15));
    let nose = Vec2::new(0.5 - long, y);
    let mut bars: Vec<Bar> = (0..12)
        .map(|k| {
            let share = k as f32 / 11.0;
            let at = nose + Vec2::X * (2.0 * long * share);
            (at, at, half * (share * TAU / 2.0).sin().max(0.15))
        })
        .collect();
    let tail = nose + Vec2::X * 2.0 * long;
    for side in [-1.0, 1.0] {
        bars.push((tail, tail + Vec2::new(0.1, side * lot(0.08, 0.15)), 0.02));
    }
    bars
}
