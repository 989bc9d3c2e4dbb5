//! The pen last used, and how pens are read.

use crate::app::pen_settings::{PenSettings, TabletDoubt};
use crate::pen::PenSource;

/// The pen last used, and how pens are read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PenState {
    /// Its name, where it is known, and how it is read; `None` before there was one.
    pub device: Option<String>,
    /// Whether its tablet is read directly.
    pub is_raw: bool,
    /// Its charge in percent, where it says so.
    pub battery: Option<u8>,
    /// Why a tablet cannot be read, and what to do.
    pub trouble: Option<String>,
    /// Tablets of which it is not sure which model they are.
    pub doubts: Vec<TabletDoubt>,
    /// How many monitors its tablet may cover, as far as that is known.
    pub monitors: usize,
    /// What its tablet covers, in points, if all of it is in the window.
    pub target: Option<egui::Rect>,
    /// How pens are read.
    pub source: PenSource,
    /// What the artist chose for it.
    pub settings: PenSettings,
    /// How it is held now.
    pub live: PenLive,
}

/// How a pen is held.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PenLive {
    /// Pressure as the pen reports it, 0 to 1.
    pub pressure: f32,
    /// Lean to the right and toward the artist, degrees.
    pub tilt_deg: [f32; 2],
}
