//! The journal file: a line that names format and version, then records.
//!
//! A record is its length (u32, little endian), a CRC-32 (IEEE) of what follows, a byte that says what it is, and the
//! body. Version 1 had steps and pictures only; version 2 adds what the drawing is called, when it was saved, and the sums of
//! snapshots; version 3 drawings that a garden has plants of.
//!
//! Where bytes are no record, reading goes on at the next place that begins a whole one: a length that fits, a known kind,
//! and the right sum. So a damaged record costs itself and no other. If only its length was damaged it is whole: its sum
//! holds up to where the next one begins. A journal may end in half a record, which is where writing was interrupted.
//!
//! Limit: damage to the last record that makes it look cut off is taken for an interruption.

use std::io;

/// First line of every journal.
pub(super) const HEADER: &str = "penstemon-journal 3\n";

/// The header up to its number.
const FORMAT: &str = "penstemon-journal ";

/// The newest version that is read, and the one that [`HEADER`] says.
const VERSION: u64 = 3;

/// Longest header of any version.
const LONGEST_HEADER: usize = 64;

/// Bytes before a record's kind.
const PREFIX_BYTES: usize = 8;

/// Bytes that looking for the next whole record may spend on sums, for every byte of the file: bytes made to look like
/// records would take the square of their number.
const SUMS_PER_BYTE: usize = 16;

/// What a record holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A step, as JSON text.
    Step,
    /// A picture that steps after it name by its hash.
    Picture,
    /// Drawings that steps after it name by their hashes, as JSON text.
    Drawing,
    /// Title and file of the drawing from here on, as JSON text.
    Named,
    /// The same, and that the file holds the drawing as it is here.
    Saved,
    /// Length and sum of a snapshot, as JSON text.
    Sum,
}

impl Kind {
    const ALL: [Self; 6] = [Self::Step, Self::Picture, Self::Drawing, Self::Named, Self::Saved, Self::Sum];

    fn byte(self) -> u8 {
        match self {
            Self::Step => b'S',
            Self::Picture => b'P',
            Self::Drawing => b'D',
            Self::Named => b'N',
            Self::Saved => b'F',
            Self::Sum => b'K',
        }
    }

    fn of(byte: u8) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.byte() == byte)
    }

    /// Whether a body may begin and end so: a look that spares most sums.
    fn may_be(self, body: &[u8]) -> bool {
        self == Self::Picture || (body.first() == Some(&b'{') && body.last() == Some(&b'}'))
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
    /// Of a newer program, whose records may be others.
    Newer(u64),
    /// Cut off: nothing was written yet.
    Unfinished,
    /// Something else; records may follow.
    Broken,
}

/// What comes next in a journal.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Next<'a> {
    /// A whole record.
    Record(Kind, &'a [u8]),
    /// Bytes that are no record, of which at least one is lost.
    Damaged,
    /// Half a record at the end.
    Unfinished,
}

/// Splits a journal into its header and what follows.
pub(super) fn read(bytes: &[u8]) -> (Header, Records<'_>) {
    let records = |rest| Records { rest, budget: bytes.len().saturating_mul(SUMS_PER_BYTE) };
    let start = &bytes[..bytes.len().min(LONGEST_HEADER)];
    let line = start.iter().position(|byte| *byte == b'\n').map(|end| bytes.split_at(end + 1));
    let version = line.and_then(|(line, _)| {
        let text = str::from_utf8(line).ok()?;
        text.strip_prefix(FORMAT)?.trim_end_matches('\n').parse().ok()
    });
    match (version, line) {
        (Some(1..=VERSION), Some((_, rest))) => (Header::Known, records(rest)),
        (Some(newer), Some((_, rest))) if newer > VERSION => (Header::Newer(newer), records(rest)),
        _ if bytes.len() < HEADER.len() || bytes.iter().all(|byte| *byte == 0) => {
            (Header::Unfinished, records(&[]))
        }
        _ => (Header::Broken, records(bytes)),
    }
}

/// The records of a journal, in order.
#[derive(Debug)]
pub(super) struct Records<'a> {
    rest: &'a [u8],
    /// How many bytes may still be summed while looking for a record.
    budget: usize,
}

impl<'a> Iterator for Records<'a> {
    type Item = Next<'a>;

    fn next(&mut self) -> Option<Next<'a>> {
        if self.rest.is_empty() {
            return None;
        }
        let rest = self.rest;
        if let Some((kind, body)) = claimed(rest).and_then(|content| checked(rest, content)) {
            self.rest = &rest[PREFIX_BYTES + 1 + body.len()..];
            return Some(Next::Record(kind, body));
        }
        let end = self.next_whole();
        self.rest = &rest[end..];
        // Only its length may be wrong.
        let content = rest.get(PREFIX_BYTES..end);
        if let Some((kind, body)) = content.and_then(|content| checked(rest, content)) {
            return Some(Next::Record(kind, body));
        }
        Some(if self.rest.is_empty() && is_unfinished(rest) { Next::Unfinished } else { Next::Damaged })
    }
}

impl Records<'_> {
    /// Where behind the beginning the next whole record begins; the end if there is none.
    fn next_whole(&mut self) -> usize {
        for at in 1..self.rest.len().saturating_sub(PREFIX_BYTES) {
            let rest = &self.rest[at..];
            let may_be = |content: &&[u8]| {
                let (kind, body) = (content[0], &content[1..]);
                Kind::of(kind).is_some_and(|kind| kind.may_be(body))
            };
            let Some(content) = claimed(rest).filter(may_be) else { continue };
            let Some(left) = self.budget.checked_sub(content.len()) else { break };
            self.budget = left;
            if checked(rest, content).is_some() {
                return at;
            }
        }
        self.rest.len()
    }
}

/// Kind and body that `bytes` begin with if their length is right; at least the kind.
fn claimed(bytes: &[u8]) -> Option<&[u8]> {
    let length = u32::from_le_bytes(*bytes.first_chunk()?);
    let content = bytes[PREFIX_BYTES.min(bytes.len())..].get(..length as usize)?;
    (!content.is_empty()).then_some(content)
}

/// The record that `bytes` begin with, if this is its kind and body.
fn checked<'a>(bytes: &[u8], content: &'a [u8]) -> Option<(Kind, &'a [u8])> {
    let sum = u32::from_le_bytes(*bytes.get(4..)?.first_chunk()?);
    let (kind, body) = content.split_first()?;
    let kind = Kind::of(*kind)?;
    (crc32fast::hash(content) == sum).then_some((kind, body))
}

/// Whether writing may have been interrupted here: too short, or with room that was never filled.
fn is_unfinished(tail: &[u8]) -> bool {
    claimed(tail).is_none() || tail.last() == Some(&0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const BODIES: [&[u8]; 4] =
        [b"{\"seed\": 1}", b"{}", b"{\"species\": \"daisy\"}", b"{\"strokes\": [], \"seed\": 3}"];

    /// A journal of [`BODIES`] without its header, and where each begins.
    fn journal() -> (Vec<u8>, Vec<usize>) {
        let (mut bytes, mut starts) = (Vec::new(), Vec::new());
        for body in BODIES {
            starts.push(bytes.len());
            append(&mut bytes, Kind::Step, body).unwrap();
        }
        (bytes, starts)
    }

    fn all(bytes: &[u8]) -> Vec<Next<'_>> {
        Records { rest: bytes, budget: bytes.len() * SUMS_PER_BYTE }.collect()
    }

    fn bodies<'a>(items: &[Next<'a>]) -> Vec<&'a [u8]> {
        let body = |item: &Next<'a>| if let Next::Record(_, body) = item { Some(*body) } else { None };
        items.iter().filter_map(body).collect()
    }

    #[test]
    fn a_cut_anywhere_leaves_whole_records() {
        let (bytes, mut starts) = journal();
        starts.push(bytes.len());
        for cut in 0..=bytes.len() {
            let found = all(&bytes[..cut]);
            let whole = starts.iter().filter(|start| **start <= cut).count() - 1;
            assert_eq!(bodies(&found), BODIES[..whole], "cut at {cut}");
            let rest = &found[whole..];
            assert_eq!(rest, if starts.contains(&cut) { &[][..] } else { &[Next::Unfinished] });
        }
    }

    #[test]
    fn a_changed_bit_anywhere_costs_its_own_record_and_no_other() {
        let (bytes, starts) = journal();
        for bit in 0..bytes.len() * 8 {
            let mut changed = bytes.clone();
            changed[bit / 8] ^= 1 << (bit % 8);
            let hit = starts.iter().filter(|start| **start <= bit / 8).count() - 1;
            let is_length = bit / 8 - starts[hit] < 4;
            let found = all(&changed);
            let mut expected = BODIES.to_vec();
            if !is_length {
                expected.remove(hit);
            }
            assert_eq!(bodies(&found), expected, "bit {bit}");
            assert_eq!(found.contains(&Next::Damaged), !is_length, "bit {bit}");
        }
    }

    #[test]
    fn what_file_systems_leave_behind_a_power_cut_is_an_unfinished_record() {
        assert_eq!(all(&[0; 64]), [Next::Unfinished]);
        let (mut bytes, starts) = journal();
        bytes[starts[3] + 12..].fill(0);
        assert_eq!(all(&bytes).last(), Some(&Next::Unfinished));
        assert_eq!(bodies(&all(&bytes)), BODIES[..3]);
    }

    #[test]
    fn bytes_made_to_look_like_records_take_no_long_time() {
        let mut bytes = Vec::new();
        for _ in 0..100_000 {
            bytes.extend_from_slice(&900_000_u32.to_le_bytes());
            bytes.extend_from_slice(b"????P");
        }
        let begun = std::time::Instant::now();
        assert!(bodies(&all(&bytes)).is_empty());
        assert!(begun.elapsed().as_secs() < 10, "{:?}", begun.elapsed());
    }

    #[test]
    fn headers_give_versions_and_what_is_broken_is_searched() {
        let header = |bytes: &[u8]| read(bytes).0;
        assert_eq!(header(HEADER.as_bytes()), Header::Known);
        assert_eq!(header(b"penstemon-journal 1\nxyz"), Header::Known);
        assert_eq!(header(b"penstemon-journal 12\nxyz"), Header::Newer(12));
        for cut in ["", "penstemon-jour"] {
            assert_eq!(header(cut.as_bytes()), Header::Unfinished, "{cut}");
        }
        for broken in ["penstemon-journal 0\n", "something else\n and more"] {
            assert_eq!(header(broken.as_bytes()), Header::Broken, "{broken}");
        }
        let bytes = [&b"penstemon=journal 2\n"[..], &journal().0].concat();
        let (header, records) = read(&bytes);
        assert_eq!(header, Header::Broken);
        assert_eq!(bodies(&records.collect::<Vec<_>>()), BODIES);
    }
}
