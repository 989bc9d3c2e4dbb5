//! The canvas of the window: paper, a picture to trace, and the strokes, drawn live at any zoom.
//!
//! A [`CanvasLayer`] paints into a render pass of the window itself, inside whatever scissor rectangle is set there; the
//! pass must have one sample, no depth, and a viewport over the whole framebuffer. Colours are encoded sRGB and are blended
//! that way, as the user interface around the canvas is.
//!
//! | file | what |
//! | --- | --- |
//! | `blocks` | where the lines lie, for painting a small place |
//! | `curve` | samples to a smooth line, one sample at a time |
//! | `ink` | all lines in one array, and what of it changed |
//! | `reference` | the picture under the drawing |
//!
//! `curve` and `ink` know no GPU: what a sample costs the processor can be measured on them alone. Limits: ink is drawn over
//! what is below, so a see-through stroke is darker where it crosses itself.

mod blocks;
mod curve;
mod ink;
mod reference;

pub use curve::StrokeCurve;
pub use ink::{InkBuffer, InkChange, InkPoint};

use super::gpu::Gpu;
use super::pipeline::{Into, PipelineSpec};
use super::uniform::Uniform;
use super::{RenderError, shaders};
use crate::picture::decode::Rgba;
use blocks::Blocks;
use bytemuck::{Pod, Zeroable};
use glam::{Affine2, Vec2, Vec3, Vec4};
use reference::Reference;

/// Points that the first buffer holds.
const FIRST_CAPACITY: usize = 1 << 14;
/// Points that a piece of a stroke looks at: its ends and their neighbours.
const POINTS_PER_PIECE: usize = 4;
/// How far a line's smooth edge, and the least width of a line, reach beyond its radius at most, pixels.
const EDGE_PX: f32 = 2.0;

/// Where the canvas is seen, and on what.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CanvasView {
    /// Canvas to framebuffer pixels, x right, y down; rotation, even scale and shift.
    pub pixel_from_canvas: Affine2,
    /// Width and height of the framebuffer in pixels.
    pub framebuffer: (u32, u32),
    /// Encoded colour of the sheet.
    pub paper: [u8; 3],
    /// Encoded colour around the sheet.
    pub surround: [u8; 3],
    /// Width and height of the sheet in canvas units; `None` for a sheet without end.
    pub sheet: Option<Vec2>,
    /// Factor on the width of all lines; 1 shows them as wide on the canvas as they are.
    pub line_scale: f32,
}

impl CanvasView {
    /// Smallest and largest corner of the canvas that a place shows: left, top, width, height, pixels.
    fn canvas_bounds(&self, [left, top, width, height]: [u32; 4]) -> blocks::Bounds {
        let (low, size) = (Vec2::new(left as f32, top as f32), Vec2::new(width as f32, height as f32));
        let canvas_from_pixel = self.pixel_from_canvas.inverse();
        let corners = [Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::ONE];
        let corners = corners.map(|corner| canvas_from_pixel.transform_point2(low + size * corner));
        corners.iter().fold((corners[0], corners[0]), |(low, high), c| (low.min(*c), high.max(*c)))
    }
}

/// `Sheet` in `canvas.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct SheetUniform {
    clip_from_pixel: Vec4,
    pixel_axes: Vec4,
    pixel_origin: Vec4,
    canvas_axes: Vec4,
    canvas_origin: Vec4,
    paper: Vec4,
    surround: Vec4,
    size: Vec4,
}

impl SheetUniform {
    fn new(view: &CanvasView, decode: bool) -> Self {
        let to_pixel = view.pixel_from_canvas;
        let to_canvas = to_pixel.inverse();
        let axes = |m: &Affine2| Vec4::from((m.matrix2.x_axis, m.matrix2.y_axis));
        let scale = to_pixel.matrix2.determinant().abs().sqrt();
        let framebuffer = Vec2::new(view.framebuffer.0.max(1) as f32, view.framebuffer.1.max(1) as f32);
        let colour = |rgb: [u8; 3]| (Vec3::from(rgb.map(f32::from)) / 255.0).extend(1.0);
        Self {
            clip_from_pixel: Vec4::from((Vec2::new(2.0, -2.0) / framebuffer, Vec2::new(-1.0, 1.0))),
            pixel_axes: axes(&to_pixel),
            pixel_origin: to_pixel.translation.extend(scale).extend(f32::from(u8::from(decode))),
            canvas_axes: axes(&to_canvas),
            canvas_origin: to_canvas.translation.extend(0.0).extend(0.0),
            paper: colour(view.paper),
            surround: colour(view.surround),
            size: view.sheet.unwrap_or(Vec2::ZERO).extend(view.line_scale).extend(0.0),
        }
    }
}

/// The drawing on the GPU.
pub struct CanvasLayer {
    /// The strokes; the next [`CanvasLayer::prepare`] sends what changed of them.
    pub ink: InkBuffer,
    /// Points as `stroke.wgsl` reads them, with room to grow.
    points: wgpu::Buffer,
    capacity: usize,
    sheet: Uniform<SheetUniform>,
    paper: wgpu::RenderPipeline,
    strokes: wgpu::RenderPipeline,
    reference: Reference,
    /// Whether the target decodes sRGB by itself.
    decode: bool,
    /// How many points [`CanvasLayer::paint`] draws.
    ready: usize,
    /// Where those points lie.
    blocks: Blocks,
    /// The view of the next [`CanvasLayer::paint`].
    view: Option<CanvasView>,
}

impl CanvasLayer {
    /// An empty drawing for a window whose surface has this format.
    ///
    /// # Errors
    /// A failure of the driver.
    pub fn new(gpu: &Gpu, target: wgpu::TextureFormat) -> Result<Self, RenderError> {
        let sheet: Uniform<SheetUniform> = Uniform::new(gpu, "canvas");
        let paper = PipelineSpec {
            label: "paper",
            wgsl: shaders::PAPER,
            groups: &[&sheet.layout],
            buffers: &[],
            topology: wgpu::PrimitiveTopology::TriangleList,
            cull: false,
            fragment: true,
            into: Into::Window(target),
            constants: &[],
        }
        .build(gpu);
        let layer = Self {
            ink: InkBuffer::default(),
            points: point_buffer(gpu, FIRST_CAPACITY),
            capacity: FIRST_CAPACITY,
            strokes: stroke_pipeline(gpu, &sheet.layout, target),
            reference: Reference::new(gpu, &sheet.layout, target),
            sheet,
            paper,
            decode: target.is_srgb(),
            ready: 0,
            blocks: Blocks::default(),
            view: None,
        };
        gpu.check()?;
        Ok(layer)
    }

    /// The picture under the drawing, or none.
    ///
    /// # Errors
    /// A picture larger than the device's textures, or a failure of the driver.
    pub fn set_reference(&mut self, gpu: &Gpu, picture: Option<&Rgba>) -> Result<(), RenderError> {
        self.reference.set(gpu, picture)
    }

    /// Where that picture lies, from a square of side 1 (y down) to the canvas, and how opaque it is, 0 to 1.
    pub fn place_reference(&mut self, canvas_from_unit: Affine2, opacity: f32) {
        self.reference.place(canvas_from_unit, opacity);
    }

    /// Sends what changed to the GPU and sets the view of the next [`CanvasLayer::paint`]. Returns how many bytes of
    /// strokes were sent.
    ///
    /// # Errors
    /// A failure of the driver, such as too little memory; the strokes are kept and sent again by the next call.
    pub fn prepare(&mut self, gpu: &Gpu, view: &CanvasView) -> Result<u64, RenderError> {
        let sheet = SheetUniform::new(view, self.decode);
        self.sheet.set(gpu, &sheet);
        self.reference.prepare(gpu);
        let points = self.ink.points().len();
        if points > self.capacity {
            self.capacity = points.next_power_of_two();
            self.points = point_buffer(gpu, self.capacity);
            self.ink.touch_all();
        }
        let mut bytes = 0;
        for range in self.ink.take_dirty() {
            let range = range.start.min(points)..range.end.min(points);
            self.blocks.update(self.ink.points(), range.clone());
            let run: &[u8] = bytemuck::cast_slice(&self.ink.points()[range.clone()]);
            gpu.queue.write_buffer(&self.points, (range.start * size_of::<InkPoint>()) as u64, run);
            bytes += run.len() as u64;
        }
        self.ready = points;
        self.view = Some(*view);
        gpu.check().inspect_err(|_| {
            self.ink.touch_all();
            self.capacity = 0;
            self.ready = 0;
        })?;
        Ok(bytes)
    }

    /// Paints paper, picture and strokes as prepared.
    pub fn paint(&self, pass: &mut wgpu::RenderPass<'_>) {
        let (width, height) = self.view.map_or((0, 0), |view| view.framebuffer);
        self.paint_paper(pass);
        self.paint_drawing(pass, [0, 0, width, height]);
    }

    /// Paints the paper alone, over everything.
    pub fn paint_paper(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_bind_group(0, &self.sheet.group, &[]);
        pass.set_pipeline(&self.paper);
        pass.draw(0..3, 0..1);
    }

    /// Paints the picture, and the strokes that may be seen in a place of the framebuffer: left, top, width, height, pixels.
    /// What it paints beyond that place is not complete.
    pub fn paint_drawing(&self, pass: &mut wgpu::RenderPass<'_>, place: [u32; 4]) {
        pass.set_bind_group(0, &self.sheet.group, &[]);
        self.reference.paint(pass);
        let (Some(pieces), Some(view)) = (self.ready.checked_sub(POINTS_PER_PIECE - 1), &self.view) else {
            return;
        };
        pass.set_pipeline(&self.strokes);
        for slot in 0..POINTS_PER_PIECE {
            pass.set_vertex_buffer(slot as u32, self.points.slice((slot * size_of::<InkPoint>()) as u64..));
        }
        let zoom = view.pixel_from_canvas.matrix2.determinant().abs().sqrt();
        let ranges = self.blocks.within(pieces, view.canvas_bounds(place), view.line_scale, EDGE_PX / zoom);
        for range in ranges {
            pass.draw(0..4, range.start as u32..range.end as u32);
        }
    }
}

fn point_buffer(gpu: &Gpu, capacity: usize) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("strokes"),
        size: (capacity * size_of::<InkPoint>()) as u64,
        usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

fn stroke_pipeline(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    target: wgpu::TextureFormat,
) -> wgpu::RenderPipeline {
    // The same points four times, each time one point further on.
    let points = |attributes| wgpu::VertexBufferLayout {
        array_stride: size_of::<InkPoint>() as u64,
        step_mode: wgpu::VertexStepMode::Instance,
        attributes,
    };
    PipelineSpec {
        label: "stroke",
        wgsl: shaders::STROKE,
        groups: &[layout],
        buffers: &[
            points(&wgpu::vertex_attr_array![0 => Float32x3]),
            points(&wgpu::vertex_attr_array![1 => Float32x3, 4 => Unorm8x4]),
            points(&wgpu::vertex_attr_array![2 => Float32x3]),
            points(&wgpu::vertex_attr_array![3 => Float32x3]),
        ],
        topology: wgpu::PrimitiveTopology::TriangleStrip,
        cull: false,
        fragment: true,
        into: Into::Window(target),
        constants: &[],
    }
    .build(gpu)
}
