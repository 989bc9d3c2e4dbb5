//! A live view: one changing model, drawn into a texture that the window shows.
//!
//! The texture is [`wgpu::TextureFormat::Rgba8Unorm`] and holds encoded (gamma) colours multiplied by their opacity, which
//! is what egui blends on a surface without sRGB: register [`Viewport::view`] once, and again whenever
//! [`Viewport::revision`] has changed.
//!
//! Shadow maps are kept. A lamp's map is drawn again when the model changed or the lamp moved; moving the camera without
//! turning it costs no map at all. In [`Quality::Draft`] the sky lights corners instead of pixels, its lamps stay where they are while the viewer turns, and
//! after a change of the model a software driver renews only a few of them per picture; it also draws fewer pixels and
//! stretches them. [`Quality::Full`] is the picture that [`Renderer::picture`] makes, but a software driver shows no relief of bark.

use super::debug::DebugRenderer;
use super::frame::FrameUniform;
use super::ground::GroundRenderer;
use super::light::{LightUniform, SKY_LAMPS, SUN_MAP_SIZE};
use super::overlay::{OverlayDrawData, OverlayRenderer, Spot};
use super::present::{PresentRenderer, SHOWN_FORMAT};
use super::resident::ResidentModel;
use super::scene::{Scene, SkyMaps};
use super::sight::Sight;
use super::surface::SurfaceRenderer;
use super::target::{PictureBuffers, Readback};
use super::{
    Background, Look, Mode, OrbitCamera, Quality, RenderError, RenderedImage, Renderer, TextureSource,
    UploadStats,
};
use crate::garden::Seen;
use glam::{Mat4, Vec3};

/// Constants of `light.wgsl` and `surface.wgsl` for drafts.
const DRAFT_SURFACE: [(&str, f64); 3] = [("BLOCKER_TAPS", 4.0), ("SUN_TAPS", 6.0), ("SKY_PER_CORNER", 1.0)];
/// Constants of `surface.wgsl` for software drivers: with a relief in pictures one after the other, Mesa's keeps up to 40 MB more with every six
/// strokes (`tests/window/memory.rs`).
const SOFTWARE_SURFACE: [(&str, f64); 1] = [("RELIEF", 0.0)];
/// Constants of `light.wgsl` and `ground.wgsl` for drafts.
const DRAFT_GROUND: [(&str, f64); 3] = [("BLOCKER_TAPS", 4.0), ("SUN_TAPS", 6.0), ("SKY_STEP", 4.0)];
/// Width of the sun's shadow map in drafts, texels.
const DRAFT_SUN_MAP_SIZE: u32 = 1024;
/// Sky lamps whose maps a draft renews after a change of the model, when the processor draws.
const SKY_LAMPS_PER_DRAFT: usize = 2;
/// Share of the width and height at which drafts are drawn when the processor draws.
const DRAFT_SCALE: f32 = 0.5;
/// What is lit when there is no model.
const NOTHING: (Vec3, Vec3) = (Vec3::new(-0.5, 0.0, -0.5), Vec3::new(0.5, 1.0, 0.5));

/// What decides a picture: the same twice is the same picture.
#[derive(Clone, PartialEq)]
struct Shown {
    camera: OrbitCamera,
    look: Look,
    version: u64,
    /// How often the overlay was replaced.
    overlay: u64,
    /// How often the texture was replaced.
    revision: u64,
}

/// A picture as it lies in the texture of a [`Viewport`]: red, green, blue and opacity, encoded, multiplied by the opacity.
#[derive(Clone, Debug)]
pub struct ShownPicture {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Bytes from one row to the next.
    pub bytes_per_row: u32,
    /// The rows from the top.
    pub rows: Vec<u8>,
}

impl ShownPicture {
    /// The same with straight opacity.
    pub fn picture(&self) -> RenderedImage {
        RenderedImage::from_premultiplied_rows(self.width, self.height, &self.rows, self.bytes_per_row)
    }
}

/// What casts shadows: the version of the model, and that of the forms which were chosen for the plants of a garden.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Casters {
    model: u64,
    forms: u64,
}

impl Casters {
    /// Whether a map of these will do. While somebody walks through a garden, shadows of what its plants were a moment ago do.
    fn will_do(self, for_now: Self, hurried: bool) -> bool {
        self.model == for_now.model && (hurried || self.forms == for_now.forms)
    }
}

/// What a shadow map shows: the lamp's place and what casts the shadows.
type MapState = Option<(Mat4, Casters)>;

/// A scene with what its sun's map shows.
struct LitScene {
    scene: Scene,
    sun: MapState,
}

/// A live view of one model.
pub struct Viewport {
    model: ResidentModel,
    full: LitScene,
    draft: LitScene,
    sky: [MapState; SKY_LAMPS],
    /// The light as it was last drawn: its sky lamps are those of the maps.
    light: Option<LightUniform>,
    /// How often other forms were chosen for the plants of a garden.
    forms: u64,
    draft_surface: SurfaceRenderer,
    /// That of full pictures, where it is another than the renderer's.
    software_surface: Option<SurfaceRenderer>,
    draft_ground: GroundRenderer,
    debug: DebugRenderer,
    overlays: OverlayRenderer,
    overlay: Option<OverlayDrawData>,
    overlay_version: u64,
    present: PresentRenderer,
    size: (u32, u32),
    /// By quality: draft, full.
    buffers: [Option<PictureBuffers>; 2],
    output: wgpu::Texture,
    view: wgpu::TextureView,
    revision: u64,
    shown: Option<Shown>,
}

impl Viewport {
    /// A view of nothing, without size.
    ///
    /// # Errors
    /// A failure of the driver.
    pub fn new(renderer: &Renderer) -> Result<Self, RenderError> {
        let Renderer { gpu, scenes, materials, .. } = renderer;
        let maps = SkyMaps::new(gpu);
        let scene =
            |sun_map_size| LitScene { scene: Scene::new(gpu, scenes, &maps, sun_map_size), sun: None };
        let output = output(renderer, 1, 1);
        let viewport = Self {
            model: ResidentModel::default(),
            full: scene(SUN_MAP_SIZE),
            draft: scene(DRAFT_SUN_MAP_SIZE),
            sky: [None; SKY_LAMPS],
            light: None,
            forms: 0,
            draft_surface: SurfaceRenderer::new(gpu, scenes, materials, &DRAFT_SURFACE),
            software_surface: gpu
                .is_software()
                .then(|| SurfaceRenderer::new(gpu, scenes, materials, &SOFTWARE_SURFACE)),
            draft_ground: GroundRenderer::new(gpu, scenes, &DRAFT_GROUND),
            debug: DebugRenderer::new(gpu, scenes),
            overlays: OverlayRenderer::new(gpu, scenes),
            overlay: None,
            overlay_version: 0,
            present: PresentRenderer::new(gpu),
            size: (0, 0),
            buffers: [None, None],
            view: output.create_view(&Default::default()),
            output,
            revision: 0,
            shown: None,
        };
        gpu.check()?;
        Ok(viewport)
    }

    /// Sets the size of the next pictures in physical pixels; buffers are made when they are needed. Nothing is drawn
    /// while a side is zero.
    pub fn set_size(&mut self, width: u32, height: u32) {
        self.size = (width, height);
    }

    /// Shows another model: only parts whose mesh changed go to the GPU, pictures once.
    ///
    /// # Errors
    /// A model that contradicts itself or a texture that cannot be used, both with the view unchanged; or a failure of
    /// the driver.
    pub fn update<'s>(
        &mut self,
        renderer: &Renderer,
        seen: impl Into<Seen<'s>>,
        textures: &TextureSource<'_>,
    ) -> Result<UploadStats, RenderError> {
        self.model.update(&renderer.gpu, &renderer.materials, &seen.into(), textures)
    }

    /// Shows these spots over the model, instead of those before; none for nothing.
    pub fn set_overlay(&mut self, renderer: &Renderer, spots: &[Spot]) {
        let overlay = OverlayDrawData::new(&renderer.gpu, spots);
        if overlay.is_some() || self.overlay.is_some() {
            self.overlay = overlay;
            self.overlay_version += 1;
        }
    }

    /// Smallest and largest corner of the model, `None` without one.
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        self.model.bounds
    }

    /// The texture to show, valid until [`Viewport::revision`] changes.
    pub fn view(&self) -> &wgpu::TextureView {
        &self.view
    }

    /// Changes whenever a call of [`Viewport::draw`] has replaced the texture.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Width over height; 1 without a size.
    pub fn aspect(&self) -> f32 {
        self.size.0.max(1) as f32 / self.size.1.max(1) as f32
    }

    /// Draws unless the picture would be the one that is shown already; says whether it drew.
    ///
    /// # Errors
    /// [`RenderError::Size`], or a failure of the driver; [`Renderer::is_lost`] tells whether it is for good.
    pub fn draw(
        &mut self,
        renderer: &Renderer,
        camera: &OrbitCamera,
        look: &Look,
    ) -> Result<bool, RenderError> {
        if self.size.0 == 0 || self.size.1 == 0 {
            return Ok(false);
        }
        self.make_room(renderer, look.quality)?;
        let version = self.model.version;
        let (overlay, revision) = (self.overlay_version, self.revision);
        let next = Shown { camera: *camera, look: look.clone(), version, overlay, revision };
        if self.shown.as_ref() == Some(&next) {
            return Ok(false);
        }
        self.shown = None;
        let mut encoder = renderer.gpu.device.create_command_encoder(&Default::default());
        self.light(renderer, &mut encoder, camera, look);
        self.paint(renderer, &mut encoder, look);
        if let Some(buffers) = &self.buffers[slot(look.quality)] {
            self.present.draw(&renderer.gpu, &mut encoder, buffers, &self.view);
        }
        renderer.gpu.queue.submit([encoder.finish()]);
        renderer.gpu.poll();
        renderer.gpu.check()?;
        self.shown = Some(next);
        Ok(true)
    }

    /// The picture that is shown, brought back to memory.
    ///
    /// # Errors
    /// A failure of the driver.
    pub fn snapshot(&self, renderer: &Renderer) -> Result<RenderedImage, RenderError> {
        self.read(renderer).map(|shown| shown.picture())
    }

    /// The same as it lies in the texture, for another device to show.
    ///
    /// # Errors
    /// A failure of the driver.
    pub fn read(&self, renderer: &Renderer) -> Result<ShownPicture, RenderError> {
        let (width, height) = (self.output.width(), self.output.height());
        let encoder = renderer.gpu.device.create_command_encoder(&Default::default());
        let readback = Readback::new(&renderer.gpu, width, height);
        readback.finish(&renderer.gpu, encoder, &self.output, |rows, bytes_per_row| ShownPicture {
            width,
            height,
            bytes_per_row,
            rows: rows.to_vec(),
        })
    }

    /// Makes the buffers for pictures of the set size.
    fn make_room(&mut self, renderer: &Renderer, quality: Quality) -> Result<(), RenderError> {
        let (width, height) = self.size;
        let scale = match quality {
            Quality::Draft if renderer.is_software() => DRAFT_SCALE,
            Quality::Draft | Quality::Full => 1.0,
        };
        let scaled = |side: u32| ((side as f32 * scale).round() as u32).max(1);
        let buffers = &mut self.buffers[slot(quality)];
        let fitting = buffers.take().filter(|b| b.has_size(scaled(width), scaled(height)));
        let made = match fitting {
            Some(buffers) => buffers,
            None => PictureBuffers::new(&renderer.gpu, scaled(width), scaled(height))?,
        };
        *buffers = Some(made);
        if (self.output.width(), self.output.height()) != (width, height) {
            let output = output(renderer, width, height);
            renderer.gpu.check()?;
            self.view = output.create_view(&Default::default());
            self.output = output;
            self.revision += 1;
        }
        Ok(())
    }

    /// Sets view and light, and draws the shadow maps that are out of date.
    fn light(
        &mut self,
        renderer: &Renderer,
        encoder: &mut wgpu::CommandEncoder,
        camera: &OrbitCamera,
        look: &Look,
    ) {
        let bounds = self.model.bounds.unwrap_or(NOTHING);
        let ground = (look.background, self.model.ground);
        let height = self.buffers[slot(look.quality)].as_ref().map_or(self.size.1, PictureBuffers::height);
        let camera_there = camera.camera(bounds, self.aspect());
        let frame = FrameUniform::new(&camera_there, bounds, ground);
        if self.model.surface.choose(&renderer.gpu, &Sight::new(&camera_there, height)) {
            self.forms += 1;
        }
        let lit = match look.quality {
            Quality::Draft => &mut self.draft,
            Quality::Full => &mut self.full,
        };
        let axes = camera.level_axes();
        let mut light = LightUniform::new(bounds, &axes, &look.light, lit.scene.sun_map_size);
        if look.mode == Mode::Shaded || look.background != Background::Transparent {
            let hurried = look.quality == Quality::Draft;
            let casters = Casters { model: self.model.version, forms: self.forms };
            let per_draft = if renderer.is_software() { SKY_LAMPS_PER_DRAFT } else { SKY_LAMPS };
            let mut renewed = renewed_sky(&mut self.sky, &light, casters, hurried.then_some(per_draft));
            if let Some(drawn) = &self.light {
                for (i, lamp) in light.sky.iter_mut().enumerate().filter(|(i, _)| !renewed.contains(i)) {
                    *lamp = drawn.sky[i].with_radiance_of(lamp);
                }
            }
            let sun = light.sun.lamp_from_world;
            if !lit.sun.is_some_and(|(lamp, shown)| lamp == sun && shown.will_do(casters, hurried)) {
                lit.sun = Some((sun, casters));
                renewed.push(SKY_LAMPS);
            }
            let lamps = light.lamps().zip(&lit.scene.maps).enumerate().map(|(i, (lamp, map))| (i, lamp, map));
            let lamps = lamps.filter(|(i, ..)| renewed.contains(i));
            renderer.shadow.draw(&renderer.gpu, encoder, lamps, &self.model.surface);
            self.light = Some(light);
        }
        lit.scene.set(&renderer.gpu, &frame, &light);
    }

    /// Draws the picture into the buffers of its quality.
    fn paint(&mut self, renderer: &Renderer, encoder: &mut wgpu::CommandEncoder, look: &Look) {
        let (scene, surface, ground) = match look.quality {
            Quality::Draft => (&self.draft.scene, &self.draft_surface, &self.draft_ground),
            Quality::Full => {
                let surface = self.software_surface.as_ref().unwrap_or(&renderer.surface);
                (&self.full.scene, surface, &renderer.ground)
            }
        };
        let Some(buffers) = &self.buffers[slot(look.quality)] else { return };
        let mut pass = buffers.begin_depth(encoder);
        pass.set_bind_group(0, &scene.group, &[]);
        if look.mode == Mode::Shaded {
            surface.draw_depth(&mut pass, &self.model.surface);
        }
        drop(pass);
        let mut pass = buffers.begin(encoder);
        pass.set_bind_group(0, &scene.group, &[]);
        if look.background != Background::Transparent {
            ground.draw(&mut pass);
        }
        match look.mode {
            Mode::Shaded => surface.draw(&mut pass, &self.model.surface),
            Mode::PartColours | Mode::Wireframe => {
                self.model.faces().for_each(|(faces, tints)| self.debug.draw_faces(&mut pass, &faces, tints));
            }
        }
        match look.mode {
            Mode::Wireframe => {
                for (edges, tints) in self.model.edges(&renderer.gpu) {
                    self.debug.draw_edges(&mut pass, &edges, &tints);
                }
            }
            Mode::PartColours => self.model.forget_edges(),
            Mode::Shaded => {}
        }
        if let Some(overlay) = &self.overlay {
            self.overlays.draw(&mut pass, overlay);
        }
    }
}

/// Sky lamps whose maps are to be drawn now, with `state` as it is afterwards. All that moved or show an older model;
/// within a limit only those that show an older model, the oldest first, but all that show nothing yet.
fn renewed_sky(
    state: &mut [MapState; SKY_LAMPS],
    light: &LightUniform,
    casters: Casters,
    limit: Option<usize>,
) -> Vec<usize> {
    let lamps = 0..SKY_LAMPS;
    let mut renewed: Vec<usize> = match limit {
        None => lamps.filter(|&i| state[i] != Some((light.sky[i].lamp_from_world, casters))).collect(),
        Some(_) => {
            lamps.filter(|&i| state[i].is_none_or(|(_, shown)| !shown.will_do(casters, true))).collect()
        }
    };
    if let Some(limit) = limit {
        let empty = renewed.iter().filter(|&&i| state[i].is_none()).count();
        renewed.sort_by_key(|&i| state[i].map(|(_, shown)| shown));
        renewed.truncate(limit.max(empty));
    }
    for &i in &renewed {
        state[i] = Some((light.sky[i].lamp_from_world, casters));
    }
    renewed
}

fn slot(quality: Quality) -> usize {
    match quality {
        Quality::Draft => 0,
        Quality::Full => 1,
    }
}

fn output(renderer: &Renderer, width: u32, height: u32) -> wgpu::Texture {
    renderer.gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("viewport"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: SHOWN_FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    })
}
