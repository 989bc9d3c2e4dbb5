//! The plant's age: what the slider shows, and growth replayed from the beginning.
//!
//! A replay is no change of the drawing: only the snapshots for the worker carry another age. Its clock decides the age
//! of each, and the next is handed over when the one before has been built, so that a plant slow to build skips ages and
//! the window never waits. Whatever changes the drawing ends the replay.

use super::Editor;
use crate::app::panels::growth::YEARS;
use crate::app::panels::snapshot::GrowthState;
use crate::growth::GrowthParams;
use crate::params::Parameters as _;
use serde_json::{Map, Value};
use std::time::{Duration, Instant};

/// The parameter that says at which age a species is shown.
const AGE: &str = "habit.age";
/// Length of a replay.
const REPLAY: Duration = Duration::from_secs(5);
/// Least time from one age to the next.
const FRAME: Duration = Duration::from_millis(16);
/// What the slider reaches beyond the species' own age.
const BEYOND: f32 = 1.5;
/// Least years on the slider.
const LEAST: f32 = 10.0;

/// Oldest age that the parameter takes.
fn oldest() -> f32 {
    let years = GrowthParams::default().describe().into_iter().find(|known| YEARS.ends_with(&known.path));
    years.map_or(LEAST, |known| known.max as f32)
}

/// Growth that is being replayed, or pauses.
#[derive(Clone, Copy, Debug)]
pub(super) struct Replay {
    /// Age at its end, years.
    end: f32,
    /// Time that it has run.
    run: Duration,
    /// When it was last looked at; `None` while it pauses.
    seen: Option<Instant>,
}

impl Replay {
    fn age(&self) -> f32 {
        self.end * (self.run.as_secs_f32() / REPLAY.as_secs_f32()).min(1.0)
    }
}

/// The parameters with the age of a replay.
pub(super) fn at_age(params: &Map<String, Value>, replay: Option<&Replay>) -> Map<String, Value> {
    let Some(replay) = replay else { return params.clone() };
    let mut params = super::perform::without(params, YEARS);
    params.insert(YEARS.to_owned(), Value::from(replay.age()));
    params
}

impl Editor {
    /// What the panels show of growth.
    pub(super) fn growth_state(&self) -> Option<GrowthState> {
        let ages = self.built.as_ref().and_then(|built| built.growth);
        let habit = self.species.as_ref().and_then(|(_, species)| species.growth.as_ref());
        if ages.is_none() && habit.is_none() {
            return None;
        }
        let own = self.years();
        let shown = own.or_else(|| ages.map(|ages| ages.shown)).unwrap_or(0.0);
        let shown = self.building.replay.map_or(shown, |replay| replay.age());
        let end = self.building.replay.map_or(shown, |replay| replay.end);
        let age = self.own_number(AGE).or(habit.map(|habit| habit.age as f32));
        let species = BEYOND * age.unwrap_or(0.0);
        Some(GrowthState {
            age: shown,
            most: species.max(end).ceil().clamp(LEAST, oldest()),
            chosen: own.is_some(),
            crown: self.outlines.crowns,
            playing: self.is_playing(),
            resource: ages.map(|ages| ages.resource),
        })
    }

    /// The age that the artist chose.
    fn years(&self) -> Option<f32> {
        self.own_number(YEARS).filter(|years| *years >= 0.0)
    }

    /// A parameter that the artist changed.
    fn own_number(&self, path: &str) -> Option<f32> {
        let params = &self.document.sketch().params;
        let flat = crate::app::panels::snapshot::ParamValues::of(&Map::new(), params);
        flat.own.get(path).map(|number| *number as f32)
    }

    /// Whether growth is being replayed right now.
    pub(super) fn is_playing(&self) -> bool {
        self.building.replay.is_some_and(|replay| replay.seen.is_some())
    }

    /// Replays growth from the beginning, goes on where it paused, or pauses.
    pub(super) fn play_growth(&mut self, on: bool) {
        let now = on.then(Instant::now);
        match &mut self.building.replay {
            Some(replay) => replay.seen = now,
            None if on => {
                let end = self.growth_state().map_or(0.0, |state| state.age);
                self.building.replay = (end > 0.0).then_some(Replay { end, run: Duration::ZERO, seen: now });
                self.building.is_stale = self.building.replay.is_some();
            }
            None => {}
        }
    }

    /// When the next age of a replay is due; `None` while one is being built.
    pub(super) fn next_age_at(&self) -> Option<Instant> {
        let seen = self.building.replay.filter(|_| !self.building.is_running)?.seen?;
        Some(seen + FRAME)
    }

    /// Hands the next age over, once the one before has been built.
    pub(super) fn replay_growth(&mut self) {
        self.plant.keeps_room = self.building.replay.is_some();
        let Some(replay) = self.building.replay.as_mut().filter(|_| !self.building.is_running) else {
            return;
        };
        let Some(seen) = replay.seen else { return };
        let now = Instant::now();
        if now < seen + FRAME {
            return;
        }
        replay.seen = Some(now);
        self.advance_replay(now - seen);
    }

    /// Moves a replay on by a time.
    fn advance_replay(&mut self, by: Duration) {
        let Some(replay) = &mut self.building.replay else { return };
        replay.run += by;
        self.building.is_stale = true;
        if replay.run >= REPLAY {
            self.building.replay = None;
        }
    }
}

#[cfg(test)]
#[path = "growth_tests.rs"]
mod tests;
