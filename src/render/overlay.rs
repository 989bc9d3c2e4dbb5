//! What growth looks like from inside, over the plant: markers, buds, light.
//!
//! Each spot is one instance of four corners: a disc toward the eye, or the line from a bud to where it will go. All are
//! drawn twice, first faintly without regard to depth, then where nothing stands before them. Limits: faint spots are laid
//! over each other in no order of depth.

use super::gpu::Gpu;
use super::pipeline::{Into, PipelineSpec};
use super::scene::SceneLayout;
use super::shaders;
use crate::growth::overlay::{Kind, Spot};
use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// Encoded red, green, blue and opacity of markers and buds: blue against orange, which everybody tells apart.
const FREE: [u8; 4] = [70, 150, 235, 255];
const TAKEN: [u8; 4] = [232, 132, 40, 255];
const ACTIVE: [u8; 4] = [240, 60, 160, 255];
const DORMANT: [u8; 4] = [172, 140, 204, 255];
/// Red, green and blue of light at evenly spaced shares of full light: none is dim, all is bright.
const LIGHT: [[f32; 3]; 4] =
    [[24.0, 12.0, 110.0], [140.0, 30.0, 150.0], [236.0, 110.0, 70.0], [255.0, 226.0, 60.0]];

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

/// What is drawn of each spot.
fn instances(spots: &[Spot]) -> Vec<Instance> {
    let mut out = Vec::with_capacity(spots.len());
    for &Spot { at, radius, kind } in spots {
        let mut put = |way, colour| out.push(Instance { at, radius, way, colour });
        match kind {
            Kind::Free => put(Vec3::ZERO, FREE),
            Kind::Taken => put(Vec3::ZERO, TAKEN),
            Kind::Active { way } => {
                put(way, ACTIVE);
                put(Vec3::ZERO, ACTIVE);
            }
            Kind::Dormant { way } => {
                put(way, DORMANT);
                put(Vec3::ZERO, DORMANT);
            }
            Kind::Light { exposure } => put(Vec3::ZERO, of_light(exposure)),
        }
    }
    out
}

fn of_light(exposure: f32) -> [u8; 4] {
    let place = exposure.clamp(0.0, 1.0) * (LIGHT.len() - 1) as f32;
    let below = (place as usize).min(LIGHT.len() - 2);
    let at = |k: usize| {
        let (from, to) = (LIGHT[below][k], LIGHT[below + 1][k]);
        (from + (to - from) * (place - below as f32)) as u8
    };
    [at(0), at(1), at(2), 255]
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
    fn a_bud_is_a_disc_and_a_line_and_light_is_brighter_than_shade() {
        let bud = Kind::Active { way: Vec3::Y };
        let spots = [Kind::Free, bud, Kind::Light { exposure: 0.4 }];
        let drawn = instances(&spots.map(|kind| Spot { at: Vec3::X, radius: 0.1, kind }));
        assert_eq!(drawn.iter().filter(|one| one.way == Vec3::ZERO).count(), 3);
        assert_eq!(drawn.iter().filter(|one| one.way == Vec3::Y).count(), 1);
        let sum = |exposure| of_light(exposure)[..3].iter().map(|c| u32::from(*c)).sum::<u32>();
        assert!(sum(0.0) < sum(0.5) && sum(0.5) < sum(1.0));
    }
}
