//! Fuzzes `pen_recording::check`.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| penstemon_fuzz::pen_recording::check(bytes));
