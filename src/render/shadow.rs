//! Shadow maps: the plant's depth as each lamp sees it.

use super::corner::CORNER_LAYOUT;
use super::drawn::PLACEMENT_LAYOUT;
use super::gpu::Gpu;
use super::light::{Lamp, SKY_LAMPS};
use super::material::MaterialLayout;
use super::pipeline::{Into, PipelineSpec, entry, uniform};
use super::shaders;
use super::surface::SurfaceDrawData;
use glam::Mat4;

/// Lamps with a map.
const LAMPS: usize = SKY_LAMPS + 1;
/// Distance between two lamps' matrices in their buffer: the coarsest alignment a device may ask for.
const STRIDE: usize = 256;

/// Draws surfaces into shadow maps.
pub(super) struct ShadowRenderer {
    solid: wgpu::RenderPipeline,
    cut_out: wgpu::RenderPipeline,
    matrices: wgpu::Buffer,
    group: wgpu::BindGroup,
}

impl ShadowRenderer {
    pub(super) fn new(gpu: &Gpu, materials: &MaterialLayout) -> Self {
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("shadow"),
            entries: &[entry(0, wgpu::ShaderStages::VERTEX, uniform(size_of::<Mat4>(), true))],
        });
        let matrices = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("lamps"),
            size: (LAMPS * STRIDE) as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let matrix = wgpu::BufferBinding {
            buffer: &matrices,
            offset: 0,
            size: wgpu::BufferSize::new(size_of::<Mat4>() as u64),
        };
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("shadow"),
            layout: &layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::Buffer(matrix) }],
        });
        let build = |fragment| {
            PipelineSpec {
                label: "shadow",
                wgsl: shaders::SHADOW,
                groups: &[&layout, &materials.layout],
                buffers: &[CORNER_LAYOUT, PLACEMENT_LAYOUT],
                topology: wgpu::PrimitiveTopology::TriangleList,
                cull: false,
                fragment,
                into: Into::ShadowMap,
                constants: &[],
            }
            .build(gpu)
        };
        Self { solid: build(false), cut_out: build(true), matrices, group }
    }

    /// Draws the maps of some lamps, each given with its number among all lamps, the sun's last.
    pub(super) fn draw<'a>(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        lamps: impl Iterator<Item = (usize, &'a Lamp, &'a wgpu::TextureView)>,
        surface: &SurfaceDrawData,
    ) {
        for (i, lamp, map) in lamps {
            let offset = (i * STRIDE) as u32;
            gpu.queue.write_buffer(&self.matrices, offset.into(), bytemuck::bytes_of(&lamp.lamp_from_world));
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("shadow"),
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: map,
                    depth_ops: Some(wgpu::Operations {
                        load: wgpu::LoadOp::Clear(1.0),
                        store: wgpu::StoreOp::Store,
                    }),
                    stencil_ops: None,
                }),
                ..Default::default()
            });
            pass.set_bind_group(0, &self.group, &[offset]);
            surface.draw_all(&mut pass, [&self.solid, &self.cut_out]);
        }
    }
}
