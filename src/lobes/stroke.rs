//! Strokes made ready: closed, smooth, evenly sampled.
//!
//! A stroke whose ends are less than [`GAP`] of its length apart is a loop (001 §5.2.1: "a given threshold"). The gap is
//! closed by bringing both ends to their middle, less and less along the stroke. Samples are set evenly by arc length and
//! smoothed by a Gaussian of [`SIGMA`] samples; a loop that crosses itself, seen along the direction in which it is thinnest,
//! keeps its larger loop.
//!
//! The longest stroke of a lobe has [`MOST`] samples, shorter ones fewer by their length, so that faces are about as
//! wide as they are long everywhere; joining strokes of unlike numbers is what [`strip`](super::strip) is for.

use super::lobe::SpaceStroke;
use crate::geom::polyline::{arc_lengths, interpolate, length, locate};
use crate::geom::principal_axes::principal_axes;
use crate::geom::simple_loop::{is_simple, make_simple};
use glam::{Vec2, Vec3};

/// Share of its length that the ends of a loop may be apart.
pub(super) const GAP: f32 = 0.12;
/// Samples of the longest stroke of a lobe.
pub(super) const MOST: usize = 96;
/// Fewest samples of a loop and of an open stroke.
pub(super) const FEWEST: (usize, usize) = (12, 4);
/// Most samples of an open stroke.
const MOST_OPEN: usize = 47;
/// Width of the Gaussian that takes the hand's tremble away, samples.
const SIGMA: f32 = 2.0;
/// Share of a loop, from each end, along which its gap is closed.
const CLOSING: f32 = 0.2;
/// A gap of so many usual distances of samples is an edge of the loop like any other.
const EDGE: f32 = 2.0;

/// A stroke that is ready to be joined to others.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Line {
    /// Whether its last sample is followed by its first.
    pub(super) closed: bool,
    /// Evenly spaced samples.
    pub(super) points: Vec<Vec3>,
}

impl Line {
    /// Mean of its samples.
    pub(super) fn centroid(&self) -> Vec3 {
        self.points.iter().copied().sum::<Vec3>() / self.points.len().max(1) as f32
    }

    /// Mean distance of its samples from their centroid.
    pub(super) fn radius(&self) -> f32 {
        let centroid = self.centroid();
        self.points.iter().map(|p| p.distance(centroid)).sum::<f32>() / self.points.len().max(1) as f32
    }

    /// Unit normal of a loop: its area as a vector; zero for loops without any.
    pub(super) fn normal(&self) -> Vec3 {
        let centroid = self.centroid();
        let next = self.points.iter().cycle().skip(1);
        let area = self.points.iter().zip(next).map(|(a, b)| (a - centroid).cross(b - centroid));
        area.sum::<Vec3>().normalize_or_zero()
    }

    /// The same with so many samples.
    pub(super) fn resampled(&self, count: usize) -> Self {
        Self { closed: self.closed, points: resample(&self.points, self.closed, count) }
    }
}

/// A stroke made ready, not yet at its final number of samples.
#[derive(Clone, Debug)]
pub(super) struct Smooth {
    /// The line, with [`MOST`] samples.
    pub(super) line: Line,
    /// Its length, metres.
    pub(super) length: f32,
    /// Whether a part of it was cut off, because it crossed itself.
    pub(super) was_cut: bool,
}

/// A stroke as a smooth line; `None` for one that has no length.
pub(super) fn smooth(stroke: &SpaceStroke) -> Option<Smooth> {
    let mut points = stroke.points.clone();
    points.dedup();
    let open_length = length(&points);
    if points.len() < 2 || !(open_length > 0.0 && open_length.is_finite()) {
        return None;
    }
    let gap = points[0].distance(*points.last()?);
    let closed = stroke.closed.unwrap_or(gap < GAP * open_length) && points.len() > 2;
    let mut was_cut = false;
    if closed {
        if gap == 0.0 {
            points.pop();
        } else if gap > EDGE * open_length / points.len() as f32 && stroke.closed.is_none() {
            points = close(&points);
        }
        (points, was_cut) = cut(points);
        if points.len() < 3 {
            return None;
        }
    }
    let points = even_out(&resample(&points, closed, MOST), closed);
    let line = Line { closed, points };
    let length = perimeter(&line);
    (length > 0.0).then_some(Smooth { line, length, was_cut })
}

/// Strokes of one lobe with as many samples as their lengths, against the longest, ask for.
pub(super) fn matched(lines: &[Smooth]) -> Vec<Line> {
    let longest = lines.iter().map(|line| line.length).fold(0.0, f32::max);
    let count = |line: &Smooth| {
        let wanted = (MOST as f32 * line.length / longest).round() as usize;
        if line.line.closed { wanted.clamp(FEWEST.0, MOST) } else { wanted.clamp(FEWEST.1, MOST_OPEN) }
    };
    lines.iter().map(|line| line.line.resampled(count(line))).collect()
}

fn perimeter(line: &Line) -> f32 {
    let closing = if line.closed { line.points[0].distance(line.points[line.points.len() - 1]) } else { 0.0 };
    length(&line.points) + closing
}

/// A loop without the gap between its ends: each is brought to the middle of both, what lies behind it less and less.
fn close(points: &[Vec3]) -> Vec<Vec3> {
    let arcs = arc_lengths(points.iter().copied());
    let (first, last) = (points[0], points[points.len() - 1]);
    let (half, whole) = ((last - first) * 0.5, arcs[arcs.len() - 1]);
    let fade = |arc: f32| {
        let share = (1.0 - arc / (CLOSING * whole)).clamp(0.0, 1.0);
        share * share * (3.0 - 2.0 * share)
    };
    let moved = points.iter().zip(&arcs).map(|(p, arc)| p + half * (fade(*arc) - fade(whole - arc)));
    let mut moved: Vec<Vec3> = moved.collect();
    moved.pop();
    moved
}

/// A loop without crossings as it is seen along its thinnest direction, and whether something was cut off.
fn cut(points: Vec<Vec3>) -> (Vec<Vec3>, bool) {
    let (middle, [x, y, _]) = principal_axes(&points);
    let flat = |p: &Vec3| Vec2::new((p - middle).dot(x), (p - middle).dot(y));
    let seen: Vec<Vec2> = points.iter().map(flat).collect();
    if is_simple(&seen) {
        return (points, false);
    }
    (make_simple(points, flat, |a, b, t| a.lerp(*b, t)), true)
}

/// Samples at even distances along a stroke; both ends of an open one stay.
fn resample(points: &[Vec3], closed: bool, count: usize) -> Vec<Vec3> {
    let around: Vec<Vec3> = points.iter().chain(closed.then_some(&points[0])).copied().collect();
    let arcs = arc_lengths(around.iter().copied());
    let whole = arcs[arcs.len() - 1];
    let steps = if closed { count } else { count - 1 };
    let at = |k: usize| interpolate(&around, locate(&arcs, whole * k as f32 / steps as f32));
    (0..count).map(at).collect()
}

/// Smooths samples by a Gaussian; both ends of an open stroke stay.
fn even_out(points: &[Vec3], closed: bool) -> Vec<Vec3> {
    let reach = (3.0 * SIGMA).ceil() as isize;
    let count = points.len() as isize;
    let at = |k: isize| -> Vec3 {
        if closed {
            return points[k.rem_euclid(count) as usize];
        }
        // Beyond its ends an open stroke goes on as its mirror image through them.
        let end = count - 1;
        match k {
            k if k < 0 => 2.0 * points[0] - points[(-k).min(end) as usize],
            k if k > end => 2.0 * points[end as usize] - points[(2 * end - k).max(0) as usize],
            k => points[k as usize],
        }
    };
    let weight = |d: isize| (-0.5 * (d as f32 / SIGMA).powi(2)).exp();
    let total: f32 = (-reach..=reach).map(weight).sum();
    (0..count).map(|k| (-reach..=reach).map(|d| at(k + d) * weight(d)).sum::<Vec3>() / total).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::TAU;

    fn arc(share: f32, count: usize) -> Vec<Vec3> {
        let at = |k: usize| {
            let (sin, cos) = (share * TAU * k as f32 / (count - 1) as f32).sin_cos();
            Vec3::new(cos, 1.0, sin)
        };
        (0..count).map(at).collect()
    }

    fn drawn(points: Vec<Vec3>) -> SpaceStroke {
        SpaceStroke { closed: None, points }
    }

    #[test]
    fn a_small_gap_is_closed_and_a_large_one_is_not() {
        let closed = smooth(&drawn(arc(0.93, 80))).unwrap().line;
        assert!(closed.closed);
        let steps: Vec<f32> =
            (0..MOST).map(|k| closed.points[k].distance(closed.points[(k + 1) % MOST])).collect();
        let mean = steps.iter().sum::<f32>() / MOST as f32;
        assert!(steps.iter().all(|s| (s / mean - 1.0).abs() < 0.05), "{steps:?}");
        assert!(!smooth(&drawn(arc(0.85, 80))).unwrap().line.closed);
        let said = SpaceStroke { closed: Some(true), points: arc(0.5, 9) };
        assert!(smooth(&said).unwrap().line.closed, "what is said counts");
    }

    #[test]
    fn a_circle_stays_a_circle_and_an_open_stroke_keeps_its_ends() {
        let circle = smooth(&drawn(arc(1.0, 200))).unwrap().line;
        for p in &circle.points {
            assert!((p.with_y(0.0).length() - 1.0).abs() < 0.01, "{p}");
        }
        let open = smooth(&drawn(arc(0.5, 60))).unwrap().line;
        assert!(open.points[0].distance(Vec3::new(1.0, 1.0, 0.0)) < 1e-5);
        assert!(open.points[MOST - 1].distance(Vec3::new(-1.0, 1.0, 0.0)) < 1e-5);
    }

    #[test]
    fn a_figure_eight_keeps_its_larger_loop() {
        let eight = (0..120).map(|k| {
            let t = k as f32 / 120.0 * TAU;
            Vec3::new((2.0 * t).sin() * 0.5, 2.0, t.cos() * if t.cos() > 0.0 { 2.0 } else { 1.0 })
        });
        let made = smooth(&drawn(eight.collect())).unwrap();
        assert!(made.was_cut && made.line.closed);
        assert!(made.line.points.iter().all(|p| p.z > -0.1), "the smaller loop is gone");
    }

    #[test]
    fn a_spot_is_no_stroke_and_three_samples_are_a_loop() {
        assert!(smooth(&drawn(vec![Vec3::ONE; 5])).is_none());
        assert!(smooth(&drawn(vec![Vec3::ONE])).is_none() && smooth(&drawn(vec![])).is_none());
        let three = SpaceStroke { closed: Some(true), points: vec![Vec3::ZERO, Vec3::X, Vec3::Z] };
        let line = smooth(&three).unwrap().line;
        assert!(line.closed && line.points.len() == MOST);
    }

    #[test]
    fn shorter_strokes_have_fewer_samples() {
        let small: Vec<Vec3> = arc(1.0, 50).iter().map(|p| p * 0.3).collect();
        let lines: Vec<Smooth> =
            [arc(1.0, 50), small, arc(0.25, 50)].map(|points| smooth(&drawn(points)).unwrap()).to_vec();
        let counts: Vec<usize> = matched(&lines).iter().map(|line| line.points.len()).collect();
        assert_eq!(counts, [96, 29, 24]);
    }
}
