//! Meshes that plants grow in or around, from the text of OBJ files, and what is wrong with those that cannot be used.

use crate::obj_text::{self, Fault};
use crate::quote;
use glam::Vec3;
use thiserror::Error;

/// Largest OBJ text that is read, bytes.
pub const MAX_BYTES: usize = 256 << 20;

/// Corners and, three indices each, triangles.
type Mesh = (Vec<Vec3>, Vec<[u32; 3]>);

/// A mesh that cannot be used.
#[derive(Debug, Error, PartialEq)]
pub enum MeshError {
    /// Not an OBJ file.
    #[error("{name}: line {line}: not a readable OBJ file: {reason}")]
    Unreadable {
        /// Name of the file.
        name: String,
        /// Line number, from 1.
        line: usize,
        /// Why.
        reason: String,
    },
    /// Nothing in it.
    #[error("{name}: there is no face in it; export it as a mesh of faces")]
    Empty {
        /// Name of the file.
        name: String,
    },
    /// More than anybody needs.
    #[error("{name}: {what} are more than the {most} that it may have; simplify the mesh")]
    Huge {
        /// Name of the file.
        name: String,
        /// What there is too much of.
        what: String,
        /// The limit.
        most: usize,
    },
    /// A corner that is nowhere.
    #[error("{name}: corner {corner} of face {face} {what}")]
    Corner {
        /// Name of the file.
        name: String,
        /// Corner of the face, from 1.
        corner: usize,
        /// The face, from 1, after splitting into triangles.
        face: usize,
        /// What is wrong with it.
        what: &'static str,
    },
    /// A hole.
    #[error(
        "{name}: the mesh is open: {edges} edges have a face on one side only, the first at ({x}, {y}, {z}); close its holes"
    )]
    Open {
        /// Name of the file.
        name: String,
        /// Number of such edges.
        edges: usize,
        /// Where the first begins.
        x: f32,
        /// Where the first begins.
        y: f32,
        /// Where the first begins.
        z: f32,
    },
    /// Inside out, or flat.
    #[error("{name}: the mesh {what}; {remedy}")]
    NoVolume {
        /// Name of the file.
        name: String,
        /// What is wrong.
        what: &'static str,
        /// What to do.
        remedy: &'static str,
    },
}

/// Reads the faces of an OBJ text, cut into triangles; `name` stands for the file in messages.
///
/// # Errors
/// A text that is too long or no OBJ file.
pub(crate) fn read(text: &str, name: &str) -> Result<Mesh, MeshError> {
    if text.len() > MAX_BYTES {
        let what = format!("{} bytes", text.len());
        return Err(MeshError::Huge { name: name.to_owned(), what, most: MAX_BYTES });
    }
    let (meshes, _) = obj_text::read(text.as_bytes()).map_err(|Fault { line, reason }| {
        MeshError::Unreadable { name: name.to_owned(), line, reason: quote::message(&reason) }
    })?;
    let (mut points, mut triangles) = (Vec::new(), Vec::new());
    for mesh in meshes {
        let first = points.len() as u32;
        points.extend(mesh.positions.as_chunks::<3>().0.iter().map(|p| Vec3::from_array(*p)));
        triangles.extend(mesh.indices.as_chunks::<3>().0.iter().map(|t| t.map(|i| first.saturating_add(i))));
    }
    Ok((points, triangles))
}

/// Whether all triangles have three corners that are somewhere, and are neither none nor more than `most`.
///
/// # Errors
/// The first thing that is wrong.
pub(crate) fn check(
    points: &[Vec3],
    triangles: &[[u32; 3]],
    name: &str,
    most: usize,
) -> Result<(), MeshError> {
    let name = || name.to_owned();
    if triangles.is_empty() {
        return Err(MeshError::Empty { name: name() });
    }
    if triangles.len() > most {
        let what = format!("{} triangles", triangles.len());
        return Err(MeshError::Huge { name: name(), what, most });
    }
    for (face, corners) in triangles.iter().enumerate() {
        for (corner, &i) in corners.iter().enumerate() {
            let what = match points.get(i as usize) {
                None => "does not exist",
                Some(p) if !p.is_finite() || p.abs().max_element() > 1e9 => "is no place in space",
                Some(_) => continue,
            };
            return Err(MeshError::Corner { name: name(), corner: corner + 1, face: face + 1, what });
        }
    }
    Ok(())
}
