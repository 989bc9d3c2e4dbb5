//! Brushes in the view of the plant (001 §4.4): a growth brush is filled with wood and leaves when the pen is lifted, a pruning brush
//! cuts while it moves, and light draws what grows toward it.
//!
//! A drag that begins where the brush is over the plant, or nearly so, paints, in the plane through the nearest wood there that faces the viewer,
//! or level through it; what else is dragged turns the camera, and a tap selects. One stroke is one step to undo, and lies among
//! the strokes of the sheet, where it can be moved and erased like them.
//!
//! Limits: a stroke stays in its plane; what has depth takes several strokes from several sides.

use super::Editor;
use super::beside::to_points;
use super::brush_tool::BrushStroke;
use super::drawing_surface::DrawingSurface;
use super::stroke_frame::StrokeFrame;
use crate::app::action::Action;
use crate::app::panels::snapshot::BrushState;
use crate::app::theme::Palette;
use crate::app::work_surface::WorkSurface;
use crate::pen::{PenPhase, PenSample, PenTool};
use crate::sketch::{Brush, Change, Stroke, StrokePoint, Tool};
use egui::epaint::{Mesh, Vertex, WHITE_UV};
use egui::{Color32, Painter, Pos2, Shape, Vec2};
use glam::{DVec2, Vec3};

/// How far from wood a stroke may begin, in radii of the brush: who cuts a branch begins beside it.
const NEAR: f32 = 2.0;
/// Opacity of what a brush has swept.
const SWEPT: f32 = 0.35;

impl Editor {
    /// Actions about brushes.
    pub(super) fn perform_on_brushes(&mut self, action: Action) {
        match action {
            Action::TakeBrush(tool) => {
                self.lay_down_plant_tools();
                self.brush.tool = tool.filter(|tool| tool.is_brush());
            }
            Action::SetBrush(settings) => self.brush.settings = settings,
            other => self.perform_on_dialogs(other),
        }
    }

    /// The action of a brush's key: take it up, or lay it down.
    pub(super) fn toggled(&self, tool: Tool) -> Action {
        Action::TakeBrush((self.brush.tool != Some(tool)).then_some(tool))
    }

    /// What the bar below the plant shows.
    pub(super) fn brush_state(&self) -> BrushState {
        BrushState { tool: self.brush.tool, settings: self.brush.settings }
    }

    /// Begins a stroke at a place in the window, physical pixels; whether the brush is over the plant there.
    pub(super) fn begin_painting(&mut self, sample: &PenSample) -> bool {
        let buttons = sample.buttons;
        let moves_camera = buttons.secondary || buttons.middle || self.canvas.is_shift_held();
        let stroke = if moves_camera { None } else { self.stroke_begun(sample) };
        let Some(stroke) = stroke else { return false };
        self.plant.take_hold();
        self.brush.stroke = Some(stroke);
        true
    }

    /// A stroke with its first sample.
    fn stroke_begun(&self, sample: &PenSample) -> Option<BrushStroke> {
        let tool = self.brush.tool?;
        let frame = StrokeFrame { world: self.world()?, motion: None };
        let settings = self.brush.settings;
        let radius = settings.size * self.sketch().canvas.height;
        // Light may shine from anywhere.
        let near = if tool == Tool::LightBrush { f32::INFINITY } else { NEAR * radius * frame.world.scale };
        let through = self.wood_under_brush(sample.position, near)?;
        let normal = match self.space.surface {
            WorkSurface::Level => Vec3::Y,
            WorkSurface::Facing | WorkSurface::Lifted => self.plant.forward()?,
        };
        let mut surface = DrawingSurface::Plane { through, normal };
        let at = surface.met_by(&self.plant.ray(self.plant.place(sample.position))?)?;
        let brush = Brush { radius, density: settings.density, guide: settings.guide };
        let points = vec![frame.sample(at, self.pressed(sample), 0.0)];
        Some(BrushStroke {
            id: self.unused_id(),
            tool,
            brush,
            surface,
            frame,
            began_ms: sample.time_ms,
            points,
        })
    }

    /// The place of the plant's wood, grown wood too, that is seen nearest to a place in the window, if it is seen so near, metres.
    fn wood_under_brush(&self, at: DVec2, near: f32) -> Option<Vec3> {
        let branches = self.built()?.plant.branches.iter();
        let seen = branches.filter_map(|branch| self.seen_on(branch, at));
        let (away, place, _) = seen.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (near.is_infinite() || away <= self.reach_at(place, near)).then_some(place)
    }

    /// Follows what the pen painted since this was asked last.
    pub(super) fn paint(&mut self, phase: PenPhase, sample: &PenSample) {
        match phase {
            PenPhase::Move => self.extend_painting(sample, self.pressed(sample)),
            PenPhase::Up => {
                // A lifted pen presses no more: the end is as wide as what is before it.
                let last = self.brush.stroke.as_ref().and_then(|stroke| stroke.points.last());
                let pressure = last.map_or(StrokePoint::NEUTRAL_PRESSURE, |last| last.pressure);
                self.extend_painting(sample, pressure);
                self.end_painting();
                // Fingers hover nowhere.
                let hovers = !matches!(sample.tool, PenTool::Finger(_));
                self.hover_brush(hovers.then_some(sample.position));
            }
            PenPhase::Cancel => {
                self.brush.stroke = None;
                self.live.set_stale();
            }
            _ => {}
        }
    }

    /// One more sample of the stroke under the pen.
    fn extend_painting(&mut self, sample: &PenSample, pressure: f32) {
        let ray = self.plant.ray(self.plant.place(sample.position));
        let (Some(stroke), Some(ray)) = (self.brush.stroke.as_mut(), ray) else { return };
        let Some(met) = stroke.surface.met_by(&ray) else { return };
        let when = (pressure, sample.time_ms - stroke.began_ms);
        let Some(new) = stroke.frame.next_sample(stroke.points.last(), met, when) else { return };
        stroke.points.push(new);
        if stroke.under_pen().is_some() {
            self.live.set_stale();
        }
    }

    /// The pen is lifted: the stroke counts.
    pub(super) fn end_painting(&mut self) {
        let Some(BrushStroke { id, tool, brush, points, .. }) = self.brush.stroke.take() else { return };
        self.change(Change::put(Stroke { id, tool, points, brush: Some(brush) }));
    }

    /// Notes where the pointer hovers over the plant, physical pixels of the window; none elsewhere.
    pub(super) fn hover_brush(&mut self, at: Option<DVec2>) {
        self.brush.hovered = at.filter(|_| self.brush.tool.is_some() && self.brush.stroke.is_none());
    }

    /// Paints the brush under the pointer, and what it has swept.
    pub(super) fn paint_brush(&self, painter: &Painter, palette: &Palette) {
        let scale = self.plant.pixels_per_point();
        let colour = match self.brush.tool {
            Some(tool @ (Tool::PruningBrush | Tool::LightBrush | Tool::FlowerBrush)) => palette.tool(tool),
            _ => palette.accent,
        };
        if let (Some(at), Some(radius)) = (self.brush.hovered, self.hovered_radius()) {
            painter.circle_stroke(to_points(at, scale), (radius / scale) as f32, (1.5, colour));
        }
        let Some(stroke) = &self.brush.stroke else { return };
        let seen = |point: &StrokePoint| {
            let place = stroke.frame.place(point);
            let radius = stroke.brush.radius_at(point.pressure) * stroke.frame.world.scale;
            let at = self.plant.seen_at(place)?;
            Some((to_points(at, scale), (self.seen_length(place, radius)? / scale) as f32))
        };
        let places: Vec<(Pos2, f32)> = stroke.points.iter().filter_map(seen).collect();
        painter.add(Shape::mesh(swept(&places, colour.gamma_multiply(SWEPT))));
        if let Some((at, radius)) = places.last() {
            painter.circle_stroke(*at, *radius, (1.5, colour));
        }
    }

    /// How large the brush looks in the middle of the plant, physical pixels.
    fn hovered_radius(&self) -> Option<f64> {
        let (low, high) = self.plant.bounds()?;
        let radius = self.brush.settings.size * self.sketch().canvas.height * self.world()?.scale;
        self.seen_length(low.midpoint(high), radius)
    }
}

/// What a disc sweeps on its way, as a band with round ends: one mesh, so that it is as opaque everywhere, but where it crosses
/// itself.
fn swept(places: &[(Pos2, f32)], colour: Color32) -> Mesh {
    let mut mesh = Mesh::default();
    let vertex = |pos: Pos2| Vertex { pos, uv: WHITE_UV, color: colour };
    for (k, &(at, radius)) in places.iter().enumerate() {
        let (from, to) = (places[k.saturating_sub(1)].0, places[(k + 1).min(places.len() - 1)].0);
        let along = (to - from).normalized();
        let side = if along == Vec2::ZERO { Vec2::X } else { along.rot90() } * radius;
        let first = mesh.vertices.len() as u32;
        mesh.vertices.extend([vertex(at + side), vertex(at - side)]);
        if k > 0 {
            mesh.indices.extend([first - 2, first - 1, first, first, first - 1, first + 1]);
        }
    }
    for (end, inner) in [(0, 1), (places.len().wrapping_sub(1), places.len().wrapping_sub(2))] {
        let Some(&(at, radius)) = places.get(end) else { continue };
        let out = places.get(inner).map_or(Vec2::Y, |inner| at - inner.0).normalized();
        let (middle, steps) = (mesh.vertices.len() as u32, 12);
        mesh.vertices.push(vertex(at));
        for k in 0..=steps {
            let turn = std::f32::consts::PI * (k as f32 / steps as f32 - 0.5);
            let way =
                Vec2::new(out.x * turn.cos() - out.y * turn.sin(), out.x * turn.sin() + out.y * turn.cos());
            mesh.vertices.push(vertex(at + way * radius));
            if k > 0 {
                mesh.indices.extend([middle, middle + k, middle + k + 1]);
            }
        }
    }
    mesh
}

#[cfg(test)]
#[path = "painting_tests.rs"]
mod tests;
