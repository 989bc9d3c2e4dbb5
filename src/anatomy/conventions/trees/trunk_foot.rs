//! The foot of a drawn trunk: its width without its roots, and how it rises from level ground.
//!
//! People draw roots by leading the two sides of a trunk outward at its foot. A round trunk as thick as its roots reach looks like a
//! bottle, so its width grows toward the foot by a limited share, ever faster; a trunk that widens evenly from its upper half on is a
//! cone, and may grow more. Limits: roots become no branches of their own.

use glam::Vec2;

/// Height over which a trunk that leans comes up plumb, in half widths of its foot.
const PLUMB: f32 = 2.0;
/// Widest foot of a trunk, in the middle width of its upper part, and of one that widens evenly all the way down.
const FLARE: f32 = 1.5;
const CONE: f32 = 2.4;
/// The upper part of a trunk, as a share of its rows from above.
const UPPER: f32 = 0.6;

/// Rows of a trunk from below without the roots at its foot: it widens toward the foot by [`FLARE`] at most, ever faster, or
/// evenly as its upper half does, by [`CONE`] at most.
pub(crate) fn without_roots(rows: &[(Vec2, f32)]) -> Vec<(Vec2, f32)> {
    let last = rows.len().saturating_sub(1) as f32;
    let mut upper: Vec<f32> =
        rows.iter().rev().take((UPPER * rows.len() as f32).ceil() as usize).map(|row| row.1).collect();
    let middle = upper.len() / 2;
    let stem = if upper.is_empty() { 0.0 } else { *upper.select_nth_unstable_by(middle, f32::total_cmp).1 };
    let half = rows.get(rows.len() / 2).map_or(0.0, |row| row.1 - stem).max(0.0);
    let most = |i: usize| {
        let down = 1.0 - i as f32 / last.max(1.0);
        let even = (2.0 * half * down).min((CONE - 1.0) * stem * down);
        stem + ((FLARE - 1.0) * stem * down * down).max(even)
    };
    rows.iter().enumerate().map(|(i, row)| (row.0, row.1.min(most(i)))).collect()
}

/// A trunk's middles and widths, from the foot up, so that it rises plumb: its foot is level, however the trunk leans above.
pub(crate) fn plumb(mut rows: Vec<(Vec2, f32)>) -> Vec<(Vec2, f32)> {
    let Some(&(foot, half)) = rows.first() else { return rows };
    for (place, _) in &mut rows {
        let share = ((foot.y - place.y) / (PLUMB * half).max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
        place.x = foot.x + (place.x - foot.x) * share * share * (3.0 - 2.0 * share);
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    fn halves(of: impl Fn(f32) -> f32) -> Vec<f32> {
        let rows: Vec<(Vec2, f32)> =
            (0..=40).map(|k| (Vec2::new(0.0, -(k as f32)), of(1.0 - k as f32 / 40.0))).collect();
        without_roots(&rows).into_iter().map(|row| row.1).collect()
    }

    #[test]
    fn roots_widen_a_foot_by_half_and_a_cone_stays_one() {
        let roots = halves(|down| if down > 0.7 { 10.0 + 200.0 * (down - 0.7) } else { 10.0 });
        assert!((roots[0] - 15.0).abs() < 0.1 && roots[20] < 10.1, "{roots:?}");
        assert!(roots.windows(2).all(|pair| pair[0] >= pair[1]));
        let cone = halves(|down| 10.0 + 8.0 * down);
        assert!((cone[0] - 18.0).abs() < 3.0 && (cone[20] - 14.0).abs() < 0.1, "{cone:?}");
        let column = halves(|_| 7.0);
        assert!(column.iter().all(|half| (half - 7.0).abs() < 1e-4));
    }
}
