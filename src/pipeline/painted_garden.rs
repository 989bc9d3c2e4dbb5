//! The garden around a plant, from the strokes that paint it to all that stands there.
//!
//! Its individuals are levels of detail of a few plants of each kind (`garden_plants.rs`), so that a garden of hundreds of them moves
//! under the pen. They are kept from one build to the next while they are wanted; places are found anew, which takes milliseconds
//! (`garden/painted.rs`).
//!
//! Limits: parameters of the drawing, but for the time of the year, are the drawn plant's alone; copies of the drawn plant are all of one
//! individual, of which only the turn, the lean and the size differ.

use super::clock::Clock;
use super::finish::Built;
use super::garden_plants::{MadeOf, PlantOf, individuals};
use super::setup::Params;
use crate::budget::GardenBudget;
use crate::garden::painted::{self, PaintedKind, Placed};
use crate::garden::stock::Individual;
use crate::garden::{Garden, Grown, Place, Stock};
use crate::quote;
use crate::sketch::{GardenPlant, Remark, Sketch, Warning};
use crate::species::Species;
use glam::Vec3Swizzles as _;
use std::sync::Arc;

/// Fewest triangles that a plant has in a garden of too many.
const FEWEST_TRIANGLES: u32 = 250;
/// Room that a plant beside the drawn one keeps free around its foot, metres.
const BESIDE: f32 = 0.3;
/// Height up to which wood stands on the ground, metres.
const GROUND: f32 = 0.02;
/// Room around the foot of a stem, in radii.
const AROUND_STEM: f32 = 4.0;

/// What is kept of a garden from one build to the next.
#[derive(Debug, Default)]
pub struct GardenMemory {
    individuals: Vec<Kept>,
    /// Stocks that were made for the last garden, with what they were made of.
    stocks: Vec<(Vec<MadeOf>, Stock)>,
}

#[derive(Debug)]
struct Kept {
    of: MadeOf,
    models: Vec<Grown>,
}

/// What a garden adds to what was built.
#[derive(Default)]
pub(super) struct LaidOut {
    garden: Option<Garden>,
    remarks: Vec<Remark>,
    stages: Vec<(&'static str, std::time::Duration)>,
}

impl LaidOut {
    /// Puts the garden around a plant.
    pub(super) fn put_into(self, built: &mut Built) {
        built.garden = self.garden.map(Arc::new);
        built.remarks.extend(self.remarks.into_iter().map(|remark| Warning { stroke: None, remark }));
        built.stages.extend(self.stages);
    }
}

/// Lays the garden out around the drawn plant; nothing if `stop` said yes.
pub(super) fn lay_out(
    memory: &mut GardenMemory,
    drawn: &Built,
    sketch: &Sketch,
    (species, params): (&Species, &Params),
    clock: &mut Clock,
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<LaidOut> {
    if sketch.garden.is_empty() {
        *memory = GardenMemory::default();
        return Some(LaidOut::default());
    }
    let (mut remarks, mut plants) = (Vec::new(), Vec::new());
    for kind in painted::kinds(&sketch.garden) {
        match kind {
            GardenPlant::Drawn if drawn.model.triangle_count() == 0 => {
                remarks.push(Remark::NothingToPlant { drawing: None });
            }
            GardenPlant::Drawn => plants.push(PlantOf::drawn(sketch, (species, params))),
            GardenPlant::Drawing(drawing) => plants.push(PlantOf::Drawing(drawing.clone())),
            GardenPlant::Species { name, age } if makes_itself(name) => {
                plants.push(PlantOf::Species(name.clone(), *age));
            }
            GardenPlant::Species { name, .. } => remarks.push(Remark::NoSuchPlantInGarden {
                species: quote::name(name),
                known: Species::by_themselves().join(", "),
            }),
        }
    }
    let placed = placed(drawn, sketch);
    let season = params.season_of_all(species);
    let laid = Laying { drawn, sketch, params, season, plants, placed: &placed };
    let (stock, places) = clock.time("garden", || laid.planted(memory, &mut remarks, stop))?;
    let ground = clock.time("ground", || painted::ground(&sketch.garden, (&placed, &params.garden)));
    let garden = Some(Garden { stock, places, ground, walls: Vec::new() });
    Some(LaidOut { garden, remarks, stages: clock.take() })
}

fn makes_itself(species: &str) -> bool {
    Species::built_in(species).is_ok_and(|species| species.makes_itself())
}

/// What stands on the ground: the drawn plant's stems, and the plants beside it.
fn placed(drawn: &Built, sketch: &Sketch) -> Vec<Placed> {
    let on_ground = drawn.plant.branches.iter().filter(|branch| branch.parent.is_none());
    let stem = |branch: &crate::plant::Branch| {
        let (foot, radius) = (branch.points.first()?, branch.radii.first()?);
        (foot.y <= GROUND).then(|| (foot.xz(), AROUND_STEM * radius))
    };
    let world = drawn.provenance.world_from_canvas;
    let beside = sketch.plants.iter().map(|plant| (world.point(plant.foot).xz(), BESIDE));
    on_ground.filter_map(stem).chain(beside).collect()
}

/// A garden that is laid out.
struct Laying<'a> {
    drawn: &'a Built,
    sketch: &'a Sketch,
    params: &'a Params,
    /// The time of the year where it is not that of each species.
    season: Option<f32>,
    plants: Vec<PlantOf>,
    placed: &'a [Placed],
}

impl Laying<'_> {
    /// The individuals and where their copies stand: as fine as asked for, or as all of them together allow.
    fn planted(
        &self,
        memory: &mut GardenMemory,
        remarks: &mut Vec<Remark>,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Option<(Stock, Vec<Place>)> {
        let mut triangles = vec![self.params.garden.triangles; self.plants.len()];
        let mut made_of = self.made_of(&triangles);
        let mut stock = self.stock(memory, &made_of, stop)?;
        let (mut places, are_all) = self.places(&stock);
        let mut wanted = Vec::new();
        while let Some(kind) = too_heavy(&stock, &places, &triangles) {
            triangles[kind] /= 2;
            wanted.push(std::mem::replace(&mut made_of, self.made_of(&triangles)));
            stock = self.stock(memory, &made_of, stop)?;
        }
        wanted.push(made_of);
        memory.individuals.retain(|kept| wanted.iter().any(|made_of| made_of.contains(&kept.of)));
        memory.stocks.retain(|(made_of, _)| wanted.contains(made_of));
        remarks.extend(self.plants.iter().zip(&stock.kinds).filter_map(|(plant, kind)| match plant {
            PlantOf::Drawing(drawing) if kind.individuals.is_empty() => {
                Some(Remark::NothingToPlant { drawing: Some(quote::name(drawing.name())) })
            }
            _ => None,
        }));
        let fitting = fitting(&stock, &places);
        if fitting < places.len() || !are_all {
            places.truncate(fitting);
            remarks.push(Remark::GardenThinned { plants: places.len() });
        }
        Some((stock, places))
    }

    /// What the kinds are made of with so many triangles each.
    fn made_of(&self, triangles: &[u32]) -> Vec<MadeOf> {
        let of = |(plant, triangles): (&PlantOf, &u32)| MadeOf {
            season: self.season,
            variants: if matches!(plant, PlantOf::Drawn(_)) { 1 } else { self.params.garden.variants },
            plant: plant.clone(),
            triangles: *triangles,
        };
        self.plants.iter().zip(triangles).map(of).collect()
    }

    /// Where plants stand that are as wide as these individuals.
    fn places(&self, stock: &Stock) -> (Vec<Place>, bool) {
        let kinds = self.plants.iter().zip(&stock.kinds).map(|(plant, kind)| PaintedKind {
            plant: plant.planted(),
            width: kind.width(),
            variants: kind.individuals.len() as u32,
        });
        let kinds: Vec<PaintedKind> = kinds.collect();
        let with = (self.placed, &self.params.garden);
        painted::places(&self.sketch.garden, &kinds, with, self.sketch.seed)
    }

    /// The individuals of all kinds, those that are known among them.
    fn stock(
        &self,
        memory: &mut GardenMemory,
        made_of: &[MadeOf],
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Option<Stock> {
        if let Some((_, stock)) = memory.stocks.iter().find(|(known, _)| known == made_of) {
            return Some(stock.clone());
        }
        let mut stock = Stock::default();
        for of in made_of {
            if stop() {
                return None;
            }
            stock.add(of.plant.name(), self.individuals(memory, of), 0.0);
        }
        memory.stocks.push((made_of.to_vec(), stock.clone()));
        Some(stock)
    }

    fn individuals(&self, memory: &mut GardenMemory, of: &MadeOf) -> Vec<Grown> {
        if let Some(known) = memory.individuals.iter().find(|kept| kept.of == *of) {
            return known.models.clone();
        }
        let models = individuals(of, self.drawn);
        memory.individuals.push(Kept { of: of.clone(), models: models.clone() });
        models
    }
}

/// Where all plants together have more triangles than they may, the kind that has most of those that can have fewer.
fn too_heavy(stock: &Stock, places: &[Place], triangles: &[u32]) -> Option<usize> {
    let mut of_kind = vec![0; stock.kinds.len()];
    places.iter().for_each(|place| of_kind[place.kind as usize] += triangles_of(stock, place));
    let is_fine = of_kind.iter().sum::<usize>() <= GardenBudget::PAINTED_TRIANGLES;
    let can_be_coarser =
        (0..of_kind.len()).filter(|kind| !is_fine && triangles[*kind] / 2 >= FEWEST_TRIANGLES);
    can_be_coarser.max_by_key(|kind| of_kind[*kind])
}

/// How many of the places have together no more triangles than a painted garden may have.
fn fitting(stock: &Stock, places: &[Place]) -> usize {
    let sums = places.iter().scan(0, |sum, place| {
        *sum += triangles_of(stock, place);
        Some(*sum)
    });
    sums.take_while(|sum| *sum <= GardenBudget::PAINTED_TRIANGLES).count()
}

fn triangles_of(stock: &Stock, place: &Place) -> usize {
    let individual = stock.kinds[place.kind as usize].individuals.get(place.variant as usize);
    individual.map_or(0, Individual::triangle_count)
}

#[cfg(test)]
#[path = "painted_garden_tests.rs"]
mod tests;
