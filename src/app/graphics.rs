//! The frame on the graphics card: drawing, plant and panels.
//!
//! Everything here can be made again from the editor: that is how a lost device is survived. The drawing's strokes are
//! kept in step by what changed, the growing one sample by sample as it comes.

use super::canvas::Rect as CanvasRect;
use super::editor::{Editor, Versions};
use super::frame::{EguiFrame, EguiPainter};
use super::paper::{Paper, PaperChange};
use super::plant_view;
use super::surface::Surface;
use super::theme::Palette;
use crate::export::decode;
use crate::render::canvas::{CanvasLayer, CanvasView};
use crate::render::{RenderError, Renderer, Viewport};
use crate::sketch::StrokeId;
use anyhow::Context as _;
use egui::Color32;
use glam::{Affine2, DAffine2, DVec2, Vec2};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use winit::dpi::PhysicalSize;
use winit::event_loop::ActiveEventLoop;
use winit::window::Window;

/// Width of a line at full pressure, canvas units per unit of the drawing's height on a usual sheet.
const LINE_WIDTH: f32 = 4.0;

/// Shortest wait before asking again whether a picture is finished. Asking costs a frame, so it is asked ever less often
/// the longer the picture takes: every time after this share of the time gone by.
const ASK_AGAIN: Duration = Duration::from_millis(8);
const ASK_SHARE: f32 = 0.25;

/// Spaces the plant's drafts, so that a slow graphics driver has as much time for the stroke under the pen as for the plant.
#[derive(Default)]
struct Pace {
    /// How long the last picture took, once it is finished.
    finished: Arc<Mutex<Option<Duration>>>,
    /// When the picture was begun that is not finished yet.
    begun: Option<Instant>,
    next: Option<Instant>,
}

impl Pace {
    /// A picture was sent to the card.
    fn begin(&mut self, queue: &wgpu::Queue) {
        let (begun, finished) = (Instant::now(), Arc::clone(&self.finished));
        self.begun = Some(begun);
        queue.on_submitted_work_done(move || {
            *finished.lock().unwrap_or_else(PoisonError::into_inner) = Some(begun.elapsed());
        });
    }

    /// When the next draft may be drawn; `None` for now.
    fn waits_until(&mut self, device: &wgpu::Device) -> Option<Instant> {
        // A lost device is found out elsewhere.
        let _ = device.poll(wgpu::PollType::Poll);
        let now = Instant::now();
        if let Some(took) = self.finished.lock().unwrap_or_else(PoisonError::into_inner).take() {
            self.begun = None;
            self.next = Some(now + took);
        }
        if let Some(begun) = self.begun {
            return Some(now + (now - begun).mul_f32(ASK_SHARE).max(ASK_AGAIN));
        }
        self.next.filter(|next| *next > now)
    }
}

/// Everything on the graphics card.
pub(super) struct Graphics {
    surface: Surface,
    painter: EguiPainter,
    renderer: Renderer,
    viewport: Viewport,
    canvas: CanvasLayer,
    pace: Pace,
    plant: egui::TextureId,
    /// Revision of the texture that egui knows.
    plant_revision: u64,
    /// What is on the card.
    shown: Versions,
    paper: Paper,
    /// The growing stroke and how many of its points are on the card.
    growing: Option<(StrokeId, usize)>,
    reference: Option<u64>,
}

impl Graphics {
    /// Opens the best adapter for a window.
    ///
    /// # Errors
    /// No adapter that can draw on the window, with the package to install; or the driver's own failure.
    pub(super) fn open(event_loop: &dyn ActiveEventLoop, window: &Arc<dyn Window>) -> anyhow::Result<Self> {
        let surface = Surface::open(event_loop, Arc::clone(window)).context("the window cannot be drawn")?;
        let renderer = Renderer::with_device(surface.device.clone(), surface.queue.clone(), &surface.info)?;
        let viewport = Viewport::new(&renderer)?;
        let canvas = CanvasLayer::new(&renderer, surface.format())?;
        let mut painter = EguiPainter::new(&surface);
        let plant = painter.register(&surface, viewport.view());
        let plant_revision = viewport.revision();
        Ok(Self {
            surface,
            painter,
            renderer,
            viewport,
            canvas,
            pace: Pace::default(),
            plant,
            plant_revision,
            shown: Versions::default(),
            paper: Paper::default(),
            growing: None,
            reference: None,
        })
    }

    /// The adapter's name.
    pub(super) fn adapter(&self) -> &str {
        self.renderer.adapter()
    }

    /// Whether the device is gone and everything must be made again.
    pub(super) fn is_lost(&self) -> bool {
        self.renderer.is_lost()
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
        self.plant
    }

    /// Puts the newest samples of the growing stroke on the canvas: with the sample that made them.
    pub(super) fn grow_stroke(&mut self, editor: &Editor) {
        let Some(stroke) = editor.canvas.growing() else { return };
        let points = stroke.points();
        match self.growing {
            Some((id, sent)) if id == stroke.id() && sent == stroke.settled() => {
                self.canvas.append_points(id, &points[sent..]);
            }
            // The stabiliser still moves the last points: the stroke is sent anew.
            _ => {
                let colour = Palette::of(editor.theme()).tool(stroke.tool());
                self.canvas.set_stroke(stroke.id(), points, colour.to_array(), LINE_WIDTH);
            }
        }
        self.growing = Some((stroke.id(), points.len()));
    }

    /// Draws a frame: what egui laid out, over the drawing; the plant first, into its texture.
    pub(super) fn draw(&mut self, egui: &egui::Context, mut output: egui::FullOutput, editor: &mut Editor) {
        for drawn in [self.draw_plant(editor), self.draw_canvas(editor)] {
            // A lost device is not told: all is drawn again on the next one.
            match drawn {
                Err(error) if !self.is_lost() => editor.tell_render_failure(&error),
                _ => {}
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
        let area = editor.layout().canvas_px();
        let scissor = scissor(area, self.surface.size());
        let ground = Palette::of(editor.theme()).ground;
        let [r, g, b] = [ground.r(), ground.g(), ground.b()].map(|c| f64::from(c) / 255.0);
        let canvas = &self.canvas;
        let drawing = |pass: &mut wgpu::RenderPass<'_>| {
            if let Some([x, y, width, height]) = scissor {
                pass.set_scissor_rect(x, y, width, height);
                canvas.paint(pass);
            }
        };
        let (ground, is_lost) = (wgpu::Color { r, g, b, a: 1.0 }, || self.renderer.is_lost());
        self.painter.paint(&mut self.surface, frame, ground, drawing, is_lost);
    }

    /// The plant's picture, drawn only where it would be another.
    fn draw_plant(&mut self, editor: &mut Editor) -> Result<(), RenderError> {
        let area = editor.layout().plant;
        let scale = editor.layout().pixels_per_point() as f32;
        let limit = self.surface.device.limits().max_texture_dimension_2d as f32;
        let side = |points: f32| (points * scale).round().clamp(0.0, limit) as u32;
        if area.is_finite() {
            self.viewport.set_size(side(area.width()), side(area.height()));
        }
        if let Some(until) = self.pace.waits_until(&self.surface.device) {
            editor.plant.draw_at(until);
            return Ok(());
        }
        if self.shown.plant != editor.versions.plant
            && let Some(built) = &editor.built
        {
            self.shown.plant = editor.versions.plant;
            let stats = self.viewport.update(&self.renderer, &built.model, &plant_view::texture)?;
            tracing::debug!("uploaded {} of {} parts", stats.uploaded_parts, stats.parts);
            self.viewport.set_overlay(&self.renderer, &built.overlay);
            editor.plant.set_bounds(self.viewport.bounds());
        }
        let look = editor.plant_look();
        let camera = editor.plant.camera();
        if self.viewport.draw(&self.renderer, &camera, &look)? {
            self.pace.begin(&self.surface.queue);
        }
        if self.viewport.revision() != self.plant_revision {
            self.plant_revision = self.viewport.revision();
            self.painter.replace(&self.surface, self.plant, self.viewport.view());
        }
        if std::mem::take(&mut editor.plant.wants_copy) {
            let picture = self.viewport.snapshot(&self.renderer)?;
            let size = [picture.width() as usize, picture.height() as usize];
            editor.copy_picture(egui::ColorImage::from_rgba_unmultiplied(size, picture.pixels()));
        }
        Ok(())
    }

    fn draw_canvas(&mut self, editor: &Editor) -> Result<(), RenderError> {
        if self.shown.drawing != editor.versions.drawing {
            self.shown.drawing = editor.versions.drawing;
            self.sync_strokes(editor);
        }
        if self.shown.reference != editor.versions.reference {
            self.shown.reference = editor.versions.reference;
            self.sync_reference(editor)?;
        }
        let palette = Palette::of(editor.theme());
        let rgb = |c: Color32| [c.r(), c.g(), c.b()];
        let view = CanvasView {
            pixel_from_canvas: narrow(editor.canvas.view().window_from_canvas()),
            framebuffer: self.surface.size(),
            paper: rgb(palette.paper),
            desk: rgb(palette.paper),
            sheet: None,
            line_scale: editor.line_scale(LINE_WIDTH),
        };
        self.canvas.prepare(&self.renderer, &view).map(drop)
    }

    /// Brings the strokes on the card in step with the drawing as it is previewed.
    fn sync_strokes(&mut self, editor: &Editor) {
        for change in self.paper.follow(editor) {
            match change {
                PaperChange::Set(stroke, colour) => {
                    self.canvas.set_stroke(stroke.id, &stroke.points, colour.to_array(), LINE_WIDTH);
                }
                PaperChange::Recolour(id, colour) => self.canvas.set_colour(id, colour.to_array()),
                PaperChange::Remove(id) => self.canvas.remove_stroke(id),
                PaperChange::Order(ids) => self.canvas.set_order(&ids),
            }
        }
        let growing = editor.canvas.growing().map(|stroke| stroke.id());
        if let Some((id, _)) = self.growing.filter(|(id, _)| growing != Some(*id)) {
            self.growing = None;
            if !self.paper.shows(id) {
                self.canvas.remove_stroke(id);
            }
        }
    }

    fn sync_reference(&mut self, editor: &Editor) -> Result<(), RenderError> {
        let reference = editor.document.sketch().reference.as_ref().filter(|r| r.visible);
        let hash = reference.map(|r| r.picture.hash());
        if hash != self.reference {
            self.reference = hash;
            let picture = reference.map(|r| decode::decode(r.picture.bytes())).transpose();
            let picture = picture.map_err(|reason| RenderError::Texture {
                name: "the picture under the drawing".into(),
                reason: reason.to_string(),
            })?;
            self.canvas.set_reference(&self.renderer, picture.as_ref())?;
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

/// The part of a rectangle that lies on the surface, whole pixels: left, top, width, height; `None` where there is none.
fn scissor(area: CanvasRect, (width, height): (u32, u32)) -> Option<[u32; 4]> {
    let most = DVec2::new(width.into(), height.into());
    let (low, high) = (area.min.round().clamp(DVec2::ZERO, most), area.max.round().clamp(DVec2::ZERO, most));
    let size = (high - low).as_uvec2();
    (size.x > 0 && size.y > 0).then_some([low.x as u32, low.y as u32, size.x, size.y])
}

fn narrow(m: DAffine2) -> Affine2 {
    Affine2::from_cols(m.x_axis.as_vec2(), m.y_axis.as_vec2(), m.translation.as_vec2())
}
