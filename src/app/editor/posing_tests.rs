//! Branches are turned and bent in the view of the plant by any pointer, undone, saved and given back.

use super::*;
use crate::app::editor::test_window::{build, drag, frame, seen_organ, touch, with_sketch};
use crate::pen::{PenPhase, PenTool};
use crate::plant::{Branch, Organ, OrganKind, Origin, Shape};
use crate::sketch::json;

/// The stem that ends in a flower and stands on the ground.
fn stem(editor: &Editor) -> Branch {
    editor.built().unwrap().plant.branches.iter().find(|branch| branch.parent.is_none()).unwrap().clone()
}

/// Drags the stem at its middle by so much.
fn drag_stem(editor: &mut Editor, tool: PenTool, by: DVec2) -> (DVec2, Vec3) {
    let stem = stem(editor);
    let grip = stem.points[stem.points.len() / 2];
    let from = editor.plant.seen_at(grip).unwrap();
    drag(editor, tool, from, from + by);
    (from, grip)
}

#[test]
fn any_pointer_turns_a_stem_with_all_that_is_on_it_as_one_step() {
    for tool in [PenTool::Pen, PenTool::Mouse, PenTool::Finger(2)] {
        let home = tempfile::tempdir().unwrap();
        let (mut editor, egui) = with_sketch(&home, "balloon_flower");
        let before = editor.built().unwrap().clone();
        editor.key(egui::Key::J, egui::Modifiers::NONE, true, false);
        frame(&mut editor, &egui);
        let camera = editor.plant.camera();
        let (from, grip) = drag_stem(&mut editor, tool, DVec2::new(60.0, 10.0));
        assert_eq!(editor.plant.camera(), camera, "{tool:?}: a branch is dragged, not the camera");
        build(&mut editor);
        frame(&mut editor, &egui);
        let (built, stem) = (editor.built().unwrap().clone(), stem(&editor));
        assert_eq!(stem.points[0], before.plant.branches[0].points[0], "{tool:?}: its base stays");
        let now = built.wood.posed.motion_at(&stem, stem.points[stem.points.len() / 2]).unwrap().point(grip);
        let seen = camera.project(now).map(|at| editor.plant.window_place(at)).unwrap();
        // As far as its length allows.
        assert!(seen.distance(from + DVec2::new(60.0, 10.0)) < 12.0, "{tool:?}: {seen} and {from}");
        let apex = |built: &crate::pipeline::Built| built.plant.flowers[0].cone.apex;
        assert!(apex(&built).distance(apex(&before)) > 0.01, "{tool:?}: the flower goes along");
        assert_eq!(built.plant.organs.len(), before.plant.organs.len());
        let again = json::write(editor.sketch());
        assert_eq!(&crate::sketch::from_bytes(again.as_bytes(), "a.penstemon").unwrap().0, editor.sketch());
        editor.perform(Action::Undo);
        assert!(editor.sketch().part_poses.is_empty(), "{tool:?}: one step");
        build(&mut editor);
        assert_eq!(editor.built().unwrap().model, before.model, "{tool:?}: as before, to the last bit");
    }
}

#[test]
fn a_stem_is_bent_and_given_back() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _) = with_sketch(&home, "balloon_flower");
    let before = stem(&editor);
    editor.perform(Action::PoseParts(true));
    editor.perform(Action::PoseBy(PoseDrag::Bend));
    let camera = editor.plant.camera();
    let (from, grip) = drag_stem(&mut editor, PenTool::Pen, DVec2::new(40.0, 0.0));
    build(&mut editor);
    let bent = stem(&editor);
    let (_, arc) = polyline::nearest(&before.points, grip).unwrap();
    let arcs = polyline::arc_lengths(bent.points.iter().copied());
    let held = polyline::interpolate(&bent.points, polyline::locate(&arcs, arc));
    let seen = camera.project(held).map(|at| editor.plant.window_place(at)).unwrap();
    let off = seen.distance(from + DVec2::new(40.0, 0.0));
    assert!(off < 12.0, "what is held follows the pointer: {off} pixels off");
    assert!((polyline::length(&bent.points) / polyline::length(&before.points) - 1.0).abs() < 1e-3);
    let begins = |branch: &Branch| (branch.points[1] - branch.points[0]).normalize();
    let ends = |branch: &Branch| {
        let [.., a, b] = branch.points.as_slice() else { panic!("no line") };
        (*b - *a).normalize()
    };
    assert!(begins(&bent).angle_between(begins(&before)) < 0.1, "it stays at its base");
    assert!(ends(&bent).angle_between(ends(&before)) > 0.2, "and turns at its end");
    assert!(editor.pose_state().posed);
    editor.perform(Action::ResetPose);
    assert!(editor.sketch().part_poses.is_empty());
}

#[test]
fn branches_drawn_on_posed_wood_go_along_with_it() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = with_sketch(&home, "balloon_flower");
    editor.perform(Action::PoseParts(true));
    drag_stem(&mut editor, PenTool::Pen, DVec2::new(60.0, 10.0));
    build(&mut editor);
    frame(&mut editor, &egui);
    editor.perform(Action::DrawInSpace(true));
    let stem_now = stem(&editor);
    let from = editor.plant.seen_at(stem_now.points[stem_now.points.len() / 3]).unwrap();
    let (to, camera) = (from + DVec2::new(80.0, -40.0), editor.plant.camera());
    drag(&mut editor, PenTool::Pen, from, to);
    build(&mut editor);
    let stroke = editor.sketch().in_space().next().unwrap().id;
    let branch = |editor: &Editor| {
        let built = editor.built().unwrap();
        let drawn = built.plant.branches.iter().find(|b| built.provenance.stroke(b.origin) == Some(stroke));
        drawn.unwrap().clone()
    };
    let end = |branch: &Branch| *branch.points.last().unwrap();
    let seen = camera.project(end(&branch(&editor))).map(|at| editor.plant.window_place(at)).unwrap();
    assert!(seen.distance(to) < 3.0, "it ends under the pen: {seen}, {to}");
    // Without the pose it stands where the stem is then.
    let posed = end(&branch(&editor));
    editor.perform(Action::ResetPose);
    editor.change(Change::part_poses([].into()));
    build(&mut editor);
    let (rest, straight) = (branch(&editor), stem(&editor));
    assert!(end(&rest).distance(posed) > 0.01);
    let foot = polyline::nearest(&straight.points, rest.points[0]).unwrap().0;
    assert!(foot < 1e-3, "on the stem: {foot}");
}

/// Grown branches that are seen, each by its place in the plant and where it is hit in the window.
fn seen_grown(editor: &Editor) -> Vec<(usize, DVec2)> {
    let built = editor.built().unwrap();
    let seen = |(index, branch): (usize, &Branch)| {
        let at = editor.plant.seen_at(branch.points[branch.points.len() * 2 / 3])?;
        let hit = pick(&built.model, &built.plant, &editor.plant.ray(editor.plant.place(at))?)?;
        (hit.element == Element::Branch(index) && matches!(branch.origin, Origin::Grown(_)))
            .then_some((index, at))
    };
    built.plant.branches.iter().enumerate().filter_map(seen).collect()
}

/// Taps, and waits until it is no double click.
fn tap(editor: &mut Editor, egui: &egui::Context, at: DVec2) {
    touch(editor, (PenPhase::Down, PenTool::Mouse), at, 0.5);
    touch(editor, (PenPhase::Up, PenTool::Mouse), at, 0.0);
    std::thread::sleep(std::time::Duration::from_millis(500));
    frame(editor, egui);
}

#[test]
fn grown_branches_are_chosen_turned_thickened_and_cut_off() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = with_sketch(&home, "freehand_tree");
    let before = editor.built().unwrap().clone();
    editor.perform(Action::PoseParts(true));
    frame(&mut editor, &egui);
    let deep = |(index, _): &(usize, DVec2)| before.plant.branches[*index].level;
    let (index, at) = seen_grown(&editor).into_iter().max_by_key(deep).unwrap();
    let parts = editor.parts_under(Element::Branch(index));
    let name = parts[0];
    // A tap chooses it, another one what it grows on.
    tap(&mut editor, &egui, at);
    assert_eq!(editor.posing.last, Some(name));
    tap(&mut editor, &egui, at);
    let parent = before.plant.branches[index].parent.unwrap();
    assert_eq!(editor.posing.last, Some(parts[1]));
    let branch = |editor: &Editor, index: usize| editor.built().unwrap().plant.branches[index].clone();
    // A drag on the twig moves the bough that is chosen.
    if let Some(PartName::Grown(_)) = editor.posing.last {
        drag(&mut editor, PenTool::Pen, at, at + DVec2::new(30.0, 10.0));
        build(&mut editor);
        let (rest, now) = (&before.plant.branches[parent], branch(&editor, parent));
        assert_eq!(rest.points[0], now.points[0], "its base stays");
        assert_ne!(rest.points, now.points);
        editor.perform(Action::Undo);
        assert!(editor.sketch().part_poses.is_empty(), "one step");
        build(&mut editor);
        assert_eq!(editor.built().unwrap().model, before.model);
    }
    editor.posing.let_go();
    drag(&mut editor, PenTool::Finger(1), at, at + DVec2::new(-24.0, 6.0));
    assert_eq!(editor.sketch().part_poses[0].part, name, "without a choice the twig itself");
    let turn = editor.sketch().part_poses[0].turn;
    [0.8, 0.6].into_iter().for_each(|thickness| editor.perform(Action::SizePart(thickness)));
    editor.perform(Action::Undo);
    let pose = editor.sketch().part_poses[0];
    assert_eq!((pose.turn, pose.thickness), (turn, 1.0), "a drag and a slider are a step each");
    editor.perform(Action::SizePart(0.5));
    build(&mut editor);
    frame(&mut editor, &egui);
    assert!(branch(&editor, index).radii[1] < 0.6 * before.plant.branches[index].radii[1]);
    assert_eq!(editor.pose_state().size, Some(0.5));
    let again = json::write(editor.sketch());
    assert_eq!(&crate::sketch::from_bytes(again.as_bytes(), "a.penstemon").unwrap().0, editor.sketch());
    editor.key(egui::Key::Delete, egui::Modifiers::NONE, true, false);
    build(&mut editor);
    let left = editor.built().unwrap().plant.branches.len();
    assert!(left < before.plant.branches.len(), "it is cut off");
    assert!(!editor.can_take_part_away());
    editor.perform(Action::ResetPose);
    build(&mut editor);
    assert_eq!(editor.built().unwrap().model, before.model, "as it grew");
}

#[test]
fn a_drawn_branch_is_cut_off_with_its_stroke() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _) = with_sketch(&home, "balloon_flower");
    let strokes = editor.sketch().strokes.len();
    editor.perform(Action::PoseParts(true));
    drag_stem(&mut editor, PenTool::Pen, DVec2::new(40.0, 0.0));
    editor.key(egui::Key::Delete, egui::Modifiers::NONE, true, false);
    assert_eq!(editor.sketch().strokes.len(), strokes - 1);
    editor.perform(Action::Undo);
    assert_eq!(editor.sketch().strokes.len(), strokes);
}

#[test]
fn the_ring_turns_the_chosen_branch_about_the_line_of_sight() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = with_sketch(&home, "balloon_flower");
    editor.perform(Action::PoseParts(true));
    drag_stem(&mut editor, PenTool::Pen, DVec2::new(20.0, 0.0));
    build(&mut editor);
    frame(&mut editor, &egui);
    let before = stem(&editor);
    let centre = editor.plant.seen_at(before.points[0]).unwrap();
    let radius = 64.0 * editor.plant.pixels_per_point();
    let at = |degrees: f64| centre + DVec2::from_angle(degrees.to_radians()) * radius;
    touch(&mut editor, (PenPhase::Down, PenTool::Pen), at(-45.0), 0.5);
    (1..=30).for_each(|k| touch(&mut editor, (PenPhase::Move, PenTool::Pen), at(-45.0 + f64::from(k)), 0.5));
    touch(&mut editor, (PenPhase::Up, PenTool::Pen), at(-15.0), 0.0);
    build(&mut editor);
    frame(&mut editor, &egui);
    let seen = |editor: &Editor, stem: &Branch| {
        editor.plant.seen_at(*stem.points.last().unwrap()).unwrap()
            - editor.plant.seen_at(stem.points[0]).unwrap()
    };
    let turned = seen(&editor, &before).angle_to(seen(&editor, &stem(&editor))).to_degrees();
    // The stem is not flat before the viewer, so its picture turns a little otherwise.
    assert!((turned - 30.0).abs() < 3.0, "{turned}");
    editor.perform(Action::Undo);
    build(&mut editor);
    assert_eq!(stem(&editor).points, before.points, "one step");
}

fn blade(editor: &Editor, index: usize) -> (Vec3, Vec3) {
    let Shape::Blade(blade) = &editor.built().unwrap().plant.organs[index].shape else { panic!("no blade") };
    (blade.base, blade.v)
}

#[test]
fn a_drawn_leaf_is_turned_slid_along_its_stem_made_larger_and_taken_away() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = with_sketch(&home, "balloon_flower");
    let before = editor.built().unwrap().clone();
    editor.perform(Action::PoseParts(true));
    frame(&mut editor, &egui);
    let is_leaf = |organ: &Organ| organ.kind() == OrganKind::Leaf && organ.origin.is_drawn();
    let (leaf, at) = seen_organ(&editor, is_leaf);
    let (base, v) = blade(&editor, leaf);
    drag(&mut editor, PenTool::Pen, at, at + DVec2::new(0.0, -40.0));
    build(&mut editor);
    frame(&mut editor, &egui);
    let (turned_base, turned_v) = blade(&editor, leaf);
    assert!(turned_v.angle_between(v) > 0.1 && (turned_v.length() / v.length() - 1.0).abs() < 1e-4);
    assert!(editor.pose_state().is_organ && editor.pose_state().posed);
    assert_eq!(editor.sketch().part_poses.len(), 1);
    // Along its stem.
    editor.perform(Action::PoseBy(PoseDrag::Move));
    let (_, at) = seen_organ(&editor, is_leaf);
    drag(&mut editor, PenTool::Finger(1), at, at + DVec2::new(3.0, -30.0));
    build(&mut editor);
    frame(&mut editor, &egui);
    let (slid, _) = blade(&editor, leaf);
    let stem = &editor.built().unwrap().plant.branches[0];
    let from_stem = |at: Vec3| stem.axis_at(at).0.distance(at);
    assert!(slid.y > turned_base.y + 1e-3, "{slid} and {turned_base}");
    assert!(from_stem(slid) < from_stem(turned_base) + 1e-3);
    editor.perform(Action::SizePart(1.5));
    build(&mut editor);
    assert!((blade(&editor, leaf).1.length() / v.length() - 1.5).abs() < 1e-3);
    let again = json::write(editor.sketch());
    assert_eq!(&crate::sketch::from_bytes(again.as_bytes(), "a.penstemon").unwrap().0, editor.sketch());
    editor.perform(Action::ResetPose);
    build(&mut editor);
    assert_eq!((blade(&editor, leaf), &editor.built().unwrap().model), ((base, v), &before.model));
    let strokes = editor.sketch().strokes.len();
    editor.key(egui::Key::Delete, egui::Modifiers::NONE, true, false);
    assert_eq!(editor.sketch().strokes.len(), strokes - 1);
}

#[test]
fn a_drawn_flower_turns_as_a_whole_and_another_tap_chooses_a_petal_of_it() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = with_sketch(&home, "balloon_flower");
    let before = editor.built().unwrap().clone();
    editor.perform(Action::PoseParts(true));
    frame(&mut editor, &egui);
    let (petal, at) =
        seen_organ(&editor, |organ| organ.kind() == OrganKind::Petal && organ.origin.is_drawn());
    tap(&mut editor, &egui, at);
    let flower = editor.posing.last.unwrap();
    tap(&mut editor, &egui, at);
    let chosen = editor.posing.last.unwrap();
    assert_eq!(editor.strokes_of(chosen).len(), 1);
    assert!(editor.strokes_of(flower).len() > 1);
    editor.posing.let_go();
    drag(&mut editor, PenTool::Mouse, at, at + DVec2::new(30.0, 20.0));
    assert_eq!(editor.sketch().part_poses[0].part, flower, "the flower, not its petal");
    build(&mut editor);
    let built = editor.built().unwrap().clone();
    let index = before.plant.organs[petal].flower.unwrap();
    let axis = |built: &crate::pipeline::Built| built.plant.flowers[index].cone.axis;
    assert!(axis(&built).angle_between(axis(&before)) > 0.05);
    let petals = |built: &crate::pipeline::Built| -> Vec<Vec3> {
        let of_flower = built.plant.organs.iter().filter(|organ| organ.flower == Some(index));
        of_flower.map(|organ| organ.base() - built.plant.flowers[index].cone.apex).collect()
    };
    let turn = built.wood.posed.clone();
    assert_ne!(turn, before.wood.posed);
    for (now, then) in petals(&built).iter().zip(petals(&before)) {
        assert!((now.length() - then.length()).abs() < 1e-5, "all of it keeps its shape");
    }
    let strokes = editor.sketch().strokes.len();
    editor.perform(Action::TakeAwayPart);
    assert_eq!(editor.sketch().strokes.len(), strokes - editor_strokes(&before, index));
}

/// How many strokes drew a flower.
fn editor_strokes(built: &crate::pipeline::Built, flower: usize) -> usize {
    let petals = built.plant.organs.iter().filter(|organ| organ.flower == Some(flower));
    let strokes = petals.filter_map(|petal| built.provenance.stroke(petal.origin));
    strokes.collect::<std::collections::HashSet<_>>().len()
}
