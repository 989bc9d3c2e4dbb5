//! Leaves, flowers, fruits and pots turned, moved, made larger and taken away: in drawings of all kinds the rest of the plant stays,
//! and what grew is found again.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use crate::in_space::{built, in_space};
use glam::{Quat, Vec3};
use penstemon::modelling::{OrganGroup, PartNames};
use penstemon::pipeline::Built;
use penstemon::plant::{Organ, OrganKind, OrganPart, Shape};
use penstemon::sketch::{self, PartPose, Remark, Sketch};
use std::path::Path;

fn sketch(name: &str) -> Sketch {
    let file = format!("assets/sketches/{name}.penstemon");
    sketch::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join(file)).unwrap().0
}

fn posed(sketch: &Sketch, poses: &[PartPose]) -> Built {
    let posed = built(&Sketch { part_poses: poses.into(), ..sketch.clone() });
    let rest = posed.remarks.iter().find(|remark| matches!(remark.remark, Remark::PosesRest { .. }));
    assert_eq!(rest, None);
    posed
}

/// All parts of a plant that are organs and have a name.
fn groups(built: &Built) -> Vec<OrganGroup> {
    OrganGroup::all(&built.plant, &PartNames::new(&built.provenance), |_| true)
}

fn is_of(built: &Built, group: &OrganGroup, kind: OrganKind) -> bool {
    group.organs.iter().any(|organ| built.plant.organs[*organ].kind() == kind)
}

#[test]
fn any_organ_of_any_drawing_is_posed_and_the_rest_stays_to_the_last_bit() {
    for name in [
        "balloon_flower",
        "potted_plant",
        "freehand_house_plant",
        "freehand_apple_tree",
        "freehand_flower",
        "freehand_tulip",
        "tree_willow",
    ] {
        let sketch = sketch(name);
        let before = built(&sketch);
        let groups = groups(&before);
        assert!(!groups.is_empty(), "{name}");
        // Some of each drawing, from the first to the last.
        for group in groups.iter().step_by(groups.len().div_ceil(4)).chain(groups.last()) {
            let turn = Quat::from_axis_angle(Vec3::new(0.6, 0.0, 0.8), 0.7);
            let pose = PartPose { turn, thickness: 1.4, ..PartPose::still(group.name) };
            let after = posed(&sketch, &[pose]);
            assert_eq!(after.plant.organs.len(), before.plant.organs.len(), "{name}");
            for (index, (now, then)) in after.plant.organs.iter().zip(&before.plant.organs).enumerate() {
                assert_eq!(now != then, group.organs.contains(&index), "{name}: {:?}, {index}", group.name);
            }
            let branches = after.plant.branches.iter().zip(&before.plant.branches).enumerate();
            for (index, (now, then)) in branches {
                assert_eq!(now != then, group.stalk == Some(index), "{name}: branch {index}");
            }
            let gone =
                posed(&sketch, &[PartPose { is_cut: true, turn: Quat::IDENTITY, thickness: 1.0, ..pose }]);
            assert_eq!(gone.plant.organs.len(), before.plant.organs.len() - group.organs.len(), "{name}");
        }
    }
}

#[test]
fn a_petal_turns_in_its_turned_flower() {
    let sketch = sketch("balloon_flower");
    let before = built(&sketch);
    let all = groups(&before);
    let flower = all.iter().find(|group| group.is_flower).unwrap();
    let petal = all.iter().find(|group| !group.is_flower && group.flower == flower.flower).unwrap();
    let [turn, other] =
        [(Vec3::X, 0.5), (Vec3::Y, 0.9)].map(|(axis, angle)| Quat::from_axis_angle(axis, angle));
    let poses = [
        PartPose { turn, ..PartPose::still(flower.name) },
        PartPose { turn: other, ..PartPose::still(petal.name) },
    ];
    let v = |built: &Built| match &built.plant.organs[petal.organs[0]].shape {
        Shape::Blade(blade) => blade.v,
        shape => panic!("{shape:?} is no blade"),
    };
    for poses in [poses, [poses[1], poses[0]]] {
        let both = posed(&sketch, &poses);
        assert!(v(&both).distance(turn * other * v(&before)) < 1e-5);
        let names = PartNames::new(&both.provenance);
        let petal = groups(&both).into_iter().find(|group| group.name == petal.name).unwrap();
        let frame = petal.frame(&both.plant, &names, &both.wood.posed);
        assert!(
            frame.foot.angle_between(turn * other) < 1e-3 && frame.parent_turn.angle_between(turn) < 1e-3
        );
        assert!(frame.stood.distance(petal.base) < 1e-5, "it was not moved along");
    }
}

#[test]
fn a_pot_moves_over_the_ground_with_its_earth() {
    let sketch = sketch("freehand_house_plant");
    let before = built(&sketch);
    let pot = groups(&before).into_iter().find(|group| is_of(&before, group, OrganKind::Pot)).unwrap();
    let after =
        posed(&sketch, &[PartPose { shift: Vec3::new(50.0, 30.0, -20.0), ..PartPose::still(pot.name) }]);
    let way = Vec3::new(50.0, 0.0, -20.0) * before.provenance.world_from_canvas.scale;
    for part in [OrganPart::Pot, OrganPart::Soil] {
        let at =
            |built: &Built| built.plant.organs.iter().find(|organ| organ.role.part == part).unwrap().base();
        assert!((at(&after) - at(&before)).distance(way) < 1e-5, "{part:?}");
    }
}

#[test]
fn a_leaf_that_grew_is_found_again_where_others_grew() {
    let mut sketch = in_space();
    (sketch.species, sketch.part_poses) = (Some("maple".to_owned()), [].into());
    sketch.params.insert("growth.years".to_owned(), 5.0.into());
    let before = built(&sketch);
    let all = groups(&before);
    let leaf = all.iter().rev().find(|group| is_of(&before, group, OrganKind::Leaf)).unwrap();
    let names: std::collections::BTreeSet<_> = all.iter().map(|group| group.name).collect();
    assert_eq!(names.len(), all.len(), "each has its own name");
    let pose = PartPose { thickness: 2.0, ..PartPose::still(leaf.name) };
    let length = |organ: &Organ| match &organ.shape {
        Shape::Blade(blade) => blade.v.length(),
        shape => panic!("{shape:?} is no blade"),
    };
    // Other leaves, more of them, and later in the year.
    for (key, value) in
        [("habit.leaf.length", 0.09), ("habit.leaf.per_internode", 3.0), ("growth.years", 5.0)]
    {
        let mut other = sketch.clone();
        other.params.insert(key.to_owned(), value.into());
        let (still, larger) = (built(&other), posed(&other, &[pose]));
        let changed = larger.plant.organs.iter().zip(&still.plant.organs).filter(|(now, then)| now != then);
        let changed: Vec<_> = changed.collect();
        assert!(!changed.is_empty(), "{key}");
        for (now, then) in changed {
            assert!((length(now) / length(then) - 2.0).abs() < 1e-4, "{key}");
        }
    }
    // A bough that is turned takes it along.
    let bough = before.plant.branches[leaf.on.unwrap()].clone();
    let bough = PartNames::new(&before.provenance).of(bough.origin).unwrap();
    let turn = Quat::from_axis_angle(Vec3::Z, 0.8);
    let slide = PartPose { shift: Vec3::Y * 4.0, ..pose };
    let both = posed(&sketch, &[slide, PartPose { turn, ..PartPose::still(bough) }]);
    let index = leaf.organs[0];
    let branch = &both.plant.branches[both.plant.organs[index].branch.unwrap()];
    let (axis, radius) = branch.axis_at(both.plant.organs[index].base());
    assert!(
        axis.distance(both.plant.organs[index].base()) < 2.0 * radius.max(0.004),
        "it stands on its twig"
    );
}

#[test]
fn a_flower_that_was_turned_in_the_window_stays_turned() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/painted_flower.penstemon");
    let sketch = sketch::read(&path).unwrap().0;
    let (turned, still) = (built(&sketch), built(&Sketch { part_poses: [].into(), ..sketch.clone() }));
    assert_eq!(turned.remarks, []);
    let axis = |built: &Built| built.plant.flowers[0].cone.axis;
    assert!(axis(&turned).angle_between(axis(&still)) > 0.02, "the names of drawn flowers are kept in files");
    assert_eq!(turned.plant.flowers[1..], still.plant.flowers[1..]);
}
