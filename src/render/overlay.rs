//! Spots and lines over the model, such as the markers, buds and light of a plant that grew.
//!
//! Each disc and each line is one instance of four corners; discs face the eye. All are
//! drawn twice, first faintly without regard to depth, then where nothing stands before them. Limits: faint spots are laid
//! over each other in no order of depth.

use super::gpu::Gpu;
use super::pipeline::{Into, PipelineSpec};
use super::scene::SceneLayout;
use super::shaders;
use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// A disc drawn over the model, and a line that begins there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Middle of the disc and beginning of the line, metres.
    pub at: Vec3,
    /// Radius of the disc, metres.
    pub radius: f32,
    /// From the beginning of the line to its end, metres; `None` for the disc alone.
    pub line: Option<Vec3>,
    /// Encoded red, green, blue and opacity.
    pub colour: [u8; 4],
}

/// One instance; mirrors the inputs of `overlay.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Instance {
    at: Vec3,
    radius: f32,
    way: Vec3,
    colour: [u8; 4],
}

const INSTANCE_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Instance>() as u64,
    step_mode: wgpu::VertexStepMode::Instance,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32, 2 => Float32x3, 3 => Unorm8x4],
};

/// Spots on the GPU.
pub(super) struct OverlayDrawData {
    instances: wgpu::Buffer,
    count: u32,
}

impl OverlayDrawData {
    /// Nothing where there are no spots.
    pub(super) fn new(gpu: &Gpu, spots: &[Spot]) -> Option<Self> {
        let instances = instances(spots);
        if instances.is_empty() {
            return None;
        }
        let bytes: &[u8] = bytemuck::cast_slice(&instances);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("overlay"),
            size: bytes.len() as u64,
            usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        gpu.queue.write_buffer(&buffer, 0, bytes);
        Some(Self { instances: buffer, count: instances.len() as u32 })
    }
}

/// What is drawn of each spot: first its line, so that the disc lies on it.
fn instances(spots: &[Spot]) -> Vec<Instance> {
    let mut out = Vec::with_capacity(spots.len());
    for &Spot { at, radius, line, colour } in spots {
        out.extend(line.map(|way| Instance { at, radius, way, colour }));
        out.push(Instance { at, radius, way: Vec3::ZERO, colour });
    }
    out
}

/// Draws spots.
pub(super) struct OverlayRenderer {
    hidden: wgpu::RenderPipeline,
    seen: wgpu::RenderPipeline,
}

impl OverlayRenderer {
    pub(super) fn new(gpu: &Gpu, scenes: &SceneLayout) -> Self {
        let blend = wgpu::BlendState::ALPHA_BLENDING.color;
        let build = |solid, constants| {
            PipelineSpec {
                label: "overlay",
                wgsl: shaders::OVERLAY,
                groups: &[&scenes.layout],
                buffers: &[INSTANCE_LAYOUT],
                topology: wgpu::PrimitiveTopology::TriangleStrip,
                cull: false,
                fragment: true,
                into: Into::Picture { blend, solid, coverage_from_alpha: false },
                constants,
            }
            .build(gpu)
        };
        Self { hidden: build(false, &[("HIDDEN", 1.0)]), seen: build(true, &[]) }
    }

    /// Draws into a pass with the scene's bind group already set, after the plant.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, overlay: &OverlayDrawData) {
        pass.set_vertex_buffer(0, overlay.instances.slice(..));
        for pipeline in [&self.hidden, &self.seen] {
            pass.set_pipeline(pipeline);
            pass.draw(0..4, 0..overlay.count);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spot_with_a_line_is_a_line_under_a_disc() {
        let spot = Spot { at: Vec3::X, radius: 0.1, line: None, colour: [255; 4] };
        let drawn = instances(&[spot, Spot { line: Some(Vec3::Y), ..spot }]);
        assert_eq!(drawn.iter().map(|one| one.way).collect::<Vec<_>>(), [Vec3::ZERO, Vec3::Y, Vec3::ZERO]);
    }
}
