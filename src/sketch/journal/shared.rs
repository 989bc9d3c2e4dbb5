//! What the threads of a journal have in common: what the thread that writes is asked for, and what is on disk so far.

use super::error::JournalError;
use super::session::Meta;
use crate::atomic::WriteError;
use crate::sketch::Step;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

/// What is asked of the thread that writes.
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
    /// What was written since this epoch began may not reach the disk.
    FlushFailed(u64, WriteError),
    /// Remove everything and end.
    Close,
    /// End, and leave everything to be found.
    End,
}

/// What window and writing thread both look at.
#[derive(Debug, Default)]
pub(super) struct Progress {
    /// Number of the last step that is on disk.
    pub(super) durable: u64,
    /// The last epoch of which something is on disk.
    pub(super) epoch: u64,
    /// What failed last, and in which epoch.
    pub(super) failure: Option<(u64, Arc<JournalError>)>,
    /// The thread is gone.
    pub(super) ended: bool,
}

/// A [`Progress`] and a bell that rings when it changes.
#[derive(Debug, Default)]
pub(super) struct Shared {
    progress: Mutex<Progress>,
    pub(super) changed: Condvar,
}

impl Shared {
    /// Everything up to this step is on disk, written in this epoch.
    pub(super) fn reached(&self, epoch: u64, step: u64) {
        self.change(|progress| {
            progress.durable = progress.durable.max(step);
            progress.epoch = progress.epoch.max(epoch);
            progress.failure.take_if(|(failed, _)| *failed < epoch);
        });
    }

    /// Whether anything of this epoch is on disk.
    pub(super) fn has_reached(&self, epoch: u64) -> bool {
        self.lock().epoch >= epoch
    }

    pub(super) fn failed(&self, epoch: u64, error: JournalError) {
        self.change(|progress| progress.failure = Some((epoch, Arc::new(error))));
    }

    /// Everything up to this step needs no recovery copy any more.
    pub(super) fn forget_failure(&self, step: u64) {
        self.change(|progress| (progress.durable, progress.failure) = (step, None));
    }

    pub(super) fn change(&self, change: impl FnOnce(&mut Progress)) {
        change(&mut self.lock());
        self.changed.notify_all();
    }

    pub(super) fn lock(&self) -> MutexGuard<'_, Progress> {
        // Plain numbers: no panic can leave them half changed.
        self.progress.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
