//! Branches that earn too little fall off.
//!
//! A lateral branch is shed when the resource of all its buds, per internode, lies below a threshold and it has had
//! its first years; so is, on a species with a clean bole, what stands lower than the bole's height. The crown lifts and
//! its inside clears by itself.
//!
//! The thesis names the fate (a bud is discarded) but not the rule; this one is known from self-organising tree models:
//! light per length of branch.

use crate::growth::habit::Habit;
use crate::growth::resource::vigour::Flow;
use crate::growth::tree::{Fate, NEVER, NONE, Tree};

/// Sheds branches at the end of a year and gives the nodes that died.
pub(crate) fn shed(tree: &mut Tree, flow: &Flow, habit: &Habit, year: u16) -> Vec<u32> {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::growth::habit::LightHabit;
    use crate::growth::resource::shadow::{Change, Shadow};
    use crate::growth::tree::NewNode;
    use glam::Vec3;

    /// A trunk of three internodes whose last node carries a branch of three on either side, the one to +x first.
    fn tree() -> Tree {
        let mut tree = Tree::default();
        let add = |tree: &mut Tree, parent, at, lateral, year| {
            tree.add(NewNode { parent, at, side: Vec3::Z, lateral, year })
        };
        let mut trunk = tree.add_foot(Vec3::ZERO, Vec3::X);
        for k in 1..=3 {
            trunk = add(&mut tree, trunk, Vec3::Y * k as f32, false, 0);
        }
        for way in [Vec3::X, Vec3::NEG_X] {
            let mut below = trunk;
            for k in 1..=3 {
                below = add(&mut tree, below, Vec3::Y * 3.0 + way * k as f32, k == 1, 1);
            }
            tree.add_bud(below, way, true, 1);
        }
        tree
    }

    /// What falls in a year when something casts a deep shadow over the branch to +x.
    fn fallen(tree: &mut Tree, habit: &Habit, year: u16) -> Vec<u32> {
        let mut shadow = Shadow::new(&LightHabit { darkening: 1.0, ..LightHabit::default() }, 1.0, 100);
        for _ in 0..6 {
            assert!(shadow.cast(Vec3::new(3.5, 5.5, 0.5), Change::Grown, 1 << 20));
        }
        let light = |b: &u32| shadow.exposure(tree.nodes.at[tree.buds.node[*b as usize] as usize]);
        let q: Vec<f32> = tree.open.iter().map(light).collect();
        assert!(q[0] < 0.2 && q[1] > 0.9, "{q:?}");
        let mut flow = Flow::default();
        flow.gather(tree, &q);
        shed(tree, &flow, habit, year)
    }

    #[test]
    fn a_shaded_branch_falls_and_a_lit_one_stays() {
        let mut tree = tree();
        let habit = Habit { shed: 0.2.into(), shed_after: 3, bole: 0.0.into(), ..Habit::default() };
        assert!(fallen(&mut tree, &habit, 3).is_empty(), "it has its first years");
        assert!(fallen(&mut tree, &Habit { shed: 0.0.into(), ..habit.clone() }, 9).is_empty());
        assert_eq!(fallen(&mut tree, &habit, 4), [4, 5, 6]);
        assert!((0..tree.len()).all(|i| tree.lives(i, 4) != (4..=6).contains(&i)));
        assert!((0..tree.len()).all(|i| tree.lives(i, 3)), "it was there the year before");
        assert_eq!((tree.open.as_slice(), tree.buds.fate[0]), (&[1][..], Fate::Shed));
        tree.check_invariants().unwrap();
    }

    #[test]
    fn a_bole_is_cleared_of_lit_branches_too() {
        let mut tree = tree();
        let habit = Habit { shed: 0.0.into(), shed_after: 0, bole: 3.5.into(), ..Habit::default() };
        assert_eq!(fallen(&mut tree, &habit, 4).len(), 6);
    }
}
