//! Whatever a crash or a disk left of a journal, what is recovered is a sound drawing that holds the snapshot's strokes or
//! what steps made of them. Input is either a whole file after an `R`, or records, one a line, which get the sums that whole
//! ones have, in a journal of today's version or of the first.

#![no_main]

use libfuzzer_sys::fuzz_target;
use penstemon::sketch::journal::Recovery;
use penstemon_fuzz::journal_of;
use std::fs;

const SNAPSHOT: &[u8] = include_bytes!("../seeds/sketch_json/minimal.penstemon");

fuzz_target!(|bytes: &[u8]| {
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
});
