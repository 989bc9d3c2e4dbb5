//! What fuzz targets share.

use penstemon::sketch::{from_bytes, json};

/// Reads a drawing; if it is one, checks its invariants and that writing and reading give it back.
pub fn read_write_read(bytes: &[u8]) {
    let Ok((sketch, _)) = from_bytes(bytes, "fuzz") else { return };
    sketch.check_invariants().expect("a sketch that was read keeps the invariants");
    let written = json::write(&sketch);
    let (again, warnings) = from_bytes(written.as_bytes(), "again").expect("what was written can be read");
    assert_eq!(again, sketch);
    assert_eq!(warnings, []);
}
