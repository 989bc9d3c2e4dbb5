//! What the artist can choose about the canvas.

use crate::app::pen_uses::PenUses;
use crate::app::stabiliser::Stabiliser;
use crate::pen::PressureCurve;
use serde::{Deserialize, Serialize};

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
