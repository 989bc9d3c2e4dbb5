//! A drawn plant with what grew on it.
//!
//! Drawn wood grows on; everything else that was drawn stays as it is: flowers and their stems, leaves and the wood that
//! outlines were filled with. Grown wood begins with the drawn wood, so what stood on a drawn branch now stands on the
//! grown one that runs through the same place, moved along with it where that was brought inside of a crown.

use super::drawing::Grown;
use crate::growth::at_age::chains::Chains;
use crate::growth::at_age::wood_at_age::WoodAtAge;
use crate::growth::at_age::{PlantAtAge, Younger, to_plant, wood_names};
use crate::growth::tree::NONE;
use crate::plant::{Branch, Continued, Plant, Provenance};
use glam::Vec3;
use std::collections::BTreeSet;

/// Which branches grow on: those drawn by hand that end in no flower, and whatever carries such.
pub fn grows(plant: &Plant) -> Vec<bool> {
    let mut grows: Vec<bool> = plant.branches.iter().map(|b| b.origin.is_drawn()).collect();
    for flower in &plant.flowers {
        if let Some(branch) = flower.branch {
            grows[branch] = false;
        }
    }
    for b in (0..plant.branches.len()).rev() {
        if let Some(parent) = plant.branches[b].parent.filter(|_| grows[b]) {
            grows[parent] = true;
        }
    }
    grows
}

/// The branches that grow on, numbered anew.
pub fn wood(plant: &Plant, grows: &[bool]) -> Vec<Branch> {
    let number = numbers(grows);
    let on = plant.branches.iter().zip(grows).filter(|(_, grows)| **grows);
    on.map(|(b, _)| Branch { parent: b.parent.and_then(|p| number[p]), ..b.clone() }).collect()
}

/// The number of each branch among those that grow on.
fn numbers(grows: &[bool]) -> Vec<Option<usize>> {
    let mut next = 0;
    let number = |grows: &bool| {
        grows.then(|| {
            next += 1;
            next - 1
        })
    };
    grows.iter().map(number).collect()
}

/// The drawn plant with what grew from its [`wood`], flower buds, each branch with its name, and which of the
/// `posed` branches, by their names, run on in others.
pub fn merged(
    (drawn, provenance): (Plant, &Provenance),
    grows: &[bool],
    grown: &Grown<'_>,
    (posed, younger): (&BTreeSet<u64>, &Younger),
) -> (PlantAtAge, Vec<Continued>) {
    let tree = grown.simulation.tree();
    let names = wood_names::names(tree, &wood_names::names_of_wood(grown.wood, provenance));
    let strokes: Vec<Option<u64>> =
        grown.wood.iter().map(|branch| provenance.stroke(branch.origin)).collect();
    let tree = younger.tree(tree, &names, &strokes, grown.age.ceil() as u16);
    let (PlantAtAge { mut plant, buds }, WoodAtAge { chains, at, .. }) =
        to_plant::with_wood(grown.simulation, &tree, grown.age, Some(&names));
    let of_tree = (&*tree, &chains, &*at);
    let continued = wood_names::name_branches(&mut plant.branches, of_tree, &names, posed);
    let on = GrownParents { grown, chains: &chains, number: numbers(grows), drawn: &drawn.branches };
    // Where a branch that stays now is, and how far it went in depth.
    let mut moved: Vec<Option<(usize, f32)>> = vec![None; drawn.branches.len()];
    for (b, branch) in drawn.branches.iter().enumerate().filter(|(b, _)| !grows[*b]) {
        let base = branch.points.first().copied().unwrap_or_default();
        let under = branch.parent.and_then(|p| moved[p].or_else(|| on.parent(p, base)));
        let (parent, by) = under.map_or((None, 0.0), |(parent, by)| (Some(parent), by));
        let level = parent.map_or(0, |p| plant.branches[p].level + 1);
        moved[b] = Some((plant.branches.len(), by));
        let mut kept = Branch { parent, level, ..branch.clone() };
        kept.points.iter_mut().for_each(|p| p.z += by);
        plant.branches.push(kept);
    }
    let now = |branch: Option<usize>, at: Vec3| branch.and_then(|b| moved[b].or_else(|| on.parent(b, at)));
    plant.flowers = drawn.flowers;
    for flower in &mut plant.flowers {
        let under = now(flower.branch, flower.cone.apex);
        flower.branch = under.map(|u| u.0);
        flower.cone.apex.z += under.map_or(0.0, |u| u.1);
    }
    let leaves = std::mem::replace(&mut plant.organs, drawn.organs);
    let of_leaves = std::mem::replace(&mut plant.templates, drawn.templates);
    for organ in &mut plant.organs {
        let under = now(organ.branch, organ.base());
        organ.branch = under.map(|u| u.0);
        organ.shape.translate(Vec3::Z * under.map_or(0.0, |u| u.1));
    }
    plant.add_organs(leaves, of_leaves);
    debug_assert_eq!(plant.check_invariants(), Ok(()));
    (PlantAtAge { plant, buds }, continued)
}

/// Finds the grown branch that runs where a drawn one ran.
struct GrownParents<'a> {
    grown: &'a Grown<'a>,
    chains: &'a Chains,
    number: Vec<Option<usize>>,
    drawn: &'a [Branch],
}

impl GrownParents<'_> {
    /// The branch through the place on drawn branch `b` nearest to `at`, and how far that went in depth.
    fn parent(&self, b: usize, at: Vec3) -> Option<(usize, f32)> {
        let tree = self.grown.simulation.tree();
        let number = self.number[b]?;
        let (before, after) = (&self.drawn[b].points, &self.grown.wood.get(number)?.points);
        let pairs = before.iter().zip(after);
        let near = pairs.min_by(|p, q| p.0.distance_squared(at).total_cmp(&q.0.distance_squared(at)));
        let by = near.map_or(0.0, |(before, after)| after.z - before.z);
        let (at, number) = (at + Vec3::Z * by, number as u32);
        let first = tree.drawn.partition_point(|d| *d < number);
        let end = tree.drawn.partition_point(|d| *d <= number);
        let away = |n: &usize| tree.nodes.at[*n].distance_squared(at);
        let lives = |n: &usize| self.chains.of_node.get(*n).is_some_and(|chain| *chain != NONE);
        let nearest = (first..end).filter(lives).min_by(|a, b| away(a).total_cmp(&away(b)))?;
        Some((self.chains.of_node[nearest] as usize, by))
    }
}
