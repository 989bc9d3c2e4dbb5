//! Branches and leaves are grafted onto other branches in the view of the plant, undone and saved.

use crate::app::action::Action;
use crate::app::editor::Editor;
use crate::app::editor::test_window::{build, drag, frame, with_sketch};
use crate::app::pose_drag::PoseDrag;
use crate::geom::polyline;
use crate::model::pick::{Element, pick};
use crate::pen::PenTool;
use crate::plant::{Branch, Organ, OrganKind, Origin, Shape};
use crate::sketch::json;
use glam::{DVec2, Vec3};

/// Where branches are seen and hit, each by its place in the plant: at a share of their points.
fn seen(editor: &Editor, share: f32, is_it: impl Fn(&Branch) -> bool) -> Vec<(usize, DVec2, Vec3)> {
    let built = editor.built().unwrap();
    let place = |(index, branch): (usize, &Branch)| {
        let point = branch.points[((branch.points.len() - 1) as f32 * share) as usize];
        let at = editor.plant.seen_at(point)?;
        let hit = pick(&built.model, &built.plant, &editor.plant.ray(editor.plant.place(at))?)?;
        (hit.element == Element::Branch(index)).then_some((index, at, point))
    };
    built.plant.branches.iter().enumerate().filter(|(_, branch)| is_it(branch)).filter_map(place).collect()
}

/// How far a place is from the axis of the branch of an origin, metres.
fn from_axis(editor: &Editor, origin: Origin, place: Vec3) -> f32 {
    let branches = &editor.built().unwrap().plant.branches;
    let branch = branches.iter().find(|branch| branch.origin == origin).unwrap();
    branch.axis_at(place).0.distance(place)
}

#[test]
fn a_grown_twig_is_grafted_onto_the_branch_under_the_pen() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = with_sketch(&home, "freehand_tree");
    let before = editor.built().unwrap().clone();
    editor.perform(Action::PoseParts(true));
    editor.perform(Action::PoseBy(PoseDrag::Graft));
    frame(&mut editor, &egui);
    let branches = &before.plant.branches;
    let is_grown = |branch: &Branch| matches!(branch.origin, Origin::Grown(_));
    let carries = |index: usize| branches.iter().any(|branch| branch.parent == Some(index));
    let twigs = seen(&editor, 0.5, is_grown);
    let (twig, from, _) = twigs.into_iter().find(|(index, ..)| !carries(*index)).unwrap();
    let boughs = seen(&editor, 0.6, |branch| branch.level <= 1 && is_grown(branch));
    let other = |index: usize| Some(index) != branches[twig].parent && index != twig;
    let (bough, to, place) = boughs.into_iter().find(|(index, ..)| other(*index)).unwrap();
    drag(&mut editor, PenTool::Pen, from, to);
    build(&mut editor);
    let pose = editor.sketch().part_poses[0];
    assert_eq!(editor.built().unwrap().names.of(branches[twig].origin), Some(pose.part));
    assert_eq!(editor.built().unwrap().names.of(branches[bough].origin), Some(pose.graft.unwrap().onto));
    let after = editor.built().unwrap().clone();
    after.plant.check_invariants().unwrap();
    let grafted = after.plant.branches.iter().find(|branch| branch.origin == branches[twig].origin).unwrap();
    let parent = &after.plant.branches[grafted.parent.unwrap()];
    assert_eq!(parent.origin, branches[bough].origin);
    let reach = 12.0 * branches[bough].radii[0];
    assert!(grafted.points[0].distance(place) < reach, "where it was dropped");
    assert!(from_axis(&editor, parent.origin, grafted.points[0]) < branches[bough].radii[0] + 1e-4);
    assert!(grafted.radii[0] <= parent.radii[0]);
    let again = json::write(editor.sketch());
    assert_eq!(&crate::sketch::from_bytes(again.as_bytes(), "a.penstemon").unwrap().0, editor.sketch());
    assert!(again.contains("\"version\": 13"));
    editor.perform(Action::Undo);
    assert!(editor.sketch().part_poses.is_empty(), "one step");
    build(&mut editor);
    assert_eq!(editor.built().unwrap().model, before.model, "as it grew, to the last bit");
}

/// The branch of an origin.
fn branch(editor: &Editor, origin: Origin) -> Branch {
    let branches = &editor.built().unwrap().plant.branches;
    branches.iter().find(|branch| branch.origin == origin).unwrap().clone()
}

#[test]
fn a_drawn_branch_is_grafted_with_its_leaves_and_drawn_out_straight() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = with_sketch(&home, "plumeria");
    editor.perform(Action::PoseParts(true));
    editor.perform(Action::PoseBy(PoseDrag::Graft));
    frame(&mut editor, &egui);
    let before = editor.built().unwrap().clone();
    let branches = &before.plant.branches;
    let is_drawn = |branch: &Branch| branch.origin.is_drawn();
    let places = seen(&editor, 0.5, is_drawn);
    // The last of all, which carries none, onto the first that it does not stand on.
    let (twig, from, _) = *places.last().unwrap();
    let is_other = |index: usize| index != twig && Some(index) != branches[twig].parent;
    let (other, to, _) = *places.iter().find(|(index, ..)| is_other(*index)).unwrap();
    let (twig, other) = (branches[twig].clone(), branches[other].origin);
    let moved_organs = |editor: &Editor| {
        let organs = &editor.built().unwrap().plant.organs;
        organs.iter().zip(&before.plant.organs).filter(|(now, then)| now.base() != then.base()).count()
    };
    drag(&mut editor, PenTool::Pen, from, to);
    build(&mut editor);
    let grafted = branch(&editor, twig.origin);
    assert!(from_axis(&editor, other, grafted.points[0]) < 1e-4 + branch(&editor, other).radii[0]);
    assert!(moved_organs(&editor) > 0, "what is on it goes along");
    let (length, bowed) = (polyline::length(&grafted.points), chord(&grafted));
    editor.perform(Action::StraightenPart(1.0));
    build(&mut editor);
    let straight = branch(&editor, twig.origin);
    assert_eq!(straight.points[0], grafted.points[0], "its base stays");
    assert!((polyline::length(&straight.points) / length - 1.0).abs() < 1e-3);
    assert!(
        chord(&straight) > 0.999 * length && chord(&straight) > bowed,
        "{} of {length}",
        chord(&straight)
    );
    assert_eq!(editor.pose_state().straight, Some(1.0));
    editor.perform(Action::ResetPose);
    build(&mut editor);
    assert_eq!(editor.built().unwrap().model, before.model, "as it was drawn, to the last bit");
}

#[test]
fn a_grown_branch_is_made_younger_and_old_again() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = with_sketch(&home, "freehand_tree");
    editor.perform(Action::PoseParts(true));
    frame(&mut editor, &egui);
    let before = editor.built().unwrap().clone();
    let branches = &before.plant.branches;
    let mut carried = vec![0; branches.len()];
    for (index, branch) in branches.iter().enumerate().rev() {
        branch.parent.into_iter().for_each(|parent| carried[parent] += carried[index] + 1);
    }
    let grown = (0..branches.len()).filter(|index| matches!(branches[*index].origin, Origin::Grown(_)));
    let bough = grown.max_by_key(|index| carried[*index]).unwrap();
    editor.posing.last = before.names.of(branches[bough].origin);
    let state = editor.pose_state();
    assert!(state.younger == Some(0) && state.years > 2, "{state:?}");
    // In the last years of a full crown next to nothing grew.
    let younger = state.years - 1;
    editor.perform(Action::MakePartYounger(younger));
    build(&mut editor);
    let after = editor.built().unwrap().clone();
    after.plant.check_invariants().unwrap();
    assert!(
        after.plant.branches.len() < branches.len(),
        "{} of {}",
        after.plant.branches.len(),
        branches.len()
    );
    assert_eq!(editor.pose_state().younger, Some(younger));
    let text = json::write(editor.sketch());
    assert!(text.contains("\"version\": 14") && text.contains(&format!("\"younger\": {younger}")));
    assert_eq!(&crate::sketch::from_bytes(text.as_bytes(), "a.penstemon").unwrap().0, editor.sketch());
    editor.perform(Action::MakePartYounger(0));
    build(&mut editor);
    assert!(editor.sketch().part_poses.is_empty());
    assert_eq!(editor.built().unwrap().model, before.model, "as it grew, to the last bit");
}

/// From the base of a branch straight to its end, metres.
fn chord(branch: &Branch) -> f32 {
    branch.points[0].distance(*branch.points.last().unwrap())
}

#[test]
fn a_drawn_leaf_is_grafted_onto_another_branch() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = with_sketch(&home, "plumeria");
    editor.perform(Action::PoseParts(true));
    editor.perform(Action::PoseBy(PoseDrag::Graft));
    frame(&mut editor, &egui);
    let before = editor.built().unwrap().clone();
    let is_leaf = |organ: &Organ| organ.kind() == OrganKind::Leaf && organ.origin.is_drawn();
    let leaf_at = |(index, organ): (usize, &Organ)| {
        let Shape::Blade(blade) = &organ.shape else { return None };
        let at = editor
            .plant
            .seen_at(before.plant.templates.resolve(blade).tip_at_rest().lerp(blade.base, 0.4))?;
        let ray = editor.plant.ray(editor.plant.place(at))?;
        let hit = pick(&before.model, &before.plant, &ray)?;
        (hit.element == Element::Organ(index) && editor.is_organ_meant(hit.element)).then_some((index, at))
    };
    let organs = before.plant.organs.iter().enumerate().filter(|(_, organ)| is_leaf(organ));
    let (leaf, from) = organs.filter_map(leaf_at).next().expect("a leaf is seen");
    let places = seen(&editor, 0.5, |branch| branch.origin.is_drawn());
    let (other, to, _) =
        *places.iter().find(|(index, ..)| Some(*index) != before.plant.organs[leaf].branch).unwrap();
    drag(&mut editor, PenTool::Pen, from, to);
    build(&mut editor);
    let origin = before.plant.organs[leaf].origin;
    let after = editor.built().unwrap();
    let now = after.plant.organs.iter().find(|organ| organ.origin == origin).unwrap();
    let onto = &before.plant.branches[other];
    assert!(from_axis(&editor, onto.origin, now.base()) < 2.0 * onto.radii[0], "at the other branch");
    assert_eq!(editor.sketch().part_poses.len(), 1);
    assert_eq!(editor.pose_state().straight, None, "leaves are not straightened");
}
