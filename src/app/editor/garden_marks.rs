//! What is painted over the view while a garden is painted: the brush on the ground, and the way that it went.

use super::Editor;
use super::beside::to_points;
use crate::app::garden_brush::GardenBrushKind;
use crate::app::theme::Palette;
use crate::garden::painted;
use crate::sketch::GardenStroke;
use egui::epaint::{Mesh, Vertex, WHITE_UV};
use egui::{Color32, Painter, Pos2, Shape};
use glam::{Vec2, Vec3, Vec3Swizzles as _};
use std::f32::consts::TAU;

/// Corners of the circle under the pointer.
const CORNERS: usize = 48;
/// Opacity of what the brush has gone over.
const SWEPT: f32 = 0.25;

impl Editor {
    /// Paints the brush on the ground, and the way of the stroke under the pen.
    pub(super) fn paint_garden_marks(&self, painter: &Painter, palette: &Palette) {
        let brush = &self.garden.brush;
        let colour = match brush.kind {
            GardenBrushKind::Plants => palette.accent,
            GardenBrushKind::Path => palette.text,
            GardenBrushKind::Clear | GardenBrushKind::Erase => palette.error,
        };
        if brush.kind == GardenBrushKind::Erase {
            return self.mark_what_goes(painter, colour);
        }
        if let Some(at) = self.garden.hovered.and_then(|at| self.ground_under(at)) {
            self.ring_on_ground(painter, (at, brush.radius), colour);
        }
        let Some(stroke) = &self.garden.stroke else { return };
        self.mark_stroke(painter, stroke, colour);
    }

    /// Paints the stroke under the pointer, which a press would take away.
    fn mark_what_goes(&self, painter: &Painter, colour: Color32) {
        let garden = &self.sketch().garden;
        let at = self.garden.hovered.and_then(|at| self.ground_under(at));
        if let Some(seen) = at.and_then(|at| painted::stroke_at(garden, at.xz())) {
            self.mark_stroke(painter, &garden[seen], colour);
        }
    }

    fn mark_stroke(&self, painter: &Painter, stroke: &GardenStroke, colour: Color32) {
        let line: Vec<Vec2> = stroke.points.iter().map(|point| point.at).collect();
        painter.add(Shape::mesh(self.band_on_ground(&line, stroke.radius, colour.gamma_multiply(SWEPT))));
        if let Some(last) = line.last() {
            self.ring_on_ground(painter, (Vec3::new(last.x, 0.0, last.y), stroke.radius), colour);
        }
    }

    fn seen_on_ground(&self, at: Vec2) -> Option<Pos2> {
        let seen = self.plant.seen_at(Vec3::new(at.x, 0.0, at.y))?;
        Some(to_points(seen, self.plant.pixels_per_point()))
    }

    fn ring_on_ground(&self, painter: &Painter, (at, radius): (Vec3, f32), colour: Color32) {
        let middle = Vec2::new(at.x, at.z);
        let corner =
            |k: usize| middle + radius * Vec2::from_angle(TAU * (k % CORNERS) as f32 / CORNERS as f32);
        let ring: Option<Vec<Pos2>> = (0..=CORNERS).map(|k| self.seen_on_ground(corner(k))).collect();
        painter.line(ring.unwrap_or_default(), (1.5, colour));
    }

    /// The ground on both sides of a line, as it is seen.
    fn band_on_ground(&self, line: &[Vec2], radius: f32, colour: Color32) -> Mesh {
        let mut mesh = Mesh::default();
        let mut was_seen = false;
        for (k, at) in line.iter().enumerate() {
            let (from, to) = (line[k.saturating_sub(1)], line[(k + 1).min(line.len() - 1)]);
            let side = (to - from).normalize_or(Vec2::X).perp() * radius;
            let seen = [at + side, at - side].map(|at| self.seen_on_ground(at));
            let [Some(left), Some(right)] = seen else {
                was_seen = false;
                continue;
            };
            let first = mesh.vertices.len() as u32;
            let vertex = |pos: Pos2| Vertex { pos, uv: WHITE_UV, color: colour };
            mesh.vertices.extend([left, right].map(vertex));
            if was_seen {
                mesh.indices.extend([first - 2, first - 1, first, first, first - 1, first + 1]);
            }
            was_seen = true;
        }
        mesh
    }
}
