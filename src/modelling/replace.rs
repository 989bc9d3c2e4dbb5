//! Leaves, flowers and fruits in whose place the artist put copies of others of the plant.
//!
//! The copy stands where its predecessor stood, in the direction of that, as large as what it is a copy of, and has the name of its
//! predecessor: so it is turned, moved and made larger like that, and comes back with the plant at other ages. What has a stalk brings that
//! along; what has none takes over the stalk that is there.
//!
//! Limits: petals stay in their flowers, and pots stay what they are. Copies are of what was drawn or grew, not of other copies.

use super::organ_group::OrganGroup;
use crate::plant::{Branch, Motion, Organ, OrganKind, Origin, Plant, Shape};
use crate::sketch::{PartName, PartPose};
use glam::{Mat3, Quat, Vec3};
use std::collections::HashMap;

/// Puts copies in the place of the groups whose poses say so. Says which groups are to be taken away for that, without the stalks that
/// copies stand on, and how many have found nothing to become.
pub(super) fn replace(
    plant: &mut Plant,
    groups: &[OrganGroup],
    pose_of: &HashMap<PartName, PartPose>,
) -> (Vec<OrganGroup>, usize) {
    let place_of: HashMap<PartName, usize> =
        groups.iter().enumerate().map(|(place, group)| (group.name, place)).collect();
    let (mut gone, mut resting) = (Vec::new(), 0);
    for group in groups {
        let Some(pose) = pose_of.get(&group.name).filter(|pose| !pose.is_cut) else { continue };
        let Some(like) = pose.like else { continue };
        let pattern = place_of.get(&like).map(|place| &groups[*place]);
        let can_be = |group: &&OrganGroup| is_replaceable(plant, group);
        match pattern.filter(can_be).filter(|_| is_replaceable(plant, group)) {
            Some(pattern) => {
                copy(plant, pattern, group, pose.thickness);
                let stalk = group.stalk.filter(|_| pattern.stalk.is_some());
                gone.push(OrganGroup { stalk, ..group.clone() });
            }
            None => resting += 1,
        }
    }
    (gone, resting)
}

/// Whether a group may be another: a leaf, a whole flower, a fruit.
pub fn is_replaceable(plant: &Plant, group: &OrganGroup) -> bool {
    let is_petal = group.flower.is_some() && !group.is_flower;
    let is_pot = |organ: &usize| plant.organs[*organ].kind() == OrganKind::Pot;
    !is_petal && !group.organs.is_empty() && !group.organs.iter().any(is_pot)
}

/// Where something stands, the direction in which it leaves, and its side across that, where it has such.
#[derive(Clone, Copy)]
struct Stand {
    at: Vec3,
    way: Option<Vec3>,
    side: Option<Vec3>,
}

impl Stand {
    /// That of a group: with its stalk, or of what is at the end of that.
    fn of(plant: &Plant, group: &OrganGroup, with_stalk: bool) -> Self {
        let end = Self::of_organs(plant, group);
        let Some(stalk) = group.stalk.filter(|_| with_stalk) else {
            return Self { at: if with_stalk { group.base } else { end.at }, ..end };
        };
        let points = &plant.branches[stalk].points;
        let way = points.last().and_then(|end| (*end - group.base).try_normalize());
        Self { at: group.base, way: way.or(end.way), side: None }
    }

    fn of_organs(plant: &Plant, group: &OrganGroup) -> Self {
        if let Some(flower) = group.flower {
            let cone = &plant.flowers[flower].cone;
            return Self { at: cone.apex, way: cone.axis.try_normalize(), side: None };
        }
        match group.organs.first().map(|organ| &plant.organs[*organ]) {
            Some(Organ { shape: Shape::Blade(blade), .. }) => {
                Self { at: blade.base, way: blade.v.try_normalize(), side: blade.u.try_normalize() }
            }
            other => Self { at: other.map_or(group.base, Organ::base), way: None, side: None },
        }
    }

    /// The turn from here to there: of leaves their faces too; none where one has no direction.
    fn turn_to(&self, to: &Self) -> Quat {
        let (Some(from_way), Some(to_way)) = (self.way, to.way) else { return Quat::IDENTITY };
        let frame = |way: Vec3, side: Vec3| {
            let side = side.reject_from_normalized(way).try_normalize()?;
            Some(Mat3::from_cols(side, way, side.cross(way)))
        };
        let frames =
            self.side.zip(to.side).and_then(|(from, to)| frame(from_way, from).zip(frame(to_way, to)));
        frames.map_or_else(
            || Quat::from_rotation_arc(from_way, to_way),
            |(from, to)| Quat::from_mat3(&(to * from.transpose())).normalize(),
        )
    }
}

/// Adds a copy of a group in the place of another, so many times as large.
fn copy(plant: &mut Plant, pattern: &OrganGroup, group: &OrganGroup, size: f32) {
    let with_stalk = pattern.stalk.is_some();
    let (from, to) = (Stand::of(plant, pattern, with_stalk), Stand::of(plant, group, with_stalk));
    let motion = Motion { turn: from.turn_to(&to), from: from.at, to: to.at, size };
    let origin = match group.flower {
        Some(flower) => plant.flowers[flower].origin,
        None => plant.organs[group.organs[0]].origin,
    };
    let branch = match pattern.stalk {
        Some(stalk) => Some(copy_stalk(plant, stalk, group.on, &motion)),
        None => group.stalk.or(group.on),
    };
    let flower = pattern.flower.map(|flower| {
        let mut flower = plant.flowers[flower].clone();
        flower.move_by(&motion);
        (flower.origin, flower.branch) = (origin, branch);
        plant.flowers.push(flower);
        plant.flowers.len() - 1
    });
    for organ in &pattern.organs {
        let mut organ = plant.organs[*organ].clone();
        organ.move_by(&motion);
        // What belongs to a flower is known by that.
        organ.origin = if flower.is_some() { Origin::Generated } else { origin };
        (organ.branch, organ.flower) = (branch, flower);
        plant.organs.push(organ);
    }
}

/// Adds a copy of a stalk on a branch; its place.
fn copy_stalk(plant: &mut Plant, stalk: usize, on: Option<usize>, motion: &Motion) -> usize {
    let level = on.map_or(0, |on| plant.branches[on].level + 1);
    let mut stalk = Branch { parent: on, level, ..plant.branches[stalk].clone() };
    stalk.points.iter_mut().for_each(|point| *point = motion.point(*point));
    stalk.radii.iter_mut().for_each(|radius| *radius *= motion.size);
    plant.branches.push(stalk);
    plant.branches.len() - 1
}
