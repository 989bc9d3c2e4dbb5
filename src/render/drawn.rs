//! What one call draws: triangles, and where copies of them stand.
//!
//! Every surface is drawn as copies, so that one shader serves all; what is no copy is one that stays where it is
//! ([`alone`]).

use super::gpu::Gpu;
use crate::model::Placement;
use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use std::ops::Range;

/// `Placement` in `placement.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(super) struct PlacementRow {
    x: Vec3,
    y: Vec3,
    z: Vec3,
    origin: Vec3,
}

impl From<&Placement> for PlacementRow {
    fn from(placement: &Placement) -> Self {
        let world_from_shape = placement.world_from_shape();
        let [x, y, z] = [world_from_shape.x_axis, world_from_shape.y_axis, world_from_shape.z_axis];
        Self { x, y, z, origin: placement.base }
    }
}

/// Layout of a vertex buffer of placements.
pub(super) const PLACEMENT_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<PlacementRow>() as u64,
    step_mode: wgpu::VertexStepMode::Instance,
    attributes: &wgpu::vertex_attr_array![4 => Float32x3, 5 => Float32x3, 6 => Float32x3, 7 => Float32x3],
};

/// The table of one copy that stays where it is.
pub(super) fn alone(gpu: &Gpu) -> wgpu::Buffer {
    let row = PlacementRow { x: Vec3::X, y: Vec3::Y, z: Vec3::Z, origin: Vec3::ZERO };
    gpu.buffer("placement", bytemuck::bytes_of(&row), wgpu::BufferUsages::VERTEX)
}

/// What one call draws: triangles, and how often.
#[derive(Clone)]
pub(super) struct Drawn {
    pub(super) corners: wgpu::Buffer,
    pub(super) placements: wgpu::Buffer,
    pub(super) indices: wgpu::Buffer,
    pub(super) range: Range<u32>,
    pub(super) copies: u32,
}

impl Drawn {
    /// Draws into a pass whose pipeline and bind groups are set.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.corners.slice(..));
        pass.set_vertex_buffer(1, self.placements.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(self.range.clone(), 0, 0..self.copies);
    }
}
