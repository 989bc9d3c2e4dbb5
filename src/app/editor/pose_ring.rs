//! Precise turning (001 §4.3, eq. 4.1): a ring around the base of the part that is chosen. A drag along it turns the part about
//! the line of sight, by as much as the pointer goes round, or by an eighth of that while Alt is held.
//!
//! Eq. 4.1 takes an angle by the arc cosine of a rounded number, which is none at 0 and 180 degrees, and has no sign; here it is
//! the arc tangent of cross and dot product. Near the middle of the ring, where an angle means nothing, nothing turns.

use super::Editor;
use super::beside::to_points;
use super::pose_tool::RingHold;
use super::posing::turned;
use crate::app::pose_drag::PoseDrag;
use crate::app::theme::Palette;
use crate::sketch::PartPose;
use egui::{Align2, FontId, Painter, Stroke, vec2};
use glam::{DVec2, Quat};

/// Radius of the ring, points.
const RADIUS: f64 = 64.0;
/// Distance from it within which it is taken hold of, points.
const GRIP: f64 = 14.0;
/// Share of the radius around the middle in which nothing turns.
const DEAD: f64 = 0.15;
/// Share of the pointer's own turn by which the part turns while Alt is held.
const FINE: f64 = 0.125;

impl Editor {
    /// Where the middle of the ring is seen, physical pixels of the window; none without a part that is chosen.
    fn ring_centre(&self) -> Option<DVec2> {
        let name = self.posing.last.filter(|_| self.posing.is_on)?;
        self.plant.seen_at(self.posable(name)?.base)
    }

    /// Takes hold of the ring at a place in the window, physical pixels; whether it is there.
    pub(super) fn hold_ring(&mut self, at: DVec2) -> bool {
        self.posing.ring = self.ring_hold(at);
        if let Some(ring) = &self.posing.ring {
            let part = ring.held.before.part;
            self.posing.held_others = self.other_holds(part);
            self.posing.around = self.wood_around(part);
            // A plant that becomes larger under the pointer does not move away from it.
            self.plant.take_hold();
        }
        self.posing.ring.is_some()
    }

    fn ring_hold(&self, at: DVec2) -> Option<RingHold> {
        let (centre, scale) = (self.ring_centre()?, self.plant.pixels_per_point());
        if (centre.distance(at) / scale - RADIUS).abs() > GRIP {
            return None;
        }
        let name = self.posing.last?;
        let held = self.held(name)?;
        let sight = self.plant.ray(self.plant.place(centre))?.direction;
        Some(RingHold { held, sight, centre, last: at, angle: 0.0 })
    }

    /// Turns the part whose ring is held with the pointer.
    pub(super) fn drag_ring(&mut self, to: DVec2) {
        let dead = DEAD * RADIUS * self.plant.pixels_per_point();
        let gear = if self.posing.is_fine { FINE } else { 1.0 };
        let Some(ring) = &mut self.posing.ring else { return };
        ring.angle += gear * angle_between(ring.last - ring.centre, to - ring.centre, dead);
        ring.last = to;
        // Down is positive in the window, so the angle runs clockwise, as turns about the line of sight do.
        let turn = Quat::from_axis_angle(ring.sight, ring.angle as f32);
        let held = ring.held;
        let bends = self.posing.drag == PoseDrag::Bend && !held.is_stiff;
        let turn = if bends { turn } else { self.posing.free_turn(turn) };
        let all = [&held].into_iter().chain(&self.posing.held_others);
        let poses: Vec<PartPose> = all.map(|held| turned(held, turn, bends)).collect();
        self.pose(poses);
    }

    /// Paints the ring, and while it is held by how many degrees it has turned.
    pub(super) fn paint_ring(&self, painter: &Painter, palette: &Palette) {
        let Some(centre) = self.ring_centre() else { return };
        let (centre, radius) = (to_points(centre, self.plant.pixels_per_point()), RADIUS as f32);
        let width = if self.posing.ring.is_some() { 3.0 } else { 1.5 };
        painter.circle_stroke(centre, radius, Stroke::new(width + 2.0, palette.panel.gamma_multiply(0.6)));
        painter.circle_stroke(centre, radius, Stroke::new(width, palette.accent));
        if let Some(ring) = &self.posing.ring {
            // As on paper: against the clock is positive.
            let text = format!("{:+.1}°", -ring.angle.to_degrees());
            let text = painter.layout_no_wrap(text, FontId::proportional(14.0), palette.text);
            let at = centre + vec2(0.0, -radius - 8.0);
            let place = Align2::CENTER_BOTTOM.anchor_size(at, text.size());
            painter.rect_filled(place.expand2(vec2(6.0, 2.0)), 4.0, palette.panel);
            painter.galley(place.min, text, palette.text);
        }
    }
}

/// The angle from one place to another around the origin, radians, in the direction from x to y; none where one is `dead`.
fn angle_between(from: DVec2, to: DVec2, dead: f64) -> f64 {
    let is_dead = from.length() < dead || to.length() < dead;
    if is_dead { 0.0 } else { from.perp_dot(to).atan2(from.dot(to)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_steps_around_the_ring_add_up_whatever_way_they_go() {
        for (way, gear) in [(1.0, 1.0), (-1.0, FINE)] {
            let at = |k: u32| DVec2::from_angle(way * f64::from(k * 10).to_radians()) * 50.0;
            let sum: f64 = (0..36).map(|k| gear * angle_between(at(k), at(k + 1), 5.0)).sum();
            assert!((sum.to_degrees() - way * gear * 360.0).abs() < 0.01, "{}", sum.to_degrees());
        }
        assert_eq!(angle_between(DVec2::X, -DVec2::X, 0.1).abs(), std::f64::consts::PI);
        assert_eq!(angle_between(DVec2::X, DVec2::X, 0.1), 0.0);
        assert_eq!(angle_between(DVec2::X, DVec2::Y * 0.01, 0.1), 0.0, "through the middle");
    }
}
