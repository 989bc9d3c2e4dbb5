//! Backdrop and ground: a sheet of paper without horizon that catches the plant's shadow.

use super::gpu::Gpu;
use super::pipeline::{Into, PipelineSpec};
use super::scene::SceneLayout;
use super::shaders;

/// Fills the picture with paper and shadow, behind everything.
pub(super) struct GroundRenderer {
    pipeline: wgpu::RenderPipeline,
}

impl GroundRenderer {
    /// `taps` are constants of `light.wgsl` and `ground.wgsl`.
    pub(super) fn new(gpu: &Gpu, scene: &SceneLayout, taps: &[(&str, f64)]) -> Self {
        let pipeline = PipelineSpec {
            label: "ground",
            wgsl: shaders::GROUND,
            groups: &[&scene.layout],
            buffers: &[],
            topology: wgpu::PrimitiveTopology::TriangleList,
            cull: false,
            fragment: true,
            into: Into::Picture {
                blend: wgpu::BlendComponent::REPLACE,
                solid: false,
                coverage_from_alpha: false,
            },
            constants: taps,
        }
        .build(gpu);
        Self { pipeline }
    }

    /// Draws into a pass with the scene's bind group already set.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_pipeline(&self.pipeline);
        pass.draw(0..3, 0..1);
    }
}
