//! One frame of the window: the drawing below, egui above it.
//!
//! Frames are painted into a picture that stays, only where something changed, and copied onto the surface, whose own
//! pictures come and go.
//!
//! egui's pictures are uploaded before the surface is asked for a frame, because a frame may not be had and egui sends
//! each picture only once.

use super::cut_meshes;
use super::damage::Damage;
use super::surface::Surface;
use egui::{ClippedPrimitive, Pos2, Rect, TexturesDelta, pos2, vec2};
use egui_wgpu::ScreenDescriptor;

/// Paints egui's shapes.
pub(super) struct EguiPainter {
    renderer: egui_wgpu::Renderer,
    /// The window as it was painted last; `None` where it must be painted whole.
    picture: Option<wgpu::Texture>,
    /// What egui had on it.
    shown: Vec<ClippedPrimitive>,
    /// Where the picture is still to be painted again.
    due: Damage,
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

/// How much of the window a frame may paint while something there must not wait.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hurry {
    /// What must not wait, points.
    pub(super) around: Rect,
    /// Share of the window for everything else.
    pub(super) share: f32,
}

impl EguiPainter {
    /// A painter for this surface.
    pub(super) fn new(surface: &Surface) -> Self {
        let options = egui_wgpu::RendererOptions::default();
        let renderer = egui_wgpu::Renderer::new(&surface.device, surface.format(), options);
        Self { renderer, picture: None, shown: Vec::new(), due: Damage::default() }
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

    /// Whether something is still to be painted in a place, points.
    pub(super) fn is_due(&self, place: Rect) -> bool {
        self.due.touches(place)
    }

    /// Uploads egui's pictures, then paints what is damaged of the frame and shows it; with a `hurry` so much of it, and
    /// the rest in the frames to come. Where the surface has no frame to give, or `is_lost` says afterwards that the device
    /// is gone, nothing is lost but the frame.
    #[allow(clippy::iter_over_hash_type, reason = "pictures do not depend on each other")]
    pub(super) fn paint(
        &mut self,
        surface: &mut Surface,
        mut frame: EguiFrame,
        damage: Damage,
        hurry: Option<Hurry>,
        below: impl Fn(&mut wgpu::RenderPass<'_>, [u32; 4]),
        is_lost: impl Fn() -> bool,
    ) {
        for (id, deltas) in &frame.textures.set {
            for delta in deltas {
                self.renderer.update_texture(&surface.device, &surface.queue, *id, delta);
            }
        }
        let (width, height) = surface.size();
        let window =
            Rect::from_min_size(Pos2::ZERO, vec2(width as f32, height as f32) / frame.pixels_per_point);
        let is_empty = self.make_room(surface);
        if is_empty {
            self.due.add(window);
        }
        damage.places().iter().for_each(|place| self.due.add(*place));
        self.due.add_pictures(&frame.textures, &frame.primitives);
        self.due.compare(&self.shown, &frame.primitives, window);
        let damage = match hurry.filter(|_| surface.takes_copies() && !is_empty) {
            Some(hurry) => self.due.take(hurry.around, hurry.share * window.area()),
            None => std::mem::take(&mut self.due),
        };
        tracing::debug!("painted share={:.4}", damage.share(window));
        if let Some(target) = surface.acquire() {
            self.draw(surface, &frame, &target, &damage, below);
            if is_lost() {
                Surface::abandon(target);
            } else {
                surface.present(target);
            }
            self.shown = std::mem::take(&mut frame.primitives);
        } else {
            // The damage is forgotten with the frame: the next one is painted whole.
            self.picture = None;
            self.due = Damage::default();
        }
        for id in &frame.textures.free {
            self.renderer.free_texture(id);
        }
        frame.textures.clear();
    }

    /// Makes the picture of the window as large as that is; whether it is a new one.
    fn make_room(&mut self, surface: &Surface) -> bool {
        let (width, height) = surface.size();
        if self.picture.as_ref().is_some_and(|p| (p.width(), p.height()) == (width, height)) {
            return false;
        }
        self.picture = Some(surface.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("window"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: surface.format(),
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        }));
        true
    }

    fn draw(
        &mut self,
        surface: &Surface,
        frame: &EguiFrame,
        target: &wgpu::SurfaceTexture,
        damage: &Damage,
        below: impl Fn(&mut wgpu::RenderPass<'_>, [u32; 4]),
    ) {
        let (width, height) = surface.size();
        let scale = frame.pixels_per_point;
        let screen = ScreenDescriptor { size_in_pixels: [width, height], pixels_per_point: scale };
        // Where the surface takes no copies every frame is painted whole, and on the surface itself.
        let whole = Rect::from_min_size(Pos2::ZERO, vec2(width as f32, height as f32) / scale);
        let kept = self.picture.as_ref().filter(|_| surface.takes_copies());
        let places = if kept.is_some() { damage.places() } else { std::slice::from_ref(&whole) };
        let painted = kept.unwrap_or(&target.texture);
        let view = painted.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = surface.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let size = (width, height);
        let pixels: Vec<[u32; 4]> = places.iter().filter_map(|place| pixels(*place, scale, size)).collect();
        let places: Vec<Rect> = pixels.iter().map(|pixels| points(*pixels, scale)).collect();
        let cut = cut_meshes::within(&frame.primitives, &places);
        let mut commands =
            self.renderer.update_buffers(&surface.device, &surface.queue, &mut encoder, &cut, &screen);
        let load = if kept.is_some() { wgpu::LoadOp::Load } else { wgpu::LoadOp::Clear(wgpu::Color::BLACK) };
        let mut pass = encoder
            .begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("window"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
                })],
                ..Default::default()
            })
            .forget_lifetime();
        for place in pixels {
            let [left, top, wide, high] = place;
            pass.set_viewport(0.0, 0.0, width as f32, height as f32, 0.0, 1.0);
            pass.set_scissor_rect(left, top, wide, high);
            below(&mut pass, place);
        }
        self.renderer.render(&mut pass, &cut, &screen);
        drop(pass);
        if let Some(picture) = kept {
            let (from, onto) = (picture.as_image_copy(), target.texture.as_image_copy());
            encoder.copy_texture_to_texture(from, onto, picture.size());
        }
        commands.push(encoder.finish());
        surface.queue.submit(commands);
    }
}

/// A place's pixels: left, top, width, height; `None` where there are none. Places that are apart have none in common.
fn pixels(place: Rect, scale: f32, (width, height): (u32, u32)) -> Option<[u32; 4]> {
    let side = |at: f32, most: u32| (at * scale).round().clamp(0.0, most as f32) as u32;
    let (left, top) = (side(place.min.x, width), side(place.min.y, height));
    let (right, bottom) = (side(place.max.x, width), side(place.max.y, height));
    (right > left && bottom > top).then(|| [left, top, right - left, bottom - top])
}

/// The points that pixels are: left, top, width, height.
fn points([left, top, wide, high]: [u32; 4], scale: f32) -> Rect {
    let at = |x: u32, y: u32| pos2(x as f32, y as f32) / scale;
    Rect::from_min_max(at(left, top), at(left + wide, top + high))
}
