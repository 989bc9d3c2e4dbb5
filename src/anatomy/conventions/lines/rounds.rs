//! Outlines gone round more than once in one stroke, as gone round once.
//!
//! Such a line comes back to its beginning in the same direction, and all that follows runs along what was drawn before. Then
//! the first round is the outline, drawn toward the mean of the rounds. A spiral comes back beside itself, a scribble elsewhere, a corolla
//! of loops through its middle goes on where it was not before. Cost: linear in the points for each time the line comes back.

use super::overlap::{Near, Overlap, REACH};
use crate::geom::polyline;
use glam::Vec2;

/// Least share of what follows that runs along the first round.
const ALONG: f32 = 0.85;
/// Least length of a round, as a share of the drawing's diagonal, and least of what follows it, as a share of the round.
const ROUND: (f32, f32) = (0.2, 0.3);
/// How near the line comes back, as a share of the round's length.
const BACK: f32 = 0.06;
/// Most times that a line comes back of which each is looked at.
const TIMES: usize = 6;

/// The line gone round once; none if it does not go round again.
pub(super) fn once(points: &[Vec2], diagonal: f32) -> Option<Vec<Vec2>> {
    let length = polyline::length(points);
    let step = length / (points.len() - 1).max(1) as f32;
    let returns = returns(points, step, diagonal);
    returns.into_iter().take(TIMES).find_map(|end| {
        let (round, rest) = (&points[..=end], &points[end..]);
        let reach = (REACH.0 * diagonal).min(REACH.1 * end as f32 * step);
        if (rest.len() as f32) < ROUND.1 * round.len() as f32 {
            return None;
        }
        let same_way = |near: &&Near| near.is_same_way;
        let along = Overlap::new(rest, round, reach);
        let share = along.along.iter().flatten().filter(same_way).count() as f32 / rest.len() as f32;
        (share >= ALONG).then(|| {
            let again = Overlap::new(round, rest, reach);
            let mean = |(p, near): (&Vec2, &Option<Near>)| near.map_or(*p, |near| p.midpoint(near.place));
            let mut once: Vec<Vec2> = round.iter().zip(&again.along).map(mean).collect();
            once.push(once[0]);
            once
        })
    })
}

/// Where a line comes back to its beginning, ascending.
fn returns(points: &[Vec2], step: f32, diagonal: f32) -> Vec<usize> {
    let first = ((ROUND.0 * diagonal / step) as usize).max(4);
    let away = |k: usize| points[k].distance(points[0]);
    let is_back = |k: &usize| {
        away(*k) < (BACK * *k as f32 * step).max(step) && away(*k) <= away(*k - 1) && away(*k) < away(*k + 1)
    };
    (first..points.len() - 1).filter(is_back).collect()
}
