//! Keys and fingers of Wacom tablets, in chunks of eight bytes.

use super::spec::share;
use super::{Bytes, Decode, HidEvent, Spec, bit};
use glam::DVec2;

/// A mask of fingers instead of chunks.
const MASK: u8 = 0x81;
/// A chunk of keys instead of a finger.
const KEYS: u8 = 0x80;
/// The first finger's id.
const FIRST_FINGER: u8 = 2;
const UP: u8 = 0x20;
const CHUNK: usize = 8;
const FINGERS: usize = 16;

/// Keeps where fingers are, because a mask lifts them without saying where.
pub(super) struct Chunks {
    spec: Spec,
    down: [Option<DVec2>; FINGERS],
}

impl Chunks {
    pub(super) fn new(spec: Spec) -> Self {
        Self { spec, down: [None; FINGERS] }
    }

    fn lift_unmasked(&mut self, mask: u16, sink: &mut dyn FnMut(HidEvent)) {
        for (finger, place) in (0..).zip(&mut self.down) {
            if mask >> finger & 1 == 0
                && let Some(position) = place.take()
            {
                sink(HidEvent::Touch { finger, touches: false, position });
            }
        }
    }

    fn finger(&mut self, chunk: Bytes<'_>) -> Option<HidEvent> {
        let [across, along] = self.spec.touch?;
        let finger = chunk.u8(0)?.checked_sub(FIRST_FINGER)?;
        let place = self.down.get_mut(usize::from(finger))?;
        let (touches, low) = (chunk.u8(1)? != UP, chunk.u8(4)?);
        let x = u32::from(chunk.u8(2)?) << 4 | u32::from(low >> 4);
        let y = u32::from(chunk.u8(3)?) << 4 | u32::from(low & 0x0F);
        let position = DVec2::new(share(x, across), share(y, along));
        *place = touches.then_some(position);
        Some(HidEvent::Touch { finger: finger.into(), touches, position })
    }
}

impl Decode for Chunks {
    fn decode(&mut self, report: &[u8], sink: &mut dyn FnMut(HidEvent)) {
        let b = Bytes(report);
        let (Some(count), Some(first)) = (b.u8(1), b.u8(2)) else { return };
        if first == MASK {
            if let Some(mask) = b.u16(3) {
                self.lift_unmasked(mask, sink);
            }
            return;
        }
        for chunk in report.get(2..).unwrap_or_default().chunks_exact(CHUNK).take(count.into()) {
            let chunk = Bytes(chunk);
            let event = match (chunk.u8(0), chunk.u8(1)) {
                (Some(KEYS), Some(keys)) => {
                    let held = (0..4).filter(|key| bit(keys, *key)).map(|key| 1 << key).sum();
                    Some(HidEvent::Keys(held))
                }
                _ => self.finger(chunk),
            };
            if let Some(event) = event {
                sink(event);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{events, quiet, silent_when_cut, spec};
    use super::super::{Family, Spec};
    use super::*;

    fn fingers() -> Spec {
        Spec { touch: Some([4096, 4096]), ..spec(Family::Wacom64bAux, 64) }
    }

    #[test]
    fn keys_and_fingers_in_one_report_and_a_mask_that_lifts() {
        let mut chunks = fingers().decoder();
        // id, two chunks; keys 1 and 3; finger 1 down at (0x800, 0x401) of 4096 steps
        let mut report = [0_u8; 18];
        report[..4].copy_from_slice(&[2, 2, 0x80, 0x05]);
        report[10..15].copy_from_slice(&[3, 0x80, 0x80, 0x40, 0x01]);
        let position = DVec2::new(0.5, 1025.0 / 4096.0);
        let down = HidEvent::Touch { finger: 1, touches: true, position };
        assert_eq!(events(&mut *chunks, &report), [HidEvent::Keys(5), down]);
        // id, -, mask marker, fingers still down: none
        let up = HidEvent::Touch { finger: 1, touches: false, position };
        assert_eq!(events(&mut *chunks, &[2, 0, 0x81, 0, 0]), [up]);
        assert!(quiet(&mut *chunks, &[2, 0, 0x81, 0, 0]), "lifted once");
        silent_when_cut(fingers(), &report[..10], 10);
    }

    #[test]
    fn fingers_without_a_known_range_say_nothing() {
        let mut chunks = spec(Family::Wacom64bAux, 64).decoder();
        assert!(quiet(&mut *chunks, &[2, 1, 3, 0x80, 0x80, 0x40, 0x01, 0, 0, 0]));
    }
}
