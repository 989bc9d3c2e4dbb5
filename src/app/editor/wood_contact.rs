//! Whether wood that is turned in the view of the plant stops at other wood, slides along it or passes through it (001 §4.3).

use super::Editor;
use crate::modelling::{OnContact, Surroundings};
use crate::sketch::PartName;
use glam::Quat;

impl Editor {
    /// The wood around a branch that is taken hold of, and the turn at which it is then; nothing where it passes through wood, or is no
    /// branch.
    pub(super) fn wood_around(&self, part: PartName) -> Option<(Surroundings, Quat)> {
        let built = self.built().filter(|_| self.posing.on_contact != OnContact::Pass)?;
        let branch = built.names.branch(&built.plant, part)?;
        Some((Surroundings::of(&built.plant.branches, branch)?, Quat::IDENTITY))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::action::Action;
    use crate::app::editor::test_window::{build, drag, frame, with_sketch};
    use crate::model::pick::{Element, pick};
    use crate::pen::PenTool;
    use glam::DVec2;

    /// A branch whose drag by some way would lead it into other wood: where it is seen, the way, and the wood around it.
    fn blocked(editor: &mut Editor) -> (DVec2, DVec2, Surroundings) {
        let built = editor.built().unwrap().clone();
        let ways = [(50.0, 0.0), (-50.0, 0.0), (0.0, 50.0), (0.0, -50.0)].map(DVec2::from);
        for (index, branch) in built.plant.branches.iter().enumerate() {
            let Some(at) = editor.plant.seen_at(branch.points[branch.points.len() * 2 / 3]) else { continue };
            let hit = editor
                .plant
                .ray(editor.plant.place(at))
                .and_then(|ray| pick(&built.model, &built.plant, &ray));
            if hit.is_none_or(|hit| hit.element != Element::Branch(index)) {
                continue;
            }
            let around = Surroundings::of(&built.plant.branches, index).unwrap();
            for way in ways {
                editor.posing.let_go();
                drag(editor, PenTool::Pen, at, at + way);
                let turn = editor.sketch().part_poses.first().map(|pose| pose.turn);
                if turn.is_some() {
                    editor.perform(Action::Undo);
                }
                if turn.is_some_and(|turn| !around.is_free(turn)) {
                    return (at, way, around);
                }
            }
        }
        panic!("no branch comes into others");
    }

    #[test]
    fn a_bough_stops_at_wood_or_slides_along_it_where_that_is_chosen() {
        let home = tempfile::tempdir().unwrap();
        let (mut editor, egui) = with_sketch(&home, "freehand_tree");
        editor.perform(Action::PoseParts(true));
        build(&mut editor);
        frame(&mut editor, &egui);
        let (at, way, around) = blocked(&mut editor);
        let mut turned = |on_contact: OnContact| {
            editor.posing.let_go();
            editor.perform(Action::MeetWood(on_contact));
            drag(&mut editor, PenTool::Pen, at, at + way);
            let turn = editor.sketch().part_poses.first().map_or(Quat::IDENTITY, |pose| pose.turn);
            editor.perform(Action::Undo);
            turn
        };
        let [passed, stopped, slid] = [OnContact::Pass, OnContact::Stop, OnContact::Slide].map(&mut turned);
        assert!(!around.is_free(passed) && around.is_free(stopped) && around.is_free(slid));
        let angle = |turn: Quat| turn.angle_between(Quat::IDENTITY);
        assert!(angle(stopped) < angle(passed), "{} {}", angle(stopped), angle(passed));
        assert!(slid.angle_between(passed) <= stopped.angle_between(passed) + 1e-3);
    }
}
