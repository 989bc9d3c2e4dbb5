//! The thread that writes: journal records as they come, snapshots now and then, everything anew after a failure.
//!
//! It never waits for the disk but to end: what is written is safe from a crash of the program at once, and the
//! [`Flusher`] makes it safe from a power cut and reports that. It carries out every step on a copy of the drawing, which
//! costs little as strokes are shared. So it can write a whole snapshot at any time, and needs nothing from the window after
//! a failure.

use super::error::JournalError;
use super::file::{Identity, Journal, Sum};
use super::flusher::{Flusher, Order, Target};
use super::session::{Folder, Meta, Session};
use super::shared::{Command, Shared};
use crate::atomic::{Staged, WriteError};
use crate::file_system::FileSystem;
use crate::sketch::{Sketch, Step, json};
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::thread::{Builder, JoinHandle};
use std::time::{Duration, Instant};

/// How old the newest snapshot may become while the drawing changes.
const SNAPSHOT_EVERY: Duration = Duration::from_secs(60);

/// How long after a failure the next attempt waits.
const RETRY_AFTER: Duration = Duration::from_secs(2);

/// A journal longer than this, and than twice the drawing, makes room for a snapshot.
const JOURNAL_BYTES: u64 = 4 << 20;

/// What comes after a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Flow {
    GoOn,
    /// What was written stays.
    Ended,
    /// Nothing is left to write.
    Closed,
}

/// A snapshot being written beside the drawing.
type Background = JoinHandle<Result<Sum, WriteError>>;

/// The drawing that is written down.
#[derive(Debug)]
pub(super) struct Subject {
    pub(super) sketch: Sketch,
    pub(super) identity: Identity,
    /// Files of the session that is taken over, from which a part of it could not be read.
    pub(super) damaged: Vec<PathBuf>,
}

#[derive(Debug)]
pub(super) struct JournalThread {
    files: Arc<dyn FileSystem>,
    state: PathBuf,
    session: Option<Session>,
    /// Folders with names that are new since there is a session.
    above: BTreeSet<PathBuf>,
    subject: Subject,
    shared: Arc<Shared>,
    flusher: Flusher,
    journal: Option<Journal>,
    background: Option<Background>,
    snapshot_bytes: u64,
    /// Counts the times that everything was written anew.
    epoch: u64,
    /// Number of the last step carried out on the drawing.
    last: u64,
    failed_at: Option<Instant>,
}

impl JournalThread {
    pub(super) fn new(
        files: Arc<dyn FileSystem>,
        state: PathBuf,
        session: Option<Session>,
        subject: Subject,
        shared: Arc<Shared>,
        flusher: Flusher,
    ) -> Self {
        Self {
            files,
            state,
            session,
            above: BTreeSet::new(),
            subject,
            shared,
            flusher,
            journal: None,
            background: None,
            snapshot_bytes: 0,
            epoch: 0,
            last: 0,
            failed_at: None,
        }
    }

    /// Carries out commands until one of them ends it.
    pub(super) fn run(mut self, inbox: &Receiver<Command>) {
        let mut flow = Flow::GoOn;
        while flow == Flow::GoOn {
            let first = match self.next_deadline() {
                None => inbox.recv().map_err(|_| RecvTimeoutError::Disconnected),
                Some(due) => inbox.recv_timeout(due.saturating_duration_since(Instant::now())),
            };
            match first {
                // What has gathered meanwhile is written together.
                Ok(first) => flow = self.carry_out(std::iter::once(first).chain(inbox.try_iter())),
                Err(RecvTimeoutError::Timeout) => self.on_time(),
                Err(RecvTimeoutError::Disconnected) => flow = Flow::Ended,
            }
        }
        if flow == Flow::Closed {
            return;
        }
        self.finish_background(true);
        self.flusher.wait();
        self.carry_out(inbox.try_iter());
        // The last attempt.
        if self.failed_at.take().is_some() {
            self.begin_generation();
        }
        self.flusher.wait();
    }

    fn next_deadline(&self) -> Option<Instant> {
        let retry = self.failed_at.map(|at| at + RETRY_AFTER);
        let since = self.journal.as_ref().and_then(|journal| journal.unsnapshotted_since);
        retry.or(since.map(|since| since + SNAPSHOT_EVERY))
    }

    fn on_time(&mut self) {
        if self.failed_at.is_some() {
            return self.begin_generation();
        }
        // One that takes a minute is waited for, or the time would be up again at once.
        self.finish_background(true);
        self.snapshot();
    }

    fn carry_out(&mut self, commands: impl Iterator<Item = Command>) -> Flow {
        let mut steps = Vec::new();
        for command in commands {
            if let Command::Step(number, step) = command {
                step.carry_out(&mut self.subject.sketch);
                self.last = number;
                steps.push(step);
                continue;
            }
            self.write(&std::mem::take(&mut steps));
            match command {
                Command::Step(..) => {}
                Command::Begin => self.begin_generation(),
                Command::Snapshot => self.snapshot(),
                Command::Saved(meta, up_to) => self.saved(meta, up_to >= self.last),
                Command::FlushFailed(epoch, error) => self.flush_failed(epoch, error),
                Command::Close => {
                    self.close();
                    return Flow::Closed;
                }
                Command::End => return Flow::Ended,
            }
        }
        self.write(&steps);
        Flow::GoOn
    }

    /// Writes steps that the copy of the drawing already has.
    fn write(&mut self, steps: &[Arc<Step>]) {
        if steps.is_empty() {
            return;
        }
        self.subject.identity.is_saved = false;
        if self.failed_at.is_some_and(|at| at.elapsed() < RETRY_AFTER) {
            return;
        }
        let drawn: usize = self.subject.sketch.strokes.iter().map(|stroke| stroke.points.len()).sum();
        let changed: usize = steps.iter().map(|step| step.samples()).sum();
        let is_small = changed <= 2 * drawn + 1000;
        match self.journal.as_mut().filter(|_| is_small).map(|journal| journal.append_steps(steps)) {
            Some(Ok(())) => self.flush_journal(),
            // No journal yet, or more changes than the whole drawing is long; or the file may end in half a record now, or
            // be gone with its folder: a new one begins.
            None | Some(Err(_)) => self.begin_generation(),
        }
        // Not before: where that begins a new generation, the steps would be in its snapshot and then in its journal.
        self.finish_background(false);
        let bytes = self.journal.as_ref().map_or(0, Journal::bytes);
        if bytes > JOURNAL_BYTES.max(2 * self.snapshot_bytes) {
            self.snapshot();
        }
    }

    fn flush_journal(&self) {
        if let Some(journal) = &self.journal {
            let (file, path) = journal.file();
            self.order(vec![Target::File(file, path)], self.last, false);
        }
    }

    /// Has something flushed; every step up to `reached` has been written by now.
    fn order(&self, flush: Vec<Target>, reached: u64, tidy: bool) {
        let Some(session) = &self.session else { return };
        let folder = session.folder.clone();
        let set_aside = if tidy { self.subject.damaged.clone() } else { Vec::new() };
        self.flusher.order(Order { epoch: self.epoch, folder, flush, reached, tidy, set_aside });
    }

    /// Writes the drawing as it is, and an empty journal after it.
    fn begin_generation(&mut self) {
        self.finish_background(true);
        self.epoch += 1;
        // What fails once may have been a folder that is gone, which is made again.
        match self.try_begin_generation().or_else(|_| self.try_begin_generation()) {
            Ok(()) => self.failed_at = None,
            Err(error) => self.failed(error),
        }
    }

    fn try_begin_generation(&mut self) -> Result<(), WriteError> {
        self.journal = None;
        let session = match self.session.take().filter(Session::exists) {
            Some(session) => session,
            None => Session::create(&self.files, &self.state, &mut self.above)?,
        };
        let session = self.session.insert(session);
        let folder = &session.folder;
        let generation = folder.newest() + 1;
        let text = json::write(&self.subject.sketch);
        let path = folder.snapshot(generation);
        let snapshot = Staged::private(&*self.files, &path, text.as_bytes())?.place()?;
        let mut journal = Journal::create(folder, generation, &self.subject.sketch, &self.subject.identity)?;
        let (file, journal_path) = journal.file();
        let sum = Sum::of(generation, text.as_bytes());
        journal.append_sum(&sum).map_err(|error| WriteError::of(&journal_path, error))?;
        self.snapshot_bytes = sum.bytes();
        self.journal = Some(journal);
        let mut flush = vec![
            Target::File(snapshot, path),
            Target::File(file, journal_path),
            Target::Folder(folder.path.clone()),
        ];
        flush.extend(self.above.iter().cloned().map(Target::Folder));
        self.order(flush, self.last, true);
        Ok(())
    }

    /// Begins the next journal and writes the snapshot before it on a thread of its own, if there is something new.
    fn snapshot(&mut self) {
        self.finish_background(false);
        let is_current = self.journal.as_ref().is_none_or(|journal| journal.unsnapshotted_since.is_none());
        let Some(session) = self.session.as_ref().filter(|_| !is_current && self.background.is_none()) else {
            return;
        };
        let folder = session.folder.clone();
        let generation = folder.newest() + 1;
        let sketch = self.subject.sketch.clone();
        let Ok(next) = Journal::create(&folder, generation, &sketch, &self.subject.identity) else {
            return self.begin_generation();
        };
        let (file, path) = next.file();
        self.journal = Some(next);
        self.order(vec![Target::File(file, path), Target::Folder(folder.path.clone())], 0, false);
        let write = move || write_snapshot(&folder, generation, &sketch);
        self.background = Builder::new().name("snapshot".to_owned()).spawn(write).ok();
    }

    /// Takes note of a snapshot that was being written; waits for it if asked.
    fn finish_background(&mut self, wait: bool) {
        let Some(thread) = self.background.take_if(|thread| wait || thread.is_finished()) else { return };
        match thread.join() {
            Ok(Ok(sum)) => {
                self.snapshot_bytes = sum.bytes();
                let appended = self.journal.as_mut().map(|journal| journal.append_sum(&sum));
                if let Some(Err(_)) = appended {
                    return self.begin_generation();
                }
                // Steps may be about to be written just now.
                self.order(Vec::new(), 0, true);
            }
            // The generation before is still whole, and the journals go on; the next snapshot may succeed.
            Ok(Err(error)) => tracing::warn!("{error}"),
            Err(_) => {}
        }
    }

    /// The drawing's file holds what it held at some step, which may be the last.
    fn saved(&mut self, meta: Meta, is_last: bool) {
        self.subject.identity = Identity { meta, is_saved: is_last };
        let identity = &self.subject.identity;
        match self.journal.as_mut().map(|journal| journal.append_identity(identity)) {
            Some(Ok(())) => self.flush_journal(),
            Some(Err(_)) => self.begin_generation(),
            // No journal can be written, and what is left of the last one is older than what was saved.
            None if is_last => {
                let _ = self.session.as_ref().map(|session| session.folder.clear());
                self.failed_at = None;
                self.shared.forget_failure(self.last);
            }
            None => {}
        }
    }

    fn flush_failed(&mut self, epoch: u64, error: WriteError) {
        if epoch < self.epoch || self.failed_at.is_some() {
            return;
        }
        self.journal = None;
        if self.shared.has_reached(epoch) {
            // It went well before, so it may again.
            self.begin_generation();
        } else {
            self.failed(error);
        }
    }

    fn close(&mut self) {
        let _ = self.background.take().map(JoinHandle::join);
        self.flusher.wait();
        self.journal = None;
        if let Some(Err(error)) = self.session.take().map(|session| session.folder.remove()) {
            tracing::warn!("a recovery copy could not be removed: {error}");
        }
        self.shared.forget_failure(self.last);
    }

    fn failed(&mut self, error: WriteError) {
        self.failed_at = Some(Instant::now());
        self.journal = None;
        self.shared.failed(self.epoch, JournalError::Write(error));
    }
}

/// Writes a snapshot that takes its name when it is on the disk.
fn write_snapshot(folder: &Folder, generation: u64, sketch: &Sketch) -> Result<Sum, WriteError> {
    let text = json::write(sketch);
    let path = folder.snapshot(generation);
    let mut staged = Staged::private(&*folder.files, &path, text.as_bytes())?;
    staged.flush()?;
    staged.place()?;
    folder.files.flush_folder(&folder.path).map_err(|error| WriteError::of(&path, error))?;
    Ok(Sum::of(generation, text.as_bytes()))
}

#[cfg(test)]
#[path = "journal_thread_tests.rs"]
mod tests;
