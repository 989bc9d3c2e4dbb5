//! Growth in what a growth brush sweeps (001 §4.4).

use super::nearby::{Nearby, lead, reached};
use super::own_leaves::OwnLeaves;
use crate::growth::at_age::PlantAtAge;
use crate::growth::at_age::new_growth::add_new_growth;
use crate::growth::at_age::wood_names;
use crate::growth::habit::Habit;
use crate::growth::limits::{Limits, Outcome};
use crate::growth::obstacle::Obstacles;
use crate::growth::simulation::{Simulation, fit};
use crate::growth::volume::Swept;
use crate::plant::{Branch, Plant, Provenance};
use crate::random::mix;
use std::sync::Arc;

/// Years that growth in a dab takes at most, and those for each ball of a stroke besides: a long one is reached from its beginning.
const ROUNDS: (u16, f32) = (60, 0.5);
/// Years in succession with hardly any growth after which it is filled.
const QUIET: u16 = 2;
/// Share of what grew that is hardly any growth in a year.
const HARDLY: f32 = 0.002;

/// A stroke of a growth brush, in the world.
#[derive(Clone, Debug)]
pub struct Paint {
    /// What it sweeps, and how strongly shoots follow it.
    pub swept: Arc<Swept>,
    /// What stands in its way.
    pub obstacles: Option<Arc<Obstacles>>,
    /// Its radius at neutral pressure, metres.
    pub radius: f32,
    /// How densely wood grows, 1 as ever.
    pub density: f32,
    /// Decides everything that is left to chance.
    pub seed: u64,
}

/// How painting ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Painted {
    /// What was swept is filled, or as full as it gets.
    Filled,
    /// There is no wood, or none nearer than the plant is high.
    OutOfReach,
    /// A cap of the plant's limits ended it before.
    Capped,
    /// It was asked to stop.
    Stopped,
}

/// Everything that growth in a stroke depends on.
#[derive(Clone, Debug, PartialEq)]
struct Start {
    habit: Habit,
    wood: Vec<Branch>,
    swept: Arc<Swept>,
    obstacles: Option<Arc<Obstacles>>,
    seed: u64,
    limits: Limits,
}

/// What grew in the strokes of one drawing, in their order, for the next build of it.
#[derive(Debug, Default)]
pub struct Memory {
    kept: Vec<Kept>,
}

#[derive(Debug)]
struct Kept {
    start: Start,
    simulation: Simulation,
    outcome: Outcome,
}

impl Memory {
    /// Forgets all strokes from one on: there are so many.
    pub fn truncate(&mut self, strokes: usize) {
        self.kept.truncate(strokes);
    }

    /// What grows in stroke number `nth`, taken from memory where nothing is other than it was.
    fn grown(&mut self, nth: usize, start: Start, stop: &dyn Fn() -> bool) -> Option<&Kept> {
        if self.kept.get(nth).is_none_or(|kept| kept.start != start) {
            self.kept.truncate(nth);
            let plant = Plant { branches: start.wood.clone(), ..Plant::default() };
            let (habit, swept) = (&start.habit, start.swept.clone());
            let begun = Simulation::in_swept(habit, &plant, swept, start.seed, start.limits);
            let simulation = match &start.obstacles {
                Some(obstacles) => begun.among(obstacles.clone()),
                None => begun,
            };
            self.kept.push(Kept { start, simulation, outcome: Outcome::Growing });
        }
        let kept = self.kept.get_mut(nth)?;
        let rounds = ROUNDS.0.saturating_add((ROUNDS.1 * kept.start.swept.balls().len() as f32) as u16);
        while kept.outcome == Outcome::Growing && !is_filled(&kept.simulation, rounds) {
            match kept.simulation.step(stop) {
                Outcome::Stopped => return None,
                outcome => kept.outcome = outcome,
            }
        }
        Some(kept)
    }
}

/// Whether hardly anything has grown of late, or the years are over.
fn is_filled(simulation: &Simulation, rounds: u16) -> bool {
    let (tree, age) = (simulation.tree(), simulation.age());
    let born = &tree.nodes.born;
    let until = |year: u16| born.partition_point(|b| *b <= year) - tree.drawn.len();
    let is_quiet = age >= QUIET && {
        let now = until(age);
        (now - until(age - QUIET)) as f32 <= HARDLY * f32::from(QUIET) * now as f32
    };
    age >= rounds || is_quiet
}

impl Paint {
    /// Lets the plant grow into what the stroke, number `nth` of its drawing, sweeps.
    pub fn grow(
        &self,
        (to, provenance): (&mut PlantAtAge, &Provenance),
        (memory, nth): (&mut Memory, usize),
        (habit, limits): (&Habit, Limits),
        stop: &dyn Fn() -> bool,
    ) -> Painted {
        let mut nearby = reached(&to.plant, &self.swept);
        if nearby.wood.is_empty() {
            let Some(lead) = lead(&to.plant, &self.swept) else { return Painted::OutOfReach };
            to.plant.branches.push(lead);
            nearby = reached(&to.plant, &self.swept);
        }
        let Nearby { branches, wood, thickest } = nearby;
        let wood_names =
            wood_names::names_of_wood(branches.iter().map(|b| &to.plant.branches[*b]), provenance);
        let names: Vec<u64> = wood_names.iter().map(|name| mix(self.seed, *name)).collect();
        let own = OwnLeaves::of(&to.plant);
        let size = (self.radius, self.density);
        let habit = fit::fitted_to_brush(habit, size, &self.swept, (2.0 * thickest, own.length));
        let start = Start {
            habit,
            wood,
            swept: self.swept.clone(),
            obstacles: self.obstacles.clone(),
            seed: self.seed,
            limits,
        };
        let Some(kept) = memory.grown(nth, start, stop) else { return Painted::Stopped };
        add_new_growth(to, (&branches, &names), &kept.simulation, |leaves, usual| {
            own.give_forms(leaves, usual, self.seed)
        });
        match kept.outcome {
            Outcome::Growing | Outcome::Finished | Outcome::Stopped => Painted::Filled,
            _ => Painted::Capped,
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::growth::Field;

    /// The share of the markers in what a stroke sweeps that are taken in the end.
    pub(in crate::growth::brush) fn share_taken(paint: &Paint, on: &PlantAtAge, habit: &Habit) -> f32 {
        let (mut memory, mut plant) = (Memory::default(), on.clone());
        paint.grow(
            (&mut plant, &Provenance::default()),
            (&mut memory, 0),
            (habit, Limits::default()),
            &|| false,
        );
        let Field::Space(markers) = memory.kept[0].simulation.field() else { return 0.0 };
        markers.occupied().count() as f32 / markers.len() as f32
    }
}
