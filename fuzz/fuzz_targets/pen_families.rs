//! Fuzzes `pen_families::check`.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| penstemon_fuzz::pen_families::check(bytes));
