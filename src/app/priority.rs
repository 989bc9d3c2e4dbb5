//! Work that steps back behind the stroke under the pen.
//!
//! Where there are fewer processors than work, the plant's threads would take turns with those that draw the ink. So they
//! run at a lower priority, and so do the threads that they start: those of a software graphics driver, and those that
//! share a build. What nothing else needs they get all the same. Only under Linux, where priority is a thread's own.

/// How far: as far as can be, so that a frame of ink, which passes through several threads of driver and screen, waits at
/// none of them.
#[cfg(target_os = "linux")]
const NICE: i32 = 19;

/// Lets the calling thread step back, and the threads that it starts from now on.
pub(super) fn step_back() {
    #[cfg(target_os = "linux")]
    if let Err(error) = rustix::process::nice(NICE) {
        tracing::debug!("a thread keeps its priority: {error}");
    }
}
