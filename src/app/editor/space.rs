//! Branches drawn in the view of the plant (001 §4.2): from wood, or from the ground for a trunk of its own.
//!
//! A line that begins on wood is a branch of it; what else is dragged turns the camera as ever, and a tap selects. The pen
//! draws on the surface that is chosen: facing the viewer through the beginning, level, or along the lines of sight of the
//! branch drawn last, which is lifted. While it draws, the plant grows with every sample; lifted, it is one step to undo.
//!
//! Limits: branches begin on wood that was drawn, for wood that grew is another one when anything changes.

use super::Editor;
use super::beside::to_points;
use super::drawing_surface::DrawingSurface;
use super::space_tool::SpaceStroke;
use crate::app::action::Action;
use crate::app::panels::snapshot::SpaceState;
use crate::app::theme::Palette;
use crate::app::work_surface::WorkSurface;
use crate::modelling::GROUND_REACH;
use crate::pen::{PenPhase, PenSample, PenTool};
use crate::plant::{Branch, WorldFromCanvas};
use crate::sketch::{Change, Stroke, StrokePoint, Tool, limits};
use egui::Painter;
use glam::{DVec2, Vec3};

/// Distance from wood within which a branch begins on it, points.
const REACH: f64 = 14.0;
/// Sine of the camera's slope from which the ground is drawn on from above.
const FROM_ABOVE: f32 = 0.35;
/// How far from the plant a trunk may stand, in heights of it.
const AROUND: f32 = 1.5;

impl Editor {
    /// Actions about branches in space.
    pub(super) fn perform_in_space(&mut self, action: Action) {
        match action {
            Action::DrawInSpace(on) => {
                self.space.is_on = on;
                self.space.stroke = None;
                if on {
                    self.petals.is_on = false;
                    self.petals.let_go();
                }
            }
            Action::SetWorkSurface(surface) => self.space.surface = surface,
            other => self.perform_on_dialogs(other),
        }
    }

    /// What the panel over the plant shows.
    pub(super) fn space_state(&self) -> SpaceState {
        let can_lift = self.last_in_space().is_some();
        let surface = match self.space.surface {
            WorkSurface::Lifted if !can_lift => WorkSurface::Facing,
            surface => surface,
        };
        SpaceState { any: self.built().is_some(), on: self.space.is_on, surface, can_lift }
    }

    /// Begins a branch at a place in the window, physical pixels; whether there is anything to begin on.
    pub(super) fn begin_in_space(&mut self, sample: &PenSample) -> bool {
        if !self.space.is_on {
            return false;
        }
        let at = sample.position;
        let begun = match self.space_state().surface {
            WorkSurface::Lifted => self.lift_begun(at),
            surface => self.branch_begun(at, surface),
        };
        let Some((id, surface, start, lifts)) = begun else { return false };
        let mut stroke = SpaceStroke { id, surface, began_ms: sample.time_ms, points: Vec::new(), lifts };
        if let (Some(start), Some(world)) = (start, self.world()) {
            stroke.points.push(point(start, world, self.pressed(sample), 0.0));
        }
        // A plant that becomes larger under the pen does not move away from it.
        self.plant.take_hold();
        self.space.stroke = Some(stroke);
        true
    }

    /// A new branch: its name, surface and beginning.
    fn branch_begun(
        &self,
        at: DVec2,
        surface: WorkSurface,
    ) -> Option<(u64, DrawingSurface, Option<Vec3>, bool)> {
        let start = self.wood_at(at).or_else(|| self.ground_at(at))?;
        let normal = match surface {
            WorkSurface::Level => Vec3::Y,
            WorkSurface::Facing | WorkSurface::Lifted => self.plant.forward()?,
        };
        let surface = DrawingSurface::Plane { through: start, normal };
        Some((self.drawing.next_id(), surface, Some(start), false))
    }

    /// The branch drawn last, to be lifted; none away from it.
    fn lift_begun(&self, at: DVec2) -> Option<(u64, DrawingSurface, Option<Vec3>, bool)> {
        let (stroke, world) = (self.last_in_space()?, self.world()?);
        let line: Vec<Vec3> = stroke.points.iter().map(|p| world_point(p, world)).collect();
        let seen: Vec<DVec2> = line.iter().filter_map(|p| self.plant.seen_at(*p)).collect();
        let away = |ends: &[DVec2]| ends[0].lerp(ends[1], nearest_share(ends[0], ends[1], at)).distance(at);
        if !seen.windows(2).any(|ends| away(ends) <= REACH * self.plant.pixels_per_point()) {
            return None;
        }
        let seen = self.space.last.filter(|(id, _)| *id == stroke.id);
        let along = seen.map_or(Vec3::Y, |(_, along)| along);
        let start = line.first().copied();
        (line.len() > 1).then(|| (stroke.id, DrawingSurface::Ruled { line, along, from: 0.0 }, start, true))
    }

    /// The branch in space that is the newest stroke of its kind.
    fn last_in_space(&self) -> Option<&Stroke> {
        self.sketch().in_space().max_by_key(|stroke| stroke.id).map(|stroke| &**stroke)
    }

    /// Follows what the pen drew in the view of the plant since this was asked last.
    pub(super) fn draw_in_space(&mut self) {
        for (phase, sample) in self.plant.take_drawn() {
            match phase {
                PenPhase::Move => self.extend_in_space(&sample, self.pressed(&sample)),
                PenPhase::Up => {
                    // A lifted pen presses no more: the end is as thick as what is before it.
                    let last = self.space.stroke.as_ref().and_then(|stroke| stroke.points.last());
                    let pressure = last.map_or(StrokePoint::NEUTRAL_PRESSURE, |last| last.pressure);
                    self.extend_in_space(&sample, pressure);
                    self.end_in_space();
                }
                PenPhase::Cancel => self.cancel_in_space(),
                _ => {}
            }
        }
    }

    /// One more sample of the branch under the pen.
    fn extend_in_space(&mut self, sample: &PenSample, pressure: f32) {
        let ray = self.plant.ray(self.plant.place(sample.position));
        let world = self.world();
        let (Some(stroke), Some(ray), Some(world)) = (self.space.stroke.as_mut(), ray, world) else { return };
        let time_ms = ((sample.time_ms - stroke.began_ms) as f32).clamp(0.0, limits::MAX_TIME_MS);
        let Some(met) = stroke.surface.met_by(&ray) else { return };
        let new = point(met, world, pressure, time_ms);
        let is_other =
            stroke.points.last().is_none_or(|last| (last.position, last.depth) != (new.position, new.depth));
        let place = new.position.extend(new.depth);
        if !is_other || !(place.abs().max_element() <= limits::MAX_COORDINATE) {
            return;
        }
        stroke.points.push(new);
        if stroke.lifts {
            let lifted = lifted(stroke, world);
            return self.change_merging(Change::put(lifted), "lift");
        }
        self.live.set_stale();
    }

    /// What was drawn does not count.
    fn cancel_in_space(&mut self) {
        match self.space.stroke.take() {
            Some(stroke) if stroke.lifts && stroke.points.len() > 1 => {
                self.drawing.end_merging();
                let is_other = self.drawing.undo();
                self.changed(is_other);
            }
            _ => self.live.set_stale(),
        }
    }

    /// The pen is lifted: the branch counts.
    pub(super) fn end_in_space(&mut self) {
        let Some(stroke) = self.space.stroke.take() else { return };
        if stroke.lifts {
            // Drawn once more it would be lifted again along the first lines of sight; a new branch is drawn as before.
            self.space.surface = WorkSurface::Facing;
            return self.drawing.end_merging();
        }
        self.space.last = self.plant.forward().map(|forward| (stroke.id, sight(&stroke.surface, forward)));
        if stroke.points.len() < 2 {
            return self.live.set_stale();
        }
        let SpaceStroke { id, points, .. } = stroke;
        self.change(Change::put(Stroke { id, tool: Tool::SpaceBranch, points }));
    }

    /// What the pen presses, as the artist's curve has it.
    fn pressed(&self, sample: &PenSample) -> f32 {
        let pressure = match sample.tool {
            PenTool::Pen | PenTool::Eraser => self.canvas.pressure(sample.pressure),
            PenTool::Finger(_) | PenTool::Mouse => StrokePoint::NEUTRAL_PRESSURE,
        };
        if pressure.is_nan() { StrokePoint::NEUTRAL_PRESSURE } else { pressure.clamp(0.0, 1.0) }
    }

    /// How the drawing maps to the world of the plant that is shown.
    fn world(&self) -> Option<WorldFromCanvas> {
        self.built().map(|built| built.provenance.world_from_canvas)
    }

    /// The wood that branches in space can begin on.
    fn drawn_wood(&self) -> impl Iterator<Item = &Branch> {
        let built = self.built().map(|built| &**built);
        let grown = built.and_then(|built| built.drawn_wood.as_deref());
        let plain = built.filter(|_| grown.is_none()).map(|built| &*built.plant.branches);
        let drawn = plain.unwrap_or_default().iter().filter(|branch| branch.origin.is_drawn());
        grown.unwrap_or_default().iter().chain(drawn)
    }

    /// The place on the axis of drawn wood under a place in the window; of several the one in front.
    fn wood_at(&self, at: DVec2) -> Option<Vec3> {
        let forward = self.plant.forward()?;
        let (scale, right) =
            (self.plant.pixels_per_point(), forward.cross(Vec3::Y).try_normalize().unwrap_or(Vec3::X));
        let near = |branch: &Branch| {
            let seen: Vec<Option<DVec2>> = branch.points.iter().map(|p| self.plant.seen_at(*p)).collect();
            let pieces = seen.windows(2).enumerate().filter_map(|(i, ends)| {
                let (a, b) = (ends[0]?, ends[1]?);
                let share = nearest_share(a, b, at);
                let place = branch.points[i].lerp(branch.points[i + 1], share as f32);
                // As thick as it is seen, or as a finger is.
                let edge = self.plant.seen_at(place + branch.radii[i] * right)?;
                let axis = a.lerp(b, share);
                (axis.distance(at) <= (REACH * scale).max(edge.distance(axis)))
                    .then_some((axis.distance(at), place))
            });
            pieces.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, place)| place)
        };
        let places = self.drawn_wood().filter_map(near);
        places.min_by(|a, b| a.dot(forward).total_cmp(&b.dot(forward)))
    }

    /// Where a trunk would stand on the ground under a place in the window; none where that is far from the plant.
    fn ground_at(&self, at: DVec2) -> Option<Vec3> {
        let (low, high) = self.plant.bounds()?;
        let (forward, ray) = (self.plant.forward()?, self.plant.ray(self.plant.place(at))?);
        let (middle, height) = (low.midpoint(high).with_y(0.0), (high.y - low.y).max((high.x - low.x) * 0.5));
        let is_from_above = forward.y <= -FROM_ABOVE;
        let mut surface = match is_from_above {
            true => DrawingSurface::Plane { through: Vec3::ZERO, normal: Vec3::Y },
            false => {
                DrawingSurface::Plane { through: middle, normal: forward.with_y(0.0).normalize_or(Vec3::Z) }
            }
        };
        let met = surface.met_by(&ray)?;
        let is_low = is_from_above || met.y.abs() <= 2.0 * GROUND_REACH * height;
        let is_near = met.with_y(0.0).distance(middle) <= AROUND * height;
        (is_low && is_near).then(|| met.with_y(0.0))
    }

    /// Notes where the pointer hovers over the plant, logical pixels of the window; none elsewhere.
    pub(super) fn hover_in_space(&mut self, at: Option<egui::Pos2>) {
        let scale = self.plant.pixels_per_point();
        let at = at.filter(|_| self.space.is_on && self.space.stroke.is_none());
        let at = at.map(|at| DVec2::new(at.x.into(), at.y.into()) * scale);
        let begin = at.and_then(|at| self.wood_at(at).or_else(|| self.ground_at(at)));
        self.space.hovered = begin.and_then(|begin| self.plant.seen_at(begin));
    }

    /// Paints where a branch would begin, and the line under the pen.
    pub(super) fn paint_in_space(&self, painter: &Painter, palette: &Palette) {
        let scale = self.plant.pixels_per_point();
        if let Some(at) = self.space.hovered {
            painter.circle(to_points(at, scale), 5.0, palette.accent, (1.5, palette.panel));
        }
        let (Some(stroke), Some(world)) = (&self.space.stroke, self.world()) else { return };
        let seen = stroke.points.iter().filter_map(|p| self.plant.seen_at(world_point(p, world)));
        let line: Vec<egui::Pos2> = seen.map(|at| to_points(at, scale)).collect();
        painter.line(line, (2.0, palette.accent));
    }
}

/// The way along which a branch on this surface can be lifted: that in which it is seen.
fn sight(surface: &DrawingSurface, forward: Vec3) -> Vec3 {
    match surface {
        DrawingSurface::Plane { normal, .. } => *normal,
        DrawingSurface::Ruled { .. } => forward,
    }
}

/// The branch that is lifted: as far as the pen has come, and the rest of it after that, moved along.
fn lifted(stroke: &SpaceStroke, world: WorldFromCanvas) -> Stroke {
    let mut points = stroke.points.clone();
    let last = points.last().copied();
    if let (Some(last), DrawingSurface::Ruled { line, along, from }) = (last, &stroke.surface) {
        let (i, share) = (from.floor() as usize, from.fract());
        let here = line.get(i).map(|p| p.lerp(*line.get(i + 1).unwrap_or(p), share));
        let height = here.map_or(Vec3::ZERO, |here| (world_point(&last, world) - here).project_onto(*along));
        let rest =
            stroke.surface.rest().iter().map(|p| point(*p + height, world, last.pressure, last.time_ms));
        points.extend(rest);
    }
    Stroke { id: stroke.id, tool: Tool::SpaceBranch, points }
}

/// A world point as a sample of a stroke.
fn point(at: Vec3, world: WorldFromCanvas, pressure: f32, time_ms: f32) -> StrokePoint {
    StrokePoint { pressure, time_ms, depth: at.z / world.scale, ..StrokePoint::at(world.canvas(at)) }
}

/// The world point of a sample.
fn world_point(point: &StrokePoint, world: WorldFromCanvas) -> Vec3 {
    world.point(point.position).with_z(point.depth * world.scale)
}

/// Share of the way from `a` to `b` of the place nearest to a point.
fn nearest_share(a: DVec2, b: DVec2, at: DVec2) -> f64 {
    let way = b - a;
    ((at - a).dot(way) / way.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0)
}

#[cfg(test)]
#[path = "space_tests.rs"]
mod tests;
