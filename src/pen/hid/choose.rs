//! Which decoder reads a device.
//!
//! A device whose descriptor describes a pen is read by its descriptor; so are tablets whose reports a kernel driver has
//! rewritten, since it rewrites the descriptor as well. What is left may be a tablet of the table ([`super::table`]): it is
//! known by its numbers, the lengths of its reports and its USB strings, and woken before it is read. Where these leave a
//! doubt, the best guess is taken unless the artist chose a model among those that fit.

use super::report_lengths::ReportLengths;
use super::table::{Certainty, Match, Table};
use super::wake::Wake;
use super::{Abilities, ChooseError, Decode, DescriptorDecoder, DeviceInfo, Tablet, Transport};
use crate::pen::machine::Silence;
use glam::DVec2;
use std::collections::BTreeMap;
use std::time::Duration;

/// Models that the artist chose, by the [`identity`](DeviceInfo::identity) of their devices.
pub type Models = BTreeMap<String, String>;

/// Wakes a device up: sends what makes it report its pen in full. Called once, on the reader's thread; what fails there
/// it tells by itself, since the device may be read all the same.
pub type WakeUp = Box<dyn FnOnce(&mut dyn Transport) + Send>;

/// A decoder for a device, and what is known of the device besides.
pub struct Choice {
    /// Turns its reports into events.
    pub decoder: Box<dyn Decode>,
    /// What must be sent before its first report is read.
    pub wake_up: Option<WakeUp>,
    /// How it is read, for people.
    pub way: String,
    /// Width and height of the active area in millimetres, if known.
    pub area_mm: Option<DVec2>,
    /// The silence that says that the pen left, where the device does not.
    pub silence: Option<Silence>,
    /// What the pen can say.
    pub abilities: Abilities,
    /// The models it may be, where that is not sure.
    pub doubt: Option<Doubt>,
}

/// A tablet of which it is not sure which model it is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Doubt {
    /// Models that fit, the best guess first.
    pub models: Vec<String>,
    /// The one it is read as.
    pub taken: String,
    /// The artist chose it.
    pub is_chosen: bool,
}

/// The decoder for a device, `None` for a device that is no pen.
///
/// # Errors
/// A descriptor that cannot be understood, or a tablet that only its USB strings would tell from others.
pub fn choose_decoder(device: &DeviceInfo, descriptor: &[u8]) -> Result<Option<Choice>, ChooseError> {
    choose_model(device, descriptor, None)
}

/// The same; where a doubt is left, the device is read as this model if it may be one.
///
/// # Errors
/// As before, if no model is given that fits.
pub fn choose_model(
    device: &DeviceInfo,
    descriptor: &[u8],
    model: Option<&str>,
) -> Result<Option<Choice>, ChooseError> {
    let by_itself = DescriptorDecoder::new(descriptor);
    if let Ok(Some(decoder)) = by_itself {
        let abilities = decoder.abilities();
        return Ok(Some(Choice {
            wake_up: None,
            way: "its report descriptor".to_owned(),
            area_mm: decoder.area_mm(),
            silence: (!abilities.leaves).then_some(Silence::KNOWN),
            abilities,
            decoder: Box::new(decoder),
            doubt: None,
        }));
    }
    match from_table(device, descriptor, model)? {
        Some(choice) => Ok(Some(choice)),
        None => Ok(by_itself.map(|_| None)?),
    }
}

/// The decoder of a tablet that is known by name.
fn from_table(
    device: &DeviceInfo,
    descriptor: &[u8],
    model: Option<&str>,
) -> Result<Option<Choice>, ChooseError> {
    let Some(table) = Table::shipped().inspect_err(|error| tracing::error!("{error}")).ok() else {
        return Ok(None);
    };
    if !table.knows(device.vendor_id, device.product_id) {
        return Ok(None);
    }
    let lengths = ReportLengths::of(descriptor);
    let mut strings = strings::Reader::new(device);
    let found = table.find(
        device.vendor_id,
        device.product_id,
        lengths.input,
        lengths.output,
        device.interface,
        &mut |index| strings.read(index),
    );
    match take(&found, model) {
        Taken::Pen(tablet, doubt) => Ok(Some(Choice {
            decoder: tablet.decoder(lengths.input),
            wake_up: wake_up(tablet.wake.clone(), lengths),
            way: format!("the table, as {}", tablet.name),
            area_mm: Some(tablet.area_mm),
            silence: tablet.silence(),
            abilities: abilities(tablet),
            doubt,
        })),
        Taken::NoPen => Ok(None),
        Taken::Untold(models) => Err(ChooseError::StringsUnread { models, reason: strings.kept() }),
    }
}

/// What a match comes to.
#[derive(Debug)]
enum Taken<'t> {
    /// It is read as this tablet.
    Pen(&'t Tablet, Option<Doubt>),
    /// It is no node of a pen.
    NoPen,
    /// Only its strings would tell which of these it is.
    Untold(Vec<String>),
}

/// The tablet that a device is read as: the one that fits, the one that the artist chose of several, or the best guess.
fn take<'t>(found: &Match<'t>, model: Option<&str>) -> Taken<'t> {
    let pens = || found.tablets.iter().copied().filter(|tablet| !tablet.keys_only);
    let models: Vec<String> = pens().map(|tablet| tablet.name.clone()).collect();
    let chosen = pens().find(|tablet| model == Some(tablet.name.as_str()));
    let best = found.best().filter(|tablet| !tablet.keys_only);
    match (found.certainty, chosen.or(best)) {
        (Certainty::Sure, _) => best.map_or(Taken::NoPen, |tablet| Taken::Pen(tablet, None)),
        (_, Some(tablet)) => {
            let doubt = Doubt { models, taken: tablet.name.clone(), is_chosen: chosen.is_some() };
            Taken::Pen(tablet, Some(doubt))
        }
        (Certainty::StringsUnread, None) if !models.is_empty() => Taken::Untold(models),
        (_, None) => Taken::NoPen,
    }
}

fn abilities(tablet: &Tablet) -> Abilities {
    Abilities {
        pressure_levels: u64::from(tablet.pressure) + 1,
        tilt: tablet.tilts,
        barrel_buttons: tablet.buttons,
        leaves: tablet.silence().is_none(),
        touch: tablet.touch.is_some(),
        ..Abilities::default()
    }
}

fn wake_up(wake: Wake, lengths: ReportLengths) -> Option<WakeUp> {
    if wake.is_empty() {
        return None;
    }
    Some(Box::new(move |transport| {
        let strings = strings::Reader::new(transport.info());
        let name = transport.info().name();
        let mut io = Waking { transport, strings };
        // Feature reports go as they are: the longest that a node declares says nothing of the others.
        for fault in wake.run(lengths.output, 0, &mut io) {
            tracing::warn!("{name}: {fault}");
        }
    }))
}

/// An open device that is being woken.
struct Waking<'a> {
    transport: &'a mut dyn Transport,
    strings: strings::Reader,
}

impl super::wake::WakeIo for Waking<'_> {
    fn read_string(&mut self, index: u8) -> std::io::Result<()> {
        self.strings.request(index)
    }

    fn send_feature(&mut self, report: &[u8]) -> std::io::Result<()> {
        self.transport.send_feature(report).map_err(std::io::Error::other)
    }

    fn write_output(&mut self, report: &[u8]) -> std::io::Result<()> {
        self.transport.write(report).map_err(std::io::Error::other)
    }

    fn sleep(&mut self, milliseconds: u64) {
        std::thread::sleep(Duration::from_millis(milliseconds));
    }
}

/// USB strings, which hidraw does not give.
#[cfg(feature = "program")]
mod strings {
    use crate::pen::hid::usb_strings::{UsbStrings, UsbStringsError};
    use crate::pen::hid::{Bus, DeviceInfo, StringsKept};
    use std::io;
    use std::path::PathBuf;

    /// Opens the USB device when the first string is asked for.
    pub(super) struct Reader {
        /// The node, until it was tried; only devices on a cable have strings.
        node: Option<PathBuf>,
        device: Option<UsbStrings>,
        fault: Option<UsbStringsError>,
        is_wireless: bool,
    }

    impl Reader {
        pub(super) fn new(device: &DeviceInfo) -> Self {
            let node = (device.bus == Bus::Usb).then(|| PathBuf::from(&device.path));
            Self { node, device: None, fault: None, is_wireless: device.bus == Bus::Bluetooth }
        }

        fn device(&mut self) -> Option<&UsbStrings> {
            if let Some(node) = self.node.take() {
                match UsbStrings::open(&node) {
                    Ok(device) => self.device = Some(device),
                    Err(fault) => self.fault = Some(fault),
                }
            }
            self.device.as_ref()
        }

        pub(super) fn read(&mut self, index: u8) -> Option<String> {
            self.device()?.read(index)
        }

        pub(super) fn request(&mut self, index: u8) -> io::Result<()> {
            match self.device() {
                Some(device) => device.request(index),
                None => {
                    let none = "it has no USB strings; connect it by cable".to_owned();
                    Err(io::Error::other(self.fault.as_ref().map_or(none, ToString::to_string)))
                }
            }
        }

        /// Why strings that were asked for were not given.
        pub(super) fn kept(&self) -> StringsKept {
            match &self.fault {
                _ if self.is_wireless => StringsKept::Wireless,
                Some(UsbStringsError::Forbidden { .. }) => StringsKept::Forbidden,
                _ => StringsKept::Unanswered,
            }
        }
    }
}

/// Without the program no USB device is opened.
#[cfg(not(feature = "program"))]
mod strings {
    use crate::pen::hid::{DeviceInfo, StringsKept};

    pub(super) struct Reader;

    impl Reader {
        pub(super) fn new(_: &DeviceInfo) -> Self {
            Self
        }

        pub(super) fn read(&mut self, _: u8) -> Option<String> {
            None
        }

        pub(super) fn request(&mut self, _: u8) -> std::io::Result<()> {
            Err(std::io::Error::other("USB strings belong to the program"))
        }

        pub(super) fn kept(&self) -> StringsKept {
            StringsKept::Unanswered
        }
    }
}

#[cfg(test)]
#[path = "choose_tests.rs"]
mod tests;
