//! Makes a hand-drawn closed outline simple: no edge crosses another.
//!
//! Hands overshoot: the end of a petal's outline crosses its beginning and leaves two tails. Wherever two edges
//! cross, the loop is cut there and the piece with the larger area is kept, until no crossing is left. Edges are
//! grouped into runs with bounding boxes, so an outline without crossings costs little more than one pass.
//!
//! Limits: a figure-eight keeps only its larger half; edges that merely touch count as crossing.

use glam::Vec2;

const RUN: usize = 8;

/// Signed area of the closed loop; positive when it turns from +x toward +y.
pub fn signed_area(points: impl Iterator<Item = Vec2> + Clone) -> f32 {
    let Some(first) = points.clone().next() else { return 0.0 };
    let next = points.clone().skip(1).chain(std::iter::once(first));
    points.zip(next).map(|(a, b)| (a - first).perp_dot(b - first)).sum::<f32>() * 0.5
}

/// Cuts crossings out of a closed loop of anything with a position. `blend(a, b, t)` makes the point where an edge
/// is cut. Ends after at most as many cuts as there are points; the result may have fewer than three points.
pub fn make_simple<T: Clone>(
    mut points: Vec<T>,
    position: impl Fn(&T) -> Vec2,
    blend: impl Fn(&T, &T, f32) -> T,
) -> Vec<T> {
    while points.len() > 3 {
        let flat: Vec<Vec2> = points.iter().map(&position).collect();
        let Some((i, j, ti)) = first_crossing(&flat) else { break };
        let n = points.len();
        let cut = blend(&points[i], &points[(i + 1) % n], ti);
        let inner: Vec<T> = std::iter::once(cut.clone()).chain(points[i + 1..=j].iter().cloned()).collect();
        let outer: Vec<T> = points[..=i].iter().cloned().chain([cut]).chain(points[j + 1..].iter().cloned()).collect();
        let area = |part: &[T]| signed_area(part.iter().map(&position)).abs();
        let kept = if area(&inner) > area(&outer) { inner } else { outer };
        if kept.len() >= n {
            return kept;
        }
        points = kept;
    }
    points
}

/// The first pair of edges `(i, j)`, `i < j`, that cross, and the share of edge `i` before the crossing.
fn first_crossing(points: &[Vec2]) -> Option<(usize, usize, f32)> {
    let n = points.len();
    let edge = |i: usize| (points[i], points[(i + 1) % n]);
    let boxes: Vec<(Vec2, Vec2)> = (0..n)
        .step_by(RUN)
        .map(|start| {
            (start..=(start + RUN).min(n))
                .map(|i| points[i % n])
                .fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(lo, hi), p| (lo.min(p), hi.max(p)))
        })
        .collect();
    for (a, box_a) in boxes.iter().enumerate() {
        for (b, box_b) in boxes.iter().enumerate().skip(a) {
            if box_a.0.cmpgt(box_b.1).any() || box_b.0.cmpgt(box_a.1).any() {
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
    let (r, s, ac) = (b - a, d - c, c - a);
    let det = r.perp_dot(s);
    if det == 0.0 {
        return None;
    }
    let (t, u) = (ac.perp_dot(s) / det, ac.perp_dot(r) / det);
    ((0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&u)).then_some(t)
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
        let drawn = [Vec2::new(-1.0, -1.0), Vec2::new(10.0, 10.0), Vec2::new(-10.0, 10.0), Vec2::new(1.0, -1.0)];
        let kept = simple(&drawn);
        assert_eq!(kept.len(), 3);
        assert!((signed_area(kept.iter().copied()).abs() - 100.0).abs() < 1e-3);
    }

    #[test]
    fn a_simple_outline_is_left_alone() {
        let star: Vec<Vec2> = (0..40).map(|k| Vec2::from_angle(k as f32 * 0.157) * (2.0 + (k % 2) as f32)).collect();
        assert_eq!(simple(&star), star);
    }

    #[test]
    fn area_is_signed_by_sense() {
        let ccw = [Vec2::ZERO, Vec2::X, Vec2::ONE];
        assert_eq!(signed_area(ccw.into_iter()), 0.5);
        assert_eq!(signed_area(ccw.into_iter().rev()), -0.5);
    }

    proptest! {
        #[test]
        fn any_scribble_becomes_simple(corners in prop::collection::vec((-9.0f32..9.0, -9.0f32..9.0), 3..60)) {
            let points: Vec<Vec2> = corners.into_iter().map(Vec2::from).collect();
            let kept = simple(&points);
            prop_assert!(kept.len() <= 3 || first_crossing(&kept).is_none());
        }
    }
}
