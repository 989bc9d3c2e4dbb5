//! Remarks gathered while a drawing is read; bounded, so that a file odd in every stroke does not drown its reader.

use super::{Remark, StrokeId, Warning, limits};

/// Collects up to [`limits::MAX_WARNINGS`] remarks and counts the rest.
#[derive(Debug, Default)]
pub(crate) struct Warnings {
    kept: Vec<Warning>,
    dropped: usize,
}

impl Warnings {
    /// Adds a remark; it is only made if there is room for it.
    pub(crate) fn add(&mut self, stroke: Option<StrokeId>, remark: impl FnOnce() -> Remark) {
        if self.kept.len() < limits::MAX_WARNINGS {
            self.kept.push(Warning { stroke, remark: remark() });
        } else {
            self.dropped += 1;
        }
    }

    /// All remarks, closed by a count of those left out.
    pub(crate) fn into_vec(mut self) -> Vec<Warning> {
        if self.dropped > 0 {
            self.kept.push(Warning { stroke: None, remark: Remark::More { count: self.dropped } });
        }
        self.kept
    }
}
