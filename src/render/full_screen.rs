//! A pass that gives every pixel of a texture its colour: one triangle over all of it (`full_screen.wgsl`), and whatever
//! the fragments read.

use super::gpu::Gpu;
use super::pipeline::{Into, PipelineSpec};

/// Such a pass.
pub(super) struct FullScreen {
    label: &'static str,
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
}

impl FullScreen {
    /// The pass that a module draws into textures of this format.
    pub(super) fn new(
        gpu: &Gpu,
        label: &'static str,
        wgsl: &str,
        reads: &[wgpu::BindGroupLayoutEntry],
        format: wgpu::TextureFormat,
    ) -> Self {
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(label),
            entries: reads,
        });
        let pipeline = PipelineSpec {
            label,
            wgsl,
            groups: &[&layout],
            buffers: &[],
            topology: wgpu::PrimitiveTopology::TriangleList,
            cull: false,
            fragment: true,
            into: Into::Texture(format),
            constants: &[],
        }
        .build(gpu);
        Self { label, pipeline, layout }
    }

    /// Draws over all of `into`; `reads` are bound from 0 on.
    pub(super) fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        reads: &[wgpu::BindingResource<'_>],
        into: &wgpu::TextureView,
    ) {
        let numbered = (0..).zip(reads);
        let entries: Vec<wgpu::BindGroupEntry<'_>> =
            numbered.map(|(binding, r)| wgpu::BindGroupEntry { binding, resource: r.clone() }).collect();
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(self.label),
            layout: &self.layout,
            entries: &entries,
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(self.label),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: into,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
    }
}
