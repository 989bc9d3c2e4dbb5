//! The tool that turns, bends and moves parts of the plant: whether it is in hand, and what is held.

use crate::app::pose_drag::PoseDrag;
use crate::modelling::PartFrame;
use crate::sketch::{PartName, PartPose};
use glam::{DVec2, Vec3};

/// A part that is held.
#[derive(Clone, Copy, Debug)]
pub(super) struct PartHold {
    /// What the drag does.
    pub(super) drag: PoseDrag,
    /// Its pose before, and what that starts from.
    pub(super) before: PartPose,
    pub(super) frame: PartFrame,
    /// Where it begins and where it is held, metres.
    pub(super) base: Vec3,
    pub(super) grip: Vec3,
    /// How far along it that is, 0 to 1.
    pub(super) share: f32,
}

/// The ring around the base of a part, held.
#[derive(Clone, Copy, Debug)]
pub(super) struct RingHold {
    /// The part's pose before, and what that starts from.
    pub(super) before: PartPose,
    pub(super) frame: PartFrame,
    /// From the eye to the base, of unit length.
    pub(super) sight: Vec3,
    /// Middle of the ring and where the pointer was last, physical pixels of the window.
    pub(super) centre: DVec2,
    pub(super) last: DVec2,
    /// By how much it has turned, radians, with the clock.
    pub(super) angle: f64,
}

/// The tool that turns, bends and moves parts of the plant.
#[derive(Debug, Default)]
pub(super) struct PoseTool {
    pub(super) is_on: bool,
    /// What a drag does.
    pub(super) drag: PoseDrag,
    pub(super) hold: Option<PartHold>,
    pub(super) ring: Option<RingHold>,
    /// The ring turns by an eighth of what the pointer does.
    pub(super) is_fine: bool,
    /// The part that was held or chosen last.
    pub(super) last: Option<PartName>,
}

impl PoseTool {
    /// Lets go of the part.
    pub(super) fn let_go(&mut self) {
        (self.hold, self.ring, self.last) = (None, None, None);
    }
}
