//! What is to be saved: one drawing is written at a time, in the order in which that was asked for.

use super::background::{self, Wake, Work};
use super::open_drawing::Saving;
use crate::app::action::Action;
use crate::sketch::Sketch;
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
    saving: Saving,
    work: Work<Result<FileStamp, SaveError>>,
}

/// What came of a drawing that was to be saved.
pub(super) struct Saved {
    pub(super) path: PathBuf,
    pub(super) saving: Saving,
    /// The file's stamp; `None` where the work broke off.
    pub(super) result: Option<Result<FileStamp, SaveError>>,
}

/// Everything that is to be saved.
#[derive(Default)]
pub(super) struct Saver {
    under_way: Option<UnderWay>,
    waiting: VecDeque<Target>,
    /// What waits for the end of all that.
    then: Option<Action>,
}

impl Saver {
    /// Whether something is being written.
    pub(super) fn is_busy(&self) -> bool {
        self.under_way.is_some()
    }

    /// Puts a file at the end of the line, unless it stands there.
    pub(super) fn ask_for(&mut self, target: Target) {
        if self.waiting.back() != Some(&target) {
            self.waiting.push_back(target);
        }
    }

    /// The next one, if nothing is being written.
    pub(super) fn next(&mut self) -> Option<Target> {
        if self.is_busy() { None } else { self.waiting.pop_front() }
    }

    /// Begins to write a drawing into a file, which must be as `expected` says.
    pub(super) fn begin(
        &mut self,
        (sketch, saving): (Sketch, Saving),
        path: PathBuf,
        expected: Option<FileStamp>,
        wake: &Wake,
    ) -> std::io::Result<()> {
        let target = path.clone();
        let save = move || save::save(&target, &sketch, expected.as_ref());
        let work = background::begin("saving", wake, save)?;
        self.under_way = Some(UnderWay { path, saving, work });
        Ok(())
    }

    /// What was written, if that has ended.
    pub(super) fn take(&mut self) -> Option<Saved> {
        let result = self.under_way.as_ref()?.work.result()?;
        self.end(result)
    }

    /// Waits for what is being written; `None` if nothing is.
    pub(super) fn wait(&mut self) -> Option<Saved> {
        let result = self.under_way.as_ref()?.work.wait();
        self.end(result)
    }

    fn end(&mut self, result: Option<Result<FileStamp, SaveError>>) -> Option<Saved> {
        let UnderWay { path, saving, .. } = self.under_way.take()?;
        Some(Saved { path, saving, result })
    }

    /// What comes when all is written; nothing, if that is `None`.
    pub(super) fn set_then(&mut self, then: Option<Action>) {
        self.then = then;
    }

    /// What waited for the end of all that.
    pub(super) fn take_then(&mut self) -> Option<Action> {
        self.then.take()
    }
}
