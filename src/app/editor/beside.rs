//! The plants beside the drawn one: adding, changing and removing them, and which of them is selected.
//!
//! They stand in the drawing as a list; every change of it is a step to undo like any other, and one drag is one step.

use super::Editor;
use super::dice::another_seed;
use crate::app::action::Action;
use crate::app::panels::snapshot::{AgeState, BesideState, PlantState};
use crate::sketch::{Change, Maker, PlacedPlant, SeedOf, Sketch, limits};
use crate::species::Species;
use glam::{DVec2, Vec2};

/// Height of a new plant where nothing is drawn, as a share of the sheet's.
const SHARE_OF_SHEET: f32 = 0.8;
/// Least height of a new plant beside a drawing, as a share of the sheet's.
const LEAST_SHARE: f32 = 0.25;
/// How far beside the drawing the first plant stands, and how far from each other two stand at least, as shares of the
/// height.
const FROM_DRAWING: f32 = 0.5;
const BETWEEN: f32 = 0.5;
/// What the slider of the age reaches beyond the age that a plant usually has, and its least end in years.
const BEYOND: f32 = 1.5;
const LEAST_AGE: f32 = 10.0;

impl Editor {
    /// Actions about plants beside the drawn one.
    pub(super) fn perform_on_plants(&mut self, action: Action) {
        match action {
            Action::AddPlant(species) => self.add_plant(species),
            Action::SelectPlant(place) => {
                self.beside.select(place.filter(|place| *place < self.sketch().plants.len()));
            }
            Action::SetPlant { place, plant } => self.set_plant(place, plant),
            Action::RollPlantSeed(place) => {
                if let Some(mut plant) = self.sketch().plants.get(place).cloned() {
                    let Maker::Growth(seed) = &mut plant.maker;
                    seed.seed = another_seed(seed.seed);
                    self.set_plant(place, plant);
                }
            }
            Action::RemovePlant(place) => {
                let mut plants = self.sketch().plants.clone();
                if place < plants.len() {
                    plants.remove(place);
                    self.beside.select(None);
                    self.change(Change::plants(plants));
                }
            }
            other => self.perform_on_petals(other),
        }
    }

    /// Adds a plant of a species beside what is there, and selects it.
    fn add_plant(&mut self, species: String) {
        // That of another drawing says nothing.
        let ground = self.live.ground().filter(|_| !self.live.is_working());
        let plants = &self.sketch().plants;
        let (foot, height) = place_for(self.sketch(), ground);
        // Two of one species are two plants.
        let seeds = plants.iter().map(|PlacedPlant { maker: Maker::Growth(known), .. }| known.seed);
        let seed = seeds.max().map_or(1, |last| last.wrapping_add(1));
        let seed = SeedOf { species, seed, age: None };
        let plant = PlacedPlant { maker: Maker::Growth(seed), foot, height: Some(height) };
        let (place, plants) = (plants.len(), [plants.clone(), vec![plant]].concat());
        self.change(Change::plants(plants));
        if place < self.sketch().plants.len() {
            self.beside.select(Some(place));
            if self.layout.shows_all {
                self.perform(Action::FitCanvas);
            }
        }
    }

    /// Changes a plant; one drag is one step.
    pub(super) fn set_plant(&mut self, place: usize, plant: PlacedPlant) {
        let mut plants = self.sketch().plants.clone();
        if let Some(known) = plants.get_mut(place) {
            *known = plant;
            self.change_merging(Change::plants(plants), &format!("plants.{place}"));
        }
    }

    /// What the panel shows of them.
    pub(super) fn beside_state(&self) -> BesideState {
        let Sketch { plants, canvas, .. } = self.sketch();
        let state = |(place, plant): (usize, &PlacedPlant)| {
            let Maker::Growth(SeedOf { species, age, .. }) = &plant.maker;
            let AgeState { years: age, most: most_age, .. } = age_of(species, *age);
            PlantState { plant: plant.clone(), age, most_age, height: self.height_of_plant(place) }
        };
        BesideState {
            plants: plants.iter().enumerate().map(state).collect(),
            selected: self.beside.selected(),
            sheet: [canvas.width, canvas.height],
        }
    }

    /// The height of a plant in canvas pixels: as the drawing says, or else as it has grown; `None` before it was built.
    pub(super) fn height_of_plant(&self, place: usize) -> Option<f32> {
        let plant = self.sketch().plants.get(place)?;
        let grown = || {
            let built = self.built()?;
            let placed = built.beside.get(place)?.as_ref()?;
            Some(placed.height / built.provenance.world_from_canvas.scale)
        };
        plant.height.or_else(grown)
    }
}

/// The age of a plant of a species, that of its own where none is chosen.
pub(super) fn age_of(species: &str, chosen: Option<f32>) -> AgeState {
    let habit = Species::built_in(species).ok().and_then(|species| species.growth);
    let own = habit.unwrap_or_default().age as f32;
    let years = chosen.unwrap_or(own);
    let most = (BEYOND * own).max(years).ceil().clamp(LEAST_AGE, limits::MAX_PLANT_AGE);
    AgeState { years, own, most }
}

/// Foot and height of a new plant: as high as the drawing, on its ground, to its right or left where no other stands.
fn place_for(sketch: &Sketch, ground: Option<f32>) -> (Vec2, f32) {
    let sheet = Vec2::new(sketch.canvas.width, sketch.canvas.height);
    let bounds = sketch.bounds().filter(|_| !sketch.strokes.is_empty());
    let (height, [left, right], lowest) = match bounds {
        Some((low, high)) => {
            let height = (high.y - low.y).max(LEAST_SHARE * sheet.y);
            (height, [low.x - FROM_DRAWING * height, high.x + FROM_DRAWING * height], high.y)
        }
        None => (SHARE_OF_SHEET * sheet.y, [0.5 * sheet.x; 2], sheet.y),
    };
    let is_free = |x: &f32| sketch.plants.iter().all(|plant| (plant.foot.x - x).abs() >= BETWEEN * height);
    // A little more than the least, so that rounding takes no place away.
    let steps = (0..=limits::MAX_PLANTS).map(|step| step as f32 * 1.01 * BETWEEN * height);
    let x = steps.flat_map(|step| [right + step, left - step]).find(is_free).unwrap_or(right);
    let y = ground.unwrap_or(lowest);
    // As people read it in a file.
    (Vec2::new(x.round(), (10.0 * y).round() / 10.0), height.round().max(1.0))
}

/// A place in the window as egui has it.
pub(super) fn to_points(at: DVec2, pixels_per_point: f64) -> egui::Pos2 {
    let at = at / pixels_per_point;
    egui::pos2(at.x as f32, at.y as f32)
}

#[cfg(test)]
#[path = "beside_tests.rs"]
mod tests;
