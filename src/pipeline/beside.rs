//! The plants that stand beside the drawn one: each is produced by its own maker and finished by its own species, as if it
//! were alone, and then put behind the drawn one in one plant and one model.
//!
//! What one of them depends on is its own entry, its place in the world and its share of the budget. While these stay, it
//! is kept whole; while only its place, size or age changes, it does not grow anew.
//!
//! Limits: parameters and textures of the drawing are those of the drawn plant alone, but for the time of the year, which all have;
//! species are built-in ones. When the drawing's scale changes, the surfaces of all plants are made anew.

use super::alone;
use super::clock::Clock;
use super::finish::{Built, Finish, finish};
use super::placing::{BuiltBeside, Placing, height_above};
use super::seed::SeedMemory;
use super::setup::{Params, params_of_species};
use super::source::Seed;
use crate::budget::Budget;
use crate::cards;
use crate::growth::Limits;
use crate::model::{self, Model, Part};
use crate::plant::WorldFromCanvas;
use crate::quote;
use crate::sketch::{Maker, PlacedPlant, Remark, SeedOf, Textures, Warning};
use crate::species::Species;
use glam::Vec3;
use std::collections::BTreeSet;
use std::sync::Arc;

/// What is kept of the plants beside the drawn one from one build to the next.
#[derive(Debug, Default)]
pub struct Beside {
    kept: Vec<Kept>,
}

/// What is kept of one plant.
#[derive(Debug)]
struct Kept {
    maker: Maker,
    /// Its species and parameters; none where there is no such species that grows.
    with: Option<Box<(Species, Params)>>,
    seed: SeedMemory,
    model: model::Cache,
    last: Option<(Request, Arc<Made>)>,
}

/// All that decides what a plant is like.
#[derive(Clone, Debug, PartialEq)]
struct Request {
    maker: Maker,
    placing: Placing,
    budget: Budget,
    /// The time of the year; none for that of its species.
    season: Option<f32>,
}

/// What became of a plant.
#[derive(Debug)]
enum Made {
    /// It stands there.
    Stands(Box<Built>),
    /// It was left out.
    LeftOut(Remark),
}

/// The budget of a drawn plant beside which so many others stand: of the triangles the others have half.
pub(super) fn budget_of_drawn(others: usize) -> Budget {
    let halves = if others == 0 { 1 } else { 2 };
    Budget { triangles: Budget::PLANT.triangles / halves, ..Budget::PLANT }
}

/// The budget of each of so many plants beside a drawn one.
fn budget_of_each(plants: usize) -> Budget {
    let share = Budget::PLANT.shared_by(plants);
    Budget { triangles: share.triangles / 2, ..share }
}

/// Puts the plants behind the drawn one; nothing if `stop` said yes, but what was made until then is kept.
pub(super) fn add(
    memory: &mut Beside,
    mut drawn: Built,
    (plants, season): (&[PlacedPlant], Option<f32>),
    clock: &mut Clock,
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<Built> {
    memory.arrange(plants);
    if plants.is_empty() {
        return Some(drawn);
    }
    let (world, budget) = (drawn.provenance.world_from_canvas, budget_of_each(plants.len()));
    let kept = memory.kept.iter_mut().zip(plants);
    let with = (budget, season);
    let made: Option<Vec<Arc<Made>>> = clock
        .time("plants beside", || kept.map(|(kept, plant)| kept.make(plant, &world, with, stop)).collect());
    let mut names = Names::of(&drawn.model);
    for (i, (made, plant)) in made?.iter().zip(plants).enumerate() {
        let of_plant = |remark: &Remark| Warning {
            stroke: None,
            remark: Remark::OfPlant {
                place: i + 1,
                species: quote::name(plant.maker.species()),
                remark: Box::new(remark.clone()),
            },
        };
        match &**made {
            Made::LeftOut(remark) => {
                drawn.remarks.push(of_plant(remark));
                drawn.beside.push(None);
            }
            Made::Stands(built) => {
                drawn.remarks.extend(built.remarks.iter().map(|warning| of_plant(&warning.remark)));
                let foot = Placing::new(plant, &world).foot();
                let placed = put_behind(&mut drawn, built, (plant.maker.species(), foot), &mut names);
                drawn.beside.push(Some(placed));
            }
        }
    }
    drawn.stages.extend(clock.take());
    Some(drawn)
}

impl Beside {
    /// Brings what is kept into the order of the plants: first comes what is kept of the very same plant, then what is kept
    /// of it at another age. What is kept of no plant is forgotten.
    fn arrange(&mut self, plants: &[PlacedPlant]) {
        let mut old: Vec<Option<Kept>> = std::mem::take(&mut self.kept).into_iter().map(Some).collect();
        let mut new: Vec<Option<Kept>> = plants.iter().map(|_| None).collect();
        let rules: [fn(&Maker, &Maker) -> bool; 2] = [|a, b| a == b, grows_the_same];
        for is_it in rules {
            for (place, plant) in new.iter_mut().zip(plants).filter(|(place, _)| place.is_none()) {
                let mut of_it = old
                    .iter_mut()
                    .filter(|kept| kept.as_ref().is_some_and(|kept| is_it(&kept.maker, &plant.maker)));
                *place = of_it.next().and_then(Option::take);
            }
        }
        let begun = |(kept, plant): (Option<Kept>, &PlacedPlant)| match kept {
            Some(kept) => Kept { maker: plant.maker.clone(), ..kept },
            None => Kept::begin(&plant.maker),
        };
        self.kept = new.into_iter().zip(plants).map(begun).collect();
    }
}

/// Whether two plants differ in nothing but their age.
fn grows_the_same(a: &Maker, b: &Maker) -> bool {
    let (Maker::Growth(a), Maker::Growth(b)) = (a, b);
    (&a.species, a.seed) == (&b.species, b.seed)
}

impl Kept {
    fn begin(maker: &Maker) -> Self {
        let species = Species::built_in(maker.species()).ok().filter(Species::makes_itself);
        let with = species.and_then(|species| {
            let params = params_of_species(&species, &[]).ok()?;
            Some(Box::new((species, params)))
        });
        let (seed, model) = (SeedMemory::default(), model::Cache::default());
        Self { maker: maker.clone(), with, seed, model, last: None }
    }

    /// Makes the plant, unless it is the one that was made last.
    fn make(
        &mut self,
        plant: &PlacedPlant,
        world: &WorldFromCanvas,
        (budget, season): (Budget, Option<f32>),
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Option<Arc<Made>> {
        let placing = Placing::new(plant, world);
        let request = Request { maker: plant.maker.clone(), placing, budget, season };
        if let Some((_, made)) = self.last.as_ref().filter(|(last, _)| *last == request) {
            return Some(made.clone());
        }
        let made = Arc::new(self.made(&request, stop)?);
        self.last = Some((request, made.clone()));
        Some(made)
    }

    fn made(&mut self, request: &Request, stop: &(dyn Fn() -> bool + Sync)) -> Option<Made> {
        let Self { with, seed: memory, model, .. } = self;
        let Some((species, params)) = with.as_deref_mut() else {
            return Some(Made::LeftOut(Remark::NoSuchPlant { known: Species::by_themselves().join(", ") }));
        };
        params.season.time = request.season.unwrap_or(species.season.time);
        let (species, params) = (&*species, &*params);
        let Maker::Growth(SeedOf { species: _, seed: number, age }) = request.maker;
        let seed = Seed { number, age, limits: Limits::within(&request.budget), ..Seed::default() };
        // Times of the stages are counted together.
        let clock = &mut Clock::default();
        let produced = alone::produce(memory, &seed, (species, params), clock, stop)?;
        if !request.placing.fits(&produced.plant) {
            return Some(Made::LeftOut(Remark::PlantOutOfScale));
        }
        let pictures = &Textures::default();
        let how = Finish { seed: number, pictures, budget: request.budget, placing: Some(&request.placing) };
        // Their parameters are those of their species, which has no cards.
        let cards = &mut cards::Cache::for_one_build();
        finish((model, cards), produced, (species, params), &how, clock, stop)
            .map(|built| Made::Stands(Box::new(built)))
    }
}

/// Puts a plant of this species, which stands there, with its model behind those that are there.
fn put_behind(all: &mut Built, one: &Built, (species, foot): (&str, Vec3), names: &mut Names) -> BuiltBeside {
    let (branches, organs) = (all.plant.branches.len(), all.plant.organs.len());
    let materials = all.plant.append(&one.plant, species);
    let prefix = names.prefix(species);
    let first = all.model.parts.len();
    let specimens = all.model.parts.iter().map(|part| part.specimen + 1).max().unwrap_or(0);
    all.model.parts.extend(one.model.parts.iter().map(|part| Part {
        name: names.unused(format!("{prefix}_{}", part.name)).into(),
        parent: part.parent.map(|parent| parent + first),
        specimen: part.specimen + specimens,
        material: materials[part.material],
        more_materials: part.more_materials.iter().map(|material| materials[*material]).collect(),
        ..part.clone()
    }));
    all.model.materials = all.plant.materials().to_vec();
    BuiltBeside {
        branches: branches..all.plant.branches.len(),
        organs: organs..all.plant.organs.len(),
        foot,
        height: height_above(foot.y, &one.plant),
    }
}

/// Names of parts that are taken, and how many plants of each species there are.
struct Names {
    taken: BTreeSet<String>,
    plants: Vec<String>,
}

impl Names {
    fn of(model: &Model) -> Self {
        Self { taken: model.parts.iter().map(|part| part.name.to_string()).collect(), plants: Vec::new() }
    }

    /// What the names of the parts of a plant begin with: its species, from the second of a species on with a number.
    fn prefix(&mut self, species: &str) -> String {
        self.plants.push(species.to_owned());
        match self.plants.iter().filter(|known| **known == species).count() {
            1 => species.to_owned(),
            number => format!("{species}_{number}"),
        }
    }

    /// The name, with a number behind it if it is taken.
    fn unused(&mut self, name: String) -> String {
        let mut names = std::iter::once(name.clone()).chain((2..).map(|n| format!("{name}_{n}")));
        let free = names.find(|name| !self.taken.contains(name)).unwrap_or(name);
        self.taken.insert(free.clone());
        free
    }
}
