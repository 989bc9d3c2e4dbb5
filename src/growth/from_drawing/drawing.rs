//! Growth in a drawing: the drawn wood is what the plant begins with, and drawn crowns are what it fills.
//!
//! A [`Start`] is all that decides how a drawing grows; [`Memory`] keeps the plant that grew from the last one with all
//! its ages, so that another age of the same drawing costs no growth. The species' lengths are scaled by the height
//! that the drawing has to the height that the species has.
//!
//! Limits: a crown counts as filled when for [`QUIET`] years hardly anything has grown, or after [`OLDEST`] years.

use super::extend_into_crown;
use crate::budget::Budget;
use crate::growth::habit::Habit;
use crate::growth::limits::{Limits, Outcome};
use crate::growth::obstacle::Obstacles;
use crate::growth::overlay::{Spot, Wanted, overlay};
use crate::growth::simulation::Simulation;
use crate::growth::tree::Tree;
use crate::growth::volume::Envelope;
use crate::growth::volume::{Inflated, Lamp};
use crate::learned_depth::WorldDepth;
use crate::plant::{Branch, Plant};
use glam::Vec2;
use std::sync::Arc;

crate::parameters! {
    /// How a drawn plant grows on.
    pub struct GrowthParams {
        /// Years of growth that are shown. Below 0 the plant decides: a drawn crown is filled, and without one nothing grows beyond what is drawn.
        years: f32 = -1.0, -1.0..=200.0, "years";
        /// How deep a drawn crown is; 1 is as deep as it is wide.
        depth: f32 = 1.0, 0.1..=3.0, "";
        /// How hollow a drawn crown is: 0 grows through, 0.8 leaves a shell of a fifth of its radius.
        hollow: f32 = 0.0, 0.0..=0.9, "";
        /// How fine wood and leaves are in a drawn crown: 2 is twice as fine and several times as heavy.
        fineness: f32 = 1.0, 0.4..=2.0, "";
        /// How strongly growth is led from the drawn wood along the arms of a drawn crown; at 0 only free space draws it.
        guide: f32 = 0.0, 0.0..=3.0, "";
    }
}

/// Age at which a crown counts as filled whatever grows in it.
pub const OLDEST: u16 = 120;
/// Years in succession with hardly any growth after which a crown counts as filled.
pub const QUIET: u16 = 2;
/// Share of all internodes that is hardly any growth in a year.
const HARDLY: f32 = 0.0006;

/// What no drawing may exceed: less than a plant that grows by itself, because it is grown while it is drawn.
pub const LIMITS: Limits = Limits {
    internodes: 120_000,
    markers: 500_000,
    voxels: 16 << 20,
    steps: 2_000_000_000,
    ..Limits::within(&Budget::PLANT)
};

/// The crowns of a drawing in the plane z = 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DrawnCrowns {
    /// Closed outlines, metres; one inside another is a hole.
    pub outlines: Vec<Vec<Vec2>>,
    /// Middles and radii of places where they are sparse, metres.
    pub thin_spots: Vec<(Vec2, f32)>,
    /// The depth that a network gives them, and how much of it is wanted.
    pub learned: Option<(WorldDepth, f32)>,
}

/// All that decides how a drawing grows.
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    habit: Habit,
    /// Drawn wood that grows on; parents before children.
    wood: Vec<Branch>,
    crowns: DrawnCrowns,
    /// What stands beside it.
    obstacles: Option<Arc<Obstacles>>,
    /// Light that was painted.
    lamps: Vec<Lamp>,
    depth: f32,
    hollow: f32,
    guide: f32,
    seed: u64,
    limits: Limits,
}

impl Start {
    /// A drawing of a species: `wood` grows on, into `crowns` if there are any, beside `obstacles`. `height` is what the
    /// drawing's height is in the world, metres.
    pub fn new(
        (habit, params): (&Habit, &GrowthParams),
        height: f32,
        (wood, crowns): (Vec<Branch>, DrawnCrowns),
        obstacles: Option<Arc<Obstacles>>,
        seed: u64,
    ) -> Self {
        let mut habit = habit.scaled(height / habit.height);
        habit.fineness *= params.fineness;
        let &GrowthParams { depth, hollow, guide, .. } = params;
        Self { habit, wood, crowns, obstacles, lamps: Vec::new(), depth, hollow, guide, seed, limits: LIMITS }
    }

    /// The same with painted light.
    #[must_use]
    pub fn lit(self, lamps: Vec<Lamp>) -> Self {
        Self { lamps, ..self }
    }

    /// The plant before its first year.
    fn begin(&self) -> Kept {
        let DrawnCrowns { outlines, thin_spots, learned } = &self.crowns;
        let crown = Inflated::new(outlines.clone(), self.depth);
        let crown = crown.map(|crown| match learned {
            Some((depth, share)) => crown.learned(depth, *share, self.seed),
            None => crown,
        });
        let crown = crown.map(|crown| {
            Arc::new(
                crown.hollowed(self.hollow, &self.wood).guided(self.guide, &self.wood).thinned(thin_spots),
            )
        });
        let mut inside = self.wood.clone();
        if let Some(crown) = &crown {
            extend_into_crown::move_inside(&mut inside, crown);
        }
        let mut wood = inside.clone();
        if let Some(crown) = &crown {
            extend_into_crown::extend(&mut wood, crown);
        }
        let envelope = crown.map_or(Envelope::Free, Envelope::Inflated);
        let plant = Plant { branches: wood, ..Plant::default() };
        let begun = Simulation::from_skeleton(&self.habit, &plant, envelope, self.seed, self.limits);
        let simulation = match &self.obstacles {
            Some(obstacles) => begun.among(obstacles.clone()),
            None => begun,
        }
        .lit(self.lamps.clone());
        Kept { start: self.clone(), inside, simulation, ended: Outcome::Growing }
    }
}

/// A drawing that has grown.
#[derive(Clone, Copy, Debug)]
pub struct Grown<'a> {
    /// The plant with its ages.
    pub simulation: &'a Simulation,
    /// The drawn wood that it began with, point by point, brought inside of the crown's depth.
    pub wood: &'a [Branch],
    /// The age to show, years.
    pub age: f32,
    /// Why it grew no further; [`Outcome::Growing`] where nothing kept it.
    pub outcome: Outcome,
}

/// Whether a drawn crown bounds a plant.
pub fn is_bound(simulation: &Simulation) -> bool {
    matches!(simulation.envelope(), Envelope::Inflated(_))
}

/// The plant that grew last.
#[derive(Debug, Default)]
pub struct Memory {
    last: Option<Kept>,
}

/// A plant, what it grew from and why it grows no more.
#[derive(Debug)]
struct Kept {
    start: Start,
    /// The drawn wood, brought inside of the crown's depth.
    inside: Vec<Branch>,
    simulation: Simulation,
    ended: Outcome,
}

impl Memory {
    /// Forgets it.
    pub fn clear(&mut self) {
        self.last = None;
    }

    /// How the plant that grew last grows, fitted into its crown if it has one.
    pub fn habit(&self) -> Option<&Habit> {
        self.last.as_ref().map(|kept| kept.simulation.habit())
    }

    /// What the plant that grew last looks like from inside, at an age that it has lived through.
    pub fn overlay(&self, age: f32, wanted: Wanted) -> Vec<Spot> {
        self.last.as_ref().map_or_else(Vec::new, |kept| overlay(&kept.simulation, age, wanted))
    }

    /// Grows a drawing to an age, or until its crown is filled; nothing if `stop` said yes, but what had grown until
    /// then is kept. The same start gives the same plant whatever grew before.
    pub fn grow(&mut self, start: &Start, years: Option<f32>, stop: &dyn Fn() -> bool) -> Option<Grown<'_>> {
        let known = self.last.take().filter(|kept| kept.start == *start);
        let kept = self.last.insert(known.unwrap_or_else(|| start.begin()));
        let Kept { inside, simulation, ended, .. } = kept;
        // Crowns that enclose nothing bind nothing: then all there is is what was drawn.
        let years = years.or((!is_bound(simulation)).then_some(0.0));
        let wanted = |s: &Simulation| match years {
            Some(years) => f32::from(s.age()) < years,
            None => filled_at(s.tree(), s.age()).is_none(),
        };
        while *ended == Outcome::Growing && wanted(simulation) {
            match simulation.step(stop) {
                Outcome::Stopped => return None,
                outcome => *ended = outcome,
            }
        }
        let oldest = f32::from(simulation.age());
        let filled = || filled_at(simulation.tree(), simulation.age()).map_or(oldest, f32::from);
        let age = years.map_or_else(filled, |years| years.min(oldest));
        // What ended growth later than what is shown is not its fault.
        let outcome = if age < oldest { Outcome::Growing } else { *ended };
        Some(Grown { simulation, wood: inside, age, outcome })
    }
}

/// The first age, at most `now`, at which a plant had hardly grown for [`QUIET`] years.
pub fn filled_at(tree: &Tree, now: u16) -> Option<u16> {
    let born = &tree.nodes.born;
    let until = |year: u16| born.partition_point(|b| *b <= year);
    let mut quiet = 0;
    for year in 1..=now {
        let (before, after) = (until(year - 1), until(year));
        quiet = if (after - before) as f32 <= HARDLY * after as f32 { quiet + 1 } else { 0 };
        if quiet >= QUIET || year >= OLDEST {
            return Some(year);
        }
    }
    None
}
