//! Pens, wheels and fingers on the canvas, and what comes of them.

use super::Editor;
use crate::app::action::CanvasTool;
use crate::app::canvas::{CanvasOutcome, Drawing, Scroll};
use crate::app::messages::Localize;
use crate::app::panels::snapshot::{MenuOf, Notice, PartMenu, PenLive, PenUsed};
use crate::app::pen_settings::TabletDoubt;
use crate::app::tablets::Reach;
use crate::pen::{PenEvent, PenPhase, PenTool};
use crate::sketch::{Change, Tool};
use glam::DVec2;

impl Editor {
    /// A sample of a pointer over the canvas, or of one that went down over it.
    pub fn pen(&mut self, event: PenEvent) {
        if event.phase == PenPhase::Down {
            self.pen_used = match event.sample.tool {
                PenTool::Mouse => PenUsed::Mouse,
                PenTool::Finger(_) => PenUsed::Touch,
                PenTool::Pen | PenTool::Eraser => {
                    PenUsed::Pen(self.pen_device.clone().filter(|name| !name.is_empty()))
                }
            };
            self.part_menu = None;
        }
        if !self.hold_reference(&event) {
            self.on_canvas(|canvas, drawing, out| canvas.pen(&event, drawing, out));
        }
    }

    /// Sees how a pen is held, wherever it is in the window.
    pub fn note_pen(&mut self, event: &PenEvent) {
        if matches!(event.sample.tool, PenTool::Pen | PenTool::Eraser) {
            let sample = &event.sample;
            self.pen_live = PenLive { pressure: sample.pressure, tilt_deg: sample.tilt_deg.to_array() };
        }
    }

    /// A pen came into use: what the artist chose for it holds from now on.
    pub fn take_up_pen(&mut self, name: &str, is_raw: bool, battery: Option<u8>) {
        self.pen_battery = battery;
        if self.pen_device.as_deref() != Some(name) || self.pen_is_raw != is_raw {
            self.pen_device = Some(name.to_owned());
            self.pen_is_raw = is_raw;
            self.apply_settings();
        }
    }

    /// Where tablets may reach: how many monitors there are, and what the pen's own tablet covers.
    pub(in crate::app) fn note_reach(&mut self, reach: &Reach) {
        let pen = self.settings.pen(self.pen_device.as_deref().unwrap_or_default());
        self.tablets.monitors = reach.monitors.len();
        let target = reach.target(&pen);
        let is_seen = target.min.cmpge(reach.window.min).all() && target.max.cmple(reach.window.max).all();
        self.tablets.target = is_seen.then_some(target);
    }

    /// Whether the tablet of the pen last used is read directly.
    pub fn pen_is_raw(&self) -> bool {
        self.pen_is_raw
    }

    /// Why a tablet cannot be read, or that all can, and of which tablets the model is not sure. What is wrong is reported
    /// once beside the dialog, too: a tablet that does nothing is not looked for there. Whether anything is new.
    pub fn note_tablets(&mut self, trouble: Option<&dyn Localize>, doubts: &[TabletDoubt]) -> bool {
        let trouble = trouble.map(|trouble| trouble.localize(&self.messages));
        let is_new = self.tablets.trouble != trouble || self.tablets.doubts != doubts;
        if self.tablets.trouble != trouble {
            if let Some(what) = &trouble {
                self.tell(Notice::warning(what.clone(), ""));
            }
            self.tablets.trouble = trouble;
        }
        if is_new {
            self.tablets.doubts = doubts.to_vec();
        }
        is_new
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
        let mut last = self.document.next_id();
        let mut new_id = || {
            last += 1;
            last - 1
        };
        let mut drawing = Drawing { strokes: &self.document.sketch().strokes, new_id: &mut new_id };
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
            CanvasOutcome::StrokeBegan(_) | CanvasOutcome::StrokeGrew { .. } => self.building.is_stale = true,
            CanvasOutcome::StrokeCancelled(_) => {
                self.building.is_stale = true;
                self.versions.drawing += 1;
            }
            CanvasOutcome::StrokeFinished(stroke) => {
                self.change(Change::put(stroke));
                tracing::debug!("lifted strokes={}", self.document.sketch().strokes.len());
            }
            CanvasOutcome::Changed(changes) => self.change(Change::strokes(changes)),
            CanvasOutcome::Nudged(changes) => self.nudged(changes),
            CanvasOutcome::PreviewChanged => {
                self.building.is_stale = true;
                self.versions.drawing += 1;
            }
            CanvasOutcome::SelectionChanged => {
                self.nudged_at = None;
                self.versions.drawing += 1;
                self.part_menu = None;
            }
            CanvasOutcome::ViewChanged => {
                self.part_menu = None;
                self.layout.shows_all = false;
            }
            CanvasOutcome::OverlayChanged => {}
            CanvasOutcome::Action(action) => self.perform(action),
            CanvasOutcome::TapOnStroke { id, at } => {
                let strokes = &self.document.sketch().strokes;
                let Some(stroke) = strokes.iter().find(|s| s.id == id) else { return };
                let at = at / self.layout.pixels_per_point();
                let (of, tool) = (MenuOf::Stroke(id), stroke.tool);
                self.part_menu = Some(PartMenu { of, tool, at: [at.x as f32, at.y as f32] });
            }
            CanvasOutcome::AskWhatToDraw { at } => {
                let at = at / self.layout.pixels_per_point();
                let tool = match self.canvas.tool() {
                    CanvasTool::Draw(tool) => tool,
                    _ => Tool::Auto,
                };
                self.part_menu = Some(PartMenu { of: MenuOf::Pen, tool, at: [at.x as f32, at.y as f32] });
            }
            CanvasOutcome::Orbit(by) => {
                let by = by / self.layout.pixels_per_point();
                self.plant.orbit(egui::vec2(by.x as f32, by.y as f32));
            }
        }
    }
}

#[cfg(test)]
#[path = "outcomes_tests.rs"]
mod tests;
