//! Any text as a species file ends in a message or in a species; nothing panics.

use penstemon::species::Species;

/// Fails where what the head of this file says does not hold of these bytes.
pub fn check(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let _ = Species::from_toml(text, "fuzz.toml");
}
