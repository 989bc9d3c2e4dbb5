//! Work on threads of its own, and the actions that those threads send.

use crate::app::action::Action;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};

/// Calls from other threads that there is something to collect.
pub(super) type Wake = Arc<dyn Fn() + Send + Sync>;

/// The way back from other threads.
pub(super) struct Background {
    wake: Wake,
    sender: Sender<Action>,
    receiver: Receiver<Action>,
}

impl Background {
    pub(super) fn new(wake: Wake) -> Self {
        let (sender, receiver) = channel();
        Self { wake, sender, receiver }
    }

    /// What calls from other threads.
    pub(super) fn wake(&self) -> &Wake {
        &self.wake
    }

    /// Where other threads send actions; they call [`Self::wake`] afterwards.
    pub(super) fn sender(&self) -> &Sender<Action> {
        &self.sender
    }

    /// The next action that another thread sent.
    pub(super) fn take_action(&self) -> Option<Action> {
        self.receiver.try_recv().ok()
    }
}

/// Something that another thread does.
pub(super) struct Work<T>(Receiver<T>);

impl<T> Work<T> {
    /// What came of it, once it has ended; nothing in it if it broke off.
    pub(super) fn result(&self) -> Option<Option<T>> {
        match self.0.try_recv() {
            Ok(result) => Some(Some(result)),
            Err(TryRecvError::Disconnected) => Some(None),
            Err(TryRecvError::Empty) => None,
        }
    }

    /// Waits for what comes of it; nothing if it breaks off.
    pub(super) fn wait(&self) -> Option<T> {
        self.0.recv().ok()
    }
}

/// Wakes the window when it goes, whatever became of the work.
struct WakeOnDrop(Wake);

impl Drop for WakeOnDrop {
    fn drop(&mut self) {
        (self.0)();
    }
}

/// Begins to do something on a thread of its own; the window is woken at its end.
///
/// # Errors
/// A system without threads.
pub(super) fn begin<T: Send + 'static>(
    name: &str,
    wake: &Wake,
    work: impl FnOnce() -> T + Send + 'static,
) -> std::io::Result<Work<T>> {
    let (sender, done) = channel();
    let wake_on_drop = WakeOnDrop(Arc::clone(wake));
    let work = move || {
        let _wake_on_drop = wake_on_drop;
        // Dropped before the window is woken: whoever is woken finds the end, also of work that broke off.
        let sender = sender;
        // A window that closed does not listen any more.
        let _ = sender.send(work());
    };
    std::thread::Builder::new().name(name.into()).spawn(work)?;
    Ok(Work(done))
}
