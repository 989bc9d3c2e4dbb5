//! Several parts are chosen by a loop or with Shift, and posed and taken away together.

use super::*;
use crate::app::action::Action;
use crate::app::editor::test_window::{build, frame, touch, with_sketch};
use crate::app::pose_drag::PoseDrag;
use crate::pen::{PenPhase, PenTool};
use crate::plant::{Organ, OrganKind, Origin};

/// Draws a loop through places of the window.
fn draw_loop(editor: &mut Editor, places: &[DVec2]) {
    let pen = PenTool::Pen;
    touch(editor, (PenPhase::Down, pen), places[0], 0.5);
    for ends in places.windows(2) {
        for k in 1..=4 {
            touch(editor, (PenPhase::Move, pen), ends[0].lerp(ends[1], f64::from(k) / 4.0), 0.5);
        }
    }
    touch(editor, (PenPhase::Up, pen), places[places.len() - 1], 0.0);
}

/// A loop around all that is seen.
fn around_everything(editor: &Editor) -> Vec<DVec2> {
    let built = editor.built().unwrap();
    let points = built.plant.branches.iter().flat_map(|branch| &branch.points).copied();
    let all = points.chain(built.plant.organs.iter().map(Organ::base));
    let seen: Vec<DVec2> = all.filter_map(|at| editor.plant.seen_at(at)).collect();
    let least = seen.iter().copied().reduce(DVec2::min).unwrap() - 200.0;
    let most = seen.iter().copied().reduce(DVec2::max).unwrap() + 200.0;
    [(least.x, least.y), (most.x, least.y), (most.x, most.y), (least.x, most.y)].map(DVec2::from).to_vec()
}

/// A loop around a place.
fn around(at: DVec2, radius: f64) -> Vec<DVec2> {
    (0..=8).map(|k| at + DVec2::from_angle(f64::from(k) * 0.8) * radius).collect()
}

fn chosen(editor: &Editor) -> Vec<PartName> {
    editor.chosen_parts().collect()
}

#[test]
fn a_loop_chooses_the_lowest_wood_in_it_and_not_what_that_carries() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = with_sketch(&home, "freehand_tree");
    editor.perform(Action::PoseParts(true));
    editor.perform(Action::PoseBy(PoseDrag::Choose));
    frame(&mut editor, &egui);
    let (camera, all) = (editor.plant.camera(), around_everything(&editor));
    draw_loop(&mut editor, &all);
    assert_eq!(editor.plant.camera(), camera, "the plant does not turn");
    let built = editor.built().unwrap().clone();
    let branches = &built.plant.branches;
    // Leaves are chosen where they stand on wood without a name.
    let place = |part: &PartName| built.names.branch(&built.plant, *part);
    let lowest: Vec<usize> = chosen(&editor).iter().filter_map(place).collect();
    let carries = |low: usize, of: usize| {
        let mut below = std::iter::successors(branches[of].parent, |below| branches[*below].parent);
        below.any(|below| below == low)
    };
    assert!(
        !lowest.is_empty() && lowest.len() < branches.len() / 3,
        "{} of {}",
        lowest.len(),
        branches.len()
    );
    assert!(lowest.iter().all(|of| !lowest.iter().any(|low| carries(*low, *of))), "with each goes all above");
    let widest = *lowest
        .iter()
        .max_by_key(|low| (0..branches.len()).filter(|of| carries(**low, *of)).count())
        .unwrap();
    let widest = built.names.of(branches[widest].origin).unwrap();
    // Around the end of a twig: leaves there, and no trunk.
    let twig = branches.iter().rev().find(|branch| matches!(branch.origin, Origin::Grown(_)));
    let end = editor.plant.seen_at(*twig.unwrap().points.last().unwrap()).unwrap();
    draw_loop(&mut editor, &around(end, 40.0));
    assert!(!chosen(&editor).is_empty() && !chosen(&editor).contains(&widest), "{:?}", chosen(&editor));
}

#[test]
fn leaves_in_a_loop_are_made_larger_turned_and_taken_away_as_one_step() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = with_sketch(&home, "plumeria");
    editor.perform(Action::PoseParts(true));
    editor.perform(Action::PoseBy(PoseDrag::Choose));
    frame(&mut editor, &egui);
    let before = editor.built().unwrap().clone();
    let names = |is_it: &dyn Fn(&Organ) -> bool| -> Vec<PartName> {
        let organs = before.plant.organs.iter().filter(|organ| is_it(organ));
        organs.filter_map(|organ| before.names.of(organ.origin)).collect()
    };
    let leaves = names(&|organ| organ.kind() == OrganKind::Leaf && organ.origin.is_drawn());
    assert!(leaves.len() > 3);
    // By Shift one after the other.
    leaves[..3].iter().for_each(|leaf| editor.choose_part(*leaf, true));
    assert_eq!(editor.pose_state().chosen, 3);
    editor.choose_part(leaves[1], true);
    assert_eq!(chosen(&editor), [leaves[2], leaves[0]], "a second time takes it away");
    editor.choose_part(leaves[1], true);
    editor.perform(Action::SizePart(1.5));
    assert_eq!(editor.sketch().part_poses.len(), 3);
    assert!(editor.sketch().part_poses.iter().all(|pose| pose.thickness == 1.5));
    editor.perform(Action::Undo);
    assert!(editor.sketch().part_poses.is_empty(), "one step");
    editor.perform(Action::StraightenPart(1.0));
    assert!(editor.sketch().part_poses.is_empty(), "leaves are not straightened");
    let strokes = editor.sketch().strokes.len();
    editor.perform(Action::TakeAwayPart);
    assert_eq!(editor.sketch().strokes.len(), strokes - 3);
    editor.perform(Action::Undo);
    assert_eq!(editor.sketch().strokes.len(), strokes, "one step");
}

#[test]
fn a_drag_on_one_of_several_branches_turns_all_of_them() {
    let home = tempfile::tempdir().unwrap();
    let (mut editor, egui) = with_sketch(&home, "freehand_tree");
    editor.perform(Action::PoseParts(true));
    frame(&mut editor, &egui);
    let built = editor.built().unwrap().clone();
    let branches = &built.plant.branches;
    let carries = |index: usize| branches.iter().any(|branch| branch.parent == Some(index));
    let twigs = (0..branches.len()).filter(|index| !carries(*index));
    let twigs: Vec<usize> =
        twigs.filter(|index| matches!(branches[*index].origin, Origin::Grown(_))).take(3).collect();
    let named: Vec<PartName> =
        twigs.iter().map(|index| built.names.of(branches[*index].origin).unwrap()).collect();
    named.iter().for_each(|name| editor.choose_part(*name, true));
    let end = *branches[twigs[2]].points.last().unwrap();
    editor.posing.hold = Some(super::super::pose_tool::PartHold {
        drag: PoseDrag::Turn,
        held: editor.held(named[2]).unwrap(),
        grip: end,
        share: 1.0,
    });
    editor.posing.held_others = editor.other_holds(named[2]);
    let at = editor.plant.seen_at(end).unwrap();
    editor.drag_part(at + DVec2::new(18.0, -22.0));
    build(&mut editor);
    assert_eq!(editor.sketch().part_poses.len(), 3);
    let way = |branches: &[Branch], index: usize| {
        (branches[index].points[branches[index].points.len() - 1] - branches[index].points[0]).normalize()
    };
    let after = editor.built().unwrap().plant.branches.clone();
    let turn = glam::Quat::from_rotation_arc(way(branches, twigs[2]), way(&after, twigs[2]));
    assert!(turn.angle_between(glam::Quat::IDENTITY) > 0.02);
    for index in &twigs {
        assert_eq!(after[*index].points[0], branches[*index].points[0], "about their own bases");
        let angle = way(branches, *index).angle_between(way(&after, *index));
        assert!(angle > 0.2 * turn.angle_between(glam::Quat::IDENTITY), "{index}: {angle}");
    }
    // Another part that is dragged is chosen alone.
    editor.posing.take_up(PartName::Grown(1));
    assert_eq!(chosen(&editor), [PartName::Grown(1)]);
}
