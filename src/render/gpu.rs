//! The graphics device: chosen once, and every failure of it turned into a [`RenderError`].
//!
//! Hardware is taken before software; the window opens its own device, because it must fit the screen, and shares it.
//! wgpu reports failures out of band; [`Gpu`] collects them and [`Gpu::check`] hands over the first, so that no failure
//! of a driver can end in a panic. A device that was lost once stays lost: everything on it must be made anew.
//!
//! Buffers have a largest size, the device's own: what may be larger is divided among several (`surface`, `pool`).

use super::RenderError;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Buffers lie in blocks that are given back only when all of a block is free, the last block never: small blocks let the
/// large buffers of a plant have memory of their own, which goes with them.
pub(crate) const MEMORY_HINTS: wgpu::MemoryHints =
    wgpu::MemoryHints::Manual { suballocated_device_memory_block_size: BLOCK..BLOCK };
/// Smallest block, bytes.
const BLOCK: u64 = 8 << 20;
/// Longest wait for the device in one go, which is one pass; software drivers need seconds for the largest.
const PATIENCE: Duration = Duration::from_secs(120);
/// Between waits that ended too early.
const PAUSE: Duration = Duration::from_millis(1);

/// What is asked of a device: little, so that any will do, but buffers and textures as large as the adapter can.
pub(crate) fn limits(adapter: &wgpu::Adapter) -> wgpu::Limits {
    let best = adapter.limits();
    let max_buffer_size = best.max_buffer_size;
    wgpu::Limits { max_buffer_size, ..wgpu::Limits::downlevel_defaults().using_resolution(best) }
}

/// A failure that the device reported.
enum Fault {
    /// There was no memory for something.
    OutOfMemory,
    Other(String),
}

/// An open device with its queue.
pub struct Gpu {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    pub(super) adapter: String,
    /// Whether the processor does the drawing.
    software: bool,
    /// Size of the largest buffer, bytes.
    pub(super) largest_buffer: u64,
    fault: Arc<Mutex<Option<Fault>>>,
    lost: Arc<AtomicBool>,
}

impl Gpu {
    /// Opens the best adapter among `backends`; `WGPU_BACKEND` in the environment narrows them further.
    ///
    /// # Errors
    /// No adapter, or one that refuses to open.
    pub(super) fn open(backends: wgpu::Backends) -> Result<Self, RenderError> {
        let mut wanted = wgpu::InstanceDescriptor::new_without_display_handle_from_env();
        wanted.backends &= backends;
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        };
        let adapter = pollster::block_on(wgpu::Instance::new(wanted).request_adapter(&options))
            .map_err(|e| RenderError::NoAdapter { reason: e.to_string() })?;
        let info = adapter.get_info();
        let name = name_of(&info);
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("penstemon"),
            required_limits: limits(&adapter),
            memory_hints: MEMORY_HINTS,
            ..Default::default()
        }))
        .map_err(|e| RenderError::Device { adapter: name, reason: e.to_string() })?;
        Ok(Self::from_parts(device, queue, &info))
    }

    /// Takes over a device that somebody else opened: from here on its uncaptured errors and its loss are collected here,
    /// also those of commands that others give to it.
    pub fn from_parts(device: wgpu::Device, queue: wgpu::Queue, adapter: &wgpu::AdapterInfo) -> Self {
        let fault = Arc::new(Mutex::new(None));
        let lost = Arc::new(AtomicBool::new(false));
        let uncaptured = Arc::clone(&fault);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            let is_memory = matches!(error, wgpu::Error::OutOfMemory { .. });
            let fault = if is_memory { Fault::OutOfMemory } else { Fault::Other(error.to_string()) };
            note(&uncaptured, fault);
        }));
        let (why, gone) = (Arc::clone(&fault), Arc::clone(&lost));
        device.set_device_lost_callback(move |reason, message| {
            tracing::warn!("the graphics device was lost ({reason:?}): {message}");
            gone.store(true, Ordering::Release);
            note(&why, Fault::Other(format!("the device was lost: {message}")));
        });
        let software = adapter.device_type == wgpu::DeviceType::Cpu;
        let largest_buffer = device.limits().max_buffer_size;
        Self { device, queue, adapter: name_of(adapter), software, largest_buffer, fault, lost }
    }

    /// Whether the device is gone for good: open a new one, and make everything on it anew.
    pub fn is_lost(&self) -> bool {
        self.lost.load(Ordering::Acquire)
    }

    /// Name of the adapter and the interface through which it is used.
    pub fn adapter(&self) -> &str {
        &self.adapter
    }

    /// Whether the processor does the work of a graphics card.
    pub fn is_software(&self) -> bool {
        self.software
    }

    /// Longest side of a texture in pixels.
    pub fn largest_side(&self) -> u32 {
        self.device.limits().max_texture_dimension_2d
    }

    /// A buffer with these contents. (wgpu's own helper maps the new buffer and panics when there is no memory for it.)
    pub(super) fn buffer(&self, label: &str, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: contents.len() as u64,
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        self.queue.write_buffer(&buffer, 0, contents);
        buffer
    }

    /// The first failure since the last check; a lost device fails every time.
    ///
    /// # Errors
    /// That failure.
    pub fn check(&self) -> Result<(), RenderError> {
        match self.fault.lock().unwrap_or_else(PoisonError::into_inner).take() {
            Some(Fault::OutOfMemory) => Err(RenderError::OutOfMemory { adapter: self.adapter.clone() }),
            Some(Fault::Other(reason)) => Err(self.failure(reason)),
            None if self.is_lost() => Err(self.failure("the device was lost".to_owned())),
            None => Ok(()),
        }
    }

    /// Lets the device report what happened, such as its loss, without waiting.
    pub(super) fn poll(&self) {
        // wgpu panics when a device is asked of which it knows that it is lost.
        if self.is_lost() {
            return;
        }
        // A failure to poll shows in the next check.
        let _ = self.device.poll(wgpu::PollType::Poll);
    }

    /// Waits until everything submitted is done.
    ///
    /// # Errors
    /// A lost device, or one that takes longer than two minutes.
    pub(super) fn wait(&self) -> Result<(), RenderError> {
        if self.is_lost() {
            return self.check();
        }
        let begin = Instant::now();
        loop {
            let left = PATIENCE.saturating_sub(begin.elapsed());
            let wait = wgpu::PollType::Wait { submission_index: None, timeout: Some(left) };
            let waited = self.device.poll(wait);
            self.check()?;
            match waited {
                Ok(_) => return Ok(()),
                // OpenGL waits 2.1 s at most, even where more is asked for: wgpu gives it the nanoseconds as 31 bits.
                Err(wgpu::PollError::Timeout) if !left.is_zero() => std::thread::sleep(PAUSE),
                Err(wgpu::PollError::Timeout) => {
                    return Err(RenderError::TooSlow {
                        adapter: self.adapter.clone(),
                        seconds: PATIENCE.as_secs(),
                    });
                }
                Err(other) => return Err(self.failure(other.to_string())),
            }
        }
    }

    /// Submits a pass and waits until it is done.
    ///
    /// # Errors
    /// As [`Self::wait`], and any failure since the last check.
    pub(super) fn finish(&self, encoder: wgpu::CommandEncoder) -> Result<(), RenderError> {
        self.queue.submit([encoder.finish()]);
        self.check()?;
        self.wait()
    }

    /// A failure of this device in words.
    pub(super) fn failure(&self, reason: String) -> RenderError {
        RenderError::Gpu { adapter: self.adapter.clone(), reason }
    }
}

/// Name of an adapter and the interface through which it is used.
fn name_of(adapter: &wgpu::AdapterInfo) -> String {
    format!("{} ({})", adapter.name, adapter.backend)
}

/// Keeps the first failure: later ones are usually its consequences.
fn note(first: &Mutex<Option<Fault>>, fault: Fault) {
    first.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(fault);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Mesh, Model, Part, PartKind, Vertex};
    use crate::plant::Material;
    use crate::render::{Background, PictureOptions, Renderer, View};
    use glam::{Vec2, Vec3};

    #[test]
    fn a_refused_command_is_an_error_once() {
        let renderer = Renderer::new().unwrap();
        let gpu = renderer.gpu();
        let endless = wgpu::BufferDescriptor {
            label: None,
            size: u64::MAX / 2,
            usage: wgpu::BufferUsages::VERTEX,
            mapped_at_creation: false,
        };
        drop(gpu.device.create_buffer(&endless));
        assert!(matches!(gpu.check(), Err(RenderError::Gpu { .. })));
        assert!(gpu.check().is_ok());
    }

    fn triangle() -> Model {
        let points = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
        let corner = |point| Vertex { point, normal: Vec3::Z, uv: Vec2::ZERO };
        let mesh = Mesh {
            points,
            vertices: [0, 1, 2].map(corner).to_vec(),
            triangles: vec![[0, 1, 2]],
            breaks: vec![],
        };
        let part = Part::alone("branch_0", PartKind::Wood, 0, mesh.into());
        Model { parts: vec![part], materials: vec![Material::plain("bark", [0.5; 3])] }
    }

    #[test]
    fn a_lost_device_is_an_error() {
        let mut renderer = Renderer::new().unwrap();
        let options = PictureOptions { width: 8, height: 8, background: Background::Paper };
        let mut uploaded = renderer.upload(&triangle(), &|_| Err("none".into())).unwrap();
        let mut draw =
            |renderer: &mut Renderer| renderer.pictures(&mut uploaded, &[View::default()], &options).next();
        assert!(matches!(draw(&mut renderer), Some(Ok(_))));
        renderer.gpu().device.destroy();
        assert!(matches!(draw(&mut renderer), Some(Err(RenderError::Gpu { .. }))));
        let again = renderer.upload(&triangle(), &|_| Err("none".into()));
        assert!(matches!(again, Err(RenderError::Gpu { .. })));
    }
}
