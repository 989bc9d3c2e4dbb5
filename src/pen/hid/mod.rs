//! Raw HID: tablets read past the window system, report by report.
//!
//! A device's node is opened, woken up where its maker demands it, and drained by a thread of its own. Whatever the bytes
//! look like, a decoder turns each report into [`HidEvent`]s; nobody after it knows which family the tablet is of.

pub mod families;
pub mod report;
pub mod table;
#[cfg(feature = "program")]
pub mod usb_strings;
pub mod wake;

pub use report::{Decode, HidEvent, RawPen};
pub use table::{Table, Tablet};
