//! Prepares a blade's outline for triangulation: counter-clockwise, evenly dense, no needless points.
//!
//! Points that stand closer together than a face may be small are merged, points that do not carry the shape are
//! dropped (Douglas–Peucker between base and tip, and of many points between every few, so that these stay), and long straight
//! runs are divided so that the blade can bend there. Outlines that may have only a few points keep those that enclose the most area. Coordinates are in blade sizes: 1 is the larger of the blade's length and extent.
//!
//! Limits: the result stays within the tolerance of the drawn outline but may cross itself by as much; the
//! triangulation notices and [`untangled`] cuts the crossing off.

use crate::geom::{simple_loop, simplify};
use glam::Vec2;

/// One point of a prepared outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MarginPoint {
    /// Position (u, v) in blade sizes.
    pub(super) at: Vec2,
    /// Pen pressure's curl there, −1 to 1.
    pub(super) curl: f32,
}

impl MarginPoint {
    fn lerp(&self, other: &Self, share: f32) -> Self {
        Self { at: self.at.lerp(other.at, share), curl: self.curl + (other.curl - self.curl) * share }
    }
}

/// How closely an outline is followed; all in blade sizes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Precision {
    /// Largest distance between the drawn and the prepared outline.
    pub(super) tolerance: f32,
    /// Edges longer than this are divided.
    pub(super) longest_edge: f32,
    /// The least important points beyond this number are left out before edges are divided, whatever the tolerance.
    pub(super) most_points: usize,
}

/// No edge of a prepared outline is shorter, in blade sizes.
const SHORTEST_EDGE: f32 = 1e-3;

/// Edges of the drawn outline that are searched together, where no points are left out for their number.
const SPAN: usize = 16;

/// Memory that is used again for every blade.
#[derive(Default)]
pub(super) struct OutlineScratch {
    spaced: Vec<MarginPoint>,
    kept: Vec<bool>,
    pending: Vec<(usize, usize)>,
}

/// Writes the prepared outline to `out`: at least three points, or none when the outline has no area.
pub(super) fn prepare(
    (outline, curl): (&[Vec2], &[f32]),
    size: f32,
    precision: Precision,
    scratch: &mut OutlineScratch,
    out: &mut Vec<MarginPoint>,
) {
    out.clear();
    space((outline, curl), 1.0 / size, &mut scratch.spaced);
    let spaced = &mut scratch.spaced;
    if spaced.len() < 3 {
        return;
    }
    let area = simple_loop::signed_area(spaced.iter().map(|m| m.at));
    if area < 0.0 {
        spaced.reverse();
    }
    // The two sides of a narrow blade must not fall together: its area is its mean width.
    let tolerance = precision.tolerance.min(0.25 * area.abs()).max(f32::MIN_POSITIVE);
    let base = best(spaced, |m| -m.at.length_squared());
    spaced.rotate_left(base);
    spaced.push(spaced[0]);
    let tip = best(&spaced[1..spaced.len() - 1], |m| m.at.y) + 1;
    scratch.kept.clear();
    scratch.kept.resize(spaced.len(), false);
    for side in [(0, tip), (tip, spaced.len() - 1)] {
        for span in pieces(side, if precision.most_points == usize::MAX { SPAN } else { usize::MAX }) {
            simplify::mark(span, &mut scratch.kept, &mut scratch.pending, |a, b| {
                distance_from_chord(spaced, a, b, tolerance)
            });
        }
    }
    thin(spaced, &mut scratch.kept, tip, precision.most_points);
    divide(spaced, &scratch.kept, precision.longest_edge, out);
    if out.len() < 3 {
        out.clear();
    }
}

/// Divides a side into equal spans of at most `longest` edges: long edges would be divided anyway, and short spans are
/// searched fewer times.
fn pieces((first, last): (usize, usize), longest: usize) -> impl Iterator<Item = (usize, usize)> {
    let count = (last - first).div_ceil(longest);
    let at = move |k: usize| first + (last - first) * k / count;
    (0..count).map(move |k| (at(k), at(k + 1)))
}

/// Copies the outline, leaving out points that nearly repeat the one before them.
fn space((outline, curl): (&[Vec2], &[f32]), scale: f32, out: &mut Vec<MarginPoint>) {
    out.clear();
    let far = |a: Vec2, b: Vec2| a.distance_squared(b) > SHORTEST_EDGE * SHORTEST_EDGE;
    for (i, point) in outline.iter().enumerate() {
        let at = *point * scale;
        if out.last().is_none_or(|last| far(last.at, at)) {
            out.push(MarginPoint { at, curl: curl.get(i).copied().unwrap_or(0.0) });
        }
    }
    while out.len() > 1 && !far(out[0].at, out[out.len() - 1].at) {
        out.pop();
    }
}

fn best(points: &[MarginPoint], merit: impl Fn(&MarginPoint) -> f32) -> usize {
    let better = |best: (usize, f32), (i, m): (usize, &MarginPoint)| {
        let merit = merit(m);
        if merit > best.1 { (i, merit) } else { best }
    };
    points.iter().enumerate().fold((0, f32::NEG_INFINITY), better).0
}

/// Squared distance of a point from the segment `a`–`b` as a multiple of the squared tolerance; the curl counts too,
/// because a straight margin may still be pressed unevenly.
fn distance_from_chord(
    points: &[MarginPoint],
    a: usize,
    b: usize,
    tolerance: f32,
) -> impl Fn(usize) -> f32 + use<'_> {
    const CURL_TOLERANCE: f32 = 0.15;
    let (from, to) = (points[a], points[b]);
    let along = to.at - from.at;
    let (inverse, curled) = (1.0 / along.length_squared().max(f32::MIN_POSITIVE), to.curl - from.curl);
    let per_tolerance = 1.0 / (tolerance * tolerance);
    move |i| {
        let (from_start, curl) = (points[i].at - from.at, points[i].curl - from.curl);
        let share = (from_start.dot(along) * inverse).clamp(0.0, 1.0);
        let off = from_start.distance_squared(along * share) * per_tolerance;
        off.max((curl - curled * share).powi(2) * (1.0 / (CURL_TOLERANCE * CURL_TOLERANCE)))
    }
}

/// Leaves out kept points of the closed chain, the one that encloses the least area with its neighbours first, until
/// `most` remain (Visvalingam and Whyatt 1993). Base and tip stay.
///
/// Quadratic in the number of kept points, which the tolerance has already made few.
fn thin(chain: &[MarginPoint], kept: &mut [bool], tip: usize, most: usize) {
    if most >= chain.len() {
        return;
    }
    let mut left: Vec<usize> = (0..chain.len()).filter(|&i| kept[i]).collect();
    let importance = |w: &[usize]| {
        let [a, b, c] = [w[0], w[1], w[2]].map(|i| chain[i].at);
        if w[1] == tip { f32::INFINITY } else { (b - a).perp_dot(c - a).abs() }
    };
    // The base stands at both ends of the chain and counts once.
    while left.len() > most.max(3) + 1 {
        let least = left.windows(3).map(importance).enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
        let Some((before, _)) = least else { return };
        kept[left.remove(before + 1)] = false;
    }
}

/// Writes the kept points of the closed chain (first point repeated at the end), with long edges divided evenly.
fn divide(chain: &[MarginPoint], kept: &[bool], longest_edge: f32, out: &mut Vec<MarginPoint>) {
    let mut from = chain[0];
    for (to, _) in chain.iter().zip(kept).skip(1).filter(|(_, kept)| **kept) {
        let pieces = (from.at.distance(to.at) / longest_edge).ceil().clamp(1.0, 64.0) as u32;
        out.extend((0..pieces).map(|k| from.lerp(to, k as f32 / pieces as f32)));
        from = *to;
    }
}

/// The largest part of the outline that does not cross itself.
pub(super) fn untangled(outline: &[MarginPoint]) -> Vec<MarginPoint> {
    let mut simple = simple_loop::make_simple(outline.to_vec(), |m| m.at, MarginPoint::lerp);
    simple.dedup_by(|b, a| a.at.distance_squared(b.at) < SHORTEST_EDGE * SHORTEST_EDGE);
    if simple_loop::signed_area(simple.iter().map(|m| m.at)) < 0.0 {
        simple.reverse();
    }
    simple
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::polyline;

    const FINE: Precision = Precision { tolerance: 0.001, longest_edge: 0.2, most_points: usize::MAX };

    fn prepared(outline: &[Vec2], curl: &[f32], precision: Precision) -> Vec<MarginPoint> {
        let mut out = Vec::new();
        prepare((outline, curl), 1.0, precision, &mut OutlineScratch::default(), &mut out);
        out
    }

    fn notched_petal() -> Vec<Vec2> {
        let half = (0..60).map(|k| {
            let s = k as f32 / 60.0;
            Vec2::new(0.4 * (s * 3.0).sin(), s - 0.12 * (s - 0.8).max(0.0) * 5.0)
        });
        let right: Vec<Vec2> = half.collect();
        right.iter().copied().chain(right.iter().rev().map(|p| Vec2::new(-p.x, p.y))).collect()
    }

    #[test]
    fn the_drawn_outline_stays_within_a_fifth_of_a_percent() {
        let drawn = notched_petal();
        let prepared = prepared(&drawn, &[], FINE);
        assert!(prepared.len() < drawn.len());
        let mut closed: Vec<Vec2> = prepared.iter().map(|m| m.at).collect();
        closed.push(closed[0]);
        for p in drawn {
            let (distance, _) = polyline::nearest(&closed, p).unwrap();
            assert!(distance < 0.002, "{distance} at {p}");
        }
    }

    #[test]
    fn clockwise_outlines_turn_round_with_their_curl() {
        let drawn = [Vec2::ZERO, Vec2::new(-0.5, 0.5), Vec2::Y, Vec2::new(0.5, 0.5)];
        let out = prepared(&drawn, &[0.0, -1.0, 0.0, 1.0], Precision { longest_edge: 9.0, ..FINE });
        assert_eq!(out.iter().map(|m| m.curl).collect::<Vec<_>>(), [0.0, 1.0, 0.0, -1.0]);
        assert!(simple_loop::signed_area(out.iter().map(|m| m.at)) > 0.0);
    }

    #[test]
    fn long_edges_are_divided_and_repeats_dropped() {
        let drawn = [Vec2::ZERO, Vec2::new(1e-5, 0.0), Vec2::X, Vec2::ONE, Vec2::ONE, Vec2::Y];
        let out = prepared(&drawn, &[], FINE);
        assert_eq!(out.len(), 20);
        assert!(out.windows(2).all(|w| w[0].at.distance(w[1].at) < 0.2001));
    }

    #[test]
    fn a_star_thinned_to_its_corners_keeps_all_of_them() {
        let corner = |k: usize| {
            Vec2::from_angle(k as f32 * 0.628 - 1.57) * if k.is_multiple_of(2) { 0.5 } else { 0.2 }
        };
        let corners: Vec<Vec2> = (0..10).map(|k| corner(k) + Vec2::Y * 0.5).collect();
        let between = |k: usize| (0..6).map(move |j| (k, j as f32 / 6.0));
        let drawn: Vec<Vec2> =
            (0..10).flat_map(between).map(|(k, s)| corners[k].lerp(corners[(k + 1) % 10], s)).collect();
        let out = prepared(&drawn, &[], Precision { longest_edge: 9.0, most_points: 10, ..FINE });
        assert_eq!(out.len(), 10);
        for corner in corners {
            assert!(out.iter().any(|m| m.at.distance(corner) < 1e-3), "{corner} is lost");
        }
        assert_eq!(prepared(&drawn, &[], Precision { longest_edge: 9.0, most_points: 6, ..FINE }).len(), 6);
    }
}
