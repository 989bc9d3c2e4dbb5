//! Pictures of the interface, drawn by wgpu without a window.

use super::stage::Stage;
use egui_kittest::{Harness, TestRenderer};
use std::cell::RefCell;
use std::path::Path;
use std::rc::Rc;

/// Draws what a harness shows.
pub(super) struct Painter {
    device: wgpu::Device,
    queue: wgpu::Queue,
    renderer: egui_wgpu::Renderer,
}

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

impl Painter {
    /// Opens any adapter.
    pub(super) fn new() -> Self {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let adapter =
            pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default())).unwrap();
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            required_limits: wgpu::Limits::downlevel_defaults().using_resolution(adapter.limits()),
            ..Default::default()
        }))
        .unwrap();
        let renderer = egui_wgpu::Renderer::new(&device, FORMAT, egui_wgpu::RendererOptions::default());
        Self { device, queue, renderer }
    }

    /// What the harness shows over a ground colour, as RGBA.
    pub(super) fn draw(
        &mut self,
        harness: &Harness<'_, Stage>,
        ground: egui::Color32,
    ) -> ([u32; 2], Vec<u8>) {
        let scale = harness.ctx.pixels_per_point();
        let logical = harness.ctx.content_rect().size();
        let size = [logical.x, logical.y].map(|side| (side * scale).round() as u32);
        let primitives = harness.ctx.tessellate(harness.output().shapes.clone(), scale);
        let screen = egui_wgpu::ScreenDescriptor { size_in_pixels: size, pixels_per_point: scale };
        let extent = wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 };
        let texture = self.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: extent,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let view = texture.create_view(&Default::default());
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let mut commands =
            self.renderer.update_buffers(&self.device, &self.queue, &mut encoder, &primitives, &screen);
        let [r, g, b, _] = ground.to_array().map(|c| f64::from(c) / 255.0);
        let clear = wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a: 1.0 });
        let attachment = wgpu::RenderPassColorAttachment {
            view: &view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: clear, store: wgpu::StoreOp::Store },
        };
        let pass =
            wgpu::RenderPassDescriptor { color_attachments: &[Some(attachment)], ..Default::default() };
        let mut pass = encoder.begin_render_pass(&pass).forget_lifetime();
        self.renderer.render(&mut pass, &primitives, &screen);
        drop(pass);
        let row = (size[0] * 4).next_multiple_of(256);
        let readback = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(row * size[1]),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let layout =
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
        let into = wgpu::TexelCopyBufferInfo { buffer: &readback, layout };
        encoder.copy_texture_to_buffer(texture.as_image_copy(), into, extent);
        commands.push(encoder.finish());
        self.queue.submit(commands);
        readback.map_async(wgpu::MapMode::Read, .., |_| ());
        self.device.poll(wgpu::PollType::wait_indefinitely()).unwrap();
        let mapped = readback.get_mapped_range(..).unwrap();
        let rows = mapped.chunks(row as usize).map(|line| &line[..size[0] as usize * 4]);
        (size, rows.flatten().copied().collect())
    }
}

/// Hands the textures of a harness to a painter.
pub(super) struct Textures(pub(super) Rc<RefCell<Painter>>);

impl TestRenderer for Textures {
    #[allow(clippy::iter_over_hash_type, reason = "textures are independent of each other")]
    fn handle_delta(&mut self, delta: &mut egui::TexturesDelta) {
        let Painter { device, queue, renderer } = &mut *self.0.borrow_mut();
        for (id, changes) in &delta.set {
            for change in changes {
                renderer.update_texture(device, queue, *id, change);
            }
        }
        delta.clear();
    }
}

/// Writes a picture as PNG.
pub(super) fn write(path: &Path, size: [u32; 2], pixels: &[u8]) {
    let file = std::io::BufWriter::new(std::fs::File::create(path).unwrap());
    let mut encoder = png::Encoder::new(file, size[0], size[1]);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header().unwrap().write_image_data(pixels).unwrap();
}
