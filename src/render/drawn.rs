//! What one call draws: triangles, and where copies of them stand.
//!
//! Every surface is drawn as copies, so that one shader serves all; what is no copy is one that stays where it is
//! ([`alone`]).

use super::gpu::Gpu;
use crate::garden::Place;
use crate::model::Placement;
use bytemuck::{Pod, Zeroable};
use glam::{Mat3, Vec3};
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

impl From<&Place> for PlacementRow {
    fn from(place: &Place) -> Self {
        let Mat3 { x_axis, y_axis, z_axis } = Mat3::from_quat(place.rotation) * place.scale;
        Self { x: x_axis, y: y_axis, z: z_axis, origin: place.at }
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
    /// Rows of the placements, those outside of the picture among them, whose shadows may lie inside.
    pub(super) copies: Range<u32>,
    /// Those of which something may be seen.
    pub(super) in_view: Range<u32>,
}

impl Drawn {
    /// Triangles of the copies of which something may be seen.
    pub(super) fn triangles_in_view(&self) -> u64 {
        self.range.len() as u64 / 3 * self.in_view.len() as u64
    }

    /// Draws what may be seen into a pass whose pipeline and bind groups are set.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.draw_rows(pass, &self.in_view);
    }

    /// Draws everything.
    pub(super) fn draw_all(&self, pass: &mut wgpu::RenderPass<'_>) {
        self.draw_rows(pass, &self.copies);
    }

    fn draw_rows(&self, pass: &mut wgpu::RenderPass<'_>, rows: &Range<u32>) {
        if rows.is_empty() {
            return;
        }
        pass.set_vertex_buffer(0, self.corners.slice(..));
        pass.set_vertex_buffer(1, self.placements.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(self.range.clone(), 0, rows.clone());
    }
}
