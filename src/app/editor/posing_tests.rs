//! Branches are turned and bent in the view of the plant by any pointer, undone, saved and given back.

use super::*;
use crate::app::editor::test_window::{build, frame, touch, with_sketch};
use crate::pen::{PenPhase, PenTool};
use crate::plant::Branch;
use crate::sketch::json;

/// The stem that ends in a flower and stands on the ground.
fn stem(editor: &Editor) -> Branch {
    editor.built().unwrap().plant.branches.iter().find(|branch| branch.parent.is_none()).unwrap().clone()
}

fn drag(editor: &mut Editor, tool: PenTool, from: DVec2, to: DVec2) {
    touch(editor, (PenPhase::Down, tool), from, 0.5);
    [0.3, 0.6, 1.0].into_iter().for_each(|t| touch(editor, (PenPhase::Move, tool), from.lerp(to, t), 0.5));
    touch(editor, (PenPhase::Up, tool), to, 0.0);
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
        let camera = editor.plant.camera();
        let (from, grip) = drag_stem(&mut editor, tool, DVec2::new(60.0, 10.0));
        assert_eq!(editor.plant.camera(), camera, "{tool:?}: a branch is dragged, not the camera");
        build(&mut editor);
        frame(&mut editor, &egui);
        let (built, stem) = (editor.built().unwrap().clone(), stem(&editor));
        assert_eq!(stem.points[0], before.plant.branches[0].points[0], "{tool:?}: its base stays");
        let now = built.wood.posed.motion_at(0, stem.points[stem.points.len() / 2]).unwrap().point(grip);
        let seen = camera.project(now).map(|at| editor.plant.window_place(at)).unwrap();
        // As far as its length allows.
        assert!(seen.distance(from + DVec2::new(60.0, 10.0)) < 12.0, "{tool:?}: {seen} and {from}");
        let apex = |built: &crate::pipeline::Built| built.plant.flowers[0].cone.apex;
        assert!(apex(&built).distance(apex(&before)) > 0.01, "{tool:?}: the flower goes along");
        assert_eq!(built.plant.organs.len(), before.plant.organs.len());
        let again = json::write(editor.sketch());
        assert_eq!(&crate::sketch::from_bytes(again.as_bytes(), "a.penstemon").unwrap().0, editor.sketch());
        editor.perform(Action::Undo);
        assert!(editor.sketch().wood_poses.is_empty(), "{tool:?}: one step");
        build(&mut editor);
        assert_eq!(editor.built().unwrap().model, before.model, "{tool:?}: as before, to the last bit");
    }
}

#[test]
fn a_stem_is_bent_and_given_back() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, _) = with_sketch(&home, "balloon_flower");
    let before = stem(&editor);
    editor.perform(Action::PoseWood(true));
    editor.perform(Action::BendWood(true));
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
    assert!(editor.sketch().wood_poses.is_empty());
}

#[test]
fn branches_drawn_on_posed_wood_go_along_with_it() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = with_sketch(&home, "balloon_flower");
    editor.perform(Action::PoseWood(true));
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
    editor.change(Change::wood_poses([].into()));
    build(&mut editor);
    let (rest, straight) = (branch(&editor), stem(&editor));
    assert!(end(&rest).distance(posed) > 0.01);
    let foot = polyline::nearest(&straight.points, rest.points[0]).unwrap().0;
    assert!(foot < 1e-3, "on the stem: {foot}");
}
