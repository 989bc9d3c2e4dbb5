//! Brings the stems of a bush to their common base, so that the wood of one plant is one surface.
//!
//! The stems of a bush sprout around one place, and each grows by itself. Here they are brought to a base
//! ([`StemBase`]): the first stem goes on from its top, the others leave its bark evenly around it, in the order of the
//! directions in which they lean. What a stem carries near the ground moves with it, less and less with height. The base
//! is as thick as its stems need it, and so grows with them.
//!
//! Limits: drawn trunks stay where they were drawn. Buds and markers, as overlays show them, are not moved.

use super::chains::{Chains, Life};
use crate::growth::tree::{NONE, Tree};
use crate::plant::StemBase;
use glam::Vec3;

/// Height up to which a stem is moved, in lengths of its way to the base: at 2 what stands just above its foot would be pressed flat.
const REACH: f32 = 4.0;

/// The feet of a plant that stand on a common base, in the order of their nodes; none if it has one trunk or drawn ones.
fn feet(tree: &Tree) -> Vec<u32> {
    let parents = &tree.nodes.parent;
    let is_foot = |n: &u32| parents[*n as usize] == NONE;
    let feet: Vec<u32> =
        if tree.drawn.is_empty() { (0..tree.len() as u32).take_while(is_foot).collect() } else { Vec::new() };
    if feet.len() > 1 { feet } else { Vec::new() }
}

/// The base below stems on these feet; it stands amid them.
fn base(tree: &Tree, feet: &[u32], diameters: &[f32]) -> StemBase {
    let middle = feet.iter().map(|foot| tree.nodes.at[*foot as usize]).sum::<Vec3>() / feet.len() as f32;
    StemBase::below(middle, feet.iter().map(|foot| 0.5 * diameters[*foot as usize]))
}

/// Brings the stems of a bush to their base. `life` is for every node that has been born.
pub(super) fn gather(tree: &Tree, life: &[Life], at: &mut [Vec3], diameters: &[f32]) {
    let feet = feet(tree);
    let Some(leader) = feet.first().map(|first| leader(tree, life).unwrap_or(*first)) else { return };
    let base = base(tree, &feet, diameters);
    let ways = ways(tree, &feet, leader, &base);
    // Feet come first, and parents before their children.
    let mut root: Vec<usize> = Vec::with_capacity(life.len());
    for (n, place) in at.iter_mut().enumerate().take(life.len()) {
        let parent = tree.nodes.parent[n];
        root.push(if parent == NONE { n } else { root[parent as usize] });
        let way = ways[root[n]];
        let height = (place.y - base.middle.y).max(0.0);
        let left = (1.0 - height / (REACH * way.length()).max(f32::MIN_POSITIVE)).max(0.0);
        *place += way * (left * left);
    }
}

/// The way of each foot to where its stem leaves the base.
fn ways(tree: &Tree, feet: &[u32], leader: u32, base: &StemBase) -> Vec<Vec3> {
    let from = |foot: u32| tree.nodes.at[foot as usize] - base.middle;
    let mut ways = vec![Vec3::ZERO; feet.len()];
    ways[leader as usize] = base.to_top() - from(leader);
    let azimuth = |foot: &u32| {
        let out = from(*foot);
        out.z.atan2(out.x)
    };
    let mut others: Vec<u32> = feet.iter().copied().filter(|foot| *foot != leader).collect();
    others.sort_by(|a, b| azimuth(a).total_cmp(&azimuth(b)));
    let sides = base.to_sides(others.first().map_or(0.0, azimuth), others.len());
    for (foot, side) in others.iter().zip(sides) {
        ways[*foot as usize] = side - from(*foot);
    }
    ways
}

/// The foot of the stem whose chain is the first.
fn leader(tree: &Tree, life: &[Life]) -> Option<u32> {
    let parents = &tree.nodes.parent;
    let first = (0..life.len()).find(|n| life[*n] != Life::Gone && parents[*n] != NONE)?;
    std::iter::successors(Some(first as u32), |n| Some(parents[*n as usize]).filter(|p| *p != NONE)).last()
}

/// The stems of a bush.
pub(super) struct Stems {
    /// The chain that goes on from the top of the base.
    leader: usize,
    base: StemBase,
}

impl Stems {
    /// The stems of a plant; `None` if it has one trunk or drawn ones.
    pub(super) fn of(tree: &Tree, chains: &Chains, diameters: &[f32]) -> Option<Self> {
        let feet = feet(tree);
        let leader = chains.chains.iter().position(|chain| chain.parent.is_none())?;
        (!feet.is_empty()).then(|| Self { leader, base: base(tree, &feet, diameters) })
    }

    /// Joins a stem, points with their radii from its foot, to the base: the leader runs through it, the others begin
    /// inside of it. Gives the stem's parent.
    pub(super) fn join(&self, stem: usize, skeleton: &mut Vec<(Vec3, f32)>) -> Option<usize> {
        let (foot, radius) = skeleton[0];
        if stem == self.leader {
            skeleton.splice(0..0, self.base.skeleton(foot));
            return None;
        }
        skeleton.insert(0, (self.base.start(foot), radius));
        Some(self.leader)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::growth::{Habit, Limits, Simulation, plant_at};
    use std::f32::consts::TAU;

    fn bush(stems: u32, age: u16) -> Simulation {
        let habit = Habit { stems, internode: 0.2, lift: 0.3.into(), flare: 0.0, ..Habit::default() };
        let mut bush = Simulation::new(&habit, 5, Limits::default());
        bush.grow_to(age, &|| false);
        bush
    }

    #[test]
    fn all_stems_of_a_bush_stand_on_one_base() {
        for (stems, age) in [(2, 3), (3, 8), (9, 1), (9, 8), (20, 6)] {
            let plant = plant_at(&bush(stems, age), f32::from(age)).plant;
            let trunks = plant.branches.iter().filter(|b| b.parent.is_none()).count();
            let sides: Vec<_> = plant.branches[1..].iter().filter(|b| b.level == 0).collect();
            assert_eq!((trunks, sides.len()), (1, stems as usize - 1), "{stems} stems at {age}");
            let base = &plant.branches[0];
            let girth: f32 = sides.iter().map(|stem| 2.0 * stem.radii[0]).sum();
            assert!(base.radii[1] * TAU > 1.3 * girth, "bark for every stem");
            for stem in &sides {
                assert_eq!(stem.parent, Some(0));
                let (inside, foot) = (stem.points[0] - base.points[0], stem.points[1] - base.points[0]);
                assert!(inside.with_y(0.0).length() < 1e-4 && inside.y >= 0.0);
                assert!(foot.y > inside.y && foot.with_y(0.0).length() > inside.with_y(0.0).length());
            }
            let apart = |k: usize| {
                let others = sides.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, stem)| stem);
                others.map(|o| o.points[1].distance(sides[k].points[1])).fold(f32::INFINITY, f32::min)
            };
            assert!((0..sides.len()).all(|k| apart(k) > 2.0 * sides[k].radii[0]), "{stems} stems at {age}");
        }
    }

    #[test]
    fn shoots_of_the_first_days_rise_from_the_middle() {
        let bush = bush(7, 1);
        for age in [0.02, 0.3, 0.7, 1.0] {
            let plant = plant_at(&bush, age).plant;
            let base = plant.branches[0].points[0];
            let off = |b: &crate::plant::Branch| (b.points[1] - base).with_y(0.0).length();
            let widest = plant.branches.iter().map(off).fold(0.0, f32::max);
            assert!(widest < 0.04, "stems begin {widest} m from the middle at {age}");
        }
    }

    #[test]
    fn wood_high_above_the_base_stays_where_it_grew() {
        let bush = bush(7, 8);
        let tree = bush.tree();
        let life = vec![Life::Living; tree.len()];
        let (mut at, diameters) = (tree.nodes.at.clone(), vec![0.02; tree.len()]);
        gather(tree, &life, &mut at, &diameters);
        let moved = |n: &usize| at[*n].distance(tree.nodes.at[*n]);
        let high: Vec<usize> = (0..tree.len()).filter(|n| tree.nodes.at[*n].y > 1.0).collect();
        assert!(high.len() > 20 && high.iter().all(|n| moved(n) == 0.0));
        assert!((0..7).all(|foot| moved(&foot) > 0.02));
        // Neighbours stay neighbours: nothing is torn, nothing turned upside down.
        for n in 7..tree.len() {
            let below = tree.nodes.parent[n] as usize;
            let (before, after) = (tree.nodes.at[n] - tree.nodes.at[below], at[n] - at[below]);
            assert!((after - before).length() < 0.8 * before.length(), "node {n}: {before} is now {after}");
        }
    }

    #[test]
    fn a_single_trunk_and_drawn_trunks_have_none() {
        let single = bush(1, 4);
        assert!(feet(single.tree()).is_empty());
        let mut drawn = bush(4, 2).tree().clone();
        drawn.drawn.push(0);
        assert!(feet(&drawn).is_empty());
    }
}
