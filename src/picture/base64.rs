//! Base64 with padding (RFC 4648, section 4), for pictures in text files.
//!
//! Strict: every group has four characters, padding stands only at the end, and unused bits are zero, so that a text
//! has one meaning and each meaning one text. White space is not skipped.

const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
const PADDING: u8 = b'=';

/// Value of each character, or [`NONE`].
const VALUES: [u8; 256] = values();
const NONE: u8 = 0xff;

const fn values() -> [u8; 256] {
    let mut values = [NONE; 256];
    let mut i = 0;
    while i < ALPHABET.len() {
        values[ALPHABET[i] as usize] = i as u8;
        i += 1;
    }
    values
}

/// Appends `bytes` as text.
pub(super) fn encode_into(bytes: &[u8], out: &mut String) {
    out.reserve(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let bits =
            group.iter().fold(0_u32, |bits, byte| bits << 8 | u32::from(*byte)) << (8 * (3 - group.len()));
        for place in 0..4 {
            let six = (bits >> (18 - 6 * place)) as usize & 63;
            out.push(char::from(if place <= group.len() { ALPHABET[six] } else { PADDING }));
        }
    }
}

/// The bytes behind `text`.
///
/// # Errors
/// Offset of the group of four characters that is not sound.
pub(super) fn decode(text: &str) -> Result<Vec<u8>, usize> {
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3);
    for (at, group) in text.as_bytes().chunks(4).enumerate() {
        let is_last = (at + 1) * 4 >= text.len();
        let padding = group.iter().rev().take_while(|c| **c == PADDING).count();
        if group.len() < 4 || padding > 2 || padding > 0 && !is_last {
            return Err(at * 4);
        }
        let mut bits = 0_u32;
        for &character in &group[..4 - padding] {
            let six = VALUES[usize::from(character)];
            if six == NONE {
                return Err(at * 4);
            }
            bits = bits << 6 | u32::from(six);
        }
        bits <<= 6 * padding;
        let [_, first, second, third] = bits.to_be_bytes();
        let group = [first, second, third];
        let (whole, rest) = group.split_at(3 - padding);
        if rest.iter().any(|byte| *byte != 0) {
            return Err(at * 4);
        }
        bytes.extend_from_slice(whole);
    }
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn encode(bytes: &[u8]) -> String {
        let mut text = String::new();
        encode_into(bytes, &mut text);
        text
    }

    #[test]
    fn the_vectors_of_the_standard() {
        for (plain, text) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(encode(plain.as_bytes()), text);
            assert_eq!(decode(text).unwrap(), plain.as_bytes());
        }
    }

    #[test]
    fn what_is_not_sound_is_refused_and_placed() {
        for (text, at) in [
            ("Zg=", 0),
            ("Zm9vYg", 4),
            ("Z===", 0),
            ("Zg==Zg==", 0),
            ("Zm9v Zm9v", 4),
            ("Zh==", 0),
            ("====", 0),
        ] {
            assert_eq!(decode(text), Err(at), "{text}");
        }
    }

    proptest! {
        #[test]
        fn bytes_come_back(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
            prop_assert_eq!(decode(&encode(&bytes)).unwrap(), bytes);
        }

        #[test]
        fn any_text_is_refused_or_is_the_one_text_of_its_bytes(text in "[A-Za-z0-9+/= ]{0,12}") {
            if let Ok(bytes) = decode(&text) {
                prop_assert_eq!(encode(&bytes), text);
            }
        }
    }
}
