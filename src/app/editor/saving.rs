//! Saving on a thread of its own: the artist goes on drawing, and what was drawn since stays unsaved.
//!
//! One drawing is written at a time, in the order in which that was asked for; a later one shows the stamp that the one
//! before left, so that the window does not take its own work for another's. What would replace the drawing waits until
//! nothing is under way any more.

use super::files::meta_of;
use super::task::{self, Work};
use super::{Editor, OwnFile};
use crate::app::action::Action;
use crate::app::messages::{Localize as _, Msg};
use crate::app::panels::snapshot::{Notice, PathPurpose};
use crate::sketch::document::SavePoint;
use crate::sketch::journal::{Closing, JournalWriter};
use crate::sketch::save::{self, FileStamp, SaveError};
use std::collections::VecDeque;
use std::path::PathBuf;

/// Where to save.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Target {
    /// In the drawing's own file, if nobody else changed it.
    Own,
    /// In this file, in the place of whatever is there: the artist was asked.
    Chosen(PathBuf),
}

/// A drawing on its way to its file.
struct UnderWay {
    path: PathBuf,
    /// What of the document and of the journal will be saved then.
    point: SavePoint,
    step: u64,
    work: Work<Result<FileStamp, SaveError>>,
}

/// Everything that is to be saved.
#[derive(Default)]
pub(super) struct Saver {
    under_way: Option<UnderWay>,
    waiting: VecDeque<Target>,
    /// What waits for the end of all that.
    pub(super) then: Option<Action>,
    /// Journals of the drawings before.
    pub(super) closing: Vec<Closing>,
    /// The artist knows that the journal cannot be written.
    journal_failure_is_told: bool,
}

impl Saver {
    /// Whether something is being written.
    pub(super) fn is_busy(&self) -> bool {
        self.under_way.is_some()
    }
}

impl Editor {
    /// Saves as soon as nothing else is being saved.
    pub(super) fn save(&mut self, target: Target) {
        if self.saver.waiting.back() != Some(&target) {
            self.saver.waiting.push_back(target);
        }
        self.save_next();
    }

    fn save_next(&mut self) {
        while !self.saver.is_busy() {
            match self.saver.waiting.pop_front() {
                None => return,
                Some(Target::Chosen(path)) => self.begin_save(path, None),
                Some(Target::Own) => match self.file.path.clone() {
                    Some(path) => self.begin_save(path, self.file.stamp),
                    None => self.choose(PathPurpose::SaveDrawing),
                },
            }
        }
    }

    fn begin_save(&mut self, path: PathBuf, expected: Option<FileStamp>) {
        let (sketch, target) = (self.document.sketch().clone(), path.clone());
        let point = self.document.save_point();
        let step = self.journal.as_ref().map_or(0, |journal| journal.last_step());
        let save = move || save::save(&target, &sketch, expected.as_ref());
        match task::begin("saving", &self.wake, save) {
            Ok(work) => self.saver.under_way = Some(UnderWay { path, point, step, work }),
            Err(error) => self.tell_error(&error),
        }
    }

    /// Takes what was saved since.
    pub(super) fn collect_save(&mut self) {
        let Some(result) = self.saver.under_way.as_ref().and_then(|saving| saving.work.result()) else {
            return;
        };
        self.end_save(result);
    }

    /// Ends the journal of a drawing that is saved or given up; a slow disk keeps nobody from drawing on.
    pub(super) fn end_journal(&mut self) {
        self.saver.closing.retain(|closing| !closing.is_over());
        self.saver.closing.extend(self.journal.take().map(JournalWriter::close));
    }

    /// Says it when no recovery copy can be kept, once until it can be kept again.
    pub(super) fn watch_journal(&mut self) {
        let failure = self.journal.as_ref().and_then(|journal| journal.failure());
        let is_failed = failure.is_some();
        if let Some(error) = failure.filter(|_| !self.saver.journal_failure_is_told) {
            self.tell(Notice::error(error.localize(&self.messages), ""));
        }
        self.saver.journal_failure_is_told = is_failed;
    }

    /// Waits for what is being saved.
    pub(super) fn finish_saving(&mut self) {
        while let Some(saving) = &self.saver.under_way {
            let result = saving.work.wait();
            self.end_save(result);
        }
    }

    fn end_save(&mut self, result: Option<Result<FileStamp, SaveError>>) {
        let Some(UnderWay { path, point, step, .. }) = self.saver.under_way.take() else { return };
        match result {
            Some(Ok(stamp)) => {
                tracing::debug!("saved {}", path.display());
                self.file = OwnFile { path: Some(path.clone()), stamp: Some(stamp) };
                self.document.mark_saved_at(point);
                if let Some(journal) = &self.journal {
                    journal.saved(meta_of(&self.file), step);
                }
                self.settings.remember(&path);
                self.save_settings();
                self.refresh_title();
            }
            failed => {
                let broken = || self.messages.get(Msg::NoticeSaveFailed).to_owned();
                let reason =
                    failed.and_then(Result::err).map_or_else(broken, |error| error.localize(&self.messages));
                self.tell(Notice::error(reason, ""));
                // What waited for a saved drawing is given up: the artist reads why, and decides.
                self.saver.then = None;
            }
        }
        self.save_next();
        if !self.saver.is_busy()
            && let Some(action) = self.saver.then.take()
        {
            self.perform_if_saved(action);
        }
    }
}

#[cfg(test)]
#[path = "saving_tests.rs"]
mod tests;
