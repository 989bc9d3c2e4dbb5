//! Fuzzes `model_reader::check`.

#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| penstemon_fuzz::model_reader::check(bytes));
