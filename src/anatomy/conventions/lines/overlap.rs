//! Where one line runs along another: near it, in its direction or against it.
//!
//! Two lines are one restated where they are nearer than [`REACH`] and nearly parallel. What keeps the two sides of a trunk or of
//! a thin stem apart: they lie at one and the same side of each other all along, a restated line now at this, now at that side; only
//! very near ones ([`SAME`]) are one line whatever their side.
//!
//! Cost: linear in the points of both.

use glam::{IVec2, Vec2};
use std::collections::HashMap;

/// Largest distance of a line from one that it restates, as a share of the drawing's diagonal, and of the shorter line's length.
pub(super) const REACH: (f32, f32) = (0.018, 0.08);
/// Mean distance up to which lines are one even if one lies at one side of the other, as a share of the drawing's diagonal: of those
/// that restate another, and of those that go on from its end, where two sides of a thing seldom overlap.
pub(super) const SAME: (f32, f32) = (0.006, 0.007);
/// Largest share of a line that lies at one side of another that it restates.
const ONE_SIDE: f32 = 0.85;
/// Least cosine of the angle between lines that are parallel.
const PARALLEL: f32 = 0.85;

/// For each point of a line: where on the other, in its points, it lies along; none where it does not.
pub(super) struct Overlap {
    pub along: Vec<Option<Near>>,
}

/// The nearest place on the other line.
#[derive(Clone, Copy)]
pub(super) struct Near {
    /// The other line's point.
    pub index: usize,
    /// The place on it.
    pub place: Vec2,
    /// Distance to the left of the other line.
    pub side: f32,
    /// Whether both lines have the same direction there.
    pub is_same_way: bool,
}

impl Overlap {
    /// Where `line` runs along `other`, within `reach`.
    pub(super) fn new(line: &[Vec2], other: &[Vec2], reach: f32) -> Self {
        let cell = |p: Vec2| (p / reach).floor().as_ivec2();
        let mut at: HashMap<IVec2, Vec<usize>> = HashMap::new();
        other.iter().enumerate().for_each(|(k, p)| at.entry(cell(*p)).or_default().push(k));
        let around: Vec<IVec2> = (-1..=1).flat_map(|x| (-1..=1).map(move |y| IVec2::new(x, y))).collect();
        let near = |i: usize| {
            let way = direction(line, i);
            let places = around.iter().filter_map(|step| at.get(&(cell(line[i]) + step))).flatten();
            let place = |k: &usize| near_at(line[i], way, other, *k);
            let candidates = places.filter_map(place).filter(|(distance, _)| *distance < reach);
            candidates
                .min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.index.cmp(&b.1.index)))
                .map(|(_, near)| near)
        };
        Self { along: (0..line.len()).map(near).collect() }
    }

    /// Share of the points that lie along the other line.
    pub(super) fn share(&self) -> f32 {
        self.count() as f32 / self.along.len().max(1) as f32
    }

    /// How many points lie along the other line.
    pub(super) fn count(&self) -> usize {
        self.along.iter().flatten().count()
    }

    /// Whether both lines are one, as far as their sides tell, which count from a mean distance on.
    pub(super) fn is_one_line(&self, same: f32) -> bool {
        let sides: Vec<f32> = self.along.iter().flatten().map(|near| near.side).collect();
        let left = sides.iter().filter(|side| **side > 0.0).count() as f32 / sides.len().max(1) as f32;
        let mean = sides.iter().map(|side| side.abs()).sum::<f32>() / sides.len().max(1) as f32;
        mean < same || (1.0 - ONE_SIDE..ONE_SIDE).contains(&left)
    }
}

/// The direction of a line at one of its points.
fn direction(line: &[Vec2], i: usize) -> Vec2 {
    (line[(i + 2).min(line.len() - 1)] - line[i.saturating_sub(2)]).normalize_or_zero()
}

/// The place on the other line about its point `k` that is nearest to `p`, and its distance; none where the directions differ.
fn near_at(p: Vec2, way: Vec2, other: &[Vec2], k: usize) -> Option<(f32, Near)> {
    let its_way = direction(other, k);
    let cosine = way.dot(its_way);
    if cosine.abs() < PARALLEL {
        return None;
    }
    let half_step = 0.5 * other[0].distance(other[1]);
    let place = other[k] + its_way * (p - other[k]).dot(its_way).clamp(-half_step, half_step);
    let near = Near { index: k, place, side: its_way.perp_dot(p - place), is_same_way: cosine > 0.0 };
    Some((p.distance(place), near))
}
