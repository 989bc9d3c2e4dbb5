//! Branches grafted, turned, bent, straightened, made thicker and cut off by the artist (001 §4.3): the wood above goes along, and
//! leaves and flowers with the place that they grow on.
//!
//! The branches of a plant are joints of a puppet. A pose turns its branch about its base, in the frame that what it grows on has
//! there, and bends it besides: the bend grows evenly along the branch, and lengths stay. It may draw out its line straight before, slide the
//! base along what the branch grows on or over the ground, and set it on another branch (`graft.rs`). So a pose is the same whatever is done to other branches, and a plant without
//! poses is not touched.
//!
//! Drawn wood is posed before it grows on, so that growth sees it where it is. Wood that grew is posed when it has grown: the
//! rest of the plant stays as it was, to the last bit. What brushes grow after that stands on posed wood, and is posed last.
//!
//! Limits: a branch stays on its parent, and no branch becomes thicker than that; the stems of a bush stay on their base. Nothing
//! keeps moved wood from passing through other wood.

use super::carried::{move_buds, move_organs};
use super::cut_off::cut_off;
use super::graft::graft;
use super::joint::{Joint, joints};
use super::part_names::PartNames;
use super::slide::Slide;
use super::straighten::{straightening, turns_at_points};
use super::thickness::{Thickened, thicken};
use crate::geom::polyline;
use crate::plant::{Branch, Continued, FlowerBuds, Motion, Origin, Plant};
use crate::sketch::{PartName, PartPose, Remark};
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
    /// What its foot was turned by, without the straightening of its line.
    foot: Quat,
    /// Where its base was before it slid, and what the place of its parent there was turned by.
    stood: (Vec3, Quat),
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
        Motion { turn, from: between(&self.rest), to: between(&self.points), size: 1.0 }
    }
}

/// How a part of a plant was turned and where it stood before its own pose: what a new pose of it starts from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartFrame {
    /// Where its base was before the part was moved itself, metres.
    pub stood: Vec3,
    /// What the place that it stood on was turned by.
    pub parent_turn: Quat,
    /// What its foot is turned by, its own turn included.
    pub foot: Quat,
}

/// Where the parts of a plant were moved by poses; that of a plant without poses is empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Posed {
    /// Branches.
    wood: HashMap<Origin, Moved>,
    /// Organs that have poses themselves.
    pub(super) organs: HashMap<PartName, PartFrame>,
    /// How many parts could not be set on the branch onto which they are grafted, or found nothing to be a copy of.
    pub(super) resting: usize,
}

impl Posed {
    /// The frame of a branch.
    pub fn frame(&self, branch: &Branch) -> PartFrame {
        let base = branch.points.first().copied().unwrap_or_default();
        self.wood.get(&branch.origin).map_or_else(
            || PartFrame { stood: base, parent_turn: Quat::IDENTITY, foot: Quat::IDENTITY },
            |moved| PartFrame { stood: moved.stood.0, parent_turn: moved.stood.1, foot: moved.foot },
        )
    }

    /// The motion of what grows on a branch at the place that is now nearest to a point; none where it was not moved.
    pub fn motion_at(&self, branch: &Branch, point: Vec3) -> Option<Motion> {
        Some(self.wood.get(&branch.origin)?.at(point, true))
    }

    fn insert(&mut self, branches: &[Branch], moved: HashMap<usize, Moved>) {
        // Of what a rule made only what it stands on is known, which is turned as it is.
        let named = moved.into_iter().map(|(index, moved)| (branches[index].origin, moved));
        self.wood.extend(named.filter(|(origin, _)| *origin != Origin::Generated));
    }
}

/// Poses the branches that strokes drew, and all that grows on them; says where they were. `scale` is what a pixel of the canvas is,
/// metres. Poses that are left in `poses` are of no branch of the plant.
pub fn pose_wood(plant: &mut Plant, names: &PartNames, poses: &mut Vec<PartPose>, scale: f32) -> Posed {
    let resting = graft((plant, &mut FlowerBuds::default()), &mut [], (names, poses));
    let moved = pose_branches(plant, &joints(plant, names, &[], poses), scale);
    move_organs(plant, |branch, at| Some(moved.get(&branch)?.at(at, false)));
    let mut posed = Posed { resting, ..Posed::default() };
    posed.insert(&plant.branches, moved);
    posed
}

/// Poses branches that grew, and all that is on them; what is cut off goes with all of it. A branch that is `continued` is posed
/// from where it begins in the line of the other. Poses that are left in `poses` are of no branch of the plant.
pub fn pose_grown_wood(
    (plant, buds): (&mut Plant, &mut FlowerBuds),
    continued: &[Continued],
    (names, poses, scale): (&PartNames, &mut Vec<PartPose>, f32),
    posed: &mut Posed,
) {
    if poses.is_empty() {
        return;
    }
    let mut continued = continued.to_vec();
    posed.resting += graft((plant, buds), &mut continued, (names, poses));
    let joints = joints(plant, names, &continued, poses);
    let moved = pose_branches(plant, &joints, scale);
    let motion_on = |branch: usize, at: Vec3| Some(moved.get(&branch)?.at(at, false));
    move_organs(plant, motion_on);
    move_buds(buds, motion_on);
    posed.insert(&plant.branches, moved);
    cut_off(plant, buds, &joints);
}

/// The remark that poses have found no part, or no branch to graft theirs onto.
pub fn poses_at_rest(left: &[PartPose], posed: &Posed) -> Option<Remark> {
    let poses = left.len() + posed.resting;
    (poses > 0).then_some(Remark::PosesRest { poses })
}

/// Moves branches and makes them thicker; says how they were moved.
fn pose_branches(
    plant: &mut Plant,
    joints: &HashMap<usize, Vec<Joint>>,
    scale: f32,
) -> HashMap<usize, Moved> {
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
        let foot = Foot::new(&plant.branches, index, by_parent, own, scale);
        // At a thinner place it is thinner itself.
        let on_parent = on_parent.unwrap_or(1.0) * foot.slide.thickness.min(1.0);
        let thickened_now = Thickened::new(branch, on_parent, own);
        let moves = |joint: &Joint| {
            let PartPose { turn, bend, straight, shift, .. } = joint.pose;
            turn != Quat::IDENTITY || bend != Quat::IDENTITY || straight != 0.0 || shift != Vec3::ZERO
        };
        if by_parent.is_some() || own.iter().any(moves) {
            let moved = moved(branch, &foot, own);
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

/// Where the base of a branch comes to.
struct Foot {
    /// Where it stands on its moved parent, and what that is turned by there.
    stood: (Vec3, Quat),
    /// How it slides from there.
    slide: Slide,
}

impl Foot {
    fn new(
        branches: &[Branch],
        index: usize,
        by_parent: Option<Motion>,
        joints: &[Joint],
        scale: f32,
    ) -> Self {
        let branch = &branches[index];
        let base = branch.points.first().copied().unwrap_or_default();
        let (base, parent_turn) =
            by_parent.map_or((base, Quat::IDENTITY), |motion| (motion.point(base), motion.turn));
        let first = joints.first().filter(|joint| joint.arc == 0.0 && !branch.is_basal_stem());
        let by = first.map_or(Vec3::ZERO, |joint| parent_turn * (joint.pose.shift * scale));
        let on = branch.parent.map(|parent| &branches[parent]);
        Self { stood: (base, parent_turn), slide: Slide::new(on, base, by, scale) }
    }
}

/// The branch moved with its foot, and then in its own poses.
fn moved(branch: &Branch, foot: &Foot, joints: &[Joint]) -> Moved {
    let rest = branch.points.clone();
    let carried = foot.slide.turn * foot.stood.1;
    let arcs = polyline::arc_lengths(rest.iter().copied());
    let length = arcs.last().copied().unwrap_or(0.0);
    let turn_at = |arc: f32| {
        let below = joints.iter().take_while(|joint| joint.arc <= arc);
        let turn = below.fold(carried, |turn, Joint { arc: from, pose }| {
            let along = (arc - from) / (length - from).max(f32::MIN_POSITIVE);
            turn * pose.turn.normalize() * Quat::IDENTITY.slerp(pose.bend.normalize(), along)
        });
        turn.normalize()
    };
    let straight = straightening(&rest, &arcs, joints);
    let at_points = arcs.iter().zip(turns_at_points(&straight));
    let turns: Vec<Quat> = at_points.map(|(arc, straight)| turn_at(*arc) * straight).collect();
    let mut points = Vec::with_capacity(rest.len());
    let mut last = foot.slide.to;
    points.push(last);
    for ((ends, arcs), straight) in rest.windows(2).zip(arcs.windows(2)).zip(straight) {
        last += turn_at(arcs[0].midpoint(arcs[1])) * straight * (ends[1] - ends[0]);
        points.push(last);
    }
    Moved { rest, points, turns, foot: turn_at(0.0), stood: foot.stood }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::{GrownId, Provenance, Role, WoodPart};
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

    fn pose(stroke: u64, turn: Quat, bend: Quat) -> PartPose {
        PartPose { turn, bend, ..PartPose::still(PartName::Stroke(stroke)) }
    }

    /// The plant posed, a pixel being a millimetre.
    fn posed(plant: &mut Plant, provenance: &Provenance, poses: &[PartPose]) -> Posed {
        pose_wood(plant, &PartNames::new(provenance), &mut poses.to_vec(), 0.001)
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
        let posed = posed(&mut plant, &provenance, &[pose(2, turn, Quat::IDENTITY)]);
        let middle = Vec3::Y * 0.5;
        assert_near(ends(&plant), [Vec3::Y, middle + Vec3::Z * 0.4, middle + Vec3::new(0.0, 0.2, 0.2)]);
        let motion = posed.motion_at(&plant.branches[1], middle + Vec3::Z * 0.3).unwrap();
        assert!(motion.back(middle + Vec3::Z * 0.3).distance(middle + Vec3::X * 0.3) < 1e-5);
        assert_eq!(posed.motion_at(&plant.branches[0], Vec3::Y), None);
    }

    #[test]
    fn poses_do_not_depend_on_each_other() {
        let (to_viewer, up) = (Quat::from_rotation_y(-FRAC_PI_2), Quat::from_rotation_z(FRAC_PI_2));
        let poses = [pose(1, to_viewer, Quat::IDENTITY), pose(2, up, Quat::IDENTITY)];
        let (mut one, provenance) = tree();
        posed(&mut one, &provenance, &poses);
        let (mut other, _) = tree();
        posed(&mut other, &provenance, &[poses[1], poses[0]]);
        assert_eq!(one, other);
        // The bough stands upright now, and the twig, which was to its left, is turned with the trunk.
        assert_near(ends(&one), [Vec3::Y, Vec3::Y * 0.9, Vec3::new(0.0, 0.7, -0.2)]);
    }

    #[test]
    fn a_bend_keeps_the_length_and_the_base() {
        let (mut plant, provenance) = tree();
        posed(&mut plant, &provenance, &[pose(1, Quat::IDENTITY, Quat::from_rotation_z(-FRAC_PI_2))]);
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
    fn a_crooked_bough_is_straight_before_it_is_turned_and_takes_its_twig_along() {
        let (mut plant, provenance) = tree();
        let crooked: Vec<Vec3> = plant.branches[1]
            .points
            .iter()
            .enumerate()
            .map(|(k, point)| *point + Vec3::Y * if k % 4 < 2 { 0.0 } else { 0.02 })
            .collect();
        plant.branches[1].points = crooked.clone();
        let turn = Quat::from_rotation_z(FRAC_PI_2);
        let straight = PartPose { straight: 1.0, ..pose(2, turn, Quat::IDENTITY) };
        let posed = posed(&mut plant, &provenance, &[straight]);
        let bough = &plant.branches[1].points;
        let (base, length) = (bough[0], polyline::length(&crooked));
        assert!(bough[20].distance(base + Vec3::Y * length) < 1e-4, "{}", bough[20]);
        let frame = posed.frame(&plant.branches[1]);
        assert!(frame.foot.angle_between(turn) < 1e-3, "a new turn starts from the turn alone");
        assert!(
            plant.branches[1].axis_at(plant.branches[2].points[0]).0.distance(plant.branches[2].points[0])
                < 2e-2
        );
    }

    #[test]
    fn a_bough_slides_along_its_trunk_with_its_twigs_and_a_trunk_over_the_ground() {
        let (mut plant, provenance) = tree();
        let shifted =
            |stroke: u64, shift: Vec3| PartPose { shift, ..pose(stroke, Quat::IDENTITY, Quat::IDENTITY) };
        let poses = [shifted(1, Vec3::new(0.0, 70.0, 200.0)), shifted(2, Vec3::new(90.0, 250.0, 0.0))];
        let posed = posed(&mut plant, &provenance, &poses);
        let trunk = Vec3::Z * 0.2;
        let foot = trunk + Vec3::Y * 0.75;
        assert_near(ends(&plant), [trunk + Vec3::Y, foot + Vec3::X * 0.4, foot + Vec3::new(0.2, 0.2, 0.0)]);
        let frame = posed.frame(&plant.branches[1]);
        assert!(frame.stood.distance(trunk + Vec3::Y * 0.5) < 1e-6 && frame.foot == Quat::IDENTITY);
        plant.check_invariants().unwrap();
    }

    #[test]
    fn a_branch_that_runs_on_in_another_is_posed_from_where_it_begins() {
        let (still, _) = tree();
        let name = GrownId(5);
        let continued = [Continued { name, branch: 0, from: Vec3::Y * 0.75 }];
        let posed = |pose: PartPose| {
            let (mut plant, mut buds) = (still.clone(), FlowerBuds::default());
            let mut poses = vec![pose];
            let to = (&mut plant, &mut buds);
            let by = (&PartNames::default(), &mut poses, 0.001);
            pose_grown_wood(to, &continued, by, &mut Posed::default());
            assert!(poses.is_empty());
            plant
        };
        let pose = PartPose::still(PartName::Grown(name.0));
        let turned = posed(PartPose { turn: Quat::from_rotation_z(FRAC_PI_2), ..pose });
        let end = turned.branches[0].points[20];
        assert!(end.distance(Vec3::new(-0.25, 0.75, 0.0)) < 1e-4, "{end}");
        assert_eq!(turned.branches[1..], still.branches[1..], "what is below stays");
        let cut = posed(PartPose { is_cut: true, ..pose });
        assert!((cut.branches[0].points.last().unwrap().y - 0.75).abs() < 1e-5);
        assert_eq!(cut.branches.len(), 3);
        let thick = posed(PartPose { thickness: 2.0, ..pose });
        assert_eq!((thick.branches[0].radii[14], thick.branches[0].radii[16]), (0.01, 0.02));
    }

    #[test]
    fn poses_of_strokes_that_are_not_there_rest() {
        let (mut plant, provenance) = tree();
        let before = plant.clone();
        posed(&mut plant, &provenance, &[pose(9, Quat::from_rotation_z(1.0), Quat::IDENTITY)]);
        assert_eq!(plant, before);
    }
}
