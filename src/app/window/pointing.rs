//! Pointers in the window: each event goes to the side that it belongs to, or to egui.

use super::Running;
use crate::app::canvas::Scroll;
use crate::app::pointers::{Place, PointerEvent};
use crate::app::sides::{Side, is_pen};
use crate::pen::mapping::Rect;
use crate::pen::{PenEvent, PenPhase};
use glam::DVec2;
use winit::event::{MouseScrollDelta, WindowEvent};

impl Running {
    /// The side that a place belongs to: inside it, and nothing of egui's floats above.
    fn side_at(&self, at: egui::Pos2) -> Option<Side> {
        let layout = self.editor.layout();
        let side = match (layout.is_canvas(at), layout.is_plant(at)) {
            (true, _) => Side::Canvas,
            (false, true) => Side::Plant,
            (false, false) => return None,
        };
        let layer = self.egui.layer_id_at(at);
        layer.is_none_or(|layer| layer.order == egui::Order::Background).then_some(side)
    }

    /// Hands an event of a pointer to its side, sample by sample; whether it was a side's, or nobody's.
    pub(super) fn on_pointer(&mut self, event: &WindowEvent) -> bool {
        let mut received = std::mem::take(&mut self.received);
        let is_shadow = self.pointers.window_event(event, &mut received);
        self.dispatch(received) || is_shadow
    }

    /// Takes events of pens that do not come through winit.
    pub(super) fn take_pens(&mut self) {
        let mut received = std::mem::take(&mut self.received);
        let scale = f64::from(self.input.pixels_per_point());
        let pixels = |at: egui::Pos2| DVec2::new(f64::from(at.x), f64::from(at.y)) * scale;
        let canvas = self.editor.layout().canvas;
        let canvas = Rect { min: pixels(canvas.min), max: pixels(canvas.max) };
        let place = Place { window: &*self.window, size: self.size, canvas };
        self.pointers.take(&place, self.editor.settings(), &mut received);
        self.pointers.idle(&mut received);
        let is_new = self.editor.note_tablets(self.pointers.trouble(), self.pointers.doubts());
        if let Some(reach) = self.pointers.reach() {
            self.editor.note_reach(reach);
        }
        let actions = self.pointers.actions();
        if is_new || !received.is_empty() || !actions.is_empty() {
            self.want_frame();
        }
        actions.into_iter().for_each(|action| self.editor.tablet_action(action));
        self.dispatch(received);
    }

    /// Hands events to their sides, or to egui those that it does not get from winit; whether one was a side's.
    fn dispatch(&mut self, mut received: Vec<PointerEvent>) -> bool {
        let mut ours = false;
        for PointerEvent { event, is_beside, origin } in received.drain(..) {
            // With every event: one pen may leave and another draw while the window is busy.
            if let Some(pen) = self.pointers.pen(origin) {
                self.editor.take_up_pen(pen.name, pen.is_raw, pen.battery);
            }
            self.editor.note_pen(&event);
            if self.on_pen(event) {
                ours = true;
            } else if is_beside {
                self.input.on_pen(&event);
            }
        }
        self.received = received;
        ours
    }

    /// Hands a sample to the canvas or to the plant if it is theirs; whether it was.
    fn on_pen(&mut self, event: PenEvent) -> bool {
        let scale = f64::from(self.input.pixels_per_point());
        let at = event.sample.position / scale;
        self.pointer = egui::pos2(at.x as f32, at.y as f32);
        let over = self.side_at(self.pointer);
        let side = self.sides.owner(&event, over);
        if side.is_some() && event.phase == PenPhase::Down {
            // egui does not see this press: keys are the canvas's again, and menus close.
            self.egui.memory_mut(|memory| memory.stop_text_input());
            egui::Popup::close_all(&self.egui);
        }
        let is_near = is_pen(event.sample.tool) && !is_contact(event.phase);
        match side {
            Some(Side::Canvas) => {
                if !self.sides.enter_canvas() {
                    self.input.pointer_gone();
                }
                self.editor.pen(event);
                if let Some(graphics) = self.graphics.get() {
                    graphics.grow_stroke(&self.editor);
                }
                return true;
            }
            Some(Side::Plant) => self.editor.plant_pen(&event),
            None => {}
        }
        if is_near {
            // A pen near a panel or the plant still keeps the palm from drawing.
            self.editor.pen(event);
            self.sides.leave_canvas();
        } else if self.sides.leave_canvas() {
            self.editor.pen(PenEvent { phase: PenPhase::Leave, ..event });
        }
        side.is_some()
    }

    /// Wheel and pinch over the canvas.
    pub(super) fn on_canvas_event(&mut self, event: &WindowEvent) -> bool {
        if self.side_at(self.pointer) != Some(Side::Canvas) {
            return false;
        }
        let scale = f64::from(self.input.pixels_per_point());
        let at = DVec2::new(f64::from(self.pointer.x), f64::from(self.pointer.y)) * scale;
        match event {
            WindowEvent::MouseWheel { delta: MouseScrollDelta::LineDelta(x, y), .. } => {
                self.editor.wheel(Scroll::Lines(DVec2::new(f64::from(*x), f64::from(*y))), at);
            }
            WindowEvent::MouseWheel { delta: MouseScrollDelta::PixelDelta(by), .. } => {
                self.editor.wheel(Scroll::Pixels(DVec2::new(by.x, by.y)), at);
            }
            WindowEvent::PinchGesture { delta, .. } => self.editor.pinch(*delta, 0.0, at),
            WindowEvent::RotationGesture { delta, .. } => self.editor.pinch(0.0, f64::from(*delta), at),
            _ => return false,
        }
        true
    }
}

/// Whether the tool touches or just did.
fn is_contact(phase: PenPhase) -> bool {
    matches!(phase, PenPhase::Down | PenPhase::Move | PenPhase::Up)
}
