//! Brings a report descriptor into a plain form before it is interpreted.
//!
//! Descriptors come from the device, so any bytes may come. The interpreter (`hidreport`) trusts them: huge usage ranges
//! and nested collections would take memory without bound, and some gaps make it panic. Here the items are read once, as
//! the Linux kernel reads them, and written anew: every value in four bytes, usages resolved and in front of the field
//! that uses them, maxima unsigned unless their minimum is negative, unknown and long items left out. Only input reports
//! remain; constants, arrays and fields of other pages become padding of the same size. What costs more than
//! [`MAX_FIELDS`], [`MAX_DEPTH`] or [`MAX_REPORT_BITS`] is refused. Source: HID 1.11, section 6.2.2.

use super::DescriptorError;
use super::descriptor_limits::{MAX_DEPTH, MAX_DESCRIPTOR_BYTES, MAX_FIELDS, MAX_REPORT_BITS};

/// Widest field that is read.
const MAX_FIELD_BITS: u32 = 64;

/// Usage pages that a pen is described with: desktop, device controls, buttons (of the mouse that it imitates),
/// digitizers, battery, and Wacom's own.
const PAGES: [u32; 6] = [0x01, 0x06, 0x09, 0x0D, 0x85, 0xFF0D];

/// First bytes of items, the two bits of their size left out.
pub(super) mod tag {
    pub(in crate::pen::hid) const INPUT: u8 = 0x80;
    pub(in crate::pen::hid) const OUTPUT: u8 = 0x90;
    pub(in crate::pen::hid) const COLLECTION: u8 = 0xA0;
    pub(in crate::pen::hid) const FEATURE: u8 = 0xB0;
    pub(in crate::pen::hid) const END_COLLECTION: u8 = 0xC0;
    pub(in crate::pen::hid) const USAGE_PAGE: u8 = 0x04;
    pub(in crate::pen::hid) const LOGICAL_MINIMUM: u8 = 0x14;
    pub(in crate::pen::hid) const LOGICAL_MAXIMUM: u8 = 0x24;
    pub(in crate::pen::hid) const PHYSICAL_MINIMUM: u8 = 0x34;
    pub(in crate::pen::hid) const PHYSICAL_MAXIMUM: u8 = 0x44;
    pub(in crate::pen::hid) const UNIT_EXPONENT: u8 = 0x54;
    pub(in crate::pen::hid) const UNIT: u8 = 0x64;
    pub(in crate::pen::hid) const REPORT_SIZE: u8 = 0x74;
    pub(in crate::pen::hid) const REPORT_ID: u8 = 0x84;
    pub(in crate::pen::hid) const REPORT_COUNT: u8 = 0x94;
    pub(in crate::pen::hid) const PUSH: u8 = 0xA4;
    pub(in crate::pen::hid) const POP: u8 = 0xB4;
    pub(in crate::pen::hid) const USAGE: u8 = 0x08;
    pub(in crate::pen::hid) const USAGE_MINIMUM: u8 = 0x18;
    pub(in crate::pen::hid) const USAGE_MAXIMUM: u8 = 0x28;
    /// A long item: its size stands in the next byte.
    pub(in crate::pen::hid) const LONG: u8 = 0xFC;
}

/// Bits of an input item.
const IS_CONSTANT: u32 = 1;
const IS_VARIABLE: u32 = 2;

/// One item as it stands in the descriptor.
pub(super) struct Item<'a> {
    offset: usize,
    pub(super) tag: u8,
    data: &'a [u8],
}

impl Item<'_> {
    pub(super) fn unsigned(&self) -> u32 {
        self.data.iter().rev().fold(0, |value, byte| value << 8 | u32::from(*byte))
    }

    fn signed(&self) -> i32 {
        match self.data {
            [] => 0,
            [a] => i32::from(*a as i8),
            [a, b] => i32::from(i16::from_le_bytes([*a, *b])),
            _ => self.unsigned() as i32,
        }
    }
}

/// Items of a descriptor one after the other; ends after the first that is cut off.
pub(super) struct Items<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Items<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0 }
    }
}

impl<'a> Iterator for Items<'a> {
    type Item = Result<Item<'a>, DescriptorError>;

    fn next(&mut self) -> Option<Self::Item> {
        let offset = self.at;
        let first = *self.bytes.get(offset)?;
        let (tag, start, size) = match first {
            0xFE => (tag::LONG, offset + 3, usize::from(self.bytes.get(offset + 1).copied().unwrap_or(0))),
            _ => (first & 0xFC, offset + 1, [0, 1, 2, 4][usize::from(first & 3)]),
        };
        let Some(data) = self.bytes.get(start..start + size) else {
            self.at = self.bytes.len();
            return Some(Err(DescriptorError::CutOff { offset }));
        };
        self.at = start + size;
        Some(Ok(Item { offset, tag, data }))
    }
}

/// Whether a device's reports begin with a report id; without, hidraw leaves that byte out.
pub fn has_report_ids(descriptor: &[u8]) -> bool {
    let mut items = Items::new(descriptor);
    items.any(|item| item.is_ok_and(|item| item.tag == tag::REPORT_ID))
}

/// The descriptor in its plain form.
///
/// # Errors
/// A descriptor that is broken or too large.
pub(super) fn plain(bytes: &[u8]) -> Result<Vec<u8>, DescriptorError> {
    if bytes.is_empty() {
        return Err(DescriptorError::Empty);
    }
    if bytes.len() > MAX_DESCRIPTOR_BYTES {
        return Err(DescriptorError::TooLong { length: bytes.len() });
    }
    let mut writer = Writer::default();
    // The interpreter panics on a usage before any page. Every report begins with an id here, 0 if the device has none.
    writer.put(tag::USAGE_PAGE, 0);
    writer.put(tag::REPORT_ID, 0);
    for item in Items::new(bytes) {
        let item = item?;
        match item.tag {
            tag::INPUT => writer.input(&item)?,
            tag::OUTPUT | tag::FEATURE => writer.forget_locals(),
            tag::COLLECTION => writer.collection(&item)?,
            tag::END_COLLECTION => writer.end_collection(&item)?,
            tag::USAGE => writer.usages.push(Usages::one(&item)),
            tag::USAGE_MINIMUM => writer.usage_minimum = item.unsigned(),
            tag::USAGE_MAXIMUM => {
                let (first, last) = (writer.usage_minimum, item.unsigned());
                writer.usages.push(Usages { first, last: last.max(first), has_page: item.data.len() == 4 });
            }
            _ => writer.global(&item)?,
        }
    }
    Ok(writer.out)
}

/// What stays until it is said anew.
#[derive(Clone, Copy, Default)]
struct Globals {
    page: u32,
    logical_is_signed: bool,
    physical_is_signed: bool,
    report_id: u8,
    size: u32,
    count: u32,
}

/// One usage, or a range of them.
struct Usages {
    first: u32,
    last: u32,
    /// The page is part of the number; otherwise it is the page in force when the field is declared.
    has_page: bool,
}

impl Usages {
    fn one(item: &Item<'_>) -> Self {
        let usage = item.unsigned();
        Self { first: usage, last: usage, has_page: item.data.len() == 4 }
    }
}

struct Writer {
    out: Vec<u8>,
    globals: Globals,
    saved: Vec<Globals>,
    depth: usize,
    usages: Vec<Usages>,
    usage_minimum: u32,
    fields: usize,
    /// Bits of each report so far, by report id.
    bits: Box<[u64; 256]>,
}

impl Default for Writer {
    fn default() -> Self {
        Self {
            out: Vec::new(),
            globals: Globals::default(),
            saved: Vec::new(),
            depth: 0,
            usages: Vec::new(),
            usage_minimum: 0,
            fields: 0,
            bits: Box::new([0; 256]),
        }
    }
}

impl Writer {
    fn put(&mut self, tag: u8, value: u32) {
        self.out.push(tag | 3);
        self.out.extend_from_slice(&value.to_le_bytes());
    }

    fn forget_locals(&mut self) {
        self.usages.clear();
        self.usage_minimum = 0;
    }

    fn global(&mut self, item: &Item<'_>) -> Result<(), DescriptorError> {
        let offset = item.offset;
        let (signed, unsigned) = (item.signed() as u32, item.unsigned());
        let value = match item.tag {
            tag::USAGE_PAGE => {
                self.globals.page = unsigned & 0xFFFF;
                unsigned
            }
            tag::LOGICAL_MINIMUM => {
                self.globals.logical_is_signed = item.signed() < 0;
                signed
            }
            tag::PHYSICAL_MINIMUM => {
                self.globals.physical_is_signed = item.signed() < 0;
                signed
            }
            tag::LOGICAL_MAXIMUM if self.globals.logical_is_signed => signed,
            tag::PHYSICAL_MAXIMUM if self.globals.physical_is_signed => signed,
            tag::UNIT_EXPONENT => signed,
            tag::LOGICAL_MAXIMUM | tag::PHYSICAL_MAXIMUM | tag::UNIT => unsigned,
            tag::REPORT_SIZE => {
                self.globals.size = unsigned;
                unsigned
            }
            tag::REPORT_COUNT => {
                self.globals.count = unsigned;
                unsigned
            }
            tag::REPORT_ID => {
                let id = u8::try_from(unsigned).ok().filter(|id| *id != 0);
                self.globals.report_id = id.ok_or(DescriptorError::ReportId { id: unsigned, offset })?;
                unsigned
            }
            tag::PUSH if self.saved.len() >= MAX_DEPTH => return Err(DescriptorError::TooDeep { offset }),
            tag::PUSH => {
                self.saved.push(self.globals);
                self.out.push(tag::PUSH);
                return Ok(());
            }
            tag::POP => {
                self.globals = self.saved.pop().ok_or(DescriptorError::Unbalanced { offset })?;
                self.out.push(tag::POP);
                return Ok(());
            }
            _ => return Ok(()),
        };
        self.put(item.tag, value);
        Ok(())
    }

    fn collection(&mut self, item: &Item<'_>) -> Result<(), DescriptorError> {
        if self.depth >= MAX_DEPTH {
            return Err(DescriptorError::TooDeep { offset: item.offset });
        }
        self.depth += 1;
        let usage = self.resolved().next().unwrap_or(0);
        self.put(tag::USAGE, usage);
        self.out.extend([tag::COLLECTION | 1, item.data.first().copied().unwrap_or(0)]);
        self.forget_locals();
        Ok(())
    }

    fn end_collection(&mut self, item: &Item<'_>) -> Result<(), DescriptorError> {
        let offset = item.offset;
        self.depth = self.depth.checked_sub(1).ok_or(DescriptorError::Unbalanced { offset })?;
        self.out.push(tag::END_COLLECTION);
        self.forget_locals();
        Ok(())
    }

    /// Usages named since the last field, in order.
    fn resolved(&self) -> impl Iterator<Item = u32> + '_ {
        let page = self.globals.page << 16;
        self.usages.iter().flat_map(move |usages| {
            let page = if usages.has_page { 0 } else { page };
            (usages.first..=usages.last).map(move |usage| page | usage)
        })
    }

    fn input(&mut self, item: &Item<'_>) -> Result<(), DescriptorError> {
        let Globals { size, count, report_id, .. } = self.globals;
        let bits = u64::from(size) * u64::from(count);
        let total = &mut self.bits[usize::from(report_id)];
        *total = total.saturating_add(bits);
        if *total > MAX_REPORT_BITS {
            return Err(DescriptorError::TooMuch { offset: item.offset });
        }
        if bits > 0 {
            let flags = item.unsigned();
            let is_field = flags & (IS_CONSTANT | IS_VARIABLE) == IS_VARIABLE && size <= MAX_FIELD_BITS;
            // At most MAX_REPORT_BITS usages, since there is at least one bit to each.
            let used: Vec<u32> =
                if is_field { self.resolved().take(count as usize).collect() } else { vec![] };
            if used.iter().any(|usage| PAGES.contains(&(usage >> 16))) {
                self.fields += count as usize;
                if self.fields > MAX_FIELDS {
                    return Err(DescriptorError::TooMuch { offset: item.offset });
                }
                used.into_iter().for_each(|usage| self.put(tag::USAGE, usage));
                self.put(tag::INPUT, flags);
            } else {
                self.put(tag::INPUT, IS_CONSTANT);
            }
        }
        self.forget_locals();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maxima_are_unsigned_unless_the_minimum_is_negative() {
        let plain_of = |bytes: &[u8]| plain(bytes).unwrap().split_off(10);
        assert_eq!(plain_of(&[0x15, 0, 0x25, 0xFF]), [0x17, 0, 0, 0, 0, 0x27, 0xFF, 0, 0, 0]);
        let signed = [0x17, 0x80, 0xFF, 0xFF, 0xFF, 0x27, 0xFE, 0xFF, 0xFF, 0xFF];
        assert_eq!(plain_of(&[0x15, 0x80, 0x25, 0xFE]), signed);
    }

    #[test]
    fn broken_descriptors_are_named_with_their_place() {
        use DescriptorError::*;
        let of = |bytes: &[u8]| plain(bytes).unwrap_err();
        assert_eq!(of(&[]), Empty);
        assert_eq!(of(&[0; 4097]), TooLong { length: 4097 });
        assert_eq!(of(&[0x05, 0x0D, 0x26, 0x01]), CutOff { offset: 2 });
        assert_eq!(of(&[0xC0]), Unbalanced { offset: 0 });
        assert_eq!(of(&[0xB4]), Unbalanced { offset: 0 });
        assert_eq!(of(&[0xA4; 17]), TooDeep { offset: 16 });
        assert_eq!(of(&[0xA0; 17]), TooDeep { offset: 16 });
        assert_eq!(of(&[0x85, 0]), ReportId { id: 0, offset: 0 });
        assert_eq!(of(&[0x77, 0xFF, 0xFF, 0xFF, 0xFF, 0x97, 2, 0, 0, 0, 0x81, 2]), TooMuch { offset: 10 });
    }

    #[test]
    fn endless_usage_ranges_cost_nothing() {
        let range = [0x05, 0x0D, 0x1B, 0, 0, 0, 0, 0x2B, 0xFF, 0xFF, 0xFF, 0xFF];
        let field = [0x75, 1, 0x95, 3, 0x81, 2];
        let plain = plain(&[&range[..], &field].concat()).unwrap();
        assert!(plain.len() < 60, "{}", plain.len());
    }
}
