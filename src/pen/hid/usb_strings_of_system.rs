//! Indexed USB strings of a tablet on systems whose HID functions give them: Windows. On macOS there is no such function,
//! and the strings count as not answered.
//!
//! Limits: Windows ends a string at the first zero, so strings that hold numbers ([`super::uclogic`]) come cut short; their
//! being read wakes a tablet all the same.

use super::strings::{DeviceStrings, STRING_DESCRIPTOR};
use super::{Bus, DeviceInfo, StringsKept};
use hidapi::{HidApi, HidDevice};
use std::ffi::CString;
use std::io;

/// The strings of a HID device, which is opened when the first is asked for.
pub struct StringsOnDemand {
    /// The node, until it was tried; only devices on a cable have strings.
    node: Option<CString>,
    device: Option<HidDevice>,
    is_wireless: bool,
}

impl StringsOnDemand {
    /// Nothing is opened yet.
    pub fn new(device: &DeviceInfo) -> Self {
        let node = CString::new(device.path.as_str()).ok().filter(|_| device.bus == Bus::Usb);
        Self { node, device: None, is_wireless: device.bus == Bus::Bluetooth }
    }
}

impl DeviceStrings for StringsOnDemand {
    fn read(&mut self, index: u8) -> io::Result<Vec<u8>> {
        if let Some(node) = self.node.take() {
            let opened = HidApi::new().and_then(|api| api.open_path(&node));
            self.device = Some(opened.map_err(io::Error::other)?);
        }
        let none = || io::Error::other("it has no USB strings; connect it by cable");
        let device = self.device.as_ref().ok_or_else(none)?;
        let text = device.get_indexed_string(i32::from(index)).map_err(io::Error::other)?;
        Ok(descriptor(&text.unwrap_or_default()))
    }

    fn kept(&self) -> StringsKept {
        if self.is_wireless { StringsKept::Wireless } else { StringsKept::Unanswered }
    }
}

/// The string descriptor of a text, cut at the longest that a descriptor holds.
fn descriptor(text: &str) -> Vec<u8> {
    const LONGEST: usize = 126;
    let string: Vec<u8> = text.encode_utf16().take(LONGEST).flat_map(u16::to_le_bytes).collect();
    [&[string.len() as u8 + 2, STRING_DESCRIPTOR][..], &string].concat()
}
