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

/// A journal whose records are the lines of `steps`.
pub fn journal_of(steps: &[u8]) -> Vec<u8> {
    let mut out = b"penstemon-journal 1\n".to_vec();
    for step in steps.split(|byte| *byte == b'\n') {
        let mut sum = crc32fast::Hasher::new();
        sum.update(b"S");
        sum.update(step);
        out.extend_from_slice(&(step.len() as u32 + 1).to_le_bytes());
        out.extend_from_slice(&sum.finalize().to_le_bytes());
        out.push(b'S');
        out.extend_from_slice(step);
    }
    out
}
