//! Fuzzes `journal::check`.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| penstemon_fuzz::journal::check(bytes));
