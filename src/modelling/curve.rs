//! The smooth line of a branch drawn in space: sparse samples of the hand, and a curve through them (001 §4.2).
//!
//! The stroke is sampled anew at even lengths; every fourth of these samples is a knot, and centripetal Catmull-Rom pieces
//! (cubic Hermite pieces with the tangents of the centripetal parametrisation) lead through the knots, which neither loop nor
//! overshoot between knots at uneven distances. The thesis names "sparse samples, then cubic Hermite" without numbers. Where
//! the curve leaves the hand by more than [`DEVIATION`], knots are set twice as densely, and then at every sample: corners that
//! were drawn stay.

use crate::geom::polyline;
use glam::{Vec3, Vec4};

/// Distance of the samples, as a share of the stroke's length.
const SPACING: f32 = 0.015;

/// Samples from knot to knot, in the order in which they are tried.
const STRIDES: [usize; 3] = [4, 2, 1];

/// Farthest that the curve may lie from what was drawn, as a share of its length.
const DEVIATION: f32 = 0.006;

/// A place of a stroke in space and what the pen pressed there, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SpaceSample {
    pub(super) position: Vec3,
    pub(super) pressure: f32,
}

impl SpaceSample {
    fn to_row(self) -> Vec4 {
        self.position.extend(self.pressure)
    }

    fn from_row(row: Vec4) -> Self {
        Self { position: row.truncate(), pressure: row.w.clamp(0.0, 1.0) }
    }
}

/// The smooth line through a stroke: from its first to its last sample, at even distances. A stroke that goes nowhere gives
/// nothing.
pub(super) fn smoothed(raw: &[SpaceSample]) -> Vec<SpaceSample> {
    let even = evenly(raw);
    let length = polyline::length(&even.iter().map(|row| row.truncate()).collect::<Vec<_>>());
    let is_near = |line: &[Vec4]| {
        let away = |(a, b): (&Vec4, &Vec4)| a.truncate().distance(b.truncate());
        line.iter().zip(&even).map(away).all(|away| away <= DEVIATION * length)
    };
    let curves = STRIDES.iter().map(|stride| through_knots(&even, *stride));
    let chosen = curves.into_iter().find(|line| is_near(line)).unwrap_or_default();
    chosen.into_iter().map(SpaceSample::from_row).collect()
}

/// The stroke at even distances along its length, place and pressure together; empty for one without length.
fn evenly(raw: &[SpaceSample]) -> Vec<Vec4> {
    let arcs = polyline::arc_lengths(raw.iter().map(|sample| sample.position));
    let length = arcs.last().copied().unwrap_or(0.0);
    if !(length > 0.0 && length.is_finite()) {
        return Vec::new();
    }
    let pieces = (1.0 / SPACING).round() as usize;
    let at = |k: usize| {
        let (i, share) = polyline::locate(&arcs, length * k as f32 / pieces as f32);
        let next = raw.get(i + 1).unwrap_or(&raw[i]);
        raw[i].to_row().lerp(next.to_row(), share)
    };
    (0..=pieces).map(at).collect()
}

/// As many places on the curve through every `stride`-th sample, and the last.
fn through_knots(even: &[Vec4], stride: usize) -> Vec<Vec4> {
    let Some((last, _)) = even.split_last() else { return Vec::new() };
    let mut knots: Vec<Vec4> = even.iter().copied().step_by(stride).collect();
    let whole = (even.len() - 1) / stride * stride;
    if whole + 1 < even.len() {
        knots.push(*last);
    }
    let place = |i: usize| {
        let piece = (i / stride).min(knots.len().saturating_sub(2));
        let begin = piece * stride;
        let end = (begin + stride).min(even.len() - 1);
        centripetal(&knots, piece, (i - begin) as f32 / (end - begin).max(1) as f32)
    };
    (0..even.len()).map(place).collect()
}

/// A place on the piece of the curve from knot `i` to the next, `share` of the way.
fn centripetal(knots: &[Vec4], i: usize, share: f32) -> Vec4 {
    let (Some(&b), Some(&c)) = (knots.get(i), knots.get(i + 1)) else {
        return knots.get(i).copied().unwrap_or_default();
    };
    // Beyond its ends the curve goes on as if mirrored there.
    let a = if i > 0 { knots[i - 1] } else { b * 2.0 - c };
    let d = knots.get(i + 2).copied().unwrap_or(c * 2.0 - b);
    let step = |from: Vec4, to: Vec4| from.truncate().distance(to.truncate()).sqrt();
    let (before, here, after) = (step(a, b), step(b, c), step(c, d));
    if before * here * after == 0.0 {
        return b.lerp(c, share);
    }
    let slope = |p: Vec4, q: Vec4, r: Vec4, first: f32, second: f32| {
        (q - p) / first - (r - p) / (first + second) + (r - q) / second
    };
    let (at_b, at_c) = (slope(a, b, c, before, here) * here, slope(b, c, d, here, after) * here);
    let (t, t2, t3) = (share, share * share, share * share * share);
    b * (2.0 * t3 - 3.0 * t2 + 1.0)
        + at_b * (t3 - 2.0 * t2 + t)
        + c * (3.0 * t2 - 2.0 * t3)
        + at_c * (t3 - t2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(places: impl IntoIterator<Item = Vec3>) -> Vec<SpaceSample> {
        places.into_iter().map(|position| SpaceSample { position, pressure: 0.5 }).collect()
    }

    fn turn(line: &[SpaceSample]) -> f32 {
        let way = |pair: &[SpaceSample]| pair[1].position - pair[0].position;
        let ways: Vec<Vec3> = line.windows(2).map(way).collect();
        ways.windows(2).map(|pair| pair[0].angle_between(pair[1]).to_degrees()).fold(0.0, f32::max)
    }

    #[test]
    fn a_hand_that_trembles_gives_a_smooth_line_near_to_it() {
        // A helix of one turn, trembling by 0.2 % of its length.
        let at = |k: u16| {
            let x = f32::from(k) / 300.0;
            let tremble = Vec3::new((x * 611.0).sin(), (x * 433.0).sin(), (x * 557.0).sin()) * 0.002;
            Vec3::new((6.0 * x).cos() * 0.1, x, (6.0 * x).sin() * 0.1) + tremble
        };
        let raw = samples((0..=300).map(at));
        let line = smoothed(&raw);
        assert_eq!((line[0], line[line.len() - 1]), (raw[0], raw[300]));
        let length = polyline::length(&line.iter().map(|s| s.position).collect::<Vec<_>>());
        for sample in &line {
            let away = raw.windows(2).map(|pair| {
                let (a, b) = (pair[0].position, pair[1].position);
                let share = polyline::nearest_share(a, b, sample.position, Vec3::dot);
                a.lerp(b, share).distance(sample.position)
            });
            assert!(away.fold(f32::INFINITY, f32::min) <= 0.006 * length);
        }
        assert!(turn(&line) <= 35.0, "{}", turn(&line));
    }

    #[test]
    fn corners_that_were_drawn_stay() {
        let raw = samples([Vec3::ZERO, Vec3::Y, Vec3::Y + Vec3::Z]);
        let line = smoothed(&raw);
        let nearest = line.iter().map(|s| s.position.distance(Vec3::Y)).fold(f32::INFINITY, f32::min);
        assert!(nearest <= 0.02, "{nearest}");
    }

    #[test]
    fn strokes_that_go_nowhere_give_nothing() {
        for raw in [vec![], samples([Vec3::ONE]), samples([Vec3::ONE; 5])] {
            assert_eq!(smoothed(&raw), []);
        }
    }
}
