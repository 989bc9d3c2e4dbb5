//! Branches that would grow through each other: the thinner one ends before.
//!
//! Wood thickens for as long as it lives, so what once passed close by comes to rub, and one of the two dies. Internodes
//! are capsules; of two that overlap the thinner is cut off with all that it carries, the thickest
//! wood first, so that nothing is cut for the sake of what is cut itself. Wood that was drawn is never cut.
//!
//! Around a fork everything overlaps. What lies near to the fork along the wood is left to the joint.
//!
//! Limits: where wood is so thick that all of it overlaps, there are more pairs than the budget has comparisons, and none is
//! cut. What both has to stay, and what touches only where chains are rounded, is left to [`aside`](super::aside).

use super::chains::Chains;
use super::fork::Wood;
use crate::budget::Budget;
use crate::geom::bvh::{Bounds, overlapping_within};
use crate::geom::capsule::Capsule;
use crate::growth::tree::Tree;
use crate::plant::junction::APART;
use glam::Vec3;
use rayon::prelude::*;

/// The nodes at which wood has to be cut so that none grows through thicker wood, besides those that are cut already.
/// What `stays` is never cut.
pub(super) fn cuts(
    chains: &Chains,
    tree: &Tree,
    (at, diameters): (&[Vec3], &[f32]),
    stays: impl Fn(u32) -> bool + Sync,
    already: &[u32],
) -> Vec<u32> {
    let wood = Wood { chains, tree, at };
    let mut pairs = pairs(&wood, diameters, stays);
    // The thickest wood decides first; among equals the oldest.
    let thickness = |pair: &(u32, u32)| diameters[pair.0 as usize];
    pairs.par_sort_unstable_by(|a, b| thickness(b).total_cmp(&thickness(a)).then(a.cmp(b)));
    let mut cut = vec![false; tree.len()];
    already.iter().for_each(|node| cut[*node as usize] = true);
    let mut cuts = Vec::new();
    for (stays, goes) in pairs {
        let is_cut = |node: u32| wood.down(node).any(|node| cut[node as usize]);
        if !is_cut(goes) && !is_cut(stays) {
            cut[goes as usize] = true;
            cuts.push(goes);
        }
    }
    cuts
}

/// Nodes whose internodes overlap, the one that stays first.
fn pairs(wood: &Wood<'_>, diameters: &[f32], stays: impl Fn(u32) -> bool + Sync) -> Vec<(u32, u32)> {
    let nodes: Vec<u32> = wood.shown().collect();
    let capsules: Vec<Capsule> = nodes.iter().map(|node| wood.internode(*node, diameters)).collect();
    let boxes: Vec<Bounds> = capsules.iter().map(|capsule| capsule.bounds(APART)).collect();
    let (any, each) = Budget::PLANT.overlaps;
    let overlapping = overlapping_within(any + each * nodes.len() as u64, &boxes, |i, j| {
        let (a, b) = (capsules[i], capsules[j]);
        if a.overlaps(&b, APART) { verdict(wood, (nodes[i], a), (nodes[j], b), &stays) } else { None }
    });
    overlapping.unwrap_or_default()
}

/// Which of two overlapping internodes stays and which goes; `None` if both stay.
fn verdict(
    wood: &Wood<'_>,
    (i, a): (u32, Capsule),
    (j, b): (u32, Capsule),
    is_kept: impl Fn(u32) -> bool,
) -> Option<(u32, u32)> {
    let (thicker, thinner) = if b.radius > a.radius { (j, i) } else { (i, j) };
    let (stays, goes) = if is_kept(thinner) { (thinner, thicker) } else { (thicker, thinner) };
    if is_kept(goes) {
        return None;
    }
    let near = wood.near(i, j, a.radius + b.radius);
    let (a, b) = match wood.fork(i, j, near) {
        Some([of_a, of_b]) => (of_a.beyond(a, near)?, of_b.beyond(b, near)?),
        None => (a, b),
    };
    a.overlaps(&b, APART).then_some((stays, goes))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::growth::at_age::chains::{Life, chains};
    use crate::growth::tree::{NONE, NewNode};
    use glam::vec3;

    /// A trunk of ten internodes of 0.3 m, and one branch on its sixth node that turns back into the trunk or away.
    fn tree(toward: f32) -> (Tree, Vec<Vec3>, Vec<f32>) {
        let mut tree = Tree::default();
        let mut node = |parent: u32, at: Vec3, lateral: bool| {
            let foot = parent == NONE;
            let side = Vec3::X;
            if foot {
                tree.add_foot(at, side)
            } else {
                tree.add(NewNode { parent, at, side, lateral, year: 1 })
            }
        };
        let mut last = node(NONE, Vec3::ZERO, false);
        let mut sixth = 0;
        for k in 1..=10u8 {
            last = node(last, Vec3::Y * 0.3 * f32::from(k), false);
            sixth = if k == 6 { last } else { sixth };
        }
        let out = node(sixth, vec3(0.6, 1.9, 0.0), true);
        let back = node(out, vec3(toward, 2.8, 0.0), false);
        node(back, vec3(toward - 0.2, 2.9, 0.0), false);
        let at = tree.nodes.at.clone();
        let diameters = (0..tree.len()).map(|n| if n <= 10 { 0.15 } else { 0.03 }).collect();
        (tree, at, diameters)
    }

    fn branches(toward: f32) -> Vec<usize> {
        let (tree, at, diameters) = tree(toward);
        let mut life = vec![Life::Living; tree.len()];
        let whole = chains(&tree, &life, &at, &diameters);
        let cuts = cuts(&whole, &tree, (&at, &diameters), |node| node <= 10, &[]);
        cuts.iter().for_each(|cut| life[*cut as usize..].fill(Life::Gone));
        chains(&tree, &life, &at, &diameters)
            .chains
            .iter()
            .map(|c| (c.range.1 - c.range.0) as usize)
            .collect()
    }

    #[test]
    fn a_branch_that_bends_into_its_trunk_ends_before_and_one_beside_it_stays() {
        assert_eq!(branches(0.0), [11, 2], "the trunk is whole, the branch keeps its first internode");
        assert_eq!(branches(0.9), [11, 4]);
    }
}
