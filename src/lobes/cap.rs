//! Ends of a lobe: a loop closed by an open stroke, or, where none was drawn, by a round cap.
//!
//! *Open stroke of k samples*: the loop is brought to 2k + 2 samples (or the stroke to half as many as the loop where that is
//! more). Two of them are anchors: those whose directions from the centroid fit the stroke's ends, extended outward, best
//! and are at least [`APART`] of the loop apart. Each of the two parts of the loop between them is joined to one side of the stroke.
//! *Round cap*: rings like the last one, ever smaller on a parabola that begins in the direction of the last strip and ends level,
//! half the ring's mean radius times how much the last strip narrows above it.
//!
//! Source: 001 §5.2.1, case 2 of fig. 5.4; round caps are missing there. Directions are compared in the plane of the loop, because
//! the ends of a stroke that arches over the loop point down at it.

use super::strip::{Loop, Sample, Side, densified, join};
use super::surface::Surface;
use crate::geom::principal_axes::principal_axes;
use glam::{Vec2, Vec3};

/// Least share of the loop between the two anchors.
const APART: f32 = 0.25;
/// Rings of a round cap, the one it stands on and the apex not counted.
const ROUND: usize = 5;

/// Closes a loop by an open stroke of at least two vertices. Faces lie to the left of the loop.
pub(super) fn cap(around: &Loop, stroke: &Loop, triangles: &mut Vec<[u32; 3]>) {
    let open = stroke.points.len();
    let count = around.points.len().max(2 * open + 2);
    let dense = densified(&around.points, true, count);
    let dense_stroke = densified(&stroke.points, false, open.max((count - 2).div_ceil(2)));
    let [from, to] = anchors(&dense, &stroke.points);
    let along = |k: usize| k as f32 / (dense_stroke.len() - 1) as f32;
    let places = dense_stroke.iter().enumerate().filter(|(_, s)| s.original.is_some());
    let there = Side { ids: stroke.ids.clone(), along: places.map(|(k, _)| along(k)).collect() };
    let back = Side {
        ids: there.ids.iter().rev().copied().collect(),
        along: there.along.iter().rev().map(|at| 1.0 - at).collect(),
    };
    join(&part(&dense, around, from, to), &there, true, triangles);
    join(&part(&dense, around, to, from), &back, true, triangles);
}

/// The originals of a loop from one of them to another.
fn part(dense: &[Sample], around: &Loop, from: usize, to: usize) -> Side {
    let count = dense.len();
    let span = (to + count - from) % count;
    let mut side = Side::default();
    for k in 0..=span {
        if let Some(original) = dense[(from + k) % count].original {
            side.ids.push(around.ids[original]);
            side.along.push(k as f32 / span as f32);
        }
    }
    side
}

/// The two originals among a loop's samples that the ends of an open stroke belong to.
fn anchors(dense: &[Sample], stroke: &[Vec3]) -> [usize; 2] {
    let points: Vec<Vec3> = dense.iter().map(|s| s.at).collect();
    let (middle, [x, y, _]) = principal_axes(&points);
    let flat = |d: Vec3| Vec2::new(d.dot(x), d.dot(y));
    let size = points.iter().map(|p| flat(p - middle).length()).fold(f32::MIN_POSITIVE, f32::max);
    let last = stroke.len() - 1;
    let ends = [(stroke[0], stroke[1.min(last)]), (stroke[last], stroke[last.saturating_sub(1)])];
    // Where the extension of an end leaves the loop, seen along its normal.
    let directions = ends.map(|(end, inner)| {
        let outward = flat(end - inner).normalize_or_zero();
        (flat(end - middle) + outward * size).normalize_or_zero()
    });
    let originals: Vec<usize> = (0..dense.len()).filter(|k| dense[*k].original.is_some()).collect();
    let fit = |k: usize, end: usize| flat(points[k] - middle).normalize_or_zero().dot(directions[end]);
    let count = originals.len();
    // With a vertex between the anchors on either side each part has room for its own faces.
    let apart = ((APART * count as f32).ceil() as usize).max(2).min(count / 2);
    let mut best = (f32::NEG_INFINITY, [originals[0], originals[count / 2]]);
    for i in 0..count {
        for j in (0..count).filter(|j| i.abs_diff(*j).min(count - i.abs_diff(*j)) >= apart) {
            let value = fit(originals[i], 0) + fit(originals[j], 1);
            if value > best.0 {
                best = (value, [originals[i], originals[j]]);
            }
        }
    }
    best.1
}

/// A round cap: how high it is along which unit direction, and how wide it would be at its height if it went on as it begins, as a
/// share of its loop.
#[derive(Clone, Copy, Debug)]
pub(super) struct Round {
    pub(super) way: Vec3,
    pub(super) height: f32,
    pub(super) shoulder: f32,
}

/// Closes a loop by a round cap with new vertices. Faces lie to the left of the loop.
pub(super) fn round_cap(around: &Loop, Round { way, height, shoulder }: Round, surface: &mut Surface) {
    let count = around.ids.len();
    let middle = around.points.iter().copied().sum::<Vec3>() / count as f32;
    let mut below = around.ids.clone();
    for k in 1..=ROUND {
        let t = k as f32 / (ROUND + 1) as f32;
        let rise = 1.0 - (1.0 - t) * (1.0 - t);
        let shrink = (1.0 - t) * (1.0 - t) + 2.0 * t * (1.0 - t) * shoulder;
        let lift = way * (height * rise);
        let first = surface.points.len() as u32;
        surface.points.extend(around.points.iter().map(|p| middle + (p - middle) * shrink + lift));
        let above: Vec<u32> = (first..first + count as u32).collect();
        for i in 0..count {
            let next = (i + 1) % count;
            surface.triangles.push([below[i], below[next], above[i]]);
            surface.triangles.push([below[next], above[next], above[i]]);
        }
        below = above;
    }
    let apex = surface.points.len() as u32;
    surface.points.push(middle + way * height);
    surface.triangles.extend((0..count).map(|i| [below[i], below[(i + 1) % count], apex]));
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::TAU;

    fn ring(count: usize) -> Loop {
        let at = |k: usize| {
            let (sin, cos) = (k as f32 / count as f32 * TAU).sin_cos();
            Vec3::new(2.0 * cos, 0.0, -sin)
        };
        Loop { ids: (0..count as u32).collect(), points: (0..count).map(at).collect() }
    }

    /// A loop closed on one side by an open stroke and on the other by a round cap.
    fn closed(count: usize, stroke: &[Vec3]) -> Surface {
        let around = ring(count);
        let mut surface = Surface { points: around.points.clone(), triangles: Vec::new() };
        let first = surface.points.len() as u32;
        surface.points.extend(stroke);
        let ids = (first..first + stroke.len() as u32).collect();
        cap(&around, &Loop { ids, points: stroke.to_vec() }, &mut surface.triangles);
        let round = Round { way: Vec3::NEG_Y, height: 0.5, shoulder: 1.0 };
        round_cap(&around.reversed(), round, &mut surface);
        surface
    }

    #[test]
    fn an_open_stroke_closes_a_loop_whatever_the_numbers() {
        for count in [6, 12, 13, 48, 96] {
            for k in [2, 3, 5, 20, 47] {
                let at = |i: usize| {
                    let t = i as f32 / (k - 1) as f32;
                    Vec3::new(3.0 * t - 1.5, 1.0 - (2.0 * t - 1.0).powi(2) * 0.8, 0.1 * t)
                };
                let surface = closed(count, &(0..k).map(at).collect::<Vec<_>>());
                assert_eq!(surface.check_invariants(), Ok(()), "{count} and {k}");
                assert!(surface.signed_volume() > 1.0, "{count} and {k}: {}", surface.signed_volume());
            }
        }
    }

    #[test]
    fn the_ends_of_the_stroke_belong_to_what_they_point_at() {
        let dense = densified(&ring(40).points, true, 40);
        let stroke = [Vec3::new(0.2, 0.5, -0.6), Vec3::Y, Vec3::new(-0.2, 0.5, 0.6)];
        let [from, to] = anchors(&dense, &stroke).map(|k| dense[k].at);
        assert!(from.z < -0.9 && to.z > 0.9, "{from} {to}");
    }

    #[test]
    fn a_round_cap_is_about_half_an_ellipsoid() {
        let surface = closed(96, &[Vec3::new(-1.0, 0.001, 0.0), Vec3::new(1.0, 0.001, 0.0)]);
        // Half of 4/3 π a b c.
        let expected = 2.0 / 3.0 * std::f64::consts::PI * 2.0 * 0.5;
        assert!((surface.signed_volume() / expected - 1.0).abs() < 0.15, "{}", surface.signed_volume());
    }
}
