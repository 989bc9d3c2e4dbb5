//! The stage between depth and species: the drawn plant grows on, into its crowns or for the years that are asked for.
//!
//! A drawing grows if it has a crown, or if its species says how it grows and years are asked for. A crown for a species
//! that does not say it grows like [`Habit::default`](crate::growth::Habit), and a remark says so.

use super::Params;
use crate::anatomy::Anatomy;
use crate::depth;
use crate::growth::habit::Resource;
use crate::growth::{Field, Memory, Outcome, Start, bloom, drawing, foliage, merge};
use crate::plant::Plant;
use crate::quote;
use crate::sketch::{Remark, Sketch, Warning};
use crate::species::Species;

/// The ages of a drawn plant that grew.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ages {
    /// Age that is shown, years.
    pub shown: f32,
    /// Oldest age that is known of it, years.
    pub oldest: f32,
    /// What its buds compete for.
    pub resource: Resource,
}

/// Whether a drawing grows.
pub(super) fn grows(anatomy: &Anatomy, species: &Species, params: &Params) -> bool {
    !anatomy.crowns.is_empty() || (params.growth.years >= 0.0 && species.growth.is_some())
}

/// Says of a drawing without a crown that fineness, which is another than the species', changes nothing.
pub(super) fn remark_fineness(anatomy: &mut Anatomy, species: &Species, params: &Params) {
    let usual = Params::of_species(species);
    let fineness = |params: &Params| (params.growth.fineness, params.habit.fineness);
    if anatomy.crowns.is_empty() && fineness(params) != fineness(&usual) {
        anatomy.warnings.push(Warning { stroke: None, remark: Remark::FinenessUnused });
    }
}

/// Lets a drawn plant grow. What is odd about it is added to the remarks of its anatomy.
///
/// # Errors
/// The plant as it was drawn, if `stop` said yes.
pub(super) fn grow_on(
    memory: &mut Memory,
    drawn: Plant,
    anatomy: &mut Anatomy,
    (species, params, sketch): (&Species, &Params, &Sketch),
    stop: &dyn Fn() -> bool,
) -> Result<(Plant, Ages), Plant> {
    let growth = &params.growth;
    let grows = merge::grows(&drawn);
    let crowns = depth::crowns(anatomy, &drawn.world_from_canvas);
    let wood = merge::wood(&drawn, &grows);
    let start = Start::new(&params.habit, params.depth.world.height, wood, crowns, growth, sketch.seed);
    let years = (growth.years >= 0.0).then_some(growth.years);
    let Some(grown) = memory.grow(&start, years, stop) else { return Err(drawn) };
    let resource = match grown.simulation.field() {
        Field::Light(_) => Resource::Light,
        Field::Space(_) => Resource::Space,
    };
    let ages = Ages { shown: grown.age, oldest: f32::from(grown.simulation.age()), resource };
    let stroke = anatomy.crowns.first().map(|crown| crown.stroke);
    let mut remark = |remark| anatomy.warnings.push(Warning { stroke, remark });
    if stroke.is_some() && !drawing::is_bound(grown.simulation) {
        remark(Remark::EmptyCrown);
    }
    if species.growth.is_none() {
        let species = quote::name(&species.name);
        remark(Remark::DoesNotGrow { species, known: Species::growing().join(", ") });
    }
    match grown.outcome {
        Outcome::TooManyInternodes(internodes) => remark(Remark::GrowthCapped { internodes }),
        Outcome::TooLarge(_) | Outcome::TooOld(_) => {
            remark(Remark::GrownTooLarge { years: grown.simulation.age() });
        }
        Outcome::TooManySteps(_) => {
            remark(Remark::GrowthTooCostly { years: grown.simulation.age() });
        }
        Outcome::Growing | Outcome::Finished | Outcome::Stopped => {}
    }
    let plant = merge::merged(drawn, &grows, &grown);
    if species.blossom.is_some() && bloom::is_thinned(&plant.buds) {
        remark(Remark::BlossomThinned { flowers: bloom::MOST });
    }
    if foliage::is_thinned(&plant.organs) {
        remark(Remark::LeavesThinned { leaves: foliage::MOST });
    }
    Ok((plant, ages))
}
