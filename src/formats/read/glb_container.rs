//! The container of binary glTF: a header and chunks, taken apart.

use super::error::Malformed;
use gltf_json::Root;

/// A GLB file's document and its binary buffer, empty if it has none.
///
/// # Errors
/// Anything but a whole glTF 2.0 container with a readable document.
pub(super) fn open(bytes: &[u8]) -> Result<(Root, &[u8]), Malformed> {
    let fault = |reason: &str| Malformed::new("header", reason);
    if bytes.get(..4) != Some(b"glTF") {
        return Err(fault("it does not begin with `glTF`; this is no GLB file"));
    }
    if word(bytes, 4) != Some(2) {
        return Err(fault("only version 2 of glTF is read"));
    }
    let length = word(bytes, 8).ok_or_else(|| fault("the file ends in its header"))?;
    let body = bytes.get(12..length).ok_or_else(|| {
        fault(&format!("it promises {length} bytes, the file has {}; it seems cut off", bytes.len()))
    })?;
    let (document, rest) = chunk(body, b"JSON")?;
    let root = Root::from_slice(document).map_err(|e| Malformed::new("JSON chunk", e.to_string()))?;
    let buffer = if rest.is_empty() { rest } else { chunk(rest, b"BIN\0")?.0 };
    Ok((root, buffer))
}

/// The contents of the chunk that `bytes` begin with, and what follows it.
fn chunk<'a>(bytes: &'a [u8], kind: &[u8; 4]) -> Result<(&'a [u8], &'a [u8]), Malformed> {
    let name = String::from_utf8_lossy(&kind[..3]);
    let fault = |reason: &str| Malformed::new(format!("{name} chunk"), reason);
    if bytes.get(4..8) != Some(kind) {
        return Err(fault("it is missing"));
    }
    let length = word(bytes, 0).unwrap_or_default();
    let end = length.checked_add(8).ok_or_else(|| fault("its length overflows"))?;
    let contents = bytes.get(8..end).ok_or_else(|| fault("it is longer than the file"))?;
    Ok((contents, &bytes[end..]))
}

fn word(bytes: &[u8], at: usize) -> Option<usize> {
    let word = bytes.get(at..at + 4)?.try_into().ok()?;
    Some(u32::from_le_bytes(word) as usize)
}
