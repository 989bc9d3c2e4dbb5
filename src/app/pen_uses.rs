//! What the parts of a pen besides its tip do, as the artist chooses it.

use serde::{Deserialize, Serialize};

/// What a button of a pen does, or its eraser end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ButtonUse {
    /// Moves the canvas while held.
    #[default]
    Pan,
    /// Turns the plant while held.
    Orbit,
    /// The tip removes strokes while it is held.
    Erase,
    /// The tip removes what it touches while it is held.
    ErasePartly,
    /// Asks about the stroke under the pen, as a tap on it does.
    Pick,
    /// Asks what to draw next.
    Menu,
    /// Takes the last step back.
    Undo,
    /// Does again what was taken back.
    Redo,
    /// Nothing.
    Nothing,
}

impl ButtonUse {
    /// Every use, in the order in which they are offered.
    pub const ALL: [Self; 9] = [
        Self::Pan,
        Self::Orbit,
        Self::Erase,
        Self::ErasePartly,
        Self::Pick,
        Self::Menu,
        Self::Undo,
        Self::Redo,
        Self::Nothing,
    ];
}

/// What the parts of a pen besides its tip do; they work while the pen hovers, too.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PenUses {
    /// The barrel button near the tip; default pan.
    pub lower: ButtonUse,
    /// The barrel button away from the tip; default pick.
    pub upper: ButtonUse,
    /// The third barrel button, which few pens have; default menu.
    pub third: ButtonUse,
    /// The other end of the pen, when it touches; default erase.
    pub eraser: ButtonUse,
}

impl Default for PenUses {
    fn default() -> Self {
        let (lower, upper, third) = (ButtonUse::Pan, ButtonUse::Pick, ButtonUse::Menu);
        Self { lower, upper, third, eraser: ButtonUse::Erase }
    }
}
