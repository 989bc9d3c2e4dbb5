//! The text of an OBJ file for the `tobj` crate: geometry only, line by line, screened.
//!
//! Everything but `v`, `vt`, `vn` and `f` is withheld from the parser, which would start a new set of points at each group
//! and material. It names no line, and indices near 2⁶³ would overflow in it, so face indices are screened here and the
//! place of an error is known.
//!
//! Limits: an index must refer to a line above its own, as the format says.

use std::io::{self, BufRead, Read};
use std::path::Path;

/// What is wrong with a line.
#[derive(Debug, PartialEq, Eq)]
pub struct Fault {
    /// Line number, from 1.
    pub line: usize,
    /// What and why.
    pub reason: String,
}

/// What a text that was read to its end says of its faces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Faces {
    /// The last line that was read, from 1; 0 if there is none.
    pub last_line: usize,
    /// How many there are.
    pub count: usize,
    /// Those of which a corner has no point, UV or normal.
    pub without: [usize; 3],
}

/// Reads all geometry, as one mesh where there is any, with polygons cut into fans.
///
/// # Errors
/// A line that is no geometry, or refers to what is not there.
pub fn read(bytes: &[u8]) -> Result<(Vec<tobj::Mesh>, Faces), Fault> {
    let mut elements = Elements::of(bytes);
    let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
    let no_materials = |_: &Path| Ok((Vec::new(), Default::default()));
    match tobj::load_obj_buf(&mut elements, &options, no_materials) {
        Ok((models, _)) => {
            let faces = Faces { last_line: elements.line, ..elements.faces };
            Ok((models.into_iter().map(|model| model.mesh).collect(), faces))
        }
        Err(error) => {
            let line = elements.line;
            Err(elements.fault.take().unwrap_or_else(|| Fault { line, reason: error.to_string() }))
        }
    }
}

/// The lines of an OBJ file that describe geometry, one at a time.
struct Elements<'a> {
    rest: &'a [u8],
    /// What is left of the line being handed out.
    current: &'a [u8],
    line: usize,
    /// How many `v`, `vt` and `vn` lines there were so far.
    counts: [usize; 3],
    faces: Faces,
    fault: Option<Fault>,
}

impl<'a> Elements<'a> {
    fn of(bytes: &'a [u8]) -> Self {
        Self { rest: bytes, current: &[], line: 0, counts: [0; 3], faces: Faces::default(), fault: None }
    }

    fn fault(&self, reason: String) -> Fault {
        Fault { line: self.line, reason }
    }

    /// Moves on to the next line of geometry; leaves `current` empty at the end.
    fn advance(&mut self) -> Result<(), Fault> {
        while !self.rest.is_empty() {
            let end = self.rest.iter().position(|b| *b == b'\n').map_or(self.rest.len(), |i| i + 1);
            let (line, rest) = self.rest.split_at(end);
            self.rest = rest;
            self.line += 1;
            let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
            match words.next() {
                Some(b"v") => self.counts[0] += 1,
                Some(b"vt") => self.counts[1] += 1,
                Some(b"vn") => self.counts[2] += 1,
                Some(b"f") => self.screen_face(words)?,
                _ => continue,
            }
            self.current = line;
            return Ok(());
        }
        Ok(())
    }

    fn screen_face<'w>(&mut self, corners: impl Iterator<Item = &'w [u8]>) -> Result<(), Fault> {
        let mut count = 0;
        let mut lacks = [false; 3];
        for corner in corners {
            let given = self.screen_corner(corner).map_err(|reason| self.fault(reason))?;
            lacks = [0, 1, 2].map(|kind| lacks[kind] || !given[kind]);
            count += 1;
        }
        if count < 3 {
            return Err(self.fault(format!("a face of {count} corners; it needs three")));
        }
        self.faces.count += 1;
        self.faces.without = [0, 1, 2].map(|kind| self.faces.without[kind] + usize::from(lacks[kind]));
        Ok(())
    }

    /// Which of point, UV and normal a corner such as `3/1/2`, `3//2` or `-1` gives.
    fn screen_corner(&self, corner: &[u8]) -> Result<[bool; 3], String> {
        let strange = || format!("`{}` is no corner of a face", String::from_utf8_lossy(corner));
        let text = std::str::from_utf8(corner).map_err(|_| strange())?;
        let mut given = [false; 3];
        for (kind, index) in text.split('/').enumerate() {
            let count = *self.counts.get(kind).ok_or_else(strange)?;
            if index.is_empty() {
                continue;
            }
            let index: i64 = index.parse().map_err(|_| strange())?;
            if index == 0 || index.unsigned_abs() > count as u64 {
                let kind = ["v", "vt", "vn"][kind];
                return Err(format!("index {index} is out of range; there are {count} `{kind}` lines above"));
            }
            given[kind] = true;
        }
        if given[0] { Ok(given) } else { Err(strange()) }
    }
}

impl BufRead for Elements<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        if self.current.is_empty() {
            self.advance().map_err(|fault| {
                self.fault = Some(fault);
                io::Error::other("a fault that is told apart")
            })?;
        }
        Ok(self.current)
    }

    fn consume(&mut self, amount: usize) {
        self.current = &self.current[amount..];
    }
}

impl Read for Elements<'_> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let copied = self.fill_buf()?.read(out)?;
        self.consume(copied);
        Ok(copied)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn fault(text: &str) -> Fault {
        read(text.as_bytes()).unwrap_err()
    }

    #[test]
    fn geometry_of_all_groups_is_one_mesh() {
        let text = "o a\nv 0 0 0\nv 1 0 0\nusemtl x\nv 0 1 0\nv 1 1 0\nf 1 2 3\ng b\nf -3 4 3\n";
        let (meshes, faces) = read(text.as_bytes()).unwrap();
        assert_eq!((meshes.len(), faces), (1, Faces { last_line: 9, count: 2, without: [0, 2, 2] }));
        assert_eq!(meshes[0].indices.len(), 6);
    }

    #[test]
    fn indices_that_no_parser_could_count_are_refused_with_their_line() {
        let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
        for index in [
            "4",
            "0",
            "-4",
            "4294967296",
            "9223372036854775807",
            "-9223372036854775808",
            "1e3",
            "1/1",
            "1//-1",
        ] {
            let fault = fault(&format!("{triangle}f 1 2 {index}\n"));
            assert_eq!(fault.line, 4, "{index}: {fault:?}");
        }
        assert!(fault(&format!("{triangle}f 1 2\n")).reason.contains("three"));
    }

    proptest! {
        #[test]
        fn any_faces_end_in_a_mesh_or_a_fault(
            points in 0usize..5,
            corners in prop::collection::vec(prop_oneof![(-6i64..7).boxed(), any::<i64>().boxed()], 0..12),
            slashes in "[/0-9 -]{0,12}",
        ) {
            let mut text = "v 0 1 2\n".repeat(points) + "f";
            corners.iter().for_each(|corner| text += &format!(" {corner}"));
            text += &slashes;
            let _ = read(text.as_bytes());
        }
    }
}
