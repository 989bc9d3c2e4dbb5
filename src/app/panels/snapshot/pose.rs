//! Branches that are being turned and bent, as the card over the plant shows them.

/// How branches are being turned and bent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PoseState {
    /// Whether the tool is in hand.
    pub on: bool,
    /// Whether it bends branches, not turns them.
    pub bends: bool,
    /// Whether the branch that was held last stands otherwise than it was drawn or grew.
    pub posed: bool,
    /// How many times as thick it is; none where none was held or it is cut off.
    pub thickness: Option<f32>,
}
