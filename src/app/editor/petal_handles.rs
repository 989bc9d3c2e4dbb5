//! The control points of the chosen petal over the picture of the plant: where they are seen, and how they are painted.
//!
//! They are as large as a fingertip to touch, whatever their size on the screen; where several are near, the nearest is taken
//! hold of.

use super::Editor;
use super::beside::to_points;
use super::petal_tool::PointPlace;
use crate::app::theme::Palette;
use egui::{Painter, Pos2, Stroke};
use glam::DVec2;

/// Distance within which a point is taken hold of, points.
const GRIP: f64 = 22.0;
/// Radius of a point as it is painted, and of the one that was touched last, points.
const RADII: (f32, f32) = (7.0, 9.0);

impl Editor {
    /// Where the control points of the chosen petal are seen, physical pixels of the window; those behind the eye are not.
    fn control_points(&self) -> Option<[[Option<DVec2>; 4]; 4]> {
        let net = self.petal_net()?;
        Some(net.points.map(|row| row.map(|point| self.plant.seen_at(point))))
    }

    /// The control point nearest to a place in the window that is near enough to be taken hold of, physical pixels.
    pub(super) fn control_point_at(&self, at: DVec2) -> Option<PointPlace> {
        let reach = GRIP * self.plant.pixels_per_point();
        let points = self.control_points()?;
        let places = (0..4).flat_map(|row| (0..4).map(move |column| PointPlace { row, column }));
        let far = |place: PointPlace| {
            let far = points[place.row][place.column]?.distance(at);
            (far <= reach).then_some((far, place))
        };
        places.filter_map(far).min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, place)| place)
    }

    /// Paints them, with the net between them.
    pub(super) fn paint_control_points(&self, painter: &Painter, palette: &Palette) {
        let Some(points) = self.control_points() else { return };
        let scale = self.plant.pixels_per_point();
        let points: [[Option<Pos2>; 4]; 4] = points.map(|row| row.map(|at| Some(to_points(at?, scale))));
        let line = Stroke::new(1.0, palette.accent.gamma_multiply(0.7));
        let between = |from: Option<Pos2>, to: Option<Pos2>| {
            if let (Some(from), Some(to)) = (from, to) {
                painter.line_segment([from, to], line);
            }
        };
        for row in points {
            row.windows(2).for_each(|ends| between(ends[0], ends[1]));
        }
        for rows in points.windows(2) {
            rows[0].iter().zip(rows[1]).for_each(|(from, to)| between(*from, to));
        }
        let touched = self.petals.point.map(|PointPlace { row, column }| (row, column));
        for (row, column) in (0..4).flat_map(|row| (0..4).map(move |column| (row, column))) {
            let Some(at) = points[row][column] else { continue };
            let (radius, fill) = match touched == Some((row, column)) {
                true => (RADII.1, palette.accent),
                false => (RADII.0, palette.panel),
            };
            painter.circle(at, radius, fill, Stroke::new(2.0, palette.accent));
        }
    }
}
