//! The canvas as a whole: events of pens, fingers, wheel and keys in, outcomes for the window out.
//!
//! One thing happens at a time and belongs to the tool that began it; what other tools do meanwhile is ignored. Fingers
//! pass the palm gate, then the gestures, and draw like any other tool. What a tool does on the drawing is in
//! `activity.rs`, what actions do in `commands.rs`, what is shown of it in [`super::overlay`].
//!
//! Changes reach the drawing only through outcomes. Where a change is still being made (an eraser or a handle on its way)
//! [`Canvas::preview`] says what the drawing will look like.

use super::doing::{Activity, Trigger};
use super::gesture::{Touch, TouchGestures};
use super::outcome::{CanvasKey, CanvasOutcome, Drawing, Scroll};
use super::select::Selection;
use super::settings::CanvasSettings;
use super::stroke_index::StrokeIndex;
use super::tool_context::Keys;
use super::view::{CanvasView, Rect};
use crate::app::action::Action;
use crate::app::canvas_tool::CanvasTool;
use crate::app::pen_uses::ButtonUse;
use crate::pen::{MAX_POSITION_PX, PalmGate, PenButtons, PenEvent, PenPhase, PenSample, PenTool, palm_gate};
use crate::sketch::{Stroke, Tool};
use glam::DVec2;
use std::sync::Arc;

/// Zoom of one notch of a wheel.
const ZOOM_PER_LINE: f64 = 1.15;

/// Scrolled pixels of a touchpad that count as a notch, in logical pixels.
const PIXELS_PER_LINE: f64 = 40.0;

/// Logical pixels that one notch moves the canvas where a wheel moves it.
const PAN_PER_LINE: f64 = 60.0;

/// Most that one event may scroll, in notches.
const MOST_LINES: f64 = 50.0;

/// The canvas.
#[derive(Debug)]
pub struct Canvas {
    /// What the artist chose.
    pub settings: CanvasSettings,
    pub(super) tool: CanvasTool,
    pub(super) view: CanvasView,
    /// Part of the window that shows the canvas; `None` until it is laid out.
    viewport: Option<Rect>,
    pub(super) scale_factor: f64,
    pub(super) keys: Keys,
    pub(super) index: StrokeIndex,
    pub(super) selection: Selection,
    /// Box around the selection on the canvas.
    pub(super) bounds: Option<Rect>,
    pub(super) activity: Option<Activity>,
    /// Where pen or mouse is, while in range.
    pub(super) hover: Option<PenSample>,
    gate: PalmGate,
    touch: TouchGestures,
    /// Buttons of mouse and pen as last seen.
    held: [PenButtons; 2],
    last: (DVec2, f64),
    /// Room for what gate and gestures say, kept so that no event allocates.
    passed: Vec<PenEvent>,
    touches: Vec<Touch>,
}

impl Default for Canvas {
    fn default() -> Self {
        Self::new(CanvasSettings::default())
    }
}

impl Canvas {
    /// A canvas at rest.
    pub fn new(settings: CanvasSettings) -> Self {
        Self {
            settings,
            tool: CanvasTool::Draw(Tool::Auto),
            view: CanvasView::default(),
            viewport: None,
            scale_factor: 1.0,
            keys: Keys::default(),
            index: StrokeIndex::default(),
            selection: Selection::default(),
            bounds: None,
            activity: None,
            hover: None,
            gate: PalmGate::new(palm_gate::AFTER_PEN_MS),
            touch: TouchGestures::default(),
            held: [PenButtons::default(); 2],
            last: (DVec2::ZERO, 0.0),
            passed: Vec::new(),
            touches: Vec::new(),
        }
    }

    /// The tool in hand.
    pub fn tool(&self) -> CanvasTool {
        self.tool
    }

    /// Where the canvas lies.
    pub fn view(&self) -> &CanvasView {
        &self.view
    }

    /// Puts the canvas elsewhere, as when a document's own place is restored.
    pub fn set_view(&mut self, view: CanvasView) {
        self.view = view;
    }

    /// Sets which part of the window shows the canvas (physical pixels), and the physical pixels per logical pixel. Where
    /// that part moves or changes its size, the place of the canvas in its middle stays there.
    pub fn set_viewport(&mut self, rect: Rect, scale_factor: f64) {
        if let Some(before) = self.viewport.replace(rect) {
            self.view.pan(rect.center() - before.center());
        }
        let is_sound = scale_factor.is_finite() && scale_factor > 0.0;
        self.scale_factor = if is_sound { scale_factor } else { 1.0 };
        self.touch.scale_factor = self.scale_factor;
    }

    /// Part of the window that shows the canvas, physical pixels.
    pub(super) fn viewport(&self) -> Rect {
        self.viewport.unwrap_or(Rect::new(DVec2::ZERO, DVec2::ONE))
    }

    /// Shows all of a rectangle of the canvas.
    pub fn fit(&mut self, bounds: Rect, out: &mut Vec<CanvasOutcome>) {
        self.view.fit(bounds, self.viewport());
        out.push(CanvasOutcome::ViewChanged);
    }

    /// The selected strokes.
    pub fn selection(&self) -> &Selection {
        &self.selection
    }

    /// The drawing has changed, by this canvas or by anybody: opened, taken back, edited. An eraser or handle
    /// on its way lets go, since what it held is no more; a growing stroke goes on.
    pub fn drawing_changed(&mut self, strokes: &[Arc<Stroke>], out: &mut Vec<CanvasOutcome>) {
        if self.activity.as_ref().is_some_and(Activity::holds_strokes) {
            self.abort(out);
        }
        self.sync(strokes, out);
        self.refresh_bounds();
    }

    /// Takes an event of a pointer over the canvas, or of one that went down over it.
    pub fn pen(&mut self, event: &PenEvent, drawing: &mut Drawing, out: &mut Vec<CanvasOutcome>) {
        let Some(event) = self.sound(event) else { return };
        self.touch.one_finger_draws = self.settings.fingers_draw;
        let mut passed = std::mem::take(&mut self.passed);
        self.gate.pass(event, &mut passed);
        for event in passed.drain(..) {
            if matches!(event.sample.tool, PenTool::Finger(_)) {
                let mut touches = std::mem::take(&mut self.touches);
                self.touch.event(&event, &mut touches);
                touches.drain(..).for_each(|touch| self.touched(touch, drawing, out));
                self.touches = touches;
            } else {
                let is_gone = matches!(event.phase, PenPhase::Leave | PenPhase::Cancel);
                self.hover = (!is_gone).then_some(event.sample);
                self.pointer(&event, drawing, out);
            }
        }
        self.passed = passed;
    }

    /// Sources reject what is no number; so does the canvas, without losing the end of a stroke to it.
    fn sound(&mut self, event: &PenEvent) -> Option<PenEvent> {
        let mut event = *event;
        let sample = &mut event.sample;
        let is_place = sample.position.is_finite() && sample.position.abs().max_element() <= MAX_POSITION_PX;
        let is_end = matches!(event.phase, PenPhase::Up | PenPhase::Leave | PenPhase::Cancel);
        if !is_place && !is_end {
            return None;
        }
        let (place, time_ms) = self.last;
        sample.position = if is_place { sample.position } else { place };
        sample.time_ms = if sample.time_ms.is_finite() { sample.time_ms.max(time_ms) } else { time_ms };
        self.last = (sample.position, sample.time_ms);
        Some(event)
    }

    fn touched(&mut self, touch: Touch, drawing: &mut Drawing, out: &mut Vec<CanvasOutcome>) {
        match touch {
            Touch::Draw(event) => self.pointer(&event, drawing, out),
            Touch::Tap(2) => out.push(CanvasOutcome::Action(Action::Undo)),
            Touch::Tap(3) => out.push(CanvasOutcome::Action(Action::Redo)),
            Touch::Tap(_) => {}
            // Another tool is at work on the canvas: it stays where it is.
            _ if self.activity.is_some() => {}
            Touch::Pan(delta) => {
                self.view.pan(delta);
                out.push(CanvasOutcome::ViewChanged);
            }
            Touch::Pair { from, to } => {
                self.view.follow_pair(from, to);
                out.push(CanvasOutcome::ViewChanged);
            }
            Touch::Settled => self.view.settle(),
        }
    }

    fn pointer(&mut self, event: &PenEvent, drawing: &mut Drawing, out: &mut Vec<CanvasOutcome>) {
        let tool = event.sample.tool;
        let is_owner = self.activity.as_ref().is_some_and(|a| a.owner == tool);
        self.buttons(event, drawing, out);
        match event.phase {
            PenPhase::Down if self.activity.is_none() => self.begin(&event.sample, drawing, out),
            PenPhase::Up if is_owner => self.lifted(&event.sample, drawing, out),
            PenPhase::Leave if is_owner => self.finish(&event.sample, drawing, out),
            PenPhase::Cancel if is_owner => self.abort(out),
            PenPhase::Move | PenPhase::Hover if is_owner => self.moved(&event.sample, drawing, out),
            // The circle of the eraser and the hints of handles follow the pointer.
            PenPhase::Enter | PenPhase::Hover | PenPhase::Leave if self.follows_hover() => {
                out.push(CanvasOutcome::OverlayChanged);
            }
            _ => {}
        }
    }

    /// Where a pen is that does not touch.
    pub fn hovering_pen(&self) -> Option<DVec2> {
        let pen = self.hover.filter(|s| matches!(s.tool, PenTool::Pen | PenTool::Eraser))?;
        (!pen.buttons.primary).then_some(pen.position)
    }

    /// Buttons of the pen as last seen.
    pub(super) fn held_by_pen(&self) -> PenButtons {
        self.held[1]
    }

    /// Begins and ends what buttons besides the tip do.
    fn buttons(&mut self, event: &PenEvent, drawing: &mut Drawing, out: &mut Vec<CanvasOutcome>) {
        let tool = event.sample.tool;
        let slot = match tool {
            PenTool::Finger(_) => return,
            PenTool::Mouse => 0,
            PenTool::Pen | PenTool::Eraser => 1,
        };
        let before = std::mem::replace(&mut self.held[slot], event.sample.buttons);
        let now = event.sample.buttons;
        if self.activity.as_ref().is_some_and(|a| a.owner == tool && a.is_let_go(now)) {
            return self.finish(&event.sample, drawing, out);
        }
        if self.activity.is_some() {
            return;
        }
        let is_mouse = tool == PenTool::Mouse;
        if now.middle && !before.middle {
            let usage = if is_mouse { ButtonUse::Pan } else { self.settings.pen.upper };
            self.use_button(usage, Trigger::Middle, &event.sample, drawing, out);
        } else if now.secondary && !before.secondary {
            let usage = if is_mouse { ButtonUse::Pick } else { self.settings.pen.lower };
            self.use_button(usage, Trigger::Secondary, &event.sample, drawing, out);
        } else if now.third && !before.third && !is_mouse {
            self.use_button(self.settings.pen.third, Trigger::Third, &event.sample, drawing, out);
        }
    }

    /// Scrolls at a window position: a wheel zooms about it, sideways or with Shift it moves the canvas; a touchpad moves
    /// the canvas, with Ctrl it zooms.
    pub fn wheel(&mut self, scroll: Scroll, at: DVec2, out: &mut Vec<CanvasOutcome>) {
        let (lines, pans) = match scroll {
            Scroll::Lines(lines) => (lines, false),
            Scroll::Pixels(px) => (px / (PIXELS_PER_LINE * self.scale_factor), self.settings.touchpad_pans),
        };
        if !lines.is_finite() || !at.is_finite() {
            return;
        }
        let most = DVec2::splat(MOST_LINES);
        let lines = lines.clamp(-most, most);
        let before = self.view;
        if pans && !self.keys.ctrl {
            self.view.pan(lines * PIXELS_PER_LINE * self.scale_factor);
        } else if self.keys.shift && !self.keys.ctrl {
            let along = if lines.x == 0.0 { lines.y } else { lines.x };
            self.view.pan(DVec2::new(along * PAN_PER_LINE * self.scale_factor, 0.0));
        } else {
            self.view.zoom_about(at, ZOOM_PER_LINE.powf(lines.y));
            self.view.pan(DVec2::new(lines.x * PAN_PER_LINE * self.scale_factor, 0.0));
        }
        if self.view != before {
            out.push(CanvasOutcome::ViewChanged);
        }
    }

    /// Zooms by so many lines of a wheel about the middle of the paper.
    pub(super) fn zoom_steps(&mut self, steps: i32, out: &mut Vec<CanvasOutcome>) {
        let lines = f64::from(steps).clamp(-MOST_LINES, MOST_LINES);
        let before = self.view;
        self.view.zoom_about(self.viewport().center(), ZOOM_PER_LINE.powf(lines));
        if self.view != before {
            out.push(CanvasOutcome::ViewChanged);
        }
    }

    /// Pinches on a touchpad at a window position: `delta` is the growth as a share, `turn_deg` counter-clockwise, as winit
    /// has them; 0 for what the gesture does not say.
    pub fn pinch(&mut self, delta: f64, turn_deg: f64, at: DVec2, out: &mut Vec<CanvasOutcome>) {
        let before = self.view;
        self.view.zoom_about(at, 1.0 + delta.clamp(-0.9, 9.0));
        if turn_deg != 0.0 {
            self.view.rotate_about(at, -turn_deg.to_radians());
        }
        if self.view != before {
            out.push(CanvasOutcome::ViewChanged);
        }
    }

    /// Takes a key.
    pub fn key(&mut self, key: CanvasKey, pressed: bool, out: &mut Vec<CanvasOutcome>) {
        match key {
            CanvasKey::Space => self.keys.space = pressed,
            CanvasKey::Shift => {
                self.keys.shift = pressed;
                if self.activity.as_ref().is_some_and(Activity::is_drag) {
                    out.push(CanvasOutcome::PreviewChanged);
                }
            }
            CanvasKey::Ctrl => self.keys.ctrl = pressed,
            CanvasKey::Escape if pressed => self.escape(out),
            CanvasKey::Escape => {}
        }
        out.push(CanvasOutcome::OverlayChanged);
    }

    /// What a pen's pressure becomes by the artist's curve.
    pub fn pressure(&self, raw: f32) -> f32 {
        self.settings.pressure.apply(raw)
    }

    /// Whether Shift is held.
    pub fn is_shift_held(&self) -> bool {
        self.keys.shift
    }

    /// Forgets the keys held, as when the window loses the keyboard: their release may never come.
    pub fn release_keys(&mut self) {
        self.keys = Keys::default();
    }

    /// Gives up what is being done, whatever it is.
    pub fn cancel(&mut self, out: &mut Vec<CanvasOutcome>) {
        self.abort(out);
        self.touch.forget();
    }

    fn escape(&mut self, out: &mut Vec<CanvasOutcome>) {
        if self.activity.is_some() {
            self.cancel(out);
        } else if self.selection.take([], false) {
            self.selection_changed(out);
        }
    }

    pub(super) fn sync(&mut self, strokes: &[Arc<Stroke>], out: &mut Vec<CanvasOutcome>) {
        self.index.sync(strokes);
        if self.selection.keep_known(&self.index) {
            self.selection_changed(out);
        }
    }

    pub(super) fn selection_changed(&mut self, out: &mut Vec<CanvasOutcome>) {
        self.refresh_bounds();
        out.push(CanvasOutcome::SelectionChanged);
    }

    pub(super) fn refresh_bounds(&mut self) {
        self.bounds = self.selection.bounds(&self.index);
    }
}

#[cfg(test)]
#[path = "controller_tests/mod.rs"]
mod tests;
