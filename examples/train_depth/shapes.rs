//! Areas that are no crowns, which the network learns to know: letters, stars, animals, boxes.

use crate::views::BYTES;
use anyhow::{Context as _, Result};
use glam::Vec2;
use penstemon::learned_depth::picture::{self, Frame, Line, Picture, SIDE};
use penstemon::random::{mix, unit};

/// Strokes of capital letters in a square of 4 by 6, y down.
const LETTERS: [&[&[(f32, f32)]]; 16] = [
    &[&[(0., 6.), (2., 0.), (4., 6.)], &[(1., 4.), (3., 4.)]],
    &[&[(4., 1.), (2., 0.), (0., 2.), (0., 4.), (2., 6.), (4., 5.)]],
    &[&[(4., 0.), (0., 0.), (0., 6.), (4., 6.)], &[(0., 3.), (3., 3.)]],
    &[&[(4., 0.), (0., 0.), (0., 6.)], &[(0., 3.), (3., 3.)]],
    &[&[(0., 0.), (0., 6.)], &[(4., 0.), (4., 6.)], &[(0., 3.), (4., 3.)]],
    &[&[(0., 0.), (0., 6.)], &[(4., 0.), (0., 3.), (4., 6.)]],
    &[&[(0., 0.), (0., 6.), (4., 6.)]],
    &[&[(0., 6.), (0., 0.), (2., 3.), (4., 0.), (4., 6.)]],
    &[&[(0., 6.), (0., 0.), (4., 6.), (4., 0.)]],
    &[&[(2., 0.), (0., 2.), (0., 4.), (2., 6.), (4., 4.), (4., 2.), (2., 0.)]],
    &[&[(0., 6.), (0., 0.), (3., 0.), (4., 1.5), (3., 3.), (0., 3.)]],
    &[&[(4., 1.), (2., 0.), (0., 1.5), (4., 4.5), (2., 6.), (0., 5.)]],
    &[&[(0., 0.), (4., 0.)], &[(2., 0.), (2., 6.)]],
    &[&[(0., 0.), (0., 4.), (2., 6.), (4., 4.), (4., 0.)]],
    &[&[(0., 0.), (2., 6.), (4., 0.)]],
    &[&[(0., 0.), (4., 6.)], &[(4., 0.), (0., 6.)]],
];

/// A thick line: its ends and half its width.
pub(crate) type Bar = (Vec2, Vec2, f32);

/// The bytes of the picture of such an area; its depth is unknown.
pub(crate) fn bytes(seed: u64) -> Result<Vec<u8>> {
    let mut state = seed;
    let mut lot = |low: f32, high: f32| {
        state = mix(state, 1);
        low + (high - low) * unit(state)
    };
    let kind = lot(0.0, 5.0) as usize;
    let area = match kind {
        0 | 1 => of_bars(&letter(&mut lot)),
        2 => of_bars(&animal(&mut lot)),
        3 => star(&mut lot),
        _ => boxed(&mut lot),
    };
    let frame = Frame::around(Vec2::ZERO, [Vec2::new(0.0, -1.0)].into_iter()).context("an extent of 1")?;
    let stem = Line { points: vec![Vec2::ZERO, Vec2::new(lot(-0.1, 0.1), -lot(0.3, 0.7))], is_trunk: true };
    let wood = if lot(0.0, 1.0) < 0.5 { vec![stem] } else { Vec::new() };
    let picture = Picture::new(&area, &frame, &wood);
    let mut row = vec![0; BYTES];
    for (i, v) in picture.channels()[..5 * SIDE * SIDE].iter().enumerate() {
        row[i] =
            if i < 3 * SIDE * SIDE { (v * 255.0).round() as u8 } else { (v * 127.0).round() as i8 as u8 };
    }
    Ok(row)
}

pub(crate) fn letter(lot: &mut impl FnMut(f32, f32) -> f32) -> Vec<Bar> {
    let strokes = LETTERS[lot(0.0, LETTERS.len() as f32) as usize];
    let (width, height) = (lot(0.06, 0.15), lot(0.07, 0.13));
    let (left, top, half) = (0.5 - 2.0 * width, lot(0.05, 0.15), lot(0.02, 0.07));
    let place = |(x, y): (f32, f32)| Vec2::new(left + x * width, top + y * height);
    strokes.iter().flat_map(|s| s.windows(2)).map(|w| (place(w[0]), place(w[1]), half)).collect()
}

/// A body with a head, legs and a tail.
pub(crate) fn animal(lot: &mut impl FnMut(f32, f32) -> f32) -> Vec<Bar> {
    let (y, half, long) = (lot(0.35, 0.55), lot(0.08, 0.16), lot(0.12, 0.25));
    let (a, b) = (Vec2::new(0.5 - long, y), Vec2::new(0.5 + long, y));
    let head = b + Vec2::new(lot(0.02, 0.1), -lot(0.1, 0.28));
    let mut bars =
        vec![(a, b, half), (b, head, 0.6 * half), (head, head + Vec2::X * lot(0.0, 0.08), lot(0.05, 0.1))];
    bars.push((a, a + Vec2::new(-lot(0.05, 0.15), lot(-0.2, 0.2)), lot(0.015, 0.04)));
    for x in [0.0, 0.2, 0.8, 1.0] {
        let hip = a.lerp(b, x) + Vec2::Y * 0.5 * half;
        bars.push((hip, hip.with_y(0.92) + Vec2::X * lot(-0.04, 0.04), lot(0.02, 0.045)));
    }
    bars
}

pub(crate) fn of_bars(bars: &[Bar]) -> Box<[bool; SIDE * SIDE]> {
    let mut area = Box::new([false; SIDE * SIDE]);
    for &(a, b, half) in bars {
        let cells = SIDE as f32;
        picture::for_cells_near((a * cells, b * cells), half * cells, SIDE, |i| area[i] = true);
    }
    area
}

pub(crate) fn star(lot: &mut impl FnMut(f32, f32) -> f32) -> Box<[bool; SIDE * SIDE]> {
    let (points, sharp, radius, turn) =
        (lot(3.0, 8.99).floor(), lot(0.35, 0.75), lot(0.25, 0.45), lot(0.0, 1.0));
    let middle = Vec2::new(0.5, lot(0.4, 0.5));
    let inside = |i: usize| {
        let p = picture::middle(i) - middle;
        let around = (p.y.atan2(p.x) / std::f32::consts::TAU * points + turn).rem_euclid(1.0);
        p.length() < radius * (1.0 - sharp * 2.0 * (around - 0.5).abs())
    };
    Box::new(std::array::from_fn(inside))
}

pub(crate) fn boxed(lot: &mut impl FnMut(f32, f32) -> f32) -> Box<[bool; SIDE * SIDE]> {
    let (half, turn) = (Vec2::new(lot(0.1, 0.4), lot(0.1, 0.4)), Vec2::from_angle(lot(-0.6, 0.6)));
    let hole = if lot(0.0, 1.0) < 0.4 { lot(0.3, 0.7) } else { 0.0 };
    let inside = |i: usize| {
        let p = (turn.rotate(picture::middle(i) - Vec2::new(0.5, 0.48)) / half).abs();
        p.max_element() < 1.0 && p.max_element() >= hole
    };
    Box::new(std::array::from_fn(inside))
}
