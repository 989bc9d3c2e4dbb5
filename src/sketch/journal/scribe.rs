//! The thread that writes: journal records as they come, snapshots now and then, everything anew after a failure.
//!
//! It carries out every step on a copy of the drawing, which costs little as strokes are shared. So it can write a whole
//! snapshot at any time, and needs nothing from the window after a failure.

use super::error::JournalError;
use super::record::{self, HEADER, Kind};
use super::session::{Meta, Session};
use super::writer::Shared;
use crate::atomic::{WriteError, flush_folder, write_atomically};
use crate::sketch::{Picture, Sketch, Step, json};
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, Write};
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

/// What the window asks for.
#[derive(Debug)]
pub(super) enum Command {
    /// Write this step, which has this number.
    Step(u64, Arc<Step>),
    /// Write the drawing even though nothing changed yet.
    Begin,
    /// Write a snapshot if the newest is not up to date.
    Snapshot,
    /// The drawing is safe in its file as it was after the step of this number.
    Saved(Meta, u64),
    /// Another title or file.
    Meta(Meta),
    /// Remove everything.
    Close,
}

/// The journal that is being written.
#[derive(Debug)]
struct Journal {
    file: File,
    path: PathBuf,
    bytes: u64,
    /// Hashes of the pictures that are in it or in its snapshot.
    pictures: BTreeSet<u64>,
    /// When the first step was written that the newest snapshot does not have.
    unsnapshotted_since: Option<Instant>,
}

/// A snapshot being written beside the drawing.
type Background = JoinHandle<Result<u64, WriteError>>;

#[derive(Debug)]
pub(super) struct Scribe {
    state: PathBuf,
    session: Option<Session>,
    mirror: Sketch,
    meta: Meta,
    shared: Arc<Shared>,
    journal: Option<Journal>,
    background: Option<Background>,
    snapshot_bytes: u64,
    /// Number of the last step carried out on the mirror.
    last: u64,
    failed_at: Option<Instant>,
}

impl Scribe {
    pub(super) fn new(
        state: PathBuf,
        session: Option<Session>,
        mirror: Sketch,
        meta: Meta,
        shared: Arc<Shared>,
    ) -> Self {
        let (journal, background, failed_at) = (None, None, None);
        Self {
            state,
            session,
            mirror,
            meta,
            shared,
            journal,
            background,
            snapshot_bytes: 0,
            last: 0,
            failed_at,
        }
    }

    /// Carries out commands until the window hangs up.
    pub(super) fn run(mut self, inbox: &Receiver<Command>) {
        let mut closed = false;
        while !closed {
            let first = match self.next_deadline() {
                None => inbox.recv().map_err(|_| RecvTimeoutError::Disconnected),
                Some(due) => inbox.recv_timeout(due.saturating_duration_since(Instant::now())),
            };
            match first {
                // What has gathered meanwhile goes to disk together.
                Ok(first) => closed = self.carry_out(std::iter::once(first).chain(inbox.try_iter())),
                Err(RecvTimeoutError::Timeout) => self.on_time(),
                Err(RecvTimeoutError::Disconnected) => break,
            }
        }
        self.finish_background(true);
        if !closed && self.failed_at.is_some() {
            self.begin_generation();
        }
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

    /// Whether the session is over.
    fn carry_out(&mut self, commands: impl Iterator<Item = Command>) -> bool {
        let mut steps = Vec::new();
        for command in commands {
            if let Command::Step(number, step) = command {
                step.carry_out(&mut self.mirror);
                self.last = number;
                steps.push(step);
                continue;
            }
            self.write(&std::mem::take(&mut steps));
            match command {
                Command::Step(..) => {}
                Command::Begin => self.begin_generation(),
                Command::Snapshot => self.snapshot(),
                Command::Saved(meta, up_to) if up_to >= self.last => self.forget(meta),
                Command::Saved(meta, _) | Command::Meta(meta) => self.set_meta(meta),
                Command::Close => {
                    self.close();
                    return true;
                }
            }
        }
        self.write(&steps);
        false
    }

    /// Brings steps to disk that the mirror already has.
    fn write(&mut self, steps: &[Arc<Step>]) {
        if steps.is_empty() || self.failed_at.is_some_and(|at| at.elapsed() < RETRY_AFTER) {
            return;
        }
        self.finish_background(false);
        let drawn: usize = self.mirror.strokes.iter().map(|stroke| stroke.points.len()).sum();
        let changed: usize = steps.iter().map(|step| step.samples()).sum();
        let Some(journal) =
            self.journal.as_mut().filter(|_| self.failed_at.is_none() && changed <= 2 * drawn + 1000)
        else {
            // No journal yet, one that failed, or more changes than the whole drawing is long.
            return self.begin_generation();
        };
        match journal.append(steps) {
            Ok(()) => {
                let is_long = journal.bytes > JOURNAL_BYTES.max(2 * self.snapshot_bytes);
                self.succeeded();
                if is_long {
                    self.snapshot();
                }
            }
            // The file may end in half a record now, or be gone with its folder: a new one begins.
            Err(_) => self.begin_generation(),
        }
    }

    /// Writes the drawing as it is, and an empty journal after it; waits for both.
    fn begin_generation(&mut self) {
        self.finish_background(true);
        match self.try_begin_generation() {
            Ok(()) => self.succeeded(),
            Err(error) => self.failed(error),
        }
    }

    fn try_begin_generation(&mut self) -> Result<(), WriteError> {
        self.journal = None;
        let session = match self.session.take().filter(Session::exists) {
            Some(session) => {
                session.write_meta(&self.meta)?;
                session
            }
            None => Session::create(&self.state, &self.meta)?,
        };
        let session = self.session.insert(session);
        let generation = session.newest() + 1;
        let text = json::write(&self.mirror);
        write_atomically(&session.snapshot(generation), text.as_bytes())?;
        self.snapshot_bytes = text.len() as u64;
        self.journal = Some(Journal::create(session, generation, &self.mirror)?);
        session.remove_before(generation);
        Ok(())
    }

    /// Begins the next journal and writes the snapshot before it on a thread of its own, if there is something new.
    fn snapshot(&mut self) {
        self.finish_background(false);
        let is_current = self.journal.as_ref().is_none_or(|journal| journal.unsnapshotted_since.is_none());
        let Some(session) = self.session.as_ref().filter(|_| !is_current && self.background.is_none()) else {
            return;
        };
        let generation = session.newest() + 1;
        let next = Journal::create(session, generation, &self.mirror);
        let (mirror, path) = (self.mirror.clone(), session.snapshot(generation));
        let write = move || {
            let text = json::write(&mirror);
            write_atomically(&path, text.as_bytes())?;
            Ok(text.len() as u64)
        };
        match next {
            Ok(next) => self.journal = Some(next),
            Err(error) => return self.failed(error),
        }
        self.background = Builder::new().name("snapshot".to_owned()).spawn(write).ok();
    }

    /// Takes note of a snapshot that was being written; waits for it if asked.
    fn finish_background(&mut self, wait: bool) {
        let Some(thread) = self.background.take_if(|thread| wait || thread.is_finished()) else { return };
        match (thread.join(), &self.session) {
            (Ok(Ok(bytes)), Some(session)) => {
                self.snapshot_bytes = bytes;
                let newest = session.snapshots().ok().and_then(|numbers| numbers.last().copied());
                session.remove_before(newest.unwrap_or(0));
            }
            // The generation before is still whole, and the journals go on; the next snapshot may succeed.
            (Ok(Err(error)), _) => tracing::warn!("{error}"),
            _ => {}
        }
    }

    fn forget(&mut self, meta: Meta) {
        self.finish_background(true);
        self.meta = meta;
        self.journal = None;
        if let Some(session) = self.session.as_ref().filter(|session| session.exists()) {
            session.remove_before(u64::MAX);
            // Without a drawing in it, what the folder says does not matter until the next step.
            let _ = session.write_meta(&self.meta);
        }
        self.succeeded();
    }

    fn set_meta(&mut self, meta: Meta) {
        self.meta = meta;
        let written = self.session.as_ref().map_or(Ok(()), |session| session.write_meta(&self.meta));
        if let Err(error) = written {
            self.failed(error);
        }
    }

    fn close(&mut self) {
        self.finish_background(true);
        self.journal = None;
        if let Some(Err(error)) = self.session.take().map(|session| session.remove()) {
            tracing::warn!("a recovery copy could not be removed: {error}");
        }
        let last = self.last;
        self.shared.change(|progress| progress.durable = last);
    }

    fn succeeded(&mut self) {
        self.failed_at = None;
        let last = self.last;
        self.shared.change(|progress| (progress.durable, progress.failure) = (last, None));
    }

    fn failed(&mut self, error: WriteError) {
        self.failed_at = Some(Instant::now());
        self.journal = None;
        let message = JournalError::Write(error).to_string();
        self.shared.change(|progress| progress.failure = Some(message));
    }
}

impl Journal {
    fn create(session: &Session, generation: u64, sketch: &Sketch) -> Result<Self, WriteError> {
        let path = session.journal(generation);
        let create = || {
            let mut file = File::create_new(&path)?;
            file.write_all(HEADER.as_bytes())?;
            file.sync_all()?;
            Ok(file)
        };
        let file = create().map_err(|error| WriteError::of(&path, error))?;
        flush_folder(&session.folder);
        let pictures = sketch.pictures().map(Picture::hash).collect();
        Ok(Self { file, path, bytes: HEADER.len() as u64, pictures, unsnapshotted_since: None })
    }

    /// Writes steps behind each other and waits until they are on disk.
    fn append(&mut self, steps: &[Arc<Step>]) -> io::Result<()> {
        let mut records = Vec::new();
        for step in steps {
            for picture in step.after.pictures() {
                if self.pictures.insert(picture.hash()) {
                    record::append(&mut records, Kind::Picture, picture.bytes())?;
                }
            }
            record::append(&mut records, Kind::Step, json::step::write(step).as_bytes())?;
        }
        self.file.write_all(&records)?;
        self.file.sync_data()?;
        // A file that was removed takes bytes as gladly as any other.
        if !self.path.exists() {
            return Err(io::ErrorKind::NotFound.into());
        }
        self.bytes += records.len() as u64;
        self.unsnapshotted_since.get_or_insert_with(Instant::now);
        Ok(())
    }
}

#[cfg(test)]
#[path = "scribe_tests.rs"]
mod tests;
