//! The texture in which the window shows the plant: pictures from another device, put in as pixels.

use super::frame::EguiPainter;
use super::surface::Surface;
use crate::render::ShownPicture;

/// Format of the pictures: already encoded.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// The texture, known to egui.
pub(super) struct PlantTexture {
    texture: wgpu::Texture,
    /// egui's name of it.
    pub(super) id: egui::TextureId,
    /// What it shows.
    pub(super) picture: Option<ShownPicture>,
}

impl PlantTexture {
    /// A clear texture.
    pub(super) fn new(surface: &Surface, painter: &mut EguiPainter) -> Self {
        let texture = make(surface, 1, 1);
        let id = painter.register(surface, &texture.create_view(&Default::default()));
        Self { texture, id, picture: None }
    }

    /// Shows a picture.
    pub(super) fn show(&mut self, surface: &Surface, painter: &mut EguiPainter, picture: ShownPicture) {
        let ShownPicture { width, height, bytes_per_row, ref rows } = picture;
        if (self.texture.width(), self.texture.height()) != (width, height) {
            self.texture = make(surface, width, height);
            painter.replace(surface, self.id, &self.texture.create_view(&Default::default()));
        }
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(bytes_per_row),
            rows_per_image: None,
        };
        surface.queue.write_texture(self.texture.as_image_copy(), rows, layout, self.texture.size());
        self.picture = Some(picture);
    }
}

fn make(surface: &Surface, width: u32, height: u32) -> wgpu::Texture {
    surface.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("plant"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    })
}
