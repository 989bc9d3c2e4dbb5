//! Which wood of a plant a brush reaches, and a lead to what it sweeps where it reaches none.
//!
//! A branch is reached where its axis runs through the volume. What carries a reached branch comes along down to the ground, so
//! that orders of branching stay what they are. Where no wood is reached, a branch leads from the nearest wood to the nearest place of
//! the stroke; it may be as long as the plant is high.

use crate::growth::lead::curve;
use crate::growth::volume::{Ball, Swept};
use crate::plant::{Branch, Origin, Plant, Role, WoodPart};
use glam::Vec3;

/// Steps along an axis at which it is tested, in radii of the smallest ball.
const STEP: f32 = 0.5;
/// Places of a stroke that are tried for a lead, about.
const TRIED: usize = 64;
/// By how much farther away than it is the far end of a stroke counts.
const LATE: f32 = 0.5;
/// Radii of a lead at its beginning and at its end, as shares of that of the wood which it leaves.
const LEAD: (f32, f32) = (0.7, 0.45);

/// Wood that a stroke reaches.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Nearby {
    /// Places of the branches in the plant, rising.
    pub(super) branches: Vec<usize>,
    /// The branches themselves, parents by their place among these.
    pub(super) wood: Vec<Branch>,
    /// Radius of the thickest that runs through the volume, metres.
    pub(super) thickest: f32,
}

/// What a stroke reaches of a plant; empty where it reaches nothing.
pub(super) fn reached(plant: &Plant, swept: &Swept) -> Nearby {
    let smallest = swept.balls().iter().map(|ball| ball.radius).fold(f32::INFINITY, f32::min);
    let inside = |branch: &Branch| radius_inside(branch, swept, STEP * smallest);
    let radii: Vec<Option<f32>> = plant.branches.iter().map(inside).collect();
    let mut taken: Vec<bool> = radii.iter().map(Option::is_some).collect();
    for (b, branch) in plant.branches.iter().enumerate().rev() {
        if let (true, Some(parent)) = (taken[b], branch.parent) {
            taken[parent] = true;
        }
    }
    let mut place = vec![0; taken.len()];
    let mut nearby =
        Nearby { thickest: radii.iter().flatten().copied().fold(0.0, f32::max), ..Nearby::default() };
    for (b, branch) in plant.branches.iter().enumerate().filter(|(b, _)| taken[*b]) {
        place[b] = nearby.branches.len();
        nearby.branches.push(b);
        nearby.wood.push(Branch { parent: branch.parent.map(|parent| place[parent]), ..branch.clone() });
    }
    nearby
}

/// Largest radius of a branch where its axis runs through the volume.
fn radius_inside(branch: &Branch, swept: &Swept, step: f32) -> Option<f32> {
    let (low, high) = swept.bounds();
    let mut largest: Option<f32> = None;
    for (k, w) in branch.points.windows(2).enumerate() {
        let misses = w[0].max(w[1]).cmplt(low).any() || w[0].min(w[1]).cmpgt(high).any();
        if misses {
            continue;
        }
        // Only as many as it takes through the volume's box: a segment may be far longer than that.
        let count = (w[0].distance(w[1]) / step).ceil().clamp(1.0, 10_000.0) as usize;
        for n in 0..=count {
            let share = n as f32 / count as f32;
            if swept.contains(w[0].lerp(w[1], share)) {
                let radius = branch.radii[k] + (branch.radii[k + 1] - branch.radii[k]) * share;
                largest = Some(largest.unwrap_or(0.0).max(radius));
            }
        }
    }
    largest
}

/// A branch from the nearest wood of a plant to the nearest place of a stroke; `None` where there is no wood, or none so near.
pub(super) fn lead(plant: &Plant, swept: &Swept) -> Option<Branch> {
    let (distance, parent, ball) = nearest(plant, swept)?;
    let height = plant.branches.iter().flat_map(|b| &b.points).map(|p| p.y).fold(0.0, f32::max);
    if distance > height {
        return None;
    }
    let on = &plant.branches[parent];
    let (foot, radius) = on.axis_at(ball.at);
    let toward = (ball.at - foot).normalize_or(Vec3::Y);
    let leaving = (toward + Vec3::Y * 0.5).normalize_or(Vec3::Y);
    let (points, radii) = curve((foot, LEAD.0 * radius), leaving, (ball.at, LEAD.1 * radius));
    let level = on.level + 1;
    (points.len() > 1).then(|| Branch {
        origin: Origin::Generated,
        parent: Some(parent),
        level,
        points,
        radii,
        role: Role::of(WoodPart::Stem),
    })
}

/// How far the nearest wood is from a ball, which branch and which ball that is: near where shoots that follow the stroke begin.
fn nearest(plant: &Plant, swept: &Swept) -> Option<(f32, usize, Ball)> {
    let balls = swept.balls();
    let mut best: Option<(f32, (f32, usize, Ball))> = None;
    for k in (0..balls.len()).step_by(balls.len().div_ceil(TRIED).max(1)).chain([balls.len() - 1]) {
        let along = k as f32 / balls.len() as f32;
        let late = LATE * if swept.guide() < 0.0 { 1.0 - along } else { along };
        for (b, branch) in plant.branches.iter().enumerate() {
            let away = branch.axis_at(balls[k].at).0.distance(balls[k].at);
            let cost = away * (1.0 + late);
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, (away, b, balls[k])));
            }
        }
    }
    best.map(|(_, found)| found)
}
