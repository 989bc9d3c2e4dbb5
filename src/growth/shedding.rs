//! Branches that earn too little fall off.
//!
//! A lateral branch is shed when the resource of all its buds, per internode, lies below a threshold and it has had
//! its first years; so is, on a species with a clean bole, what stands lower than the bole's height. The crown lifts and
//! its inside clears by itself.
//!
//! The thesis names the fate (a bud is discarded) but not the rule; this one is known from self-organising tree models:
//! light per length of branch.

use super::fate::Fate;
use super::species::Habit;
use super::tree::{NEVER, NONE, Tree};
use super::vigour::Flow;

/// Sheds branches at the end of a year and gives the nodes that died.
pub fn shed(tree: &mut Tree, flow: &Flow, habit: &Habit, year: u16) -> Vec<u32> {
    let age = f32::from(year);
    let (least, bole) = (habit.shed.at(age), habit.bole.at(age));
    let mut dead = Vec::new();
    if least <= 0.0 && bole <= 0.0 {
        return dead;
    }
    // Nodes of this year have no flow yet.
    let known = flow.main.len();
    let mut internodes = vec![0u32; tree.len()];
    for i in (0..tree.len()).rev() {
        if tree.nodes.died[i] == NEVER && tree.nodes.parent[i] != NONE {
            internodes[i] += 1;
            internodes[tree.nodes.parent[i] as usize] += internodes[i];
        }
    }
    for (i, &carried) in internodes.iter().enumerate() {
        let parent = tree.nodes.parent[i];
        if tree.nodes.died[i] != NEVER || parent == NONE {
            continue;
        }
        let falls = tree.nodes.died[parent as usize] == year || {
            let grown_up = u32::from(year - tree.nodes.born[i]) >= habit.shed_after;
            let lateral = tree.begins_lateral(i) && tree.nodes.born[i] > 0;
            let poor = || i < known && flow.through(i) < least * carried as f32;
            let low = || tree.nodes.order[i] == 1 && tree.nodes.at[parent as usize].y < bole;
            lateral && grown_up && (poor() || low())
        };
        if falls {
            tree.nodes.died[i] = year;
            dead.push(i as u32);
        }
    }
    if !dead.is_empty() {
        for k in 0..tree.open.len() {
            let bud = tree.open[k];
            if tree.nodes.died[tree.buds.node[bud as usize] as usize] != NEVER {
                tree.settle(bud, Fate::Shed, year);
            }
        }
        tree.forget_settled();
    }
    dead
}
