//! The strings of a USB device: they tell models apart, and reading some of them is a command.
//!
//! What is handed over is the string descriptor as the device gives it: its length, the type 3, and the string in UTF-16.
//! UC-Logic's tablets answer some indices with numbers ([`super::uclogic`]), so nothing is decoded before somebody asks for
//! text. Sources: USB 2.0, section 9.6.7.

use super::remedy::StringsKept;
use std::collections::BTreeMap;
use std::io;

/// Type of string descriptors.
pub const STRING_DESCRIPTOR: u8 = 3;

/// The strings of one device.
pub trait DeviceStrings: Send {
    /// The string descriptor at an index; the device is asked at each call.
    ///
    /// # Errors
    /// The device has no such string, or none of its strings can be read.
    fn read(&mut self, index: u8) -> io::Result<Vec<u8>>;

    /// Why strings that were asked for were not given.
    fn kept(&self) -> StringsKept;
}

/// Strings by their indices, as a recording or a simulated device has them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KnownStrings {
    /// String descriptors.
    pub strings: BTreeMap<u8, Vec<u8>>,
    /// Why the others are not known.
    pub kept: StringsKept,
}

impl KnownStrings {
    /// Of a device whose strings are not known.
    pub fn none(kept: StringsKept) -> Self {
        Self { strings: BTreeMap::new(), kept }
    }
}

impl DeviceStrings for KnownStrings {
    fn read(&mut self, index: u8) -> io::Result<Vec<u8>> {
        let missing = || io::Error::new(io::ErrorKind::Unsupported, "the device has no such string");
        self.strings.get(&index).cloned().ok_or_else(missing)
    }

    fn kept(&self) -> StringsKept {
        self.kept
    }
}

/// The text of a string descriptor; `None` for bytes that are none.
pub fn text(descriptor: &[u8]) -> Option<String> {
    let [length, STRING_DESCRIPTOR, string @ ..] = descriptor else { return None };
    let string = string.get(..usize::from(*length).checked_sub(2)?).unwrap_or(string);
    let (units, _) = string.as_chunks::<2>();
    Some(String::from_utf16_lossy(&units.iter().map(|unit| u16::from_le_bytes(*unit)).collect::<Vec<_>>()))
}

/// The string descriptor of a text, for tests and simulated devices.
///
/// # Panics
/// A text of more than 126 units of UTF-16, which no descriptor holds.
#[cfg(test)]
pub(crate) fn descriptor(text: &str) -> Vec<u8> {
    let string: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let length = u8::try_from(string.len() + 2).expect("a string that fits");
    [&[length, STRING_DESCRIPTOR][..], &string].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_is_read_as_far_as_its_length_says() {
        assert_eq!(text(&descriptor("HUION_T173")).as_deref(), Some("HUION_T173"));
        assert_eq!(text(&[6, 3, b'A', 0, b'B', 0, b'C', 0]).as_deref(), Some("AB"));
        assert_eq!(text(&[20, 3, b'A', 0, b'B']).as_deref(), Some("A"), "cut short");
        assert_eq!(text(&[2, 3]).as_deref(), Some(""));
        assert_eq!([text(&[]), text(&[4, 2, b'A', 0]), text(&[1, 3, 7])], [None, None, None]);
    }

    #[test]
    fn what_is_not_known_is_not_given() {
        let strings = BTreeMap::from([(201, descriptor("A"))]);
        let mut known = KnownStrings { strings, ..KnownStrings::none(StringsKept::NotRecorded) };
        assert_eq!(known.read(201).unwrap(), descriptor("A"));
        assert!(known.read(4).is_err() && known.kept() == StringsKept::NotRecorded);
    }
}
