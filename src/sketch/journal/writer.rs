//! The window's end of the journal: hands steps to the writing thread and knows what is on disk.

use super::error::JournalError;
use super::flusher::Flusher;
use super::journal_thread::{JournalThread, Subject};
use super::session::{Meta, Session};
use super::shared::{Command, Progress, Shared};
use crate::file_system::FileSystem;
use crate::sketch::Step;
use std::path::PathBuf;
use std::sync::mpsc::{self, Sender};
use std::sync::{Arc, PoisonError};
use std::thread::{Builder, JoinHandle};
use std::time::{Duration, Instant};

/// How the recovery copy stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum JournalState {
    /// Every step is on disk.
    Saved,
    /// Steps are on their way. They survive the end of the program, but not yet that of the machine.
    Saving {
        /// How many.
        steps: u64,
        /// Since when there have always been some.
        since: Instant,
    },
    /// The last steps are only in memory; the writer goes on trying. The message says why and what to do.
    Failed(String),
}

/// Marks the thread as ended when it is dropped, also by a panic.
struct EndOnDrop(Arc<Shared>);

impl Drop for EndOnDrop {
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
    commands: Sender<Command>,
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
    appended: u64,
    /// When the first step was handed over after everything before it was on disk.
    behind_since: Instant,
}

impl JournalWriter {
    pub(super) fn spawn(
        files: Arc<dyn FileSystem>,
        state: PathBuf,
        session: Option<Session>,
        subject: Subject,
    ) -> Result<Self, JournalError> {
        let (commands, inbox) = mpsc::channel();
        let shared = Arc::new(Shared::default());
        let flusher = Flusher::start(shared.clone(), commands.clone()).map_err(JournalError::NoThread)?;
        let end_on_drop = EndOnDrop(shared.clone());
        let journal_thread = JournalThread::new(files, state, session, subject, shared.clone(), flusher);
        let thread = Builder::new().name("journal".to_owned()).spawn(move || {
            let _end_on_drop = end_on_drop;
            journal_thread.run(&inbox);
        });
        let thread = Some(thread.map_err(JournalError::NoThread)?);
        let writer = Self { commands, shared, thread, appended: 0, behind_since: Instant::now() };
        // Before the first stroke, which then has nothing to wait for.
        writer.send(Command::Begin);
        Ok(writer)
    }

    /// Hands over a step that the document has carried out, undo and redo too, in their order. Returns at once, with
    /// the step's number.
    pub fn append(&mut self, step: &Arc<Step>) -> u64 {
        if self.shared.lock().durable >= self.appended {
            self.behind_since = Instant::now();
        }
        self.appended += 1;
        self.send(Command::Step(self.appended, step.clone()));
        self.appended
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
            Some((_, error)) => JournalState::Failed(error.to_string()),
            None if progress.ended => {
                JournalState::Failed("no recovery copy is kept any longer; save soon".to_owned())
            }
            None if progress.durable < self.appended => {
                JournalState::Saving { steps: self.appended - progress.durable, since: self.behind_since }
            }
            None => JournalState::Saved,
        }
    }

    /// What keeps steps from being written.
    pub fn failure(&self) -> Option<Arc<JournalError>> {
        self.shared.lock().failure.as_ref().map(|(_, error)| error.clone())
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

    /// The drawing is saved in its file, and called, as `meta` says, as it was after step `up_to`. If nothing came after
    /// that, there is nothing to recover until the next step.
    pub fn saved(&self, meta: Meta, up_to: u64) {
        self.send(Command::Saved(meta, up_to));
    }

    /// Ends a drawing that is saved or given up, and removes its recovery copy. Does not wait for the disk; what is returned
    /// does, when it is dropped.
    pub fn close(mut self) -> Closing {
        self.send(Command::Close);
        Closing(self.thread.take())
    }

    fn send(&self, command: Command) {
        // A thread that is gone is seen in the state.
        let _ = self.commands.send(command);
    }
}

impl Drop for JournalWriter {
    fn drop(&mut self) {
        self.send(Command::End);
        drop(Closing(self.thread.take()));
    }
}

/// A journal that is being ended. Dropping it waits for that.
#[derive(Debug)]
pub struct Closing(Option<JoinHandle<()>>);

impl Closing {
    /// Whether it has ended.
    pub fn is_over(&self) -> bool {
        self.0.as_ref().is_none_or(JoinHandle::is_finished)
    }
}

impl Drop for Closing {
    fn drop(&mut self) {
        if let Some(thread) = self.0.take() {
            let _ = thread.join();
        }
    }
}
