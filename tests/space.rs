//! Branches drawn in space, and wood that is turned and bent: wood like any other, which grows on, in sound meshes.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use crate::in_space::{built, in_space};
use glam::{Quat, Vec3};
use penstemon::anatomy::Part;
use penstemon::pipeline::Built;
use penstemon::plant::Branch;
use penstemon::sketch::part_poses::{PartName, PartPose, posed};
use penstemon::sketch::{Sketch, Tool};

/// The branch that a stroke drew.
fn branch(built: &Built, stroke: u64) -> &Branch {
    built.plant.branches.iter().find(|b| built.provenance.stroke(b.origin) == Some(stroke)).unwrap()
}

/// Half the extents of the plant's wood and leaves from its trunk: across and in depth, metres.
fn reach(built: &Built) -> (f32, f32) {
    let points = built.plant.branches.iter().flat_map(|b| &b.points);
    let organs = built.plant.organs.iter().map(|organ| organ.base());
    let far = |of: fn(Vec3) -> f32| {
        let all = points.clone().copied().chain(organs.clone()).map(of);
        all.fold(0.0f32, |far, x| far.max(x.abs()))
    };
    (far(|p| p.x), far(|p| p.z))
}

#[test]
fn each_stroke_is_a_branch_on_what_it_begins_on_and_the_meshes_are_sound() {
    let sketch = in_space();
    let built = built(&sketch);
    assert_eq!(built.remarks, []);
    assert_eq!(built.plant.branches.len(), sketch.strokes.len());
    built.plant.check_invariants().unwrap();
    built.model.parts.iter().for_each(|part| part.mesh.check_invariants().unwrap());
    // Boughs on the trunk and twigs on the boughs, in turn.
    for bough in (2..18).step_by(2) {
        assert_eq!((branch(&built, bough).level, branch(&built, bough + 1).level), (1, 2), "bough {bough}");
    }
    let (across, deep) = reach(&built);
    assert!(deep > 0.6 * across, "it is no flat plant: {across} across, {deep} deep");
}

#[test]
fn growth_goes_on_from_branches_in_space() {
    let mut sketch = in_space();
    let bare = built(&sketch);
    sketch.params.insert("growth.years".into(), 3.into());
    let grown = built(&sketch);
    assert!(grown.growth.is_some() && grown.plant.organs.len() > 100, "{} leaves", grown.plant.organs.len());
    // Leaves stand around the ends of the boughs, also of those that lead toward the viewer and away.
    for stroke in 2..18 {
        let end = *branch(&bare, stroke).points.last().unwrap();
        let nearest = grown.plant.organs.iter().map(|o| o.base().distance(end)).fold(f32::INFINITY, f32::min);
        // The plant is 0.3 m high.
        assert!(nearest < 0.08, "stroke {stroke} ends {nearest} m from the nearest leaf");
    }
}

#[test]
fn a_pose_takes_along_what_grows_there_and_a_still_one_changes_no_byte() {
    let mut sketch = in_space();
    let posed_twice = built(&sketch);
    sketch.part_poses = [].into();
    let still = built(&sketch);
    let poses = (1..18)
        .map(|id| PartPose::still(PartName::Stroke(id)))
        .fold(sketch.part_poses.clone(), |known, pose| posed(&known, pose));
    assert!(poses.is_empty());
    assert_ne!(posed_twice.model, still.model);
    // The trunk lies down toward the viewer.
    let turn = Quat::from_rotation_x(std::f32::consts::FRAC_PI_2);
    sketch.part_poses = [PartPose { turn, ..PartPose::still(PartName::Stroke(1)) }].into();
    let lying = built(&sketch);
    for (before, after) in still.plant.branches.iter().zip(&lying.plant.branches) {
        let foot = still.plant.branches[0].points[0];
        let turned = |point: &Vec3| foot + turn * (*point - foot);
        let away = before.points.iter().map(turned).zip(&after.points).map(|(a, b)| a.distance(*b));
        assert!(away.fold(0.0, f32::max) < 1e-5);
    }
}

#[test]
fn the_front_of_the_sheet_is_read_as_if_nothing_were_in_space() {
    let sketch = in_space();
    let mut flat = sketch.clone();
    flat.strokes.retain(|stroke| stroke.tool != Tool::SpaceBranch);
    flat.part_poses = [].into();
    let (mut with, without) = (built(&Sketch { part_poses: [].into(), ..sketch }), built(&flat));
    let in_space = with.anatomy.marks.split_off(1);
    assert!(
        in_space.iter().all(|mark| mark.part == Part::Branch),
        "they are shown as branches: {in_space:?}"
    );
    assert_eq!(with.anatomy, without.anatomy);
    assert_eq!(with.plant.branches[0].points, without.plant.branches[0].points);
}
