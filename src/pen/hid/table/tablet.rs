//! A tablet as the table lists it, and the table itself: what a device is known by, and all that is needed to use it.

use crate::pen::hid::device::{Bus, DeviceInfo};
use crate::pen::hid::families::{Family, Spec};
use crate::pen::hid::report::Decode;
use crate::pen::hid::uclogic::Protocol;
use crate::pen::hid::wake::Wake;
use crate::pen::machine::Silence;
use glam::DVec2;
use regex::bytes::Regex;

/// What a USB string must say.
#[derive(Clone, Debug)]
pub struct StringRule {
    /// Index of the string descriptor.
    pub index: u8,
    /// What to look for in it; strings of firmwares may hold NULs.
    pub pattern: Regex,
    /// It must be found; otherwise it must not.
    pub must_match: bool,
}

/// One HID node of a model: what it is known by, and all that is needed to use it.
#[derive(Clone, Debug)]
pub struct Tablet {
    /// Maker and model.
    pub name: String,
    /// USB or Bluetooth vendor id.
    pub vendor: u16,
    /// USB or Bluetooth product id.
    pub product: u16,
    /// Active area in millimetres.
    pub area_mm: DVec2,
    /// Greatest raw x and y.
    pub steps: [u32; 2],
    /// Greatest raw pressure.
    pub pressure: u32,
    /// Greatest raw x and y of fingers, on tablets that feel them.
    pub touch: Option<[u32; 2]>,
    /// Buttons on the pen.
    pub buttons: u8,
    /// Express keys on the tablet.
    pub keys: u8,
    /// The pen's lean is measured.
    pub tilts: bool,
    /// Layout of the reports.
    pub family: Family,
    /// One byte too many stands before each report.
    pub shifted: bool,
    /// The node is reached over Bluetooth.
    pub bluetooth: bool,
    /// The node carries express keys and fingers; the pen is on another.
    pub keys_only: bool,
    /// Bytes of the longest input report, id included.
    pub input_length: Option<usize>,
    /// Bytes of the longest output report, id included; 0 for nodes without.
    pub output_length: Option<usize>,
    /// Number of the USB interface.
    pub interface: Option<u8>,
    /// What strings of the device must say.
    pub strings: Vec<StringRule>,
    /// How it is woken.
    pub wake: Wake,
    /// Why this row may be wrong.
    pub doubtful: Option<String>,
}

impl Tablet {
    /// A decoder for one open node whose longest input report has so many bytes, id included.
    #[must_use]
    pub fn decoder(&self, report_length: usize) -> Box<dyn Decode> {
        self.spec(report_length).decoder()
    }

    /// What decoding needs.
    #[must_use]
    pub fn spec(&self, report_length: usize) -> Spec {
        Spec {
            family: self.family,
            steps: self.steps,
            pressure: self.pressure,
            touch: self.touch,
            tilts: self.tilts,
            shifted: self.shifted,
            report_id: self.report_id(),
            report_length,
        }
    }

    /// The silence after which the pen is gone, where no report of this tablet says so.
    #[must_use]
    pub fn silence(&self) -> Option<Silence> {
        let by_wake = matches!(self.family, Family::Generic | Family::Uclogic)
            && self.wake.strings.contains(&Protocol::Second.string());
        if by_wake { Protocol::Second.silence() } else { self.family.silence() }
    }

    /// Identifying or waking it needs the device's USB strings, which hidraw does not give.
    #[must_use]
    pub fn needs_strings(&self) -> bool {
        !self.strings.is_empty() || !self.wake.strings.is_empty()
    }

    /// The report id of the protocol it is woken into, where one way of waking leads to one protocol.
    #[must_use]
    pub fn report_id(&self) -> Option<u8> {
        match (&self.wake.strings[..], &self.wake.outputs[..]) {
            (strings, []) => {
                let known = Protocol::ALL.into_iter().find(|known| strings.contains(&known.string()));
                known.map(Protocol::report_id)
            }
            // Output reports of XP-Pen and Veikk carry the id that input reports will have.
            ([], [first, ..]) => first.first().copied().filter(|id| matches!(id, 0x02 | 0x09)),
            _ => None,
        }
    }
}

/// All tablets, in the order in which they are tried.
#[derive(Clone, Debug)]
pub struct Table {
    pub(super) tablets: Vec<Tablet>,
    /// Makers of nothing but tablets whose models say their ranges themselves.
    pub(super) self_describing: Vec<u16>,
}

impl Table {
    /// Every node of every tablet, in the order in which they are tried.
    #[must_use]
    pub fn tablets(&self) -> &[Tablet] {
        &self.tablets
    }

    /// Some tablet has these ids: the device is a tablet even if none of its nodes fits.
    #[must_use]
    pub fn knows(&self, vendor: u16, product: u16) -> bool {
        self.tablets.iter().any(|t| (t.vendor, t.product) == (vendor, product))
    }

    /// Models of this maker say their ranges themselves, so that they are read without being listed.
    #[must_use]
    pub fn is_self_describing(&self, vendor: u16) -> bool {
        self.self_describing.contains(&vendor)
    }

    /// The rules that are made of the table let the user open this device.
    #[must_use]
    pub fn rules_cover(&self, device: &DeviceInfo) -> bool {
        let ids = (device.vendor_id, device.product_id);
        match device.bus {
            Bus::Bluetooth => self.tablets.iter().any(|t| t.bluetooth && (t.vendor, t.product) == ids),
            Bus::I2c | Bus::Spi => false,
            Bus::Usb | Bus::Unknown => self.is_self_describing(ids.0) || self.knows(ids.0, ids.1),
        }
    }
}
