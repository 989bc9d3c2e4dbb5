//! Branches that would grow through each other: the thinner one ends before.
//!
//! Wood thickens for as long as it lives, so what once passed close by comes to rub, and one of the two dies. Internodes
//! are capsules; of two that overlap the thinner is cut off with all that it carries, the thickest
//! wood first, so that nothing is cut for the sake of what is cut itself. Wood that was drawn is never cut.
//!
//! Around a fork everything overlaps. What lies near to the fork along the wood is left to the joint.
//!
//! Limits: where wood is so thick that all of it overlaps, there are more pairs than the budget has comparisons, and none is
//! cut. Two that both have to stay cross. Chains are rounded after this; twigs may still touch where they
//! turn sharply.

use super::chains::Chains;
use crate::budget::Budget;
use crate::geom::meetings::{Bounds, meetings_within};
use crate::growth::tree::{NONE, Tree};
use glam::Vec3;
use rayon::prelude::*;

/// Distance that two branches keep, in the sum of their radii: surfaces are a little wider than the wood in places.
const KEPT: f32 = 1.2;
/// How much of two branches belongs to their fork, in the sum of their radii: of a branch and its parent, whose
/// surfaces are joined, and of two that leave one parent. More would hide branches that curl back, less cut those that
/// leave by a small angle.
const JOINED: f32 = 7.0;
const BESIDE: f32 = 4.0;

/// The nodes at which wood has to be cut so that none grows through thicker wood, besides those that are cut already.
/// What `stays` is never cut.
pub(super) fn cuts(
    chains: &Chains,
    tree: &Tree,
    (at, diameters): (&[Vec3], &[f32]),
    stays: impl Fn(u32) -> bool + Sync,
    already: &[u32],
) -> Vec<u32> {
    let wood = Wood { chains, tree, at, diameters, stays };
    let mut pairs = wood.pairs();
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

/// An internode as a capsule.
#[derive(Clone, Copy)]
struct Capsule {
    from: Vec3,
    to: Vec3,
    radius: f32,
}

struct Wood<'a, F> {
    chains: &'a Chains,
    tree: &'a Tree,
    at: &'a [Vec3],
    diameters: &'a [f32],
    /// Whether the wood of a node is never cut.
    stays: F,
}

impl<F: Fn(u32) -> bool + Sync> Wood<'_, F> {
    fn capsule(&self, node: u32) -> Capsule {
        let n = node as usize;
        let from = self.chains.below(n, self.tree, self.at);
        Capsule { from, to: self.at[n], radius: 0.5 * self.diameters[n] }
    }

    /// A node and those below it.
    fn down(&self, node: u32) -> impl Iterator<Item = u32> {
        std::iter::successors(Some(node), |n| {
            Some(self.tree.nodes.parent[*n as usize]).filter(|p| *p != NONE)
        })
    }

    /// Nodes whose internodes overlap, the one that stays first.
    fn pairs(&self) -> Vec<(u32, u32)> {
        let lives = |node: &u32| self.chains.of_node[*node as usize] != NONE;
        let nodes: Vec<u32> = (0..self.chains.of_node.len() as u32).filter(lives).collect();
        let capsules: Vec<Capsule> = nodes.iter().map(|node| self.capsule(*node)).collect();
        let boxes: Vec<Bounds> = capsules.iter().map(Capsule::bounds).collect();
        let (any, each) = Budget::PLANT.overlaps;
        let overlapping = meetings_within(any + each * nodes.len() as u64, &boxes, |i, j| {
            let (a, b) = (capsules[i], capsules[j]);
            if a.overlaps(&b, KEPT) { self.verdict((nodes[i], a), (nodes[j], b)) } else { None }
        });
        overlapping.unwrap_or_default()
    }

    /// Which of two overlapping internodes stays and which goes; `None` if both stay.
    fn verdict(&self, (i, a): (u32, Capsule), (j, b): (u32, Capsule)) -> Option<(u32, u32)> {
        let (thicker, thinner) = if b.radius > a.radius { (j, i) } else { (i, j) };
        let (stays, goes) = if (self.stays)(thinner) { (thinner, thicker) } else { (thicker, thinner) };
        if (self.stays)(goes) {
            return None;
        }
        let (of_i, of_j) = (self.chains.of_node[i as usize], self.chains.of_node[j as usize]);
        let carries = |upper: u32, lower: u32| self.chains.chains[upper as usize].parent == Some(lower);
        let is_joined = of_i == of_j || carries(of_i, of_j) || carries(of_j, of_i);
        let near = (if is_joined { JOINED } else { BESIDE }) * (a.radius + b.radius);
        let (a, b) = self.beyond_fork((i, a), (j, b), near)?;
        a.overlaps(&b, KEPT).then_some((stays, goes))
    }

    /// What of two internodes lies farther than `near` from the fork where they part; `None` if nothing of one does.
    fn beyond_fork(
        &self,
        (i, a): (u32, Capsule),
        (j, b): (u32, Capsule),
        near: f32,
    ) -> Option<(Capsule, Capsule)> {
        let parent = |node: u32| self.tree.nodes.parent[node as usize];
        // Down from the later of both until the ways meet, at the upper end of one or below both.
        let (mut x, mut y) = (parent(i), parent(j));
        let (mut under_a, mut under_b) = (0.0f32, 0.0f32);
        while under_a.max(under_b) <= near {
            if x == j {
                return Some((a.above(near - under_a)?, b.below(near)?));
            }
            if y == i {
                return Some((a.below(near)?, b.above(near - under_b)?));
            }
            if x == y {
                return Some((a.above(near - under_a)?, b.above(near - under_b)?));
            }
            let (below_x, below_y) = (parent(x), parent(y));
            if below_x == NONE && below_y == NONE {
                // Trunks that come out of the ground side by side part there.
                return Some((a.above(near - under_a)?, b.above(near - under_b)?));
            }
            let is_x = below_y == NONE || (below_x != NONE && x > y);
            let (later, under, next) =
                if is_x { (&mut x, &mut under_a, below_x) } else { (&mut y, &mut under_b, below_y) };
            *under += self.at[*later as usize].distance(self.at[next as usize]);
            *later = next;
        }
        Some((a, b))
    }
}

impl Capsule {
    /// Two whose boxes are apart do not overlap.
    fn bounds(&self) -> Bounds {
        let wide = Vec3::splat(KEPT * self.radius);
        (self.from.min(self.to) - wide, self.from.max(self.to) + wide)
    }

    /// The part farther than a distance from the lower end.
    fn above(self, distance: f32) -> Option<Self> {
        let length = self.from.distance(self.to);
        (distance < length)
            .then(|| Self { from: self.from.lerp(self.to, distance.max(0.0) / length), ..self })
    }

    /// The part farther than a distance from the upper end.
    fn below(self, distance: f32) -> Option<Self> {
        let turned = Self { from: self.to, to: self.from, ..self };
        turned.above(distance).map(|part| Self { from: part.to, to: part.from, ..part })
    }

    /// Whether two are nearer than a multiple of the sum of their radii.
    fn overlaps(&self, other: &Self, kept: f32) -> bool {
        let reach = kept * (self.radius + other.radius);
        squared_distance((self.from, self.to), (other.from, other.to)) < reach * reach
    }
}

/// Squared distance of two segments.
fn squared_distance((a, b): (Vec3, Vec3), (c, d): (Vec3, Vec3)) -> f32 {
    let (along, other, off) = (b - a, d - c, a - c);
    let (aa, bb, ab) = (along.length_squared(), other.length_squared(), along.dot(other));
    let (a_off, b_off) = (along.dot(off), other.dot(off));
    let det = aa * bb - ab * ab;
    // Nearest on the lines, then each share kept within its segment.
    let s = if det > 1e-9 * aa * bb { ((ab * b_off - bb * a_off) / det).clamp(0.0, 1.0) } else { 0.0 };
    let t = if bb > 0.0 { ((ab * s + b_off) / bb).clamp(0.0, 1.0) } else { 0.0 };
    let s = if aa > 0.0 { ((ab * t - a_off) / aa).clamp(0.0, 1.0) } else { 0.0 };
    (off + along * s - other * t).length_squared()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::growth::at_age::chains::chains;
    use crate::growth::tree::NewNode;
    use glam::vec3;

    #[test]
    fn distances_of_segments_are_those_of_their_nearest_points() {
        let x = (Vec3::ZERO, Vec3::X);
        assert_eq!(squared_distance(x, (vec3(0.5, 1.0, -1.0), vec3(0.5, 1.0, 1.0))), 1.0);
        assert_eq!(squared_distance(x, (vec3(3.0, 0.0, 0.0), vec3(4.0, 5.0, 0.0))), 4.0);
        assert_eq!(squared_distance(x, (vec3(0.0, 2.0, 0.0), vec3(1.0, 2.0, 0.0))), 4.0);
        assert_eq!(squared_distance(x, (vec3(-1.0, 0.0, 0.0), vec3(-1.0, 0.0, 0.0))), 1.0);
    }

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
        let mut lives = vec![true; tree.len()];
        let whole = chains(&tree, &lives, &at, &diameters);
        let cuts = cuts(&whole, &tree, (&at, &diameters), |node| node <= 10, &[]);
        cuts.iter().for_each(|cut| lives[*cut as usize..].fill(false));
        chains(&tree, &lives, &at, &diameters)
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
