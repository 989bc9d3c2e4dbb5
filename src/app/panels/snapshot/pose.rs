//! Parts that are being turned, bent, straightened, moved and grafted, as the bar below the plant shows them.

use crate::app::pose_drag::PoseDrag;
use crate::modelling::OnContact;

/// How parts are being posed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PoseState {
    /// Whether there is a part to be posed.
    pub any: bool,
    /// Whether the tool is in hand.
    pub on: bool,
    /// What a drag does.
    pub drag: PoseDrag,
    /// What becomes of wood that meets other wood as it is turned.
    pub on_contact: OnContact,
    /// How many parts are chosen.
    pub chosen: usize,
    /// Whether the part that was held last stands otherwise than it was drawn or grew.
    pub posed: bool,
    /// How many times as thick or as large it is; none where none was held or it is taken away.
    pub size: Option<f32>,
    /// How far its line is drawn out straight; none where that is not a branch.
    pub straight: Option<f32>,
    /// How many years younger it is shown than it is; none where that is not a branch.
    pub younger: Option<u16>,
    /// How many years the plant grew.
    pub years: u16,
    /// Whether it is a leaf, a flower or another organ, and no branch.
    pub is_organ: bool,
}
