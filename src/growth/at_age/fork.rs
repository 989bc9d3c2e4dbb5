//! Where the wood of two internodes parts: around a fork everything overlaps, and that is the joint's.
//!
//! From both internodes one goes down along the wood until the ways meet. What lies near to that place, along the wood and
//! in the sum of the two radii, belongs to the fork.

use super::chains::Chains;
use crate::geom::capsule::Capsule;
use crate::growth::tree::{NONE, Tree};
use glam::Vec3;

/// How much of two branches belongs to their fork, in the sum of their radii: of a branch and its parent, whose
/// surfaces are joined, and of two that leave one parent. More would hide branches that curl back, less count those that
/// leave by a small angle.
const JOINED: f32 = 7.0;
const BESIDE: f32 = 4.0;

/// The wood of a plant.
#[derive(Clone, Copy)]
pub(super) struct Wood<'a> {
    pub(super) tree: &'a Tree,
    pub(super) chains: &'a Chains,
    /// Places of the nodes.
    pub(super) at: &'a [Vec3],
}

/// Where the fork of two internodes lies, seen from one of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fork {
    /// So many metres along the wood below its lower end.
    Below(f32),
    /// So many metres along the wood above its upper end.
    Above(f32),
}

impl Fork {
    /// The same seen from a piece of the internode, before and after which so many metres of it lie.
    pub(super) fn of_piece(self, before: f32, after: f32) -> Self {
        match self {
            Self::Below(under) => Self::Below(under + before),
            Self::Above(over) => Self::Above(over + after),
        }
    }

    /// What of an internode is farther than `near` from the fork.
    pub(super) fn beyond(self, internode: Capsule, near: f32) -> Option<Capsule> {
        match self {
            Self::Below(under) => internode.above(near - under),
            Self::Above(over) => internode.below(near - over),
        }
    }
}

impl<'a> Wood<'a> {
    /// The internode below a node.
    pub(super) fn internode(&self, node: u32, diameters: &[f32]) -> Capsule {
        let n = node as usize;
        let from = self.chains.below(n, self.tree, self.at);
        Capsule { from, to: self.at[n], radius: 0.5 * diameters[n] }
    }

    /// Nodes that are shown.
    pub(super) fn shown(&self) -> impl Iterator<Item = u32> + use<'a> {
        let of_node = &self.chains.of_node;
        (0..of_node.len() as u32).filter(|node| of_node[*node as usize] != NONE)
    }

    /// A node and those below it.
    pub(super) fn down(&self, node: u32) -> impl Iterator<Item = u32> + use<'a> {
        let parents = &self.tree.nodes.parent;
        std::iter::successors(Some(node), |n| Some(parents[*n as usize]).filter(|p| *p != NONE))
    }

    /// Whether the internode below a node is the first of its chain.
    pub(super) fn is_first(&self, node: u32) -> bool {
        self.chains.first(self.chains.of_node[node as usize]) == node
    }

    /// Whether two internodes belong to one chain, or to a chain and the one that carries it.
    pub(super) fn is_joined(&self, i: u32, j: u32) -> bool {
        let (of_i, of_j) = (self.chains.of_node[i as usize], self.chains.of_node[j as usize]);
        let carries = |upper: u32, lower: u32| self.chains.chains[upper as usize].parent == Some(lower);
        of_i == of_j || carries(of_i, of_j) || carries(of_j, of_i)
    }

    /// How much of two internodes, of which `radii` is the sum of the radii, belongs to their fork, metres along the wood.
    pub(super) fn near(&self, i: u32, j: u32, radii: f32) -> f32 {
        radii * if self.is_joined(i, j) { JOINED } else { BESIDE }
    }

    /// Where the fork of two internodes lies, seen from each; `None` if that is farther than `near` below one of them.
    pub(super) fn fork(&self, i: u32, j: u32, near: f32) -> Option<[Fork; 2]> {
        let parent = |node: u32| self.tree.nodes.parent[node as usize];
        // Down from the later of both until the ways meet, at the upper end of one or below both.
        let (mut x, mut y) = (parent(i), parent(j));
        let (mut under_i, mut under_j) = (0.0f32, 0.0f32);
        while under_i.max(under_j) <= near {
            if x == j {
                return Some([Fork::Below(under_i), Fork::Above(0.0)]);
            }
            if y == i {
                return Some([Fork::Above(0.0), Fork::Below(under_j)]);
            }
            let (below_x, below_y) = (parent(x), parent(y));
            // Trunks that come out of the ground side by side part there.
            if x == y || (below_x == NONE && below_y == NONE) {
                return Some([Fork::Below(under_i), Fork::Below(under_j)]);
            }
            let is_x = below_y == NONE || (below_x != NONE && x > y);
            let (later, under, next) =
                if is_x { (&mut x, &mut under_i, below_x) } else { (&mut y, &mut under_j, below_y) };
            *under += self.at[*later as usize].distance(self.at[next as usize]);
            *later = next;
        }
        None
    }
}
