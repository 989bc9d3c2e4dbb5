//! Outlines of leaves and leaflets from a few numbers: width, where it is widest, how it ends at foot and tip, teeth.
//!
//! The half width rises and falls as powers of a sine about the widest place. Teeth point toward the tip, as those of a rose do.

use glam::Vec2;
use std::f32::consts::FRAC_PI_2;

/// Points on each side of a margin without teeth.
const SIDE_POINTS: usize = 12;
/// Power of the sine at a rounded and at a drawn-out end.
const ROUND: f32 = 0.62;
const DRAWN_OUT: f32 = 1.6;

crate::parameters! {
    /// Outline of a leaf.
    pub struct LeafOutline {
        /// Greatest width.
        width: f32 = 0.42, 0.01..=2.0, "of the length";
        /// Where it is widest: 0 foot, 1 tip.
        widest: f32 = 0.4, 0.1..=0.9, "of the length";
        /// How drawn out the foot is: 0 round, 1 like a wedge.
        wedge: f32 = 0.4, 0.0..=1.0, "";
        /// How drawn out the tip is: 0 round, 1 pointed.
        point: f32 = 0.6, 0.0..=1.0, "";
        /// Teeth on each side.
        teeth: u32 = 0, 0..=60, "";
        /// Their depth.
        tooth_depth: f32 = 0.02, 0.0..=0.3, "of the length";
    }
}

impl LeafOutline {
    /// Half the width at a share of the way from foot to tip, share of the length.
    pub fn half_width(&self, t: f32) -> f32 {
        let (x, drawn_out) = if t <= self.widest {
            (t / self.widest, self.wedge)
        } else {
            ((1.0 - t) / (1.0 - self.widest), self.point)
        };
        let power = ROUND + (DRAWN_OUT - ROUND) * drawn_out;
        0.5 * self.width * (FRAC_PI_2 * x.clamp(0.0, 1.0)).sin().powf(power)
    }

    /// The outline, foot at the origin and tip at v = 1, counter-clockwise.
    pub fn points(&self) -> Vec<Vec2> {
        let right: Vec<Vec2> = if self.teeth == 0 { self.smooth_side() } else { self.toothed_side() };
        let left = right.iter().rev().map(|point| Vec2::new(-point.x, point.y));
        [Vec2::ZERO].into_iter().chain(right.iter().copied()).chain([Vec2::Y]).chain(left).collect()
    }

    fn smooth_side(&self) -> Vec<Vec2> {
        let at = |k: usize| {
            // Closer together at the ends, where the margin turns.
            let t = 0.5 - 0.5 * (std::f32::consts::PI * k as f32 / (SIDE_POINTS + 1) as f32).cos();
            Vec2::new(self.half_width(t), t)
        };
        (1..=SIDE_POINTS).map(at).collect()
    }

    fn toothed_side(&self) -> Vec<Vec2> {
        let step = 1.0 / (self.teeth as f32 + 1.0);
        let tooth = |k: u32| {
            let (from, to) = (step * (k as f32 + 0.35), step * (k as f32 + 1.0));
            let half = |t: f32| self.half_width(t);
            let deep = self.tooth_depth.min(0.6 * half(to));
            [
                Vec2::new((half(from) - deep).max(0.2 * half(from)), from),
                Vec2::new(half(to), to + 0.3 * step * (1.0 - to)),
            ]
        };
        (0..self.teeth).flat_map(tooth).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Detail, Template};

    #[test]
    fn every_outline_is_sound() {
        for teeth in [0, 1, 7, 14, 60] {
            for (wedge, point) in [(0.0, 0.0), (1.0, 1.0), (0.2, 0.8)] {
                for width in [0.01, 0.4, 2.0] {
                    let outline = LeafOutline { teeth, wedge, point, width, ..LeafOutline::default() };
                    let template = Template::new(outline.points(), Vec::new(), 1.0, Detail::Moderate);
                    assert_eq!(template.check_invariants(), Ok(()), "{outline:?}");
                }
            }
        }
    }

    #[test]
    fn it_is_as_wide_as_asked_for_where_asked_for() {
        let outline = LeafOutline { width: 0.6, widest: 0.3, ..LeafOutline::default() };
        assert!((outline.half_width(0.3) - 0.3).abs() < 1e-6);
        assert!(outline.half_width(0.1) < 0.3 && outline.half_width(0.9) < 0.15);
    }

    #[test]
    fn teeth_are_counted() {
        let outline = LeafOutline { teeth: 9, tooth_depth: 0.03, ..LeafOutline::default() };
        let right: Vec<Vec2> = outline.points().into_iter().filter(|p| p.x > 0.0).collect();
        let deep: Vec<f32> = right.iter().map(|p| outline.half_width(p.y) - p.x).collect();
        assert_eq!(right.len(), 18);
        assert!(deep.chunks(2).all(|pair| pair[0] > pair[1] + 0.005), "{deep:?}");
    }
}
