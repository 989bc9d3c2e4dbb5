//! Any bytes as a recording of tablets: a message, or a recording that can be written, read again and played.

use penstemon::pen::grammar::Grammar;
use penstemon::pen::hid::{Recording, replay};
use penstemon::pen::mapping::Rect;

/// Fails where what the head of this file says does not hold of these bytes.
pub fn check(bytes: &[u8]) {
    let Ok(recording) = Recording::from_bytes(bytes, "fuzz") else { return };
    let again = Recording::from_bytes(recording.to_text().as_bytes(), "again");
    assert_eq!(again.expect("what was written can be read"), recording);
    let mut grammars = vec![Grammar::default(); recording.devices.len()];
    let window = Rect { min: (0.0, 0.0).into(), max: (1920.0, 1080.0).into() };
    replay::play(&recording, window, &mut |device, event| {
        grammars[device].accept(event).expect("every pen keeps the grammar");
    });
}
