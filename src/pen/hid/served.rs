//! Which devices the system already serves as pens.
//!
//! The Linux kernel makes an input device of what it understands, and one that knows the tool "pen" reaches every window
//! system as a pen. Such a tablet needs no second reader; waking it into its maker's protocol would even take it away
//! from the system. A tablet on a cable may show itself as several interfaces of one USB device, and what one of them
//! serves all of them do. Read from sysfs, so nothing is opened.
//!
//! Limits: on other systems nothing is known to be served.

use std::fs;
use std::path::{Path, PathBuf};

/// Where Linux lists hidraw nodes.
const HIDRAW_CLASS: &str = "/sys/class/hidraw";
/// `BTN_TOOL_PEN` of the kernel's `input-event-codes.h`.
const TOOL_PEN: usize = 0x140;

/// Whether the system serves the device of a node such as `/dev/hidraw3` as a pen.
pub fn is_served(node: &str) -> bool {
    is_served_below(Path::new(HIDRAW_CLASS), node)
}

fn is_served_below(class: &Path, node: &str) -> bool {
    let Some(name) = Path::new(node).file_name() else { return false };
    let Ok(device) = class.join(name).join("device").canonicalize() else { return false };
    kin(&device).iter().any(|device| has_pen(device))
}

/// The HID device and those of the other interfaces of its USB device.
fn kin(device: &Path) -> Vec<PathBuf> {
    let usb = device.parent().filter(|interface| is_interface(interface)).and_then(Path::parent);
    let Some(usb) = usb else { return vec![device.to_owned()] };
    let interfaces = entries(usb).into_iter().filter(|path| is_interface(path));
    interfaces.flat_map(|interface| entries(&interface)).collect()
}

/// Interfaces of a USB device are named like `1-4:1.0`, after the device.
fn is_interface(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let device = path.parent().and_then(Path::file_name).unwrap_or_default().to_string_lossy();
    name.strip_prefix(&*device).is_some_and(|rest| rest.starts_with(':'))
}

/// Whether a HID device has an input device with the tool "pen".
fn has_pen(device: &Path) -> bool {
    entries(&device.join("input")).iter().any(|input| {
        let keys = fs::read_to_string(input.join("capabilities/key"));
        keys.is_ok_and(|keys| has_bit(&keys, TOOL_PEN))
    })
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    entries.filter_map(|entry| entry.ok().map(|entry| entry.path())).collect()
}

/// Whether a bit is set in one of sysfs's bit maps: words of the kernel in hexadecimal, the highest first.
fn has_bit(map: &str, bit: usize) -> bool {
    const WORD: usize = usize::BITS as usize;
    let word = map.split_whitespace().rev().nth(bit / WORD);
    let word = word.and_then(|word| u64::from_str_radix(word, 16).ok());
    word.is_some_and(|word| word >> (bit % WORD) & 1 == 1)
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use super::*;
    use std::os::unix::fs::symlink;

    /// Keys of a pen display as the kernel lists them: tools, touch and stylus buttons in the sixth word.
    const PEN_KEYS: &str = "1c03 0 0 0 0 0\n";
    const MOUSE_KEYS: &str = "1f0000 0 0 0 0\n";

    /// A tree like sysfs with one USB tablet of two interfaces and one device on another bus.
    fn tree(of_first: &str, of_i2c: &str) -> tempfile::TempDir {
        let root = tempfile::tempdir().unwrap();
        let hid = |place: &str, number: u32, keys: &str| {
            let device = root.path().join(place);
            let input = device.join(format!("input/input{number}/capabilities"));
            fs::create_dir_all(&input).unwrap();
            fs::write(input.join("key"), keys).unwrap();
            let class = root.path().join("class").join(format!("hidraw{number}"));
            fs::create_dir_all(&class).unwrap();
            symlink(&device, class.join("device")).unwrap();
        };
        hid("usb1/1-4/1-4:1.0/0003:256C:006D.0001", 0, of_first);
        hid("usb1/1-4/1-4:1.1/0003:256C:006D.0002", 1, MOUSE_KEYS);
        hid("usb1/1-5/1-5:1.0/0003:046D:C077.0003", 2, MOUSE_KEYS);
        hid("i2c-1/i2c-WACF2200:00/0018:056A:0001.0004", 3, of_i2c);
        root
    }

    #[test]
    fn all_interfaces_of_a_tablet_are_served_by_the_pen_of_one() {
        let root = tree(PEN_KEYS, MOUSE_KEYS);
        let class = root.path().join("class");
        let served = |n: u32| is_served_below(&class, &format!("/dev/hidraw{n}"));
        assert_eq!([0, 1, 2, 3, 4].map(served), [true, true, false, false, false]);
    }

    #[test]
    fn devices_on_other_buses_stand_for_themselves() {
        let root = tree(MOUSE_KEYS, PEN_KEYS);
        let class = root.path().join("class");
        let served = |n: u32| is_served_below(&class, &format!("/dev/hidraw{n}"));
        assert_eq!([0, 1, 2, 3].map(served), [false, false, false, true]);
    }

    #[test]
    fn bits_are_counted_from_the_last_word() {
        assert!(has_bit("1 0", 64) && has_bit("3", 1) && !has_bit("3", 2));
        assert!(!has_bit("", 0) && !has_bit("nonsense", 0) && !has_bit("1", 9999));
    }
}
