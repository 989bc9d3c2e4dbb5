//! Fuzzes `sketch::check`.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| penstemon_fuzz::sketch::check(bytes));
