//! What is seen of a tool's work before that counts.

use crate::app::canvas::transform::Drag;
use crate::sketch::change::StrokeChange;
use glam::DVec2;

/// What is seen of a tool's work before that counts.
#[derive(Debug, Default)]
pub(in crate::app::canvas) enum Shown {
    /// Nothing, or a stroke that grows as it is drawn.
    #[default]
    Nothing,
    /// A lasso through these places of the canvas.
    Lasso(Vec<DVec2>),
    /// Strokes changed so far.
    Changes(Vec<StrokeChange>),
    /// The selection is dragged like this.
    Drag(Drag),
}
