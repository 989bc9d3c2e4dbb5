//! Phyllotaxis: how buds and leaves stand around the axis that carries them.

use serde::{Deserialize, Serialize};

/// How the buds of an axis, or its leaves, are arranged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Arrangement {
    /// One per node, turned by the divergence angle.
    Spiral,
    /// One per node, left and right in turn; branches are flat sprays.
    Alternate,
    /// Pairs, each square to the one below.
    Opposite,
    /// A ring at the end of each year's shoot.
    Whorl,
}
