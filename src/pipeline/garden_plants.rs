//! The plants of which those of a painted garden are copies: of a species, of another drawing, or of the drawing that has the garden.
//!
//! A species is built as if it were alone, from the seeds 1, 2, …; another drawing with its own parameters and with its seed and those
//! after it, so that its individuals differ in what is left to chance. The time of the year that the drawing with the garden says is that of all.
//!
//! Limits: another drawing whose species is not known, or whose parameters cannot be used, is built as any species, or with the usual ones.

use super::clock::Clock;
use super::drawing::{self, DrawingMemory};
use super::finish::{Built, Finish, finish};
use super::seed::SeedMemory;
use super::setup::{Params, params_of, params_of_species, species_or_usual};
use super::source::Seed;
use super::usual_species::DEFAULT_SPECIES;
use super::{alone, levels};
use crate::budget::Budget;
use crate::cards;
use crate::garden::Grown;
use crate::model;
use crate::sketch::{GardenDrawing, GardenPlant, GardenStrokes, Sketch, Textures};
use crate::species::Species;
use rayon::prelude::*;
use std::path::Path;
use std::sync::Arc;

/// All that decides what the individuals of a kind are like.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MadeOf {
    pub(super) plant: PlantOf,
    /// Time of the year; none for the plants' own.
    pub(super) season: Option<f32>,
    /// Triangles of each, at most, about.
    pub(super) triangles: u32,
    pub(super) variants: u32,
}

/// What is planted.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum PlantOf {
    /// A species that makes itself, and its age in years.
    Species(String, Option<f32>),
    /// Another drawing.
    Drawing(GardenDrawing),
    /// The drawing that has the garden, without it, and with what it is made.
    Drawn(Arc<(Sketch, Params, Species)>),
}

impl PlantOf {
    /// The drawing that has the garden.
    pub(super) fn drawn(sketch: &Sketch, (species, params): (&Species, &Params)) -> Self {
        let without = Sketch { garden: GardenStrokes::default(), ..sketch.clone() };
        Self::Drawn(Arc::new((without, params.clone(), species.clone())))
    }

    /// What strokes plant it as.
    pub(super) fn planted(&self) -> GardenPlant {
        match self {
            Self::Species(name, age) => GardenPlant::Species { name: name.clone(), age: *age },
            Self::Drawing(drawing) => GardenPlant::Drawing(drawing.clone()),
            Self::Drawn(_) => GardenPlant::Drawn,
        }
    }

    /// What parts of it are called in files.
    pub(super) fn name(&self) -> &str {
        match self {
            Self::Species(name, _) => name,
            Self::Drawing(drawing) => drawing.name(),
            Self::Drawn(_) => "drawn",
        }
    }
}

/// Makes the individuals of a kind; the drawing that has the garden was built already.
pub(super) fn individuals(of: &MadeOf, drawn: &Built) -> Vec<Grown> {
    let season: Vec<String> = of.season.iter().map(|time| format!("season.time={time}")).collect();
    match &of.plant {
        PlantOf::Drawn(made) => vec![for_garden(drawn, &made.1, of.triangles)],
        PlantOf::Species(name, age) => {
            let Ok(species) = Species::built_in(name) else { return Vec::new() };
            let Ok(params) = params_of_species(&species, &season) else { return Vec::new() };
            let age = age.filter(|_| species.growth.is_some());
            let built = |number: u32| grown_alone((&species, &params), u64::from(number) + 1, age);
            grown(of, &params, built)
        }
        PlantOf::Drawing(drawing) => {
            let Some((species, params)) = set_up(drawing.sketch(), &season) else { return Vec::new() };
            let built = |number: u32| {
                let seed = drawing.sketch().seed.wrapping_add(u64::from(number));
                let built = drawn_alone((&species, &params), &Sketch { seed, ..drawing.sketch().clone() });
                built.filter(|built| built.model.triangle_count() > 0)
            };
            grown(of, &params, built)
        }
    }
}

/// The species and the parameters of another drawing.
fn set_up(sketch: &Sketch, season: &[String]) -> Option<(Species, Params)> {
    // It names no file, so no folder is looked into.
    let species = species_or_usual(sketch, Path::new("")).map(|(species, _)| species);
    let species = species.or_else(|_| Species::built_in(DEFAULT_SPECIES)).ok()?;
    let params = params_of(sketch, &species, season).or_else(|_| params_of_species(&species, season)).ok()?;
    Some((species, params))
}

/// The individuals of a kind, each as `built` makes it by its number from 0.
fn grown(of: &MadeOf, params: &Params, built: impl Fn(u32) -> Option<Built> + Sync) -> Vec<Grown> {
    let individual = |number: u32| {
        let built = built(number)?;
        let remarks = built.remarks.iter().map(ToString::to_string).collect();
        Some(Grown { remarks, ..for_garden(&built, params, of.triangles) })
    };
    (0..of.variants).into_par_iter().filter_map(individual).collect()
}

/// A plant of at most about so many triangles.
fn for_garden(built: &Built, params: &Params, triangles: u32) -> Grown {
    let Built { plant, model, .. } = built;
    levels::for_garden(plant, model, params, triangles).into()
}

/// The plant of a drawing.
fn drawn_alone(with: (&Species, &Params), sketch: &Sketch) -> Option<Built> {
    let (clock, never) = (&mut Clock::default(), &|| false);
    let produced = drawing::produce(&mut DrawingMemory::for_one_build(), sketch, with, clock, never)?;
    let (model, cards) = (&mut model::Cache::for_one_build(), &mut cards::Cache::for_one_build());
    let how = Finish { seed: sketch.seed, pictures: &sketch.textures, budget: Budget::PLANT, placing: None };
    finish((model, cards), produced, with, &how, clock, never)
}

/// A plant of a seed as if it were alone.
fn grown_alone(with: (&Species, &Params), number: u64, age: Option<f32>) -> Option<Built> {
    let (clock, never) = (&mut Clock::default(), &|| false);
    let seed = Seed { number, age, ..Seed::default() };
    let produced = alone::produce(&mut SeedMemory::default(), &seed, with, clock, never)?;
    let (model, cards) = (&mut model::Cache::for_one_build(), &mut cards::Cache::for_one_build());
    let how = Finish { seed: number, pictures: &Textures::default(), budget: Budget::PLANT, placing: None };
    finish((model, cards), produced, with, &how, clock, never)
}
