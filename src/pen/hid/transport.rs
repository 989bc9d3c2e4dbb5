//! The wire to one device: reports in, reports out.
//!
//! A transport is a node of the system or a simulated device; nobody above it knows which. Reports begin with their
//! report id, 0 for devices without ids.

use super::device::DeviceInfo;
use super::remedy::Remedy;
use super::strings::DeviceStrings;
use std::time::Duration;
use thiserror::Error;

/// What can go wrong with a device.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum TransportError {
    /// The system keeps the device from this user.
    #[error("{path}: no permission to read this tablet; {}", remedy.message())]
    Permission {
        /// The node.
        path: String,
        /// What would allow it.
        remedy: Remedy,
    },
    /// It is not there, or not there any more.
    #[error("{path}: the tablet is gone; plug it in again")]
    Gone {
        /// The node.
        path: String,
    },
    /// Anything else the system says.
    #[error("{path}: {message}; unplug the tablet and plug it in again")]
    System {
        /// The node.
        path: String,
        /// What the system says.
        message: String,
    },
}

impl TransportError {
    /// The system keeps this device from this user.
    pub fn forbidden(device: &DeviceInfo) -> Self {
        Self::Permission { path: device.path.clone(), remedy: Remedy::of(device) }
    }
}

/// An open device.
pub trait Transport: Send {
    /// Waits up to `timeout` for a report and puts it into `buffer`, its report id first; its length, or 0 when none came.
    ///
    /// # Errors
    /// A device that is gone or fails; nothing more comes from it.
    fn read(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, TransportError>;

    /// Sends an output report, its report id first.
    ///
    /// # Errors
    /// A device that is gone or does not take it.
    fn write(&mut self, report: &[u8]) -> Result<(), TransportError>;

    /// Sends a feature report, its report id first.
    ///
    /// # Errors
    /// A device that is gone or does not take it.
    fn send_feature(&mut self, report: &[u8]) -> Result<(), TransportError>;

    /// The report descriptor; empty where the system does not tell it.
    fn descriptor(&self) -> &[u8];

    /// Who it is.
    fn info(&self) -> &DeviceInfo;
}

/// Where devices are found: the system, or a test.
pub trait Enumerate: Send {
    /// Every device that is there now, each path once.
    ///
    /// # Errors
    /// A system that does not tell.
    fn devices(&mut self) -> Result<Vec<DeviceInfo>, TransportError>;

    /// The report descriptor of a device, got without opening it where the system allows that.
    ///
    /// # Errors
    /// A device that is gone or keeps it to itself.
    fn descriptor(&mut self, device: &DeviceInfo) -> Result<Vec<u8>, TransportError>;

    /// The USB strings of a device; none is read before it is asked for.
    fn strings(&mut self, device: &DeviceInfo) -> Box<dyn DeviceStrings>;

    /// Opens a device.
    ///
    /// # Errors
    /// A device that is gone, that the user may not open, or that fails.
    fn open(&mut self, device: &DeviceInfo) -> Result<Box<dyn Transport>, TransportError>;
}

#[cfg(test)]
mod tests {
    use super::super::device::Bus;
    use super::*;

    #[test]
    fn a_refused_device_says_what_helps_there() {
        let message = |vendor_id, product_id, bus| {
            let device =
                DeviceInfo { path: "/dev/hidraw3".into(), vendor_id, product_id, bus, ..Default::default() };
            TransportError::forbidden(&device).to_string()
        };
        let parts = |message: &str, parts: &[&str]| {
            parts.iter().for_each(|part| assert!(message.contains(part), "{part} is missing: {message}"));
        };
        let installs = ["/dev/hidraw3", "70-penstemon.rules", "./run.sh --install-udev"];
        parts(&message(0x56A, 0x357, Bus::Usb), &installs);
        parts(&message(0x56A, 0x360, Bus::Bluetooth), &installs);
        parts(&message(0x256C, 0xFFFF, Bus::Usb), &installs);
        let of_usb = message(0x1234, 0xABCD, Bus::Usb);
        parts(&of_usb, &["/dev/hidraw3", "/etc/udev/rules.d", "ATTRS{idVendor}==\"1234\"", "\"abcd\""]);
        let of_bluetooth = message(0x56A, 0xABCD, Bus::Bluetooth);
        parts(&of_bluetooth, &["/etc/udev/rules.d", "KERNELS==\"0005:056A:ABCD.*\""]);
        let built_in = message(0x56A, 0x4806, Bus::I2c);
        parts(&built_in, &["built into this machine", "“Automatic”"]);
        for message in [of_usb, of_bluetooth, built_in] {
            assert!(!message.contains("install-udev"), "that would not help: {message}");
        }
    }
}
