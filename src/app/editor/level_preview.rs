//! The plant seen in its levels of detail: made on a thread of their own while the drawing rests, and each shown at the distance
//! at which engines show it, or as long as the artist holds it.
//!
//! A plant that changes is shown as it is until its levels are there. Only what is seen is another: tools work on the plant itself.

use super::Editor;
use super::background;
use super::shown_levels::{Made, ShownLevels};
use crate::app::messages::Localize;
use crate::app::panels::snapshot::{LevelState, LevelsState};
use crate::app::worker::BuildError;
use crate::model::{self, Model};
use crate::pipeline::{self, Built, LevelSet};
use std::sync::{Arc, Weak};

impl Editor {
    /// Shows the plant in these levels, or as it is.
    pub(super) fn show_levels(&mut self, set: Option<LevelSet>) {
        self.levels = ShownLevels { set, ..ShownLevels::default() };
        self.updates.level_changed();
    }

    /// Shows one level at any distance, or each at its own.
    pub(super) fn hold_level(&mut self, level: Option<usize>) {
        self.levels.held = level;
    }

    /// Takes levels that have been made.
    pub(super) fn collect_levels(&mut self) {
        let Some(result) = self.levels.work.as_ref().and_then(|(_, work)| work.result()) else { return };
        let Some((of, _)) = self.levels.work.take() else { return };
        match result {
            Some(Ok(levels)) => {
                let triangles: Vec<usize> = levels.iter().map(Model::triangle_count).collect();
                let shares = model::screen_shares(&triangles);
                let levels = levels.into_iter().map(Arc::new).collect();
                self.levels.made = Some(Made { of, levels, triangles, shares });
                self.updates.level_changed();
            }
            Some(Err(error)) => self.end_levels(&BuildError::from(error)),
            None => self.end_levels(&BuildError::Defect),
        }
    }

    /// Shows the plant as it is, because of this.
    fn end_levels(&mut self, why: &dyn Localize) {
        self.show_levels(None);
        self.notify_error(why);
    }

    /// Lets go of the levels of a plant that is no more, begins to make those of a plant that rests, and chooses the one for the
    /// distance.
    pub(super) fn follow_levels(&mut self, ctx: &egui::Context) {
        let Some(set) = self.levels.set else { return };
        let Some(built) = self.live.built().cloned() else { return };
        let is_of_it = |of: &Weak<Built>| std::ptr::eq(of.as_ptr(), Arc::as_ptr(&built));
        if self.levels.made.as_ref().is_some_and(|made| !is_of_it(&made.of)) {
            self.levels.made = None;
            self.updates.level_changed();
        }
        let before = self.levels.shown;
        match &self.levels.made {
            Some(made) => {
                let share = self.plant.distance().map_or(1.0, |distance| distance.share);
                let last = made.levels.len().saturating_sub(1);
                let of_distance = model::shown_at(share, &made.shares);
                self.levels.shown = self.levels.held.unwrap_or(of_distance).min(last);
            }
            None if !self.levels.is_busy() && !self.live.is_working() => self.begin_levels(set, built),
            None => {}
        }
        if self.levels.shown != before {
            self.updates.level_changed();
            ctx.request_repaint();
        }
    }

    fn begin_levels(&mut self, set: LevelSet, built: Arc<Built>) {
        let of = Arc::downgrade(&built);
        let (sketch, folder) = (self.sketch().clone(), self.drawing.folder().to_owned());
        let make = move || pipeline::levels_of_drawing((&sketch, &folder), &built, set);
        match background::begin("levels of detail", self.background.wake(), make) {
            Ok(work) => self.levels.work = Some((of, work)),
            Err(error) => self.end_levels(&error),
        }
    }

    /// What the panels show of them.
    pub(super) fn levels_state(&self) -> LevelsState {
        let ShownLevels { set, held, made, shown, .. } = &self.levels;
        let distance = self.plant.distance();
        let metres_of = |share: f32| distance.map_or(0.0, |now| now.metres * now.share / share);
        let rows = |made: &Made| {
            let each = made.triangles.iter().zip(&made.shares);
            each.map(|(triangles, share)| LevelState { triangles: *triangles, up_to: metres_of(*share) })
                .collect()
        };
        LevelsState {
            set: *set,
            levels: made.as_ref().map(rows).unwrap_or_default(),
            shown: *shown,
            is_held: held.is_some(),
            distance: distance.map(|now| (now.metres, now.range)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Editor;
    use crate::app::action::Action;
    use crate::app::editor::test_window::{build, frame, with_sketch};
    use crate::pipeline::LevelSet;

    #[test]
    fn far_away_the_plant_has_fewer_triangles() {
        let home = tempfile::tempdir().unwrap();
        let (mut editor, egui) = with_sketch(&home, "tree_round");
        let of_plant = editor.built().unwrap().model.triangle_count();
        assert!(editor.subject().unwrap().level.is_none());
        editor.perform(Action::ShowLevels(Some(LevelSet::Game)));
        frame(&mut editor, &egui);
        build(&mut editor);
        frame(&mut editor, &egui);
        let rows = editor.levels_state().levels;
        assert!(rows.len() > 2 && rows[0].triangles <= of_plant, "{rows:?}");
        assert!(rows.is_sorted_by(|a, b| a.triangles > b.triangles && a.up_to < b.up_to), "{rows:?}");
        let shown = |editor: &mut Editor, action| {
            let before = editor.versions().plant;
            editor.perform(action);
            frame(editor, &egui);
            let level = editor.subject().unwrap().level.unwrap().triangle_count();
            (level, editor.versions().plant > before)
        };
        for (level, row) in rows.iter().enumerate() {
            let found = shown(&mut editor, Action::SetDistance(0.98 * row.up_to));
            assert_eq!(found, (row.triangles, level > 0), "level {level}");
        }
        // Held, the finest stays; what tools work on is the plant all along.
        assert_eq!(shown(&mut editor, Action::HoldLevel(Some(0))).0, rows[0].triangles);
        assert_eq!(editor.built().unwrap().model.triangle_count(), of_plant);
        editor.perform(Action::ShowLevels(None));
        assert!(editor.subject().unwrap().level.is_none());
    }

    #[test]
    fn a_plant_that_changes_is_shown_as_it_is_until_its_levels_are_there() {
        let home = tempfile::tempdir().unwrap();
        let (mut editor, egui) = with_sketch(&home, "daisy");
        editor.perform(Action::ShowLevels(Some(LevelSet::Mobile)));
        frame(&mut editor, &egui);
        build(&mut editor);
        frame(&mut editor, &egui);
        assert!(editor.subject().unwrap().level.is_some());
        editor.perform(Action::SetSeed(4));
        editor.submit();
        while editor.live.is_working() {
            editor.collect();
            std::thread::yield_now();
        }
        frame(&mut editor, &egui);
        assert!(editor.subject().unwrap().level.is_none(), "it is of another seed");
        build(&mut editor);
        frame(&mut editor, &egui);
        assert!(editor.subject().unwrap().level.is_some());
    }
}
