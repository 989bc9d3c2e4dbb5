//! Where branches can begin in the view of the plant, and what is painted over it while they are drawn.

use super::Editor;
use super::beside::to_points;
use super::drawing_surface::DrawingSurface;
use crate::app::theme::Palette;
use crate::geom::polyline;
use crate::modelling::GROUND_REACH;
use crate::plant::Branch;
use egui::{Painter, Pos2};
use glam::{DVec2, Vec2, Vec3};

/// Distance from wood within which a branch begins on it, points.
const REACH: f64 = 14.0;
/// Sine of the camera's slope from which the ground is drawn on from above.
const FROM_ABOVE: f32 = 0.35;
/// How far from the plant a trunk may stand, in heights of it.
const AROUND: f32 = 1.5;

impl Editor {
    /// The drawn branch under a place in the window, physical pixels, and the place on its axis; of several the one in
    /// front.
    pub(super) fn wood_at(&self, at: DVec2) -> Option<(&Branch, Vec3)> {
        let forward = self.plant.forward()?;
        let places = self.drawn_wood().filter_map(|branch| Some((branch, self.place_on(branch, at)?)));
        places.min_by(|a, b| a.1.dot(forward).total_cmp(&b.1.dot(forward)))
    }

    /// The place on the axis of a branch that is seen nearest to a place in the window, if that is over the branch, or as near
    /// as a finger is thick.
    pub(super) fn place_on(&self, branch: &Branch, at: DVec2) -> Option<Vec3> {
        let (away, place, radius) = self.seen_on(branch, at)?;
        (away <= self.reach_at(place, radius)).then_some(place)
    }

    /// The place on the axis of a branch that is seen nearest to a place in the window, how far from that, physical pixels, and
    /// the branch's radius there, metres.
    pub(super) fn seen_on(&self, branch: &Branch, at: DVec2) -> Option<(f64, Vec3, f32)> {
        let mut best: Option<(f32, usize, f32)> = None;
        let mut before: Option<Vec2> = None;
        // No list: this is asked of all branches with every frame in which the pointer hovers.
        for (i, point) in branch.points.iter().enumerate() {
            let seen = self.plant.seen_at(*point).map(|seen| (seen - at).as_vec2());
            if let (Some(a), Some(b)) = (before, seen) {
                let share = polyline::nearest_share(a, b, Vec2::ZERO, Vec2::dot);
                let away = a.lerp(b, share).length();
                if best.is_none_or(|(least, ..)| away < least) {
                    best = Some((away, i - 1, share));
                }
            }
            before = seen;
        }
        let (away, i, share) = best?;
        Some((away.into(), branch.points[i].lerp(branch.points[i + 1], share), branch.radii[i]))
    }

    /// How far from a place something of this radius there, metres, is touched, physical pixels: as far as it reaches, and no less
    /// than a finger does.
    pub(super) fn reach_at(&self, place: Vec3, radius: f32) -> f64 {
        let reach = REACH * self.plant.pixels_per_point();
        self.seen_length(place, radius).unwrap_or(0.0).max(reach)
    }

    /// How long something of a length at a place, metres, is seen, physical pixels.
    pub(super) fn seen_length(&self, place: Vec3, length: f32) -> Option<f64> {
        let right = self.plant.forward()?.cross(Vec3::Y).try_normalize().unwrap_or(Vec3::X);
        Some(self.plant.seen_at(place)?.distance(self.plant.seen_at(place + right * length)?))
    }

    /// Where a trunk would stand on the ground under a place in the window; none where that is far from the plant.
    pub(super) fn ground_at(&self, at: DVec2) -> Option<Vec3> {
        let (low, high) = self.plant.bounds()?;
        let (forward, ray) = (self.plant.forward()?, self.plant.ray(self.plant.place(at))?);
        let middle = low.midpoint(high).with_y(0.0);
        let height = (high.y - low.y).max((high.x - low.x) * 0.5);
        let is_from_above = forward.y <= -FROM_ABOVE;
        let (through, normal) = match is_from_above {
            true => (Vec3::ZERO, Vec3::Y),
            false => (middle, forward.with_y(0.0).normalize_or(Vec3::Z)),
        };
        let met = DrawingSurface::Plane { through, normal }.met_by(&ray)?;
        let is_low = is_from_above || met.y.abs() <= 2.0 * GROUND_REACH * height;
        let is_near = met.with_y(0.0).distance(middle) <= AROUND * height;
        (is_low && is_near).then(|| met.with_y(0.0))
    }

    /// Notes where the pointer hovers over the plant, logical pixels of the window; none elsewhere.
    pub(super) fn hover_in_space(&mut self, at: Option<Pos2>) {
        let scale = self.plant.pixels_per_point();
        let at = at.map(|at| DVec2::new(at.x.into(), at.y.into()) * scale);
        self.hover_brush(at);
        self.hover_garden(at);
        let is_idle = self.space.stroke.is_none() && self.posing.hold.is_none();
        let at = at.filter(|_| is_idle);
        let on_wood = |at: DVec2| self.wood_at(at).map(|(_, place)| place);
        let begin = at.and_then(|at| match (self.space.is_on, self.posing.is_on) {
            (true, _) => on_wood(at).or_else(|| self.ground_at(at)),
            (_, true) => on_wood(at),
            _ => None,
        });
        self.space.hovered = begin.and_then(|begin| self.plant.seen_at(begin));
    }

    /// Paints where a branch would begin, the line under the pen, and brushes.
    pub(super) fn paint_in_space(&self, painter: &Painter, palette: &Palette) {
        let scale = self.plant.pixels_per_point();
        if let Some(at) = self.space.hovered {
            painter.circle(to_points(at, scale), 5.0, palette.accent, (1.5, palette.panel));
        }
        self.paint_brush(painter, palette);
        self.paint_garden_marks(painter, palette);
        self.paint_chosen_parts(painter, palette);
        self.paint_ring(painter, palette);
        let Some(stroke) = &self.space.stroke else { return };
        let seen = stroke.points.iter().filter_map(|point| self.plant.seen_at(stroke.frame.place(point)));
        let line: Vec<Pos2> = seen.map(|at| to_points(at, scale)).collect();
        painter.line(line, (2.0, palette.accent));
    }
}
