//! The wire to one device: reports in, reports out, and who it is.
//!
//! A transport is a node of the system or a simulated device; nobody above it knows which. Reports begin with their
//! report id, 0 for devices without ids.

use super::DeviceStrings;
use super::refusal::Remedy;
use std::time::Duration;
use thiserror::Error;

/// How a device is connected.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Bus {
    /// By a cable.
    Usb,
    /// By radio.
    Bluetooth,
    /// Inside the machine.
    I2c,
    /// Inside the machine.
    Spi,
    /// In another way.
    #[default]
    Unknown,
}

impl Bus {
    /// All of them with the words that stand for them in files.
    pub const NAMES: [(Self, &'static str); 5] = [
        (Self::Usb, "usb"),
        (Self::Bluetooth, "bluetooth"),
        (Self::I2c, "i2c"),
        (Self::Spi, "spi"),
        (Self::Unknown, "unknown"),
    ];

    /// The kernel's number of it, by which HID devices are named that are not on USB; `None` for USB and what is unknown.
    pub fn number(self) -> Option<u16> {
        match self {
            Self::Bluetooth => Some(0x05),
            Self::I2c => Some(0x18),
            Self::Spi => Some(0x1C),
            Self::Usb | Self::Unknown => None,
        }
    }

    /// The word that stands for it in files.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(bus, _)| *bus == self).map_or("unknown", |(_, name)| name)
    }
}

/// Who a device is.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DeviceInfo {
    /// The node, for instance `/dev/hidraw3`; no two devices have the same.
    pub path: String,
    /// Number of its maker.
    pub vendor_id: u16,
    /// Number of its model, given by the maker.
    pub product_id: u16,
    /// How it is connected.
    pub bus: Bus,
    /// Its name.
    pub product: String,
    /// Its maker's name.
    pub manufacturer: String,
    /// Its serial number.
    pub serial: String,
    /// What its first collection is for: page and usage.
    pub usage: (u16, u16),
    /// Number of its USB interface.
    pub interface: Option<u8>,
}

impl DeviceInfo {
    /// A name for people: maker and product, or the numbers where both are silent.
    pub fn name(&self) -> String {
        let (maker, product) = (self.manufacturer.trim(), self.product.trim());
        match (maker.is_empty(), product.is_empty()) {
            (true, true) => format!("tablet {:04x}:{:04x}", self.vendor_id, self.product_id),
            (false, false) if !product.starts_with(maker) => format!("{maker} {product}"),
            (_, false) => product.to_owned(),
            (false, true) => maker.to_owned(),
        }
    }

    /// What the device is known by from one day to the next, and all its nodes alike: numbers, name, serial number.
    pub fn identity(&self) -> String {
        let Self { vendor_id, product_id, serial, .. } = self;
        format!("{vendor_id:04x}:{product_id:04x} {} {}", self.name(), serial.trim()).trim_end().to_owned()
    }
}

/// What can go wrong with a device.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum TransportError {
    /// The system keeps the device from this user.
    #[error("{path}: no permission to read this tablet; {}", remedy.told())]
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
    use super::*;

    #[test]
    fn a_refused_device_says_what_helps_there() {
        let told = |vendor_id, product_id, bus| {
            let device =
                DeviceInfo { path: "/dev/hidraw3".into(), vendor_id, product_id, bus, ..Default::default() };
            TransportError::forbidden(&device).to_string()
        };
        let parts = |told: &str, parts: &[&str]| {
            parts.iter().for_each(|part| assert!(told.contains(part), "{part} is missing: {told}"));
        };
        let installs = ["/dev/hidraw3", "70-penstemon.rules", "./run.sh --install-udev"];
        parts(&told(0x56A, 0x357, Bus::Usb), &installs);
        parts(&told(0x56A, 0x360, Bus::Bluetooth), &installs);
        parts(&told(0x256C, 0xFFFF, Bus::Usb), &installs);
        let of_usb = told(0x1234, 0xABCD, Bus::Usb);
        parts(&of_usb, &["/dev/hidraw3", "/etc/udev/rules.d", "ATTRS{idVendor}==\"1234\"", "\"abcd\""]);
        let of_bluetooth = told(0x56A, 0xABCD, Bus::Bluetooth);
        parts(&of_bluetooth, &["/etc/udev/rules.d", "KERNELS==\"0005:056A:ABCD.*\""]);
        let built_in = told(0x56A, 0x4806, Bus::I2c);
        parts(&built_in, &["built into this machine", "“Automatic”"]);
        for told in [of_usb, of_bluetooth, built_in] {
            assert!(!told.contains("install-udev"), "that would not help: {told}");
        }
    }

    #[test]
    fn a_device_has_a_name_for_people() {
        let named = |maker: &str, product: &str| {
            let (manufacturer, product) = (maker.to_owned(), product.to_owned());
            DeviceInfo { manufacturer, product, vendor_id: 0x56A, product_id: 0x357, ..Default::default() }
                .name()
        };
        assert_eq!(named("Wacom Co.,Ltd.", "Intuos Pro M"), "Wacom Co.,Ltd. Intuos Pro M");
        assert_eq!(named("HUION", "HUION Kamvas"), "HUION Kamvas");
        assert_eq!(named("", " "), "tablet 056a:0357");
    }

    #[test]
    fn nodes_of_one_device_have_one_identity() {
        let node = |path: &str, serial: &str| DeviceInfo {
            path: path.into(),
            vendor_id: 0x256C,
            product_id: 0x6D,
            product: "Tablet".into(),
            serial: serial.into(),
            ..Default::default()
        };
        assert_eq!(node("a", "").identity(), "256c:006d Tablet");
        assert_eq!(node("a", "7").identity(), node("b", " 7").identity());
        assert_ne!(node("a", "7").identity(), node("a", "8").identity());
    }
}
