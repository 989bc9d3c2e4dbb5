//! Which tool goes to work when a pointer touches, and what it is given until it is lifted.

use super::controller::Canvas;
use super::doing::{Activity, Doing, Trigger};
use super::erase::Eraser;
use super::outcome::{CanvasOutcome, Drawing};
use super::stroke_builder::StrokeBuilder;
use super::tool_context::{ToolContext, Touch};
use super::tools::{DragHandle, Erase, Lasso, MoveView, Pen, ViewDrag};
use super::transform::{Drag, FINGER_HANDLE_REACH, HANDLE_REACH, Handle};
use crate::app::action::Action;
use crate::app::canvas_tool::CanvasTool;
use crate::app::pen_uses::ButtonUse;
use crate::pen::{PenSample, PenTool};
use crate::sketch::StrokeId;

impl Canvas {
    /// The stroke under the pen.
    pub fn growing(&self) -> Option<&StrokeBuilder> {
        self.activity.as_ref()?.stroke()
    }

    /// Whether something is being done.
    pub fn is_busy(&self) -> bool {
        self.activity.is_some()
    }

    /// What a tool works on during a touch.
    pub(super) fn context<'a>(
        &'a mut self,
        touch: Touch,
        drawing: &'a mut Drawing<'_>,
        out: &'a mut Vec<CanvasOutcome>,
    ) -> ToolContext<'a> {
        ToolContext {
            viewport: self.viewport(),
            view: &mut self.view,
            index: &mut self.index,
            selection: &mut self.selection,
            bounds: &mut self.bounds,
            settings: &self.settings,
            scale_factor: self.scale_factor,
            keys: self.keys,
            strokes: drawing.strokes,
            new_id: &mut *drawing.new_id,
            out,
            touch,
        }
    }

    pub(super) fn begin(&mut self, sample: &PenSample, drawing: &mut Drawing, out: &mut Vec<CanvasOutcome>) {
        if sample.tool == PenTool::Eraser && self.eraser_end().is_none() && !self.keys.space {
            let usage = self.settings.pen.eraser;
            return self.use_button(usage, Trigger::Tip, sample, drawing, out);
        }
        let doing = match self.tool_for(sample.tool) {
            _ if self.keys.space => Doing::View(MoveView { by: self.view_drag() }),
            CanvasTool::Pan => Doing::View(MoveView { by: ViewDrag::Pan }),
            CanvasTool::Draw(kind) => Doing::Draw(Pen::new(kind)),
            CanvasTool::Erase { partial } => {
                let place = self.view.to_canvas(sample.position);
                Doing::Erase(Erase::new(Eraser::begin(partial, place, self.eraser_radius())))
            }
            CanvasTool::Select => {
                self.sync(drawing.strokes, out);
                self.refresh_bounds();
                self.begin_select(sample)
            }
        };
        let mut activity = Activity::new(sample, Trigger::Tip, doing);
        activity.doing.tool().begin(sample, &mut self.context(activity.touch, drawing, out));
        // A stroke that would begin off the largest canvas is none.
        let is_void = matches!(activity.doing, Doing::Draw(_)) && activity.stroke().is_none();
        self.activity = (!is_void).then_some(activity);
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
        let drag = |by| Some(Activity::new(sample, trigger, Doing::View(MoveView { by })));
        match usage {
            ButtonUse::Pan => self.activity = drag(ViewDrag::Pan),
            ButtonUse::Orbit => self.activity = drag(ViewDrag::Orbit),
            ButtonUse::Pick => {
                let touch = Touch { start: *sample, last: sample.position, is_still: true };
                self.context(touch, drawing, out).pick(sample);
            }
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

    fn begin_select(&self, sample: &PenSample) -> Doing {
        let is_finger = matches!(sample.tool, PenTool::Finger(_));
        let reach = if is_finger { FINGER_HANDLE_REACH } else { HANDLE_REACH };
        let held = self.bounds.and_then(|bounds| {
            let handle = Handle::at(sample.position, bounds, &self.view, (self.scale_factor, reach))?;
            // With Shift the inside of the box is a place like any other, to add strokes from.
            let is_held = handle != Handle::Inside || !self.keys.shift;
            is_held.then(|| Drag::begin(handle, bounds, self.view.to_canvas(sample.position)))
        });
        held.map_or_else(|| Doing::Lasso(Lasso::default()), |drag| Doing::Drag(DragHandle::new(drag)))
    }

    pub(super) fn moved(&mut self, sample: &PenSample, drawing: &mut Drawing, out: &mut Vec<CanvasOutcome>) {
        let Some(mut activity) = self.activity.take() else { return };
        activity.note(sample, self.scale_factor);
        activity.doing.tool().sample(sample, &mut self.context(activity.touch, drawing, out));
        activity.touch.last = sample.position;
        self.activity = Some(activity);
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
        let Some(mut activity) = self.activity.take() else { return };
        // Where a pen is lifted makes no stroke of a tap.
        if activity.stroke().is_none() {
            activity.note(sample, self.scale_factor);
        }
        activity.doing.tool().end(sample, &mut self.context(activity.touch, drawing, out));
        out.push(CanvasOutcome::OverlayChanged);
    }

    /// Gives up what is being done, as if it had not begun.
    pub(super) fn abort(&mut self, out: &mut Vec<CanvasOutcome>) {
        let Some(mut activity) = self.activity.take() else { return };
        // What is given up asks nothing of the drawing.
        let mut drawing = Drawing { strokes: &[], new_id: &mut || StrokeId::MAX };
        activity.doing.tool().cancel(&mut self.context(activity.touch, &mut drawing, out));
        out.push(CanvasOutcome::OverlayChanged);
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
