//! What the artist chose about pens: how they are read, and for each pen how it presses, what its buttons do and what its
//! tablet covers. Plain data, kept with the other settings.

use super::pen_uses::PenUses;
use super::tablet_keys::TabletKeys;
use crate::pen::PressureCurve;
use crate::pen::calibration::Calibration;
use crate::pen::mapping::Turn;
use serde::{Deserialize, Deserializer, Serialize};

/// What the whole of a tablet that is read directly covers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Covers {
    /// The paper.
    Canvas,
    /// The window.
    #[default]
    Window,
    /// A monitor; the window itself where the system does not say where monitors are.
    Monitor,
}

/// A tablet of which it is not sure which model it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TabletDoubt {
    /// What it is known by ([`crate::pen::hid::DeviceInfo::identity`]).
    pub device: String,
    /// Its name, as the device reports it.
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
    /// How the tablet lies, seen from how it is meant to.
    #[serde(alias = "is_turned", deserialize_with = "turn_or_whether")]
    pub turn: Turn,
    /// The monitor that it covers, counted from 0, if it covers one; otherwise the one on which the window is.
    pub monitor: Option<u8>,
    /// What puts places right on a pen display.
    pub calibration: Calibration,
    /// What the tablet's own keys and wheels do.
    pub keys: TabletKeys,
}

/// Earlier settings say only whether the tablet lies upside down.
fn turn_or_whether<'de, D: Deserializer<'de>>(from: D) -> Result<Turn, D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged)]
    enum Kept {
        Turn(Turn),
        IsTurned(bool),
    }
    Ok(match Kept::deserialize(from)? {
        Kept::Turn(turn) => turn,
        Kept::IsTurned(is_turned) => {
            if is_turned {
                Turn::Half
            } else {
                Turn::None
            }
        }
    })
}

impl Default for PenSettings {
    fn default() -> Self {
        Self {
            pressure: PressureCurve::default(),
            uses: PenUses::default(),
            covers: Covers::default(),
            keeps_aspect: true,
            turn: Turn::None,
            monitor: None,
            calibration: Calibration::default(),
            keys: TabletKeys::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn earlier_settings_are_understood() {
        let read = |text: &str| toml::from_str::<PenSettings>(text).unwrap();
        assert_eq!(read("is_turned = true").turn, Turn::Half);
        assert_eq!(read("is_turned = false"), PenSettings::default());
        assert_eq!(read("turn = \"left\"").turn, Turn::Left);
        let chosen = PenSettings { turn: Turn::Right, monitor: Some(1), ..PenSettings::default() };
        assert_eq!(read(&toml::to_string(&chosen).unwrap()), chosen);
    }
}
