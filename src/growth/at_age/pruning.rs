//! Wood without room is cut: the chains of an age, and places for all of them.
//!
//! Branches that find no bark to stand on ([`insertion`]), and those that would grow through thicker ones ([`rubbing`]),
//! are cut with all that they carry. Where a parent is cut short, the thickest of what is left on its end goes on with
//! it, so chains are followed anew after that.
//!
//! Drawn wood, limbs that make the crown and the feet of trunks are never cut.

use super::chains::{Chains, Life, chains};
use super::insertion;
use super::rubbing;
use crate::growth::tree::{NONE, Tree};
use glam::Vec3;

/// Wood thicker than this share of the one trunk that could stand for all is spared. A smaller share spares limbs
/// of olives that grow through each other; a larger one lets crowns lose limbs that are missed.
const SPARED: f32 = 0.3;
/// Wood up to so many times as thick as the thinnest is no limb, however young the plant: all of a young bush is that thick.
const TWIG: f32 = 2.5;
/// How often what is left is looked at again: what is cut makes room, but chains that go on elsewhere want some.
const ROUNDS: usize = 2;

/// The wood that is there and whose nodes stand at these places, pruned; and the places where it then stands. `life` is as
/// for [`chains`].
pub(super) fn pruned(
    tree: &Tree,
    mut life: Vec<Life>,
    places: &[Vec3],
    diameters: &[f32],
    pipe: f32,
) -> (Chains, Vec<Vec3>) {
    let tip = diameters.iter().copied().filter(|d| *d > 0.0).fold(f32::INFINITY, f32::min);
    let spared = (SPARED * trunk_for_all(tree, diameters, pipe)).max(TWIG * tip);
    let stays = |node: u32| {
        let (node, is_drawn) = (node as usize, (node as usize) < tree.drawn.len());
        is_drawn || diameters[node] > spared || stands_on_foot(tree, node)
    };
    for _ in 0..ROUNDS {
        let (wood, at, crowded) = settled(tree, &life, (places, diameters), stays);
        let mut cut: Vec<u32> = crowded.iter().map(|c| wood.first(*c)).filter(|node| !stays(*node)).collect();
        cut.extend(rubbing::cuts(&wood, tree, (&at, diameters), stays, &cut));
        if cut.is_empty() {
            return (wood, at);
        }
        fell(tree, &mut life, &cut);
    }
    let (wood, at, _) = settled(tree, &life, (places, diameters), |_| true);
    (wood, at)
}

/// The chains of what is there, the places of their nodes once each has found its stand, and the chains that found none.
fn settled(
    tree: &Tree,
    life: &[Life],
    (places, diameters): (&[Vec3], &[f32]),
    stays: impl Fn(u32) -> bool,
) -> (Chains, Vec<Vec3>, Vec<u32>) {
    let mut at = places.to_vec();
    let mut wood = chains(tree, life, &at, diameters);
    let crowded = insertion::settle(&mut wood, tree, &mut at, diameters, stays);
    (wood, at, crowded)
}

/// Takes some nodes away with all that stands on them.
fn fell(tree: &Tree, life: &mut [Life], cut: &[u32]) {
    cut.iter().for_each(|node| life[*node as usize] = Life::Gone);
    for n in 0..life.len() {
        let parent = tree.nodes.parent[n];
        if parent != NONE && life[parent as usize] == Life::Gone {
            life[n] = Life::Gone;
        }
    }
}

/// Whether a node is the first above the ground.
fn stands_on_foot(tree: &Tree, node: usize) -> bool {
    let below = tree.nodes.parent[node];
    below != NONE && tree.nodes.parent[below as usize] == NONE
}

/// The diameter of the one trunk that could carry what all trunks carry, by the pipe model of exponent `pipe`.
fn trunk_for_all(tree: &Tree, diameters: &[f32], pipe: f32) -> f32 {
    let trunks = (0..diameters.len()).filter(|n| stands_on_foot(tree, *n));
    trunks.map(|trunk| diameters[trunk].powf(pipe)).sum::<f32>().powf(1.0 / pipe)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::growth::at_age::chains::life;
    use crate::growth::tree::NewNode;
    use glam::vec3;

    #[test]
    fn where_a_branch_is_cut_its_side_shoot_goes_on() {
        let mut tree = Tree::default();
        let mut last = tree.add_foot(Vec3::ZERO, Vec3::X);
        let mut add = |parent, at, lateral| tree.add(NewNode { parent, at, side: Vec3::X, lateral, year: 1 });
        let mut trunk = vec![last];
        for k in 1..=10u8 {
            last = add(last, Vec3::Y * 0.3 * f32::from(k), false);
            trunk.push(last);
        }
        let branch = add(trunk[6], vec3(0.6, 1.9, 0.0), true);
        let into_trunk = add(branch, vec3(0.0, 2.8, 0.0), false);
        let beyond = add(into_trunk, vec3(-0.2, 2.9, 0.0), false);
        let side = add(branch, vec3(1.0, 2.2, 0.2), true);
        let at = tree.nodes.at.clone();
        let diameters: Vec<f32> = (0..tree.len()).map(|n| if n <= 10 { 0.15 } else { 0.03 }).collect();
        let (wood, placed) = pruned(&tree, life(&tree, 1, |_| 0.0), &at, &diameters, 2.3);
        assert_eq!(wood.nodes[11..], [trunk[6], branch, side], "{:?}", wood.chains);
        assert!(wood.of_node[into_trunk as usize] == NONE && wood.of_node[beyond as usize] == NONE);
        assert_eq!(placed, at, "there was room for all");
    }
}
