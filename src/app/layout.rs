//! Where things are in the window: the canvas and the plant side by side between the panels.

use super::canvas::Rect as CanvasRect;
use egui::{Pos2, Rect};
use glam::DVec2;

/// Width on which the divider between canvas and plant can be taken hold of, points.
pub(super) const GRIP: f32 = 12.0;

/// Where things are, in points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout {
    /// The drawing.
    pub canvas: Rect,
    /// The plant.
    pub plant: Rect,
    pub(super) pixels_per_point: f64,
    /// All of the drawing is shown, and stays so when the canvas changes its size, until the artist moves it.
    pub(super) shows_all: bool,
    /// Another drawing was opened: it is fitted into the canvas with the next frame.
    pub(super) is_new: bool,
}

impl Default for Layout {
    fn default() -> Self {
        let none = Rect::NOTHING;
        Self { canvas: none, plant: none, pixels_per_point: 1.0, shows_all: true, is_new: true }
    }
}

impl Layout {
    /// Physical pixels per point.
    pub fn pixels_per_point(&self) -> f64 {
        self.pixels_per_point
    }

    /// The canvas in physical pixels.
    pub fn canvas_px(&self) -> CanvasRect {
        let px = |p: Pos2| DVec2::new(p.x.into(), p.y.into()) * self.pixels_per_point;
        if self.canvas.is_finite() {
            CanvasRect::new(px(self.canvas.min), px(self.canvas.max))
        } else {
            CanvasRect::new(DVec2::ZERO, DVec2::ONE)
        }
    }

    /// Whether a press at this place, in points, is meant for the drawing: on the canvas, and not on the divider.
    pub(super) fn is_canvas(&self, at: Pos2) -> bool {
        let x =
            if self.canvas.right() <= self.plant.left() { self.canvas.right() } else { self.canvas.left() };
        self.canvas.contains(at) && (at.x - x).abs() > GRIP / 2.0
    }

    /// Whether a press at this place, in points, is meant for the plant: on it, and not on the divider.
    pub(super) fn is_plant(&self, at: Pos2) -> bool {
        let x = if self.canvas.right() <= self.plant.left() { self.plant.left() } else { self.plant.right() };
        self.plant.contains(at) && (at.x - x).abs() > GRIP / 2.0
    }

    /// A new egui context: nothing of ours is in its memory.
    pub(super) fn forget_context(&mut self) {
        self.pixels_per_point = 1.0;
    }

    /// Another drawing: it is fitted into the canvas with the next frame.
    pub fn forget(&mut self) {
        self.is_new = true;
    }
}
