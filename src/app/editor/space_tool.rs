//! The tool that draws branches in space: the surface that it draws on, and the branch under the pen.

use super::drawing_surface::DrawingSurface;
use super::live_plant::UnderPen;
use super::stroke_frame::StrokeFrame;
use crate::app::work_surface::WorkSurface;
use crate::sketch::{StrokeId, StrokePoint, Tool};
use glam::{DVec2, Vec3};

/// A branch under the pen.
#[derive(Clone, Debug)]
pub(super) struct SpaceStroke {
    pub(super) id: StrokeId,
    pub(super) surface: DrawingSurface,
    pub(super) frame: StrokeFrame,
    pub(super) began_ms: f64,
    /// Its samples so far, at least one, canvas pixels.
    pub(super) points: Vec<StrokePoint>,
    /// It takes the place of a branch that is there, which is lifted.
    pub(super) lifts: bool,
}

impl SpaceStroke {
    /// The stroke as the worker is given it.
    pub(super) fn under_pen(&self) -> UnderPen<'_> {
        UnderPen {
            id: self.id,
            tool: Tool::SpaceBranch,
            points: &self.points,
            settled: self.points.len(),
            brush: None,
        }
    }
}

/// The tool that draws branches in space.
#[derive(Debug, Default)]
pub(super) struct SpaceTool {
    pub(super) is_on: bool,
    pub(super) surface: WorkSurface,
    /// What is under the pen.
    pub(super) stroke: Option<SpaceStroke>,
    /// The branch drawn last, and the way that it was looked at.
    pub(super) last: Option<(StrokeId, Vec3)>,
    /// Where a branch would begin under the pointer, physical pixels of the window.
    pub(super) hovered: Option<DVec2>,
}

impl SpaceTool {
    /// Forgets what belongs to another drawing.
    pub(super) fn let_go(&mut self) {
        (self.stroke, self.last, self.hovered) = (None, None, None);
    }
}
