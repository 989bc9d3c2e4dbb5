//! The display goes away under the window: the X server ends, the session is closed, a remote connection breaks.
//!
//! Then the program can only end, with a message about the drawing, which the journal has. Three things happen, depending on
//! who notices: winit ends its loop with an error; a call of winit or of the driver panics; or Xlib, while winit waits for
//! events, ends the process itself by `exit(1)`. The first two come back to the caller of [`run`]. Of the third only the
//! destructors of the main thread's own variables learn, and one of them writes the message. A driver may also wait for ever
//! for a picture to be shown: so a thread waits beside the window on a connection of its own, and ends a process that has not
//! ended [`GRACE`] after its X server.

use std::cell::Cell;
use std::io::Write as _;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The message.
pub(super) const LOST: &str =
    "the connection to the display broke; the drawing is kept and offered at the next start";

/// Writes the message when the process ends while the window is open.
struct ReportOnExit {
    is_open: Cell<bool>,
}

impl Drop for ReportOnExit {
    fn drop(&mut self) {
        if self.is_open.get() {
            report();
        }
    }
}

fn report() {
    // Nobody is left to report a failure to.
    let _ = writeln!(std::io::stderr(), "penstemon: {LOST}");
}

thread_local! {
    static REPORT_ON_EXIT: ReportOnExit = const { ReportOnExit { is_open: Cell::new(false) } };
}

/// Runs the window on the main thread until it is closed; `None` where the display went away.
///
/// # Panics
/// As `window` does, with the display there.
pub(super) fn run<T>(window: impl FnOnce() -> T) -> Option<T> {
    let hook = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        let is_of_display = std::thread::current().name() == Some("main") && is_gone();
        if !is_of_display {
            hook(panic);
        }
    }));
    let is_open = Arc::new(AtomicBool::new(true));
    #[cfg(target_os = "linux")]
    end_after_the_server(&is_open);
    REPORT_ON_EXIT.with(|report| report.is_open.set(true));
    let done = catch_unwind(AssertUnwindSafe(window));
    REPORT_ON_EXIT.with(|report| report.is_open.set(false));
    is_open.store(false, Ordering::Relaxed);
    match done {
        Ok(done) => Some(done),
        Err(_) if is_gone() => None,
        Err(panic) => resume_unwind(panic),
    }
}

/// How long a window may take to end by itself.
#[cfg(target_os = "linux")]
const GRACE: std::time::Duration = std::time::Duration::from_secs(3);

/// Whether the window's X server ended: by the time that somebody asks, another may answer under its name.
#[cfg(target_os = "linux")]
static SERVER_ENDED: AtomicBool = AtomicBool::new(false);

/// Ends the process where the window is still open after its X server ended; without a server, or a thread, nothing.
#[cfg(target_os = "linux")]
fn end_after_the_server(is_open: &Arc<AtomicBool>) {
    use x11rb::connection::Connection as _;
    if wayland().is_some() {
        return;
    }
    let Ok((server, _)) = x11rb::connect(None) else { return };
    let is_open = Arc::clone(is_open);
    let wait = move || {
        // No events were asked for; the few that a server sends unasked say nothing.
        while server.wait_for_event().is_ok() {}
        SERVER_ENDED.store(true, Ordering::Relaxed);
        std::thread::sleep(GRACE);
        if is_open.load(Ordering::Relaxed) {
            report();
            std::process::exit(1);
        }
    };
    // Without it a window that never ends is the worst that happens.
    let _ = std::thread::Builder::new().name("display watch".to_owned()).spawn(wait);
}

/// The Wayland compositor that the window is shown by.
#[cfg(target_os = "linux")]
fn wayland() -> Option<std::os::unix::net::UnixStream> {
    let folder = std::path::PathBuf::from(std::env::var_os("XDG_RUNTIME_DIR")?);
    std::os::unix::net::UnixStream::connect(folder.join(std::env::var_os("WAYLAND_DISPLAY")?)).ok()
}

/// Whether no display answers any more.
#[cfg(target_os = "linux")]
fn is_gone() -> bool {
    SERVER_ENDED.load(Ordering::Relaxed) || wayland().is_none() && x11rb::connect(None).is_err()
}

#[cfg(not(target_os = "linux"))]
fn is_gone() -> bool {
    false
}
