//! Indexed USB strings of a tablet, which hidraw does not give: Huion, Gaomon and older UC-Logic tablets are known by
//! them, and woken by their being read.
//!
//! The hidraw node's place in sysfs leads to the USB device above it; its string descriptors are asked for on the control
//! pipe with `nusb`, which takes no interface from the kernel's driver. Linux only; elsewhere hidapi reads strings itself.
//!
//! Limits: needs the right to open the USB node (`udev/70-penstemon.rules`); devices over Bluetooth have no strings.

use super::strings::{DeviceStrings, STRING_DESCRIPTOR};
use super::{Bus, DeviceInfo, StringsKept};
use nusb::MaybeFuture as _;
use nusb::descriptors::language_id::US_ENGLISH;
use nusb::transfer::TransferError;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Longest wait for one string; firmwares that know no such string answer at once.
const PATIENCE: Duration = Duration::from_millis(500);
/// Where Linux lists hidraw nodes.
const HIDRAW_CLASS: &str = "/sys/class/hidraw";

/// Why a tablet's strings cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum UsbStringsError {
    /// There is no USB device above the node.
    #[error(
        "{node}: no USB device stands behind this node, so it has no strings; connect the tablet by cable"
    )]
    NotUsb {
        /// The node.
        node: PathBuf,
    },
    /// The system did not list its USB devices, or no longer lists this one.
    #[error("{node}: the USB device behind this node was not found ({reason}); plug the tablet in again")]
    NotFound {
        /// The node.
        node: PathBuf,
        /// What the system said.
        reason: String,
    },
    /// The user may not open the USB node.
    #[error(
        "/dev/bus/usb/{bus:03}/{address:03} may not be opened, and this tablet is known and woken by its USB strings: \
         install udev/70-penstemon.rules with ./run.sh --install-udev, then plug the tablet in again"
    )]
    Forbidden {
        /// Number of the bus.
        bus: u8,
        /// Number of the device on it.
        address: u8,
    },
    /// Opening failed for another reason.
    #[error("{node}: the USB device behind this node cannot be opened: {source}")]
    Open {
        /// The node.
        node: PathBuf,
        /// What the system said.
        source: nusb::Error,
    },
}

/// An open USB device whose strings can be read.
pub struct UsbStrings {
    device: nusb::Device,
}

impl UsbStrings {
    /// Opens the USB device behind a hidraw node such as `/dev/hidraw3`.
    ///
    /// # Errors
    /// The node is not of a USB device, or the USB device cannot be opened; the message says what to do.
    pub fn open(node: &Path) -> Result<Self, UsbStringsError> {
        let place = usb_device_above(node, Path::new(HIDRAW_CLASS))
            .ok_or_else(|| UsbStringsError::NotUsb { node: node.to_owned() })?;
        let not_found = |reason: String| UsbStringsError::NotFound { node: node.to_owned(), reason };
        let mut listed = nusb::list_devices().wait().map_err(|error| not_found(error.to_string()))?;
        let is_there =
            |info: &nusb::DeviceInfo| info.sysfs_path().canonicalize().is_ok_and(|path| path == place);
        let info =
            listed.find(is_there).ok_or_else(|| not_found(format!("{} is not listed", place.display())))?;
        let device = info.open().wait().map_err(|source| match source.kind() {
            nusb::ErrorKind::PermissionDenied => {
                UsbStringsError::Forbidden { bus: info.busnum(), address: info.device_address() }
            }
            _ => UsbStringsError::Open { node: node.to_owned(), source },
        })?;
        Ok(Self { device })
    }

    /// The string descriptor at an index. Reading it is a command to some tablets, whatever they answer.
    ///
    /// # Errors
    /// The device is gone, does not answer in time or has no such string. Some tablets obey and refuse the string.
    pub fn read(&self, index: u8) -> io::Result<Vec<u8>> {
        let language = if index == 0 { 0 } else { US_ENGLISH };
        let read = self.device.get_descriptor(STRING_DESCRIPTOR, index, language, PATIENCE).wait();
        read.map_err(|error| match error {
            nusb::GetDescriptorError::Transfer(TransferError::Stall) => {
                io::Error::new(io::ErrorKind::Unsupported, "the device has no such string")
            }
            nusb::GetDescriptorError::Transfer(error) => error.into(),
            other => io::Error::other(other),
        })
    }
}

/// The strings of a HID device, whose USB device is opened when the first is asked for.
pub struct StringsOnDemand {
    /// The node, until it was tried; only devices on a cable have strings.
    node: Option<PathBuf>,
    device: Option<UsbStrings>,
    fault: Option<UsbStringsError>,
    is_wireless: bool,
}

impl StringsOnDemand {
    /// Nothing is opened yet.
    pub fn new(device: &DeviceInfo) -> Self {
        let node = (device.bus == Bus::Usb).then(|| PathBuf::from(&device.path));
        Self { node, device: None, fault: None, is_wireless: device.bus == Bus::Bluetooth }
    }
}

impl DeviceStrings for StringsOnDemand {
    fn read(&mut self, index: u8) -> io::Result<Vec<u8>> {
        if let Some(node) = self.node.take() {
            match UsbStrings::open(&node) {
                Ok(device) => self.device = Some(device),
                Err(fault) => self.fault = Some(fault),
            }
        }
        match (&self.device, &self.fault) {
            (Some(device), _) => {
                device.read(index).inspect_err(|error| tracing::debug!(index, %error, "no USB string"))
            }
            (None, Some(fault)) => Err(io::Error::other(fault.to_string())),
            (None, None) => Err(io::Error::other("it has no USB strings; connect it by cable")),
        }
    }

    fn kept(&self) -> StringsKept {
        match &self.fault {
            _ if self.is_wireless => StringsKept::Wireless,
            Some(UsbStringsError::Forbidden { .. }) => StringsKept::Forbidden,
            _ => StringsKept::Unanswered,
        }
    }
}

/// The folder of the USB device that a hidraw node belongs to, links resolved: the nearest above with both a vendor id
/// and a number on its bus.
fn usb_device_above(node: &Path, class: &Path) -> Option<PathBuf> {
    let device = class.join(node.file_name()?).join("device").canonicalize().ok()?;
    let is_usb_device = |folder: &&Path| folder.join("idVendor").is_file() && folder.join("devnum").is_file();
    device.ancestors().find(is_usb_device).map(Path::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// A piece of sysfs: a hidraw node on an interface of a USB device, and one over Bluetooth.
    fn sysfs(root: &Path) -> PathBuf {
        let hid = |folder: &str| {
            let hid = root.join("devices").join(folder);
            fs::create_dir_all(&hid).unwrap();
            hid
        };
        let cabled = hid("pci0/usb1/1-2/1-2:1.0/0003:256C:006D.0001");
        let wireless = hid("virtual/misc/uhid/0005:056A:0360.0002");
        for file in ["idVendor", "devnum"] {
            fs::write(root.join("devices/pci0/usb1/1-2").join(file), "1\n").unwrap();
            fs::write(root.join("devices/pci0/usb1").join(file), "1\n").unwrap();
        }
        for (name, hid) in [("hidraw0", cabled), ("hidraw1", wireless)] {
            fs::create_dir_all(root.join("class").join(name)).unwrap();
            std::os::unix::fs::symlink(hid, root.join("class").join(name).join("device")).unwrap();
        }
        root.join("class")
    }

    #[test]
    fn the_usb_device_above_a_node_is_found() {
        let root = tempfile::tempdir().unwrap();
        let class = sysfs(root.path());
        let found = usb_device_above(Path::new("/dev/hidraw0"), &class).unwrap();
        assert_eq!(found, root.path().canonicalize().unwrap().join("devices/pci0/usb1/1-2"));
        assert_eq!(usb_device_above(Path::new("/dev/hidraw1"), &class), None, "over Bluetooth");
        assert_eq!(usb_device_above(Path::new("/dev/hidraw9"), &class), None, "not there");
        assert_eq!(usb_device_above(Path::new("/"), &class), None);
    }

    #[test]
    fn a_node_that_is_not_there_is_reported_with_its_remedy() {
        let message = UsbStrings::open(Path::new("/dev/hidraw-none")).err().unwrap().to_string();
        assert!(message.contains("/dev/hidraw-none") && message.contains("cable"), "{message}");
        let message = UsbStringsError::Forbidden { bus: 1, address: 12 }.to_string();
        assert!(message.contains("/dev/bus/usb/001/012") && message.contains("--install-udev"), "{message}");
    }
}
