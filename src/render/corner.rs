//! Corners of triangles as shaders read them.

use crate::model::{Mesh, Vertex};
use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};

/// A corner as `surface.wgsl` and `shadow.wgsl` read it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(super) struct Corner {
    pub(super) world: Vec3,
    normal: Vec3,
    uv: Vec2,
}

impl Corner {
    /// A vertex of a sound mesh.
    pub(super) fn of(mesh: &Mesh, vertex: &Vertex) -> Self {
        Self { world: mesh.points[vertex.point as usize], normal: vertex.normal, uv: vertex.uv }
    }

    /// Whether its place in the picture lies outside, so that the picture must repeat.
    pub(super) fn repeats(&self) -> bool {
        !((-1e-3..=1.001).contains(&self.uv.min_element()) && self.uv.max_element() <= 1.001)
    }
}

/// Layout of a vertex buffer of corners.
pub(super) const CORNER_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Corner>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x2],
};

/// Colour of a corner in the debugging views, encoded red, green, blue, and one unused byte.
pub(super) type Tint = [u8; 4];

/// The corners of a sound mesh.
pub(super) fn corners(mesh: &Mesh) -> impl Iterator<Item = Corner> {
    mesh.vertices.iter().map(|vertex| Corner::of(mesh, vertex))
}
