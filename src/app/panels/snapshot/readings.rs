//! Strokes that were read together, and how else they could be.

use crate::app::ways_to_read::WayToRead;
use crate::sketch::{Reading, StrokeId};

/// Strokes that were read together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReadTogether {
    /// What they were read as.
    pub reading: Reading,
    /// The first of them, which is read so nowhere else.
    pub stroke: StrokeId,
    /// How many they are.
    pub count: usize,
}

/// How the strokes that a menu is about can be read.
#[derive(Clone, Debug, PartialEq)]
pub struct Ways {
    /// How many strokes they are.
    pub count: usize,
    /// What they are read as now; none where each is a part by itself.
    pub reading: Option<Reading>,
    /// All ways; none while they are looked for.
    pub found: Option<Vec<WayToRead>>,
}
