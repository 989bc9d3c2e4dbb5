//! Any bytes as a report descriptor, and any bytes after them as reports: no panic, and what comes out is sound.
//!
//! The first two bytes are the length of the descriptor; the rest are reports of 64 bytes.

use penstemon::pen::grammar::Grammar;
use penstemon::pen::hid::{Decode, DescriptorDecoder, HidEvent};
use penstemon::pen::{Mapping, PenMachine};

/// Fails where what the head of this file says does not hold of these bytes.
pub fn check(bytes: &[u8]) {
    let Some((length, rest)) = bytes.split_first_chunk() else { return };
    let length = usize::from(u16::from_le_bytes(*length));
    let (descriptor, reports) = rest.split_at(length.min(rest.len()));
    let Ok(Some(mut decoder)) = DescriptorDecoder::new(descriptor) else { return };
    let (mut machine, mut grammar, mut events) =
        (PenMachine::new(Mapping::pixels()), Grammar::default(), Vec::new());
    for (number, report) in reports.chunks(64).enumerate() {
        decoder.decode(report, &mut |event| match event {
            HidEvent::Pen(pen) => {
                assert!((0.0..=1.0).contains(&pen.position.x) && (0.0..=1.0).contains(&pen.position.y));
                machine.sample(&pen, number as f64, &mut events);
            }
            HidEvent::Battery(percent) => assert!(percent <= 100),
            HidEvent::Ring { place, places, .. } | HidEvent::Strip { place, places, .. } => {
                assert!(place.is_none_or(|place| place < places));
            }
            HidEvent::Keys(_) | HidEvent::Touch { .. } | HidEvent::Dial { .. } => {}
        });
    }
    for event in &events {
        grammar.accept(event).expect("the machine keeps the grammar");
    }
}
