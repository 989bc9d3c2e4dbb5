//! What a branch drawn in space grows on: the wood that is nearest to where it begins, or the ground.
//!
//! Nothing hangs in the air. Which wood it is is found anew in every build and not kept in the drawing, so a branch stays on
//! its plant when wood goes or is moved on the sheet. Limits: of two branches at one place the one that was there first.

use crate::geom::polyline;
use crate::plant::Branch;
use glam::Vec3;

/// How far above the ground a trunk may begin, as a share of the height of what stands there.
pub const GROUND_REACH: f32 = 0.02;

/// A place on the axis of a branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foothold {
    /// Index of the branch.
    pub branch: usize,
    /// The place, metres.
    pub place: Vec3,
    /// Radius of the branch there, metres.
    pub radius: f32,
}

/// The boxes of branches, so that what is far is passed over.
#[derive(Clone, Debug, Default)]
pub(super) struct Boxes(Vec<(Vec3, Vec3)>);

impl Boxes {
    /// Of these branches.
    pub(super) fn of(branches: &[Branch]) -> Self {
        let mut boxes = Self(Vec::with_capacity(branches.len()));
        branches.iter().for_each(|branch| boxes.push(branch));
        boxes
    }

    /// One more branch.
    pub(super) fn push(&mut self, branch: &Branch) {
        let around = |(low, high): (Vec3, Vec3), point: &Vec3| (low.min(*point), high.max(*point));
        self.0.push(branch.points.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), around));
    }

    /// The place on the axes of these branches that is nearest to a point; none without branches.
    pub(super) fn nearest(&self, branches: &[Branch], point: Vec3) -> Option<Foothold> {
        let mut best: Option<(f32, Foothold)> = None;
        for (index, (branch, (low, high))) in branches.iter().zip(&self.0).enumerate() {
            let away = best.as_ref().map_or(f32::INFINITY, |(away, _)| *away);
            if point.distance_squared(point.clamp(*low, *high)) >= away {
                continue;
            }
            for (i, ends) in branch.points.windows(2).enumerate() {
                let share = polyline::nearest_share(ends[0], ends[1], point, Vec3::dot);
                let place = ends[0].lerp(ends[1], share);
                let is_nearer = best.as_ref().is_none_or(|(away, _)| place.distance_squared(point) < *away);
                if is_nearer {
                    let radius = branch.radii[i] + (branch.radii[i + 1] - branch.radii[i]) * share;
                    let foothold = Foothold { branch: index, place, radius };
                    best = Some((place.distance_squared(point), foothold));
                }
            }
        }
        best.map(|(_, foothold)| foothold)
    }
}

impl Foothold {
    /// What a branch that begins at a point grows on; none for a trunk of its own, which begins at the ground and outside of
    /// wood.
    pub(super) fn of(boxes: &Boxes, branches: &[Branch], begin: Vec3) -> Option<Self> {
        let nearest = boxes.nearest(branches, begin)?;
        let height = branches.iter().flat_map(|b| &b.points).map(|point| point.y).fold(0.0, f32::max);
        let is_at_ground = begin.y <= GROUND_REACH * height;
        let is_outside = nearest.place.distance(begin) > 2.0 * nearest.radius;
        (!(is_at_ground && is_outside)).then_some(nearest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Origin, Role, WoodPart};

    fn branch(points: Vec<Vec3>) -> Branch {
        let radii = vec![0.02; points.len()];
        let role = Role::of(WoodPart::Stem);
        Branch { origin: Origin::Generated, parent: None, level: 0, points, radii, role }
    }

    #[test]
    fn it_is_the_nearest_wood_unless_it_begins_on_the_ground() {
        let upright = |x: f32| branch(vec![Vec3::X * x, Vec3::new(x, 1.0, 0.0)]);
        let branches = [upright(0.0), upright(1.0)];
        let boxes = Boxes::of(&branches);
        let of = |x: f32, y: f32| Foothold::of(&boxes, &branches, Vec3::new(x, y, 0.1));
        let found = of(0.7, 0.5).unwrap();
        assert_eq!((found.branch, found.place, found.radius), (1, Vec3::new(1.0, 0.5, 0.0), 0.02));
        assert_eq!(of(0.2, 3.0).unwrap().place, Vec3::Y, "over its end");
        assert_eq!(of(0.5, 0.01), None, "a trunk of its own");
        let on_trunk = Foothold::of(&boxes, &branches, Vec3::new(0.01, 0.0, 0.0)).unwrap();
        assert_eq!(on_trunk.branch, 0, "at the foot of a trunk");
        assert_eq!(Foothold::of(&Boxes::default(), &[], Vec3::Y), None);
    }
}
