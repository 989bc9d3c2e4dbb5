//! What is drawn into: the buffers of a picture, and an offscreen picture that comes back to memory. They are kept while
//! the size stays.

use super::gpu::Gpu;
use super::pipeline::{COLOUR_FORMAT, DEPTH_FORMAT, SAMPLES};
use super::{RenderError, RenderedImage};

/// Most pixels of a picture: about 1.4 GB of buffers at four samples each.
pub(super) const PIXEL_LIMIT: u32 = 8192 * 4096;

/// The buffers of a picture.
pub(super) struct PictureBuffers {
    width: u32,
    height: u32,
    /// Four samples per pixel.
    colour: wgpu::TextureView,
    depth: wgpu::TextureView,
    /// One sample per pixel.
    resolved: wgpu::Texture,
    pub(super) resolved_view: wgpu::TextureView,
}

impl PictureBuffers {
    /// Makes the buffers of a picture.
    ///
    /// # Errors
    /// A side or an area out of range, or too little memory.
    pub(super) fn new(gpu: &Gpu, width: u32, height: u32) -> Result<Self, RenderError> {
        let limit = gpu.device.limits().max_texture_dimension_2d;
        let sides = 1..=limit;
        let too_many = u64::from(width) * u64::from(height) > u64::from(PIXEL_LIMIT);
        if !sides.contains(&width) || !sides.contains(&height) || too_many {
            return Err(RenderError::Size { width, height, limit, pixels: PIXEL_LIMIT });
        }
        let make = |label, format, sample_count, usage| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
                view_formats: &[],
            })
        };
        let nothing = wgpu::TextureUsages::empty();
        let colour = make("colour", COLOUR_FORMAT, SAMPLES, nothing).create_view(&Default::default());
        let depth = make("depth", DEPTH_FORMAT, SAMPLES, nothing).create_view(&Default::default());
        let resolved = make(
            "resolved",
            COLOUR_FORMAT,
            1,
            wgpu::TextureUsages::COPY_SRC | wgpu::TextureUsages::TEXTURE_BINDING,
        );
        gpu.check()?;
        let resolved_view = resolved.create_view(&Default::default());
        Ok(Self { width, height, colour, depth, resolved, resolved_view })
    }

    /// Their height in pixels.
    pub(super) fn height(&self) -> u32 {
        self.height
    }

    /// Whether a picture of this size fits exactly.
    pub(super) fn has_size(&self, width: u32, height: u32) -> bool {
        (self.width, self.height) == (width, height)
    }

    /// Begins a pass over the depth of an empty picture.
    pub(super) fn begin_depth<'a>(&'a self, encoder: &'a mut wgpu::CommandEncoder) -> wgpu::RenderPass<'a> {
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("depth"),
            depth_stencil_attachment: Some(self.depth(wgpu::LoadOp::Clear(1.0), wgpu::StoreOp::Store)),
            ..Default::default()
        })
    }

    /// Begins a pass over the colours of a see-through picture whose depth is there already.
    pub(super) fn begin<'a>(&'a self, encoder: &'a mut wgpu::CommandEncoder) -> wgpu::RenderPass<'a> {
        // Alpha 1 is “seen through”, see [`COLOUR_FORMAT`].
        let empty = wgpu::Color { r: 0.0, g: 0.0, b: 0.0, a: 1.0 };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("picture"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.colour,
                depth_slice: None,
                resolve_target: Some(&self.resolved_view),
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(empty), store: wgpu::StoreOp::Discard },
            })],
            depth_stencil_attachment: Some(self.depth(wgpu::LoadOp::Load, wgpu::StoreOp::Discard)),
            ..Default::default()
        })
    }

    fn depth(
        &self,
        load: wgpu::LoadOp<f32>,
        store: wgpu::StoreOp,
    ) -> wgpu::RenderPassDepthStencilAttachment<'_> {
        let depth_ops = Some(wgpu::Operations { load, store });
        wgpu::RenderPassDepthStencilAttachment { view: &self.depth, depth_ops, stencil_ops: None }
    }
}

/// A way from a texture of four bytes per pixel back to memory.
pub(super) struct Readback {
    buffer: wgpu::Buffer,
    bytes_per_row: u32,
}

impl Readback {
    pub(super) fn new(gpu: &Gpu, width: u32, height: u32) -> Self {
        let bytes_per_row = (4 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size: u64::from(bytes_per_row) * u64::from(height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        Self { buffer, bytes_per_row }
    }

    /// Submits the passes and brings back `texture`, which must have this size; `read` gets its rows and their length.
    ///
    /// # Errors
    /// Any failure of the driver since the last check.
    pub(super) fn finish<T>(
        &self,
        gpu: &Gpu,
        mut encoder: wgpu::CommandEncoder,
        texture: &wgpu::Texture,
        read: impl FnOnce(&[u8], u32) -> T,
    ) -> Result<T, RenderError> {
        let rows = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(self.bytes_per_row),
            rows_per_image: None,
        };
        let into = wgpu::TexelCopyBufferInfo { buffer: &self.buffer, layout: rows };
        encoder.copy_texture_to_buffer(texture.as_image_copy(), into, texture.size());
        gpu.queue.submit([encoder.finish()]);
        gpu.check()?;
        // A failed mapping shows when its range is asked for.
        self.buffer.map_async(wgpu::MapMode::Read, .., |_| ());
        gpu.wait()?;
        let mapped = self.buffer.get_mapped_range(..).map_err(|e| gpu.failure(e.to_string()))?;
        let result = read(&mapped, self.bytes_per_row);
        drop(mapped);
        self.buffer.unmap();
        Ok(result)
    }
}

/// An offscreen picture on the GPU.
pub(super) struct OffscreenTarget {
    pub(super) buffers: PictureBuffers,
    readback: Readback,
}

impl OffscreenTarget {
    /// Makes the buffers of a picture.
    ///
    /// # Errors
    /// A side or an area out of range, or too little memory.
    pub(super) fn new(gpu: &Gpu, width: u32, height: u32) -> Result<Self, RenderError> {
        let buffers = PictureBuffers::new(gpu, width, height)?;
        let readback = Readback::new(gpu, width, height);
        gpu.check()?;
        Ok(Self { buffers, readback })
    }

    /// Submits the passes and brings the picture back.
    ///
    /// # Errors
    /// Any failure of the driver since the last check.
    pub(super) fn finish(
        &self,
        gpu: &Gpu,
        encoder: wgpu::CommandEncoder,
    ) -> Result<RenderedImage, RenderError> {
        let PictureBuffers { width, height, ref resolved, .. } = self.buffers;
        self.readback.finish(gpu, encoder, resolved, |rows, bytes_per_row| {
            RenderedImage::from_see_through_rows(width, height, rows, bytes_per_row)
        })
    }
}
