//! The journal file: a line that names format and version, then records.
//!
//! A record is its length (u32, little endian), a CRC-32 (IEEE) of what follows, a byte that says what it is, and the
//! body: a step as JSON text, or a picture's bytes. Reading stops at the first record that is cut off or whose sum is
//! wrong, which is where writing was interrupted.

use std::io::{self, Read};

/// First line of every journal.
pub(super) const HEADER: &str = "penstemon-journal 1\n";

/// The header up to its number.
const FORMAT: &str = "penstemon-journal ";

/// The version that [`HEADER`] says.
const VERSION: u64 = 1;

/// Bytes before a record's kind.
const PREFIX_BYTES: usize = 8;

/// What a record holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A step, as JSON text.
    Step,
    /// A picture that steps after it name by its hash.
    Picture,
}

impl Kind {
    const ALL: [Self; 2] = [Self::Step, Self::Picture];

    fn byte(self) -> u8 {
        match self {
            Self::Step => b'S',
            Self::Picture => b'P',
        }
    }
}

/// Appends a record.
pub(super) fn append(out: &mut Vec<u8>, kind: Kind, body: &[u8]) -> io::Result<()> {
    let length = u32::try_from(body.len() + 1).map_err(|_| io::ErrorKind::FileTooLarge)?;
    let mut sum = crc32fast::Hasher::new();
    sum.update(&[kind.byte()]);
    sum.update(body);
    out.extend_from_slice(&length.to_le_bytes());
    out.extend_from_slice(&sum.finalize().to_le_bytes());
    out.push(kind.byte());
    out.extend_from_slice(body);
    Ok(())
}

/// What a header says.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Header {
    /// Records follow.
    Known,
    /// Of a newer program.
    Newer(u64),
    /// Cut off or something else.
    Broken,
}

/// What comes next in a journal.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Next {
    /// A whole record.
    Record(Kind, Vec<u8>),
    /// The end, right after a record.
    End,
    /// Half a record, or bytes that are none.
    Torn,
}

/// Reads the first line.
pub(super) fn read_header(from: &mut impl Read) -> io::Result<Header> {
    let mut line = Vec::new();
    let mut byte = [0];
    const LONGEST: usize = 64;
    while line.len() < LONGEST && from.read(&mut byte)? == 1 {
        if byte == *b"\n" {
            let text = String::from_utf8_lossy(&line);
            let version = text.strip_prefix(FORMAT).and_then(|number| number.parse().ok());
            return Ok(match version {
                Some(VERSION) => Header::Known,
                Some(newer) if newer > VERSION => Header::Newer(newer),
                _ => Header::Broken,
            });
        }
        line.push(byte[0]);
    }
    Ok(Header::Broken)
}

/// Reads the next record.
pub(super) fn read_next(from: &mut impl Read) -> io::Result<Next> {
    let mut prefix = Vec::with_capacity(PREFIX_BYTES);
    from.take(PREFIX_BYTES as u64).read_to_end(&mut prefix)?;
    if prefix.is_empty() {
        return Ok(Next::End);
    }
    let (Some(&[a, b, c, d]), Some(&[e, f, g, h])) =
        (prefix.first_chunk::<4>(), prefix[4.min(prefix.len())..].first_chunk::<4>())
    else {
        return Ok(Next::Torn);
    };
    let (length, sum) = (u32::from_le_bytes([a, b, c, d]), u32::from_le_bytes([e, f, g, h]));
    // Grows with what is there, so that a wrong length costs nothing.
    let mut content = Vec::new();
    from.take(length.into()).read_to_end(&mut content)?;
    let kind = content.first().and_then(|byte| Kind::ALL.into_iter().find(|kind| kind.byte() == *byte));
    match kind {
        Some(kind) if content.len() == length as usize && crc32fast::hash(&content) == sum => {
            content.remove(0);
            Ok(Next::Record(kind, content))
        }
        _ => Ok(Next::Torn),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(mut bytes: &[u8]) -> (Vec<Vec<u8>>, Next) {
        let mut records = Vec::new();
        loop {
            match read_next(&mut bytes).unwrap() {
                Next::Record(_, body) => records.push(body),
                end => return (records, end),
            }
        }
    }

    #[test]
    fn a_cut_anywhere_leaves_whole_records() {
        let mut bytes = Vec::new();
        let mut ends = vec![0];
        for body in [&b"first"[..], b"", b"third one"] {
            append(&mut bytes, Kind::Step, body).unwrap();
            ends.push(bytes.len());
        }
        for cut in 0..=bytes.len() {
            let (records, end) = all(&bytes[..cut]);
            assert_eq!(records.len(), ends.iter().filter(|e| **e <= cut).count() - 1);
            assert_eq!(end, if ends.contains(&cut) { Next::End } else { Next::Torn });
        }
    }

    #[test]
    fn a_changed_bit_anywhere_is_found() {
        let mut bytes = Vec::new();
        append(&mut bytes, Kind::Picture, b"some bytes").unwrap();
        for bit in 0..bytes.len() * 8 {
            let mut changed = bytes.clone();
            changed[bit / 8] ^= 1 << (bit % 8);
            assert_eq!(all(&changed), (vec![], Next::Torn), "bit {bit}");
        }
        // What file systems leave behind a power cut.
        assert_eq!(all(&[0; 64]), (vec![], Next::Torn));
    }

    #[test]
    fn headers_tell_versions() {
        assert_eq!(read_header(&mut HEADER.as_bytes()).unwrap(), Header::Known);
        assert_eq!(read_header(&mut &b"penstemon-journal 12\nxyz"[..]).unwrap(), Header::Newer(12));
        for broken in ["", "penstemon-jour", "penstemon-journal 0\n", "something else\n"] {
            assert_eq!(read_header(&mut broken.as_bytes()).unwrap(), Header::Broken, "{broken}");
        }
    }
}
