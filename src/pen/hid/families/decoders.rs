//! Which code reads which family.

use super::wheels::WithWheels;
use super::{Bytes, Decode, Family, HidEvent, OneEvent, Spec};
use super::{acepen, genius, keys, others, uclogic, veikk, xp_pen};
use super::{wacom_basic, wacom_finger, wacom_graphire, wacom_intuos, wacom_modern, wacom_pl};

/// Reads one report of a family without memory.
type Read = fn(&Spec, Bytes<'_>) -> Option<HidEvent>;

/// A family whose reports each say everything.
struct Plain {
    spec: Spec,
    read: Read,
}

impl OneEvent for Plain {
    fn read(&mut self, b: Bytes<'_>) -> Option<HidEvent> {
        (self.read)(&self.spec, b)
    }
}

/// Reports with one byte too many in front, as nodes made by Wacom's own Windows driver have them.
struct Shifted(Box<dyn Decode>);

impl Decode for Shifted {
    fn decode(&mut self, report: &[u8], sink: &mut dyn FnMut(HidEvent)) {
        self.0.decode(report.get(1..).unwrap_or_default(), sink);
    }
}

impl Spec {
    /// A decoder with a state of its own for one open node.
    #[must_use]
    pub fn decoder(&self) -> Box<dyn Decode> {
        let inner = WithWheels::around(self.family.decoder(self), self);
        if self.shifted { Box::new(Shifted(inner)) } else { inner }
    }
}

impl Family {
    fn decoder(self, spec: &Spec) -> Box<dyn Decode> {
        match self {
            Self::Acepen => Box::new(acepen::Acepen::new(*spec)),
            Self::Wacom64bAux => Box::new(wacom_finger::Chunks::new(*spec)),
            Self::WacomBamboo => Box::new(wacom_graphire::Graphire::bamboo(*spec)),
            Self::WacomGraphire => Box::new(wacom_graphire::Graphire::new(*spec)),
            Self::WacomIntuos => Box::new(wacom_basic::Bamboo::new(*spec)),
            Self::WacomIntuosV1
            | Self::WacomIntuosPro
            | Self::WacomIntuos4
            | Self::WacomIntuos3
            | Self::WacomIntuos3ExtraAux
            | Self::WacomCintiqV1 => Box::new(wacom_intuos::Intuos::new(*spec)),
            Self::WacomIntuosV2 | Self::WacomIntuosV3 => Box::new(wacom_modern::Modern::new(*spec)),
            Self::WacomIntuosBluetooth => Box::new(wacom_modern::Bluetooth::new(*spec)),
            Self::WacomPl => Box::new(wacom_pl::Pl::new(*spec)),
            _ => Box::new(Plain { spec: *spec, read: self.read() }),
        }
    }

    /// How families without memory are read; those with memory say nothing here.
    fn read(self) -> Read {
        match self {
            Self::Generic => uclogic::generic,
            Self::Uclogic => uclogic::without_tilt,
            Self::UclogicTilt | Self::UclogicV2 | Self::HuionTiltWheel => uclogic::with_tilt,
            Self::UclogicV1 => uclogic::v1,
            Self::HuionGiano => uclogic::giano,
            Self::HuionInspiroy => uclogic::inspiroy,
            Self::XpPen => xp_pen::xp_pen,
            Self::XpPenGen2 => xp_pen::gen2,
            Self::XpPenOffsetPressure => xp_pen::offset_pressure,
            Self::XpPenOffsetAux => xp_pen::offset_aux,
            Self::Xencelabs => xp_pen::xencelabs,
            Self::XpPenDedicatedAux => keys::xp_pen_dedicated,
            Self::Veikk => veikk::veikk,
            Self::VeikkTilt => veikk::tilt,
            Self::VeikkV1 => veikk::v1,
            Self::VeikkA15 => veikk::a15,
            Self::VeikkPlain => veikk::plain,
            Self::WacomBambooPad => wacom_basic::bamboo_pad,
            Self::WacomPtu => wacom_basic::ptu,
            Self::WacomBambooV2Aux => keys::bamboo_v2,
            Self::AuxGeneric => keys::generic,
            Self::Genius => genius::genius,
            Self::GeniusV2 => genius::v2,
            Self::ViewsonicWoodpad => others::woodpad,
            Self::Xenx => others::xenx,
            Self::FloogooFma => others::floogoo,
            Self::Lifetec => others::lifetec,
            Self::Robotpen => others::robotpen,
            _ => |_, _| None,
        }
    }
}
