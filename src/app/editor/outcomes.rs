//! Pens, wheels and fingers on the canvas, and what comes of them.

use super::Editor;
use super::pens::TabletUpdate;
use crate::app::canvas::{CanvasOutcome, Drawing, Scroll};
use crate::app::canvas_tool::CanvasTool;
use crate::app::messages::Localize;
use crate::app::panels::snapshot::{MenuOf, Notice, PartMenu};
use crate::app::pen_settings::TabletDoubt;
use crate::app::plant_tools::{Keys, PlantTool};
use crate::app::tablets::Reach;
use crate::pen::{PenEvent, PenPhase, PenSample};
use crate::sketch::{Change, Tool};
use glam::DVec2;

impl Editor {
    /// A sample of a pointer over the canvas, or of one that went down over it.
    pub fn pen(&mut self, event: PenEvent) {
        if event.phase == PenPhase::Down {
            self.pens.touches(event.sample.tool);
            self.dialogs.close_part_menu();
        }
        if !self.mark_plant(&event) && !self.hold_plant(&event) && !self.hold_reference(&event) {
            self.on_canvas(|canvas, drawing, out| canvas.pen(&event, drawing, out));
        }
    }

    /// An event of a pointer that went down over the plant, until it is lifted.
    pub fn plant_pen(&mut self, event: &PenEvent) {
        let is_down = event.phase == PenPhase::Down;
        if is_down {
            self.dialogs.close_part_menu();
        }
        let at = event.sample.position;
        // What a second pointer touches while one is at work is not taken hold of.
        let begins = is_down && !self.pens.in_plant.is_busy();
        if begins {
            self.drawing.end_merging();
        }
        let over_carried = begins
            && (self.hold_control_point(at)
                || self.hold_ring(at)
                || self.hold_part(at)
                || self.is_over_selected_plant(at));
        let draws = begins && self.begins_to_draw(&event.sample);
        let taps_draw = self.garden.is_busy();
        let keys = Keys { shift: self.canvas.is_shift_held(), over_carried, draws, taps_draw };
        self.pens.in_plant.event(event, keys, &mut self.plant);
        if draws && !self.pens.in_plant.is_drawing() {
            (self.space.stroke, self.brush.stroke) = (None, None);
            self.garden.drop_stroke();
        }
        self.carry();
        self.draw_in_space();
        if matches!(event.phase, PenPhase::Up | PenPhase::Leave | PenPhase::Cancel) {
            if event.phase == PenPhase::Up {
                self.close_loop(keys.shift);
            }
            self.petals.hold = None;
            self.posing.release();
            self.posing.choosing = None;
            self.drawing.end_merging();
        }
    }

    /// Begins to draw or paint in the view of the plant, if a tool that does is in hand and can begin there.
    fn begins_to_draw(&mut self, sample: &PenSample) -> bool {
        self.begin_in_space(sample) || self.begin_painting(sample) || self.begin_in_garden(sample)
    }

    /// Takes up a tool in the view of the plant; `None` gives it back.
    pub fn take_up_plant_tool(&mut self, tool: Option<PlantTool>) {
        self.pens.in_plant.take_up(tool, &mut self.plant);
    }

    /// Sees how a pen is held, wherever it is in the window.
    pub fn note_pen(&mut self, event: &PenEvent) {
        self.pens.note(event);
    }

    /// A pen came into use: what the artist chose for it holds from now on.
    pub fn take_up_pen(&mut self, name: &str, is_raw: bool, battery: Option<u8>) {
        if self.pens.take_up(name, is_raw, battery) {
            self.apply_settings();
        }
    }

    /// Where tablets may reach: how many monitors there are, and what the pen's own tablet covers.
    pub(in crate::app) fn note_reach(&mut self, reach: &Reach) {
        let pen = self.prefs.pen(self.pens.name());
        self.pens.note_reach(reach, &pen);
    }

    /// Why a tablet cannot be read, or that all can, and of which tablets the model is not sure. What is wrong is reported
    /// once beside the dialog, too: a tablet that does nothing is not looked for there. Whether anything is new.
    pub fn note_tablets(&mut self, trouble: Option<&dyn Localize>, doubts: &[TabletDoubt]) -> bool {
        let trouble = trouble.map(|trouble| trouble.localize(self.prefs.messages()));
        let TabletUpdate { is_any, trouble } = self.pens.note_tablets(trouble, doubts);
        if let Some(what) = trouble {
            self.notify(Notice::warning(what, ""));
        }
        is_any
    }

    /// The wheel over the canvas, at a place in physical pixels.
    pub fn wheel(&mut self, scroll: Scroll, at: DVec2) {
        self.on_canvas(|canvas, _, out| canvas.wheel(scroll, at, out));
    }

    /// A pinch on a touchpad over the canvas: growth as a share and turn, at a place in physical pixels.
    pub fn pinch(&mut self, delta: f64, turn_deg: f64, at: DVec2) {
        self.on_canvas(|canvas, _, out| canvas.pinch(delta, turn_deg, at, out));
    }

    /// Lets the canvas do something and follows what comes of it.
    pub(super) fn on_canvas<T>(
        &mut self,
        act: impl FnOnce(&mut crate::app::canvas::Canvas, &mut Drawing<'_>, &mut Vec<CanvasOutcome>) -> T,
    ) -> T {
        let mut outcomes = std::mem::take(&mut self.outcomes);
        // The branch under a pen in the view of the plant has a name already.
        let in_space = self.space.stroke.as_ref().map(|stroke| stroke.id);
        let painted = self.brush.stroke.as_ref().map(|stroke| stroke.id);
        let in_plant = in_space.max(painted).map_or(0, |id| id.saturating_add(1));
        let mut last = self.drawing.next_id().max(in_plant);
        let mut new_id = || {
            last += 1;
            last - 1
        };
        let mut drawing = Drawing { strokes: &self.drawing.sketch().strokes, new_id: &mut new_id };
        let made = act(&mut self.canvas, &mut drawing, &mut outcomes);
        for outcome in outcomes.drain(..) {
            self.follow(outcome);
        }
        if self.outcomes.is_empty() {
            self.outcomes = outcomes;
        }
        made
    }

    fn follow(&mut self, outcome: CanvasOutcome) {
        match outcome {
            CanvasOutcome::StrokeBegan(_) | CanvasOutcome::StrokeGrew { .. } => self.live.set_stale(),
            CanvasOutcome::StrokeCancelled(_) => {
                self.live.set_stale();
                self.updates.drawing_changed();
            }
            CanvasOutcome::StrokeFinished(stroke) => {
                self.change(Change::put(stroke));
                tracing::debug!("lifted strokes={}", self.sketch().strokes.len());
            }
            CanvasOutcome::Changed(changes) => self.change(Change::strokes(changes)),
            CanvasOutcome::Nudged(changes) => {
                let moved = self.drawing.apply_nudge(changes);
                self.changed_or_notify(moved);
            }
            CanvasOutcome::PreviewChanged => {
                self.live.set_stale();
                self.updates.drawing_changed();
            }
            CanvasOutcome::SelectionChanged => {
                self.drawing.end_nudging();
                self.updates.drawing_changed();
                self.dialogs.close_part_menu();
            }
            CanvasOutcome::ViewChanged => {
                self.dialogs.close_part_menu();
                self.layout.shows_all = false;
            }
            CanvasOutcome::OverlayChanged => {}
            CanvasOutcome::Action(action) => self.perform(action),
            CanvasOutcome::TapOnStroke { id, at } => {
                let strokes = &self.sketch().strokes;
                let Some(stroke) = strokes.iter().find(|s| s.id == id) else { return };
                let at = at / self.layout.pixels_per_point();
                let (of, tool) = (MenuOf::Stroke(id), stroke.tool);
                self.dialogs.ask_for_part(PartMenu { of, tool, at: [at.x as f32, at.y as f32] });
                self.ask_for_ways(id);
            }
            CanvasOutcome::AskWhatToDraw { at } => {
                let at = at / self.layout.pixels_per_point();
                let tool = match self.canvas.tool() {
                    CanvasTool::Draw(tool) => tool,
                    _ => Tool::Auto,
                };
                self.dialogs.ask_for_part(PartMenu { of: MenuOf::Pen, tool, at: [at.x as f32, at.y as f32] });
            }
            CanvasOutcome::Orbit(by) => self.plant.orbit(by),
        }
    }
}

#[cfg(test)]
#[path = "outcomes_tests.rs"]
mod tests;
