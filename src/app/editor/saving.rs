//! Saving on a thread of its own: the artist goes on drawing, and what was drawn since stays unsaved.
//!
//! One drawing is written at a time, in the order in which that was asked for; a later one shows the stamp that the one
//! before left, so that the window does not take its own work for another's. What would replace the drawing waits until
//! nothing is under way any more.

use super::Editor;
use super::saver::{Saved, Target};
use crate::app::messages::{Localize as _, Msg};
use crate::app::panels::snapshot::{Notice, PathPurpose};
use crate::sketch::save::FileStamp;
use std::path::{Path, PathBuf};

impl Editor {
    /// Saves as soon as nothing else is being saved.
    pub(super) fn save(&mut self, target: Target) {
        self.disk.saver.ask_for(target);
        self.save_next();
    }

    fn save_next(&mut self) {
        while let Some(target) = self.disk.saver.next() {
            match target {
                Target::Chosen(path) => self.begin_save(path, None),
                Target::Own => match self.drawing.path().map(Path::to_owned) {
                    Some(path) => self.begin_save(path, self.drawing.stamp()),
                    None => self.choose(PathPurpose::SaveDrawing),
                },
            }
        }
    }

    fn begin_save(&mut self, path: PathBuf, expected: Option<FileStamp>) {
        let what = (self.sketch().clone(), self.drawing.save_point());
        let begun = self.disk.saver.begin(what, path, expected, self.background.wake());
        self.notify_failure(begun);
    }

    /// Takes what was saved since.
    pub(super) fn collect_save(&mut self) {
        if let Some(saved) = self.disk.saver.take() {
            self.end_save(saved);
        }
    }

    /// Waits for what is being saved.
    pub(super) fn finish_saving(&mut self) {
        while let Some(saved) = self.disk.saver.wait() {
            self.end_save(saved);
        }
    }

    /// Says it when no recovery copy can be kept.
    pub(super) fn watch_journal(&mut self) {
        if let Some(error) = self.drawing.take_journal_failure() {
            self.notify_error(&*error);
        }
    }

    fn end_save(&mut self, saved: Saved) {
        let Saved { path, saving, result } = saved;
        match result {
            Some(Ok(stamp)) => {
                tracing::debug!("saved {}", path.display());
                self.prefs.remember_drawing(&path);
                self.drawing.saved(path, stamp, saving);
                self.save_settings();
                self.refresh_title();
            }
            failed => {
                let messages = self.prefs.messages();
                let broken = || messages.get(Msg::NoticeSaveFailed).to_owned();
                let reason =
                    failed.and_then(Result::err).map_or_else(broken, |error| error.localize(messages));
                self.notify(Notice::error(reason, ""));
                // What waited for a saved drawing is given up: the artist reads why, and decides.
                self.disk.saver.set_then(None);
            }
        }
        self.save_next();
        if !self.disk.saver.is_busy()
            && let Some(action) = self.disk.saver.take_then()
        {
            self.perform_if_saved(action);
        }
    }
}

#[cfg(test)]
#[path = "saving_tests.rs"]
mod tests;
