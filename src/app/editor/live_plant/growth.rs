//! The plant's age: what the slider shows, and growth replayed from the beginning.
//!
//! A replay is no change of the drawing: only the snapshots for the worker carry another age. Its clock decides the age
//! of each, and the next is handed over when the one before has been built, so that a plant slow to build skips ages and
//! the window never waits. Whatever changes the drawing ends the replay.

use super::LivePlant;
use crate::app::editor::parameters;
use crate::app::editor::replay::Replayed;
use crate::app::panels::growth::YEARS;
use crate::app::panels::snapshot::{GrowthState, ParamValues};
use crate::growth::GrowthParams;
use crate::params::Parameters as _;
use crate::sketch::Sketch;
use serde_json::{Map, Value};

/// The parameter that says at which age a species is shown.
const AGE: &str = "habit.age";
/// What the slider reaches beyond the species' own age.
const BEYOND: f32 = 1.5;
/// Least years on the slider.
const LEAST: f32 = 10.0;

/// Oldest age that the parameter takes.
fn oldest() -> f32 {
    let years = GrowthParams::default().describe().into_iter().find(|known| YEARS.ends_with(&known.path));
    years.map_or(LEAST, |known| known.max as f32)
}

impl LivePlant {
    /// What the panels show of growth.
    pub(in crate::app) fn growth_state(&self, sketch: &Sketch) -> Option<GrowthState> {
        let ages = self.built.as_ref().and_then(|built| built.growth);
        let habit = self.species().and_then(|species| species.growth.as_ref());
        if ages.is_none() && habit.is_none() {
            return None;
        }
        let own = years(sketch);
        let shown = own.or_else(|| ages.map(|ages| ages.shown)).unwrap_or(0.0);
        let replay = self.replay_of(Replayed::Age);
        let shown = replay.map_or(shown, |replay| replay.value());
        let end = replay.map_or(shown, |replay| replay.end());
        let age = own_number(sketch, AGE).or(habit.map(|habit| habit.age as f32));
        let species = BEYOND * age.unwrap_or(0.0);
        Some(GrowthState {
            age: shown,
            most: species.max(end).ceil().clamp(LEAST, oldest()),
            chosen: own.is_some(),
            crown: self.outlines.crowns,
            playing: replay.is_some_and(|replay| replay.is_running()),
            resource: ages.map(|ages| ages.resource),
        })
    }

    /// The parameters of a drawing with what a replay shows.
    pub(super) fn params_of_replay(&self, params: &Map<String, Value>) -> Map<String, Value> {
        let Some(replay) = self.replay else { return params.clone() };
        let path = replay.of().parameter();
        let mut params = parameters::without(params, path);
        params.insert(path.to_owned(), Value::from(replay.value()));
        params
    }
}

/// The age that the artist chose.
fn years(sketch: &Sketch) -> Option<f32> {
    own_number(sketch, YEARS).filter(|years| *years >= 0.0)
}

/// A parameter that the artist changed.
pub(super) fn own_number(sketch: &Sketch, path: &str) -> Option<f32> {
    let flat = ParamValues::of(&Map::new(), &sketch.params);
    flat.own.get(path).map(|number| *number as f32)
}

#[cfg(test)]
#[path = "growth_tests.rs"]
mod tests;
