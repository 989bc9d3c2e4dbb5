//! The renderer: owns the GPU and draws models and drawings into pictures.

use super::camera::{Axes, Camera, Framing};
use super::frame::FrameUniform;
use super::gpu::Gpu;
use super::ground::GroundRenderer;
use super::ink::{InkDrawData, InkRenderer};
use super::light::{LightParams, LightUniform, SUN_MAP_SIZE};
use super::look::Background;
use super::material::{MaterialLayout, TextureSource};
use super::scene::{Scene, SceneLayout, SkyMaps};
use super::shadow::ShadowRenderer;
use super::sight::Sight;
use super::surface::{SurfaceDrawData, SurfaceRenderer};
use super::target::OffscreenTarget;
use super::{OrbitCamera, RenderError, RenderedImage, View};
use crate::garden::{Crowd, Seen};
use crate::model::Part;
use crate::sketch::Sketch;
use bytemuck::Zeroable;
use glam::{Vec2, Vec3};

/// How a picture is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PictureOptions {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// What the plant stands on.
    pub background: Background,
}

impl PictureOptions {
    /// Width over height.
    fn aspect(&self) -> f32 {
        self.width.max(1) as f32 / self.height.max(1) as f32
    }
}

impl Default for PictureOptions {
    fn default() -> Self {
        Self { width: 1200, height: 900, background: Background::Paper }
    }
}

/// A model on the GPU, ready to be drawn from many sides.
pub struct ModelDrawData {
    surface: SurfaceDrawData,
    points: Vec<Vec3>,
    bounds: (Vec3, Vec3),
    /// Height of its own ground.
    ground: Option<f32>,
}

impl ModelDrawData {
    /// How many triangles the last picture of it had, what was outside of it left out.
    pub fn triangles_in_view(&self) -> u64 {
        self.surface.triangles_in_view()
    }

    /// The same model, framed and lit as if it were another: for pictures that follow one another.
    #[must_use]
    pub fn framed_as(self, other: &Self) -> Self {
        Self { points: other.points.clone(), bounds: other.bounds, ground: other.ground, ..self }
    }
}

/// Draws pictures.
pub struct Renderer {
    pub(super) gpu: Gpu,
    pub(super) scenes: SceneLayout,
    scene: Scene,
    pub(super) materials: MaterialLayout,
    pub(super) shadow: ShadowRenderer,
    pub(super) ground: GroundRenderer,
    pub(super) surface: SurfaceRenderer,
    ink: InkRenderer,
    target: Option<OffscreenTarget>,
}

impl Renderer {
    /// Opens the best graphics adapter of the machine: Vulkan, and OpenGL ES where there is none; hardware if there is
    /// any, otherwise software.
    ///
    /// # Errors
    /// [`RenderError::NoAdapter`] names the package to install; [`RenderError::Device`] and [`RenderError::Gpu`] are
    /// a driver's own failures.
    pub fn new() -> Result<Self, RenderError> {
        // OpenGL is asked second: starting its driver takes time and is rarely needed.
        Self::with_backends(wgpu::Backends::VULKAN).or_else(|_| Self::with_backends(wgpu::Backends::GL))
    }

    /// The same among chosen interfaces to the graphics driver.
    ///
    /// # Errors
    /// As [`Renderer::new`].
    pub fn with_backends(backends: wgpu::Backends) -> Result<Self, RenderError> {
        Self::on(Gpu::open(backends)?)
    }

    /// A renderer on an open device.
    ///
    /// # Errors
    /// [`RenderError::Gpu`] when the device cannot do what is needed.
    pub fn on(gpu: Gpu) -> Result<Self, RenderError> {
        let scenes = SceneLayout::new(&gpu);
        let scene = Scene::new(&gpu, &scenes, &SkyMaps::new(&gpu), SUN_MAP_SIZE);
        let materials = MaterialLayout::new(&gpu);
        let renderer = Self {
            shadow: ShadowRenderer::new(&gpu, &materials),
            ground: GroundRenderer::new(&gpu, &scenes, &[]),
            surface: SurfaceRenderer::new(&gpu, &scenes, &materials, &[]),
            ink: InkRenderer::new(&gpu),
            target: None,
            scenes,
            scene,
            materials,
            gpu,
        };
        renderer.gpu.check()?;
        Ok(renderer)
    }

    /// Name of the adapter that draws.
    pub fn adapter(&self) -> &str {
        &self.gpu.adapter
    }

    /// Whether the device was lost. It does not come back: open a new one, and make everything on it anew.
    pub fn is_lost(&self) -> bool {
        self.gpu.is_lost()
    }

    /// The first failure of the device since the last check, also of commands that others gave to a shared device.
    ///
    /// # Errors
    /// That failure.
    pub fn check(&self) -> Result<(), RenderError> {
        self.gpu.check()
    }

    /// Whether the processor draws because there is no graphics hardware: [`Quality::Draft`](super::Quality) is made for it.
    pub fn is_software(&self) -> bool {
        self.gpu.is_software()
    }

    /// The device, to share it.
    pub fn device(&self) -> &wgpu::Device {
        &self.gpu.device
    }

    /// The device's queue.
    pub fn queue(&self) -> &wgpu::Queue {
        &self.gpu.queue
    }

    /// The device with its failures.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Uploads a model with its textures, and with the plants of a garden if it has one.
    ///
    /// # Errors
    /// An empty or contradictory model, a texture that cannot be used, or a failure of the driver.
    pub fn upload<'s>(
        &self,
        seen: impl Into<Seen<'s>>,
        textures: &TextureSource<'_>,
    ) -> Result<ModelDrawData, RenderError> {
        let seen = seen.into();
        let bounds = seen.bounds().filter(|_| seen.counts()[1] > 0);
        let bounds = bounds.ok_or(RenderError::Empty { what: "the model" })?;
        let surface = SurfaceDrawData::new(&self.gpu, &self.materials, &seen, textures)?;
        self.gpu.check()?;
        let points = seen.model.parts.iter().flat_map(Part::points);
        let points = points.chain(seen.crowd.iter().flat_map(Crowd::outermost_points)).collect();
        Ok(ModelDrawData { surface, points, bounds, ground: seen.model.ground_level() })
    }

    /// One picture of a model.
    ///
    /// # Errors
    /// As [`Renderer::upload`] and [`Renderer::pictures`].
    pub fn picture<'s>(
        &mut self,
        seen: impl Into<Seen<'s>>,
        textures: &TextureSource<'_>,
        view: &View,
        options: &PictureOptions,
    ) -> Result<RenderedImage, RenderError> {
        let mut model = self.upload(seen, textures)?;
        let mut pictures = self.pictures(&mut model, std::slice::from_ref(view), options);
        pictures.next().unwrap_or(Err(RenderError::Empty { what: "the list of views" }))
    }

    /// A picture for each view, all framed alike: the frames of a turntable. The views must share a projection.
    ///
    /// # Errors
    /// Each picture's own: [`RenderError::Size`], or a failure of the driver.
    pub fn pictures<'a>(
        &'a mut self,
        model: &'a mut ModelDrawData,
        views: &'a [View],
        options: &PictureOptions,
    ) -> impl Iterator<Item = Result<RenderedImage, RenderError>> + 'a {
        let framing = Framing::new(&model.points, model.bounds, views, options.aspect());
        let seen = views.iter().map(move |view| (framing.camera(view), view.level_axes()));
        self.shots(model, seen, *options)
    }

    /// A picture by each of these cameras: the frames of a walk.
    ///
    /// # Errors
    /// As for [`Renderer::pictures`].
    pub fn pictures_by<'a>(
        &'a mut self,
        model: &'a mut ModelDrawData,
        cameras: &'a [OrbitCamera],
        options: &PictureOptions,
    ) -> impl Iterator<Item = Result<RenderedImage, RenderError>> + 'a {
        let (aspect, bounds) = (options.aspect(), model.bounds);
        let seen = cameras.iter().map(move |camera| (camera.camera(bounds, aspect), camera.level_axes()));
        self.shots(model, seen, *options)
    }

    /// A picture by each camera, with lamps that stand in these axes.
    fn shots<'a>(
        &'a mut self,
        model: &'a mut ModelDrawData,
        seen: impl Iterator<Item = (Camera, Axes)> + 'a,
        options: PictureOptions,
    ) -> impl Iterator<Item = Result<RenderedImage, RenderError>> + 'a {
        seen.map(move |(camera, axes)| {
            model.surface.choose(&self.gpu, &Sight::new(&camera, options.height));
            let frame = FrameUniform::new(&camera, model.bounds, (options.background, model.ground));
            let light = LightUniform::new(model.bounds, &axes, &LightParams::default(), SUN_MAP_SIZE);
            self.draw_model(model, &frame, &light, &options)
        })
    }

    /// Draws a picture pass by pass: drivers end work that takes them too long, and of a large model one pass takes long.
    fn draw_model(
        &mut self,
        model: &ModelDrawData,
        frame: &FrameUniform,
        light: &LightUniform,
        options: &PictureOptions,
    ) -> Result<RenderedImage, RenderError> {
        let target = sized(&mut self.target, &self.gpu, options)?;
        self.scene.set(&self.gpu, frame, light);
        for (i, (lamp, map)) in light.lamps().zip(&self.scene.maps).enumerate() {
            let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
            self.shadow.draw(&self.gpu, &mut encoder, std::iter::once((i, lamp, map)), &model.surface);
            self.gpu.finish(encoder)?;
        }
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let mut pass = target.buffers.begin_depth(&mut encoder);
        pass.set_bind_group(0, &self.scene.group, &[]);
        self.surface.draw_depth(&mut pass, &model.surface);
        drop(pass);
        self.gpu.finish(encoder)?;
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let mut pass = target.buffers.begin(&mut encoder);
        pass.set_bind_group(0, &self.scene.group, &[]);
        if options.background != Background::Transparent {
            self.ground.draw(&mut pass);
        }
        self.surface.draw(&mut pass, &model.surface);
        drop(pass);
        target.finish(&self.gpu, encoder)
    }

    /// A drawing as ink on paper, filling the picture up to its margin. Always on paper, even if `options` ask for
    /// a transparent picture.
    ///
    /// # Errors
    /// An empty drawing, [`RenderError::Size`], or a failure of the driver.
    pub fn drawing(
        &mut self,
        sketch: &Sketch,
        options: &PictureOptions,
    ) -> Result<RenderedImage, RenderError> {
        let ink = InkDrawData::new(&self.gpu, sketch)?;
        let target = sized(&mut self.target, &self.gpu, options)?;
        self.scene.set(&self.gpu, &FrameUniform::paper(), &LightUniform::zeroed());
        self.ink.set(&self.gpu, &ink, Vec2::new(options.width as f32, options.height as f32));
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        drop(target.buffers.begin_depth(&mut encoder));
        let mut pass = target.buffers.begin(&mut encoder);
        pass.set_bind_group(0, &self.scene.group, &[]);
        self.ground.draw(&mut pass);
        self.ink.draw(&mut pass, &ink);
        drop(pass);
        target.finish(&self.gpu, encoder)
    }
}

/// The kept target if it has the right size, otherwise a new one in its place.
fn sized<'a>(
    kept: &'a mut Option<OffscreenTarget>,
    gpu: &Gpu,
    options: &PictureOptions,
) -> Result<&'a OffscreenTarget, RenderError> {
    let target = match kept.take().filter(|t| t.buffers.has_size(options.width, options.height)) {
        Some(target) => target,
        None => OffscreenTarget::new(gpu, options.width, options.height)?,
    };
    Ok(kept.insert(target))
}
