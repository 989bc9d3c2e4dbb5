//! The window's surface: where frames go, and how it survives whatever happens to it.
//!
//! Resizes, minimised windows, unplugged displays and lost surfaces are answered here: the surface is configured or
//! made anew and the frame is drawn a little later. A lost device cannot be answered here: whoever draws with it sees it,
//! and everything on the GPU is made again.

use crate::render::{self, RenderError};
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::Arc;
use winit::dpi::PhysicalSize;
use winit::event_loop::ActiveEventLoop;
use winit::window::Window;

/// A window's surface with the device that draws on it.
pub(super) struct Surface {
    window: Arc<dyn Window>,
    instance: wgpu::Instance,
    surface: wgpu::Surface<'static>,
    /// How the surface is set up; its size is never zero.
    config: wgpu::SurfaceConfiguration,
    /// The adapter that draws.
    pub(super) info: wgpu::AdapterInfo,
    /// The device, shared by everything that draws in the window.
    pub(super) device: wgpu::Device,
    /// Its queue.
    pub(super) queue: wgpu::Queue,
    hidden: bool,
}

impl Surface {
    /// Opens the best adapter that can draw on the window: Vulkan first, OpenGL ES where there is none.
    ///
    /// # Errors
    /// [`RenderError::NoAdapter`] names the package to install; otherwise the driver's own failure.
    pub(super) fn open(
        event_loop: &dyn ActiveEventLoop,
        window: Arc<dyn Window>,
    ) -> Result<Self, RenderError> {
        Self::with_backends(event_loop, &window, wgpu::Backends::PRIMARY)
            .or_else(|_| Self::with_backends(event_loop, &window, wgpu::Backends::GL))
    }

    fn with_backends(
        event_loop: &dyn ActiveEventLoop,
        window: &Arc<dyn Window>,
        backends: wgpu::Backends,
    ) -> Result<Self, RenderError> {
        let no_adapter = |reason: String| RenderError::NoAdapter { reason };
        let display = Box::new(event_loop.owned_display_handle());
        let mut wanted = wgpu::InstanceDescriptor::new_with_display_handle_from_env(display);
        wanted.backends &= backends;
        let instance = wgpu::Instance::new(wanted);
        let surface = instance.create_surface(Arc::clone(window)).map_err(|e| no_adapter(e.to_string()))?;
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            compatible_surface: Some(&surface),
            ..Default::default()
        };
        let adapter =
            pollster::block_on(instance.request_adapter(&options)).map_err(|e| no_adapter(e.to_string()))?;
        let info = adapter.get_info();
        let name = format!("{} ({})", info.name, info.backend);
        let refused = |reason: String| RenderError::Device { adapter: name.clone(), reason };
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("penstemon"),
            required_limits: render::device_limits(&adapter),
            memory_hints: render::MEMORY_HINTS,
            ..Default::default()
        }))
        .map_err(|e| refused(e.to_string()))?;
        let size = window.surface_size();
        let mut config = surface
            .get_default_config(&adapter, size.width.max(1), size.height.max(1))
            .ok_or_else(|| refused("it cannot draw on this window".into()))?;
        let capabilities = surface.get_capabilities(&adapter);
        config.format = egui_wgpu::preferred_framebuffer_format(&capabilities.formats)
            .map_err(|e| refused(e.to_string()))?;
        // Newest picture first: what the pen drew must not wait behind older frames.
        let mailbox = capabilities.present_modes.contains(&wgpu::PresentMode::Mailbox);
        config.present_mode = if mailbox { wgpu::PresentMode::Mailbox } else { wgpu::PresentMode::Fifo };
        config.desired_maximum_frame_latency = 1;
        // Frames are painted elsewhere, where they stay, and copied.
        config.usage |= wgpu::TextureUsages::COPY_DST & capabilities.usages;
        surface.configure(&device, &config);
        let (window, hidden) = (Arc::clone(window), false);
        Ok(Self { window, instance, surface, config, info, device, queue, hidden })
    }

    /// Width and height in pixels, at least 1.
    pub(super) fn size(&self) -> (u32, u32) {
        (self.config.width, self.config.height)
    }

    /// Format of the frames; colours are written gamma-encoded.
    pub(super) fn format(&self) -> wgpu::TextureFormat {
        self.config.format
    }

    /// Whether frames can be copied onto the surface.
    pub(super) fn takes_copies(&self) -> bool {
        self.config.usage.contains(wgpu::TextureUsages::COPY_DST)
    }

    /// Follows the window's size; a window without area keeps the last one.
    pub(super) fn resize(&mut self, size: PhysicalSize<u32>) {
        self.hidden = size.width == 0 || size.height == 0;
        if self.hidden || (size.width, size.height) == self.size() {
            return;
        }
        let limit = self.device.limits().max_texture_dimension_2d;
        self.config.width = size.width.min(limit);
        self.config.height = size.height.min(limit);
        self.surface.configure(&self.device, &self.config);
    }

    /// The next frame to draw on; `None` where there is none to be had now. The window asks again with its next change
    /// or, where the surface was set up anew or the driver was busy, at once.
    pub(super) fn acquire(&mut self) -> Option<wgpu::SurfaceTexture> {
        use wgpu::CurrentSurfaceTexture as Current;
        if self.hidden {
            return None;
        }
        match self.surface.get_current_texture() {
            Current::Success(frame) => return Some(frame),
            Current::Suboptimal(frame) => {
                drop(frame);
                self.surface.configure(&self.device, &self.config);
            }
            Current::Outdated | Current::Validation => self.surface.configure(&self.device, &self.config),
            Current::Lost => match self.instance.create_surface(Arc::clone(&self.window)) {
                Ok(surface) => {
                    self.surface = surface;
                    self.surface.configure(&self.device, &self.config);
                }
                Err(error) => {
                    tracing::warn!("the window's surface is lost: {error}");
                    return None;
                }
            },
            // The driver is busy; what is to be shown is still to be shown.
            Current::Timeout => {
                self.window.request_redraw();
                return None;
            }
            Current::Occluded => return None,
        }
        // Once more with the new setup; otherwise with the next redraw.
        match self.surface.get_current_texture() {
            Current::Success(frame) | Current::Suboptimal(frame) => Some(frame),
            _ => {
                self.window.request_redraw();
                None
            }
        }
    }

    /// Lets go of a frame that the device did not live to draw.
    ///
    /// wgpu 30.0 keeps such a frame and panics when the surface goes (gfx-rs/wgpu issue 9277, mended after 30.0.1). Only
    /// on a thread that unwinds does it let go, so this one does, to here and without a word.
    pub(super) fn abandon(frame: wgpu::SurfaceTexture) {
        let dropped = catch_unwind(AssertUnwindSafe(move || -> () {
            let _frame = frame;
            resume_unwind(Box::new(()))
        }));
        debug_assert!(dropped.is_err());
    }

    /// Shows a frame.
    pub(super) fn present(&self, frame: wgpu::SurfaceTexture) {
        self.window.pre_present_notify();
        self.queue.present(frame);
    }
}
