//! Rounds the bends of chains.
//!
//! Chains of more than three nodes are rounded by cubic Hermite pieces with Catmull–Rom tangents (001 §2.4) wherever
//! they turn noticeably.

use glam::Vec3;

/// Turns with a larger cosine than this need no rounding: 8°.
const STRAIGHT: f32 = 0.99;

/// Puts a point into every segment that turns at one of its ends.
pub(super) fn rounded(skeleton: &[(Vec3, f32)]) -> Vec<(Vec3, f32)> {
    let mut out = Vec::with_capacity(2 * skeleton.len());
    for (k, point) in skeleton.iter().enumerate() {
        out.push(*point);
        if let Some(middle) = middle(k, skeleton.len(), |k| skeleton[k].0) {
            out.push((middle, point.1.midpoint(skeleton[k + 1].1)));
        }
    }
    out
}

/// The point that rounding puts after the `k`-th of `count` points; `None` where the line is straight.
pub(super) fn middle(k: usize, count: usize, point: impl Fn(usize) -> Vec3) -> Option<Vec3> {
    if count <= 3 || k + 1 >= count {
        return None;
    }
    let at = |k: usize| point(k.min(count - 1));
    let turns = |k: usize| {
        let (a, b) = (at(k) - at(k.saturating_sub(1)), at(k + 1) - at(k));
        k > 0 && k + 1 < count && a.dot(b) < STRAIGHT * a.length() * b.length()
    };
    // The Hermite piece half way: tangents are half the way between the neighbours.
    let (t0, t1) = ((at(k + 1) - at(k.saturating_sub(1))) * 0.5, (at(k + 2) - at(k)) * 0.5);
    (turns(k) || turns(k + 1)).then(|| at(k).midpoint(at(k + 1)) + (t0 - t1) * 0.125)
}
