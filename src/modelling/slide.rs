//! What stands on a branch moved along it, as a leaf is that slides along its stem, or to another branch.
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
        Some(Self::between(Place::nearest(on, base), Place::nearest(on, base + by)?, base))
    }

    /// From a place on what something with its base there stands on to another; from the ground it keeps its direction.
    pub(super) fn between(from: Option<Place>, to: Place, base: Vec3) -> Self {
        let Some(from) = from else { return Self { to: to.at, turn: Quat::IDENTITY, thickness: 1.0 } };
        let turn = Quat::from_rotation_arc(from.way, to.way);
        let thickness = to.radius / from.radius.max(f32::MIN_POSITIVE);
        Self { to: to.at + turn * ((base - from.at) * thickness), turn, thickness }
    }
}

/// A place on the axis of a branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// Where it is, metres.
    pub(super) at: Vec3,
    /// Unit direction of the axis there.
    way: Vec3,
    /// The branch's radius there, metres.
    pub(super) radius: f32,
}

impl Place {
    /// The nearest to a point; none on a branch without length.
    pub(super) fn nearest(on: &Branch, to: Vec3) -> Option<Self> {
        let (_, arc) = polyline::nearest(&on.points, to)?;
        Self::at(on, |_| arc)
    }

    /// That so far from the base as `arc` says of the branch's length, metres; none on a branch without length.
    pub(super) fn at(on: &Branch, arc: impl FnOnce(f32) -> f32) -> Option<Self> {
        let arcs = polyline::arc_lengths(on.points.iter().copied());
        let (i, share) = polyline::locate(&arcs, arc(*arcs.last()?));
        let next = i + 1;
        let way = (*on.points.get(next)? - on.points[i]).try_normalize()?;
        let radius = on.radii[i] + (on.radii[next] - on.radii[i]) * share;
        Some(Self { at: polyline::interpolate(&on.points, (i, share)), way, radius })
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
