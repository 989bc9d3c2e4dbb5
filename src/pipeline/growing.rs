//! The stage between depth and species: the drawn plant grows on, into its crowns or for the years that are asked for.
//!
//! A drawing grows if it has a crown, or if its species says how it grows and years are asked for. A crown for a species
//! that does not say it grows like [`Habit::default`](crate::growth::Habit), and a remark says so.

use super::brushing;
use super::setup::Params;
use super::source::Ages;
use crate::anatomy::Anatomy;
use crate::depth;
use crate::growth::{
    DrawnCrowns, Limits, Memory, Obstacles, Outcome, PlantAtAge, Start, Younger, drawing, foliage, merge,
};
use crate::learned_depth::DepthField;
use crate::plant::{Continued, Plant, Provenance};
use crate::quote;
use crate::sketch::{PartName, PartPose, Remark, Sketch, StrokeId, Warning};
use crate::species::Species;
use std::sync::Arc;

/// Whether a drawing grows.
pub(super) fn grows(anatomy: &Anatomy, species: &Species, params: &Params) -> bool {
    !anatomy.crowns.is_empty() || (params.growth.years >= 0.0 && species.growth.is_some())
}

/// The remark that fineness, which is another than the species', changes nothing in a drawing without a crown.
pub(super) fn fineness_unused(anatomy: &Anatomy, species: &Species, params: &Params) -> Option<Warning> {
    let usual = Params::of_species(species);
    let fineness = |params: &Params| (params.growth.fineness, params.habit.fineness);
    let is_unused = anatomy.crowns.is_empty() && fineness(params) != fineness(&usual);
    is_unused.then_some(Warning { stroke: None, remark: Remark::FinenessUnused })
}

/// A drawn plant that has grown.
pub(super) struct GrownDrawing {
    /// The plant.
    pub(super) made: PlantAtAge,
    /// How old it is.
    pub(super) ages: Ages,
    /// Branches that run on in the lines of others.
    pub(super) continued: Vec<Continued>,
}

/// Lets a drawn plant grow, and remarks what is odd about that; nothing if `stop` said yes.
pub(super) fn grow_on(
    memory: &mut Memory,
    (drawn, provenance): (Plant, &Provenance),
    (anatomy, field): (&Anatomy, Option<&Arc<DepthField>>),
    (species, params): (&Species, &Params),
    (sketch, obstacles): (&Sketch, Option<Arc<Obstacles>>),
    remarks: &mut Vec<Warning>,
    stop: &dyn Fn() -> bool,
) -> Option<GrownDrawing> {
    let growth = &params.growth;
    let grows = merge::grows(&drawn);
    let world = provenance.world_from_canvas;
    let crowns = DrawnCrowns {
        outlines: depth::crowns(anatomy, &world),
        thin_spots: depth::thin_spots(anatomy, &world),
        learned: field.map(|field| (field.in_world(world), params.depth.learned.crown)),
    };
    let wood = merge::wood(&drawn, &grows);
    let with = (&params.habit, growth);
    let start = Start::new(with, params.depth.world.height, (wood, crowns), obstacles, sketch.seed)
        .lit(brushing::lamps(sketch, &world));
    let years = (growth.years >= 0.0).then_some(growth.years);
    let grown = memory.grow(&start, years, stop)?;
    let ages = Ages::new(grown.simulation, grown.age, grown.outcome);
    let stroke = anatomy.crowns.first().map(|crown| crown.stroke);
    let mut of_growth = Vec::new();
    if stroke.is_some() && !drawing::is_bound(grown.simulation) {
        of_growth.push(Remark::EmptyCrown);
    }
    if species.growth.is_none() {
        let species = quote::name(&species.name);
        of_growth.push(Remark::DoesNotGrow { species, known: Species::growing().join(", ") });
    }
    of_growth.extend(why_no_older(grown.outcome, grown.simulation.age()));
    remarks.extend(of_growth.into_iter().map(|remark| Warning { stroke, remark }));
    let posed = sketch.part_poses.iter().filter_map(|pose| match pose.part {
        PartName::Grown(name) => Some(name),
        PartName::Stroke(_) => None,
    });
    let by_artist = (&posed.collect(), &younger(&sketch.part_poses));
    let (made, continued) = merge::merged((drawn, provenance), &grows, &grown, by_artist);
    remarks.extend(thinned_leaves(&made.plant, grown.simulation.limits(), stroke));
    Some(GrownDrawing { made, ages, continued })
}

/// How many years younger the artist made branches.
fn younger(poses: &[PartPose]) -> Younger {
    let mut younger = Younger::default();
    for pose in poses.iter().filter(|pose| pose.younger > 0) {
        match pose.part {
            PartName::Grown(name) => younger.grown.insert(name, pose.younger),
            PartName::Stroke(stroke) => younger.drawn.insert(stroke, pose.younger),
        };
    }
    younger
}

/// Why growth ended before what was asked for, at an age.
pub(super) fn why_no_older(outcome: Outcome, years: u16) -> Option<Remark> {
    match outcome {
        Outcome::TooManyInternodes(internodes) => Some(Remark::GrowthCapped { internodes }),
        Outcome::TooLarge(_) | Outcome::TooOld(_) => Some(Remark::GrownTooLarge { years }),
        Outcome::TooManySteps(_) => Some(Remark::GrowthTooCostly { years }),
        Outcome::Growing | Outcome::Finished | Outcome::Stopped => None,
    }
}

/// The remark that a grown plant has fewer leaves than its species asks for. Before the species is applied: then some of the
/// leaves stand as flowers.
pub(super) fn thinned_leaves(plant: &Plant, limits: &Limits, stroke: Option<StrokeId>) -> Option<Warning> {
    let is_thinned = foliage::is_thinned(&plant.organs, limits.leaves);
    is_thinned.then_some(Warning { stroke, remark: Remark::LeavesThinned { leaves: limits.leaves } })
}
