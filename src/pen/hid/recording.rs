//! Recordings of tablets: what devices sent, report by report, in a text file.
//!
//! A person whose tablet is not understood sends one; tests play them. The format is described in `docs/pen-recordings.md`.
//! Serial numbers of devices are not written: they would tell who sent it. Nor are USB strings, unless that person agrees.

use super::device::DeviceInfo;
use super::strings::{self, DeviceStrings};
use std::collections::BTreeMap;
use std::io::{self, Write};

/// First line of every recording: the format's name and version.
pub const FIRST_LINE: &str = "penstemon-pen-recording 1";

/// The USB strings that tell tablets apart and hold their ranges.
pub const STRINGS_KEPT: [u8; 10] = [2, 4, 5, 6, 100, 121, 123, 200, 201, 202];

/// Everything that some devices sent.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Recording {
    /// The devices, by their number.
    pub devices: Vec<RecordedDevice>,
    /// What happened, in order of time.
    pub entries: Vec<Entry>,
}

/// Who a recorded device is.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RecordedDevice {
    /// Its identity, without its serial number.
    pub info: DeviceInfo,
    /// Its report descriptor.
    pub descriptor: Vec<u8>,
    /// String descriptors that were kept, by their indices.
    pub strings: BTreeMap<u8, Vec<u8>>,
}

/// Reads the strings of a device that a recording keeps; its serial number is left out wherever it stands.
pub fn strings_to_keep(device: &DeviceInfo, strings: &mut dyn DeviceStrings) -> BTreeMap<u8, Vec<u8>> {
    let serial = device.serial.trim();
    let names_it = |descriptor: &[u8]| {
        !serial.is_empty() && strings::text(descriptor).is_some_and(|text| text.contains(serial))
    };
    let read = STRINGS_KEPT.into_iter().filter_map(|index| Some((index, strings.read(index).ok()?)));
    read.filter(|(_, descriptor)| !descriptor.is_empty() && !names_it(descriptor)).collect()
}

/// One thing that happened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Microseconds since the recording began.
    pub time_us: u64,
    /// The device's number.
    pub device: usize,
    /// What.
    pub what: Recorded,
}

/// What a device did.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Recorded {
    /// It sent a report, its report id first, 0 for devices without.
    Report(Vec<u8>),
    /// It was unplugged; nothing more comes from it.
    Gone,
}

impl Recording {
    /// The recording as a file's text.
    pub fn to_text(&self) -> String {
        let mut writer = RecordingWriter { out: Vec::new(), devices: 0, line: Vec::new() };
        // Writing into memory does not fail.
        let _ = self.write(&mut writer);
        String::from_utf8(writer.out).unwrap_or_default()
    }

    fn write(&self, writer: &mut RecordingWriter<Vec<u8>>) -> io::Result<()> {
        writeln!(writer.out, "{FIRST_LINE}")?;
        for device in &self.devices {
            writer.device(device)?;
        }
        self.entries.iter().try_for_each(|entry| match &entry.what {
            Recorded::Report(report) => writer.report(entry.time_us, entry.device, report),
            Recorded::Gone => writer.gone(entry.time_us, entry.device),
        })
    }
}

/// Writes a recording while it happens, whole lines at a time.
#[derive(Debug)]
pub struct RecordingWriter<W: Write> {
    out: W,
    devices: usize,
    /// Room for a line, so that none is taken for each.
    line: Vec<u8>,
}

impl<W: Write> RecordingWriter<W> {
    /// Begins a recording.
    ///
    /// # Errors
    /// What the file says.
    pub fn new(mut out: W) -> io::Result<Self> {
        writeln!(out, "{FIRST_LINE}")?;
        Ok(Self { out, devices: 0, line: Vec::new() })
    }

    /// Introduces a device and returns its number.
    ///
    /// # Errors
    /// What the file says.
    pub fn device(&mut self, device: &RecordedDevice) -> io::Result<usize> {
        let number = self.devices;
        self.devices += 1;
        let DeviceInfo { path, vendor_id, product_id, bus, product, manufacturer, usage, interface, .. } =
            &device.info;
        let mut text = format!("device {number}\nbus {}\n", bus.name());
        text += &format!("vendor {vendor_id:04x}\nproduct {product_id:04x}\n");
        text += &format!("usage {:04x}{:04x}\n", usage.0, usage.1);
        if let Some(interface) = interface {
            text += &format!("interface {interface}\n");
        }
        for (key, value) in [("manufacturer", manufacturer), ("name", product), ("path", path)] {
            let value = one_line(value);
            if !value.is_empty() {
                text += &format!("{key} {value}\n");
            }
        }
        let mut lines = text.into_bytes();
        for (index, string) in &device.strings {
            write!(lines, "string {index} ")?;
            push_hex(&mut lines, string);
            lines.push(b'\n');
        }
        lines.extend_from_slice(b"descriptor ");
        push_hex(&mut lines, &device.descriptor);
        lines.push(b'\n');
        self.out.write_all(&lines)?;
        Ok(number)
    }

    /// A report, its report id first.
    ///
    /// # Errors
    /// What the file says.
    pub fn report(&mut self, time_us: u64, device: usize, report: &[u8]) -> io::Result<()> {
        self.line(time_us, device, |line| push_hex(line, report))
    }

    /// The device was unplugged.
    ///
    /// # Errors
    /// What the file says.
    pub fn gone(&mut self, time_us: u64, device: usize) -> io::Result<()> {
        self.line(time_us, device, |line| line.extend_from_slice(b"gone"))
    }

    fn line(&mut self, time_us: u64, device: usize, what: impl FnOnce(&mut Vec<u8>)) -> io::Result<()> {
        self.line.clear();
        match device {
            0 => write!(self.line, "{time_us} ")?,
            device => write!(self.line, "{time_us} {device}:")?,
        }
        what(&mut self.line);
        self.line.push(b'\n');
        self.out.write_all(&self.line)
    }

    /// Brings everything to the file.
    ///
    /// # Errors
    /// What the file says.
    pub fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// Longest name that is written and read, in bytes.
pub(super) const MAX_TEXT_BYTES: usize = 256;

/// A device's text as it can stand in a line: without control characters, without space around it, not too long.
pub(super) fn one_line(text: &str) -> String {
    let visible: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let mut line = visible.trim();
    while line.len() > MAX_TEXT_BYTES {
        let end = line.char_indices().last().map_or(0, |(end, _)| end);
        line = line.get(..end).unwrap_or_default().trim_end();
    }
    line.to_owned()
}

fn push_hex(line: &mut Vec<u8>, bytes: &[u8]) {
    const DIGITS: &[u8; 16] = b"0123456789abcdef";
    let digit = |half: u8| DIGITS.get(usize::from(half)).copied().unwrap_or(b'0');
    line.extend(bytes.iter().flat_map(|byte| [digit(byte >> 4), digit(byte & 15)]));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_written_without_asking_for_memory() {
        let mut writer = RecordingWriter::new(std::io::sink()).unwrap();
        writer.report(u64::MAX, 63, &[0xA5; 64]).unwrap();
        let room = (writer.line.as_ptr(), writer.line.capacity());
        for time_us in 0..1000 {
            writer.report(time_us, 1, &[7; 64]).unwrap();
        }
        writer.gone(1000, 1).unwrap();
        assert_eq!((writer.line.as_ptr(), writer.line.capacity()), room);
        assert_eq!(writer.line, b"1000 1:gone\n");
    }
}
