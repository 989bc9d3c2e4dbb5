//! What grew on wood that was there before, without that wood: for growth on a plant whose own wood stays as it is.
//!
//! The nodes of the wood before come first in a tree and belong to its branches. A chain that begins among them, or runs on from
//! one of their ends, becomes a branch on the branch of the node that it leaves. New wood is never thicker than [`NARROWER`] of
//! what it stands on, because that is not made thicker for it.

use super::bloom;
use super::chains::{Chain, Chains};
use super::foliage::{self, Wood};
use super::rounding::rounded;
use super::to_plant::{NARROWER, PlantAtAge, branch_along, skeleton_of};
use super::wood_at_age::{WoodAtAge, wood_at_age};
use super::wood_names;
use crate::growth::simulation::Simulation;
use crate::plant::{Branch, FlowerBuds, GrownId, Organ, Origin, Templates};
use glam::Vec3;

/// Adds what a simulation grew to the plant on which it grew. `wood` are the branches of the plant that the simulation began
/// with, in its order, each with the name by which new branches are called; `give_forms` may make new leaves copies of other
/// templates, and gives those.
pub(crate) fn add_new_growth(
    to: &mut PlantAtAge,
    (wood, names): (&[usize], &[u64]),
    simulation: &Simulation,
    give_forms: impl Fn(&mut [Organ], Templates) -> Templates,
) {
    let (tree, habit, limits) = (simulation.tree(), simulation.habit(), simulation.limits());
    let age = f32::from(simulation.age());
    let WoodAtAge { chains, at, diameters, grown } = wood_at_age(simulation, tree, age);
    let first = tree.drawn.len();
    let names = wood_names::names(tree, names);
    let mut place_of: Vec<Option<usize>> = vec![None; chains.chains.len()];
    for (index, chain) in chains.chains.iter().enumerate() {
        let Some(new) = new_part(chain, &chains, first, &at) else { continue };
        let below = chains.nodes[new.range.0 as usize] as usize;
        let parent = match tree.drawn.get(below) {
            Some(number) => Some(wood[*number as usize]),
            None => place_of[chains.of_node[below] as usize],
        };
        let Some(parent) = parent else { continue };
        let skeleton = skeleton_of(&new, &chains, &at, &diameters);
        place_of[index] = Some(to.plant.branches.len());
        let first = chains.nodes[new.range.0 as usize + 1] as usize;
        let origin = Origin::Grown(GrownId(names[first]));
        let branch = branch_on(&to.plant.branches, parent, skeleton);
        to.plant.branches.push(Branch { origin, ..branch });
    }
    let of_wood = Wood {
        tree,
        chains: &chains,
        names: Some(&names),
        at: &at,
        diameters: &diameters,
        grown: &grown,
        first,
        age,
        tip: habit.tip,
        arrangement: habit.leaf.arrangement.unwrap_or(habit.arrangement),
        seed: simulation.seed(),
        simulation,
    };
    let (mut leaves, templates) = foliage::leaves(limits.leaves, &of_wood, &habit.leaf);
    let mut buds = bloom::buds(limits.flower_buds, &of_wood, habit);
    leaves.iter_mut().for_each(|leaf| leaf.branch = leaf.branch.and_then(|chain| place_of[chain]));
    buds.buds.iter_mut().for_each(|bud| bud.branch = bud.branch.and_then(|chain| place_of[chain]));
    let templates = give_forms(&mut leaves, templates);
    to.plant.add_organs(leaves, templates);
    to.plant.drop_unused_templates();
    add_buds(&mut to.buds, buds);
    debug_assert_eq!(to.plant.check_invariants(), Ok(()));
    debug_assert_eq!(to.buds.check_invariants(&to.plant), Ok(()));
}

fn add_buds(to: &mut FlowerBuds, new: FlowerBuds) {
    to.buds.extend(new.buds);
    to.is_thinned |= new.is_thinned;
}

/// The part of a chain that is new, from the node that it leaves; `None` where all of it was there before.
fn new_part(chain: &Chain, chains: &Chains, first: usize, at: &[Vec3]) -> Option<Chain> {
    let nodes = &chains.nodes[chain.range.0 as usize..chain.range.1 as usize];
    let new = nodes.iter().skip(1).position(|node| *node as usize >= first)? + 1;
    let foot = if new == 1 { chain.foot } else { at[nodes[new - 1] as usize] };
    let range = (chain.range.0 + new as u32 - 1, chain.range.1);
    // Whatever carries it, it is no trunk.
    Some(Chain { parent: Some(chain.parent.unwrap_or(0)), range, foot, ..*chain })
}

/// The branch along a skeleton, moved at its foot to the axis of the branch on which it stands.
fn branch_on(branches: &[Branch], parent: usize, mut skeleton: Vec<(Vec3, f32)>) -> Branch {
    let on = &branches[parent];
    let (foot, radius) = on.axis_at(skeleton[0].0);
    skeleton[0].0 = foot;
    let mut branch = branch_along(rounded(&skeleton), Some(parent), on.level + 1);
    branch.radii.iter_mut().for_each(|r| *r = r.min(NARROWER * radius));
    branch
}
