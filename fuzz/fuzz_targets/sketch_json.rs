//! Any bytes given to the sketch reader end in a message or in a sketch that reads back as itself.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| penstemon_fuzz::read_write_read(bytes));
