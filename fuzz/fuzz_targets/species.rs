//! Any text as a species file ends in a message or in a species; nothing panics.

#![no_main]

use libfuzzer_sys::fuzz_target;
use penstemon::species::Species;

fuzz_target!(|bytes: &[u8]| {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let _ = Species::from_toml(text, "fuzz.toml");
});
