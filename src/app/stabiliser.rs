//! How much the jitter of a hand is calmed while it draws, as the artist chooses it.

use serde::{Deserialize, Serialize};

/// How much the hand's jitter is calmed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stabiliser {
    /// The samples as they are.
    #[default]
    Off,
    /// Calms the tremble of a hand and the steps of a mouse.
    Light,
    /// Calms slow waves too.
    Strong,
}

impl Stabiliser {
    /// Every strength, weakest first.
    pub const ALL: [Stabiliser; 3] = [Self::Off, Self::Light, Self::Strong];

    /// Samples on either side that a point is smoothed with.
    pub fn reach(self) -> usize {
        match self {
            Stabiliser::Off => 0,
            Stabiliser::Light => 3,
            Stabiliser::Strong => 16,
        }
    }
}
