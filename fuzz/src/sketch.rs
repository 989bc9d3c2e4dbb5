//! Any bytes given to the reader of drawings, JSON or SVG, end in a message or in a sketch that reads back as itself.

use penstemon::sketch::{from_bytes, json};

/// Fails where what the head of this file says does not hold of these bytes.
pub fn check(bytes: &[u8]) {
    let Ok((sketch, _)) = from_bytes(bytes, "fuzz") else { return };
    sketch.check_invariants().expect("a sketch that was read keeps the invariants");
    let written = json::write(&sketch);
    let (again, warnings) = from_bytes(written.as_bytes(), "again").expect("what was written can be read");
    assert_eq!(again, sketch);
    assert_eq!(warnings, []);
}
