//! Gives free memory back to the system when a thread comes to rest.
//!
//! The allocator (mimalloc) keeps what is freed for a second, as it may be needed again at once, and returns it only with
//! what it does next: after many further allocations, or when any thread ends. A program at rest does neither, and would
//! keep the memory of a plant that is no longer shown. So a thread that has worked and has had nothing to do for a little
//! longer than that second starts a thread that ends at once. That takes about a tenth of a millisecond, and what is
//! returned is that of the whole process.
//!
//! What a thread had allocated and another one freed comes back only when the first one allocates or ends; so the threads of
//! builds end at rest, too (`build_threads`).
//!
//! Limits: a page of the allocator that still holds one living block stays.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// How long a thread rests before it gives back: longer than the allocator keeps what is free.
pub(super) const REST: Duration = Duration::from_millis(1200);

/// Waits until a shared state has changed, and gives free memory back if it waits for long. `has_worked` says whether there
/// may be any; it is cleared by giving back.
pub(super) fn wait<'a, T>(
    state: &'a Mutex<T>,
    changed: &Condvar,
    guard: MutexGuard<'a, T>,
    has_worked: &mut bool,
) -> MutexGuard<'a, T> {
    if !*has_worked {
        return changed.wait(guard).unwrap_or_else(PoisonError::into_inner);
    }
    let (guard, waited) = changed.wait_timeout(guard, REST).unwrap_or_else(PoisonError::into_inner);
    if !waited.timed_out() {
        return guard;
    }
    // No other thread may wait for the state meanwhile.
    drop(guard);
    give_back();
    *has_worked = false;
    state.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Gives back what is free.
pub(super) fn give_back() {
    let ended = std::thread::Builder::new().name("free memory".into()).spawn(|| ());
    match ended.map(std::thread::JoinHandle::join) {
        Ok(Ok(())) => tracing::debug!("free memory was given back"),
        // It goes back with what is allocated next.
        Ok(Err(_)) | Err(_) => tracing::debug!("no thread to give free memory back with"),
    }
}
