//! What the pen does on the canvas, as the artist chooses it.

use crate::sketch::Tool;

/// What the pen does on the canvas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CanvasTool {
    /// Draws a stroke of this kind.
    Draw(Tool),
    /// Removes what it touches: whole strokes, or only the part touched.
    Erase {
        /// Only the part touched.
        partial: bool,
    },
    /// Selects strokes with a lasso and changes them.
    Select,
    /// Moves the canvas.
    Pan,
}

impl Default for CanvasTool {
    fn default() -> Self {
        Self::Draw(Tool::Auto)
    }
}

/// How strokes are mirrored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mirror {
    /// Left and right change places.
    LeftRight,
    /// Top and bottom change places.
    TopBottom,
}
