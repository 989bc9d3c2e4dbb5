//! Which decoder reads a device.
//!
//! A device whose descriptor describes a pen is read by its descriptor; so are tablets whose reports a kernel driver has
//! rewritten, since it rewrites the descriptor as well. What is left may be a tablet of the table ([`super::table`]): it is
//! known by its numbers, the lengths of its reports and its USB strings, and woken before it is read.

use super::report_lengths::ReportLengths;
use super::table::Table;
use super::wake::Wake;
use super::{Abilities, Decode, DescriptorDecoder, DescriptorError, DeviceInfo, Tablet, Transport};
use glam::DVec2;
use std::time::Duration;

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
    /// The device does not say when its pen leaves: silence says it.
    pub leaves_by_silence: bool,
    /// What the pen can say.
    pub abilities: Abilities,
}

/// The decoder for a device, `None` for a device that is no pen.
///
/// # Errors
/// A descriptor that cannot be understood.
pub fn choose_decoder(device: &DeviceInfo, descriptor: &[u8]) -> Result<Option<Choice>, DescriptorError> {
    let by_itself = DescriptorDecoder::new(descriptor);
    if let Ok(Some(decoder)) = by_itself {
        let abilities = decoder.abilities();
        return Ok(Some(Choice {
            wake_up: None,
            way: "its report descriptor".to_owned(),
            area_mm: decoder.area_mm(),
            leaves_by_silence: !abilities.leaves,
            abilities,
            decoder: Box::new(decoder),
        }));
    }
    match from_table(device, descriptor) {
        Some(choice) => Ok(Some(choice)),
        None => by_itself.map(|_| None),
    }
}

/// The decoder of a tablet that is known by name.
fn from_table(device: &DeviceInfo, descriptor: &[u8]) -> Option<Choice> {
    let table = Table::shipped().inspect_err(|error| tracing::error!("{error}")).ok()?;
    if !table.knows(device.vendor_id, device.product_id) {
        return None;
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
    let Some(tablet) = found.best().filter(|tablet| !tablet.keys_only) else {
        if let Some(first) = found.tablets.first() {
            tracing::warn!(
                "{}: it may be {} and others, which its USB strings would tell",
                device.name(),
                first.name
            );
        }
        return None;
    };
    Some(Choice {
        decoder: tablet.decoder(lengths.input),
        wake_up: wake_up(tablet.wake.clone(), lengths),
        way: format!("the table, as {}", tablet.name),
        area_mm: Some(tablet.area_mm),
        leaves_by_silence: tablet.leaves_by_silence(),
        abilities: abilities(tablet),
    })
}

fn abilities(tablet: &Tablet) -> Abilities {
    Abilities {
        pressure_levels: u64::from(tablet.pressure) + 1,
        tilt: tablet.tilts,
        barrel_buttons: tablet.buttons,
        leaves: !tablet.leaves_by_silence(),
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
    use crate::pen::hid::usb_strings::UsbStrings;
    use crate::pen::hid::{Bus, DeviceInfo};
    use std::io;
    use std::path::PathBuf;

    /// Opens the USB device when the first string is asked for.
    pub(super) struct Reader {
        /// The node, until it was tried; only devices on a cable have strings.
        node: Option<PathBuf>,
        device: Option<UsbStrings>,
    }

    impl Reader {
        pub(super) fn new(device: &DeviceInfo) -> Self {
            let node = (device.bus == Bus::Usb).then(|| PathBuf::from(&device.path));
            Self { node, device: None }
        }

        fn device(&mut self) -> Option<&UsbStrings> {
            if let Some(node) = self.node.take() {
                let opened = UsbStrings::open(&node);
                self.device = opened.inspect_err(|error| tracing::warn!("{error}")).ok();
            }
            self.device.as_ref()
        }

        pub(super) fn read(&mut self, index: u8) -> Option<String> {
            self.device()?.read(index)
        }

        pub(super) fn request(&mut self, index: u8) -> io::Result<()> {
            match self.device() {
                Some(device) => device.request(index),
                None => Err(io::Error::other("its USB device cannot be opened")),
            }
        }
    }
}

/// Without the program no USB device is opened.
#[cfg(not(feature = "program"))]
mod strings {
    use crate::pen::hid::DeviceInfo;

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
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pen::hid::simulated::SimulatedDevice;
    use crate::pen::hid::{HidEvent, RawPen};

    /// A node of the maker's own page with one input report of so many bytes besides its id.
    fn vendor_descriptor(id: u8, bytes: u8) -> Vec<u8> {
        let head = [0x06, 0x0A, 0xFF, 0x09, 0x01, 0xA1, 0x01, 0x85, id, 0x75, 0x08, 0x95, bytes, 0x81, 0x02];
        [&head[..], &[0x95, 0x07, 0x91, 0x02, 0xC0]].concat()
    }

    #[test]
    fn a_tablet_of_the_table_is_known_woken_and_read() {
        // Adesso Cybertablet K8: known by its numbers and lengths alone.
        let info = DeviceInfo { vendor_id: 0x28BD, product_id: 0x0910, ..DeviceInfo::default() };
        let mut choice =
            choose_decoder(&info, &vendor_descriptor(2, 9)).unwrap().expect("it is in the table");
        assert!(choice.way.contains("K8"), "{}", choice.way);
        assert_eq!(choice.abilities.pressure_levels, 8192);
        let device = SimulatedDevice::new(info, &vendor_descriptor(2, 9));
        choice.wake_up.take().expect("it must be woken")(&mut device.open());
        assert_eq!(device.written().0, [[0x02, 0xB0, 0x04, 0, 0, 0, 0, 0]]);
        let mut pens: Vec<RawPen> = Vec::new();
        // In range and touching at the middle of 20320 × 11430 steps, half pressed.
        let report = [0x02, 0xA1, 0xB0, 0x27, 0x53, 0x16, 0x00, 0x10, 0, 0];
        choice.decoder.decode(&report, &mut |event| {
            if let HidEvent::Pen(pen) = event {
                pens.push(pen);
            }
        });
        assert!(pens[0].touches && pens[0].position.distance(DVec2::splat(0.5)) < 1e-3);
        assert!((pens[0].pressure.unwrap() - 0.5).abs() < 1e-3);
    }

    #[test]
    fn what_neither_describes_itself_nor_is_known_is_no_pen() {
        let info = DeviceInfo { vendor_id: 0x1234, product_id: 0x5678, ..DeviceInfo::default() };
        assert!(choose_decoder(&info, &vendor_descriptor(2, 9)).unwrap().is_none());
        assert!(choose_decoder(&info, &[]).is_err());
    }
}
