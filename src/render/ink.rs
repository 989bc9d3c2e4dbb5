//! A drawing as ink on paper: the strokes as the pen left them, thicker where it pressed.
//!
//! Every segment of a stroke is one instance of a tapered capsule, so that joins and ends are round without any tessellation;
//! `ink.wgsl` computes coverage from distance. Limits: ink is opaque and always on paper.

use super::gpu::Gpu;
use super::pipeline::{Into, PipelineSpec};
use super::uniform::Uniform;
use super::{RenderError, shaders, studio};
use crate::sketch::{Sketch, Stroke, StrokePoint};
use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3, Vec4};

/// Share of the full line width that the lightest touch draws.
const LIGHTEST: f32 = 0.25;

/// Ends of a segment: canvas position and radius.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Segment {
    begin: Vec3,
    end: Vec3,
}

/// `Sheet` in `ink.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct SheetUniform {
    clip_from_canvas: Vec4,
    ink: Vec4,
}

/// One uploaded drawing.
pub(super) struct InkDrawData {
    segments: wgpu::Buffer,
    count: u32,
    bounds: (Vec2, Vec2),
}

impl InkDrawData {
    /// Uploads the strokes of a drawing.
    ///
    /// # Errors
    /// A drawing without samples.
    pub(super) fn new(gpu: &Gpu, sketch: &Sketch) -> Result<Self, RenderError> {
        let bounds = sketch.bounds().ok_or(RenderError::Empty { what: "the drawing" })?;
        let radius = studio::INK_RADIUS * sketch.diagonal().max(1e-6);
        let segments: Vec<Segment> = sketch.strokes.iter().flat_map(|s| segments(s, radius)).collect();
        let buffer = gpu.buffer("ink", bytemuck::cast_slice(&segments), wgpu::BufferUsages::VERTEX);
        Ok(Self { segments: buffer, count: segments.len() as u32, bounds })
    }
}

/// The capsules of one stroke; a single sample is a dot.
fn segments(stroke: &Stroke, full_radius: f32) -> impl Iterator<Item = Segment> {
    let end = move |p: &StrokePoint| {
        let width = LIGHTEST + (1.0 - LIGHTEST) * p.pressure.clamp(0.0, 1.0);
        p.position.extend(full_radius * width)
    };
    let dot = stroke.points.first().filter(|_| stroke.points.len() == 1);
    let dot = dot.into_iter().map(move |p| Segment { begin: end(p), end: end(p) });
    dot.chain(stroke.points.windows(2).map(move |w| Segment { begin: end(&w[0]), end: end(&w[1]) }))
}

/// Draws ink over whatever is in the picture.
pub(super) struct InkRenderer {
    pipeline: wgpu::RenderPipeline,
    sheet: Uniform<SheetUniform>,
}

impl InkRenderer {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let sheet = Uniform::new(gpu, "ink");
        let darkest = wgpu::BlendComponent {
            src_factor: wgpu::BlendFactor::One,
            dst_factor: wgpu::BlendFactor::One,
            operation: wgpu::BlendOperation::Min,
        };
        let instances = wgpu::VertexBufferLayout {
            array_stride: size_of::<Segment>() as u64,
            step_mode: wgpu::VertexStepMode::Instance,
            attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3],
        };
        let pipeline = PipelineSpec {
            label: "ink",
            wgsl: shaders::INK,
            groups: &[&sheet.layout],
            buffers: &[instances],
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            cull: false,
            fragment: true,
            into: Into::Picture { blend: darkest, solid: false, coverage_from_alpha: false },
            constants: &[],
        }
        .build(gpu);
        Self { pipeline, sheet }
    }

    /// Fits the next drawing into a picture of `size` pixels.
    pub(super) fn set(&self, gpu: &Gpu, ink: &InkDrawData, size: Vec2) {
        let (lo, hi) = ink.bounds;
        let extent = (hi - lo).max(Vec2::splat(1e-3 * (hi - lo).max_element().max(1e-6)));
        let canvas_per_px = (extent / (size * (1.0 - studio::MARGIN))).max_element();
        let scale = Vec2::new(2.0, -2.0) / (size * canvas_per_px);
        let offset = -(lo + hi) / 2.0 * scale;
        let sheet = SheetUniform {
            clip_from_canvas: Vec4::new(scale.x, scale.y, offset.x, offset.y),
            ink: studio::INK.extend(canvas_per_px),
        };
        self.sheet.set(gpu, &sheet);
    }

    /// Draws into the picture.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, ink: &InkDrawData) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.sheet.group, &[]);
        pass.set_vertex_buffer(0, ink.segments.slice(..));
        pass.draw(0..4, 0..ink.count);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sketch::Tool;

    fn stroke(pressures: &[f32]) -> Stroke {
        let sample = |(i, &pressure): (usize, &f32)| StrokePoint {
            pressure,
            ..StrokePoint::at(Vec2::new(i as f32, 0.0))
        };
        Stroke {
            id: 1,
            tool: Tool::Auto,
            points: pressures.iter().enumerate().map(sample).collect(),
            brush: None,
        }
    }

    #[test]
    fn pressure_widens_the_line() {
        let capsules: Vec<Segment> = segments(&stroke(&[0.0, 1.0, 7.0]), 2.0).collect();
        assert_eq!(capsules.len(), 2);
        assert_eq!([capsules[0].begin.z, capsules[0].end.z], [0.5, 2.0]);
        assert_eq!(capsules[1].end.z, 2.0, "pressure beyond full counts as full");
    }

    #[test]
    fn a_single_sample_is_a_dot() {
        let capsules: Vec<Segment> = segments(&stroke(&[1.0]), 2.0).collect();
        assert_eq!(capsules.len(), 1);
        assert_eq!(capsules[0].begin, capsules[0].end);
        assert_eq!(segments(&stroke(&[]), 2.0).count(), 0);
    }
}
