//! Leaves become flowers, and flowers leaves, by a drag onto another; undone and saved.

use super::*;
use crate::app::action::Action;
use crate::app::editor::test_window::{build, drag, frame, seen_organ, with_sketch};
use crate::app::pose_drag::PoseDrag;
use crate::pen::PenTool;
use crate::plant::{FinishedPlant, Organ, OrganKind};
use crate::sketch::{Remark, json};

fn opened(home: &tempfile::TempDir, name: &str) -> (Editor, egui::Context) {
    let (mut editor, egui) = with_sketch(home, name);
    editor.perform(Action::PoseParts(true));
    editor.perform(Action::PoseBy(PoseDrag::Replace));
    frame(&mut editor, &egui);
    (editor, egui)
}

fn is_leaf(organ: &Organ) -> bool {
    organ.kind() == OrganKind::Leaf && organ.flower.is_none()
}

fn leaves(plant: &FinishedPlant) -> usize {
    plant.organs.iter().filter(|organ| is_leaf(organ)).count()
}

#[test]
fn a_leaf_becomes_a_flower_where_it_stood_and_a_flower_a_leaf() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = opened(&home, "balloon_flower");
    let before = editor.built().unwrap().clone();
    let (leaf, on_leaf) = seen_organ(&editor, is_leaf);
    let (petal, on_flower) = seen_organ(&editor, |organ| organ.flower.is_some());
    let flower = before.plant.organs[petal].flower.unwrap();
    let base = before.plant.organs[leaf].base();
    drag(&mut editor, PenTool::Pen, on_leaf, on_flower);
    build(&mut editor);
    frame(&mut editor, &egui);
    let after = editor.built().unwrap().clone();
    after.plant.check_invariants().unwrap();
    assert_eq!(after.model.check_invariants(), Ok(()));
    assert_eq!(after.remarks, before.remarks);
    assert_eq!(after.plant.flowers.len(), before.plant.flowers.len() + 1);
    assert_eq!(leaves(&after.plant), leaves(&before.plant) - 1);
    let made = after.plant.flowers.last().unwrap();
    assert!(made.cone.apex.distance(base) < 1e-4, "where the leaf stood");
    assert!((made.reach / before.plant.flowers[flower].reach - 1.0).abs() < 1e-4, "as large");
    let of = |plant: &FinishedPlant, flower: usize| {
        plant.organs.iter().filter(|organ| organ.flower == Some(flower)).count()
    };
    assert_eq!(of(&after.plant, after.plant.flowers.len() - 1), of(&before.plant, flower));
    // It has the name of the leaf: it is turned and made larger like that.
    let pose = editor.sketch().part_poses[0];
    assert_eq!(after.names.of(made.origin), Some(pose.part));
    editor.perform(Action::SizePart(0.5));
    build(&mut editor);
    let smaller = editor.built().unwrap().plant.flowers.last().unwrap().reach;
    assert!((smaller / made.reach - 0.5).abs() < 1e-3);
    let text = json::write(editor.sketch());
    assert!(text.contains("\"version\": 14") && text.contains("\"like\": {"));
    assert_eq!(&crate::sketch::from_bytes(text.as_bytes(), "a.penstemon").unwrap().0, editor.sketch());
    // Taken away, it goes with the stroke of the leaf.
    let strokes = editor.sketch().strokes.len();
    editor.perform(Action::TakeAwayPart);
    build(&mut editor);
    assert_eq!(editor.sketch().strokes.len(), strokes - 1);
    assert_eq!(editor.built().unwrap().plant.flowers.len(), before.plant.flowers.len());
    editor.perform(Action::Undo);
    build(&mut editor);
    editor.perform(Action::ResetPose);
    build(&mut editor);
    assert_eq!(editor.built().unwrap().model, before.model, "as it was drawn, to the last bit");
    // The other way round.
    frame(&mut editor, &egui);
    drag(&mut editor, PenTool::Finger(1), on_flower, on_leaf);
    build(&mut editor);
    let after = editor.built().unwrap().clone();
    after.plant.check_invariants().unwrap();
    assert_eq!(after.plant.flowers.len(), before.plant.flowers.len() - 1);
    assert_eq!(leaves(&after.plant), leaves(&before.plant) + 1);
    // A flower has the name of all its strokes, and what it became is cut off by that.
    let pose = editor.sketch().part_poses[0];
    editor.change(crate::sketch::Change::part_poses([PartPose { is_cut: true, ..pose }].into()));
    build(&mut editor);
    let after = editor.built().unwrap().clone();
    assert_eq!(leaves(&after.plant), leaves(&before.plant), "no copy of what is taken away");
    assert_eq!(after.plant.flowers.len(), before.plant.flowers.len() - 1);
}

#[test]
fn all_that_are_chosen_become_others_and_what_has_no_pattern_rests() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = opened(&home, "balloon_flower");
    let before = editor.built().unwrap().clone();
    let names: Vec<PartName> = {
        let organs = before.plant.organs.iter().filter(|organ| is_leaf(organ));
        organs.filter_map(|organ| before.names.of(organ.origin)).collect()
    };
    let (leaf, on_leaf) = seen_organ(&editor, is_leaf);
    let (_, on_flower) = seen_organ(&editor, |organ| organ.flower.is_some());
    editor.posing.last = before.names.of(before.plant.organs[leaf].origin);
    editor.posing.others = names.iter().copied().filter(|name| Some(*name) != editor.posing.last).collect();
    drag(&mut editor, PenTool::Pen, on_leaf, on_flower);
    build(&mut editor);
    frame(&mut editor, &egui);
    let after = editor.built().unwrap().clone();
    assert_eq!(after.plant.flowers.len(), before.plant.flowers.len() + names.len());
    assert_eq!(leaves(&after.plant), leaves(&before.plant) - names.len());
    // A pattern that is not there: the leaf stays, and says so.
    let pose = editor.sketch().part_poses[0];
    let nothing = PartPose { like: Some(PartName::Grown(12)), ..PartPose::still(pose.part) };
    editor.change(crate::sketch::Change::part_poses([nothing].into()));
    build(&mut editor);
    let after = editor.built().unwrap().clone();
    assert_eq!(after.plant.organs, before.plant.organs);
    let rests = |warning: &crate::sketch::Warning| warning.remark == Remark::PosesRest { poses: 1 };
    assert!(after.remarks.iter().any(rests), "{:?}", after.remarks);
}
