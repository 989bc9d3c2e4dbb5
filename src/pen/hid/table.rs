//! The table of tablets: which device is which model, how it is woken, and how its reports are read.
//!
//! The table is data, `assets/tablets.toml`, parsed and validated once. Vendor and product ids do not tell models apart
//! (one pair stands for 59 of them): the length of the reports and strings in the device decide (`matching`). TOML,
//! because it diffs line by line and because species files are TOML already; parsing costs a few milliseconds, once, on
//! the thread that looks for tablets.
//!
//! Limits: a device whose descriptor describes a pen needs no table, unless it keeps silent until it is woken.

mod file;
mod matching;
mod tablet;
mod udev;

pub use file::TableError;
pub use matching::{Certainty, FIRMWARE_NAME, Match};
pub use tablet::{StringRule, Table, Tablet};
pub use udev::own_rule;

use std::sync::OnceLock;

impl Table {
    /// The table the program ships with, parsed at the first call.
    ///
    /// # Errors
    /// What is wrong with the file; a test keeps this from happening.
    pub fn shipped() -> Result<&'static Self, &'static TableError> {
        static TABLE: OnceLock<Result<Table, TableError>> = OnceLock::new();
        TABLE.get_or_init(|| Self::from_toml(include_str!("../../../assets/tablets.toml"))).as_ref()
    }

    /// Reads and validates a table.
    ///
    /// # Errors
    /// The first thing that is wrong, with the tablet it is about.
    pub fn from_toml(text: &str) -> Result<Self, TableError> {
        file::read(text)
    }
}

#[cfg(test)]
mod tests;
