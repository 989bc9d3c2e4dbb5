//! What a plain reading says, whatever the plant.

use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::sketch::Reading;

/// A plain reading: the lines that it uses and what they become.
pub(super) struct Plain {
    pub uses: Vec<usize>,
    pub parts: Vec<Made>,
    pub reading: Reading,
    pub habit: Option<Habit>,
}

impl Plain {
    /// The same with its log-odds.
    pub(super) fn hypothesis(self, score: f32) -> Hypothesis {
        let Self { uses, parts, reading, habit } = self;
        Hypothesis { uses, score, parts, solids: Vec::new(), reading, habit }
    }
}
