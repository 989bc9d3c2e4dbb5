//! What the artist chose about pens: how they are read, and for each pen how it presses, what its buttons do and what its
//! tablet covers. Plain data, kept with the other settings.

use super::canvas::PenUses;
use crate::pen::PressureCurve;
use serde::{Deserialize, Serialize};

/// What the whole of a tablet that is read directly covers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Covers {
    /// The paper.
    Canvas,
    /// The window.
    #[default]
    Window,
    /// The monitor on which the window is; the window itself where the system does not say where that is.
    Monitor,
}

/// A tablet of which it is not sure which model it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TabletDoubt {
    /// What it is known by ([`crate::pen::hid::DeviceInfo::identity`]).
    pub device: String,
    /// Its name, as it tells it.
    pub name: String,
    /// Models that it may be, the best guess first.
    pub models: Vec<String>,
    /// The model that it is read as; `None` if it is not read.
    pub taken: Option<String>,
    /// The artist chose that model.
    pub is_chosen: bool,
}

/// What the artist chose for one pen.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PenSettings {
    /// What its pressure becomes.
    pub pressure: PressureCurve,
    /// What its buttons and its other end do.
    pub uses: PenUses,
    /// What its tablet covers.
    pub covers: Covers,
    /// Whether circles stay circles: part of the tablet is then not used.
    pub keeps_aspect: bool,
    /// Whether the tablet lies upside down, for the left hand.
    pub is_turned: bool,
}

impl Default for PenSettings {
    fn default() -> Self {
        Self {
            pressure: PressureCurve::default(),
            uses: PenUses::default(),
            covers: Covers::default(),
            keeps_aspect: true,
            is_turned: false,
        }
    }
}
