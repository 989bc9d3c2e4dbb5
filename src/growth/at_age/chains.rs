//! The wood of one age as chains of nodes: at every fork the thicker internode goes on, the others begin chains.
//!
//! So a trunk runs through where a stronger lateral has taken over from a leader that died, and branches taper
//! smoothly. Chains come after the chains that carry them. Dead wood goes on with no living wood's chain that has living wood to go on
//! with, so nothing changes where it falls at last.

use crate::growth::tree::{NONE, Tree};
use glam::Vec3;

/// What the wood below a node is at the end of a year.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Life {
    /// It is not there yet, has fallen, or was cut.
    Gone,
    /// It has died and has not fallen yet.
    Dead,
    /// It lives.
    Living,
}

/// A run of nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chain {
    /// The chain that carries it.
    pub parent: Option<u32>,
    /// 0 for a trunk.
    pub level: u32,
    /// Where its nodes begin in [`Chains::nodes`], and where they end. The first is the node that it begins at, which
    /// belongs to the parent if there is one.
    pub range: (u32, u32),
    /// Where it begins: at its first node, or a little along the parent from that.
    pub foot: Vec3,
}

/// The chains of a plant.
#[derive(Clone, Debug, Default)]
pub struct Chains {
    /// Parents before children.
    pub chains: Vec<Chain>,
    /// Nodes of all chains.
    pub nodes: Vec<u32>,
    /// The chain of the internode below each node, [`NONE`] for what is not there.
    pub of_node: Vec<u32>,
}

impl Chains {
    /// Where the internode below a node begins.
    pub fn below(&self, node: usize, tree: &Tree, at: &[Vec3]) -> Vec3 {
        let chain = self.of_node[node];
        let is_first = self.first(chain) as usize == node;
        if is_first { self.chains[chain as usize].foot } else { at[tree.nodes.parent[node] as usize] }
    }

    /// The first node of a chain that is its own.
    pub fn first(&self, chain: u32) -> u32 {
        self.nodes[self.chains[chain as usize].range.0 as usize + 1]
    }
}

/// Follows the wood that is there and whose nodes stand at these places. `life` is for every node that has been born, in
/// order; nothing stands on what is gone.
pub(crate) fn chains(tree: &Tree, life: &[Life], at: &[Vec3], diameters: &[f32]) -> Chains {
    let nodes = &tree.nodes;
    let born = life.len();
    let mut next = vec![NONE; born];
    let there = || (0..born).filter(|i| nodes.parent[*i] != NONE && life[*i] != Life::Gone);
    for i in there() {
        let parent = nodes.parent[i];
        let held = &mut next[parent as usize];
        let goes_before = |other: usize| {
            let continues = |k: usize| nodes.axis[k] == nodes.axis[parent as usize];
            let thicker = diameters[i].total_cmp(&diameters[other]);
            life[i].cmp(&life[other]).then(thicker).then(continues(i).cmp(&continues(other))).is_gt()
        };
        if *held == NONE || goes_before(*held as usize) {
            *held = i as u32;
        }
    }
    let mut out = Chains { of_node: vec![NONE; born], ..Chains::default() };
    for i in there() {
        if out.of_node[i] != NONE {
            continue;
        }
        let parent = nodes.parent[i];
        let carried_by = Some(out.of_node[parent as usize]).filter(|c| *c != NONE);
        let level = carried_by.map_or(0, |c| out.chains[c as usize].level + 1);
        let (first, index) = (out.nodes.len() as u32, out.chains.len() as u32);
        out.nodes.push(parent);
        let mut node = i as u32;
        while node != NONE {
            out.nodes.push(node);
            out.of_node[node as usize] = index;
            node = next[node as usize];
        }
        let range = (first, out.nodes.len() as u32);
        out.chains.push(Chain { parent: carried_by, level, range, foot: at[parent as usize] });
    }
    out
}

/// What the wood below each node is at the end of a year, up to the last node that has been born then. `stays` says how many years
/// dead wood stays before it falls; what it carries falls with it.
pub(crate) fn life(tree: &Tree, year: u16, stays: impl Fn(usize) -> f32) -> Vec<Life> {
    let nodes = &tree.nodes;
    let mut life = vec![Life::Gone; tree.born_by(year)];
    for i in (0..life.len()).filter(|i| nodes.born[*i] <= year) {
        let carried = nodes.parent[i] == NONE || life[nodes.parent[i] as usize] != Life::Gone;
        if nodes.died[i] > year {
            life[i] = Life::Living;
        } else if carried && f32::from(year - nodes.died[i]) + 1.0 <= stays(i) {
            life[i] = Life::Dead;
        }
    }
    life
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::growth::tree::NewNode;

    #[test]
    fn dead_wood_falls_after_its_years_and_with_what_carries_it() {
        let mut tree = Tree::default();
        let foot = tree.add_foot(Vec3::ZERO, Vec3::X);
        let add = |tree: &mut Tree, parent, lateral, x: f32| {
            tree.add(NewNode { parent, at: Vec3::new(x, 1.0, 0.0), side: Vec3::Z, lateral, year: 1 })
        };
        let trunk = add(&mut tree, foot, false, 0.0);
        let top = add(&mut tree, trunk, false, 0.1);
        let limb = add(&mut tree, trunk, true, 1.0);
        let twig = add(&mut tree, limb, false, 2.0);
        for node in [limb, twig] {
            tree.nodes.died[node as usize] = 4;
        }
        let at = |year, stays: [f32; 2]| {
            let life = life(&tree, year, |node| stays[node - limb as usize]);
            [trunk, limb, twig].map(|node| life[node as usize])
        };
        assert_eq!(at(3, [0.0; 2]), [Life::Living; 3]);
        assert_eq!(at(4, [2.0, 1.0]), [Life::Living, Life::Dead, Life::Dead]);
        assert_eq!(at(5, [2.0, 1.0]), [Life::Living, Life::Dead, Life::Gone]);
        assert_eq!(at(5, [1.0, 9.0]), [Life::Living, Life::Gone, Life::Gone]);
        let thick = [0.0, 0.1, 0.02, 0.05, 0.02];
        let wood = chains(&tree, &life(&tree, 4, |_| 9.0), &tree.nodes.at, &thick);
        assert_eq!(wood.nodes[..3], [foot, trunk, top], "living wood goes on with living wood");
    }
}
