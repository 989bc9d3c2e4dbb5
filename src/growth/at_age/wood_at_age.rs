//! The wood of one age: which of it is shown, where its nodes are and how thick it is.
//!
//! Which wood has room, and where branches are inserted in their parents, is decided for the ends of years
//! ([`pruning::pruned`]). Wood thickens all the time; decided anew for every moment, branches would be cut and come back
//! from one moment to the next. In a year that runs, nodes that are there at its beginning and at its end go evenly from
//! one place to the other. Nodes that are there at its end only have grown in it, or have found room again, and grow out
//! of their parents.
//!
//! Branches that are shed die: they lose their leaves at once and fall bit by bit, thin wood before thick wood, as the habit's
//! `dead_years` say.
//!
//! Limits: what is there at the year's beginning only, because it falls or is cut in that year, is gone as soon as the
//! year runs. Which internode goes on at a fork is that of the year's end all through it. Leaves fall in one moment, and
//! those of an end that was cut are there in one.

use super::aside;
use super::chains::{self, Chains};
use super::diameter;
use super::pruning;
use super::stem_base;
use crate::growth::simulation::Simulation;
use crate::growth::tree::{NONE, Tree};
use glam::Vec3;

/// Least share of its length that wood of this year is shown with.
const LEAST: f32 = 0.02;

/// The wood of one age.
#[derive(Clone, Debug)]
pub(crate) struct WoodAtAge {
    /// Runs of nodes.
    pub chains: Chains,
    /// Places of the nodes, metres.
    pub at: Vec<Vec3>,
    /// Diameters below the nodes, metres.
    pub diameters: Vec<f32>,
    /// How far the internode below each node, and what it carries, has grown this year; 1 for older ones.
    pub grown: Vec<f32>,
}

/// The wood of a plant at an age in years; `tree` is the simulation's, or with branches that are [younger](super::younger).
pub(crate) fn wood_at_age(simulation: &Simulation, tree: &Tree, age: f32) -> WoodAtAge {
    let habit = simulation.habit();
    let year = age.ceil() as u16;
    let passed = 1.0 - (f32::from(year) - age);
    if passed >= 1.0 || year == 0 {
        return at_the_end(simulation, tree, year);
    }
    let end_of = |year| at_the_end(simulation, tree, year);
    let (start, end) = rayon::join(|| end_of(year - 1), || end_of(year));
    let mut now = WoodAtAge {
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
fn at_the_end(simulation: &Simulation, tree: &Tree, year: u16) -> WoodAtAge {
    let habit = simulation.habit();
    let passes = |from: Vec3, to: Vec3| simulation.obstacles().is_some_and(|beside| beside.crosses(from, to));
    let diameters = diameter::diameters(tree, habit, f32::from(year));
    let stays = |node: usize| habit.dead_years * 100.0 * diameters[node];
    let (life, mut places) = (chains::life(tree, year, stays), tree.nodes.at.clone());
    stem_base::gather(tree, &life, &mut places, &diameters);
    for (place, grown) in places.iter_mut().zip(&tree.nodes.at) {
        if passes(*grown, *place) {
            *place = *grown;
        }
    }
    let (mut chains, mut at) = pruning::pruned(tree, life, &places, &diameters, habit.pipe);
    aside::bend(tree, &mut chains, &mut at, &diameters, &passes);
    let grown = vec![1.0; chains.of_node.len()];
    WoodAtAge { chains, at, diameters, grown }
}
