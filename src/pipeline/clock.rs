//! How long stages take, of a build or of what uses many.

use std::time::{Duration, Instant};

/// Measures the stages.
#[derive(Debug, Default)]
pub struct Clock {
    stages: Vec<(&'static str, Duration)>,
}

impl Clock {
    /// Does a stage's work.
    pub fn time<T>(&mut self, stage: &'static str, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let made = work();
        self.stages.push((stage, start.elapsed()));
        made
    }

    /// The stages so far, in order.
    pub fn take(&mut self) -> Vec<(&'static str, Duration)> {
        std::mem::take(&mut self.stages)
    }
}
