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

/// Kinds of records that a line of [`journal_of`] may begin with.
const KINDS: &[u8] = b"SPNFK";

/// A journal whose records are lines: each a step, or of the kind that the letter before it says. It has the version that
/// the program writes today, or version 1 where the first line begins with `1`.
pub fn journal_of(lines: &[u8]) -> Vec<u8> {
    let (version, lines) = match lines.strip_prefix(b"1") {
        Some(lines) => (1, lines),
        None => (2, lines),
    };
    let mut out = format!("penstemon-journal {version}\n").into_bytes();
    for line in lines.split(|byte| *byte == b'\n') {
        let (kind, body) = match line.split_first() {
            Some((kind, body)) if KINDS.contains(kind) => (*kind, body),
            _ => (b'S', line),
        };
        let mut sum = crc32fast::Hasher::new();
        sum.update(&[kind]);
        sum.update(body);
        out.extend_from_slice(&(body.len() as u32 + 1).to_le_bytes());
        out.extend_from_slice(&sum.finalize().to_le_bytes());
        out.push(kind);
        out.extend_from_slice(body);
    }
    out
}
