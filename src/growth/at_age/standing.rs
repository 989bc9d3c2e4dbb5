//! Where the wood of one age stands.
//!
//! Which wood has room, and where on their carriers branches stand, is decided for the ends of years
//! ([`pruning::pruned`]): wood thickens all the time, and decided anew for every moment, branches would be cut and come
//! back from one moment to the next. In a year that runs, what stands at its beginning and at its end goes evenly from its
//! one place to the other. What stands at its end only has grown in it, or has found room again, and grows out of what
//! carries it.
//!
//! Limits: what stands at its beginning only, because it is shed or cut in that year, is gone as soon as the year runs;
//! which internode goes on at a fork is that of the year's end all through it; leaves fall in one moment, and those of an
//! end that was cut are there in one.

use super::chains::{self, Chains};
use super::diameter;
use super::pruning;
use super::stool;
use crate::growth::habit::Habit;
use crate::growth::tree::{NONE, Tree};
use glam::Vec3;

/// Least share of its length that wood of this year is shown with.
const LEAST: f32 = 0.02;

/// The wood of one age.
#[derive(Clone, Debug)]
pub(crate) struct Standing {
    /// Runs of nodes.
    pub chains: Chains,
    /// Places of the nodes, metres.
    pub at: Vec<Vec3>,
    /// Diameters below the nodes, metres.
    pub diameters: Vec<f32>,
    /// How far the internode below each node, and what it carries, has grown this year; 1 for older ones.
    pub grown: Vec<f32>,
}

/// The wood of a plant at an age in years.
pub(crate) fn standing(tree: &Tree, habit: &Habit, age: f32) -> Standing {
    let year = age.ceil() as u16;
    let passed = 1.0 - (f32::from(year) - age);
    if passed >= 1.0 || year == 0 {
        return at_the_end(tree, habit, year);
    }
    let (start, end) = rayon::join(|| at_the_end(tree, habit, year - 1), || at_the_end(tree, habit, year));
    let mut now = Standing {
        chains: end.chains.clone(),
        at: end.at.clone(),
        diameters: diameter::diameters(tree, habit, age),
        grown: end.grown,
    };
    let stood = |node: usize| start.chains.of_node.get(node).is_some_and(|chain| *chain != NONE);
    for (i, &below) in tree.nodes.parent[..end.chains.of_node.len()].iter().enumerate() {
        if stood(i) || below == NONE {
            now.at[i] = start.at[i].lerp(end.at[i], passed);
        } else if end.chains.of_node[i] != NONE {
            let (foot, p) = (end.chains.below(i, tree, &end.at), below as usize);
            let from = now.at[p] + (foot - end.at[p]);
            now.at[i] = from + (end.at[i] - foot) * passed.max(LEAST);
            now.grown[i] = passed;
            if tree.nodes.born[i] < year {
                // As thick as new wood would be by the pipe model, were it to carry as much in the end.
                now.diameters[i] *= passed.powf(1.0 / habit.pipe);
            }
        }
    }
    for chain in &mut now.chains.chains {
        let (node, first) = (end.chains.nodes[chain.range.0 as usize], chain.range.0 as usize + 1);
        let first = end.chains.nodes[first] as usize;
        chain.foot = if stood(first) {
            start.chains.below(first, tree, &start.at).lerp(chain.foot, passed)
        } else {
            now.at[node as usize] + (chain.foot - end.at[node as usize])
        };
    }
    now
}

/// The wood at the end of a year.
fn at_the_end(tree: &Tree, habit: &Habit, year: u16) -> Standing {
    let diameters = diameter::diameters(tree, habit, f32::from(year));
    let (lives, mut places) = (chains::living(tree, year), tree.nodes.at.clone());
    stool::gather(tree, &lives, &mut places, &diameters);
    let (chains, at) = pruning::pruned(tree, lives, &places, &diameters, habit.pipe);
    let grown = vec![1.0; chains.of_node.len()];
    Standing { chains, at, diameters, grown }
}
