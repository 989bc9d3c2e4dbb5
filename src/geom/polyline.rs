//! Arc length on open polylines.
//!
//! Points are any consecutive positions; repeated ones are allowed and have length zero between them.

use glam::{Vec2, Vec3};
use std::ops::{Add, Mul, Sub};

/// What a polyline's points must offer: positions with a distance and a blend.
pub trait Point: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<f32, Output = Self> {
    /// Euclidean length.
    fn norm(self) -> f32;
    /// Scalar product.
    fn dot(self, other: Self) -> f32;
}

impl Point for Vec2 {
    fn norm(self) -> f32 {
        self.length()
    }

    fn dot(self, other: Self) -> f32 {
        Self::dot(self, other)
    }
}

impl Point for Vec3 {
    fn norm(self) -> f32 {
        self.length()
    }

    fn dot(self, other: Self) -> f32 {
        Self::dot(self, other)
    }
}

/// Length of the polyline.
pub fn length<P: Point>(points: &[P]) -> f32 {
    points.windows(2).map(|w| (w[1] - w[0]).norm()).sum()
}

/// Smallest and largest corner of some points; of none the smallest is infinitely large.
pub fn bounds(points: impl Iterator<Item = Vec2>) -> (Vec2, Vec2) {
    points.fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
}

/// Arc length from the first point to every point; as long as the input, starting with 0.
pub fn arc_lengths<P: Point>(points: impl Iterator<Item = P>) -> Vec<f32> {
    let mut total = 0.0;
    let mut last: Option<P> = None;
    points
        .map(|p| {
            total += last.map_or(0.0, |q| (p - q).norm());
            last = Some(p);
            total
        })
        .collect()
}

/// Index of the segment that holds `arc` and the share of that segment before it; ends are clamped.
pub fn locate(arcs: &[f32], arc: f32) -> (usize, f32) {
    let segments = arcs.len().saturating_sub(1);
    if segments == 0 {
        return (0, 0.0);
    }
    let i = arcs.partition_point(|&a| a <= arc).clamp(1, segments) - 1;
    let span = arcs[i + 1] - arcs[i];
    let share = if span > 0.0 { ((arc - arcs[i]) / span).clamp(0.0, 1.0) } else { 0.0 };
    (i, share)
}

/// The point at a segment and share as given by [`locate`].
pub fn interpolate<P: Point>(points: &[P], (i, share): (usize, f32)) -> P {
    match points.get(i + 1) {
        Some(&next) => points[i] + (next - points[i]) * share,
        None => points[i],
    }
}

/// Points along a line from end to end, at least so far apart; one where it is shorter. A closed line ends before its beginning.
pub fn spaced<P: Point + PartialEq>(line: &[P], spacing: f32) -> Vec<P> {
    let arcs = arc_lengths(line.iter().copied());
    let length = arcs.last().copied().unwrap_or_default();
    let steps = (length / spacing + 1e-3).floor().max(1.0);
    // The end of a closed line is its beginning.
    let is_closed = line.first() == line.last();
    let count = if length < spacing { 1 } else { steps as usize + usize::from(!is_closed) };
    let point = |k: usize| interpolate(line, locate(&arcs, length * k as f32 / steps));
    (0..count).map(point).collect()
}

/// Point of the segment `a`–`b` nearest to `p`, as the share of the segment before it.
pub fn nearest_share<P: Point>(a: P, b: P, p: P, dot: impl Fn(P, P) -> f32) -> f32 {
    let ab = b - a;
    let squared = dot(ab, ab);
    if squared > 0.0 { (dot(p - a, ab) / squared).clamp(0.0, 1.0) } else { 0.0 }
}

/// Distance from `p` to the polyline and the arc length of the nearest point; `None` for an empty polyline.
pub fn nearest<P: Point>(points: &[P], p: P) -> Option<(f32, f32)> {
    let first = *points.first()?;
    let squared = |way: P| way.dot(way);
    let mut best = (squared(p - first), 0.0);
    let mut arc = 0.0;
    for w in points.windows(2) {
        let share = nearest_share(w[0], w[1], p, P::dot);
        let span = (w[1] - w[0]).norm();
        let squared = squared(p - (w[0] * (1.0 - share) + w[1] * share));
        if squared < best.0 {
            best = (squared, arc + share * span);
        }
        arc += span;
    }
    Some((best.0.sqrt(), best.1))
}

#[cfg(test)]
mod tests {
    use super::*;

    const L: [Vec2; 3] = [Vec2::ZERO, Vec2::new(3.0, 0.0), Vec2::new(3.0, 4.0)];

    #[test]
    fn arc_lengths_add_up() {
        assert_eq!(length(&L), 7.0);
        assert_eq!(arc_lengths(L.into_iter()), [0.0, 3.0, 7.0]);
    }

    #[test]
    fn locate_and_interpolate_meet_the_ends() {
        let arcs = arc_lengths(L.into_iter());
        assert_eq!(interpolate(&L, locate(&arcs, -1.0)), L[0]);
        assert_eq!(interpolate(&L, locate(&arcs, 5.0)), Vec2::new(3.0, 2.0));
        assert_eq!(interpolate(&L, locate(&arcs, 99.0)), L[2]);
    }

    #[test]
    fn nearest_finds_the_closest_segment() {
        assert_eq!(nearest(&L, Vec2::new(5.0, 2.0)), Some((2.0, 5.0)));
        assert_eq!(nearest(&[], Vec2::ZERO), None);
    }

    #[test]
    fn spaced_points_reach_from_end_to_end() {
        let line = [Vec2::ZERO, Vec2::new(3.0, 0.0), Vec2::new(3.0, 2.0)];
        let points = spaced(&line, 0.9);
        assert_eq!(points.len(), 6);
        assert!(points[0] == line[0] && points[5].distance(line[2]) < 1e-6);
        assert!(points[..4].windows(2).all(|two| (two[0].distance(two[1]) - 1.0).abs() < 1e-5), "{points:?}");
        assert_eq!(spaced(&line, 40.0), [Vec2::ZERO]);
        let around = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y, Vec2::ZERO];
        assert_eq!(spaced(&around, 0.5).len(), 8);
    }
}
