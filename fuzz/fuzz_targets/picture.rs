//! Any bytes as a texture end in a message or in as many pixels as its size says.

#![no_main]

use libfuzzer_sys::fuzz_target;
use penstemon::export::decode::decode;

fuzz_target!(|bytes: &[u8]| {
    let Ok(picture) = decode(bytes) else { return };
    assert_eq!(picture.pixels.len(), 4 * picture.width as usize * picture.height as usize);
});
