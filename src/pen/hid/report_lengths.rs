//! How long a device's reports are, by its report descriptor.
//!
//! Makers' tables tell models apart by the longest report of a node. Lengths count the report id's byte, also for devices
//! whose reports have none. Source: HID 1.11, section 6.2.2.

use super::descriptor_items::{Items, tag};
use std::collections::BTreeMap;

/// Longest reports of a node in bytes, id included; 0 for a kind that it does not have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ReportLengths {
    /// What the device sends.
    pub input: usize,
    /// What can be written to it.
    pub output: usize,
}

/// Size of one field, how many there are, and the report in which they stand.
#[derive(Clone, Copy, Default)]
struct State {
    size: u64,
    count: u64,
    id: u32,
}

impl ReportLengths {
    /// Adds up the fields of every report; what follows a broken item is not counted.
    pub fn of(descriptor: &[u8]) -> Self {
        let longest = |bits: &BTreeMap<u32, u64>| bits.values().map(|bits| bytes(*bits)).max().unwrap_or(0);
        let [input, output] = bits(descriptor);
        Self { input: longest(&input), output: longest(&output) }
    }
}

/// Bytes of one input report, id included; `None` for one that the device does not have.
pub fn input_length(descriptor: &[u8], report_id: u8) -> Option<usize> {
    let [input, _] = bits(descriptor);
    input.get(&u32::from(report_id)).map(|bits| bytes(*bits))
}

/// Bytes of a report of so many bits, its id included.
fn bytes(bits: u64) -> usize {
    usize::try_from(1 + bits.div_ceil(8)).unwrap_or(usize::MAX)
}

/// Bits of every input and of every output report, by their ids.
fn bits(descriptor: &[u8]) -> [BTreeMap<u32, u64>; 2] {
    let mut bits: [BTreeMap<u32, u64>; 2] = Default::default();
    let (mut state, mut saved) = (State::default(), Vec::new());
    for item in Items::new(descriptor).map_while(Result::ok) {
        let kind = match item.tag {
            tag::REPORT_SIZE => {
                state.size = item.unsigned().into();
                continue;
            }
            tag::REPORT_COUNT => {
                state.count = item.unsigned().into();
                continue;
            }
            tag::REPORT_ID => {
                state.id = item.unsigned();
                continue;
            }
            tag::PUSH => {
                saved.push(state);
                continue;
            }
            tag::POP => {
                state = saved.pop().unwrap_or(state);
                continue;
            }
            tag::INPUT => 0,
            tag::OUTPUT => 1,
            _ => continue,
        };
        let sum = bits[kind].entry(state.id).or_default();
        *sum = sum.saturating_add(state.size.saturating_mul(state.count));
    }
    bits
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_longest_report_of_each_kind_counts_with_its_id() {
        // Two input reports of 8 and 3 bytes, one output report of 63; the size is saved over the first.
        let descriptor = [
            0x06, 0x0A, 0xFF, 0x09, 0x01, 0xA1, 0x01, 0x75, 0x08, 0x85, 0x02, 0x95, 0x07, 0x81, 0x02, 0xA4,
            0x85, 0x03, 0x75, 0x01, 0x95, 0x10, 0x81, 0x02, 0xB4, 0x95, 0x3E, 0x91, 0x02, 0xC0,
        ];
        assert_eq!(ReportLengths::of(&descriptor), ReportLengths { input: 8, output: 63 });
        assert_eq!(ReportLengths::of(&[]), ReportLengths::default());
        assert_eq!([2, 3, 4].map(|id| input_length(&descriptor, id)), [Some(8), Some(3), None]);
    }

    proptest! {
        #[test]
        fn any_bytes_have_lengths(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
            ReportLengths::of(&bytes);
        }
    }
}
