//! Smaller levels of a texture, each drawn from the one above it on the GPU.

use super::full_screen::FullScreen;
use super::gpu::Gpu;
use super::pipeline::{entry, texture};
use super::shaders;

/// Format of every texture: its colours are decoded to linear when they are read.
pub(super) const TEXTURE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

/// Fills the levels below the first of a texture.
pub(super) struct MipmapRenderer(FullScreen);

impl MipmapRenderer {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let above =
            texture(wgpu::TextureSampleType::Float { filterable: true }, wgpu::TextureViewDimension::D2);
        let reads = [entry(0, wgpu::ShaderStages::FRAGMENT, above)];
        Self(FullScreen::new(gpu, "mipmap", shaders::MIPMAP, &reads, TEXTURE_FORMAT))
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
            let above = view(level - 1);
            self.0.draw(gpu, encoder, &[wgpu::BindingResource::TextureView(&above)], &view(level));
        }
    }
}
