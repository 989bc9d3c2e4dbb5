//! Smaller levels of a texture, each drawn from the one above it on the GPU.

use super::gpu::Gpu;
use super::pipeline::{Into, PipelineSpec, entry, texture};
use super::shaders;

/// Format of every texture: its colours are decoded to linear when they are read.
pub(super) const TEXTURE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

/// Fills the levels below the first of a texture.
pub(super) struct MipmapRenderer {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
}

impl MipmapRenderer {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let above =
            texture(wgpu::TextureSampleType::Float { filterable: true }, wgpu::TextureViewDimension::D2);
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("mipmap"),
            entries: &[entry(0, wgpu::ShaderStages::FRAGMENT, above)],
        });
        let pipeline = PipelineSpec {
            label: "mipmap",
            wgsl: shaders::MIPMAP,
            groups: &[&layout],
            buffers: &[],
            topology: wgpu::PrimitiveTopology::TriangleList,
            cull: false,
            fragment: true,
            into: Into::Texture(TEXTURE_FORMAT),
            constants: &[],
        }
        .build(gpu);
        Self { pipeline, layout }
    }

    /// Draws every level of `texture` below the first.
    pub(super) fn fill(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, texture: &wgpu::Texture) {
        let view = |level| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                base_mip_level: level,
                mip_level_count: Some(1),
                ..Default::default()
            })
        };
        for level in 1..texture.mip_level_count() {
            let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("mipmap"),
                layout: &self.layout,
                entries: &[wgpu::BindGroupEntry {
                    binding: 0,
                    resource: wgpu::BindingResource::TextureView(&view(level - 1)),
                }],
            });
            let into = view(level);
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("mipmap"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &into,
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
}
