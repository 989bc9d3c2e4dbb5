//! The last step of a live view: a finished picture into the texture that the window shows.
//!
//! User interfaces on a surface without sRGB blend encoded colours that are multiplied by their opacity. So the linear,
//! “seen through” picture is encoded here; a smaller picture is stretched smoothly on the way.

use super::full_screen::FullScreen;
use super::gpu::Gpu;
use super::pipeline::{entry, texture};
use super::shaders;
use super::target::PictureBuffers;

/// Format of what the window shows: already encoded.
pub(super) const SHOWN_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Copies finished pictures.
pub(super) struct PresentRenderer {
    pass: FullScreen,
    sampler: wgpu::Sampler,
}

impl PresentRenderer {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let fragment = wgpu::ShaderStages::FRAGMENT;
        let colour = wgpu::TextureSampleType::Float { filterable: true };
        let reads = [
            entry(0, fragment, texture(colour, wgpu::TextureViewDimension::D2)),
            entry(1, fragment, wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering)),
        ];
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("present"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        Self { pass: FullScreen::new(gpu, "present", shaders::PRESENT, &reads, SHOWN_FORMAT), sampler }
    }

    /// Copies `picture` over all of `shown`.
    pub(super) fn draw(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        picture: &PictureBuffers,
        shown: &wgpu::TextureView,
    ) {
        let picture = wgpu::BindingResource::TextureView(&picture.resolved_view);
        self.pass.draw(gpu, encoder, &[picture, wgpu::BindingResource::Sampler(&self.sampler)], shown);
    }
}
