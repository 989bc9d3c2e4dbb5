//! One frame of the interface: panels at the edges, the canvas and the plant side by side between them.
//!
//! egui lays out; the canvas itself is not egui's: its rectangle is left open and the drawing is painted below. What
//! belongs to the canvas but not to the drawing (lasso, handles, the eraser's circle) is painted by egui over it.

use super::Editor;
use super::reference_hold::Frame;
use crate::app::action::Action;
use crate::app::canvas::CursorShape;
use crate::app::fonts::missing_notice;
use crate::app::invitation;
use crate::app::layout::GRIP;
use crate::app::panels::frame;
use crate::app::panels::snapshot::Dialog;
use crate::app::settings::Handedness;
use crate::app::theme::{self, Palette};
use crate::sketch::Sketch;
use egui::{Color32, Pos2, Rect, Sense, Shape, Stroke, Ui, UiBuilder, pos2, vec2};
use glam::DVec2;

impl Editor {
    /// Lays out one frame; `plant` is the texture with the plant's picture.
    pub fn ui(&mut self, ui: &mut Ui, plant: egui::TextureId) {
        self.prepare_context(ui.ctx());
        let snapshot = self.panel_snapshot();
        let mut actions = Vec::new();
        let room = frame::show(ui, &snapshot, self.prefs.messages(), &mut actions);
        let before = self.layout;
        let divider = self.divide(ui, room);
        self.layout.plant =
            frame::plant_tools(ui, self.layout.plant, &snapshot, self.prefs.messages(), &mut actions);
        self.layout.pixels_per_point = f64::from(ui.ctx().pixels_per_point());
        if self.layout.canvas != before.canvas || self.layout.plant != before.plant {
            self.log_layout();
        }
        self.canvas.set_viewport(self.layout.canvas_px(), self.layout.pixels_per_point);
        let is_new = std::mem::take(&mut self.layout.is_new);
        if is_new || (self.layout.shows_all && self.layout.canvas != before.canvas) {
            self.perform(Action::FitCanvas);
        }
        let mut side = ui.new_child(UiBuilder::new().max_rect(self.layout.plant));
        self.plant.show(&mut side, plant);
        self.follow_levels(ui.ctx());
        actions.extend(self.picked_in_plant());
        self.hold_divider(ui, divider, room);
        self.paint_overlay(ui);
        let painter = ui.painter().with_clip_rect(self.layout.plant);
        let palette = Palette::in_use(ui.visuals());
        self.paint_control_points(&painter, palette);
        let over_plant = ui.ctx().pointer_hover_pos().filter(|at| self.layout.plant.contains(*at));
        self.hover_in_space(over_plant);
        self.paint_in_space(&painter, palette);
        frame::overlays(ui, self.layout.canvas, &snapshot, self.prefs.messages(), &mut actions);
        self.paint_pointed_reading(ui);
        for action in actions {
            self.perform(action);
        }
        self.end_of_frame(ui);
    }

    /// Gives egui theme and fonts where they changed.
    fn prepare_context(&mut self, ctx: &egui::Context) {
        let theme = self.theme();
        let shown: Option<(egui::Theme, f32)> = ctx.data(|data| data.get_temp(egui::Id::unique("theme")));
        let now = (theme, ctx.pixels_per_point());
        if shown.is_none_or(|shown| shown != now) {
            theme::apply(ctx, theme);
            ctx.data_mut(|data| data.insert_temp(egui::Id::unique("theme"), now));
        }
        if self.disk.lost.draw_pictures(ctx, Palette::of(theme))
            && matches!(self.dialog(), Some(Dialog::Recovery(_)))
        {
            self.show_lost_drawings();
        }
        if self.prefs.take_need_of_fonts() {
            let (fonts, are_missing) = self.prefs.fonts();
            if are_missing {
                self.notify(missing_notice());
            }
            ctx.set_fonts(fonts);
        }
    }

    /// What follows from a frame.
    fn end_of_frame(&mut self, ui: &Ui) {
        // A slider that was let go: its next move is a step of its own.
        if ui.input(|input| input.pointer.any_released()) {
            self.drawing.end_merging();
        }
        // Not with every frame of a drag.
        if !ui.input(|input| input.pointer.any_down()) {
            self.save_settings();
        }
    }

    /// Divides the room between canvas and plant, and says where; the canvas lies at the hand that draws.
    fn divide(&mut self, ui: &mut Ui, room: Rect) -> f32 {
        let canvas_first = self.prefs.settings().handedness == Handedness::Right;
        let share = self.prefs.settings().canvas_share;
        let share = if canvas_first { share } else { 1.0 - share };
        let x = (room.left() + share * room.width()).round();
        let (left, right) = room.split_left_right_at_x(x);
        (self.layout.canvas, self.layout.plant) = if canvas_first { (left, right) } else { (right, left) };
        frame::divider(ui, x, room);
        x
    }

    /// Handles the divider. Called after the plant was shown: of things that overlap egui asks the last.
    fn hold_divider(&mut self, ui: &Ui, x: f32, room: Rect) {
        let canvas_first = self.prefs.settings().handedness == Handedness::Right;
        let grip = Rect::from_x_y_ranges(x - GRIP / 2.0..=x + GRIP / 2.0, room.y_range());
        // Only for pointers: with the keyboard there is nothing to do with it.
        let response = ui.interact(grip, egui::Id::unique("divider"), Sense::DRAG);
        let response = response.on_hover_and_drag_cursor(egui::CursorIcon::ResizeHorizontal);
        if response.dragged()
            && let Some(pointer) = response.interact_pointer_pos()
        {
            let share = (pointer.x - room.left()) / room.width().max(1.0);
            let share = if canvas_first { share } else { 1.0 - share };
            self.prefs.set_canvas_share(share);
        }
    }

    fn log_layout(&self) {
        let scale = self.layout.pixels_per_point as f32;
        let area = |r: Rect| {
            let numbers = [r.left(), r.top(), r.width(), r.height()].map(|x| (x * scale).round());
            format!("{},{},{},{}", numbers[0], numbers[1], numbers[2], numbers[3])
        };
        tracing::debug!("layout canvas={} plant={}", area(self.layout.canvas), area(self.layout.plant));
    }

    /// Lasso, selection box, handles and eraser.
    fn paint_overlay(&self, ui: &Ui) {
        let scale = self.layout.pixels_per_point;
        let point = |p: DVec2| pos2((p.x / scale) as f32, (p.y / scale) as f32);
        let palette = Palette::in_use(ui.visuals());
        let painter = ui.painter().with_clip_rect(self.layout.canvas);
        let line = Stroke::new(1.5, palette.selection);
        let overlay = self.canvas.overlay();
        if overlay.lasso.len() > 1 {
            let lasso: Vec<Pos2> = overlay.lasso.iter().map(|p| point(*p)).collect();
            painter.extend(Shape::dashed_line(&lasso, line, 5.0, 4.0));
        }
        if let Some(frame) = overlay.frame {
            painter.add(Shape::closed_line(frame.map(point).to_vec(), line));
        }
        for (handle, at) in &overlay.handles {
            let at = point(*at);
            if matches!(handle, crate::app::canvas::transform::Handle::Turn) {
                painter.circle(at, 6.0, palette.panel, line);
            } else {
                painter.rect(
                    Rect::from_center_size(at, vec2(10.0, 10.0)),
                    2.0,
                    palette.panel,
                    line,
                    egui::StrokeKind::Middle,
                );
            }
        }
        if let Some(Frame { corners, middle, turn: [edge, turn] }) = self.reference_frame() {
            let line = Stroke::new(1.5, palette.accent);
            painter.add(Shape::closed_line(corners.map(point).to_vec(), line));
            painter.line_segment([point(edge), point(turn)], line);
            painter.circle(point(turn), 7.0, palette.panel, line);
            for corner in corners {
                let square = Rect::from_center_size(point(corner), vec2(12.0, 12.0));
                painter.rect(square, 2.0, palette.panel, line, egui::StrokeKind::Middle);
            }
            painter.circle(point(middle), 8.0, palette.panel, line);
        }
        self.paint_plants(&painter, palette);
        self.paint_plant_search(&painter, palette);
        if let Some((middle, radius)) = self.canvas.cursor().circle {
            let radius = (radius / scale) as f32;
            painter.circle_stroke(
                point(middle),
                radius + 1.0,
                Stroke::new(1.0, Color32::from_white_alpha(180)),
            );
            painter.circle_stroke(point(middle), radius, Stroke::new(1.0, palette.text));
        }
        if let Some(at) = self.canvas.hovering_pen().filter(|_| self.pen_is_raw()) {
            // The system's cursor does not follow a tablet that is read directly.
            painter.circle(point(at), 2.5, palette.ink, Stroke::new(1.0, palette.paper));
        }
        if self.is_blank() {
            invitation::invite(&painter, self.layout.canvas, self.prefs.messages(), palette);
        }
    }

    /// Whether there is nothing on the canvas that the invitation to draw would stand on.
    fn is_blank(&self) -> bool {
        let Sketch { strokes, reference, .. } = self.sketch();
        let is_traced = reference.as_ref().is_some_and(|reference| reference.visible);
        strokes.is_empty() && self.canvas.growing().is_none() && !is_traced
    }

    /// The cursor over the canvas.
    pub fn cursor(&self) -> egui::CursorIcon {
        match self.canvas.cursor().shape {
            CursorShape::Draw | CursorShape::Select => egui::CursorIcon::Crosshair,
            CursorShape::Erase => egui::CursorIcon::None,
            CursorShape::Move => egui::CursorIcon::Move,
            CursorShape::Stretch(along) => stretch_cursor(along),
            CursorShape::Turn => egui::CursorIcon::Alias,
            CursorShape::Grab => egui::CursorIcon::Grab,
            CursorShape::Grabbing => egui::CursorIcon::Grabbing,
            CursorShape::Zoom => egui::CursorIcon::ZoomIn,
        }
    }
}

/// The arrow nearest to a direction on the screen, radians clockwise from right.
fn stretch_cursor(along: f64) -> egui::CursorIcon {
    use egui::CursorIcon::{ResizeHorizontal, ResizeNeSw, ResizeNwSe, ResizeVertical};
    let eighth = (along / std::f64::consts::FRAC_PI_4).round().rem_euclid(4.0) as usize;
    [ResizeHorizontal, ResizeNwSe, ResizeVertical, ResizeNeSw][eighth.min(3)]
}

#[cfg(test)]
#[path = "interface_tests.rs"]
mod tests;
