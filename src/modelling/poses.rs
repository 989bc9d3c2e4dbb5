//! Branches turned and bent by the artist (001 §4.3): the wood above goes along, and leaves and flowers with the place that they
//! grow on.
//!
//! The branches of a plant are joints of a puppet. A pose turns its branch about its base, in the frame that what it grows on has
//! there, and bends it besides: the bend grows evenly along the branch, and lengths stay. So a pose is the same whatever
//! is done to other branches, and a plant without poses is not touched.
//!
//! Limits: the branch stays where it grows on its parent; nothing keeps moved wood from passing through other wood.

use crate::geom::polyline;
use crate::plant::{Branch, Motion, Plant, Provenance};
use crate::sketch::wood_poses::WoodPose;
use glam::{Quat, Vec3};
use std::collections::HashMap;

/// How the points of a branch were moved.
#[derive(Clone, Debug, PartialEq)]
struct Moved {
    /// Where its points were.
    rest: Vec<Vec3>,
    /// Where they are.
    points: Vec<Vec3>,
    /// What they were turned by.
    turns: Vec<Quat>,
}

impl Moved {
    /// The motion of the place of the branch that was nearest to a point, or with `is_moved` is nearest to it now.
    fn at(&self, point: Vec3, is_moved: bool) -> Motion {
        let line = if is_moved { &self.points } else { &self.rest };
        let arcs = polyline::arc_lengths(line.iter().copied());
        let arc = polyline::nearest(line, point).map_or(0.0, |(_, arc)| arc);
        let (i, share) = polyline::locate(&arcs, arc);
        let next = (i + 1).min(self.turns.len() - 1);
        let between = |line: &[Vec3]| line[i].lerp(line[next], share);
        let turn = self.turns[i].slerp(self.turns[next], share);
        Motion { turn, from: between(&self.rest), to: between(&self.points) }
    }
}

/// Where the wood of a plant was moved by poses; that of a plant without poses is empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Posed(HashMap<usize, Moved>);

impl Posed {
    /// What the foot of a branch is turned by, its own turn included.
    pub fn foot(&self, branch: usize) -> Quat {
        let moved = self.0.get(&branch).and_then(|moved| moved.turns.first());
        moved.copied().unwrap_or(Quat::IDENTITY)
    }

    /// The motion of what grows on a branch at the place that is now nearest to a point; none where it was not moved.
    pub fn motion_at(&self, branch: usize, point: Vec3) -> Option<Motion> {
        Some(self.0.get(&branch)?.at(point, true))
    }
}

/// Poses the branches that strokes drew, and all that grows on them; says where they were.
pub fn pose_wood(plant: &mut Plant, provenance: &Provenance, poses: &[WoodPose]) -> Posed {
    let mut posed = Posed::default();
    let mut pose_of: HashMap<u64, &WoodPose> = poses.iter().map(|pose| (pose.stroke, pose)).collect();
    if pose_of.is_empty() {
        return posed;
    }
    for index in 0..plant.branches.len() {
        let branch = &plant.branches[index];
        // Of several branches of one stroke the first, on which the others grow.
        let own = provenance.stroke(branch.origin).and_then(|stroke| pose_of.remove(&stroke));
        let under = branch.parent.and_then(|parent| posed.0.get(&parent));
        let by_parent = under.zip(branch.points.first()).map(|(under, base)| under.at(*base, false));
        if own.is_none() && by_parent.is_none() {
            continue;
        }
        let moved = moved(branch, by_parent, own);
        plant.branches[index].points.clone_from(&moved.points);
        posed.0.insert(index, moved);
    }
    move_organs(plant, &posed);
    posed
}

/// The branch moved by its parent, and then in its own pose.
fn moved(branch: &Branch, by_parent: Option<Motion>, own: Option<&WoodPose>) -> Moved {
    let rest = branch.points.clone();
    let base = rest.first().copied().unwrap_or_default();
    let by_parent = by_parent.unwrap_or(Motion { turn: Quat::IDENTITY, from: base, to: base });
    let pose = |pose: &WoodPose| (pose.turn.normalize(), pose.bend.normalize());
    let (turn, bend) = own.map_or((Quat::IDENTITY, Quat::IDENTITY), pose);
    let foot = by_parent.turn * turn;
    let arcs = polyline::arc_lengths(rest.iter().copied());
    let length = arcs.last().copied().unwrap_or(0.0).max(f32::MIN_POSITIVE);
    let turn_at = |arc: f32| (foot * Quat::IDENTITY.slerp(bend, arc / length)).normalize();
    let turns: Vec<Quat> = arcs.iter().map(|arc| turn_at(*arc)).collect();
    let mut points = Vec::with_capacity(rest.len());
    let mut last = by_parent.point(base);
    points.push(last);
    for (ends, arcs) in rest.windows(2).zip(arcs.windows(2)) {
        last += turn_at(arcs[0].midpoint(arcs[1])) * (ends[1] - ends[0]);
        points.push(last);
    }
    Moved { rest, points, turns }
}

/// Moves flowers, and all organs with the place that they grow on; those of flowers with their flower.
fn move_organs(plant: &mut Plant, posed: &Posed) {
    let on = |branch: Option<usize>, at: Vec3| {
        branch.and_then(|b| posed.0.get(&b)).map(|moved| moved.at(at, false))
    };
    let motions: Vec<Option<Motion>> =
        plant.flowers.iter().map(|flower| on(flower.branch, flower.cone.apex)).collect();
    for (flower, motion) in plant.flowers.iter_mut().zip(&motions) {
        motion.iter().for_each(|motion| flower.move_by(motion));
    }
    for organ in &mut plant.organs {
        let of_flower = organ.flower.map(|flower| motions[flower]);
        let motion = of_flower.unwrap_or_else(|| on(organ.branch, organ.base()));
        motion.iter().for_each(|motion| organ.move_by(motion));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{Origin, Role, WoodPart};
    use std::f32::consts::FRAC_PI_2;

    fn branch(origin: Origin, parent: Option<usize>, from: Vec3, to: Vec3) -> Branch {
        let points: Vec<Vec3> = (0..=20).map(|k| from.lerp(to, k as f32 / 20.0)).collect();
        let (level, radii) = (parent.map_or(0, |parent| parent as u32 + 1), vec![0.01; points.len()]);
        Branch { origin, parent, level, points, radii, role: Role::of(WoodPart::Stem) }
    }

    /// A trunk of a metre, a bough from its middle to the right, and a twig upward from the middle of that.
    fn tree() -> (Plant, Provenance) {
        let mut provenance = Provenance::default();
        let [trunk, bough] = [1, 2].map(|stroke| provenance.record(Some(stroke)));
        let middle = Vec3::Y * 0.5;
        let branches = vec![
            branch(trunk, None, Vec3::ZERO, Vec3::Y),
            branch(bough, Some(0), middle, middle + Vec3::X * 0.4),
            branch(Origin::Generated, Some(1), middle + Vec3::X * 0.2, middle + Vec3::new(0.2, 0.2, 0.0)),
        ];
        (Plant { branches, ..Plant::default() }, provenance)
    }

    fn pose(stroke: u64, turn: Quat, bend: Quat) -> WoodPose {
        WoodPose { stroke, turn, bend }
    }

    fn ends(plant: &Plant) -> [Vec3; 3] {
        [0, 1, 2].map(|b| *plant.branches[b].points.last().unwrap())
    }

    fn assert_near(found: [Vec3; 3], expected: [Vec3; 3]) {
        let is_near = found.iter().zip(&expected).all(|(a, b)| a.distance(*b) < 1e-4);
        assert!(is_near, "{found:?}, not {expected:?}");
    }

    #[test]
    fn a_bough_turns_about_its_base_and_takes_its_twigs_along() {
        let (mut plant, provenance) = tree();
        // Toward the viewer.
        let turn = Quat::from_rotation_y(-FRAC_PI_2);
        let posed = pose_wood(&mut plant, &provenance, &[pose(2, turn, Quat::IDENTITY)]);
        let middle = Vec3::Y * 0.5;
        assert_near(ends(&plant), [Vec3::Y, middle + Vec3::Z * 0.4, middle + Vec3::new(0.0, 0.2, 0.2)]);
        let motion = posed.motion_at(1, middle + Vec3::Z * 0.3).unwrap();
        assert!(motion.back(middle + Vec3::Z * 0.3).distance(middle + Vec3::X * 0.3) < 1e-5);
        assert_eq!(posed.motion_at(0, Vec3::Y), None);
    }

    #[test]
    fn poses_do_not_depend_on_each_other() {
        let (to_viewer, up) = (Quat::from_rotation_y(-FRAC_PI_2), Quat::from_rotation_z(FRAC_PI_2));
        let poses = [pose(1, to_viewer, Quat::IDENTITY), pose(2, up, Quat::IDENTITY)];
        let (mut one, provenance) = tree();
        pose_wood(&mut one, &provenance, &poses);
        let (mut other, _) = tree();
        pose_wood(&mut other, &provenance, &[poses[1], poses[0]]);
        assert_eq!(one, other);
        // The bough stands upright now, and the twig, which was to its left, is turned with the trunk.
        assert_near(ends(&one), [Vec3::Y, Vec3::Y * 0.9, Vec3::new(0.0, 0.7, -0.2)]);
    }

    #[test]
    fn a_bend_keeps_the_length_and_the_base() {
        let (mut plant, provenance) = tree();
        pose_wood(&mut plant, &provenance, &[pose(1, Quat::IDENTITY, Quat::from_rotation_z(-FRAC_PI_2))]);
        let trunk = &plant.branches[0].points;
        assert!((polyline::length(trunk) - 1.0).abs() < 1e-4);
        // A quarter of a circle of length 1.
        let radius = 1.0 / FRAC_PI_2;
        assert!(trunk[20].distance(Vec3::new(radius, radius, 0.0)) < 2e-3, "{}", trunk[20]);
        let way = (plant.branches[1].points[20] - plant.branches[1].points[0]).normalize();
        let halfway = Quat::from_rotation_z(-0.5 * FRAC_PI_2) * Vec3::X;
        assert!(way.distance(halfway) < 1e-3, "the bough is turned half as far: {way}");
        plant.check_invariants().unwrap();
    }

    #[test]
    fn poses_of_strokes_that_are_not_there_rest() {
        let (mut plant, provenance) = tree();
        let before = plant.clone();
        pose_wood(&mut plant, &provenance, &[pose(9, Quat::from_rotation_z(1.0), Quat::IDENTITY)]);
        assert_eq!(plant, before);
    }
}
