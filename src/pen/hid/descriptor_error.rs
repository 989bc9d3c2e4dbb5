//! Why a report descriptor could not be understood.

use super::descriptor_limits::{MAX_DEPTH, MAX_DESCRIPTOR_BYTES, MAX_FIELDS, MAX_REPORT_BITS};
use thiserror::Error;

/// A report descriptor that breaks the rules of HID, or that asks for more than any tablet has.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum DescriptorError {
    /// There is nothing to read.
    #[error("the report descriptor is empty; plug the tablet in again, or try another cable")]
    Empty,
    /// It is longer than HID allows.
    #[error("the report descriptor has {length} bytes; HID allows {MAX_DESCRIPTOR_BYTES}")]
    TooLong {
        /// Its length in bytes.
        length: usize,
    },
    /// The last item has fewer bytes than it announces.
    #[error("the report descriptor is cut off inside the item at byte {offset}; plug the tablet in again")]
    CutOff {
        /// Where the item begins.
        offset: usize,
    },
    /// A collection ends, or a state is popped, that never began.
    #[error("the report descriptor closes at byte {offset} what it never opened")]
    Unbalanced {
        /// Where the item begins.
        offset: usize,
    },
    /// Collections or saved states are nested deeper than any real device does it.
    #[error("the report descriptor is nested deeper than {MAX_DEPTH} levels at byte {offset}")]
    TooDeep {
        /// Where the item begins.
        offset: usize,
    },
    /// A report id that HID does not have.
    #[error("the report descriptor has report id {id} at byte {offset}; HID has 1 to 255")]
    ReportId {
        /// The number.
        id: u32,
        /// Where the item begins.
        offset: usize,
    },
    /// A report longer than the kernel would carry, or with more fields than any real device has.
    #[error(
        "the report descriptor describes a report of more than {} bytes or more than {MAX_FIELDS} fields at byte \
         {offset}", MAX_REPORT_BITS / 8
    )]
    TooMuch {
        /// Where the item begins.
        offset: usize,
    },
    /// It could not be interpreted for another reason.
    #[error("the report descriptor cannot be interpreted: {0}")]
    Meaning(String),
}
