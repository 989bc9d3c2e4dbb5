//! Who a device is, and how it is connected.

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

#[cfg(test)]
mod tests {
    use super::*;

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
