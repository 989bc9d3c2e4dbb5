//! What the system says when it ends the program: at logout, or by `kill`. The window then closes as if the display had gone:
//! what is being saved is finished, and the drawing is kept to be offered at the next start.
//!
//! Signals of Unix; other systems ask the window to close.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether the program is to end.
#[derive(Clone, Debug, Default)]
pub(super) struct Ending(Arc<AtomicBool>);

impl Ending {
    /// Listens from now on, and calls `wake` when a signal comes. A second signal ends the program at once.
    ///
    /// # Errors
    /// A system without threads.
    #[cfg(unix)]
    pub(super) fn listen(wake: impl Fn() + Send + 'static) -> io::Result<Self> {
        use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
        let ending = Self::default();
        let requested = ending.clone();
        let mut signals = signal_hook::iterator::Signals::new([SIGTERM, SIGHUP, SIGINT])?;
        let listen = move || {
            for signal in signals.forever() {
                if requested.0.swap(true, Ordering::Relaxed) {
                    // What the signal does where nobody listens.
                    let _ = signal_hook::low_level::emulate_default_handler(signal);
                }
                wake();
            }
        };
        std::thread::Builder::new().name("signals".to_owned()).spawn(listen)?;
        Ok(ending)
    }

    /// Nobody says anything here.
    ///
    /// # Errors
    /// None.
    #[cfg(not(unix))]
    pub(super) fn listen(_: impl Fn() + Send + 'static) -> io::Result<Self> {
        Ok(Self::default())
    }

    /// Whether the program was asked to end.
    pub(super) fn is_requested(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
