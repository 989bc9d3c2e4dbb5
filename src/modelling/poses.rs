//! Branches turned, bent, made thicker and cut off by the artist (001 §4.3): the wood above goes along, and leaves and flowers
//! with the place that they grow on.
//!
//! The branches of a plant are joints of a puppet. A pose turns its branch about its base, in the frame that what it grows on has
//! there, and bends it besides: the bend grows evenly along the branch, and lengths stay. So a pose is the same whatever
//! is done to other branches, and a plant without poses is not touched.
//!
//! Drawn wood is posed before it grows on, so that growth sees it where it is. Wood that grew is posed when it has grown: the
//! rest of the plant stays as it was, to the last bit. What brushes grow after that stands on posed wood, and is posed last.
//!
//! Limits: a branch stays where it grows on its parent, and no branch becomes thicker than that; nothing keeps moved wood from
//! passing through other wood.

use super::cut_off::cut_off;
use super::joint::{Joint, joints};
use super::thickness::{Thickened, thicken};
use crate::geom::polyline;
use crate::plant::{Branch, Continued, FlowerBuds, GrownId, Motion, Origin, Plant, Provenance};
use crate::sketch::{Remark, Warning, WoodName, WoodPose};
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
pub struct Posed {
    /// Drawn branches, by their places among these.
    drawn: HashMap<usize, Moved>,
    /// What the feet of branches that grew are turned by.
    grown: HashMap<GrownId, Quat>,
}

impl Posed {
    /// What the foot of a drawn branch is turned by, its own turn included.
    pub fn foot(&self, branch: usize) -> Quat {
        let moved = self.drawn.get(&branch).and_then(|moved| moved.turns.first());
        moved.copied().unwrap_or(Quat::IDENTITY)
    }

    /// The same of one that grew.
    pub fn grown_foot(&self, branch: GrownId) -> Quat {
        self.grown.get(&branch).copied().unwrap_or(Quat::IDENTITY)
    }

    /// The motion of what grows on a drawn branch at the place that is now nearest to a point; none where it was not moved.
    pub fn motion_at(&self, branch: usize, point: Vec3) -> Option<Motion> {
        Some(self.drawn.get(&branch)?.at(point, true))
    }
}

/// Poses the branches that strokes drew, and all that grows on them; says where they were. Poses that are left in `poses` are of
/// no branch of the plant.
pub fn pose_wood(plant: &mut Plant, provenance: &Provenance, poses: &mut Vec<WoodPose>) -> Posed {
    let named = |branch: &Branch| provenance.stroke(branch.origin).map(WoodName::Stroke);
    let drawn = pose_branches(plant, &joints(plant, named, &[], poses));
    move_organs(plant, &drawn);
    Posed { drawn, ..Posed::default() }
}

/// Poses branches that grew, and all that is on them; what is cut off goes with all of it. A branch that is `continued` is posed
/// from where it begins in the line of the other. Poses that are left in `poses` are of no branch of the plant.
pub fn pose_grown_wood(
    (plant, buds): (&mut Plant, &mut FlowerBuds),
    continued: &[Continued],
    poses: &mut Vec<WoodPose>,
    posed: &mut Posed,
) {
    if poses.is_empty() {
        return;
    }
    let named = |branch: &Branch| match branch.origin {
        Origin::Grown(GrownId(name)) => Some(WoodName::Grown(name)),
        Origin::Drawn(_) | Origin::Generated => None,
    };
    let joints = joints(plant, named, continued, poses);
    let moved = pose_branches(plant, &joints);
    move_organs(plant, &moved);
    for bud in &mut buds.buds {
        let motion = bud.branch.and_then(|b| moved.get(&b)).map(|moved| moved.at(bud.base, false));
        motion.iter().for_each(|motion| bud.move_by(motion));
    }
    for (index, branch) in plant.branches.iter().enumerate() {
        let turn = moved.get(&index).and_then(|moved| moved.turns.first());
        if let (Origin::Grown(name), Some(turn)) = (branch.origin, turn) {
            posed.grown.insert(name, *turn);
        }
    }
    cut_off(plant, buds, &joints);
}

/// The remark that poses have found no branch.
pub fn poses_at_rest(left: &[WoodPose]) -> Option<Warning> {
    let poses = left.len();
    (poses > 0).then_some(Warning { stroke: None, remark: Remark::PosesRest { poses } })
}

/// Moves branches and makes them thicker; says how they were moved.
fn pose_branches(plant: &mut Plant, joints: &HashMap<usize, Vec<Joint>>) -> HashMap<usize, Moved> {
    let (mut posed, mut thickened) = (HashMap::new(), HashMap::new());
    if joints.is_empty() {
        return posed;
    }
    for index in 0..plant.branches.len() {
        let branch = &plant.branches[index];
        let own = joints.get(&index).map_or(&[][..], Vec::as_slice);
        let base = branch.parent.zip(branch.points.first().copied());
        let by_parent = base.and_then(|(parent, base)| Some(Moved::at(posed.get(&parent)?, base, false)));
        let on_parent = base.and_then(|(parent, base)| Some(Thickened::at(thickened.get(&parent)?, base)));
        let thickened_now = Thickened::new(branch, on_parent.unwrap_or(1.0), own);
        let turns = |joint: &Joint| joint.pose.turn != Quat::IDENTITY || joint.pose.bend != Quat::IDENTITY;
        if by_parent.is_some() || own.iter().any(turns) {
            let moved = moved(branch, by_parent, own);
            plant.branches[index].points.clone_from(&moved.points);
            posed.insert(index, moved);
        }
        if let Some(thicker) = thickened_now {
            thicken(&mut plant.branches, index, &thicker);
            thickened.insert(index, thicker);
        }
    }
    posed
}

/// The branch moved by its parent, and then in its own poses.
fn moved(branch: &Branch, by_parent: Option<Motion>, joints: &[Joint]) -> Moved {
    let rest = branch.points.clone();
    let base = rest.first().copied().unwrap_or_default();
    let by_parent = by_parent.unwrap_or(Motion { turn: Quat::IDENTITY, from: base, to: base });
    let arcs = polyline::arc_lengths(rest.iter().copied());
    let length = arcs.last().copied().unwrap_or(0.0);
    let turn_at = |arc: f32| {
        let below = joints.iter().take_while(|joint| joint.arc <= arc);
        let turn = below.fold(by_parent.turn, |turn, Joint { arc: from, pose }| {
            let along = (arc - from) / (length - from).max(f32::MIN_POSITIVE);
            turn * pose.turn.normalize() * Quat::IDENTITY.slerp(pose.bend.normalize(), along)
        });
        turn.normalize()
    };
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
fn move_organs(plant: &mut Plant, posed: &HashMap<usize, Moved>) {
    let on =
        |branch: Option<usize>, at: Vec3| branch.and_then(|b| posed.get(&b)).map(|moved| moved.at(at, false));
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
        WoodPose { turn, bend, ..WoodPose::still(WoodName::Stroke(stroke)) }
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
        let posed = pose_wood(&mut plant, &provenance, &mut vec![pose(2, turn, Quat::IDENTITY)]);
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
        pose_wood(&mut one, &provenance, &mut poses.to_vec());
        let (mut other, _) = tree();
        pose_wood(&mut other, &provenance, &mut vec![poses[1], poses[0]]);
        assert_eq!(one, other);
        // The bough stands upright now, and the twig, which was to its left, is turned with the trunk.
        assert_near(ends(&one), [Vec3::Y, Vec3::Y * 0.9, Vec3::new(0.0, 0.7, -0.2)]);
    }

    #[test]
    fn a_bend_keeps_the_length_and_the_base() {
        let (mut plant, provenance) = tree();
        pose_wood(
            &mut plant,
            &provenance,
            &mut vec![pose(1, Quat::IDENTITY, Quat::from_rotation_z(-FRAC_PI_2))],
        );
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
    fn a_branch_that_runs_on_in_another_is_posed_from_where_it_begins() {
        let (still, _) = tree();
        let name = GrownId(5);
        let continued = [Continued { name, branch: 0, from: Vec3::Y * 0.75 }];
        let posed = |pose: WoodPose| {
            let (mut plant, mut buds) = (still.clone(), FlowerBuds::default());
            let mut poses = vec![pose];
            let to = (&mut plant, &mut buds);
            pose_grown_wood(to, &continued, &mut poses, &mut Posed::default());
            assert!(poses.is_empty());
            plant
        };
        let pose = WoodPose::still(WoodName::Grown(name.0));
        let turned = posed(WoodPose { turn: Quat::from_rotation_z(FRAC_PI_2), ..pose });
        let end = turned.branches[0].points[20];
        assert!(end.distance(Vec3::new(-0.25, 0.75, 0.0)) < 1e-4, "{end}");
        assert_eq!(turned.branches[1..], still.branches[1..], "what is below stays");
        let cut = posed(WoodPose { is_cut: true, ..pose });
        assert!((cut.branches[0].points.last().unwrap().y - 0.75).abs() < 1e-5);
        assert_eq!(cut.branches.len(), 3);
        let thick = posed(WoodPose { thickness: 2.0, ..pose });
        assert_eq!((thick.branches[0].radii[14], thick.branches[0].radii[16]), (0.01, 0.02));
    }

    #[test]
    fn poses_of_strokes_that_are_not_there_rest() {
        let (mut plant, provenance) = tree();
        let before = plant.clone();
        pose_wood(&mut plant, &provenance, &mut vec![pose(9, Quat::from_rotation_z(1.0), Quat::IDENTITY)]);
        assert_eq!(plant, before);
    }
}
