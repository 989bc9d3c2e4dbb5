//! Branches that are being drawn in space, as the panel over the plant shows them.

use crate::app::work_surface::WorkSurface;

/// How branches are being drawn in space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SpaceState {
    /// Whether there is a plant to draw on.
    pub any: bool,
    /// Whether the tool is in hand.
    pub on: bool,
    /// The surface that it draws on.
    pub surface: WorkSurface,
    /// Whether there is a branch to lift.
    pub can_lift: bool,
}
