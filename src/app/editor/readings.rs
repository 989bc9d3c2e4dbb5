//! What strokes were read as together: taking that back, and choosing something else.

use super::Editor;
use super::asked_ways::AskedWays;
use crate::anatomy::conventions::ReadStrokes;
use crate::app::action::Action;
use crate::app::panels::readings;
use crate::app::panels::snapshot::{MenuOf, PartMenu, ReadTogether, Ways};
use crate::app::priority;
use crate::app::theme::Palette;
use crate::app::ways_to_read::ways_to_read;
use crate::pipeline;
use crate::sketch::corrections::corrected;
use crate::sketch::{Change, Correction, Reading, StrokeId, StrokePoint, Tool, Verdict};
use egui::{Shape, Stroke, Ui, pos2};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

impl Editor {
    /// The strokes that were read together, as far as they are still there.
    pub(super) fn read_together(&self) -> Vec<ReadTogether> {
        let readings = self.built().map_or(&[][..], |built| &built.anatomy.readings);
        let together = |read: &ReadStrokes| {
            Some(ReadTogether {
                reading: read.reading,
                stroke: *read.strokes.first()?,
                count: read.strokes.len(),
            })
        };
        readings.iter().filter_map(together).collect()
    }

    /// Shows which strokes belong to the reading that the pointer is over.
    pub(super) fn paint_pointed_reading(&self, ui: &Ui) {
        let Some(read) = readings::pointed_at(ui.ctx()).and_then(|stroke| self.reading_of(stroke)) else {
            return;
        };
        let scale = self.layout.pixels_per_point();
        let line = Stroke::new(5.0, Palette::in_use(ui.visuals()).selection.gamma_multiply(0.45));
        let painter = ui.painter().with_clip_rect(self.layout.canvas);
        for stroke in self.sketch().strokes.iter().filter(|stroke| read.strokes.contains(&stroke.id)) {
            let at = |p: &StrokePoint| {
                let at = self.canvas.view().to_window(p.position.as_dvec2()) / scale;
                pos2(at.x as f32, at.y as f32)
            };
            painter.add(Shape::line(stroke.points.iter().map(at).collect(), line));
        }
    }

    fn reading_of(&self, stroke: StrokeId) -> Option<&ReadStrokes> {
        self.built()?.anatomy.readings.iter().find(|read| read.strokes.contains(&stroke))
    }

    /// The reading that a stroke belongs to is not so.
    pub(super) fn refuse_reading(&mut self, stroke: StrokeId) {
        let Some(read) = self.reading_of(stroke) else { return };
        let refused = Correction::new(read.strokes.iter().copied(), Verdict::Not(read.reading));
        self.correct(refused);
    }

    /// The artist says how strokes are read.
    pub(super) fn correct(&mut self, correction: Correction) {
        self.dialogs.close_part_menu();
        let sketch = self.sketch();
        let ids = sketch.strokes.iter().map(|stroke| stroke.id);
        let corrections = corrected(&sketch.corrections, correction, ids);
        self.change(Change::corrections(corrections));
    }

    /// Shows in which ways the strokes can be read that a stroke was read with, at a place in logical pixels.
    pub(super) fn show_ways(&mut self, stroke: StrokeId, at: [f32; 2]) {
        let of = MenuOf::Reading(stroke);
        self.dialogs.ask_for_part(PartMenu { of, tool: Tool::Auto, at });
        self.ask_for_ways(stroke);
    }

    /// Looks for the ways to read the strokes that this one was read with, or would be without the artist's word.
    pub(super) fn ask_for_ways(&mut self, stroke: StrokeId) {
        let sketch = self.sketch();
        let corrected = || sketch.corrections.iter().rfind(|correction| correction.strokes.contains(&stroke));
        let read = self.reading_of(stroke).map(|read| &read.strokes);
        let Some(about) = read.or_else(|| corrected().map(|correction| &correction.strokes)).cloned() else {
            return;
        };
        let Some(species) = self.live.species() else { return };
        let Ok(params) = pipeline::params_of(sketch, species, &[]) else { return };
        let stop = Arc::new(AtomicBool::new(false));
        let asked = AskedWays::begin(about.clone(), Arc::clone(&stop));
        let (sketch, answers) = (sketch.clone(), self.background.sender().clone());
        let wake = Arc::clone(self.background.wake());
        let work = move || {
            priority::step_back();
            let ways = ways_to_read(&sketch, &params.anatomy, &about, &|| stop.load(Ordering::Relaxed));
            // A window that closed does not listen any more.
            let _ = answers.send(Action::WaysFound { about, ways });
            wake();
        };
        match std::thread::Builder::new().name("ways to read".into()).spawn(work) {
            Ok(_) => self.dialogs.set_ways(asked),
            Err(error) => self.notify_error(&error),
        }
    }

    /// What the menu shows of the ways to read its strokes.
    pub(super) fn ways(&self) -> Option<Ways> {
        let asked = self.dialogs.ways()?;
        let (about, found) = (asked.about(), asked.found().map(<[_]>::to_vec));
        Some(Ways { count: about.len(), reading: self.reading_now(about), found })
    }

    /// What most of these strokes are read as.
    fn reading_now(&self, about: &[StrokeId]) -> Option<Reading> {
        about.iter().find_map(|stroke| self.reading_of(*stroke)).map(|read| read.reading)
    }
}

#[cfg(test)]
#[path = "readings_tests.rs"]
mod tests;
