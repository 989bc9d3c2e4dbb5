//! The window's end of the journal: hands steps to the writing thread and knows what is on disk.

use super::error::JournalError;
use super::scribe::{Command, Scribe};
use super::session::{Meta, Session};
use crate::sketch::{Sketch, Step};
use std::path::PathBuf;
use std::sync::mpsc::{self, Sender};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::{Builder, JoinHandle};
use std::time::Duration;

/// How the recovery copy stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum JournalState {
    /// Every step is on disk.
    Saved,
    /// Steps are on their way.
    Saving,
    /// The last steps are only in memory; the writer goes on trying. The message says why and what to do.
    Failed(String),
}

/// What window and writing thread both look at.
#[derive(Debug, Default)]
pub(super) struct Progress {
    /// Number of the last step that is on disk.
    pub(super) durable: u64,
    pub(super) failure: Option<String>,
    /// The thread is gone.
    pub(super) ended: bool,
}

/// A [`Progress`] and a bell that rings when it changes.
#[derive(Debug, Default)]
pub(super) struct Shared {
    progress: Mutex<Progress>,
    changed: Condvar,
}

impl Shared {
    pub(super) fn change(&self, change: impl FnOnce(&mut Progress)) {
        change(&mut self.lock());
        self.changed.notify_all();
    }

    fn lock(&self) -> MutexGuard<'_, Progress> {
        // Plain numbers: no panic can leave them half changed.
        self.progress.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Says that the thread is gone, however it went.
struct Farewell(Arc<Shared>);

impl Drop for Farewell {
    fn drop(&mut self) {
        self.0.change(|progress| progress.ended = true);
    }
}

/// Writes the journal of one open drawing.
///
/// Dropping it writes what is under way and leaves the files, to be found by [`Recovery::list`](super::Recovery::list);
/// [`JournalWriter::close`] removes them.
#[derive(Debug)]
pub struct JournalWriter {
    commands: Option<Sender<Command>>,
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
    appended: u64,
}

impl JournalWriter {
    pub(super) fn spawn(
        state: PathBuf,
        session: Option<Session>,
        sketch: Sketch,
        meta: Meta,
        is_saved: bool,
    ) -> Result<Self, JournalError> {
        let (commands, inbox) = mpsc::channel();
        let shared = Arc::new(Shared::default());
        let farewell = Farewell(shared.clone());
        let scribe = Scribe::new(state, session, sketch, meta, shared.clone());
        let thread = Builder::new().name("journal".to_owned()).spawn(move || {
            let _farewell = farewell;
            scribe.run(&inbox);
        });
        let thread = Some(thread.map_err(JournalError::NoThread)?);
        let writer = Self { commands: Some(commands), shared, thread, appended: 0 };
        if !is_saved {
            writer.send(Command::Begin);
        }
        Ok(writer)
    }

    /// Hands over a step that the document has carried out, undo and redo too, in their order. Returns at once, with
    /// the step's number.
    pub fn append(&mut self, step: &Arc<Step>) -> u64 {
        self.appended += 1;
        self.send(Command::Step(self.appended, step.clone()));
        self.appended
    }

    /// Whether this step and all before it are on disk.
    pub fn is_durable(&self, step: u64) -> bool {
        self.shared.lock().durable >= step
    }

    /// Waits until this step is on disk, but not longer than `most` nor while writing fails; whether it is.
    pub fn wait_until_durable(&self, step: u64, most: Duration) -> bool {
        let waiting = |p: &mut Progress| p.durable < step && p.failure.is_none() && !p.ended;
        let guard = self.shared.lock();
        let waited = self.shared.changed.wait_timeout_while(guard, most, waiting);
        waited.unwrap_or_else(PoisonError::into_inner).0.durable >= step
    }

    /// Waits for everything handed over so far, but not longer than `most`.
    pub fn flush(&self, most: Duration) -> JournalState {
        self.wait_until_durable(self.appended, most);
        self.state()
    }

    /// How the recovery copy stands.
    pub fn state(&self) -> JournalState {
        let progress = self.shared.lock();
        match &progress.failure {
            Some(message) => JournalState::Failed(message.clone()),
            None if progress.ended => {
                JournalState::Failed("no recovery copy is kept any longer; save soon".to_owned())
            }
            None if progress.durable < self.appended => JournalState::Saving,
            None => JournalState::Saved,
        }
    }

    /// Asks for a snapshot now, such as when the window loses focus; one comes by itself every minute in which something
    /// changed. Does not wait.
    pub fn snapshot(&self) {
        self.send(Command::Snapshot);
    }

    /// Number of the last step handed over.
    pub fn last_step(&self) -> u64 {
        self.appended
    }

    /// The drawing is saved in its file as it was after step `up_to`. If nothing came after that, there is nothing to
    /// recover until the next step.
    pub fn saved(&self, meta: Meta, up_to: u64) {
        self.send(Command::Saved(meta, up_to));
    }

    /// The drawing's title or file is another now.
    pub fn set_meta(&self, meta: Meta) {
        self.send(Command::Meta(meta));
    }

    /// Ends a drawing that is saved or given up, and removes its recovery copy.
    pub fn close(mut self) {
        self.send(Command::Close);
        self.end();
    }

    fn send(&self, command: Command) {
        // A thread that is gone is seen in the state.
        let _ = self.commands.as_ref().map(|commands| commands.send(command));
    }

    fn end(&mut self) {
        self.commands = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

impl Drop for JournalWriter {
    fn drop(&mut self) {
        self.end();
    }
}
