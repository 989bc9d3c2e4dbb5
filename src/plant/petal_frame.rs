//! The directions and the length of a petal in space: what its control points are moved along and in shares of.
//!
//! A petal that was drawn keeps its outline in the plane of the drawing, which is not that of the petal: one that points at the
//! viewer is short there. So its directions come from its cone: along from base to tip, the face toward the flower's axis at
//! the middle of the petal, across to the right of both, as the face is seen. Any other blade has those of its own plane.

use super::{Cone, ResolvedBlade, RestSurface};
use glam::{Vec2, Vec3};

/// Directions and length of a petal. The directions are of unit length and at right angles, `across × along = face`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PetalFrame {
    /// To the right of the axis as the face is seen.
    pub across: Vec3,
    /// From base to tip.
    pub along: Vec3,
    /// Away from the face.
    pub face: Vec3,
    /// From base to tip, metres.
    pub length: f32,
}

impl PetalFrame {
    /// That of a blade on its rest surface; of a shaped one before it was shaped.
    pub fn of(blade: &ResolvedBlade<'_>) -> Self {
        let plane = Self::of_plane(blade);
        let blade = blade.unshaped();
        let RestSurface::Cone { cone, .. } = &blade.rest else { return plane };
        let base = blade.at_rest(Vec2::ZERO);
        let chord = blade.tip_at_rest() - base;
        let along = chord.normalize_or(plane.along);
        let middle = blade.at_rest(Vec2::new(0.0, 0.5 * blade.template.length()));
        let inward = inward(cone, middle).reject_from_normalized(along);
        let face =
            inward.try_normalize().unwrap_or_else(|| plane.across.cross(along).normalize_or(plane.face));
        Self { across: along.cross(face), along, face, length: chord.length() }
    }

    fn of_plane(blade: &ResolvedBlade<'_>) -> Self {
        let along = blade.v.normalize_or(Vec3::Y);
        let across = blade.u.reject_from_normalized(along).normalize_or(along.any_orthonormal_vector());
        let length = blade.template.length() * blade.v.length();
        Self { across, along, face: across.cross(along), length }
    }

    /// The way in the world that an offset means: across, along and toward the face, shares of the length.
    pub fn way(&self, offset: Vec3) -> Vec3 {
        (self.across * offset.x + self.along * offset.y + self.face * offset.z) * self.length
    }

    /// The offset that a way in the world is.
    pub fn offset(&self, way: Vec3) -> Vec3 {
        let shares = Vec3::new(way.dot(self.across), way.dot(self.along), way.dot(self.face));
        shares / self.length.max(f32::MIN_POSITIVE)
    }
}

/// The direction toward the inner side of a cone at a place on it.
fn inward(cone: &Cone, at: Vec3) -> Vec3 {
    let outward = (at - cone.apex).reject_from_normalized(cone.axis).normalize_or_zero();
    cone.axis * cone.opening_rad.sin() - outward * cone.opening_rad.cos()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Blade, BladeForm, Detail, Template};

    #[test]
    fn a_petal_on_a_cone_has_the_directions_of_its_place_there() {
        let outline = vec![Vec2::ZERO, Vec2::new(0.1, 0.3), Vec2::new(0.0, 0.6), Vec2::new(-0.1, 0.3)];
        let template = Template::new(outline, Vec::new(), 0.6, Detail::Full);
        // A flower that looks up, whose petals rise by 30° from the level: this one comes toward the viewer.
        let cone = Cone { apex: Vec3::ZERO, axis: Vec3::Y, opening_rad: 60f32.to_radians(), height: 1.0 };
        let rest = RestSurface::Cone { cone, hint: 1.0, sight: Vec3::Z };
        let (base, form) = (Vec3::ZERO, BladeForm::default());
        let blade = Blade { template: &template, base, u: Vec3::X, v: Vec3::Y, rest, form };
        let frame = PetalFrame::of(&blade);
        let steep = 60f32.to_radians();
        assert!(frame.along.distance(Vec3::new(0.0, steep.cos(), steep.sin())) < 1e-4, "{frame:?}");
        assert!(frame.face.distance(Vec3::new(0.0, steep.sin(), -steep.cos())) < 1e-4, "{frame:?}");
        assert!(frame.across.distance(frame.along.cross(frame.face)) < 1e-6);
        assert!((frame.length - 1.2).abs() < 1e-4, "longer than in the drawing: {}", frame.length);
        let offset = Vec3::new(0.3, -0.2, 0.1);
        assert!(frame.offset(frame.way(offset)).distance(offset) < 1e-6);
        let plane = PetalFrame::of(&Blade { rest: RestSurface::Plane, ..blade });
        assert_eq!((plane.across, plane.along, plane.face), (Vec3::X, Vec3::Y, Vec3::Z));
    }
}
