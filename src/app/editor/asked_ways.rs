//! The ways to read some strokes while they are looked for and once they have been found.

use crate::app::ways_to_read::WayToRead;
use crate::sketch::StrokeId;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The ways to read some strokes that were asked for.
pub(super) struct AskedWays {
    /// The strokes.
    about: Vec<StrokeId>,
    found: Option<Vec<WayToRead>>,
    /// Tells whoever looks for them that nobody waits any more.
    stop: Arc<AtomicBool>,
}

impl Drop for AskedWays {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}

impl AskedWays {
    /// They are being looked for, until `stop` is set.
    pub(super) fn begin(about: Vec<StrokeId>, stop: Arc<AtomicBool>) -> Self {
        Self { about, found: None, stop }
    }

    /// The strokes.
    pub(super) fn about(&self) -> &[StrokeId] {
        &self.about
    }

    /// The ways, once they have been found.
    pub(super) fn found(&self) -> Option<&[WayToRead]> {
        self.found.as_deref()
    }

    /// Takes what was found, if it is what was asked for.
    pub(super) fn take(&mut self, about: &[StrokeId], ways: Vec<WayToRead>) {
        if self.about == about {
            self.found = Some(ways);
        }
    }
}
