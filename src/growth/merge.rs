//! A drawn plant with what grew on it.
//!
//! Drawn wood grows on; everything else that was drawn stays as it is: flowers and their stems, leaves and the wood that
//! outlines were filled with. Grown wood begins with the drawn wood, so what stood on a drawn branch now stands on the
//! grown one that runs through the same place.

use super::chains::Chains;
use super::simulation::Simulation;
use super::to_plant;
use super::tree::NONE;
use crate::plant::{Branch, Plant, Shape};
use glam::Vec3;

/// Which branches grow on: those drawn by hand that end in no flower, and whatever carries such.
pub fn grows(plant: &Plant) -> Vec<bool> {
    let mut grows: Vec<bool> = plant.branches.iter().map(|b| b.stroke.is_some()).collect();
    for flower in &plant.flowers {
        if let Some(branch) = flower.branch {
            grows[branch] = false;
        }
    }
    for b in (0..plant.branches.len()).rev() {
        if let Some(parent) = plant.branches[b].parent.filter(|_| grows[b]) {
            grows[parent] = true;
        }
    }
    grows
}

/// The branches that grow on, numbered anew.
pub fn wood(plant: &Plant, grows: &[bool]) -> Vec<Branch> {
    let number = numbers(grows);
    let on = plant.branches.iter().zip(grows).filter(|(_, grows)| **grows);
    on.map(|(b, _)| Branch { parent: b.parent.and_then(|p| number[p]), ..b.clone() }).collect()
}

/// The number of each branch among those that grow on.
fn numbers(grows: &[bool]) -> Vec<Option<usize>> {
    let mut next = 0;
    let number = |grows: &bool| {
        grows.then(|| {
            next += 1;
            next - 1
        })
    };
    grows.iter().map(number).collect()
}

/// The drawn plant at an age of what grew from its [`wood`].
pub fn merged(drawn: Plant, grows: &[bool], simulation: &Simulation, age: f32) -> Plant {
    let (mut plant, chains) = to_plant::with_chains(simulation, age);
    plant.world_from_canvas = drawn.world_from_canvas;
    let on = Carriers { simulation, chains: &chains, number: numbers(grows) };
    let mut moved: Vec<Option<usize>> = vec![None; drawn.branches.len()];
    for (b, branch) in drawn.branches.iter().enumerate().filter(|(b, _)| !grows[*b]) {
        let base = branch.points.first().copied().unwrap_or_default();
        let parent = branch.parent.and_then(|p| moved[p].or_else(|| on.carrier(p, base)));
        let level = parent.map_or(0, |p| plant.branches[p].level + 1);
        moved[b] = Some(plant.branches.len());
        plant.branches.push(Branch { parent, level, material: 0, ..branch.clone() });
    }
    let now = |branch: Option<usize>, at: Vec3| branch.and_then(|b| moved[b].or_else(|| on.carrier(b, at)));
    plant.flowers = drawn.flowers;
    for flower in &mut plant.flowers {
        flower.branch = now(flower.branch, flower.cone.apex);
    }
    let first = drawn.organs.iter().filter_map(|o| template(&o.shape)).max().map_or(0, |last| last + 1);
    for organ in &mut plant.organs {
        if let Shape::Blade(blade) = &mut organ.shape {
            blade.template = blade.template.map(|t| t + first);
        }
    }
    let mut organs = drawn.organs;
    for organ in &mut organs {
        organ.branch = now(organ.branch, organ.base());
        organ.material = 0;
    }
    organs.append(&mut plant.organs);
    plant.organs = organs;
    debug_assert_eq!(plant.check_invariants(), Ok(()));
    plant
}

fn template(shape: &Shape) -> Option<u32> {
    match shape {
        Shape::Blade(blade) => blade.template,
        _ => None,
    }
}

/// Finds the grown branch that runs where a drawn one ran.
struct Carriers<'a> {
    simulation: &'a Simulation,
    chains: &'a Chains,
    number: Vec<Option<usize>>,
}

impl Carriers<'_> {
    /// The branch through the place on drawn branch `b` nearest to `at`.
    fn carrier(&self, b: usize, at: Vec3) -> Option<usize> {
        let tree = self.simulation.tree();
        let number = self.number[b]? as u32;
        let first = tree.drawn.partition_point(|d| *d < number);
        let end = tree.drawn.partition_point(|d| *d <= number);
        let away = |n: &usize| tree.nodes.at[*n].distance_squared(at);
        let lives = |n: &usize| self.chains.of_node.get(*n).is_some_and(|chain| *chain != NONE);
        let nearest = (first..end).filter(lives).min_by(|a, b| away(a).total_cmp(&away(b)))?;
        Some(self.chains.of_node[nearest] as usize)
    }
}
