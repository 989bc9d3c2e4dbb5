//! The junction of a branch and its parent: the bark that makers of plants keep free is the bark that surfaces use.
//!
//! Where a branch leaves its parent it swells to a collar, which takes a stretch of the parent's bark along it and an
//! angle around it: its [`Footprint`]. A maker that places branches gives each a footprint of its own; the model cuts the
//! window for the branch into it. Both read the numbers of this file, so neither has to know the other. So they do for the
//! distance between branches that have no junction.

use glam::Vec3;

/// Radius of a branch's collar, in radii of the branch.
pub const COLLAR: f32 = 1.25;
/// Radius of what a maker keeps free for a collar, in radii of the branch: a little more, because surfaces follow the
/// skeletons of branches only roughly.
pub const KEPT_FREE: f32 = 1.35;
/// Least angle between a parent and the foot of a branch, radians: 54°. Surfaces bend branches that leave by less
/// outward, as collars of real wood are; else their windows would be long slits.
pub const LEAST_ANGLE_RAD: f32 = 0.95;
/// Least sine of the angle between a branch and its parent that lengths along the parent are reckoned with: less than
/// that of [`LEAST_ANGLE_RAD`], for the parent may bend.
pub const LEAST_SINE: f32 = 0.4;
/// Least distance that makers leave between the axes of two branches that are not joined, in the sum of their radii:
/// surfaces are a little wider than the wood in places.
pub const APART: f32 = 1.2;
/// Angle around the parent that a maker leaves between branches beside each other, radians: room for the corners of
/// surfaces with four sides.
pub const BESIDE_RAD: f32 = 0.9;
/// Two branches at this share of the distance from which they are clear of each other count as clear.
const TOUCHING: f32 = 0.99;

const _: () = assert!(KEPT_FREE >= COLLAR, "what is kept free holds a collar");

/// The bark that a branch takes on its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// Length of the parent before its middle, metres.
    pub along: f32,
    /// Unit direction from the parent's axis to its middle, square to that axis.
    pub outward: Vec3,
    /// Half of its length along the parent, metres.
    pub half_length: f32,
    /// Half of the angle that it covers around the parent, radians.
    pub half_angle: f32,
}

impl Footprint {
    /// The angle around the parent between the middles of two, radians, 0 to π.
    pub fn angle_to(&self, other: &Self) -> f32 {
        self.outward.dot(other.outward).clamp(-1.0, 1.0).acos()
    }

    /// The distance along the parent from which two that lie beside each other are clear, metres.
    fn clear(&self, other: &Self) -> f32 {
        self.half_length + other.half_length
    }

    /// Whether this one, moved to a place along the parent, is clear of another that lies beside it.
    pub fn is_clear_at(&self, along: f32, other: &Self) -> bool {
        (along - other.along).abs() >= TOUCHING * self.clear(other)
    }

    /// The nearest places along the parent below and above another at which this one is clear of it, metres.
    pub fn next_to(&self, other: &Self) -> [f32; 2] {
        [other.along - self.clear(other), other.along + self.clear(other)]
    }
}

/// Half of the angle that something of a radius covers around a parent of a radius, both in metres; radians. `widest` is
/// the largest sine of it, at most 1.
pub fn half_angle(radius: f32, of_parent: f32, widest: f32) -> f32 {
    (radius / of_parent.max(f32::MIN_POSITIVE)).min(widest).asin()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_reckoned_for_angles_that_surfaces_leave() {
        assert!(LEAST_SINE < LEAST_ANGLE_RAD.sin());
    }

    #[test]
    fn footprints_next_to_each_other_are_clear() {
        let print = |along, half_length| Footprint {
            along,
            outward: Vec3::X,
            half_length,
            half_angle: half_angle(1.0, 2.0, 1.0),
        };
        let (own, other) = (print(1.0, 0.25), print(1.5, 0.5));
        assert!(!own.is_clear_at(own.along, &other));
        assert_eq!(own.next_to(&other), [0.75, 2.25]);
        assert!(own.next_to(&other).iter().all(|along| own.is_clear_at(*along, &other)));
        assert_eq!(own.angle_to(&other), 0.0);
        assert!((own.half_angle.sin() - 0.5).abs() < 1e-6);
    }
}
