//! What the artist can do about a device that is kept from them, or whose strings are.
//!
//! Messages here are English; the window has them in its own language (`app/messages/faults.rs`).

use super::device::{Bus, DeviceInfo};
use super::table::{Table, own_rule};

/// The rules that let people use their tablets.
pub const RULES_FILE: &str = "70-penstemon.rules";
/// Where the system looks for rules.
pub const RULES_FOLDER: &str = "/etc/udev/rules.d";
/// The command that installs them.
pub const INSTALL_RULES: &str = "./run.sh --install-udev";

/// What lets the user open a device that the system keeps from them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// The rules that come with the program.
    Rules,
    /// A rule of the user's own, since those do not name the device.
    OwnRule(String),
    /// Nothing need be done: the device is built in, and the system reads its pen.
    System,
    /// Windows hands a device to one program at a time.
    OtherProgram,
    /// macOS asks the user once whether a program may listen to input devices.
    InputMonitoring,
}

impl Remedy {
    /// What helps with this device.
    pub fn of(device: &DeviceInfo) -> Self {
        match device.bus {
            Bus::I2c | Bus::Spi => Self::System,
            _ if cfg!(windows) => Self::OtherProgram,
            _ if cfg!(target_os = "macos") => Self::InputMonitoring,
            _ if Table::shipped().is_ok_and(|table| table.rules_cover(device)) => Self::Rules,
            _ => Self::OwnRule(own_rule(device)),
        }
    }

    pub(super) fn message(&self) -> String {
        match self {
            Self::Rules => format!(
                "install the rule file {RULES_FILE} with the command {INSTALL_RULES}, then plug the tablet in again"
            ),
            Self::OwnRule(rule) => format!(
                "{RULES_FILE} does not name it: write the line {rule} into a file of its own in {RULES_FOLDER} whose name \
                 begins with 70, then plug the tablet in again"
            ),
            Self::System => {
                "it is built into this machine and the system reads its pen: choose “Automatic” under \
                             “Pen and tablet”"
                    .to_owned()
            }
            Self::OtherProgram => {
                "another program or the maker's driver holds it: choose “Automatic” under “Pen and tablet”, or end that \
                 program, then plug the tablet in again"
                    .to_owned()
            }
            Self::InputMonitoring => {
                "allow Penstemon under System Settings, Privacy & Security, Input Monitoring, then start it again"
                    .to_owned()
            }
        }
    }
}

/// Why a device's USB strings are not known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StringsKept {
    /// The system keeps the USB device from this user.
    Forbidden,
    /// It is not on a cable, and only there are strings.
    Wireless,
    /// It was asked and gave none.
    Unanswered,
    /// The device is a recording's, which does not hold them.
    NotRecorded,
}

impl StringsKept {
    pub(super) fn message(self) -> String {
        match self {
            Self::Forbidden => format!(
                "and these may not be read: install the rule file {RULES_FILE} with the command {INSTALL_RULES}, then \
                 plug the tablet in again"
            ),
            Self::Wireless => "and there are none by radio: connect it by cable".to_owned(),
            Self::Unanswered => "and it did not give them: plug it in again".to_owned(),
            Self::NotRecorded => {
                "and the recording does not hold them: record anew with --strings".to_owned()
            }
        }
    }
}
