//! How large a report descriptor may be, and what it may describe: more than any real device, little enough for any memory.

/// Longest report descriptor that HID allows.
pub const MAX_DESCRIPTOR_BYTES: usize = 4096;
/// Most fields that may matter to a pen in all input reports together; real devices stay below 1,000.
pub(super) const MAX_FIELDS: usize = 4096;
/// Deepest nesting of collections, and of saved states; real devices stay below 8.
pub(super) const MAX_DEPTH: usize = 16;
/// Longest input report: the kernel's own limit of 16 KiB.
pub(super) const MAX_REPORT_BITS: u64 = 16 * 1024 * 8;
