//! What a pruning brush cuts off (001 §4.4): wood from where it enters the brush, with all that stands on it farther out, and leaves
//! and flowers in it.
//!
//! A branch whose base lies in the brush goes whole. Cut wood ends there as thick as it was. Limits: the rest is not made thinner.

use crate::growth::at_age::PlantAtAge;
use crate::growth::volume::Swept;
use crate::plant::{Branch, Cut, Plant};

/// Steps along an axis at which it is tested, in radii of the smallest ball.
const STEP: f32 = 0.25;
/// Halvings by which the place of a cut is found.
const HALVINGS: usize = 8;
/// Shortest stump that stays, in radii of the wood.
const STUMP: f32 = 1.0;

/// Cuts off what lies in the volume; whether anything did.
pub fn prune(from: &mut PlantAtAge, swept: &Swept) -> bool {
    let cuts = cuts(&from.plant, swept);
    from.plant.cut(&mut from.buds, &cuts, |at| !swept.contains(at))
}

fn cuts(plant: &Plant, swept: &Swept) -> Vec<Cut> {
    let smallest = swept.balls().iter().map(|ball| ball.radius).fold(f32::INFINITY, f32::min);
    let mut cuts: Vec<Cut> = Vec::with_capacity(plant.branches.len());
    for branch in &plant.branches {
        let base = branch.points.first().copied().unwrap_or_default();
        let cut = if !plant.is_held(&cuts, branch.parent, base) {
            Cut::Gone
        } else {
            match first_inside(branch, swept, STEP * smallest) {
                None => Cut::Whole,
                Some(length) if length <= STUMP * branch.radii[0] => Cut::Gone,
                Some(length) => Cut::At(length),
            }
        };
        cuts.push(cut);
    }
    cuts
}

/// How far from its base the axis of a branch enters the volume, metres.
fn first_inside(branch: &Branch, swept: &Swept, step: f32) -> Option<f32> {
    let (low, high) = swept.bounds();
    let mut walked = 0.0;
    for w in branch.points.windows(2) {
        let run = w[0].distance(w[1]);
        let misses = w[0].max(w[1]).cmplt(low).any() || w[0].min(w[1]).cmpgt(high).any();
        let count = if misses { 0 } else { (run / step).ceil().clamp(1.0, 10_000.0) as usize };
        let inside = |share: f32| swept.contains(w[0].lerp(w[1], share));
        let share = |n: usize| n as f32 / count as f32;
        if let Some(n) = (0..=count).find(|n| count > 0 && inside(share(*n))) {
            let (mut out, mut within) = (share(n.saturating_sub(1)), share(n));
            for _ in 0..HALVINGS {
                let middle = out.midpoint(within);
                if inside(middle) { within = middle } else { out = middle }
            }
            return Some(walked + run * out);
        }
        walked += run;
    }
    None
}
