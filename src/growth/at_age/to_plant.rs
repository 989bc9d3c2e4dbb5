//! A grown tree at an age as a [`Plant`]: chains become branches, young wood gets leaves, and flower buds stand beside it.
//!
//! Chains are rounded ([`rounding`](super::rounding)). Trunks widen at their foot.

use super::bloom;
use super::chains::{Chain, Chains};
use super::foliage::{self, Wood};
use super::rounding::rounded;
use super::stem_base::Stems;
use super::wood_at_age::{WoodAtAge, wood_at_age};
use crate::growth::simulation::Simulation;
use crate::growth::tree::Tree;
use crate::plant::{Branch, FlowerBuds, Origin, Plant, Role, WoodPart};
use glam::Vec3;

/// Heights above the ground, in radii of the trunk, at which its foot is modelled.
const FOOT: [f32; 5] = [0.35, 0.8, 1.4, 2.4, 4.0];
/// Lengths of trunks in radii of their foot: up to the first they do not widen there, from the second on fully.
const SLENDER: (f32, f32) = (8.0, 30.0);
/// Share of its parent's radius that a branch may begin with.
pub(super) const NARROWER: f32 = 0.92;

/// A plant of one age.
#[derive(Clone, Debug, PartialEq)]
pub struct PlantAtAge {
    /// Its wood and leaves.
    pub plant: Plant,
    /// The flower buds on it.
    pub buds: FlowerBuds,
}

/// The plant at an age, at most the simulation's own. Ages between years are years that run.
pub fn plant_at(simulation: &Simulation, age: f32) -> PlantAtAge {
    with_wood(simulation, simulation.tree(), age, None).0
}

/// The same with the wood that became its branches, which are its chains, in their order; leaves and buds are known by the names of
/// their nodes, where these have `names`. `tree` is the simulation's, or with branches that are [younger](super::younger).
pub(crate) fn with_wood(
    simulation: &Simulation,
    tree: &Tree,
    age: f32,
    names: Option<&[u64]>,
) -> (PlantAtAge, WoodAtAge) {
    let (habit, limits) = (simulation.habit(), simulation.limits());
    let age = if age.is_finite() { age.clamp(0.0, f32::from(simulation.age())) } else { 0.0 };
    let shown = wood_at_age(simulation, tree, age);
    let WoodAtAge { chains, at, diameters, grown } = &shown;
    let stems = Stems::of(tree, chains, diameters);
    let mut branches: Vec<Branch> = Vec::with_capacity(chains.chains.len());
    for (index, chain) in chains.chains.iter().enumerate() {
        let mut skeleton = skeleton_of(chain, chains, at, diameters);
        if let Some(parent) = chain.parent {
            // The parent's course is rounded where it bends, away from the node that the chain begins at.
            skeleton[0].0 = nearest(&branches[parent as usize].points, skeleton[0].0);
        }
        let mut skeleton = rounded(&skeleton);
        let parent = match (chain.parent, &stems) {
            (Some(parent), _) => Some(parent as usize),
            (None, Some(stems)) => stems.join(index, &mut skeleton),
            (None, None) => None,
        };
        if parent.is_none() {
            skeleton = with_foot(&skeleton, habit.flare);
        }
        branches.push(branch_along(skeleton, parent, chain.level));
    }
    let wood = Wood {
        tree,
        chains,
        names,
        at,
        diameters,
        grown,
        first: 0,
        age,
        tip: habit.tip,
        arrangement: habit.leaf.arrangement.unwrap_or(habit.arrangement),
        seed: simulation.seed(),
        simulation,
    };
    let (organs, templates) = foliage::leaves(limits.leaves, &wood, &habit.leaf);
    let buds = bloom::buds(limits.flower_buds, &wood, habit);
    let mut plant = Plant { branches, flowers: Vec::new(), organs, templates };
    plant.drop_unused_templates();
    debug_assert_eq!(plant.check_invariants(), Ok(()));
    debug_assert_eq!(buds.check_invariants(&plant), Ok(()));
    (PlantAtAge { plant, buds }, shown)
}

/// The nodes of a chain with the radii there, metres, from its base.
pub(super) fn skeleton_of(
    chain: &Chain,
    chains: &Chains,
    at: &[Vec3],
    diameters: &[f32],
) -> Vec<(Vec3, f32)> {
    let nodes = &chains.nodes[chain.range.0 as usize..chain.range.1 as usize];
    let mut skeleton: Vec<(Vec3, f32)> = Vec::with_capacity(2 * nodes.len());
    for (k, &node) in nodes.iter().enumerate() {
        let radius = |k: usize| nodes.get(k).map(|&n| 0.5 * diameters[n as usize]);
        // The first node's own diameter is the parent's.
        let below = if k == 0 { None } else { radius(k) };
        let above = radius(k + 1);
        let mean = match (below, above) {
            (Some(below), Some(above)) => below.midpoint(above),
            (one, other) => one.or(other).unwrap_or(f32::MIN_POSITIVE),
        };
        skeleton.push((if k == 0 { chain.foot } else { at[node as usize] }, mean));
    }
    if let (Some(_), Some(first)) = (chain.parent, skeleton.first_mut()) {
        first.1 = first.1.min(NARROWER * 0.5 * diameters[nodes[0] as usize]);
    }
    skeleton
}

/// The place on a line of at least two points that is nearest to a point.
fn nearest(line: &[Vec3], p: Vec3) -> Vec3 {
    let on = |w: &[Vec3]| {
        let along = w[1] - w[0];
        let share = (p - w[0]).dot(along) / along.length_squared().max(f32::MIN_POSITIVE);
        w[0] + along * share.clamp(0.0, 1.0)
    };
    let places = line.windows(2).map(on);
    places.min_by(|a, b| a.distance_squared(p).total_cmp(&b.distance_squared(p))).unwrap_or(p)
}

/// The branch along a skeleton: points that lie on each other become one, and a single point a short branch.
pub(super) fn branch_along(mut skeleton: Vec<(Vec3, f32)>, parent: Option<usize>, level: u32) -> Branch {
    skeleton.dedup_by(|b, a| a.0.distance_squared(b.0) <= (1e-3 * a.1).powi(2));
    if let [(base, radius)] = skeleton[..] {
        skeleton.push((base + Vec3::Y * radius.max(1e-5), radius));
    }
    Branch {
        origin: Origin::Generated,
        parent,
        level,
        points: skeleton.iter().map(|s| s.0).collect(),
        radii: skeleton.iter().map(|s| s.1.max(1e-6)).collect(),
        role: Role::of(WoodPart::Stem),
    }
}

/// A trunk with more points near the ground, where it widens; a stout one, as it is drawn, hardly does: its foot would be a skirt.
fn with_foot(skeleton: &[(Vec3, f32)], flare: f32) -> Vec<(Vec3, f32)> {
    let radius = skeleton[0].1;
    let length: f32 = skeleton.windows(2).map(|w| w[0].0.distance(w[1].0)).sum();
    let slender = (length / radius.max(f32::MIN_POSITIVE) - SLENDER.0) / (SLENDER.1 - SLENDER.0);
    let flare = flare * slender.clamp(0.0, 1.0);
    let mut out = Vec::with_capacity(skeleton.len() + FOOT.len());
    let mut walked = 0.0;
    let mut feet = FOOT.iter().map(|f| f * radius).peekable();
    let widened = |r: f32, height: f32| r * (1.0 + flare * (-1.3 * height / radius).exp());
    for w in skeleton.windows(2) {
        out.push((w[0].0, widened(w[0].1, walked)));
        let run = w[0].0.distance(w[1].0);
        while let Some(foot) = feet.next_if(|f| *f < walked + run) {
            let share = ((foot - walked) / run).clamp(0.0, 1.0);
            out.push((w[0].0.lerp(w[1].0, share), widened(w[0].1 + (w[1].1 - w[0].1) * share, foot)));
        }
        walked += run;
    }
    out.extend(skeleton.last().map(|s| (s.0, widened(s.1, walked))));
    out
}

#[cfg(test)]
#[path = "to_plant_tests.rs"]
mod tests;
