//! The open drawing: the document, the file that it belongs to, and the journal that keeps every step of it.
//!
//! A step reaches the journal with the change that makes it; nobody else has to remember that.

use crate::sketch::change::StrokeChange;
use crate::sketch::document::{Document, SavePoint};
use crate::sketch::journal::{Closing, JournalError, JournalState, JournalWriter, Meta};
use crate::sketch::save::FileStamp;
use crate::sketch::{Change, ChangeError, Sketch, Step, StrokeId};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Moves by keys that follow each other within this time are one step to undo.
const BURST: Duration = Duration::from_secs(1);

/// A drawing's own file.
#[derive(Clone, Debug, Default)]
pub(super) struct OwnFile {
    pub(super) path: Option<PathBuf>,
    /// What the file held when it was last read or written here.
    pub(super) stamp: Option<FileStamp>,
}

impl OwnFile {
    /// What the journal notes about it.
    pub(super) fn meta(&self) -> Meta {
        Meta { title: self.name().unwrap_or_default(), path: self.path.clone(), stamp: self.stamp }
    }

    fn name(&self) -> Option<String> {
        Some(self.path.as_ref()?.file_stem()?.to_string_lossy().into_owned())
    }
}

/// What of the document and of the journal is being saved.
#[derive(Clone, Copy, Debug)]
pub(super) struct Saving {
    point: SavePoint,
    step: u64,
}

/// The open drawing.
pub(super) struct OpenDrawing {
    document: Document,
    file: OwnFile,
    journal: Option<JournalWriter>,
    /// Journals of the drawings before.
    closing: Vec<Closing>,
    /// The artist knows that the journal cannot be written.
    failure_is_reported: bool,
    /// Revision that the artist does not want to keep.
    given_up: Option<u64>,
    /// When strokes were moved by a key last.
    nudged_at: Option<Instant>,
}

impl OpenDrawing {
    /// An empty sheet that nothing keeps yet.
    pub(super) fn empty() -> Self {
        Self {
            document: Document::empty(),
            file: OwnFile::default(),
            journal: None,
            closing: Vec::new(),
            failure_is_reported: false,
            given_up: None,
            nudged_at: None,
        }
    }

    /// Begins another drawing. The journal of the one before ends: it is saved, or was given up.
    pub(super) fn replace(&mut self, document: Document, file: OwnFile, journal: Option<JournalWriter>) {
        self.end_journal();
        self.journal = journal;
        self.document = document;
        self.given_up = None;
        self.file = file;
    }

    pub(super) fn sketch(&self) -> &Sketch {
        self.document.sketch()
    }

    pub(super) fn next_id(&self) -> StrokeId {
        self.document.next_id()
    }

    pub(super) fn can_undo(&self) -> bool {
        self.document.can_undo()
    }

    pub(super) fn can_redo(&self) -> bool {
        self.document.can_redo()
    }

    /// Whether all of it is in its file.
    pub(super) fn is_saved(&self) -> bool {
        self.document.is_saved()
    }

    /// Whether nothing that the artist wants to keep would be lost with it.
    pub(super) fn may_go(&self) -> bool {
        self.is_saved() || self.given_up == Some(self.document.revision())
    }

    /// The artist does not want to keep it as it is now.
    pub(super) fn give_up(&mut self) {
        self.given_up = Some(self.document.revision());
    }
}

/// Changes: whether the drawing is another one after each.
impl OpenDrawing {
    /// Applies a change as one step.
    pub(super) fn apply(&mut self, change: Change) -> Result<bool, ChangeError> {
        let step = self.document.apply(change)?;
        Ok(self.note(step))
    }

    /// The same for a slider on its way: one step from press to release.
    pub(super) fn apply_merging(&mut self, change: Change, key: &str) -> Result<bool, ChangeError> {
        let step = self.document.apply_merging(change, key)?;
        Ok(self.note(step))
    }

    /// The same for strokes moved by a key: one step with those moved just before.
    pub(super) fn apply_nudge(&mut self, changes: Vec<StrokeChange>) -> Result<bool, ChangeError> {
        let now = Instant::now();
        if self.nudged_at.replace(now).is_none_or(|last| now - last > BURST) {
            self.document.end_merging();
        }
        self.apply_merging(Change::strokes(changes), "nudge")
    }

    /// The next move by a key is a step of its own.
    pub(super) fn end_nudging(&mut self) {
        self.nudged_at = None;
    }

    /// The next change is a step of its own, whatever it is.
    pub(super) fn end_merging(&mut self) {
        self.document.end_merging();
    }

    pub(super) fn undo(&mut self) -> bool {
        let step = self.document.undo();
        self.note(step)
    }

    pub(super) fn redo(&mut self) -> bool {
        let step = self.document.redo();
        self.note(step)
    }

    fn note(&mut self, step: Option<Arc<Step>>) -> bool {
        let Some(step) = step else { return false };
        if let Some(journal) = &mut self.journal {
            journal.append(&step);
        }
        true
    }

    /// As if the last move by a key had been long ago.
    #[cfg(test)]
    pub(super) fn pause_nudging(&mut self) {
        self.nudged_at = self.nudged_at.and_then(|at| at.checked_sub(2 * BURST));
    }
}

/// Its file.
impl OpenDrawing {
    /// The path of its file; `None` before it was saved.
    pub(super) fn path(&self) -> Option<&Path> {
        self.file.path.as_deref()
    }

    /// What the file held when it was last read or written here.
    pub(super) fn stamp(&self) -> Option<FileStamp> {
        self.file.stamp
    }

    /// The folder of its file; empty without one.
    pub(super) fn folder(&self) -> &Path {
        self.path().and_then(Path::parent).unwrap_or(Path::new(""))
    }

    /// Its name, without folder and extension; `None` before it was saved.
    pub(super) fn name(&self) -> Option<String> {
        self.file.name()
    }

    /// What is to be saved now.
    pub(super) fn save_point(&self) -> Saving {
        let step = self.journal.as_ref().map_or(0, JournalWriter::last_step);
        Saving { point: self.document.save_point(), step }
    }

    /// What was to be saved then is in this file, which is the drawing's from now on.
    pub(super) fn saved(&mut self, path: PathBuf, stamp: FileStamp, saving: Saving) {
        self.file = OwnFile { path: Some(path), stamp: Some(stamp) };
        self.document.mark_saved_at(saving.point);
        if let Some(journal) = &self.journal {
            journal.saved(self.file.meta(), saving.step);
        }
    }
}

/// Its journal.
impl OpenDrawing {
    /// How the journal stands; `None` where it could not even be begun.
    pub(super) fn journal_state(&self) -> Option<JournalState> {
        self.journal.as_ref().map(JournalWriter::state)
    }

    /// Keeps a snapshot now.
    pub(super) fn snapshot(&self) {
        if let Some(journal) = &self.journal {
            journal.snapshot();
        }
    }

    /// Why no recovery copy can be kept, once until it can be kept again.
    pub(super) fn take_journal_failure(&mut self) -> Option<Arc<JournalError>> {
        let failure = self.journal.as_ref().and_then(JournalWriter::failure);
        let was_reported = std::mem::replace(&mut self.failure_is_reported, failure.is_some());
        failure.filter(|_| !was_reported)
    }

    /// Ends the journal of a drawing that is saved or given up; a slow disk keeps nobody from drawing on.
    pub(super) fn end_journal(&mut self) {
        self.closing.retain(|closing| !closing.is_over());
        self.closing.extend(self.journal.take().map(JournalWriter::close));
    }

    /// Waits for the end of all journals that are being ended.
    pub(super) fn wait_for_journals(&mut self) {
        self.closing.clear();
    }

    /// Lets go of the journal as it is: the drawing is offered at the next start.
    pub(super) fn leave_journal(&mut self) {
        self.journal = None;
    }

    /// Waits until the journal is on the disk.
    #[cfg(test)]
    pub(super) fn flush_journal(&self, most: Duration) -> JournalState {
        self.journal.as_ref().unwrap().flush(most)
    }
}
