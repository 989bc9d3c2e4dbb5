//! Whatever a crash or a disk left of a journal, what is recovered is a sound drawing that holds the snapshot's strokes or
//! what steps made of them. Input is either a whole file after an `R`, or records, one a line, which get the sums that whole
//! ones have, in a journal of today's version or of the first.

use penstemon::sketch::journal::Recovery;
use std::fs;

const SNAPSHOT: &[u8] = include_bytes!("../seeds/sketch_json/minimal.penstemon");

/// Fails where what the head of this file says does not hold of these bytes.
pub fn check(bytes: &[u8]) {
    let state = tempfile::tempdir().expect("a folder for recovery copies");
    let session = state.path().join("session-fuzz");
    fs::create_dir(&session).expect("a folder for one copy");
    fs::write(session.join("snapshot-1.penstemon"), SNAPSHOT).expect("room for a snapshot");
    let journal = bytes.strip_prefix(b"R").map_or_else(|| journal_of(bytes), <[u8]>::to_vec);
    fs::write(session.join("journal-1"), journal).expect("room for a journal");
    for found in Recovery::at(state.path()).list().expect("a folder that can be read") {
        if let Ok(restored) = &found.content {
            restored.sketch.check_invariants().expect("a recovered drawing keeps the invariants");
        }
    }
}

/// Kinds of records that a line of [`journal_of`] may begin with.
const KINDS: &[u8] = b"SPNFK";

/// A journal whose records are lines: each a step, or of the kind that the letter before it says. It has the version that
/// the program writes today, or version 1 where the first line begins with `1`.
fn journal_of(lines: &[u8]) -> Vec<u8> {
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
