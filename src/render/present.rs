//! The last step of a live view: a finished picture into the texture that the window shows.
//!
//! User interfaces on a surface without sRGB blend encoded colours that are multiplied by their opacity. So the linear,
//! “seen through” picture is encoded here; a smaller picture is stretched smoothly on the way.

use super::gpu::Gpu;
use super::pipeline::{Into, PipelineSpec, entry, texture};
use super::shaders;
use super::target::PictureBuffers;

/// Format of what the window shows: already encoded.
pub(super) const SHOWN_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Copies finished pictures.
pub(super) struct PresentRenderer {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
}

impl PresentRenderer {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let fragment = wgpu::ShaderStages::FRAGMENT;
        let colour = wgpu::TextureSampleType::Float { filterable: true };
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("present"),
            entries: &[
                entry(0, fragment, texture(colour, wgpu::TextureViewDimension::D2)),
                entry(1, fragment, wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering)),
            ],
        });
        let pipeline = PipelineSpec {
            label: "present",
            wgsl: shaders::PRESENT,
            groups: &[&layout],
            buffers: &[],
            topology: wgpu::PrimitiveTopology::TriangleList,
            cull: false,
            fragment: true,
            into: Into::Texture(SHOWN_FORMAT),
            constants: &[],
        }
        .build(gpu);
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("present"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        Self { pipeline, layout, sampler }
    }

    /// Copies `picture` over all of `shown`.
    pub(super) fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        picture: &PictureBuffers,
        shown: &wgpu::TextureView,
    ) {
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("present"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry {
                    binding: 0,
                    resource: wgpu::BindingResource::TextureView(&picture.resolved_view),
                },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(&self.sampler) },
            ],
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("present"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: shown,
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
