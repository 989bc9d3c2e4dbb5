//! Wavefront OBJ: text that every modeller reads.
//!
//! `o` per specimen, `g` per part, positions once per point and shared by the faces around it, so that the file is
//! watertight as it stands; a texture coordinate and a normal per vertex. Metres, y up. Positions and the rest are the
//! shortest decimals that read back as the same single-precision numbers (Ryū), so nothing is lost and nothing padded.
//!
//! Everything is appended to one buffer reserved beforehand: no allocation per line.

use super::error::ExportError;
use super::exporter::{Encoded, Exporter, Takes};
use super::image_files::ImageFiles;
use super::names::word;
use super::scene::Scene;
use super::scene::specimen_name;
use super::{mtl, tint};
use crate::model::{Mesh, Part};

/// Wavefront OBJ with MTL and pictures beside it.
#[derive(Debug)]
pub struct Obj;

impl Exporter for Obj {
    fn extension(&self) -> &'static str {
        "obj"
    }

    fn takes(&self) -> Takes {
        Takes::Triangles
    }

    fn encode(&self, scene: &Scene<'_>) -> Result<Encoded, ExportError> {
        let parts = scene.surfaces()?;
        let tinted = tint::tinted(scene, ImageFiles::of(scene)?);
        let stem = word(&scene.stem);
        let picture_files = mtl::picture_files(&stem, &tinted.pictures);
        let materials = mtl::material_words(scene);
        let mtl_file = format!("{stem}.mtl");
        let mut out = Writer::with_room_for(&parts);
        out.line("# Penstemon: metres, y up", "");
        out.line("mtllib ", &mtl_file);
        let mut specimen = None;
        for part in parts {
            if specimen.replace(part.specimen) != Some(part.specimen) {
                out.line("o ", &specimen_name(part.specimen));
            }
            out.line("g ", &word(&part.name));
            out.vertices(&part.mesh);
            for (material, triangles) in part.material_slots() {
                out.line("usemtl ", &materials[material]);
                out.faces(&part.mesh, &part.mesh.triangles[triangles]);
            }
            out.points += part.mesh.points.len();
            out.vertices += part.mesh.vertices.len();
        }
        let mtl = mtl::encode(scene, &materials, &tinted, &picture_files);
        let mut companions: Vec<_> = picture_files
            .into_iter()
            .zip(tinted.pictures.all.into_iter().map(|picture| picture.bytes))
            .collect();
        companions.push((mtl_file, mtl.into()));
        Ok(Encoded { bytes: out.bytes, companions })
    }
}

/// The text so far, and how many elements it has: OBJ counts over the whole file, from 1.
struct Writer {
    bytes: Vec<u8>,
    points: usize,
    vertices: usize,
}

impl Writer {
    /// Typical lengths of lines with some room to spare; a longer text grows the buffer once or twice.
    fn with_room_for(parts: &[&Part]) -> Self {
        const PER_PART: usize = 64;
        const PER_POINT: usize = 2 + 3 * 13;
        const PER_VERTEX: usize = 3 + 2 * 12 + 3 + 3 * 13;
        let (mut points, mut vertices, mut triangles) = (0, 0, 0);
        for part in parts {
            points += part.mesh.points.len();
            vertices += part.mesh.vertices.len();
            triangles += part.mesh.triangles.len();
        }
        let digits = vertices.max(1).ilog10() as usize + 2;
        let room = 128 + PER_PART * parts.len() + PER_POINT * points + PER_VERTEX * vertices;
        Self { bytes: Vec::with_capacity(room + (2 + 9 * digits) * triangles), points: 0, vertices: 0 }
    }

    fn line(&mut self, keyword: &str, rest: &str) {
        self.bytes.extend_from_slice(keyword.as_bytes());
        self.bytes.extend_from_slice(rest.as_bytes());
        self.bytes.push(b'\n');
    }

    fn vertices(&mut self, mesh: &Mesh) {
        for point in &mesh.points {
            self.floats(b"v", point.to_array());
        }
        for vertex in &mesh.vertices {
            self.floats(b"vt", vertex.uv.to_array());
        }
        for vertex in &mesh.vertices {
            self.floats(b"vn", vertex.normal.to_array());
        }
    }

    /// Faces of a mesh whose points and vertices were the last to be written.
    fn faces(&mut self, mesh: &Mesh, triangles: &[[u32; 3]]) {
        for triangle in triangles {
            self.bytes.push(b'f');
            for &v in triangle {
                self.corner(
                    self.points + 1 + mesh.vertices[v as usize].point as usize,
                    self.vertices + 1 + v as usize,
                );
            }
            self.bytes.push(b'\n');
        }
    }

    fn floats<const N: usize>(&mut self, keyword: &[u8], values: [f32; N]) {
        let mut digits = ryu::Buffer::new();
        self.bytes.extend_from_slice(keyword);
        for value in values {
            self.bytes.push(b' ');
            // All numbers of a scene are finite.
            let text = digits.format_finite(value);
            self.bytes.extend_from_slice(text.strip_suffix(".0").unwrap_or(text).as_bytes());
        }
        self.bytes.push(b'\n');
    }

    /// ` point/uv/normal`; UV and normal are numbered alike.
    fn corner(&mut self, point: usize, vertex: usize) {
        let mut digits = itoa::Buffer::new();
        self.bytes.push(b' ');
        self.bytes.extend_from_slice(digits.format(point).as_bytes());
        let vertex = digits.format(vertex).as_bytes();
        self.bytes.push(b'/');
        self.bytes.extend_from_slice(vertex);
        self.bytes.push(b'/');
        self.bytes.extend_from_slice(vertex);
    }
}
