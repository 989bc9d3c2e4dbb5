//! From what a plant is made from to its model: every stage in a row.
//!
//! ```text
//! Source ──produce──► Produced { plant, provenance, .. } ──finish──► Built { plant, model, .. }
//!   drawing, seed, bloom  one file for each maker           species, pictures, surfaces: the same for all
//! ```
//!
//! A drawing may name plants that stand beside the drawn one. Each goes this way by itself; then they are put together
//! (`beside`). Around them lies the garden that is painted on the ground (`painted_garden`).
//!
//! The one place that knows the order of the stages. Live, cached and headless builds are the same code:
//! [`build`] is [`build_with`] an empty cache and nothing that stops it. In memory only: reading and writing files are the
//! callers'.

mod alone;
mod bare_stems;
mod beside;
mod bloom;
mod brushing;
mod clock;
mod clump;
mod drawing;
mod figure_plant;
mod finish;
mod garden_plants;
mod growing;
mod individuals;
mod levels;
mod painted_garden;
mod placing;
mod proposed_species;
mod rose;
mod seed;
mod seen;
mod setup;
mod source;
mod stem_leaves;
mod thinning;
mod triangle_budget;
mod usual_species;

pub use beside::Beside;
pub use clock::Clock;
pub use drawing::DrawingMemory;
pub use finish::Built;
pub use individuals::{FEWEST_TRIANGLES, Form, Grower, triangles_of_each};
pub use levels::{Level, LevelSet, levels, levels_of_drawing};
pub use painted_garden::GardenMemory;
pub use placing::BuiltBeside;
pub use seed::SeedMemory;
pub use seen::{seen, seen_as};
pub use setup::{
    Params, SetupError, check_blooms, check_grows, params_of, params_of_species, species_file, species_of,
    species_or_usual, usual_species,
};
pub use source::{Ages, Bloom, Produced, Seed, Source};
pub use triangle_budget::coarsened;
pub use usual_species::{DEFAULT_SPECIES, species_of_habit};

use crate::budget::Budget;
use crate::cards;
use crate::growth::overlay::Wanted;
use crate::model;
use crate::sketch::{Sketch, Textures};
use crate::species::Species;
use finish::Finish;
use std::sync::atomic::{AtomicBool, Ordering};

/// What [`build_with`] keeps from one build to the next.
#[derive(Debug, Default)]
pub struct Cache {
    /// Meshes of parts.
    pub model: model::Cache,
    /// Pictures of foliage.
    pub cards: cards::Cache,
    /// The drawing that was built last.
    pub drawing: DrawingMemory,
    /// The plant that grew last from a seed.
    pub seed: SeedMemory,
    /// The plants beside the drawn one.
    pub beside: Beside,
    /// What grows in the garden around it.
    pub garden: GardenMemory,
}

impl Cache {
    /// The name of a sketch's species: its own, or that of what it shows; what was read for that is kept for its build.
    pub fn species_name(&mut self, sketch: &Sketch) -> String {
        if let Some(name) = &sketch.species {
            return name.clone();
        }
        let params = setup::convention_params(sketch, &[]);
        species_of_habit(self.drawing.habit(sketch, &params)).to_owned()
    }

    /// Adds to what [`build_with`] has just built what is wanted of its growth, at the age that it shows.
    pub fn look_inside(&self, source: Source<'_>, built: &mut Built, wanted: Wanted) {
        let Some(ages) = built.growth.filter(|_| wanted.any()) else { return };
        built.overlay = match source {
            Source::Drawing(_) => self.drawing.overlay(ages.shown, wanted),
            Source::Seed(_) => self.seed.overlay(ages.shown, wanted),
            Source::Bloom(_) => Vec::new(),
        };
    }
}

/// Builds a plant. Same input, same output, on any number of threads. A source without anything to build gives an empty
/// model.
pub fn build<'a>(source: impl Into<Source<'a>>, species: &Species, params: &Params) -> Built {
    let (model, drawing) = (model::Cache::for_one_build(), DrawingMemory::for_one_build());
    let cards = cards::Cache::for_one_build();
    let mut cache = Cache { model, cards, drawing, ..Cache::default() };
    let built = build_with(&mut cache, source, species, params, &|| false);
    built.unwrap_or_else(|| unreachable!("nothing stops it"))
}

/// Builds the very plant that [`build`] gives, again and again while its source changes: what is the same as when the
/// cache was last used is not made again. `stop` is asked between the stages and inside the long ones, from any thread;
/// once it says yes the build ends soon and gives nothing. The cache survives that.
pub fn build_with<'a>(
    cache: &mut Cache,
    source: impl Into<Source<'a>>,
    species: &Species,
    params: &Params,
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<Built> {
    let stopped = AtomicBool::new(false);
    // The stages count on a yes that stays.
    let stop = || {
        if !stopped.load(Ordering::Relaxed) && stop() {
            stopped.store(true, Ordering::Relaxed);
        }
        stopped.load(Ordering::Relaxed)
    };
    let (mut clock, with) = (Clock::default(), (species, params));
    match source.into() {
        Source::Drawing(sketch) => {
            let mut produced = drawing::produce(&mut cache.drawing, sketch, with, &mut clock, &stop)?;
            let is_alone = sketch.plants.is_empty() && sketch.garden.is_empty();
            if !is_alone && produced.is_bare() {
                let height = params.depth.world.height;
                produced.provenance.world_from_canvas = placing::world_of_sheet(sketch.canvas, height);
            }
            let budget = beside::budget_of_drawn(sketch.plants.len());
            let how = Finish { seed: sketch.seed, pictures: &sketch.textures, budget, placing: None };
            let drawn = finish::finish(
                (&mut cache.model, &mut cache.cards),
                produced,
                with,
                &how,
                &mut clock,
                &stop,
            )?;
            let garden = painted_garden::lay_out(&mut cache.garden, &drawn, sketch, with, &mut clock, &stop)?;
            let others = (&sketch.plants[..], params.season_of_all(species));
            let mut built = beside::add(&mut cache.beside, drawn, others, &mut clock, &stop)?;
            garden.put_into(&mut built);
            Some(built)
        }
        Source::Bloom(bloom) => {
            let produced = clock.time("bloom", || bloom::produce(bloom, with));
            let pictures = &Textures::default();
            let how = Finish { seed: bloom.number, pictures, budget: Budget::PLANT, placing: None };
            finish::finish((&mut cache.model, &mut cache.cards), produced, with, &how, &mut clock, &stop)
        }
        Source::Seed(seed) => {
            let produced = alone::produce(&mut cache.seed, seed, with, &mut clock, &stop)?;
            let pictures = &Textures::default();
            let how = Finish { seed: seed.number, pictures, budget: Budget::PLANT, placing: None };
            finish::finish((&mut cache.model, &mut cache.cards), produced, with, &how, &mut clock, &stop)
        }
    }
}
