//! The tool that turns and bends branches: whether it is in hand, and what is held.

use crate::sketch::{WoodName, WoodPose};
use glam::{DVec2, Quat, Vec3};

/// A branch that is held.
#[derive(Clone, Copy, Debug)]
pub(super) struct WoodHold {
    /// Its pose before.
    pub(super) before: WoodPose,
    /// Where it begins and where it is held, metres.
    pub(super) base: Vec3,
    pub(super) grip: Vec3,
    /// How far along it that is, 0 to 1.
    pub(super) share: f32,
    /// What its foot is turned by, its own turn included.
    pub(super) foot: Quat,
}

/// The ring around the base of a branch, held.
#[derive(Clone, Copy, Debug)]
pub(super) struct RingHold {
    /// The branch's pose before, and what its foot was turned by, its own turn included.
    pub(super) before: WoodPose,
    pub(super) foot: Quat,
    /// From the eye to the base, of unit length.
    pub(super) sight: Vec3,
    /// Middle of the ring and where the pointer was last, physical pixels of the window.
    pub(super) centre: DVec2,
    pub(super) last: DVec2,
    /// By how much it has turned, radians, with the clock.
    pub(super) angle: f64,
}

/// The tool that turns and bends branches.
#[derive(Debug, Default)]
pub(super) struct PoseTool {
    pub(super) is_on: bool,
    /// Branches are bent, not turned.
    pub(super) bends: bool,
    pub(super) hold: Option<WoodHold>,
    pub(super) ring: Option<RingHold>,
    /// The ring turns by an eighth of what the pointer does.
    pub(super) is_fine: bool,
    /// The branch that was held or chosen last.
    pub(super) last: Option<WoodName>,
}

impl PoseTool {
    /// Lets go of the branch.
    pub(super) fn let_go(&mut self) {
        (self.hold, self.ring, self.last) = (None, None, None);
    }
}
