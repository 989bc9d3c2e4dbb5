//! What a test cannot check on this machine: said by name, and counted by `./test.sh`.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use std::fs::OpenOptions;
use std::io::{Write as _, stderr};

/// Says that `test` is not run here and why, and notes it in the file named by `PENSTEMON_NOT_RUN`.
pub(crate) fn not_run(test: &str, why: &str) {
    let line = format!("{test}: {why}\n");
    // Straight to the stream: the test harness hides what `eprintln!` prints.
    stderr().write_all(format!("not run here: {line}").as_bytes()).unwrap();
    if let Some(list) = std::env::var_os("PENSTEMON_NOT_RUN") {
        OpenOptions::new().create(true).append(true).open(list).unwrap().write_all(line.as_bytes()).unwrap();
    }
}
