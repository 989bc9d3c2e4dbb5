//! Where a point of a blade's plane lies in the blade's picture, and back.
//!
//! v runs along the axis over the outline's whole height (base 0, tip 1 unless lobes reach below the base), u across with ½
//! on the middle line, scaled by the larger half width. Meshes have their UV from here, and pictures that are made for one
//! blade, such as those from photographs, are painted by the way back, so both agree.

use super::flat::{self, BladeMeshParams, FlatBlade, FlatScratch};
use super::midline::Midline;
use crate::plant::Template;
use glam::Vec2;

/// How the picture of a blade lies in the blade's plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BladeUv {
    /// Metres of one blade size.
    size: f32,
    /// Lowest v of the outline, metres.
    low: f32,
    /// Pictures in a metre of height.
    tall: f32,
    /// Pictures in a blade size of width.
    wide: f32,
    middle: Midline,
}

impl BladeUv {
    /// That of a blade with this outline, in full detail and without waves along its margin; `None` for an outline without
    /// area.
    pub fn new(template: &Template, params: &BladeMeshParams) -> Option<Self> {
        Some(Self::of(&flat::flatten(template, None, params, &mut FlatScratch::default())?))
    }

    pub(super) fn of(flat: &FlatBlade) -> Self {
        let sections = &flat.sections;
        Self {
            size: flat.size,
            low: sections.low * flat.size,
            tall: 1.0 / (sections.high - sections.low) / flat.size,
            wide: 0.5 / sections.widest,
            middle: sections.middle,
        }
    }

    /// The place in the picture of a point of the blade's plane; beside the blade, the nearest at the picture's edge.
    pub fn uv(&self, p: Vec2) -> Vec2 {
        let off_middle = p.x / self.size - self.middle.at(p.y / self.size);
        Vec2::new(0.5 + off_middle * self.wide, (p.y - self.low) * self.tall).clamp(Vec2::ZERO, Vec2::ONE)
    }

    /// The point of the blade's plane that is seen at a place of the picture.
    pub fn point(&self, uv: Vec2) -> Vec2 {
        let y = self.low + uv.y / self.tall;
        Vec2::new((self.middle.at(y / self.size) + (uv.x - 0.5) / self.wide) * self.size, y)
    }

    /// Width and height of the picture in the blade's plane.
    pub fn extent(&self) -> Vec2 {
        Vec2::new(self.size / self.wide, 1.0 / self.tall)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::Detail;

    #[test]
    fn points_come_back_from_the_picture_of_a_bowed_blade() {
        let bow = |t: f32| 0.2 * (t * std::f32::consts::PI).sin();
        let half = |t: f32| 0.25 * (t * std::f32::consts::PI).sin();
        let right = (0..60).map(|k| k as f32 / 60.0).map(|t| Vec2::new(bow(t) + half(t), t));
        let left = (0..60).map(|k| 1.0 - k as f32 / 60.0).map(|t| Vec2::new(bow(t) - half(t), t));
        let template = Template::new(right.chain(left).collect(), Vec::new(), 1.0, Detail::Full);
        let uv = BladeUv::new(&template, &BladeMeshParams::default()).unwrap();
        for p in [(0.0, 0.0), (0.2, 0.5), (0.35, 0.4), (0.05, 0.6), (0.0, 1.0)].map(Vec2::from) {
            assert!(uv.point(uv.uv(p)).distance(p) < 1e-5, "{p} became {}", uv.point(uv.uv(p)));
        }
        assert!((uv.uv(Vec2::new(bow(0.5), 0.5)).x - 0.5).abs() < 0.02);
        assert!((uv.extent() - Vec2::new(0.52, 1.0)).abs().max_element() < 0.03, "{}", uv.extent());
    }

    #[test]
    fn nothing_has_no_picture() {
        let template = Template::new(vec![Vec2::ZERO, Vec2::Y, Vec2::Y * 2.0], Vec::new(), 1.0, Detail::Full);
        assert_eq!(BladeUv::new(&template, &BladeMeshParams::default()), None);
    }
}
