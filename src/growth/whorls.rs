//! Branches that leave one node move apart along their carrier, so that each has bark of its own to stand on.
//!
//! Buds of a whorl share a node, but the wood that they become is too thick for one place: what botany calls a whorl is
//! a close spiral. Where branches of one node would overlap around their carrier, the later ones go up or down along it
//! by as little as clears them, with all that they carry.
//!
//! Limits: a branch stays on the halves of the internodes next to its node; where these are too short, branches overlap.

use super::chains::Chains;
use super::tree::Tree;
use glam::Vec3;
use std::f32::consts::PI;

/// Radius of the swelling where a branch leaves, in its own radii.
const COLLAR: f32 = 1.3;
/// Bark between branches beside each other, radians: room for the corners of surfaces with four sides.
const BESIDE: f32 = 0.9;
/// Branches are opposite if less than this is missing to half a turn, radians.
const OPPOSITE: f32 = 0.15;
/// Share of the internodes next to the node that branches may go along.
const REACH: f32 = 0.5;

/// Moves whatever shares a node: gives nodes and the feet of chains their new places.
pub fn spread(chains: &mut Chains, tree: &Tree, at: &mut [Vec3], diameters: &[f32]) {
    let own = ways(chains, tree, at, diameters);
    let mut whole: Vec<Vec3> = Vec::with_capacity(own.len());
    for (chain, own) in chains.chains.iter_mut().zip(own) {
        let way = own + chain.parent.map_or(Vec3::ZERO, |parent| whole[parent as usize]);
        whole.push(way);
        chain.foot += way;
        let nodes = &chains.nodes[chain.range.0 as usize + 1..chain.range.1 as usize];
        nodes.iter().for_each(|node| at[*node as usize] += way);
    }
}

/// The way of each chain along its carrier.
fn ways(chains: &Chains, tree: &Tree, at: &[Vec3], diameters: &[f32]) -> Vec<Vec3> {
    let mut ways = vec![Vec3::ZERO; chains.chains.len()];
    let above = chains.above();
    let mut carried: Vec<u32> = (0..chains.chains.len() as u32).collect();
    carried.retain(|c| chains.chains[*c as usize].parent.is_some());
    let node_of = |c: &u32| chains.nodes[chains.chains[*c as usize].range.0 as usize];
    carried.sort_by_key(node_of);
    for whorl in carried.chunk_by(|a, b| node_of(a) == node_of(b)).filter(|whorl| whorl.len() > 1) {
        let node = node_of(&whorl[0]) as usize;
        let carrier =
            Carrier::new(at[node], at[tree.nodes.parent[node] as usize], at.get(above[node] as usize));
        let mut stands: Vec<Stand> = Vec::with_capacity(whorl.len());
        for &c in whorl {
            let first = chains.nodes[chains.chains[c as usize].range.0 as usize + 1] as usize;
            let mut stand = carrier.stand(at[first] - at[node], diameters[first], diameters[node]);
            // What was drawn stays where it was drawn.
            if first >= tree.drawn.len() {
                stand.settle(&stands, &carrier);
                ways[c as usize] = carrier.way(stand.above);
            }
            stands.push(stand);
        }
    }
    ways
}

/// The internodes on either side of a node.
struct Carrier {
    /// From the node to half way along the next internode, and along the one before.
    up: Vec3,
    down: Vec3,
    /// Unit direction along both.
    axis: Vec3,
}

impl Carrier {
    fn new(at: Vec3, below: Vec3, above: Option<&Vec3>) -> Self {
        let (up, down) = (above.map_or(Vec3::ZERO, |above| (above - at) * REACH), (below - at) * REACH);
        Self { up, down, axis: (up - down).try_normalize().unwrap_or(Vec3::Y) }
    }

    /// The stand at the node itself of a branch that leaves in a direction.
    fn stand(&self, way: Vec3, diameter: f32, of_carrier: f32) -> Stand {
        let outward = way.reject_from_normalized(self.axis);
        let sin = (outward.length() / way.length().max(f32::MIN_POSITIVE)).max(0.4);
        Stand {
            above: 0.0,
            outward: outward.try_normalize().unwrap_or_else(|| self.axis.any_orthonormal_vector()),
            half_length: 0.5 * COLLAR * diameter / sin,
            half_angle: (COLLAR * diameter / of_carrier.max(f32::MIN_POSITIVE)).min(1.0).asin(),
        }
    }

    /// The way to a place above the node, or below it, metres.
    fn way(&self, above: f32) -> Vec3 {
        if above > 0.0 { self.up.normalize_or_zero() * above } else { self.down.normalize_or_zero() * -above }
    }

    fn reaches(&self, above: f32) -> bool {
        (-self.down.length()..=self.up.length()).contains(&above)
    }
}

/// Where a branch leaves its carrier.
struct Stand {
    /// Length of the carrier between the node and it, metres; negative below the node.
    above: f32,
    /// Unit direction from the carrier's axis.
    outward: Vec3,
    /// Half of what its collar covers along the carrier, metres, and around it, radians.
    half_length: f32,
    half_angle: f32,
}

impl Stand {
    /// Goes to the nearest place that the others leave free.
    fn settle(&mut self, others: &[Stand], carrier: &Carrier) {
        let clear = |other: &Stand| self.half_length + other.half_length;
        let beside = |other: &&Stand| {
            let apart = self.outward.dot(other.outward).clamp(-1.0, 1.0).acos();
            apart <= (self.half_angle + other.half_angle + BESIDE).min(PI - OPPOSITE)
        };
        let is_free = |above: f32| {
            others.iter().filter(beside).all(|other| (above - other.above).abs() >= 0.99 * clear(other))
        };
        let next_to = |other: &Stand| [other.above + clear(other), other.above - clear(other)];
        let places = std::iter::once(0.0).chain(others.iter().filter(beside).flat_map(next_to));
        let free = places.filter(|above| carrier.reaches(*above) && is_free(*above));
        if let Some(above) = free.min_by(|a, b| a.abs().total_cmp(&b.abs())) {
            self.above = above;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stand(carrier: &Carrier, degrees: f32, diameter: f32) -> Stand {
        let out = Vec3::new(degrees.to_radians().cos(), 0.3, degrees.to_radians().sin());
        carrier.stand(out, diameter, 0.02)
    }

    fn settled(angles: &[f32], diameter: f32, length: f32) -> Vec<f32> {
        let carrier = Carrier::new(Vec3::Y, Vec3::Y * (1.0 - length), Some(&(Vec3::Y * (1.0 + length))));
        let mut stands: Vec<Stand> = Vec::new();
        for angle in angles {
            let mut next = stand(&carrier, *angle, diameter);
            next.settle(&stands, &carrier);
            stands.push(next);
        }
        stands.iter().map(|s| s.above).collect()
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
    fn where_there_is_no_room_branches_stay() {
        assert_eq!(settled(&[0.0, 72.0, 144.0], 0.015, 0.01), [0.0; 3]);
    }
}
