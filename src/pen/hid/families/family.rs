//! The names of the families.

use crate::pen::machine::Silence;
use serde::{Deserialize, Serialize};

/// A layout of reports; written in the tablet table in lower case with hyphens.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Family {
    /// Flags, x, y, pressure: what most older tablets of the UC-Logic line send.
    Generic,
    /// UC-Logic with keys, without tilt.
    Uclogic,
    /// UC-Logic with keys and tilt.
    UclogicTilt,
    /// UC-Logic with tilt and a wheel.
    UclogicV2,
    /// UC-Logic whose sixth flag says "in range".
    UclogicV1,
    /// Huion's large tablets and displays: 24-bit positions, dials.
    HuionGiano,
    /// Huion tablets with groups of keys.
    HuionInspiroy,
    /// Huion tablets with a touch ring.
    HuionTiltWheel,
    /// XP-Pen, UGEE, Parblo, Adesso.
    XpPen,
    /// XP-Pen with 14 bits of pressure.
    XpPenGen2,
    /// XP-Pen with 13 bits of pressure and other things above them.
    XpPenOffsetPressure,
    /// UC-Logic-made XP-Pen whose fifth flag says "keys".
    XpPenOffsetAux,
    /// Key node of XP-Pen's first displays.
    XpPenDedicatedAux,
    /// Xencelabs.
    Xencelabs,
    /// Veikk, Xoppox.
    Veikk,
    /// Veikk with tilt.
    VeikkTilt,
    /// Early Veikk whose keys type.
    VeikkV1,
    /// Veikk A15 with 16-bit positions.
    VeikkA15,
    /// Early Veikk without keys.
    VeikkPlain,
    /// Acepen.
    Acepen,
    /// Wacom Bamboo and small Intuos until 2015.
    WacomIntuos,
    /// Wacom Intuos 1, 2 and 5, early Cintiq.
    WacomIntuosV1,
    /// Wacom Intuos Pro until 2016.
    WacomIntuosPro,
    /// Wacom Intuos 4.
    WacomIntuos4,
    /// Wacom Intuos 3.
    WacomIntuos3,
    /// Wacom Cintiq 12WX.
    WacomIntuos3ExtraAux,
    /// Wacom Cintiq 21UX and 22HD.
    WacomCintiqV1,
    /// Wacom from 2017 on.
    WacomIntuosV2,
    /// Wacom from 2023 on.
    WacomIntuosV3,
    /// Wacom Intuos Pro of 2017 over Bluetooth: seven moments in a report.
    WacomIntuosBluetooth,
    /// Wacom Graphire.
    WacomGraphire,
    /// Wacom Bamboo of 2007.
    WacomBamboo,
    /// Wacom Bamboo Pad.
    WacomBambooPad,
    /// Wacom PL.
    WacomPl,
    /// Wacom PTU.
    WacomPtu,
    /// Keys and fingers of Wacom tablets in chunks of eight bytes.
    #[serde(rename = "wacom-64b-aux")]
    Wacom64bAux,
    /// Keys of the second Bamboo.
    WacomBambooV2Aux,
    /// Keys in the fourth byte.
    AuxGeneric,
    /// Genius.
    Genius,
    /// Waltop-made Genius, Trust.
    GeniusV2,
    /// ViewSonic Woodpad.
    ViewsonicWoodpad,
    /// XENX.
    Xenx,
    /// FlooGoo.
    FloogooFma,
    /// LifeTec.
    Lifetec,
    /// RobotPen.
    Robotpen,
}

impl Family {
    /// Every family, in the order of their declaration.
    #[rustfmt::skip]
    pub const ALL: [Self; 45] = [
        Self::Generic, Self::Uclogic, Self::UclogicTilt, Self::UclogicV2, Self::UclogicV1, Self::HuionGiano,
        Self::HuionInspiroy, Self::HuionTiltWheel, Self::XpPen, Self::XpPenGen2, Self::XpPenOffsetPressure,
        Self::XpPenOffsetAux, Self::XpPenDedicatedAux, Self::Xencelabs, Self::Veikk, Self::VeikkTilt, Self::VeikkV1,
        Self::VeikkA15, Self::VeikkPlain, Self::Acepen, Self::WacomIntuos, Self::WacomIntuosV1, Self::WacomIntuosPro,
        Self::WacomIntuos4, Self::WacomIntuos3, Self::WacomIntuos3ExtraAux, Self::WacomCintiqV1, Self::WacomIntuosV2,
        Self::WacomIntuosV3, Self::WacomIntuosBluetooth, Self::WacomGraphire, Self::WacomBamboo, Self::WacomBambooPad,
        Self::WacomPl, Self::WacomPtu, Self::Wacom64bAux, Self::WacomBambooV2Aux, Self::AuxGeneric, Self::Genius,
        Self::GeniusV2, Self::ViewsonicWoodpad, Self::Xenx, Self::FloogooFma, Self::Lifetec, Self::Robotpen,
    ];

    /// The family's nodes carry keys and fingers, never a pen.
    #[must_use]
    pub fn is_keys_only(self) -> bool {
        matches!(
            self,
            Self::XpPenDedicatedAux | Self::Wacom64bAux | Self::WacomBambooV2Aux | Self::AuxGeneric
        )
    }

    /// The silence after which the pen is gone, where no report says "out of range" or none is known to. Some families
    /// have such a report only after one way of waking, which
    /// [`Tablet::silence`](crate::pen::hid::table::Tablet::silence) knows.
    #[must_use]
    pub fn silence(self) -> Option<Silence> {
        match self {
            Self::UclogicTilt
            | Self::UclogicV2
            | Self::HuionGiano
            | Self::HuionInspiroy
            | Self::HuionTiltWheel => Some(Silence::KNOWN),
            Self::Genius | Self::GeniusV2 | Self::WacomBambooPad | Self::Lifetec => Some(Silence::LIKELY),
            _ => None,
        }
    }
}
