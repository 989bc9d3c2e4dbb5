//! Branches grafted onto other ones by the artist: each is set there with all that grows on it.
//!
//! A graft comes before all other poses. The branch, its twigs, leaves and flowers are moved as one piece, so that it leaves the
//! new parent under the angle at which it left the old one; a trunk keeps its direction. From then on it is a branch of that
//! parent, moves with it, and is turned, bent and slid along it. It becomes thinner where the new parent is too thin for it, with
//! all that it carries.
//!
//! The order of the poses does not matter: grafts are made in the order of the plant's branches. One whose branch is not there,
//! that would stand on itself, or that carries the other stems of a bush, stays where it grew.
//!
//! Limits: drawn wood is grafted onto drawn wood alone, because growth comes later; a branch that at some age runs on in the line of
//! another stays in that.

use super::carried::{move_buds, move_organs};
use super::part_names::PartNames;
use super::slide::{Place, Slide};
use super::thickness::NARROWER;
use crate::geom::polyline;
use crate::plant::{Branch, Continued, FlowerBuds, Motion, Plant};
use crate::sketch::part_poses::Graft;
use crate::sketch::{PartName, PartPose};
use glam::Vec3;
use std::collections::HashMap;

/// Where a part is to be grafted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct GraftPlace {
    /// The branch.
    pub(super) branch: usize,
    /// The place on its line.
    pub(super) place: Place,
}

/// The branches of a plant by their names, and those that run on in the line of others.
pub(super) struct GraftPlaces {
    branches: HashMap<PartName, (usize, f32)>,
}

impl GraftPlaces {
    pub(super) fn new(plant: &Plant, names: &PartNames, continued: &[Continued]) -> Self {
        let named = plant.branches.iter().enumerate();
        let named = named.filter_map(|(index, branch)| Some((names.of(branch.origin)?, (index, 0.0))));
        let within = continued.iter().map(|Continued { name, branch, from }| {
            let arc = polyline::nearest(&plant.branches[*branch].points, *from).map_or(0.0, |(_, arc)| arc);
            (PartName::Grown(name.0), (*branch, arc))
        });
        // What is a branch of its own is meant before one that runs on in another.
        Self { branches: within.chain(named).collect() }
    }

    /// Where a graft comes to; none where the plant has no such branch.
    pub(super) fn find(&self, branches: &[Branch], graft: Graft) -> Option<GraftPlace> {
        let &(branch, from) = self.branches.get(&graft.onto)?;
        let place = Place::at(&branches[branch], |length| from + (length - from) * graft.at)?;
        Some(GraftPlace { branch, place })
    }
}

/// Sets grafted branches onto their new parents, which then stand before them; says how many have none.
pub(super) fn graft(
    (plant, buds): (&mut Plant, &mut FlowerBuds),
    continued: &mut [Continued],
    (names, poses): (&PartNames, &[PartPose]),
) -> usize {
    let grafts: HashMap<PartName, Graft> =
        poses.iter().filter_map(|pose| Some((pose.part, pose.graft?))).collect();
    if grafts.is_empty() {
        return 0;
    }
    let mut resting = 0;
    let places = GraftPlaces::new(plant, names, continued);
    for index in 0..plant.branches.len() {
        let name = names.of(plant.branches[index].origin);
        let Some(graft) = name.and_then(|name| grafts.get(&name)) else { continue };
        let to = places.find(&plant.branches, *graft);
        match to.filter(|to| can_stand(&plant.branches, index, to.branch)) {
            Some(to) => set(plant, buds, continued, index, &to),
            None => resting += 1,
        }
    }
    let places = plant.put_parents_first(buds);
    continued.iter_mut().for_each(|continued| continued.branch = places[continued.branch]);
    debug_assert_eq!(plant.check_invariants(), Ok(()));
    resting
}

/// Whether a branch can be set onto another one, which it does not carry itself.
fn can_stand(branches: &[Branch], index: usize, onto: usize) -> bool {
    let carries_stems = branches.iter().any(|stem| stem.is_basal_stem() && stem.parent == Some(index));
    !carries_stems && !is_carried(branches, onto, index)
}

/// Whether one branch is another or grows on it; parents may stand behind what they carry.
fn is_carried(branches: &[Branch], branch: usize, by: usize) -> bool {
    let mut down = std::iter::successors(Some(branch), |below| branches[*below].parent);
    down.any(|below| below == by)
}

/// Moves a branch with all that grows on it to its place on another one.
fn set(plant: &mut Plant, buds: &mut FlowerBuds, continued: &mut [Continued], index: usize, to: &GraftPlace) {
    let branches = &plant.branches;
    let root = &branches[index];
    let (Some(base), Some(radius)) = (root.points.first().copied(), root.radii.first().copied()) else {
        return;
    };
    let from = root.parent.filter(|_| !root.is_basal_stem());
    let from = from.and_then(|parent| Place::nearest(&branches[parent], base));
    let slide = Slide::between(from, to.place, base);
    let motion = Motion { turn: slide.turn, from: base, to: slide.to, size: 1.0 };
    let thinner = (NARROWER * to.place.radius / radius.max(f32::MIN_POSITIVE)).min(1.0);
    let above = branches[to.branch].level + 1;
    let level = root.level;
    let goes_along: Vec<bool> = (0..branches.len()).map(|b| is_carried(branches, b, index)).collect();
    let motion_on = |branch: usize, _: Vec3| goes_along[branch].then_some(motion);
    move_organs(plant, motion_on);
    move_buds(buds, motion_on);
    for continued in continued.iter_mut().filter(|continued| goes_along[continued.branch]) {
        continued.from = motion.point(continued.from);
    }
    for (branch, _) in plant.branches.iter_mut().zip(&goes_along).filter(|(_, goes)| **goes) {
        branch.points.iter_mut().for_each(|point| *point = motion.point(*point));
        branch.radii.iter_mut().for_each(|radius| *radius *= thinner);
        branch.level = branch.level - level + above;
    }
    plant.branches[index].parent = Some(to.branch);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Organ, Origin, Provenance, Role, WoodPart};

    fn branch(origin: Origin, parent: Option<usize>, level: u32, ends: [Vec3; 2]) -> Branch {
        let points: Vec<Vec3> = (0..=10).map(|k| ends[0].lerp(ends[1], k as f32 / 10.0)).collect();
        let radii = vec![0.02 / (level + 1) as f32; points.len()];
        Branch { origin, parent, level, points, radii, role: Role::of(WoodPart::Stem) }
    }

    /// A trunk with a bough to the right that has a twig, and a trunk beside it with a bough to the left.
    fn trees() -> (Plant, Provenance) {
        let mut provenance = Provenance::default();
        let [one, bough, twig, other, left] = [1, 2, 3, 4, 5].map(|stroke| provenance.record(Some(stroke)));
        let (middle, beside) = (Vec3::Y * 0.5, Vec3::X * 2.0);
        let fork = middle + Vec3::X * 0.2;
        let branches = vec![
            branch(one, None, 0, [Vec3::ZERO, Vec3::Y]),
            branch(bough, Some(0), 1, [middle, middle + Vec3::X * 0.4]),
            branch(twig, Some(1), 2, [fork, fork + Vec3::Y * 0.2]),
            branch(other, None, 0, [beside, beside + Vec3::Y]),
            branch(left, Some(3), 1, [beside + middle, beside + middle - Vec3::X * 0.4]),
        ];
        (Plant { branches, ..Plant::default() }, provenance)
    }

    /// The plant with these grafts, of a stroke onto another, and how many rest.
    fn grafted(grafts: &[(u64, u64, f32)]) -> (Plant, usize) {
        let (mut plant, provenance) = trees();
        let pose = |&(stroke, onto, at): &(u64, u64, f32)| {
            let graft = Some(Graft { onto: PartName::Stroke(onto), at });
            PartPose { graft, ..PartPose::still(PartName::Stroke(stroke)) }
        };
        let poses: Vec<PartPose> = grafts.iter().map(pose).collect();
        let names = PartNames::new(&provenance);
        let resting = graft((&mut plant, &mut FlowerBuds::default()), &mut [], (&names, &poses));
        plant.check_invariants().unwrap();
        (plant, resting)
    }

    #[test]
    fn a_bough_stands_on_the_other_trunk_with_its_twig_under_the_same_angle() {
        let (plant, resting) = grafted(&[(2, 4, 0.75)]);
        assert_eq!(resting, 0);
        let parents: Vec<Option<usize>> = plant.branches.iter().map(|branch| branch.parent).collect();
        assert_eq!(parents, [None, None, Some(1), Some(2), Some(1)], "behind its new parent");
        let foot = Vec3::new(2.0, 0.75, 0.0);
        let ends = [2, 3].map(|b: usize| *plant.branches[b].points.last().unwrap());
        assert!(ends[0].distance(foot + Vec3::X * 0.4) < 1e-5, "{}", ends[0]);
        assert!(ends[1].distance(foot + Vec3::new(0.2, 0.2, 0.0)) < 1e-5, "{}", ends[1]);
    }

    #[test]
    fn a_trunk_on_a_thin_bough_becomes_thinner_and_keeps_its_direction() {
        let (plant, _) = grafted(&[(4, 2, 0.5)]);
        let set = plant.branches.iter().find(|branch| branch.level == 2 && branch.radii.len() == 11);
        assert!(set.is_some());
        let trunk = &plant.branches[3];
        assert_eq!((trunk.parent, trunk.level), (Some(1), 2));
        assert!((trunk.radii[0] - NARROWER * 0.01).abs() < 1e-6);
        assert!(trunk.points[10].distance(Vec3::new(0.2, 1.5, 0.0)) < 1e-5, "{}", trunk.points[10]);
        assert_eq!(plant.branches[4].level, 3, "its bough goes along");
    }

    #[test]
    fn the_order_of_poses_does_not_matter() {
        let grafts = [(2, 4, 0.75), (5, 3, 0.5)];
        assert_eq!(grafted(&grafts), grafted(&[grafts[1], grafts[0]]));
    }

    #[test]
    fn what_cannot_be_grafted_stays() {
        let (still, _) = trees();
        for (graft, resting) in [((2, 3, 0.5), 1), ((1, 3, 0.5), 1), ((2, 9, 0.5), 1), ((9, 1, 0.5), 0)] {
            assert_eq!(grafted(&[graft]), (still.clone(), resting), "{graft:?}");
        }
        // Each onto the other: the first is made, and the other would stand on itself.
        let (plant, resting) = grafted(&[(1, 4, 0.5), (4, 1, 0.5)]);
        assert_eq!(resting, 1);
        assert_eq!(plant.branches.iter().filter(|branch| branch.parent.is_none()).count(), 1);
    }

    #[test]
    fn organs_go_along() {
        let (mut plant, provenance) = trees();
        let head = Vec3::new(0.3, 0.55, 0.0);
        let shape = crate::plant::Shape::Filament {
            points: vec![head, head + Vec3::Y * 0.01],
            radius: 0.001,
            head: glam::Vec2::splat(0.002),
        };
        let role = Role::of(crate::plant::OrganPart::Stamen);
        plant.organs.push(Organ { origin: Origin::Generated, branch: Some(1), flower: None, shape, role });
        let names = PartNames::new(&provenance);
        let pose = PartPose {
            graft: Some(Graft { onto: PartName::Stroke(4), at: 0.5 }),
            ..PartPose::still(PartName::Stroke(2))
        };
        graft((&mut plant, &mut FlowerBuds::default()), &mut [], (&names, &[pose]));
        assert!(plant.organs[0].base().distance(head + Vec3::X * 2.0) < 1e-5);
        assert_eq!(plant.organs[0].branch, Some(2));
    }
}
