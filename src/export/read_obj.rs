//! OBJ back to a mesh, by the `tobj` crate.
//!
//! The judge wants the file's own idea of which corners are one point, across groups and materials, so everything but
//! `v`, `vt`, `vn` and `f` is withheld from the parser, which would start a new set of points at each. What it is given
//! comes line by line through [`Elements`], which thereby knows the place of an error, and screens face indices first:
//! the parser names no line, and indices near 2⁶³ would overflow in it.
//!
//! Limits: an index must refer to a line above its own, as the format says; polygons are cut into fans.

use super::read::{Malformed, Surface};
use crate::model::quality::Attributes;
use crate::model::{Mesh, Vertex};
use glam::{Vec2, Vec3};
use std::io::{self, BufRead, Read};
use std::path::Path;

/// The whole file as one surface.
pub(super) fn surfaces(bytes: &[u8]) -> Result<Vec<Surface>, Malformed> {
    let mut elements = Elements::of(bytes);
    let options = tobj::LoadOptions { triangulate: true, ..Default::default() };
    let no_materials = |_: &Path| Ok((Vec::new(), Default::default()));
    let (models, _) = tobj::load_obj_buf(&mut elements, &options, no_materials).map_err(|error| {
        let place = elements.place();
        elements.fault.take().unwrap_or_else(|| Malformed::new(place, error.to_string()))
    })?;
    if elements.faces == 0 {
        return Err(Malformed::new(elements.place(), "the file ends without a face"));
    }
    let has = Attributes { normals: elements.faces_without[2] == 0, uvs: elements.faces_without[1] == 0 };
    Ok(models.into_iter().map(|model| converted(model.mesh, has)).collect())
}

/// One vertex per corner: a face's corners take their point, UV and normal from lists of their own.
fn converted(read: tobj::Mesh, has: Attributes) -> Surface {
    let points = read.positions.chunks_exact(3).map(Vec3::from_slice).collect();
    let uv = |corner: usize| {
        let index = *read.texcoord_indices.get(corner)? as usize;
        read.texcoords.chunks_exact(2).nth(index).map(Vec2::from_slice)
    };
    let normal = |corner: usize| {
        let index = *read.normal_indices.get(corner)? as usize;
        read.normals.chunks_exact(3).nth(index).map(Vec3::from_slice)
    };
    let vertex = |(corner, &point): (usize, &u32)| Vertex {
        point,
        normal: normal(corner).unwrap_or_default(),
        uv: uv(corner).unwrap_or_default(),
    };
    let vertices = read.indices.iter().enumerate().map(vertex).collect();
    let triangles = (0..read.indices.len() as u32 / 3).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    Surface { name: String::new(), mesh: Mesh { points, vertices, triangles, ..Mesh::default() }, has }
}

/// The lines of an OBJ file that describe geometry, one at a time.
struct Elements<'a> {
    rest: &'a [u8],
    /// What is left of the line being handed out.
    current: &'a [u8],
    line: usize,
    /// How many `v`, `vt` and `vn` lines there were so far.
    counts: [usize; 3],
    faces: usize,
    /// Faces of which a corner has no such element.
    faces_without: [usize; 3],
    fault: Option<Malformed>,
}

impl<'a> Elements<'a> {
    fn of(bytes: &'a [u8]) -> Self {
        Self {
            rest: bytes,
            current: &[],
            line: 0,
            counts: [0; 3],
            faces: 0,
            faces_without: [0; 3],
            fault: None,
        }
    }

    fn place(&self) -> String {
        format!("line {}", self.line)
    }

    /// Moves on to the next line of geometry; leaves `current` empty at the end.
    fn advance(&mut self) -> Result<(), Malformed> {
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

    fn screen_face<'w>(&mut self, corners: impl Iterator<Item = &'w [u8]>) -> Result<(), Malformed> {
        let mut count = 0;
        let mut lacks = [false; 3];
        for corner in corners {
            let given = self.screen_corner(corner).map_err(|reason| Malformed::new(self.place(), reason))?;
            lacks = [0, 1, 2].map(|kind| lacks[kind] || !given[kind]);
            count += 1;
        }
        if count < 3 {
            return Err(Malformed::new(self.place(), format!("a face of {count} corners; it needs three")));
        }
        self.faces += 1;
        self.faces_without = [0, 1, 2].map(|kind| self.faces_without[kind] + usize::from(lacks[kind]));
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
