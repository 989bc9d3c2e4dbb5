//! Remarks gathered while a drawing is read; bounded, so that a file odd in every stroke does not drown its reader.

use super::{StrokeId, Warning, limits};

/// Collects up to [`limits::MAX_WARNINGS`] remarks and counts the rest.
#[derive(Debug, Default)]
pub(crate) struct Warnings {
    kept: Vec<Warning>,
    dropped: usize,
}

impl Warnings {
    /// Adds a remark; the message is only made if there is room for it.
    pub(crate) fn add(&mut self, stroke: Option<StrokeId>, message: impl FnOnce() -> String) {
        if self.kept.len() < limits::MAX_WARNINGS {
            self.kept.push(Warning { stroke, message: message() });
        } else {
            self.dropped += 1;
        }
    }

    /// All remarks, closed by a count of those left out.
    pub(crate) fn into_vec(mut self) -> Vec<Warning> {
        if self.dropped > 0 {
            let message = format!("and {} more remarks like these", self.dropped);
            self.kept.push(Warning { stroke: None, message });
        }
        self.kept
    }
}
