//! Turns of the tests that open windows: some side by side, each on its own display, and those that measure alone.
//!
//! A window waits for most of its test: for its first picture, for the hand, for what never comes. So a few are open at
//! once, also on two cores.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// Tests that have their windows open at the same time.
const SIDE_BY_SIDE: usize = 3;

/// Places that are taken of [`SIDE_BY_SIDE`].
static TAKEN: Mutex<usize> = Mutex::new(0);
static LEFT: Condvar = Condvar::new();

/// A test's turn, until it is dropped.
pub(crate) struct Turn(usize);

/// Waits for a turn beside others.
pub(crate) fn beside_others() -> Turn {
    take(1)
}

/// Waits for a turn with no other test beside it.
pub(crate) fn alone() -> Turn {
    take(SIDE_BY_SIDE)
}

fn taken() -> MutexGuard<'static, usize> {
    // A count is sound whatever a test that held it died of.
    TAKEN.lock().unwrap_or_else(PoisonError::into_inner)
}

fn take(places: usize) -> Turn {
    let free = LEFT.wait_while(taken(), |taken| *taken + places > SIDE_BY_SIDE);
    *free.unwrap_or_else(PoisonError::into_inner) += places;
    Turn(places)
}

impl Drop for Turn {
    fn drop(&mut self) {
        *taken() -= self.0;
        LEFT.notify_all();
    }
}
