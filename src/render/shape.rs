//! A shape on the GPU, of which copies are drawn: its corners and triangles once.

use super::corner::{Corner, Tint, corners};
use super::drawn::Drawn;
use super::gpu::Gpu;
use crate::model::Mesh;
use std::ops::Range;
use std::sync::Arc;

/// A shape on the GPU.
#[derive(Clone)]
pub(super) struct ResidentShape {
    mesh: Arc<Mesh>,
    corners: wgpu::Buffer,
    indices: wgpu::Buffer,
    pub(super) tints: wgpu::Buffer,
    tint: Tint,
    /// Whether its picture must repeat.
    pub(super) repeats: bool,
}

impl ResidentShape {
    /// Uploads a shape, in this colour in the debugging views. Returns it with the number of bytes.
    pub(super) fn new(gpu: &Gpu, mesh: &Arc<Mesh>, tint: Tint) -> (Self, u64) {
        let corners: Vec<Corner> = corners(mesh).collect();
        let vertex = |label, bytes| gpu.buffer(label, bytes, wgpu::BufferUsages::VERTEX);
        let shape = Self {
            mesh: mesh.clone(),
            indices: gpu.buffer("shape", bytemuck::cast_slice(&mesh.triangles), wgpu::BufferUsages::INDEX),
            tints: vertex("tints", bytemuck::cast_slice(&vec![tint; corners.len()])),
            tint,
            repeats: corners.iter().any(Corner::repeats),
            corners: vertex("shape", bytemuck::cast_slice(&corners)),
        };
        let buffers = [&shape.corners, &shape.indices, &shape.tints];
        let bytes = buffers.into_iter().map(wgpu::Buffer::size).sum();
        (shape, bytes)
    }

    /// Whether it is this shape in this colour.
    pub(super) fn is(&self, mesh: &Arc<Mesh>, tint: Tint) -> bool {
        self.tint == tint && (Arc::ptr_eq(&self.mesh, mesh) || self.mesh == *mesh)
    }

    /// Where its mesh is in memory, and its colour: while it is kept no other mesh is there.
    pub(super) fn key(&self) -> (usize, Tint) {
        (Arc::as_ptr(&self.mesh) as usize, self.tint)
    }

    /// Copies of it that stand where these rows of a table say.
    pub(super) fn drawn(&self, placements: wgpu::Buffer, copies: Range<u32>) -> Drawn {
        Drawn {
            corners: self.corners.clone(),
            placements,
            indices: self.indices.clone(),
            range: 0..3 * self.mesh.triangles.len() as u32,
            in_view: copies.clone(),
            copies,
        }
    }

    /// The edges of its triangles: indices of their ends, and how many there are.
    pub(super) fn edges(&self, gpu: &Gpu) -> (wgpu::Buffer, u32) {
        let triangles = self.mesh.triangles.iter();
        let pairs: Vec<u32> = triangles.flat_map(|&[a, b, c]| [a, b, b, c, c, a]).collect();
        (gpu.buffer("edges", bytemuck::cast_slice(&pairs), wgpu::BufferUsages::INDEX), pairs.len() as u32)
    }
}
