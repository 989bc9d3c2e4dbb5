//! A drawing as another hand might have drawn it: mirrored, turned, stretched, slanted and bent a little.

use glam::{Mat2, Vec2};
use penstemon::geom::polyline;
use penstemon::random::stream;
use rand::RngExt;
use std::f32::consts::TAU;

/// Largest turn either way, radians.
const TURN: f32 = 0.12;
/// Widths and heights, as shares of those drawn.
const STRETCH: (f32, f32) = (0.8, 1.2);
/// Largest slant.
const SLANT: f32 = 0.1;
/// How far lines are bent aside, as a share of the drawing's size, and how many bends it has.
const BEND: (f32, f32, f32) = (0.04, 1.0, 2.5);

/// The lines in a hand of this number.
pub(super) fn drawn_again(lines: &[Vec<Vec2>], hand: u64) -> Vec<Vec<Vec2>> {
    let mut rng = stream(0, "hands", hand);
    let mut within = |low: f32, high: f32| rng.random_range(low..high);
    let (low, high) = polyline::bounds(lines.iter().flatten().copied());
    let (middle, size) = (low.midpoint(high), (high - low).max_element());
    let mirrored = if within(0.0, 1.0) < 0.5 { -1.0 } else { 1.0 };
    let turned = Mat2::from_angle(within(-TURN, TURN));
    let wide = mirrored * within(STRETCH.0, STRETCH.1);
    let stretched =
        Mat2::from_cols(Vec2::new(wide, 0.0), Vec2::new(within(-SLANT, SLANT), within(STRETCH.0, STRETCH.1)));
    let bends: Vec<[f32; 3]> =
        (0..4).map(|_| [within(-BEND.0, BEND.0), TAU * within(BEND.1, BEND.2), within(0.0, TAU)]).collect();
    let bent = |p: Vec2| {
        let wave = |k: usize, along: f32| bends[k][0] * (bends[k][1] * along + bends[k][2]).sin();
        p + Vec2::new(wave(0, p.y) + wave(1, p.x), wave(2, p.x) + wave(3, p.y))
    };
    let again = |p: &Vec2| bent(turned * stretched * ((p - middle) / size));
    lines.iter().map(|line| line.iter().map(again).collect()).collect()
}
