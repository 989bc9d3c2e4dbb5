//! What stands on a branch moved along it, as a leaf is that slides along its stem.
//!
//! It comes to the place of the branch that is nearest to where it is moved, keeps its angle with the branch, and the distance
//! of its base from the axis as a share of the branch's radius. What stands on nothing is moved freely, but what stands on the
//! ground stays there.

use crate::geom::polyline;
use crate::plant::Branch;
use glam::{Quat, Vec3};

/// Height above the ground up to which things stand on it, pixels of the canvas.
const ON_GROUND_PX: f32 = 4.0;

/// How something was moved along what it stands on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Slide {
    /// Where its base comes to, metres.
    pub(super) to: Vec3,
    /// What it is turned by.
    pub(super) turn: Quat,
    /// How many times as thick the branch is there.
    pub(super) thickness: f32,
}

impl Slide {
    /// The slide of something with its base there by a way, metres, pixels of the canvas of `scale` metres.
    pub(super) fn new(on: Option<&Branch>, base: Vec3, by: Vec3, scale: f32) -> Self {
        let still = Self { to: base, turn: Quat::IDENTITY, thickness: 1.0 };
        if by == Vec3::ZERO {
            return still;
        }
        match on {
            Some(on) => Self::along(on, base, by).unwrap_or(still),
            None if base.y.abs() <= ON_GROUND_PX * scale => Self { to: base + by.with_y(0.0), ..still },
            None => Self { to: base + by, ..still },
        }
    }

    fn along(on: &Branch, base: Vec3, by: Vec3) -> Option<Self> {
        let arcs = polyline::arc_lengths(on.points.iter().copied());
        let place = |at: Vec3| {
            let (_, arc) = polyline::nearest(&on.points, at)?;
            let (i, share) = polyline::locate(&arcs, arc);
            let next = (i + 1).min(on.points.len() - 1);
            let way = (on.points[next] - on.points[next - 1]).try_normalize()?;
            let radius = on.radii[i] + (on.radii[next] - on.radii[i]) * share;
            Some((polyline::interpolate(&on.points, (i, share)), way, radius))
        };
        let ((from, from_way, from_radius), (to, to_way, to_radius)) = (place(base)?, place(base + by)?);
        let turn = Quat::from_rotation_arc(from_way, to_way);
        let thickness = to_radius / from_radius.max(f32::MIN_POSITIVE);
        Some(Self { to: to + turn * ((base - from) * thickness), turn, thickness })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Origin, Role, WoodPart};

    #[test]
    fn it_follows_its_branch_around_a_corner_and_no_further_than_its_end() {
        let points = vec![Vec3::ZERO, Vec3::Y, Vec3::Y + Vec3::X];
        let (origin, role) = (Origin::Generated, Role::of(WoodPart::Stem));
        let on = Branch { origin, parent: None, level: 0, points, radii: vec![0.2, 0.2, 0.1], role };
        let base = Vec3::new(-0.2, 0.5, 0.0);
        let slide = |by: Vec3| Slide::new(Some(&on), base, by, 0.001);
        assert_eq!(slide(Vec3::ZERO).to, base);
        assert!(slide(Vec3::Y * 0.2).to.distance(Vec3::new(-0.2, 0.7, 0.0)) < 1e-6);
        // Above the horizontal part, half as far from its axis at its end.
        let end = slide(Vec3::new(9.0, 0.5, 0.0));
        assert!(end.to.distance(Vec3::new(1.0, 1.1, 0.0)) < 1e-6, "{}", end.to);
        assert!((end.turn * Vec3::Y).distance(Vec3::X) < 1e-6);
        assert!((end.thickness - 0.5).abs() < 1e-6);
    }

    #[test]
    fn a_pot_stays_on_the_ground() {
        let by = Vec3::new(0.3, 0.2, -0.1);
        assert_eq!(Slide::new(None, Vec3::ZERO, by, 0.001).to, Vec3::new(0.3, 0.0, -0.1));
        assert_eq!(Slide::new(None, Vec3::Y, by, 0.001).to, Vec3::Y + by);
    }
}
