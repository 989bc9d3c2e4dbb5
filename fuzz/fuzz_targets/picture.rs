//! Fuzzes `picture::check`, which needs the decoders of the program and so is no part of the library beside it.

#![no_main]

#[path = "../src/picture.rs"]
mod picture;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| picture::check(bytes));
