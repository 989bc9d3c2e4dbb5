//! The tool that shapes petals: which petal is chosen, which of its control points was touched, and what is held.

use crate::plant::PetalFrame;
use crate::sketch::StrokeId;
use crate::sketch::petal_shapes::Offsets;
use glam::Vec3;

/// A place in the net of control points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct PointPlace {
    /// From the base.
    pub(super) row: usize,
    /// From the left.
    pub(super) column: usize,
}

/// A petal by the stroke that drew it, and by its number among those that this stroke drew.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ChosenPetal {
    pub(super) stroke: StrokeId,
    pub(super) number: usize,
}

/// A control point being dragged.
#[derive(Clone, Debug)]
pub(super) struct PointHold {
    pub(super) place: PointPlace,
    /// The strokes of the flower's petals.
    pub(super) strokes: Vec<StrokeId>,
    /// How the flower was shaped before.
    pub(super) before: Offsets,
    pub(super) frame: PetalFrame,
    /// Where the point was, and where its plane was taken hold of, metres.
    pub(super) point: Vec3,
    pub(super) grip: Vec3,
}

/// The tool that shapes petals.
#[derive(Debug, Default)]
pub(super) struct PetalTool {
    pub(super) is_on: bool,
    /// Left and right may differ.
    pub(super) is_lopsided: bool,
    /// Alt is held.
    pub(super) alt: bool,
    pub(super) chosen: Option<ChosenPetal>,
    pub(super) point: Option<PointPlace>,
    pub(super) hold: Option<PointHold>,
}

impl PetalTool {
    /// Lets go of the petal.
    pub(super) fn let_go(&mut self) {
        (self.chosen, self.point, self.hold) = (None, None, None);
    }
}
