//! How thick wood is: the pipe model (001 §2.4, eq. 2.7).
//!
//! dⁿ = Σ dᵢⁿ over the children of a node, with the thinnest wood at the tips. Wood is laid down and stays: what was shed
//! counts as long as the plant lives, so a trunk never grows thinner. Where we add to the thesis: every internode has
//! pipes of its own for its leaves, without which an unbranched whip would have no taper.

use crate::growth::habit::Habit;
use crate::growth::tree::{NONE, Tree};

/// Diameters in metres of the internodes below all nodes at an age; 0 for those not born yet.
///
/// In the year that runs, new internodes count by the share of it that has passed.
pub(crate) fn diameters(tree: &Tree, habit: &Habit, age: f32) -> Vec<f32> {
    let year = age.ceil() as u16;
    let passed = 1.0 - (f32::from(year) - age);
    let nodes = &tree.nodes;
    let born = tree.born_by(year);
    // dⁿ in units of the thinnest wood's.
    let mut pipes = vec![0.0f32; tree.len()];
    for i in (0..born).rev().filter(|i| nodes.born[*i] <= year) {
        let grown = if nodes.born[i] == year && year > 0 { passed } else { 1.0 };
        let carried = pipes[i].max(grown);
        pipes[i] = carried + habit.pipe_leaf * grown;
        if nodes.parent[i] != NONE {
            pipes[nodes.parent[i] as usize] += pipes[i];
        }
    }
    let exponent = 1.0 / habit.pipe;
    let mut out: Vec<f32> = pipes.iter().map(|p| habit.tip * p.powf(exponent)).collect();
    for (diameter, given) in out.iter_mut().zip(&tree.given) {
        *diameter = diameter.max(*given);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::growth::{Limits, Simulation};

    #[test]
    fn at_every_fork_the_powers_of_the_diameters_add_up() {
        for (pipe, pipe_leaf) in [(2.0, 0.0), (2.3, 0.0), (3.0, 0.4)] {
            let habit = Habit { internode: 0.3, pipe, pipe_leaf, shed: 0.05.into(), ..Habit::default() };
            let mut simulation = Simulation::new(&habit, 4, Limits::default());
            simulation.grow_to(9, &|| false);
            let tree = simulation.tree();
            let power: Vec<f32> =
                diameters(tree, &habit, 9.0).iter().map(|d| (d / habit.tip).powf(pipe)).collect();
            let (mut carried, mut children) = (vec![0.0; tree.len()], vec![0; tree.len()]);
            for i in (0..tree.len()).filter(|i| tree.nodes.parent[*i] != NONE) {
                carried[tree.nodes.parent[i] as usize] += power[i];
                children[tree.nodes.parent[i] as usize] += 1;
            }
            assert!(children.iter().filter(|count| **count > 1).count() > 50, "forks");
            for i in 0..tree.len() {
                // The wood of a tip is the thinnest; leaves add pipes of their own.
                let expected = if children[i] == 0 { 1.0 } else { carried[i] } + pipe_leaf;
                assert!((power[i] / expected - 1.0).abs() < 1e-3, "node {i}: {} of {expected}", power[i]);
            }
        }
    }
}
