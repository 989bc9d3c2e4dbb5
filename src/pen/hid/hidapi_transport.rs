//! Devices of the system, through `hidapi`.
//!
//! On Linux that is hidraw, without a C library; on Windows the system's own functions; on macOS IOKit. hidapi names a device once for each of its collections, and hands over
//! reports without the leading 0 of devices without report ids; both are put right here. On Linux descriptors are read from
//! sysfs, so that a device need not be opened, nor its permission be had, to know whether it is a pen.

use super::DeviceStrings;
use super::descriptor_items::has_report_ids;
use super::descriptor_limits::MAX_DESCRIPTOR_BYTES;
use super::device::{Bus, DeviceInfo};
use super::transport::{Enumerate, Transport, TransportError};
use super::usb_strings::StringsOnDemand;
use hidapi::{BusType, HidApi, HidDevice, HidError};
use std::ffi::CString;
use std::io::ErrorKind;
use std::path::Path;
use std::time::Duration;

/// Linux's ENXIO and ENODEV, Windows' ERROR_DEVICE_NOT_CONNECTED. A node outlives its device for a moment: readers are told
/// before the node is removed.
const NO_DEVICE: &[i32] = if cfg!(windows) { &[1167] } else { &[6, 19] };
/// On macOS nodes are names within IOKit, about which the file system knows nothing.
const NODES_ARE_FILES: bool = !cfg!(target_os = "macos");

/// Finds the system's devices.
#[derive(Default)]
pub struct System {
    /// Made when first needed.
    api: Option<HidApi>,
    /// Devices that the system serves as pens are left to it.
    leaves_served: bool,
}

impl System {
    /// Nothing is asked of the system yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// The same, without devices that the system serves as pens already.
    pub fn without_served() -> Self {
        Self { leaves_served: true, ..Self::default() }
    }

    fn api(&mut self) -> Result<&mut HidApi, TransportError> {
        let api = match self.api.take() {
            Some(api) => api,
            None => HidApi::new().map_err(|error| explain("hidapi", &error))?,
        };
        Ok(self.api.insert(api))
    }
}

impl Enumerate for System {
    fn devices(&mut self) -> Result<Vec<DeviceInfo>, TransportError> {
        let api = self.api()?;
        api.refresh_devices().map_err(|error| explain("hidapi", &error))?;
        let mut devices: Vec<DeviceInfo> = api.device_list().map(device_info).collect();
        // Stable: of several collections the first stays.
        devices.sort_by(|a, b| a.path.cmp(&b.path));
        devices.dedup_by(|a, b| a.path == b.path);
        if self.leaves_served {
            devices.retain(|device| !super::served::is_served(&device.path));
        }
        Ok(devices)
    }

    fn descriptor(&mut self, device: &DeviceInfo) -> Result<Vec<u8>, TransportError> {
        let node = Path::new(&device.path).file_name().unwrap_or_default();
        let file = Path::new("/sys/class/hidraw").join(node).join("device/report_descriptor");
        match std::fs::read(file) {
            Ok(descriptor) => Ok(descriptor),
            Err(_) => Ok(self.open(device)?.descriptor().to_vec()),
        }
    }

    fn strings(&mut self, device: &DeviceInfo) -> Box<dyn DeviceStrings> {
        Box::new(StringsOnDemand::new(device))
    }

    fn open(&mut self, device: &DeviceInfo) -> Result<Box<dyn Transport>, TransportError> {
        let path = device.path.as_str();
        let c_path = CString::new(path).map_err(|_| TransportError::Gone { path: path.to_owned() })?;
        let opened = self.api()?.open_path(&c_path).map_err(|error| refusal(device, &error))?;
        let mut descriptor = vec![0; MAX_DESCRIPTOR_BYTES];
        let length = opened.get_report_descriptor(&mut descriptor).unwrap_or(0);
        descriptor.truncate(length);
        let is_numbered = has_report_ids(&descriptor);
        Ok(Box::new(Node { device: opened, info: device.clone(), descriptor, is_numbered }))
    }
}

fn device_info(device: &hidapi::DeviceInfo) -> DeviceInfo {
    let text = |text: Option<&str>| text.unwrap_or_default().to_owned();
    DeviceInfo {
        path: device.path().to_string_lossy().into_owned(),
        vendor_id: device.vendor_id(),
        product_id: device.product_id(),
        bus: match device.bus_type() {
            BusType::Usb => Bus::Usb,
            BusType::Bluetooth => Bus::Bluetooth,
            BusType::I2c => Bus::I2c,
            BusType::Spi => Bus::Spi,
            BusType::Unknown => Bus::Unknown,
        },
        product: text(device.product_string()),
        manufacturer: text(device.manufacturer_string()),
        serial: text(device.serial_number()),
        usage: (device.usage_page(), device.usage()),
        interface: u8::try_from(device.interface_number()).ok(),
    }
}

/// Why a node could not be opened. hidapi tells it in words only, so the system is asked once more.
fn refusal(device: &DeviceInfo, error: &HidError) -> TransportError {
    let path = device.path.as_str();
    if !NODES_ARE_FILES {
        return TransportError::forbidden(device);
    }
    let asked = std::fs::OpenOptions::new().read(true).write(true).open(path);
    match asked.map_err(|error| (error.kind(), error.raw_os_error())) {
        Err((ErrorKind::PermissionDenied, _)) => TransportError::forbidden(device),
        Err((ErrorKind::NotFound, _)) => TransportError::Gone { path: path.to_owned() },
        Err((_, Some(number))) if NO_DEVICE.contains(&number) => {
            TransportError::Gone { path: path.to_owned() }
        }
        _ => explain(path, error),
    }
}

fn explain(path: &str, error: &HidError) -> TransportError {
    TransportError::System { path: path.to_owned(), message: error.to_string() }
}

/// An open node.
struct Node {
    device: HidDevice,
    info: DeviceInfo,
    descriptor: Vec<u8>,
    is_numbered: bool,
}

impl Node {
    /// What a failed read or write means; every one of them happens when the device is unplugged.
    fn failure(&self, error: &HidError) -> TransportError {
        if Path::new(&self.info.path).exists() {
            refusal(&self.info, error)
        } else {
            TransportError::Gone { path: self.info.path.clone() }
        }
    }
}

impl Transport for Node {
    fn read(&mut self, buffer: &mut [u8], timeout: Duration) -> Result<usize, TransportError> {
        let timeout_ms = i32::try_from(timeout.as_millis()).unwrap_or(i32::MAX);
        let skipped = usize::from(!self.is_numbered);
        let Some((id, rest)) = buffer.split_first_mut() else { return Ok(0) };
        *id = 0;
        let into = if self.is_numbered { buffer } else { rest };
        match self.device.read_timeout(into, timeout_ms) {
            Ok(0) => Ok(0),
            Ok(length) => Ok(length + skipped),
            // A signal woke the thread; nothing is wrong with the device.
            Err(HidError::IoError { error }) if error.kind() == ErrorKind::Interrupted => Ok(0),
            Err(error) => Err(self.failure(&error)),
        }
    }

    fn write(&mut self, report: &[u8]) -> Result<(), TransportError> {
        self.device.write(report).map(drop).map_err(|error| self.failure(&error))
    }

    fn send_feature(&mut self, report: &[u8]) -> Result<(), TransportError> {
        self.device.send_feature_report(report).map_err(|error| self.failure(&error))
    }

    fn descriptor(&self) -> &[u8] {
        &self.descriptor
    }

    fn info(&self) -> &DeviceInfo {
        &self.info
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_device_of_this_machine_is_named_once() {
        let mut paths: Vec<String> = System::new().devices().unwrap().into_iter().map(|d| d.path).collect();
        let all = paths.len();
        paths.dedup();
        assert_eq!(paths.len(), all);
    }

    #[test]
    fn a_node_that_is_not_there_is_gone() {
        let device = DeviceInfo { path: "/dev/hidraw-that-is-not-there".into(), ..Default::default() };
        let fault = System::new().open(&device).map(|_| ()).unwrap_err();
        assert_eq!(fault, TransportError::Gone { path: device.path });
    }
}
