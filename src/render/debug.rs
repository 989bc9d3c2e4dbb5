//! Debugging views: every part in a colour that says what it is, and the edges of its triangles.
//!
//! Colours go by the kind of part, branches by their level; parts of one kind differ a little. Limits: cut-outs show whole.

use super::corner::{CORNER_LAYOUT, Tint};
use super::drawn::{Drawn, PLACEMENT_LAYOUT};
use super::gpu::Gpu;
use super::pipeline::{Into, PipelineSpec};
use super::scene::SceneLayout;
use super::shaders;
use crate::checksum::fnv1a;
use crate::model::PartKind;

/// Layout of a vertex buffer of tints.
const TINT_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Tint>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![3 => Unorm8x4],
};

/// Colours of branches by level, the last for all further levels.
const WOOD: [[u8; 3]; 5] = [[140, 86, 46], [201, 128, 52], [222, 170, 74], [232, 200, 112], [240, 220, 150]];
/// Colour of a garden's ground.
const GROUND: [u8; 3] = [120, 130, 112];
/// How much parts of one kind differ in brightness, of 256.
const VARIETY: u32 = 56;

/// The colour of a part: by what it is, for branches by `level`, varied by its name.
pub(super) fn tint(kind: PartKind, level: usize, name: &str) -> Tint {
    let base = match kind {
        PartKind::Wood => WOOD[level.min(WOOD.len() - 1)],
        PartKind::Organ(organ) => organ.tint(),
        PartKind::Ground => GROUND,
    };
    let number = fnv1a(name);
    let brightness = 256 - (number >> 8) % VARIETY;
    let [r, g, b] = base.map(|c| (u32::from(c) * brightness / 256) as u8);
    [r, g, b, 255]
}

/// Draws debugging views.
pub(super) struct DebugRenderer {
    faces: wgpu::RenderPipeline,
    edges: wgpu::RenderPipeline,
}

impl DebugRenderer {
    pub(super) fn new(gpu: &Gpu, scenes: &SceneLayout) -> Self {
        let build = |topology, constants| {
            PipelineSpec {
                label: "debug",
                wgsl: shaders::DEBUG,
                groups: &[&scenes.layout],
                buffers: &[CORNER_LAYOUT, PLACEMENT_LAYOUT, TINT_LAYOUT],
                topology,
                cull: false,
                fragment: true,
                into: Into::Picture {
                    blend: wgpu::BlendComponent::REPLACE,
                    solid: true,
                    coverage_from_alpha: false,
                },
                constants,
            }
            .build(gpu)
        };
        Self {
            faces: build(wgpu::PrimitiveTopology::TriangleList, &[]),
            edges: build(wgpu::PrimitiveTopology::LineList, &[("LINES", 1.0)]),
        }
    }

    /// Draws faces into a pass with the scene's bind group already set.
    pub(super) fn draw_faces(&self, pass: &mut wgpu::RenderPass<'_>, faces: &Drawn, tints: &wgpu::Buffer) {
        pass.set_pipeline(&self.faces);
        pass.set_vertex_buffer(2, tints.slice(..));
        faces.draw(pass);
    }

    /// Draws edges, given as pairs of corners.
    pub(super) fn draw_edges(&self, pass: &mut wgpu::RenderPass<'_>, edges: &Drawn, tints: &wgpu::Buffer) {
        pass.set_pipeline(&self.edges);
        pass.set_vertex_buffer(2, tints.slice(..));
        edges.draw(pass);
    }
}
