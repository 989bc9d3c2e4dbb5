//! The frame on the graphics card: drawing, plant and panels.
//!
//! Everything here can be made again from the editor: that is how a lost device is survived. The drawing's strokes are
//! kept in step by what changed, the growing one sample by sample as it comes. The plant's pictures are painted elsewhere
//! and shown when they come; nothing here waits for one.

use super::canvas::Rect as CanvasRect;
use super::damage::Damage;
use super::editor::Editor;
use super::frame::{EguiFrame, EguiPainter, Hurry};
use super::plant_painter::{Painted, PlantPainter, Scene};
use super::plant_texture::PlantTexture;
use super::sheet::{self, Sheet};
use super::surface::Surface;
use super::theme::Palette;
use crate::render::canvas::{CanvasLayer, CanvasView, InkChange};
use crate::render::{Gpu, RenderError, decode};
use anyhow::Context as _;
use egui::Color32;
use glam::{Affine2, DAffine2, DVec2, Vec2};
use std::sync::Arc;
use winit::dpi::PhysicalSize;
use winit::event_loop::ActiveEventLoop;
use winit::window::Window;

/// How far a line may reach beyond its width, pixels.
const EDGE_PX: f32 = 3.0;

/// Share of the window that a frame paints beside growing ink where the processor paints: a few milliseconds of its work.
const SHARE_BESIDE_INK: f32 = 0.06;
/// How far from the pen ink is new since the last frame, at most, points.
const PEN_REACH: f32 = 64.0;

/// Everything on the graphics card.
pub(super) struct Graphics {
    surface: Surface,
    gpu: Gpu,
    painter: EguiPainter,
    canvas: CanvasLayer,
    sheet: Sheet,
    plant_painter: PlantPainter,
    plant: PlantTexture,
    /// What of the picture under the drawing is on the card.
    reference_version: u64,
    reference: Option<u64>,
    /// What of the canvas the last frame showed: where it lay, and which picture was under it.
    seen: Option<(CanvasView, u64)>,
    /// What the next frame must paint again, beside what egui changes.
    damage: Damage,
}

impl Graphics {
    /// Opens the best adapter for a window.
    ///
    /// # Errors
    /// No adapter that can draw on the window, with the package to install; or the driver's own failure.
    pub(super) fn open(event_loop: &dyn ActiveEventLoop, window: &Arc<dyn Window>) -> anyhow::Result<Self> {
        // Its device opens while this one does.
        let proxy = event_loop.create_proxy();
        let plant_painter =
            PlantPainter::start(move || proxy.wake_up()).context("no thread for the plant's pictures")?;
        let surface = Surface::open(event_loop, Arc::clone(window)).context("the window cannot be drawn")?;
        let gpu = Gpu::from_parts(surface.device.clone(), surface.queue.clone(), &surface.info);
        let canvas = CanvasLayer::new(&gpu, surface.format())?;
        let mut painter = EguiPainter::new(&surface);
        let plant = PlantTexture::new(&surface, &mut painter);
        Ok(Self {
            surface,
            gpu,
            painter,
            canvas,
            sheet: Sheet::default(),
            plant_painter,
            plant,
            reference_version: 0,
            reference: None,
            seen: None,
            damage: Damage::default(),
        })
    }

    /// The adapter's name.
    pub(super) fn adapter(&self) -> &str {
        self.gpu.adapter()
    }

    /// Whether a device is gone and everything must be made again.
    pub(super) fn is_lost(&self) -> bool {
        self.gpu.is_lost() || self.plant_painter.is_lost()
    }

    /// Whether a picture of the plant is still to come.
    pub(super) fn is_painting(&self) -> bool {
        self.plant_painter.is_busy()
    }

    /// The window's size in pixels.
    pub(super) fn size(&self) -> (u32, u32) {
        self.surface.size()
    }

    /// Follows the window's size.
    pub(super) fn resize(&mut self, size: PhysicalSize<u32>) {
        self.surface.resize(size);
    }

    /// The texture with the plant's picture.
    pub(super) fn plant_texture(&self) -> egui::TextureId {
        self.plant.id
    }

    /// Puts the newest samples of the growing stroke on the canvas: with the sample that made them.
    pub(super) fn grow_stroke(&mut self, editor: &Editor) {
        self.sheet.grow(&mut self.canvas.ink, editor);
    }

    /// Draws a frame: what egui laid out, over the drawing; the plant first, into its texture.
    pub(super) fn draw(&mut self, egui: &egui::Context, mut output: egui::FullOutput, editor: &mut Editor) {
        let drawn = self.draw_canvas(editor).err();
        for failure in self.show_plant(editor).into_iter().chain(drawn) {
            // A lost device is not reported: all is drawn again on the next one.
            if !self.is_lost() {
                editor.notify_render_failure(&failure);
            }
        }
        if self.is_lost() {
            output.textures_delta.clear();
            return;
        }
        let frame = EguiFrame {
            primitives: egui.tessellate(output.shapes, output.pixels_per_point),
            textures: output.textures_delta,
            pixels_per_point: output.pixels_per_point,
        };
        let canvas_area = editor.layout().canvas_px();
        let (canvas, size) = (&self.canvas, self.surface.size());
        let drawing = |pass: &mut wgpu::RenderPass<'_>, place: [u32; 4]| {
            canvas.paint_paper(pass);
            if let Some([x, y, width, height]) = scissor(canvas_area, place, size) {
                pass.set_scissor_rect(x, y, width, height);
                canvas.paint_drawing(pass, [x, y, width, height]);
            }
        };
        let damage = std::mem::take(&mut self.damage);
        let hurry = self.hurry(editor);
        self.painter.paint(&mut self.surface, frame, damage, hurry, drawing, || self.gpu.is_lost());
    }

    /// Where ink grows while the processor paints: large places then wait for it, over several frames.
    fn hurry(&self, editor: &Editor) -> Option<Hurry> {
        let pen = editor.canvas.growing().filter(|_| self.gpu.is_software())?.points().last()?;
        let layout = editor.layout();
        let at = editor.canvas.view().window_from_canvas().transform_point2(pen.position.as_dvec2())
            / layout.pixels_per_point();
        let around = egui::Rect::from_center_size(
            egui::pos2(at.x as f32, at.y as f32),
            egui::Vec2::splat(2.0 * PEN_REACH),
        );
        Some(Hurry { around: around.intersect(layout.canvas), share: SHARE_BESIDE_INK })
    }

    /// Whether some of the last frame is still to be painted.
    pub(super) fn is_unfinished(&self) -> bool {
        self.painter.is_due(egui::Rect::EVERYTHING)
    }

    /// Shows the newest picture of the plant, and requests the next where that would be another.
    fn show_plant(&mut self, editor: &mut Editor) -> Option<RenderError> {
        // A picture that is still being painted on the window is not taken away from it.
        let next = (!self.painter.is_due(editor.layout().plant)).then(|| self.plant_painter.take()).flatten();
        let Painted { picture, failure } = next.unwrap_or_default();
        if let Some(picture) = picture {
            self.plant.show(&self.surface, &mut self.painter, picture);
            self.damage.add(editor.layout().plant);
        }
        let area = editor.layout().plant;
        let scale = editor.layout().pixels_per_point() as f32;
        let limit = self.gpu.largest_side() as f32;
        let side = |points: f32| (points * scale).round().clamp(0.0, limit) as u32;
        let size = if area.is_finite() { (side(area.width()), side(area.height())) } else { (0, 0) };
        if size.0 > 0 && size.1 > 0 {
            let (camera, look) = (editor.plant.camera(), editor.plant_look());
            let scene = Scene { size, camera, look, plant: editor.versions().plant };
            self.plant_painter.request(scene, editor.subject());
        }
        editor.plant.awaits_picture = self.plant_painter.is_busy();
        if let Some(picture) = &self.plant.picture
            && editor.plant.wants_copy
            && !editor.plant.awaits_picture
        {
            editor.plant.wants_copy = false;
            let size = [picture.width as usize, picture.height as usize];
            let picture = picture.picture();
            editor.copy_picture(egui::ColorImage::from_rgba_unmultiplied(size, picture.pixels()));
        }
        failure
    }

    fn draw_canvas(&mut self, editor: &Editor) -> Result<(), RenderError> {
        self.sheet.follow(&mut self.canvas.ink, editor);
        if self.reference_version != editor.versions().reference {
            self.reference_version = editor.versions().reference;
            self.sync_reference(editor)?;
        }
        let palette = Palette::of(editor.theme());
        let rgb = |c: Color32| [c.r(), c.g(), c.b()];
        let view = CanvasView {
            pixel_from_canvas: narrow(editor.canvas.view().window_from_canvas()),
            framebuffer: self.surface.size(),
            paper: rgb(palette.paper),
            surround: rgb(palette.paper),
            sheet: None,
            line_scale: editor.line_scale(sheet::LINE_WIDTH),
        };
        self.note_damage(editor, view);
        self.canvas.prepare(&self.gpu, &view).map(drop)
    }

    /// Notes where the canvas looks different than in the last frame.
    fn note_damage(&mut self, editor: &Editor, view: CanvasView) {
        let (canvas, scale) = (editor.layout().canvas, editor.layout().pixels_per_point() as f32);
        let change = self.canvas.ink.take_change();
        let seen = (view, editor.versions().reference);
        if self.seen.replace(seen) != Some(seen) {
            return self.damage.add(canvas);
        }
        match change {
            InkChange::Nowhere => {}
            InkChange::Anywhere => self.damage.add(canvas),
            InkChange::Within(low, high) => {
                let corners = [low, Vec2::new(high.x, low.y), high, Vec2::new(low.x, high.y)];
                let corners = corners.map(|corner| {
                    let at = view.pixel_from_canvas.transform_point2(corner) / scale;
                    egui::pos2(at.x, at.y)
                });
                // Lines are drawn wider than they are where the view makes them thin, and edges smoothly.
                let zoom = view.pixel_from_canvas.matrix2.x_axis.length();
                let widened = 0.5 * sheet::LINE_WIDTH * (view.line_scale - 1.0).max(0.0) * zoom;
                let place = egui::Rect::from_points(&corners).expand((EDGE_PX + widened) / scale);
                self.damage.add(place.intersect(canvas));
            }
        }
    }

    fn sync_reference(&mut self, editor: &Editor) -> Result<(), RenderError> {
        let reference = editor.sketch().reference.as_ref().filter(|r| r.visible);
        let hash = reference.map(|r| r.picture.hash());
        if hash != self.reference {
            self.reference = hash;
            let picture = reference.map(|r| decode::decode(r.picture.bytes())).transpose();
            let picture = picture.map_err(|reason| RenderError::Texture {
                name: "the picture under the drawing".into(),
                reason: reason.to_string(),
            })?;
            self.canvas.set_reference(&self.gpu, picture.as_ref())?;
        }
        if let Some(r) = reference {
            let turn = Affine2::from_angle(r.rotation_deg.to_radians());
            let canvas_from_unit = Affine2::from_translation(r.center)
                * turn
                * Affine2::from_scale(Vec2::new(r.width, r.height()))
                * Affine2::from_translation(Vec2::splat(-0.5));
            self.canvas.place_reference(canvas_from_unit, r.opacity);
        }
        Ok(())
    }
}

/// The part of a rectangle that lies in a place on the surface, whole pixels: left, top, width, height; `None` where there
/// is none.
fn scissor(area: CanvasRect, [x, y, wide, high]: [u32; 4], (width, height): (u32, u32)) -> Option<[u32; 4]> {
    let most = DVec2::new(width.into(), height.into());
    let (low, high_corner) =
        (DVec2::new(x.into(), y.into()), DVec2::new((x + wide).into(), (y + high).into()));
    let low = area.min.round().max(low).clamp(DVec2::ZERO, most);
    let high = area.max.round().min(high_corner).clamp(DVec2::ZERO, most);
    let size = (high - low).max(DVec2::ZERO).as_uvec2();
    (size.x > 0 && size.y > 0).then_some([low.x as u32, low.y as u32, size.x, size.y])
}

fn narrow(m: DAffine2) -> Affine2 {
    Affine2::from_cols(m.x_axis.as_vec2(), m.y_axis.as_vec2(), m.translation.as_vec2())
}
