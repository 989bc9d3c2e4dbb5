//! A block of numbers that vertices and fragments of a pass read, alone in its bind group.

use super::gpu::Gpu;
use super::pipeline::{entry, uniform};
use bytemuck::Pod;
use std::marker::PhantomData;

/// One block of type `T`.
pub(super) struct Uniform<T> {
    buffer: wgpu::Buffer,
    pub(super) layout: wgpu::BindGroupLayout,
    pub(super) group: wgpu::BindGroup,
    of: PhantomData<T>,
}

impl<T: Pod> Uniform<T> {
    /// Room for a block.
    pub(super) fn new(gpu: &Gpu, label: &str) -> Self {
        let both = wgpu::ShaderStages::VERTEX_FRAGMENT;
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(label),
            entries: &[entry(0, both, uniform(size_of::<T>(), false))],
        });
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: size_of::<T>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(label),
            layout: &layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() }],
        });
        Self { buffer, layout, group, of: PhantomData }
    }

    /// What is read from the next submission on.
    pub(super) fn set(&self, gpu: &Gpu, block: &T) {
        gpu.queue.write_buffer(&self.buffer, 0, bytemuck::bytes_of(block));
    }
}
