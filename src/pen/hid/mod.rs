//! Raw HID: tablets read past the window system, report by report.
//!
//! A device's node is opened, woken up where its maker demands it, and drained by a thread of its own. Whatever the bytes
//! look like, a decoder turns each report into [`HidEvent`]s; nobody after it knows which family the tablet is of.

pub mod choice;
pub mod choose;
pub mod descriptor;
mod descriptor_error;
mod descriptor_items;
mod descriptor_layout;
mod descriptor_limits;
mod descriptor_pad;
pub mod device;
pub mod families;
mod field;
#[cfg(feature = "program")]
pub mod hidapi_transport;
#[cfg(test)]
#[path = "../../../tests/common/tablets.rs"]
#[allow(dead_code, reason = "shared with other tests")]
pub(crate) mod made_up;
pub mod reader;
pub mod recording;
mod recording_read;
pub mod refusal;
pub mod remedy;
pub mod replay;
pub mod report;
pub mod report_lengths;
pub mod served;
pub mod simulated;
pub mod strings;
pub mod table;
pub mod transport;
pub mod typed;
pub mod uclogic;
mod until_woken;
#[cfg(feature = "program")]
#[cfg_attr(not(target_os = "linux"), path = "usb_strings_of_system.rs")]
pub mod usb_strings;
pub mod wake;
pub mod waking;
pub mod watcher;

pub use super::raw_pen::RawPen;
pub use choice::{Choice, Doubt};
pub use choose::{Models, choose_decoder, choose_model};
pub use descriptor::{Abilities, DescriptorDecoder};
pub use descriptor_error::DescriptorError;
pub use descriptor_items::has_report_ids;
pub use descriptor_limits::MAX_DESCRIPTOR_BYTES;
pub use device::{Bus, DeviceInfo};
#[cfg(feature = "program")]
pub use hidapi_transport::System;
pub use reader::{Arrival, DeviceId, Inbox, Message, Notice};
pub use recording::{Recording, RecordingWriter};
pub use recording_read::{LineFault, RecordingError};
pub use refusal::{ChooseError, Refusal, Refused};
pub use remedy::StringsKept;
pub use report::{Decode, HidEvent};
pub use strings::{DeviceStrings, KnownStrings};
pub use table::{Table, Tablet};
pub use transport::{Enumerate, Transport, TransportError};
pub use typed::TypedReports;
pub use watcher::Watcher;
