//! Debugging views: every part in a colour that says what it is, and the edges of its triangles.
//!
//! Colours go by the kind of part, branches by their level; parts of one kind differ a little. Limits: cut-outs show whole.

use super::gpu::Gpu;
use super::pipeline::{Into, PipelineSpec};
use super::pool::Pool;
use super::scene::SceneLayout;
use super::shaders;
use super::surface::VERTEX_LAYOUT;
use crate::checksum::fnv1a;
use crate::model::PartKind;

/// Colour of a part, encoded red, green, blue, and one unused byte.
pub(super) type Tint = [u8; 4];

/// Layout of a vertex buffer of tints.
const TINT_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Tint>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![3 => Unorm8x4],
};

/// Colours of branches by level, the last for all further levels.
const WOOD: [[u8; 3]; 5] = [[140, 86, 46], [201, 128, 52], [222, 170, 74], [232, 200, 112], [240, 220, 150]];
/// How much parts of one kind differ in brightness, of 256.
const VARIETY: u32 = 56;

/// The colour of a part: by what it is, for branches by `level`, varied by its name.
pub(super) fn tint(kind: PartKind, level: usize, name: &str) -> Tint {
    let base = match kind {
        PartKind::Wood => WOOD[level.min(WOOD.len() - 1)],
        PartKind::Organ(organ) => organ.tint(),
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
                buffers: &[VERTEX_LAYOUT, TINT_LAYOUT],
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

    /// Draws the faces of a pool's parts into a pass with the scene's bind group already set.
    pub(super) fn draw_faces(&self, pass: &mut wgpu::RenderPass<'_>, pool: &Pool) {
        pass.set_pipeline(&self.faces);
        pool.bind_corners(pass);
        pass.set_index_buffer(pool.indices().slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(pool.index_range(), 0, 0..1);
    }

    /// Draws edges, given as pairs of a pool's corners.
    pub(super) fn draw_edges(&self, pass: &mut wgpu::RenderPass<'_>, pool: &Pool, edges: &wgpu::Buffer) {
        pass.set_pipeline(&self.edges);
        pool.bind_corners(pass);
        pass.set_index_buffer(edges.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..(edges.size() / size_of::<u32>() as u64) as u32, 0, 0..1);
    }
}
