//! Any text given to the SVG reader ends in a message or in a sketch that survives writing and reading.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| penstemon_fuzz::read_write_read(bytes));
