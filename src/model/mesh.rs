//! An indexed triangle mesh that remembers which vertices are one point.
//!
//! A renderer needs a vertex for each combination of position, normal and UV; a judge of watertightness needs to know
//! that two such vertices along a seam are the same point. So positions are kept once ([`Mesh::points`]) and vertices
//! refer to them. OBJ writes exactly this; GLB expands it.

use glam::{Vec2, Vec3};

/// A corner: a point with the normal and UV that it has on one side of a seam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Index into [`Mesh::points`].
    pub point: u32,
    /// Unit normal.
    pub normal: Vec3,
    /// Texture coordinates, u right, v up: (0, 0) is the picture's lower left corner.
    pub uv: Vec2,
}

/// A triangle surface in metres.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Positions, each once.
    pub points: Vec<Vec3>,
    /// Corners.
    pub vertices: Vec<Vertex>,
    /// Indices into `vertices`, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// The point indices of a triangle.
    pub fn point_triangle(&self, triangle: [u32; 3]) -> [u32; 3] {
        triangle.map(|v| self.vertices[v as usize].point)
    }

    /// The corner positions of a triangle.
    pub fn corners(&self, triangle: [u32; 3]) -> [Vec3; 3] {
        self.point_triangle(triangle).map(|p| self.points[p as usize])
    }
}
