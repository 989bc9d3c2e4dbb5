//! Any bytes as a texture end in a message or in as many pixels as its size says.

use penstemon::picture::decode::decode;

/// Fails where what the head of this file says does not hold of these bytes.
pub fn check(bytes: &[u8]) {
    let Ok(picture) = decode(bytes) else { return };
    assert_eq!(picture.pixels.len(), 4 * picture.width as usize * picture.height as usize);
}
