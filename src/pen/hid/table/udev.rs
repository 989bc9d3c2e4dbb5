//! The udev rules that let whoever sits at the machine open the tablets of the table.
//!
//! Nodes are tagged `uaccess`, which systemd-logind turns into rights for the seat's user; nothing is given to others and
//! no kernel driver is touched. Tablets that are known or woken by USB strings need their USB node too, because hidraw
//! gives no strings. Makers whose tablets say their ranges themselves are let in with all models.

use super::tablet::Table;
use crate::pen::hid::device::DeviceInfo;
use std::collections::BTreeMap;
use std::fmt::Write as _;

const HEAD: &str = "\
# Graphics tablets that Penstemon reads itself: the user at the seat may open them. Made from assets/tablets.toml.
#
# To install: ./run.sh --install-udev, or copy this file to /etc/udev/rules.d and run
#   udevadm control --reload && udevadm trigger
# The number in the name matters: it must sort before 73-seat-late.rules. No kernel driver is disabled.

ACTION==\"remove\", GOTO=\"penstemon_end\"
";

/// What the rules need to know of a pair of ids.
#[derive(Default)]
struct Device<'t> {
    names: Vec<&'t str>,
    needs_strings: bool,
    bluetooth: bool,
}

impl Table {
    /// The rules file, one block for each pair of ids, in the order of the ids.
    #[must_use]
    pub fn udev_rules(&self) -> String {
        let mut devices: BTreeMap<(u16, u16), Device<'_>> = BTreeMap::new();
        for tablet in self.tablets() {
            let device = devices.entry((tablet.vendor, tablet.product)).or_default();
            if !device.names.contains(&tablet.name.as_str()) {
                device.names.push(&tablet.name);
            }
            device.needs_strings |= tablet.needs_strings();
            device.bluetooth |= tablet.bluetooth;
        }
        let mut rules = HEAD.to_owned();
        for ((vendor, product), device) in &devices {
            // Writing to a String cannot fail.
            let _ = write!(rules, "{}", block(*vendor, *product, device));
        }
        for vendor in &self.self_describing {
            let _ = write!(rules, "{}", maker(*vendor));
        }
        rules.push_str("\nLABEL=\"penstemon_end\"\n");
        rules
    }
}

/// udev compares ids as text: in lower case as USB attributes, in upper case in names of Bluetooth HID devices.
fn block(vendor: u16, product: u16, device: &Device<'_>) -> String {
    let mut text = match &device.names[..] {
        [] => String::new(),
        [name] => format!("\n# {name}\n"),
        [name, others @ ..] => format!("\n# {name} and {} more\n", others.len()),
    };
    let ids = |attribute: &str| {
        format!("{attribute}{{idVendor}}==\"{vendor:04x}\", {attribute}{{idProduct}}==\"{product:04x}\"")
    };
    text += &format!("KERNEL==\"hidraw*\", {}, TAG+=\"uaccess\"\n", ids("ATTRS"));
    if device.bluetooth {
        text += &format!(
            "KERNEL==\"hidraw*\", KERNELS==\"0005:{vendor:04X}:{product:04X}.*\", TAG+=\"uaccess\"\n"
        );
    }
    if device.needs_strings {
        text += &format!(
            "SUBSYSTEM==\"usb\", ENV{{DEVTYPE}}==\"usb_device\", {}, TAG+=\"uaccess\"\n",
            ids("ATTR")
        );
    }
    text
}

/// All tablets of a maker that are not listed.
fn maker(vendor: u16) -> String {
    let node = format!("KERNEL==\"hidraw*\", ATTRS{{idVendor}}==\"{vendor:04x}\", TAG+=\"uaccess\"");
    let usb = format!(
        "SUBSYSTEM==\"usb\", ENV{{DEVTYPE}}==\"usb_device\", ATTR{{idVendor}}==\"{vendor:04x}\", TAG+=\"uaccess\""
    );
    format!("\n# Models of {vendor:04x} that are not listed\n{node}\n{usb}\n")
}

/// A rule of the user's own for a device that the rules do not cover.
#[must_use]
pub fn own_rule(device: &DeviceInfo) -> String {
    let DeviceInfo { vendor_id, product_id, bus, .. } = device;
    match bus.number() {
        // Devices that are not on USB are known by the name of their HID device alone.
        Some(number) => {
            format!(
                "KERNEL==\"hidraw*\", KERNELS==\"{number:04X}:{vendor_id:04X}:{product_id:04X}.*\", TAG+=\"uaccess\""
            )
        }
        None => format!(
            "KERNEL==\"hidraw*\", ATTRS{{idVendor}}==\"{vendor_id:04x}\", ATTRS{{idProduct}}==\"{product_id:04x}\", \
             TAG+=\"uaccess\""
        ),
    }
}
