//! The tool that turns and bends branches: whether it is in hand, and what is held.

use crate::sketch::{WoodName, WoodPose};
use glam::{Quat, Vec3};

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

/// The tool that turns and bends branches.
#[derive(Debug, Default)]
pub(super) struct PoseTool {
    pub(super) is_on: bool,
    /// Branches are bent, not turned.
    pub(super) bends: bool,
    pub(super) hold: Option<WoodHold>,
    /// The branch that was held or chosen last.
    pub(super) last: Option<WoodName>,
}

impl PoseTool {
    /// Lets go of the branch.
    pub(super) fn let_go(&mut self) {
        (self.hold, self.last) = (None, None);
    }
}
