//! Reads recordings of tablets (`docs/pen-recordings.md`), under limits that no real recording meets.

use super::descriptor_limits::MAX_DESCRIPTOR_BYTES;
use super::device::Bus;
use super::recording::{Entry, FIRST_LINE, MAX_TEXT_BYTES, Recorded, RecordedDevice, Recording, one_line};
use crate::input;
use std::io::ErrorKind;
use std::path::Path;
use thiserror::Error;

/// Longest recording: a quarter of an hour of a fast tablet.
const MAX_RECORDING_BYTES: u64 = 64 << 20;
/// Most devices in a recording.
const MAX_DEVICES: usize = 64;
/// Longest string descriptor.
const MAX_STRING_BYTES: usize = 255;
/// Longest report.
const MAX_REPORT_BYTES: usize = 4096;
/// Longest time: a week.
const MAX_TIME_US: u64 = 7 * 24 * 3600 * 1_000_000;

/// A recording that cannot be read.
#[derive(Debug, Error)]
pub enum RecordingError {
    /// The system does not give the file.
    #[error("{file}: {error}; check the name and whether the file may be read")]
    File {
        /// The file.
        file: String,
        /// What the system says.
        error: std::io::Error,
    },
    /// It is too long.
    #[error("{file}: a recording has at most {} MiB; record a shorter time", MAX_RECORDING_BYTES >> 20)]
    TooLong {
        /// The file.
        file: String,
    },
    /// A line is not as it should be.
    #[error("{file}, line {line}: {fault}")]
    Line {
        /// The file.
        file: String,
        /// The line, counted from 1.
        line: usize,
        /// What is wrong with it.
        fault: LineFault,
    },
}

/// What is wrong with a line of a recording.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum LineFault {
    /// It is no recording, or one of another version.
    #[error(
        "a recording begins with the line `{FIRST_LINE}`; record it anew with `penstemon pen record FILE`"
    )]
    FirstLine,
    /// It is no text.
    #[error("this is no UTF-8 text; the file is damaged, get it again")]
    NotText,
    /// A word that is none of the format's.
    #[error("`{0}` is no word of the format; remove the line, or see docs/pen-recordings.md")]
    Word(String),
    /// Something of a device stands before any device.
    #[error("this belongs to a device; write a line `device 0` above it")]
    NoDevice,
    /// Devices are not numbered in order, or there are too many.
    #[error("devices are numbered 0, 1, 2 and so on, at most {MAX_DEVICES} of them; this should be {0}")]
    DeviceNumber(usize),
    /// A value that cannot be.
    #[error("`{key}` cannot be `{value}`; it takes {takes}")]
    Value {
        /// The word.
        key: &'static str,
        /// What stands there.
        value: String,
        /// What could stand there.
        takes: &'static str,
    },
    /// The same word twice for one device.
    #[error("`{0}` was said of this device before; remove one of the lines")]
    Twice(&'static str),
    /// A device without a line that it needs.
    #[error("device {device} has no `{key}`; add the line to it above its first report")]
    Missing {
        /// Its number.
        device: usize,
        /// The word.
        key: &'static str,
    },
    /// A report of a device that the file has not.
    #[error("there is no device {0} above this line; add it, or correct the number before the colon")]
    UnknownDevice(String),
    /// A report of a device that is gone.
    #[error("device {0} was unplugged above; what is plugged in again is another device")]
    WasGone(usize),
    /// Time goes back, or is too late.
    #[error("the time is a number of microseconds, not less than that of the line above and at most a week")]
    Time,
    /// It is no report.
    #[error("a report is 1 to {MAX_REPORT_BYTES} bytes in hexadecimal, two digits each, or the word `gone`")]
    Report,
}

impl Recording {
    /// Reads a file.
    ///
    /// # Errors
    /// A file that cannot be read or is no recording.
    pub fn open(path: &Path) -> Result<Self, RecordingError> {
        let file = path.display().to_string();
        let bytes = input::read(path, MAX_RECORDING_BYTES).map_err(|error| match error.kind() {
            ErrorKind::FileTooLarge => RecordingError::TooLong { file: file.clone() },
            _ => RecordingError::File { file: file.clone(), error },
        })?;
        Self::from_bytes(&bytes, &file)
    }

    /// Reads the bytes of a file; `file` is its name for messages.
    ///
    /// # Errors
    /// Bytes that are no recording.
    pub fn from_bytes(bytes: &[u8], file: &str) -> Result<Self, RecordingError> {
        let file = file.to_owned();
        if bytes.len() as u64 > MAX_RECORDING_BYTES {
            return Err(RecordingError::TooLong { file });
        }
        let mut reader = Lines::default();
        let mut lines = 0;
        for (number, line) in bytes.split(|byte| *byte == b'\n').enumerate() {
            lines = number + 1;
            let read = match std::str::from_utf8(line) {
                Ok(line) if number == 0 => reader.first(line.trim_end()),
                Ok(line) => reader.line(line.trim_end()),
                Err(_) => Err(LineFault::NotText),
            };
            read.map_err(|fault| RecordingError::Line { file: file.clone(), line: lines, fault })?;
        }
        reader.check_newest().map_err(|fault| RecordingError::Line { file, line: lines, fault })?;
        Ok(reader.recording)
    }
}

/// What was read so far.
#[derive(Default)]
struct Lines {
    recording: Recording,
    /// Words said of the newest device.
    said: Vec<&'static str>,
    gone: Vec<bool>,
    time_us: u64,
}

impl Lines {
    fn first(&mut self, line: &str) -> Result<(), LineFault> {
        if line == FIRST_LINE { Ok(()) } else { Err(LineFault::FirstLine) }
    }

    fn line(&mut self, line: &str) -> Result<(), LineFault> {
        if line.is_empty() || line.starts_with('#') {
            return Ok(());
        }
        let (word, rest) = line.split_once(' ').unwrap_or((line, ""));
        if word.starts_with(|c: char| c.is_ascii_digit()) {
            return self.entry(word, rest);
        }
        match word {
            "device" => self.device(rest),
            "string" => self.string(rest),
            _ => self.identity(word, rest),
        }
    }

    fn device(&mut self, number: &str) -> Result<(), LineFault> {
        self.check_newest()?;
        let next = self.recording.devices.len();
        if number.parse() != Ok(next) || next >= MAX_DEVICES {
            return Err(LineFault::DeviceNumber(next));
        }
        self.recording.devices.push(RecordedDevice::default());
        self.gone.push(false);
        self.said.clear();
        Ok(())
    }

    /// Every device must say what its reports cannot be understood without.
    fn check_newest(&self) -> Result<(), LineFault> {
        let Some(device) = self.recording.devices.len().checked_sub(1) else { return Ok(()) };
        match ["vendor", "product", "descriptor"].into_iter().find(|key| !self.said.contains(key)) {
            Some(key) => Err(LineFault::Missing { device, key }),
            None => Ok(()),
        }
    }

    fn string(&mut self, value: &str) -> Result<(), LineFault> {
        const KEY: &str = "string";
        let device = self.recording.devices.last_mut().ok_or(LineFault::NoDevice)?;
        let wrong = || LineFault::Value {
            key: KEY,
            value: value.chars().take(40).collect(),
            takes: "a number up to 255, a space, and 1 to 255 bytes in hexadecimal",
        };
        let (index, bytes) = value.split_once(' ').ok_or_else(wrong)?;
        let index: u8 = index.parse().map_err(|_| wrong())?;
        let bytes = unhex(bytes).filter(|bytes| (1..=MAX_STRING_BYTES).contains(&bytes.len()));
        match device.strings.insert(index, bytes.ok_or_else(wrong)?) {
            Some(_) => Err(LineFault::Twice(KEY)),
            None => Ok(()),
        }
    }

    fn identity(&mut self, word: &str, value: &str) -> Result<(), LineFault> {
        const WORDS: [&str; 9] =
            ["bus", "vendor", "product", "usage", "interface", "manufacturer", "name", "path", "descriptor"];
        let key = WORDS.into_iter().find(|key| *key == word);
        let key = key.ok_or_else(|| LineFault::Word(word.chars().take(40).collect()))?;
        let device = self.recording.devices.last_mut().ok_or(LineFault::NoDevice)?;
        if self.said.contains(&key) {
            return Err(LineFault::Twice(key));
        }
        self.said.push(key);
        let wrong = |takes| LineFault::Value { key, value: value.chars().take(40).collect(), takes };
        let info = &mut device.info;
        const FOUR_DIGITS: &str = "four hexadecimal digits";
        match key {
            "bus" => {
                let bus = Bus::NAMES.iter().find(|(_, name)| *name == value);
                info.bus = bus.ok_or(wrong("usb, bluetooth, i2c, spi or unknown"))?.0;
            }
            "vendor" => info.vendor_id = number(value).ok_or(wrong(FOUR_DIGITS))?,
            "product" => info.product_id = number(value).ok_or(wrong(FOUR_DIGITS))?,
            "usage" => {
                let halves = value.split_at_checked(4).and_then(|(page, id)| number(page).zip(number(id)));
                info.usage = halves.ok_or(wrong("eight hexadecimal digits"))?;
            }
            "interface" => info.interface = Some(value.parse().map_err(|_| wrong("a number up to 255"))?),
            "descriptor" => {
                let bytes = unhex(value).filter(|bytes| bytes.len() <= MAX_DESCRIPTOR_BYTES);
                device.descriptor = bytes.ok_or(wrong("up to 4096 bytes in hexadecimal"))?;
            }
            _ => {
                if value.len() > MAX_TEXT_BYTES || one_line(value) != value {
                    return Err(wrong("up to 256 bytes of text"));
                }
                match key {
                    "manufacturer" => info.manufacturer = value.to_owned(),
                    "name" => info.product = value.to_owned(),
                    _ => info.path = value.to_owned(),
                }
            }
        }
        Ok(())
    }

    fn entry(&mut self, time: &str, rest: &str) -> Result<(), LineFault> {
        if self.recording.devices.is_empty() {
            return Err(LineFault::NoDevice);
        }
        self.check_newest()?;
        let time_us = time.parse().ok().filter(|time| (self.time_us..=MAX_TIME_US).contains(time));
        self.time_us = time_us.ok_or(LineFault::Time)?;
        let (device, what) = rest.split_once(':').unwrap_or(("0", rest));
        let unknown = || LineFault::UnknownDevice(device.chars().take(40).collect());
        let device: usize = device.parse().map_err(|_| unknown())?;
        let is_gone = self.gone.get_mut(device).ok_or_else(unknown)?;
        if *is_gone {
            return Err(LineFault::WasGone(device));
        }
        let what = if what == "gone" {
            *is_gone = true;
            Recorded::Gone
        } else {
            let report = unhex(what).filter(|report| (1..=MAX_REPORT_BYTES).contains(&report.len()));
            Recorded::Report(report.ok_or(LineFault::Report)?)
        };
        self.recording.entries.push(Entry { time_us: self.time_us, device, what });
        Ok(())
    }
}

/// Exactly four hexadecimal digits.
fn number(text: &str) -> Option<u16> {
    match unhex(text)?[..] {
        [high, low] => Some(u16::from_be_bytes([high, low])),
        _ => None,
    }
}

fn unhex(text: &str) -> Option<Vec<u8>> {
    let digit = |digit: u8| char::from(digit).to_digit(16).map(|value| value as u8);
    let (pairs, rest) = text.as_bytes().as_chunks::<2>();
    let bytes = pairs.iter().map(|[high, low]| Some(digit(*high)? << 4 | digit(*low)?));
    if rest.is_empty() { bytes.collect() } else { None }
}

#[cfg(test)]
#[path = "recording_tests.rs"]
mod tests;
