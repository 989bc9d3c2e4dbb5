//! What the artist can choose about the canvas.

use super::stroke_builder::Stabiliser;
use crate::pen::PressureCurve;
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

/// Choices, kept over sessions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CanvasSettings {
    /// How much jitter is calmed; default off.
    pub stabiliser: Stabiliser,
    /// What pens' pressure becomes; default unchanged.
    pub pressure: PressureCurve,
    /// Whether one finger draws; otherwise fingers only move the canvas. Default yes.
    pub fingers_draw: bool,
    /// What buttons and eraser end of a pen do. Of a mouse the right button picks and the middle one pans.
    pub pen: PenUses,
    /// Radius of the eraser in logical pixels, 1 to 200; default 10.
    pub eraser_radius: f64,
    /// Whether scrolling on a touchpad moves the canvas; otherwise it zooms as a wheel does. Default yes.
    pub touchpad_pans: bool,
}

impl Default for CanvasSettings {
    fn default() -> Self {
        Self {
            stabiliser: Stabiliser::Off,
            pressure: PressureCurve::default(),
            fingers_draw: true,
            pen: PenUses::default(),
            eraser_radius: 10.0,
            touchpad_pans: true,
        }
    }
}

impl CanvasSettings {
    /// Smallest and largest eraser in logical pixels.
    pub const ERASER_RADII: (f64, f64) = (1.0, 200.0);

    /// The eraser's radius in logical pixels, within bounds whatever the settings say.
    pub fn sound_eraser_radius(&self) -> f64 {
        let (least, most) = Self::ERASER_RADII;
        if self.eraser_radius.is_nan() { least } else { self.eraser_radius.clamp(least, most) }
    }
}
