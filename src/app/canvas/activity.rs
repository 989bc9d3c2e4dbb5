//! What one tool does from the moment it touches until it is lifted: draw, erase, select, drag a handle, move the view.

use super::controller::{Canvas, FINGER_PICK_REACH, PICK_REACH};
use super::erase::Eraser;
use super::outcome::{CanvasOutcome, Drawing};
use super::select::lassoed;
use super::settings::ButtonUse;
use super::stroke_builder::StrokeBuilder;
use super::transform::{Drag, FINGER_HANDLE_REACH, HANDLE_REACH, Handle};
use crate::app::action::{Action, CanvasTool};
use crate::pen::{PenButtons, PenSample, PenTool};
use crate::sketch::change::StrokeChange;
use crate::sketch::{StrokeId, Tool};
use glam::DVec2;

/// Farthest that a pen or mouse moves in a tap, in logical pixels.
const TAP_SLOP: f64 = 4.0;

/// Farthest that a finger moves in a tap, in logical pixels.
const FINGER_TAP_SLOP: f64 = 10.0;

/// Shortest step of a lasso, in logical pixels.
const LASSO_STEP: f64 = 1.5;

/// Logical pixels of a drag with Ctrl+Space that zoom by Euler's number.
const ZOOM_DRAG: f64 = 200.0;

/// What keeps an activity going.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Trigger {
    Tip,
    /// The middle button of a mouse or the upper one of a pen.
    Middle,
    /// The right button of a mouse or the lower one of a pen.
    Secondary,
    /// The third button of a pen.
    Third,
}

/// How a drag changes the view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ViewDrag {
    Pan,
    Turn,
    Zoom,
    /// Turns the plant, not the canvas.
    Orbit,
}

/// What is being done.
#[derive(Debug)]
pub(super) enum Doing {
    Draw(StrokeBuilder),
    Erase(Eraser),
    /// Canvas places of the lasso.
    Lasso(Vec<DVec2>),
    Drag(Drag),
    View(ViewDrag),
}

/// One tool at work.
#[derive(Debug)]
pub(super) struct Activity {
    pub(super) owner: PenTool,
    pub(super) doing: Doing,
    trigger: Trigger,
    start: PenSample,
    pub(super) last: DVec2,
    /// Whether it has not moved further than a tap does. Time does not count: on a busy machine the release arrives late.
    is_still: bool,
}

impl Activity {
    fn new(sample: &PenSample, trigger: Trigger, doing: Doing) -> Self {
        Self { owner: sample.tool, doing, trigger, start: *sample, last: sample.position, is_still: true }
    }

    /// Whether it works on strokes of the drawing, which must not change under it.
    pub(super) fn holds_strokes(&self) -> bool {
        matches!(self.doing, Doing::Erase(_) | Doing::Drag(_))
    }

    pub(super) fn is_drag(&self) -> bool {
        matches!(self.doing, Doing::Drag(_))
    }

    /// Whether the button that keeps it going is released.
    pub(super) fn is_let_go(&self, now: PenButtons) -> bool {
        match self.trigger {
            Trigger::Tip => false,
            Trigger::Middle => !now.middle,
            Trigger::Secondary => !now.secondary,
            Trigger::Third => !now.third,
        }
    }

    /// The drag of a handle, once it moved further than a tap.
    pub(super) fn drag(&self) -> Option<&Drag> {
        match &self.doing {
            Doing::Drag(drag) if !self.is_still => Some(drag),
            _ => None,
        }
    }
}

impl Canvas {
    /// The stroke under the pen.
    pub fn growing(&self) -> Option<&StrokeBuilder> {
        match &self.activity.as_ref()?.doing {
            Doing::Draw(stroke) => Some(stroke),
            _ => None,
        }
    }

    /// Whether something is being done.
    pub fn is_busy(&self) -> bool {
        self.activity.is_some()
    }

    pub(super) fn begin(&mut self, sample: &PenSample, drawing: &mut Drawing, out: &mut Vec<CanvasOutcome>) {
        if sample.tool == PenTool::Eraser && self.eraser_end().is_none() && !self.keys.space {
            let usage = self.settings.pen.eraser;
            return self.use_button(usage, Trigger::Tip, sample, drawing, out);
        }
        let place = self.view.to_canvas(sample.position);
        let doing = match self.tool_for(sample.tool) {
            _ if self.keys.space => Some(Doing::View(self.view_drag())),
            CanvasTool::Pan => Some(Doing::View(ViewDrag::Pan)),
            CanvasTool::Draw(tool) => self.begin_stroke(tool, sample, drawing, out),
            CanvasTool::Erase { partial } => {
                self.sync(drawing.strokes, out);
                let mut eraser = Eraser::begin(partial, place, self.eraser_radius());
                if eraser.sweep(place, &mut self.index, drawing.new_id) {
                    out.push(CanvasOutcome::PreviewChanged);
                }
                Some(Doing::Erase(eraser))
            }
            CanvasTool::Select => {
                self.sync(drawing.strokes, out);
                self.refresh_bounds();
                Some(self.begin_select(sample, place))
            }
        };
        self.activity = doing.map(|doing| Activity::new(sample, Trigger::Tip, doing));
        out.push(CanvasOutcome::OverlayChanged);
    }

    /// What a tool does on the canvas: a pen with an erasing button held erases, and so mostly does its eraser end.
    pub(super) fn tool_for(&self, tool: PenTool) -> CanvasTool {
        let erases = match tool {
            PenTool::Eraser => self.eraser_end(),
            PenTool::Pen => self.erasing_button(),
            PenTool::Mouse | PenTool::Finger(_) => None,
        };
        match (erases, self.tool) {
            (Some(_), CanvasTool::Erase { partial }) | (Some(partial), _) => CanvasTool::Erase { partial },
            (None, tool) => tool,
        }
    }

    /// Whether the eraser end erases, and if so, only in part.
    fn eraser_end(&self) -> Option<bool> {
        erases(self.settings.pen.eraser)
    }

    /// The same for a held button of the pen.
    fn erasing_button(&self) -> Option<bool> {
        let (held, uses) = (self.held_by_pen(), &self.settings.pen);
        let buttons = [(uses.lower, held.secondary), (uses.upper, held.middle), (uses.third, held.third)];
        buttons.into_iter().filter(|(_, is_held)| *is_held).find_map(|(usage, _)| erases(usage))
    }

    /// Does what a button of a pen or mouse is for, hovering or touching. Erasing waits for the tip.
    pub(super) fn use_button(
        &mut self,
        usage: ButtonUse,
        trigger: Trigger,
        sample: &PenSample,
        drawing: &mut Drawing,
        out: &mut Vec<CanvasOutcome>,
    ) {
        let drag = |kind| Some(Activity::new(sample, trigger, Doing::View(kind)));
        match usage {
            ButtonUse::Pan => self.activity = drag(ViewDrag::Pan),
            ButtonUse::Orbit => self.activity = drag(ViewDrag::Orbit),
            ButtonUse::Pick => self.pick(sample, drawing, out),
            ButtonUse::Menu => out.push(CanvasOutcome::AskWhatToDraw { at: sample.position }),
            ButtonUse::Undo => out.push(CanvasOutcome::Action(Action::Undo)),
            ButtonUse::Redo => out.push(CanvasOutcome::Action(Action::Redo)),
            ButtonUse::Erase | ButtonUse::ErasePartly => out.push(CanvasOutcome::OverlayChanged),
            ButtonUse::Nothing => {}
        }
    }

    pub(super) fn view_drag(&self) -> ViewDrag {
        match (self.keys.ctrl, self.keys.shift) {
            (true, _) => ViewDrag::Zoom,
            (false, true) => ViewDrag::Turn,
            (false, false) => ViewDrag::Pan,
        }
    }

    /// The eraser's radius in canvas pixels.
    pub(super) fn eraser_radius(&self) -> f64 {
        self.settings.sound_eraser_radius() * self.scale_factor / self.view.zoom()
    }

    fn begin_stroke(
        &mut self,
        tool: Tool,
        sample: &PenSample,
        drawing: &mut Drawing,
        out: &mut Vec<CanvasOutcome>,
    ) -> Option<Doing> {
        let how = (self.settings.stabiliser, self.settings.pressure);
        let stroke = StrokeBuilder::begin((drawing.new_id)(), tool, sample, &self.view, how)?;
        out.push(CanvasOutcome::StrokeBegan(stroke.id()));
        Some(Doing::Draw(stroke))
    }

    fn begin_select(&self, sample: &PenSample, place: DVec2) -> Doing {
        let is_finger = matches!(sample.tool, PenTool::Finger(_));
        let reach = if is_finger { FINGER_HANDLE_REACH } else { HANDLE_REACH };
        let held = self.bounds.and_then(|bounds| {
            let handle = Handle::at(sample.position, bounds, &self.view, (self.scale_factor, reach))?;
            // With Shift the inside of the box is a place like any other, to add strokes from.
            let is_held = handle != Handle::Inside || !self.keys.shift;
            is_held.then(|| Drag::begin(handle, bounds, place))
        });
        held.map_or_else(|| Doing::Lasso(vec![place]), Doing::Drag)
    }

    pub(super) fn moved(&mut self, sample: &PenSample, drawing: &mut Drawing, out: &mut Vec<CanvasOutcome>) {
        let Some(activity) = &mut self.activity else { return };
        let from = std::mem::replace(&mut activity.last, sample.position);
        let slop = if matches!(sample.tool, PenTool::Finger(_)) { FINGER_TAP_SLOP } else { TAP_SLOP };
        if sample.position.distance(activity.start.position) > slop * self.scale_factor {
            activity.is_still = false;
        }
        let place = self.view.to_canvas(sample.position);
        match &mut activity.doing {
            Doing::Draw(stroke) => {
                if let Some(from) = stroke.push(sample, &self.view) {
                    out.push(CanvasOutcome::StrokeGrew { from });
                }
            }
            Doing::Erase(eraser) => {
                if eraser.sweep(place, &mut self.index, drawing.new_id) {
                    out.push(CanvasOutcome::PreviewChanged);
                }
                out.push(CanvasOutcome::OverlayChanged);
            }
            Doing::Lasso(lasso) => {
                let step = LASSO_STEP * self.scale_factor / self.view.zoom();
                if lasso.last().is_none_or(|last| last.distance(place) >= step) {
                    lasso.push(place);
                    out.push(CanvasOutcome::OverlayChanged);
                }
            }
            Doing::Drag(drag) => {
                drag.drag_to(place);
                if !activity.is_still {
                    out.extend([CanvasOutcome::PreviewChanged, CanvasOutcome::OverlayChanged]);
                }
            }
            Doing::View(kind) => {
                let (kind, start) = (*kind, activity.start.position);
                out.push(self.drag_view(kind, (start, from, sample.position)));
            }
        }
    }

    fn drag_view(&mut self, kind: ViewDrag, (start, from, to): (DVec2, DVec2, DVec2)) -> CanvasOutcome {
        match kind {
            ViewDrag::Pan => self.view.pan(to - from),
            ViewDrag::Turn => {
                let middle = self.viewport().center();
                let (a, b) = (from - middle, to - middle);
                if a.length() * b.length() > 0.0 {
                    self.view.rotate_about(middle, a.angle_to(b));
                }
            }
            ViewDrag::Zoom => {
                let along = (to.x - from.x) - (to.y - from.y);
                self.view.zoom_about(start, (along / (ZOOM_DRAG * self.scale_factor)).exp());
            }
            ViewDrag::Orbit => return CanvasOutcome::Orbit(to - from),
        }
        CanvasOutcome::ViewChanged
    }

    /// The tip was lifted: ends what the tip began.
    pub(super) fn lifted(&mut self, sample: &PenSample, drawing: &mut Drawing, out: &mut Vec<CanvasOutcome>) {
        match self.activity.as_ref().map(|a| a.trigger) {
            Some(Trigger::Tip) => self.finish(sample, drawing, out),
            _ => self.moved(sample, drawing, out),
        }
    }

    /// Ends what is being done, where it stands.
    pub(super) fn finish(&mut self, sample: &PenSample, drawing: &mut Drawing, out: &mut Vec<CanvasOutcome>) {
        let is_drawing = self.growing().is_some();
        if !is_drawing && self.activity.as_ref().is_some_and(|a| a.last != sample.position) {
            self.moved(sample, drawing, out);
        }
        let Some(activity) = self.activity.take() else { return };
        match activity.doing {
            // A dot means nothing in a plant, and hardly anybody would see it.
            Doing::Draw(stroke) if activity.is_still => {
                out.push(CanvasOutcome::StrokeCancelled(stroke.id()));
                self.pick(&activity.start, drawing, out);
            }
            Doing::Draw(stroke) => self.finish_stroke(stroke, sample, out),
            Doing::Erase(eraser) => change(eraser.changes(), out),
            Doing::Lasso(_) if activity.is_still => self.tap_select(&activity.start, drawing, out),
            Doing::Lasso(lasso) => {
                if self.selection.take(lassoed(&lasso, &self.index), self.keys.shift) {
                    self.selection_changed(out);
                }
            }
            Doing::Drag(_) if activity.is_still => {
                self.tap_select(&activity.start, drawing, out);
            }
            Doing::Drag(drag) => {
                let transform = drag.transform(self.keys.shift);
                change(self.selection.transform(&self.index, &transform), out);
            }
            Doing::View(_) => self.view.settle(),
        }
        out.push(CanvasOutcome::OverlayChanged);
    }

    fn finish_stroke(&self, mut stroke: StrokeBuilder, sample: &PenSample, out: &mut Vec<CanvasOutcome>) {
        stroke.lift(sample, &self.view);
        out.push(CanvasOutcome::StrokeFinished(stroke.finish()));
    }

    /// Gives up what is being done, as if it had not begun.
    pub(super) fn abort(&mut self, out: &mut Vec<CanvasOutcome>) {
        let Some(activity) = self.activity.take() else { return };
        match activity.doing {
            Doing::Draw(stroke) => out.push(CanvasOutcome::StrokeCancelled(stroke.id())),
            Doing::Erase(_) | Doing::Drag(_) => out.push(CanvasOutcome::PreviewChanged),
            Doing::View(_) => self.view.settle(),
            Doing::Lasso(_) => {}
        }
        out.push(CanvasOutcome::OverlayChanged);
    }

    /// The stroke under a pointer.
    fn stroke_at(
        &mut self,
        sample: &PenSample,
        drawing: &Drawing,
        out: &mut Vec<CanvasOutcome>,
    ) -> Option<StrokeId> {
        self.sync(drawing.strokes, out);
        let is_finger = matches!(sample.tool, PenTool::Finger(_));
        let reach = if is_finger { FINGER_PICK_REACH } else { PICK_REACH };
        let reach = reach * self.scale_factor / self.view.zoom();
        self.index.nearest(self.view.to_canvas(sample.position), reach)
    }

    /// Asks about the stroke under the pointer.
    pub(super) fn pick(&mut self, sample: &PenSample, drawing: &mut Drawing, out: &mut Vec<CanvasOutcome>) {
        let at = sample.position;
        if let Some(id) = self.stroke_at(sample, drawing, out) {
            out.push(CanvasOutcome::TapOnStroke { id, at });
        }
    }

    fn tap_select(&mut self, sample: &PenSample, drawing: &Drawing, out: &mut Vec<CanvasOutcome>) {
        let found = self.stroke_at(sample, drawing, out);
        let changed = match (found, self.keys.shift) {
            (Some(id), true) => {
                self.selection.toggle(id);
                true
            }
            (None, true) => false,
            (found, false) => self.selection.take(found, false),
        };
        if changed {
            self.selection_changed(out);
        }
    }
}

/// Whether a button erases, and if so, only in part.
fn erases(usage: ButtonUse) -> Option<bool> {
    match usage {
        ButtonUse::Erase => Some(false),
        ButtonUse::ErasePartly => Some(true),
        _ => None,
    }
}

fn change(changes: Vec<StrokeChange>, out: &mut Vec<CanvasOutcome>) {
    if !changes.is_empty() {
        out.push(CanvasOutcome::Changed(changes));
    }
}
