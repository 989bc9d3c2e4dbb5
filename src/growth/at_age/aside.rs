//! Branches that still touch once wood is cut and chains are rounded: the thinner one bends aside.
//!
//! Wood that grows against other wood is led around it. Here the upper end of the internode that touches, or its lower
//! one if that is nearer, is moved away from the thicker branch by what is missing, with all that it carries; which may
//! touch something else, so that this is done a few times over. The course of branches is that of their rounded chains.
//!
//! Around a fork everything overlaps. Of a branch and the one that carries it what lies near to their fork is left to the
//! joint; of branches beside each other only where both are near to it.
//!
//! Limits: two that touch after [`ROUNDS`] cross. Where there are more pairs than the budget has comparisons, none is moved.
//! Drawn wood is not moved.

use super::chains::Chains;
use super::fork::{Fork, Wood};
use super::rounding;
use crate::budget::Budget;
use crate::geom::bvh::{Bounds, overlapping_within};
use crate::geom::capsule::Capsule;
use crate::growth::tree::{NONE, Tree};
use crate::plant::junction::APART;
use glam::Vec3;

/// How often what touches is moved.
const ROUNDS: usize = 6;
/// Least share of an internode below a place that is moved by moving the internode's upper end: below it what lies above
/// would go too far.
const LEVER: f32 = 0.5;

/// Moves what touches: gives nodes and the feet of chains their new places. Nothing is moved where the way `passes` through an obstacle.
pub(super) fn bend(
    tree: &Tree,
    chains: &mut Chains,
    at: &mut [Vec3],
    diameters: &[f32],
    passes: &dyn Fn(Vec3, Vec3) -> bool,
) {
    for _ in 0..ROUNDS {
        let ways = ways(&Wood { tree, chains, at }, diameters);
        if ways.is_empty() {
            return;
        }
        let mut whole = vec![Vec3::ZERO; chains.of_node.len()];
        let mut next = ways.iter().peekable();
        for node in 0..whole.len() {
            let parent = tree.nodes.parent[node];
            let own = next.next_if(|(of, _)| *of as usize == node).map_or(Vec3::ZERO, |(_, way)| *way);
            let way = own + if parent == NONE { Vec3::ZERO } else { whole[parent as usize] };
            whole[node] = if passes(at[node], at[node] + way) { Vec3::ZERO } else { way };
            at[node] += whole[node];
        }
        for chain in &mut chains.chains {
            chain.foot += whole[chains.nodes[chain.range.0 as usize] as usize];
        }
    }
}

/// A straight piece of the rounded internode below a node.
#[derive(Clone, Copy)]
struct Piece {
    node: u32,
    capsule: Capsule,
    /// Length of the internode before it and after it, metres.
    before: f32,
    after: f32,
}

impl Piece {
    /// The share of the internode below a place on this piece.
    fn share(&self, place: Vec3) -> f32 {
        let whole = self.before + self.capsule.length() + self.after;
        (self.before + self.capsule.from.distance(place)) / whole.max(f32::MIN_POSITIVE)
    }
}

/// Where two pieces touch.
#[derive(Clone, Copy)]
struct Touch {
    /// The places on the axes, and how far apart they should be, metres.
    places: [Vec3; 2],
    kept: f32,
}

/// The ways that nodes have to go with all that they carry, in the order of the nodes.
fn ways(wood: &Wood<'_>, diameters: &[f32]) -> Vec<(u32, Vec3)> {
    let pieces = pieces(wood, diameters);
    let boxes: Vec<Bounds> = pieces.iter().map(|piece| piece.capsule.bounds(APART)).collect();
    let (any, each) = Budget::PLANT.overlaps;
    let touching = overlapping_within(any + each * pieces.len() as u64, &boxes, |i, j| {
        let (a, b) = (&pieces[i], &pieces[j]);
        let touch = (a.node != b.node).then(|| touch(wood, a, b)).flatten()?;
        way(wood, [a, b], touch)
    });
    let mut ways = touching.unwrap_or_default();
    let far = |way: &(u32, Vec3)| way.1.length_squared();
    // Of several ways of one node the farthest; among those of one length any order, as long as it is always the same.
    ways.sort_unstable_by(|a, b| {
        let place = |way: &(u32, Vec3)| way.1.to_array().map(f32::to_bits);
        a.0.cmp(&b.0).then(far(b).total_cmp(&far(a))).then(place(a).cmp(&place(b)))
    });
    ways.dedup_by_key(|way| way.0);
    // A side branch goes with the place that it stands on; whether that is enough is seen the next time.
    let goes = |node: u32| ways.binary_search_by_key(&node, |way| way.0).is_ok();
    let is_carried = |node: u32| wood.is_first(node) && goes(wood.tree.nodes.parent[node as usize]);
    ways.iter().filter(|way| !is_carried(way.0)).copied().collect()
}

/// The pieces of all internodes.
fn pieces(wood: &Wood<'_>, diameters: &[f32]) -> Vec<Piece> {
    let Wood { chains, at, .. } = *wood;
    let mut out = Vec::with_capacity(2 * chains.nodes.len());
    for chain in &chains.chains {
        let nodes = &chains.nodes[chain.range.0 as usize..chain.range.1 as usize];
        let place = |k: usize| if k == 0 { chain.foot } else { at[nodes[k] as usize] };
        for k in 1..nodes.len() {
            let (node, radius) = (nodes[k], 0.5 * diameters[nodes[k] as usize]);
            let (from, to) = (place(k - 1), place(k));
            let middle = rounding::middle(k - 1, nodes.len(), place);
            let piece = |from: Vec3, to: Vec3| Capsule { from, to, radius };
            let (lower, upper) = (piece(from, middle.unwrap_or(to)), piece(middle.unwrap_or(to), to));
            let after = upper.length();
            out.push(Piece { node, capsule: lower, before: 0.0, after });
            if middle.is_some() {
                out.push(Piece { node, capsule: upper, before: lower.length(), after: 0.0 });
            }
        }
    }
    out
}

/// Where two pieces touch away from their fork.
fn touch(wood: &Wood<'_>, one: &Piece, other: &Piece) -> Option<Touch> {
    let (a, b) = (one.capsule, other.capsule);
    if !a.overlaps(&b, APART) {
        return None;
    }
    let radii = a.radius + b.radius;
    let near = wood.near(one.node, other.node, radii);
    let touch = |a: Option<Capsule>, b: Option<Capsule>| {
        let (a, b) = (a?, b?);
        let (p, q) = a.nearest(&b);
        a.overlaps(&b, APART).then_some(Touch { places: [p, q], kept: APART * radii })
    };
    let Some([of_a, of_b]) = wood.fork(one.node, other.node, near) else { return touch(Some(a), Some(b)) };
    let beyond =
        |fork: Fork, piece: &Piece| fork.of_piece(piece.before, piece.after).beyond(piece.capsule, near);
    let (beyond_a, beyond_b) = (beyond(of_a, one), beyond(of_b, other));
    if wood.is_joined(one.node, other.node) {
        touch(beyond_a, beyond_b)
    } else {
        touch(beyond_a, Some(b)).or_else(|| touch(Some(a), beyond_b))
    }
}

/// The node that has to go, with all that it carries, so that two pieces no longer touch; and its way.
fn way(wood: &Wood<'_>, pieces: [&Piece; 2], touch: Touch) -> Option<(u32, Vec3)> {
    let carries = |lower: u32, upper: u32| wood.down(upper).any(|node| node == lower);
    let goes = |k: usize| {
        let (own, other) = (pieces[k], pieces[1 - k]);
        let thickness = |piece: &Piece| (piece.capsule.radius, std::cmp::Reverse(piece.node));
        let stays = (own.node as usize) < wood.tree.drawn.len() || carries(own.node, other.node);
        (!stays).then_some(thickness(own))
    };
    let k = match (goes(0), goes(1)) {
        (Some(a), Some(b)) => usize::from(b < a),
        (Some(_), None) => 0,
        (None, Some(_)) => 1,
        (None, None) => return None,
    };
    let (own, other) = (pieces[k], pieces[1 - k]);
    let (place, from) = (touch.places[k], touch.places[1 - k]);
    let apart = place.distance(from);
    let axis = (other.capsule.to - other.capsule.from).cross(own.capsule.to - own.capsule.from);
    let away = (place - from).try_normalize().unwrap_or_else(|| axis.normalize_or(Vec3::X));
    let way = away * (touch.kept - apart);
    let (share, lower) = (own.share(place), wood.tree.nodes.parent[own.node as usize]);
    let is_first = wood.is_first(own.node);
    let is_drawn = (lower as usize) < wood.tree.drawn.len();
    if share < LEVER && !is_first && !is_drawn && !carries(lower, other.node) {
        return Some((lower, way));
    }
    Some((own.node, way / share.max(LEVER)))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
mod tests {
    use super::*;
    use crate::growth::at_age::chains;
    use crate::growth::tree::NewNode;
    use glam::vec3;

    #[test]
    fn a_branch_that_touches_its_trunk_is_led_past_it_with_what_it_carries() {
        let mut tree = Tree::default();
        let mut last = tree.add_foot(Vec3::ZERO, Vec3::X);
        let mut add = |parent, at, lateral| tree.add(NewNode { parent, at, side: Vec3::X, lateral, year: 1 });
        let mut trunk = vec![last];
        for k in 1..=12u8 {
            last = add(last, Vec3::Y * 0.3 * f32::from(k), false);
            trunk.push(last);
        }
        let out = add(trunk[4], vec3(0.7, 1.4, 0.0), true);
        let back = add(out, vec3(0.05, 2.7, 0.01), false);
        let end = add(back, vec3(0.3, 3.2, 0.0), false);
        let side = add(back, vec3(0.5, 2.8, 0.3), true);
        let diameters: Vec<f32> = (0..tree.len()).map(|n| if n <= 12 { 0.1 } else { 0.03 }).collect();
        let mut at = tree.nodes.at.clone();
        let mut chains = chains::chains(&tree, &chains::life(&tree, 1, |_| 0.0), &at, &diameters);
        bend(&tree, &mut chains, &mut at, &diameters, &|_, _| false);
        let moved = |n: u32| at[n as usize] - tree.nodes.at[n as usize];
        assert!(trunk.iter().chain([&out]).all(|n| moved(*n) == Vec3::ZERO), "what is thick or far stays");
        assert!(moved(back).x > 0.015 && moved(back).length() < 0.1, "{}", moved(back));
        assert!([end, side].iter().all(|n| moved(*n).distance(moved(back)) < 1e-6));
        let wood = Wood { tree: &tree, chains: &chains, at: &at };
        assert!(ways(&wood, &diameters).iter().all(|(_, way)| way.length() < 1e-4), "nothing touches");
        let foot = chains.chains.iter().find(|chain| chains.nodes[chain.range.0 as usize] == back);
        assert_eq!(foot.unwrap().foot, at[back as usize], "the side shoot still stands on it");
    }
}
