//! Where branches are inserted in their parents: each has bark of its own.
//!
//! Buds of a whorl share a node, and wood that has thickened outgrows short internodes: what botany calls a whorl is a
//! close spiral. Where branches would overlap on their parent, the thinner ones go up or down along it by as little as
//! clears them, with all that they carry.
//!
//! Limits: a branch stays on the halves of the internodes next to its node; one that finds no place there stays where it
//! is and is named to the caller.

use super::chains::{Chain, Chains};
use crate::growth::tree::Tree;
use crate::plant::junction::{BESIDE_RAD, Footprint, KEPT_FREE, LEAST_SINE, half_angle};
use glam::Vec3;
use std::f32::consts::PI;

/// Branches are opposite if less than this is missing to half a turn, radians.
const OPPOSITE: f32 = 0.15;
/// Share of the internodes next to the node that branches may go along.
const REACH: f32 = 0.5;

/// Moves whatever shares bark: gives nodes and the feet of chains their new places. Returns the chains that found none.
/// What was drawn stays where it was drawn, and a chain without room takes none unless its first node `stays`.
pub(super) fn settle(
    chains: &mut Chains,
    tree: &Tree,
    at: &mut [Vec3],
    diameters: &[f32],
    stays: impl Fn(u32) -> bool,
) -> Vec<u32> {
    let (own, crowded) = ways(chains, tree, (at, diameters), stays);
    let mut whole: Vec<Vec3> = Vec::with_capacity(own.len());
    for (chain, own) in chains.chains.iter_mut().zip(own) {
        let way = own + chain.parent.map_or(Vec3::ZERO, |parent| whole[parent as usize]);
        whole.push(way);
        chain.foot += way;
        let nodes = &chains.nodes[chain.range.0 as usize + 1..chain.range.1 as usize];
        nodes.iter().for_each(|node| at[*node as usize] += way);
    }
    crowded
}

/// The way of each chain along its parent, and the chains that have no room.
fn ways(
    chains: &Chains,
    tree: &Tree,
    (at, diameters): (&[Vec3], &[f32]),
    stays: impl Fn(u32) -> bool,
) -> (Vec<Vec3>, Vec<u32>) {
    let mut ways = vec![Vec3::ZERO; chains.chains.len()];
    let mut crowded = Vec::new();
    let first = |c: u32| chains.first(c) as usize;
    let mut carried: Vec<(u32, u32)> =
        (0..).zip(&chains.chains).filter_map(|(c, chain)| Some((chain.parent?, c))).collect();
    let is_drawn = |c: u32| first(c) < tree.drawn.len();
    carried.sort_unstable_by(|&(p, a), &(q, b)| {
        let thickness = diameters[first(b)].total_cmp(&diameters[first(a)]);
        p.cmp(&q).then(is_drawn(b).cmp(&is_drawn(a))).then(thickness).then(a.cmp(&b))
    });
    let mut parent_line = ParentLine::default();
    for siblings in carried.chunk_by(|a, b| a.0 == b.0) {
        parent_line.survey(chains, siblings[0].0, at);
        let mut insertions = Insertions::default();
        for &(_, c) in siblings {
            let number = chains.nodes[chains.chains[c as usize].range.0 as usize];
            let (foot, of_parent) = (at[number as usize], diameters[number as usize]);
            let node = parent_line.node(number);
            let mut insertion = node.insertion(at[first(c)] - foot, diameters[first(c)], of_parent);
            if !is_drawn(c) {
                match insertions.free(&insertion, &node) {
                    Some(along) => {
                        ways[c as usize] = node.way(along - insertion.along);
                        insertion.along = along;
                    }
                    None => {
                        crowded.push(c);
                        // What will be cut takes no room.
                        if !stays(first(c) as u32) {
                            continue;
                        }
                    }
                }
            }
            insertions.insert(insertion);
        }
    }
    (ways, crowded)
}

/// The parent chain, as a line.
#[derive(Default)]
struct ParentLine {
    /// Its nodes in ascending order, with their place in `line`.
    order: Vec<(u32, u32)>,
    /// Place of each node and the length of the chain before it, metres.
    line: Vec<(Vec3, f32)>,
}

impl ParentLine {
    fn survey(&mut self, chains: &Chains, parent: u32, at: &[Vec3]) {
        let Chain { range, foot, .. } = chains.chains[parent as usize];
        let nodes = &chains.nodes[range.0 as usize..range.1 as usize];
        self.order.clear();
        self.order.extend(nodes.iter().copied().zip(0..));
        self.order.sort_unstable();
        self.line.clear();
        let mut along = 0.0;
        for (k, node) in nodes.iter().enumerate() {
            let here = if k == 0 { foot } else { at[*node as usize] };
            along += self.line.last().map_or(0.0, |(before, _)| before.distance(here));
            self.line.push((here, along));
        }
    }

    /// A node and the internodes next to it.
    fn node(&self, number: u32) -> Node {
        let found = self.order.binary_search_by_key(&number, |(node, _)| *node);
        let k = found.map_or(0, |k| self.order[k].1 as usize);
        let (here, along) = self.line[k];
        let up = self.line.get(k + 1).map_or(Vec3::ZERO, |(above, _)| above - here);
        let down = k.checked_sub(1).map_or(Vec3::ZERO, |below| self.line[below].0 - here);
        let axis = (up - down).try_normalize().unwrap_or(Vec3::Y);
        Node { along, up, down, axis }
    }
}

/// A node of the parent.
struct Node {
    /// Length of the parent before it, metres.
    along: f32,
    /// To the next node and to the one before.
    up: Vec3,
    down: Vec3,
    /// Unit direction along both.
    axis: Vec3,
}

impl Node {
    /// The insertion at the node itself of a branch that leaves in a direction.
    fn insertion(&self, way: Vec3, diameter: f32, of_parent: f32) -> Footprint {
        let kept = 0.5 * KEPT_FREE * diameter;
        let outward = way.reject_from_normalized(self.axis);
        let length = way.length().max(f32::MIN_POSITIVE);
        let sin = (outward.length() / length).max(LEAST_SINE);
        // It comes out of the bark farther along than the node, by as much as it leans that way: somewhere between what
        // that is on the internode above and on the one below.
        let rise = |along: Vec3| {
            let lean = way.dot(along.try_normalize().unwrap_or(self.axis)) / length;
            0.5 * of_parent * lean / (1.0 - lean * lean).max(0.0).sqrt().max(LEAST_SINE)
        };
        let (above, below) = (rise(self.up), rise(-self.down));
        Footprint {
            along: self.along + above.midpoint(below),
            outward: outward.try_normalize().unwrap_or_else(|| self.axis.any_orthonormal_vector()),
            half_length: kept / sin + 0.5 * (above - below).abs(),
            half_angle: half_angle(kept, 0.5 * of_parent, 1.0),
        }
    }

    /// The way along the parent from an insertion at the node to one above it, or below it, metres.
    fn way(&self, above: f32) -> Vec3 {
        if above > 0.0 { self.up.normalize_or_zero() * above } else { self.down.normalize_or_zero() * -above }
    }

    fn reaches(&self, above: f32) -> bool {
        (-REACH * self.down.length()..=REACH * self.up.length()).contains(&above)
    }
}

/// Whether two share bark if they are inserted at the same height.
fn is_beside(one: &Footprint, other: &Footprint) -> bool {
    one.angle_to(other) <= (one.half_angle + other.half_angle + BESIDE_RAD).min(PI - OPPOSITE)
}

/// The insertions on one parent in the order of their places.
#[derive(Default)]
struct Insertions {
    sorted: Vec<Footprint>,
    longest: f32,
}

impl Insertions {
    fn insert(&mut self, insertion: Footprint) {
        self.longest = self.longest.max(insertion.half_length);
        let place = self.sorted.partition_point(|other| other.along <= insertion.along);
        self.sorted.insert(place, insertion);
    }

    /// The nearest place within reach that the others leave free.
    fn free(&self, insertion: &Footprint, node: &Node) -> Option<f32> {
        let reach = REACH * node.up.length().max(node.down.length()) + insertion.half_length + self.longest;
        let from = self.sorted.partition_point(|other| other.along < insertion.along - reach);
        let to = self.sorted.partition_point(|other| other.along <= insertion.along + reach);
        let near = self.sorted[from..to].iter();
        let beside: Vec<&Footprint> = near.filter(|other| is_beside(insertion, other)).collect();
        let is_free = |along: f32| beside.iter().all(|other| insertion.is_clear_at(along, other));
        let next_to = |other: &Footprint| {
            let [below, above] = insertion.next_to(other);
            [above, below]
        };
        let places = std::iter::once(insertion.along).chain(beside.iter().flat_map(|other| next_to(other)));
        let free = places.filter(|along| node.reaches(along - insertion.along) && is_free(*along));
        free.min_by(|a, b| (a - insertion.along).abs().total_cmp(&(b - insertion.along).abs()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places of branches that leave one node, relative to it.
    fn settled(angles: &[f32], diameter: f32, length: f32) -> Vec<f32> {
        let node = Node { along: 1.0, up: Vec3::Y * length, down: Vec3::Y * -length, axis: Vec3::Y };
        let mut insertions = Insertions::default();
        let place = |degrees: &f32| {
            let out = Vec3::new(degrees.to_radians().cos(), 0.0, degrees.to_radians().sin());
            let mut insertion = node.insertion(out, diameter, 0.02);
            insertion.along = insertions.free(&insertion, &node).unwrap_or(f32::NAN);
            insertions.insert(insertion);
            insertion.along - 1.0
        };
        angles.iter().map(place).collect()
    }

    #[test]
    fn opposite_branches_share_a_place_and_whorls_are_spread() {
        assert_eq!(settled(&[0.0, 180.0], 0.015, 0.3), [0.0, 0.0]);
        assert_eq!(settled(&[0.0, 90.0, 180.0, 270.0], 0.002, 0.3), [0.0; 4], "thin ones have room");
        let whorl = settled(&[0.0, 72.0, 144.0, 216.0, 288.0], 0.015, 0.3);
        let mut apart: Vec<f32> = whorl.clone();
        apart.sort_by(f32::total_cmp);
        let least = 1.3 * 0.015;
        assert!(apart.windows(2).all(|w| w[1] - w[0] > least), "{whorl:?}");
        assert!(whorl.iter().all(|above| above.abs() <= 0.15));
    }

    #[test]
    fn where_there_is_no_room_branches_are_named() {
        let places = settled(&[0.0, 72.0, 144.0], 0.015, 0.01);
        assert!(places[0] == 0.0 && places[1].is_nan() && places[2].is_nan(), "{places:?}");
    }
}
