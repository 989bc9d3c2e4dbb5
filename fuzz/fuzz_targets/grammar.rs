//! Fuzzes `grammar::check`.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| penstemon_fuzz::grammar::check(bytes));
