//! What a pruning brush cuts off (001 §4.4): wood from where it enters the brush, with all that stands on it farther out, and leaves
//! and flowers in it.
//!
//! A branch whose base lies in the brush goes whole. Cut wood ends there as thick as it was. Limits: the rest is not made thinner.

use crate::geom::polyline;
use crate::growth::at_age::PlantAtAge;
use crate::growth::volume::Swept;
use crate::plant::{Branch, OrganKind, Plant};
use glam::Vec3;

/// Steps along an axis at which it is tested, in radii of the smallest ball.
const STEP: f32 = 0.25;
/// Halvings by which the place of a cut is found.
const HALVINGS: usize = 8;
/// Shortest stump that stays, in radii of the wood.
const STUMP: f32 = 1.0;

/// What becomes of a branch.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Cut {
    /// It stays as it is.
    Whole,
    /// It ends so far from its base, metres.
    At(f32),
    /// It goes.
    Gone,
}

/// Cuts off what lies in the volume; whether anything did.
pub fn prune(from: &mut PlantAtAge, swept: &Swept) -> bool {
    let cuts = cuts(&from.plant, swept);
    let stays =
        |branch: Option<usize>, at: Vec3| !swept.contains(at) && is_held(&from.plant, &cuts, branch, at);
    let flowers: Vec<bool> =
        from.plant.flowers.iter().map(|flower| stays(flower.branch, flower.cone.apex)).collect();
    let organs: Vec<bool> = from
        .plant
        .organs
        .iter()
        .map(|organ| match organ.flower {
            Some(flower) => flowers[flower],
            None => organ.kind() == OrganKind::Pot || stays(organ.branch, organ.base()),
        })
        .collect();
    let buds: Vec<bool> = from.buds.buds.iter().map(|bud| stays(bud.branch, bud.base)).collect();
    let is_untouched = cuts.iter().all(|cut| *cut == Cut::Whole);
    if is_untouched && [&flowers, &organs, &buds].into_iter().flatten().all(|stays| *stays) {
        return false;
    }
    retain(&mut from.plant.organs, &organs);
    let places = new_places(&flowers);
    from.plant.organs.iter_mut().for_each(|organ| organ.flower = organ.flower.map(|flower| places[flower]));
    retain(&mut from.plant.flowers, &flowers);
    retain(&mut from.buds.buds, &buds);
    let kept: Vec<bool> = cuts.iter().map(|cut| *cut != Cut::Gone).collect();
    let places = new_places(&kept);
    from.buds.buds.iter_mut().for_each(|bud| bud.branch = bud.branch.map(|branch| places[branch]));
    for (branch, cut) in from.plant.branches.iter_mut().zip(&cuts) {
        if let Cut::At(length) = cut {
            shorten(branch, *length);
        }
    }
    from.plant.keep_branches(&kept);
    from.plant.drop_unused_templates();
    debug_assert_eq!(from.plant.check_invariants(), Ok(()));
    debug_assert_eq!(from.buds.check_invariants(&from.plant), Ok(()));
    true
}

/// Keeps what stays.
fn retain<T>(items: &mut Vec<T>, stays: &[bool]) {
    let mut stays = stays.iter();
    items.retain(|_| stays.next().copied().unwrap_or(true));
}

/// The place of each among those that stay.
fn new_places(stays: &[bool]) -> Vec<usize> {
    let count = |next: &mut usize, stays: &bool| {
        *next += usize::from(*stays);
        Some(*next - usize::from(*stays))
    };
    stays.iter().scan(0, count).collect()
}

fn cuts(plant: &Plant, swept: &Swept) -> Vec<Cut> {
    let smallest = swept.balls().iter().map(|ball| ball.radius).fold(f32::INFINITY, f32::min);
    let mut cuts: Vec<Cut> = Vec::with_capacity(plant.branches.len());
    for branch in &plant.branches {
        let base = branch.points.first().copied().unwrap_or_default();
        let cut = if !is_held(plant, &cuts, branch.parent, base) {
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

/// Whether what stands at a place on a branch still has wood under it.
fn is_held(plant: &Plant, cuts: &[Cut], branch: Option<usize>, at: Vec3) -> bool {
    let Some(branch) = branch else { return true };
    match cuts[branch] {
        Cut::Whole => true,
        Cut::Gone => false,
        Cut::At(length) => {
            polyline::nearest(&plant.branches[branch].points, at).is_some_and(|n| n.1 <= length)
        }
    }
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

/// Ends a branch so far from its base.
fn shorten(branch: &mut Branch, length: f32) {
    let mut walked = 0.0;
    for k in 1..branch.points.len() {
        let (from, to) = (branch.points[k - 1], branch.points[k]);
        let run = from.distance(to);
        if walked + run >= length {
            let share = ((length - walked) / run).clamp(0.0, 1.0);
            branch.radii[k] = branch.radii[k - 1] + (branch.radii[k] - branch.radii[k - 1]) * share;
            branch.points[k] = from.lerp(to, share);
            // A cut at a point leaves no piece without length.
            let kept = if share < 1e-3 && k > 1 { k } else { k + 1 };
            branch.points.truncate(kept);
            branch.radii.truncate(kept);
            return;
        }
        walked += run;
    }
}
