//! The tool that paints a garden: how its brush is set, and the stroke under the pen.

use crate::app::garden_brush::GardenBrush;
use crate::sketch::GardenStroke;
use glam::{DVec2, Vec2};

/// The tool that paints a garden.
#[derive(Debug, Default)]
pub(super) struct GardenPainting {
    pub(super) is_on: bool,
    pub(super) brush: GardenBrush,
    /// The artist has said how wide it is.
    pub(super) is_set: bool,
    /// The garden of this drawing was looked at from above.
    pub(super) is_shown: bool,
    /// What is under the pen.
    pub(super) stroke: Option<GardenStroke>,
    /// Where the pen came down that takes strokes away, on the ground.
    pub(super) erases: Option<Vec2>,
    /// Where the pointer hovers over the plant, physical pixels of the window.
    pub(super) hovered: Option<DVec2>,
}

impl GardenPainting {
    /// Whether the pen does something on the ground.
    pub(super) fn is_busy(&self) -> bool {
        self.stroke.is_some() || self.erases.is_some()
    }

    /// What the pen began comes to nothing.
    pub(super) fn drop_stroke(&mut self) {
        (self.stroke, self.erases) = (None, None);
    }

    /// Forgets what belongs to another drawing.
    pub(super) fn let_go(&mut self) {
        self.drop_stroke();
        self.hovered = None;
    }

    /// Forgets the drawing.
    pub(super) fn forget(&mut self) {
        self.let_go();
        self.is_shown = false;
    }
}
