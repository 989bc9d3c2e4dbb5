//! Makes a hand-drawn closed outline simple: no edge crosses another.
//!
//! Hands overshoot: the end of a petal's outline crosses its beginning and leaves two tails. Wherever two edges
//! cross, the loop is cut there and the piece with the larger area is kept, until no crossing is left. Where the smaller
//! piece must stay, because a petal's two sides cross just before its tip, its sense is turned instead, which takes the
//! crossing apart and keeps both.
//!
//! Edges are grouped into runs with bounding boxes; a run along which the outline always goes forward cannot cross
//! itself. So an outline without crossings costs little more than one pass.
//!
//! Limits: edges that merely touch count as crossing. After [`MOST_CUTS`] cuts what is left is a scribble, of which the
//! convex hull is given, so that a knot costs no more than that many passes.

use super::convex_hull::convex_hull;
use glam::Vec2;

const RUN: usize = 8;

/// Signed area of the closed loop; positive when it turns from +x toward +y.
pub fn signed_area(points: impl Iterator<Item = Vec2> + Clone) -> f32 {
    let Some(first) = points.clone().next() else { return 0.0 };
    let next = points.clone().skip(1).chain(std::iter::once(first));
    points.zip(next).map(|(a, b)| (a - first).perp_dot(b - first)).sum::<f32>() * 0.5
}

/// Area of a closed outline, without sign.
pub fn area(outline: &[Vec2]) -> f32 {
    signed_area(outline.iter().copied()).abs()
}

/// Area of the convex hull of some points.
pub fn hull_area(points: &[Vec2]) -> f32 {
    area(&convex_hull(points, |p| *p))
}

/// Where a closed outline crosses a height: x of each crossing, in the order of the outline's edges.
pub fn crossings_at(outline: &[Vec2], height: f32) -> impl Iterator<Item = f32> {
    let edges = outline.iter().zip(outline.iter().cycle().skip(1));
    // Half-open, so that a corner is crossed once.
    let crossed = edges.filter(move |(a, b)| (a.y <= height) != (b.y <= height));
    crossed.map(move |(a, b)| a.x + (b.x - a.x) * (height - a.y) / (b.y - a.y))
}

/// Most crossings that are taken out of one outline.
pub const MOST_CUTS: usize = 64;

/// Cuts crossings out of a closed loop of anything with a position. `blend(a, b, t)` makes the point where an edge
/// is cut. The result may have fewer than three points.
pub fn make_simple<T: Clone>(
    points: Vec<T>,
    position: impl Fn(&T) -> Vec2,
    blend: impl Fn(&T, &T, f32) -> T,
) -> Vec<T> {
    make_simple_keeping(points, position, blend, |_| false)
}

/// The same, but an inner loop with a point that must stay is turned instead of cut off.
pub fn make_simple_keeping<T: Clone>(
    mut points: Vec<T>,
    position: impl Fn(&T) -> Vec2,
    blend: impl Fn(&T, &T, f32) -> T,
    must_stay: impl Fn(&T) -> bool,
) -> Vec<T> {
    let mut flat: Vec<Vec2> = points.iter().map(&position).collect();
    let mut cuts = 0;
    while let Some((i, j, ti)) = first_crossing(&flat) {
        cuts += 1;
        if cuts > MOST_CUTS {
            return convex_hull(&points, &position);
        }
        let cut = blend(&points[i], &points[(i + 1) % points.len()], ti);
        let at = position(&cut);
        let inner = signed_area(flat[i + 1..=j].iter().copied().chain([at])).abs();
        let outer = signed_area(flat[..=i].iter().copied().chain([at]).chain(flat[j + 1..].iter().copied()));
        if inner > outer.abs() {
            points.truncate(j + 1);
            points.drain(..=i);
            points.insert(0, cut);
        } else if points[i + 1..=j].iter().any(&must_stay) {
            points[i + 1..=j].reverse();
        } else {
            points.splice(i + 1..=j, [cut]);
        }
        flat.clear();
        flat.extend(points.iter().map(&position));
    }
    points
}

/// Consecutive edges.
struct Run {
    low: Vec2,
    high: Vec2,
    /// From the first point to the last.
    chord: Vec2,
}

impl Run {
    /// All runs of a closed loop.
    fn of(points: &[Vec2]) -> Vec<Self> {
        let n = points.len();
        let run = |start: usize| {
            let end = (start + RUN).min(n);
            let held = points[start..end].iter().copied().chain([points[end % n]]);
            let (low, high) =
                held.fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(lo, hi), p| (lo.min(p), hi.max(p)));
            Self { low, high, chord: points[end % n] - points[start] }
        };
        (0..n).step_by(RUN).map(run).collect()
    }

    fn is_apart_from(&self, other: &Self) -> bool {
        self.low.cmpgt(other.high).any() || other.low.cmpgt(self.high).any()
    }
}

/// Whether no two edges of a closed loop cross or touch but at the point that they share.
pub fn is_simple(points: &[Vec2]) -> bool {
    first_crossing(points).is_none()
}

/// The first pair of edges `(i, j)`, `i < j`, that cross, and the share of edge `i` before the crossing.
fn first_crossing(points: &[Vec2]) -> Option<(usize, usize, f32)> {
    let n = points.len();
    if n <= 3 {
        return None;
    }
    let edge = |i: usize| (points[i], points[if i + 1 == n { 0 } else { i + 1 }]);
    let runs = Run::of(points);
    // An outline that always goes forward along a direction cannot come back to itself.
    let goes_forward = |a: usize, b: usize| {
        let along = if a == b { runs[a].chord } else { runs[a].chord + runs[b].chord };
        (a * RUN..((b + 1) * RUN).min(n)).map(edge).all(|(from, to)| (to - from).dot(along) > 0.0)
    };
    for a in 0..runs.len() {
        // What goes forward together with its successor goes forward alone.
        let together = a + 1 < runs.len() && goes_forward(a, a + 1);
        for b in a..runs.len() {
            let forward = b <= a + 1 && (together || (a == b && goes_forward(a, a)));
            if forward || runs[a].is_apart_from(&runs[b]) {
                continue;
            }
            for i in a * RUN..((a + 1) * RUN).min(n) {
                for j in (b * RUN).max(i + 2)..((b + 1) * RUN).min(n) {
                    if i == 0 && j == n - 1 {
                        continue;
                    }
                    if let Some(share) = crossing(edge(i), edge(j)) {
                        return Some((i, j, share));
                    }
                }
            }
        }
    }
    None
}

/// Share of the first segment before it meets the second, `None` when they do not meet.
fn crossing((a, b): (Vec2, Vec2), (c, d): (Vec2, Vec2)) -> Option<f32> {
    // Of twice the precision of the points, so that the answer is the same whichever way around a loop is gone through.
    let [a, b, c, d] = [a, b, c, d].map(Vec2::as_dvec2);
    let (r, s, ac) = (b - a, d - c, c - a);
    let det = r.perp_dot(s);
    if det == 0.0 {
        return None;
    }
    let (t, u) = (ac.perp_dot(s) / det, ac.perp_dot(r) / det);
    ((0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&u)).then_some(t as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn simple(points: &[Vec2]) -> Vec<Vec2> {
        make_simple(points.to_vec(), |p| *p, |a, b, t| a.lerp(*b, t))
    }

    #[test]
    fn overshooting_ends_are_trimmed() {
        // A triangle whose first and last strokes cross and stick out.
        let drawn =
            [Vec2::new(-1.0, -1.0), Vec2::new(10.0, 10.0), Vec2::new(-10.0, 10.0), Vec2::new(1.0, -1.0)];
        let kept = simple(&drawn);
        assert_eq!(kept.len(), 3);
        assert!((signed_area(kept.iter().copied()).abs() - 100.0).abs() < 1e-3);
    }

    #[test]
    fn a_simple_outline_is_left_alone() {
        let star: Vec<Vec2> =
            (0..40).map(|k| Vec2::from_angle(k as f32 * 0.157) * (2.0 + (k % 2) as f32)).collect();
        assert_eq!(simple(&star), star);
    }

    #[test]
    fn a_loop_that_must_stay_is_turned() {
        // A tall petal whose sides cross near the tip.
        let drawn = [(0.0, 0.0), (4.0, 5.0), (-1.0, 11.0), (0.0, 12.0), (1.0, 11.0), (-4.0, 5.0)];
        let drawn = drawn.map(Vec2::from).to_vec();
        let lerp = |a: &Vec2, b: &Vec2, t: f32| a.lerp(*b, t);
        assert!(simple(&drawn).iter().all(|p| p.y < 11.0));
        let kept = make_simple_keeping(drawn, |p| *p, lerp, |p| p.y == 12.0);
        assert!(first_crossing(&kept).is_none());
        assert_eq!(kept.iter().map(|p| p.x).collect::<Vec<_>>(), [0.0, 4.0, 1.0, 0.0, -1.0, -4.0]);
    }

    #[test]
    fn a_knot_becomes_its_hull() {
        let knot: Vec<Vec2> =
            (0..1000).map(|k| Vec2::from_angle(k as f32 * 2.4) * (200.0 - k as f32 * 0.1)).collect();
        let kept = simple(&knot);
        assert!(kept.len() > 2 && first_crossing(&kept).is_none());
    }

    #[test]
    fn area_is_signed_by_sense() {
        let ccw = [Vec2::ZERO, Vec2::X, Vec2::ONE];
        assert_eq!(signed_area(ccw.into_iter()), 0.5);
        assert_eq!(signed_area(ccw.into_iter().rev()), -0.5);
    }

    proptest! {
        #[test]
        fn runs_hide_no_crossing(corners in prop::collection::vec((-9.0f32..9.0, -9.0f32..9.0), 4..60)) {
            let points: Vec<Vec2> = corners.into_iter().map(Vec2::from).collect();
            let n = points.len();
            let edge = |i: usize| (points[i], points[(i + 1) % n]);
            let pairs = (0..n).flat_map(|i| (i + 2..n).map(move |j| (i, j)));
            let mut apart = pairs.filter(|&(i, j)| i != 0 || j != n - 1);
            let crosses = apart.any(|(i, j)| crossing(edge(i), edge(j)).is_some());
            prop_assert_eq!(first_crossing(&points).is_some(), crosses);
        }

        /// Of a loop that comes back close to itself.
        #[test]
        fn a_loop_crosses_itself_whichever_way_around(bends in prop::collection::vec(-0.9f32..0.9, 4..40), turn in 0.0f32..6.0) {
            let there = (0..bends.len()).map(|k| Vec2::from_angle(turn).rotate(Vec2::new(k as f32 * 0.031, bends[k])));
            let back = there.clone().rev().map(|point| point * (1.0 + f32::EPSILON) + Vec2::splat(1e-9));
            let mut points: Vec<Vec2> = there.chain(back).collect();
            let is_simple = is_simple(&points);
            points.reverse();
            prop_assert_eq!(super::is_simple(&points), is_simple);
        }

        #[test]
        fn any_scribble_becomes_simple(corners in prop::collection::vec((-9.0f32..9.0, -9.0f32..9.0), 3..60)) {
            let points: Vec<Vec2> = corners.into_iter().map(Vec2::from).collect();
            let kept = simple(&points);
            prop_assert!(kept.len() <= 3 || first_crossing(&kept).is_none());
        }
    }
}
