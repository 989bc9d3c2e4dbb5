//! Work on threads of its own, and what those threads wish for.

use crate::app::action::Action;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};

/// Calls from other threads that there is something to collect.
pub(super) type Wake = Arc<dyn Fn() + Send + Sync>;

/// The way back from other threads.
pub(super) struct Background {
    wake: Wake,
    wishes: Sender<Action>,
    wished: Receiver<Action>,
}

impl Background {
    pub(super) fn new(wake: Wake) -> Self {
        let (wishes, wished) = channel();
        Self { wake, wishes, wished }
    }

    /// What calls from other threads.
    pub(super) fn wake(&self) -> &Wake {
        &self.wake
    }

    /// Where other threads put their wishes; they call [`Self::wake`] afterwards.
    pub(super) fn wishes(&self) -> &Sender<Action> {
        &self.wishes
    }

    /// The next wish of another thread.
    pub(super) fn take_wish(&self) -> Option<Action> {
        self.wished.try_recv().ok()
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
struct Farewell(Wake);

impl Drop for Farewell {
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
    let (tell, done) = channel();
    let farewell = Farewell(Arc::clone(wake));
    let work = move || {
        let _farewell = farewell;
        // Dropped before the farewell: whoever is woken finds the end, also of work that broke off.
        let tell = tell;
        // A window that closed does not listen any more.
        let _ = tell.send(work());
    };
    std::thread::Builder::new().name(name.into()).spawn(work)?;
    Ok(Work(done))
}
