//! The brushes of the view of the plant: which is in hand, how they are set, and the stroke under the pen.

use super::drawing_surface::DrawingSurface;
use super::live_plant::UnderPen;
use super::stroke_frame::StrokeFrame;
use crate::app::brush_settings::BrushSettings;
use crate::sketch::{Brush, StrokeId, StrokePoint, Tool};
use glam::DVec2;

/// A stroke of a brush under the pen.
#[derive(Clone, Debug)]
pub(super) struct BrushStroke {
    pub(super) id: StrokeId,
    pub(super) tool: Tool,
    pub(super) brush: Brush,
    pub(super) surface: DrawingSurface,
    pub(super) frame: StrokeFrame,
    pub(super) began_ms: f64,
    /// Its samples so far, at least one, canvas pixels.
    pub(super) points: Vec<StrokePoint>,
}

impl BrushStroke {
    /// The stroke as the worker is given it: of all but growth and light. What grows in a growth brush would be another with every sample, so
    /// it grows when the pen is lifted.
    pub(super) fn under_pen(&self) -> Option<UnderPen<'_>> {
        let &Self { id, tool, brush, ref points, .. } = self;
        let settled = points.len();
        matches!(tool, Tool::PruningBrush | Tool::LeafBrush | Tool::FlowerBrush).then_some(UnderPen {
            id,
            tool,
            points,
            settled,
            brush: Some(brush),
        })
    }
}

/// The brushes.
#[derive(Debug, Default)]
pub(super) struct BrushTool {
    /// The one in hand.
    pub(super) tool: Option<Tool>,
    pub(super) settings: BrushSettings,
    /// What is under the pen.
    pub(super) stroke: Option<BrushStroke>,
    /// Where the pointer hovers over the plant, physical pixels of the window.
    pub(super) hovered: Option<DVec2>,
}

impl BrushTool {
    /// Forgets what belongs to another drawing.
    pub(super) fn let_go(&mut self) {
        (self.stroke, self.hovered) = (None, None);
    }
}
