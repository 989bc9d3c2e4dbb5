//! Outlines of petals from a few numbers: width, where it is widest, how broad its foot is, tip, notch and teeth.
//!
//! From the foot to the widest place the half width rises as a sine, from there to the tip it falls as an ellipse, or as a
//! power of one where the tip is pointed. Teeth are triangles along the margin beyond the widest place: the frill of a
//! carnation.

use crate::geom::polyline;
use crate::plant::{Detail, Template};
use glam::Vec2;
use std::f32::consts::FRAC_PI_2;

/// Points on each side below the widest place, and beyond it.
const BELOW: usize = 7;
const BEYOND: usize = 10;
/// Power of the ellipse of a pointed tip.
const POINTED: f32 = 1.5;

crate::parameters! {
    /// Outline of a petal.
    pub struct PetalOutline {
        /// Greatest width.
        width: f32 = 0.75, 0.02..=2.0, "of the length";
        /// Where it is widest: 0 foot, 1 tip.
        widest: f32 = 0.65, 0.1..=0.95, "of the length";
        /// Width at the foot.
        foot: f32 = 0.25, 0.02..=1.0, "of the width";
        /// How pointed the tip is: 0 round, 1 drawn out.
        point: f32 = 0.0, 0.0..=1.0, "";
        /// Depth of a notch in the tip.
        notch: f32 = 0.0, 0.0..=0.4, "of the length";
        /// Teeth along the tip.
        teeth: u32 = 0, 0..=60, "";
        /// Their depth.
        tooth_depth: f32 = 0.06, 0.0..=0.4, "of the length";
    }
}

impl PetalOutline {
    /// The outline between this one (share 0) and another (share 1); teeth are the nearer one's.
    #[must_use]
    pub fn blend(&self, other: &Self, share: f32) -> Self {
        let mix = |a: f32, b: f32| a + (b - a) * share;
        Self {
            width: mix(self.width, other.width),
            widest: mix(self.widest, other.widest),
            foot: mix(self.foot, other.foot),
            point: mix(self.point, other.point),
            notch: mix(self.notch, other.notch),
            teeth: if share < 0.5 { self.teeth } else { other.teeth },
            tooth_depth: mix(self.tooth_depth, other.tooth_depth),
        }
    }

    /// Half the width at a share of the way from foot to tip, share of the length.
    pub fn half_width(&self, t: f32) -> f32 {
        let (t, half) = (t.clamp(0.0, 1.0), 0.5 * self.width);
        if t <= self.widest {
            return half * (self.foot + (1.0 - self.foot) * (FRAC_PI_2 * t / self.widest).sin());
        }
        let x = (t - self.widest) / (1.0 - self.widest);
        half * (1.0 - x * x).max(0.0).powf(0.5 + (POINTED - 0.5) * self.point)
    }

    /// The template of such petals, of length 1.
    pub fn template(&self) -> Template {
        Template::new(self.points(), Vec::new(), 1.0, Detail::Moderate)
    }

    /// The outline, foot at the origin and tip at v = 1, counter-clockwise.
    pub fn points(&self) -> Vec<Vec2> {
        let right = self.right_side();
        let left =
            right.iter().rev().filter(|point| point.x > 1e-4).map(|point| Vec2::new(-point.x, point.y));
        let outline: Vec<Vec2> = right.iter().copied().chain(left).collect();
        if self.teeth == 0 { outline } else { self.toothed(&outline) }
    }

    fn right_side(&self) -> Vec<Vec2> {
        let below = (0..BELOW).map(|k| self.widest * k as f32 / BELOW as f32);
        let beyond = (0..=BEYOND).map(|k| {
            let x = (FRAC_PI_2 * k as f32 / BEYOND as f32).sin();
            self.widest + (1.0 - self.widest) * x
        });
        below.chain(beyond).map(|t| self.notched(Vec2::new(self.half_width(t), t))).collect()
    }

    /// A point of the margin, lowered where the notch is.
    fn notched(&self, point: Vec2) -> Vec2 {
        if point.y <= self.widest || self.notch == 0.0 {
            return point;
        }
        let off = (point.x / (0.25 * self.width)).min(1.0);
        Vec2::new(point.x, point.y - self.notch * (1.0 - off) * (1.0 - off))
    }

    /// The outline with teeth beyond the widest place.
    fn toothed(&self, outline: &[Vec2]) -> Vec<Vec2> {
        let (first, last) = (BELOW, outline.len() - BELOW);
        let (base, rim) = (&outline[..=first], &outline[first..last.max(first + 2)]);
        let middle = Vec2::new(0.0, 0.5 * self.widest);
        let steps = 2 * self.teeth as usize;
        let arcs = polyline::arc_lengths(rim.iter().copied());
        let whole = arcs.last().copied().unwrap_or(0.0);
        let along = |share: f32| polyline::interpolate(rim, polyline::locate(&arcs, share * whole));
        let margin = (1..steps).map(|k| {
            let point = along(k as f32 / steps as f32);
            let deep = if k % 2 == 0 { self.tooth_depth } else { 0.0 };
            point + (middle - point).normalize_or_zero() * deep
        });
        base.iter().copied().chain(margin).chain(outline[last - 1..].iter().copied()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(outline: &PetalOutline) -> Template {
        let template = outline.template();
        assert_eq!(template.check_invariants(), Ok(()));
        template
    }

    #[test]
    fn width_and_widest_place_are_those_asked_for() {
        let template = check(&PetalOutline { width: 0.8, widest: 0.7, ..PetalOutline::default() });
        let widest = template.outline().iter().max_by(|a, b| a.x.total_cmp(&b.x)).unwrap();
        assert!((widest.x - 0.4).abs() < 1e-3 && (widest.y - 0.7).abs() < 1e-3);
        let tip = template.outline().iter().map(|point| point.y).fold(0.0, f32::max);
        assert!((tip - 1.0).abs() < 1e-6);
    }

    #[test]
    fn every_kind_of_tip_is_a_sound_outline() {
        for point in [0.0, 0.5, 1.0] {
            for notch in [0.0, 0.1, 0.4] {
                for teeth in [0, 1, 7, 60] {
                    for width in [0.02, 0.6, 2.0] {
                        check(&PetalOutline { point, notch, teeth, width, ..PetalOutline::default() });
                    }
                }
            }
        }
    }

    #[test]
    fn a_notch_lowers_the_middle_and_teeth_are_counted() {
        let notched = PetalOutline { notch: 0.2, ..PetalOutline::default() };
        let middle =
            notched.points().into_iter().filter(|p| p.y > 0.5).min_by(|a, b| a.x.abs().total_cmp(&b.x.abs()));
        assert!((middle.unwrap().y - 0.8).abs() < 1e-3);
        let toothed = PetalOutline { teeth: 9, tooth_depth: 0.1, ..PetalOutline::default() }.points();
        let from_middle: Vec<f32> = toothed.iter().map(|p| p.distance(Vec2::new(0.0, 0.325))).collect();
        let tops = from_middle.windows(3).filter(|w| w[0] < w[1] - 0.03 && w[2] < w[1] - 0.03).count();
        assert!((8..=10).contains(&tops), "{tops}");
    }
}
