//! The levels of detail that the window shows: which, those that are there, and the one on the screen.

use super::background::Work;
use crate::model::Model;
use crate::pipeline::{Built, LevelSet, SetupError};
use std::sync::{Arc, Weak};

/// What comes of making levels.
pub(super) type Levels = Result<Vec<Model>, SetupError>;

/// The levels of detail that the window shows.
#[derive(Default)]
pub(super) struct ShownLevels {
    /// Which; none where the plant is shown as it is.
    pub(super) set: Option<LevelSet>,
    /// The level that is shown at any distance.
    pub(super) held: Option<usize>,
    /// Those that are being made, and of which plant.
    pub(super) work: Option<(Weak<Built>, Work<Levels>)>,
    pub(super) made: Option<Made>,
    /// The one on the screen.
    pub(super) shown: usize,
}

/// Levels that are there.
pub(super) struct Made {
    pub(super) of: Weak<Built>,
    pub(super) levels: Vec<Arc<Model>>,
    pub(super) triangles: Vec<usize>,
    /// Shares of the view's height down to which each is shown.
    pub(super) shares: Vec<f32>,
}

impl ShownLevels {
    /// The level on the screen; none where the plant is shown as it is.
    pub(super) fn shown(&self) -> Option<&Arc<Model>> {
        self.made.as_ref()?.levels.get(self.shown)
    }

    /// Whether levels are being made.
    pub(super) fn is_busy(&self) -> bool {
        self.work.is_some()
    }
}
