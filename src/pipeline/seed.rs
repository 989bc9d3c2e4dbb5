//! The maker of plants that grow from a seed, in the open or inside a volume.
//!
//! The plant that grew last is kept with all its ages: another age of it costs no growth.

use super::clock::Clock;
use super::growing;
use super::setup::Params;
use super::source::{Ages, MayBear, Produced, Seed};
use crate::anatomy::Anatomy;
use crate::growth::overlay::{Spot, Wanted, overlay};
use crate::growth::{
    self, Envelope, Habit, ObstacleParams, Outcome, PlantAtAge, Schedule, Simulation, drawing,
};
use crate::plant::{Plant, Provenance};
use crate::sketch::Warning;
use crate::species::Species;
use glam::Vec3;
use std::sync::Arc;

/// The plant that was grown last from a seed.
#[derive(Debug, Default)]
pub struct SeedMemory {
    last: Option<Kept>,
}

/// A plant, what it grew from and why it grows no more.
#[derive(Debug)]
struct Kept {
    habit: Habit,
    /// What stands behind it beside what its seed says.
    behind: ObstacleParams,
    seed: Seed,
    simulation: Simulation,
    ended: Outcome,
}

impl Kept {
    fn begin((habit, behind): (&Habit, &ObstacleParams), seed: &Seed) -> Self {
        let begun = match &seed.volume {
            None => Simulation::new(habit, seed.number, seed.limits),
            Some(volume) if seed.wood.is_empty() => {
                Simulation::in_envelope(habit, Envelope::clone(volume), seed.number, seed.limits)
            }
            Some(volume) => {
                let plant = Plant { branches: seed.wood.clone(), ..Plant::default() };
                Simulation::from_skeleton(habit, &plant, Envelope::clone(volume), seed.number, seed.limits)
            }
        };
        let of_seed = seed.obstacles.iter().cloned();
        let obstacles =
            of_seed.chain(behind.beside(Vec3::ZERO)).reduce(|one, other| Arc::new(one.and(&other)));
        let simulation = match obstacles {
            Some(obstacles) => begun.among(obstacles),
            None => begun,
        };
        Self {
            habit: habit.clone(),
            behind: behind.clone(),
            seed: seed.clone(),
            simulation,
            ended: Outcome::Growing,
        }
    }

    /// Whether it is the plant of that seed, at whatever age.
    fn is_of(&self, (habit, behind): (&Habit, &ObstacleParams), seed: &Seed) -> bool {
        let volume = |seed: &Seed| seed.volume.as_ref().map(Arc::as_ptr);
        let obstacles = |seed: &Seed| seed.obstacles.as_ref().map(Arc::as_ptr);
        let known = &self.seed;
        (known.number, known.limits, volume(known)) == (seed.number, seed.limits, volume(seed))
            && obstacles(known) == obstacles(seed)
            && known.wood == seed.wood
            && (&self.habit, &self.behind) == (habit, behind)
    }

    fn filled_at(&self) -> Option<u16> {
        drawing::filled_at(self.simulation.tree(), self.simulation.age())
    }
}

impl SeedMemory {
    /// The plant that grew last.
    pub fn simulation(&self) -> Option<&Simulation> {
        self.last.as_ref().map(|kept| &kept.simulation)
    }

    /// What it looks like from inside, at an age that it has lived through.
    pub(super) fn overlay(&self, age: f32, wanted: Wanted) -> Vec<Spot> {
        self.simulation().map_or_else(Vec::new, |simulation| overlay(simulation, age, wanted))
    }

    /// Grows a seed to an age, without one until its volume is full; nothing if `stop` said yes, but what had grown
    /// until then is kept.
    fn grow(
        &mut self,
        of: (&Habit, &ObstacleParams),
        seed: &Seed,
        age: Option<f32>,
        stop: &dyn Fn() -> bool,
    ) -> Option<(&Simulation, Ages)> {
        let known = self.last.take().filter(|kept| kept.is_of(of, seed));
        let kept = self.last.insert(known.unwrap_or_else(|| Kept::begin(of, seed)));
        let is_wanted = |kept: &Kept| match age {
            Some(age) => f32::from(kept.simulation.age()) < age,
            None => kept.filled_at().is_none(),
        };
        while kept.ended == Outcome::Growing && is_wanted(kept) {
            match kept.simulation.step(stop) {
                Outcome::Stopped => return None,
                outcome => kept.ended = outcome,
            }
        }
        let oldest = f32::from(kept.simulation.age());
        let shown = age.unwrap_or_else(|| kept.filled_at().map_or(oldest, f32::from));
        // What ended growth later than what is shown is not its fault, and a volume in which no bud finds any more room
        // is full.
        let is_full = age.is_none() && kept.ended == Outcome::Finished;
        let outcome = if shown < oldest || is_full { Outcome::Growing } else { kept.ended };
        Some((&kept.simulation, Ages::new(&kept.simulation, shown, outcome)))
    }
}

/// Makes the plant of a seed; nothing if `stop` said yes. A species that does not say how it grows has
/// [`Habit::default`].
pub(super) fn produce(
    memory: &mut SeedMemory,
    seed: &Seed,
    (species, params): (&Species, &Params),
    clock: &mut Clock,
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<Produced> {
    let habit = &params.habit;
    let own = seed.volume.is_none().then_some(habit.age as f32);
    let age = seed.age.or(own).map(|age| age.max(0.0));
    let (simulation, ages) =
        clock.time("growth", || memory.grow((habit, &params.obstacle), seed, age, stop))?;
    let PlantAtAge { plant, buds } = clock.time("plant", || growth::plant_at(simulation, ages.shown));
    let may_bear = may_bear(species, habit, ages.shown);
    let early = growing::why_no_older(ages.outcome, simulation.age());
    let mut remarks: Vec<_> = early.map(|remark| Warning { stroke: None, remark }).into_iter().collect();
    remarks.extend(growing::thinned_leaves(&plant, simulation.limits(), None));
    let (provenance, anatomy) = (Provenance::default(), Anatomy::default());
    let obstacles = simulation.obstacles().cloned();
    Some(Produced {
        plant,
        buds,
        provenance,
        remarks,
        anatomy,
        growth: Some(ages),
        obstacles,
        may_bear,
        ..Produced::default()
    })
}

/// What a plant of an age may bear: one that is too young no flowers, where it is the buds that decide about them, and no fruits.
fn may_bear(species: &Species, habit: &Habit, age: f32) -> MayBear {
    let flowers = |share: &Schedule| share.at(habit.flower_age) > 0.0;
    let decides = flowers(&habit.flowering) || flowers(&habit.flowering_side);
    let set = species.fruit.as_ref().and_then(|fruit| fruit.set.as_ref());
    MayBear {
        flowers: species.blossom.is_none() || !decides || age >= habit.flower_age,
        fruits: set.is_none_or(|set| age >= set.from_age),
    }
}
