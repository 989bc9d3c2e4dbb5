//! One frame of the window: the drawing below, egui above it, in one pass over the surface.
//!
//! egui's pictures are uploaded before the surface is asked for a frame, because a frame may not be had and egui sends
//! each picture only once.

use super::surface::Surface;
use egui::{ClippedPrimitive, TexturesDelta};
use egui_wgpu::ScreenDescriptor;

/// Paints egui's shapes.
pub(super) struct EguiPainter {
    renderer: egui_wgpu::Renderer,
}

/// What one run of egui wants on the screen.
pub(super) struct EguiFrame {
    /// Tessellated shapes.
    pub(super) primitives: Vec<ClippedPrimitive>,
    /// Pictures to upload and to forget.
    pub(super) textures: TexturesDelta,
    /// Pixels per point it was laid out for.
    pub(super) pixels_per_point: f32,
}

impl EguiPainter {
    /// A painter for this surface.
    pub(super) fn new(surface: &Surface) -> Self {
        let options = egui_wgpu::RendererOptions::default();
        Self { renderer: egui_wgpu::Renderer::new(&surface.device, surface.format(), options) }
    }

    /// Makes a texture of ours known to egui.
    pub(super) fn register(&mut self, surface: &Surface, view: &wgpu::TextureView) -> egui::TextureId {
        self.renderer.register_native_texture(&surface.device, view, wgpu::FilterMode::Linear)
    }

    /// Lets a known texture show another view, after a resize.
    pub(super) fn replace(&mut self, surface: &Surface, id: egui::TextureId, view: &wgpu::TextureView) {
        let filter = wgpu::FilterMode::Linear;
        self.renderer.update_egui_texture_from_wgpu_texture(&surface.device, view, filter, id);
    }

    /// Uploads egui's pictures, then paints `below` and the shapes on the surface and shows the frame. Where the
    /// surface has no frame to give, or `is_lost` says afterwards that the device is gone, nothing is lost but the frame.
    #[allow(clippy::iter_over_hash_type, reason = "pictures do not depend on each other")]
    pub(super) fn paint(
        &mut self,
        surface: &mut Surface,
        mut frame: EguiFrame,
        clear: wgpu::Color,
        below: impl FnOnce(&mut wgpu::RenderPass<'_>),
        is_lost: impl Fn() -> bool,
    ) {
        for (id, deltas) in &frame.textures.set {
            for delta in deltas {
                self.renderer.update_texture(&surface.device, &surface.queue, *id, delta);
            }
        }
        if let Some(target) = surface.acquire() {
            self.draw(surface, &frame, &target, clear, below);
            if is_lost() {
                Surface::abandon(target);
            } else {
                surface.present(target);
            }
        }
        for id in &frame.textures.free {
            self.renderer.free_texture(id);
        }
        frame.textures.clear();
    }

    fn draw(
        &mut self,
        surface: &Surface,
        frame: &EguiFrame,
        target: &wgpu::SurfaceTexture,
        clear: wgpu::Color,
        below: impl FnOnce(&mut wgpu::RenderPass<'_>),
    ) {
        let (width, height) = surface.size();
        let screen =
            ScreenDescriptor { size_in_pixels: [width, height], pixels_per_point: frame.pixels_per_point };
        let view = target.texture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = surface.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut commands = self.renderer.update_buffers(
            &surface.device,
            &surface.queue,
            &mut encoder,
            &frame.primitives,
            &screen,
        );
        let mut pass = encoder
            .begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("window"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations { load: wgpu::LoadOp::Clear(clear), store: wgpu::StoreOp::Store },
                })],
                ..Default::default()
            })
            .forget_lifetime();
        below(&mut pass);
        // What was drawn below may have narrowed both.
        pass.set_viewport(0.0, 0.0, width as f32, height as f32, 0.0, 1.0);
        pass.set_scissor_rect(0, 0, width, height);
        self.renderer.render(&mut pass, &frame.primitives, &screen);
        drop(pass);
        commands.push(encoder.finish());
        surface.queue.submit(commands);
    }
}
