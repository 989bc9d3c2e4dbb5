//! A species file that the drawing names and that is gone: said once, and another can be chosen.

use super::Editor;
use crate::app::messages::Localize as _;
use crate::app::panels::snapshot::{Notice, PathPurpose};

impl Editor {
    /// Says that the drawing's species file is missing, if it is; another that is chosen takes its place in one step.
    pub(super) fn notify_missing_species(&mut self) {
        if let Some(missing) = self.live.missing_species() {
            let what = missing.localize(self.prefs.messages());
            self.notify(Notice { find: Some(PathPurpose::Species), ..Notice::warning(what, "") });
        }
    }
}

#[cfg(test)]
#[path = "missing_species_tests.rs"]
mod tests;
