//! The wood of one age as chains of nodes: at every fork the thicker internode goes on, the others begin chains.
//!
//! So a trunk runs through where a stronger lateral has taken over from a leader that died, and branches taper
//! smoothly. Chains come after the chains that carry them.

use crate::growth::tree::{NONE, Tree};
use glam::Vec3;

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
    /// The chain of the internode below each node, [`NONE`] for what does not live.
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

/// Follows the wood that lives and whose nodes stand at these places. `lives` is for every node that has been born, in
/// order; what stands on dead wood is dead.
pub(crate) fn chains(tree: &Tree, lives: &[bool], at: &[Vec3], diameters: &[f32]) -> Chains {
    let nodes = &tree.nodes;
    let born = lives.len();
    let mut next = vec![NONE; born];
    let living = || (0..born).filter(|i| nodes.parent[*i] != NONE && lives[*i]);
    for i in living() {
        let parent = nodes.parent[i];
        let held = &mut next[parent as usize];
        let thicker = |other: usize| {
            let continues = |k: usize| nodes.axis[k] == nodes.axis[parent as usize];
            diameters[i].total_cmp(&diameters[other]).then(continues(i).cmp(&continues(other))).is_gt()
        };
        if *held == NONE || thicker(*held as usize) {
            *held = i as u32;
        }
    }
    let mut out = Chains { of_node: vec![NONE; born], ..Chains::default() };
    for i in living() {
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

/// Whether each node up to the last that has been born by the end of a year lives then.
pub(crate) fn living(tree: &Tree, year: u16) -> Vec<bool> {
    (0..tree.born_by(year)).map(|node| tree.lives(node, year)).collect()
}
