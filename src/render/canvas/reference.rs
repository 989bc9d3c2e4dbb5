//! The picture under the drawing, to be traced.

use super::super::decode::Rgba;
use super::super::gpu::Gpu;
use super::super::material::MaterialLayout;
use super::super::pipeline::{Into, PipelineSpec, entry, texture, uniform};
use super::super::{RenderError, shaders};
use bytemuck::{Pod, Zeroable};
use glam::{Affine2, Vec4};

/// `Placement` in `reference.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct PlacementUniform {
    axes: Vec4,
    origin: Vec4,
}

impl PlacementUniform {
    fn new(canvas_from_unit: &Affine2, opacity: f32) -> Self {
        let matrix = canvas_from_unit.matrix2;
        Self {
            axes: Vec4::from((matrix.x_axis, matrix.y_axis)),
            origin: canvas_from_unit.translation.extend(opacity.clamp(0.0, 1.0)).extend(0.0),
        }
    }
}

/// A picture on the canvas, or none.
pub(super) struct Reference {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    placement: PlacementUniform,
    uniform: wgpu::Buffer,
    group: Option<wgpu::BindGroup>,
}

impl Reference {
    pub(super) fn new(gpu: &Gpu, canvas: &wgpu::BindGroupLayout, target: wgpu::TextureFormat) -> Self {
        let fragment = wgpu::ShaderStages::FRAGMENT;
        let both = wgpu::ShaderStages::VERTEX_FRAGMENT;
        let colour = wgpu::TextureSampleType::Float { filterable: true };
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("reference"),
            entries: &[
                entry(0, both, uniform(size_of::<PlacementUniform>(), false)),
                entry(1, fragment, texture(colour, wgpu::TextureViewDimension::D2)),
                entry(2, fragment, wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering)),
            ],
        });
        let pipeline = PipelineSpec {
            label: "reference",
            wgsl: shaders::REFERENCE,
            groups: &[canvas, &layout],
            buffers: &[],
            topology: wgpu::PrimitiveTopology::TriangleStrip,
            cull: false,
            fragment: true,
            into: Into::Window(target),
            constants: &[],
        }
        .build(gpu);
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("reference"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            ..Default::default()
        });
        let uniform = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("placement"),
            size: size_of::<PlacementUniform>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let placement = PlacementUniform::new(&Affine2::IDENTITY, 1.0);
        Self { pipeline, layout, sampler, placement, uniform, group: None }
    }

    /// Another picture, or none.
    ///
    /// # Errors
    /// A picture larger than the device's textures or without pixels, or a failure of the driver.
    pub(super) fn set(&mut self, gpu: &Gpu, picture: Option<&Rgba>) -> Result<(), RenderError> {
        self.group = None;
        let Some(picture) = picture else { return Ok(()) };
        let limit = gpu.device.limits().max_texture_dimension_2d;
        let sides = 1..=limit;
        let whole = picture.pixels.len() == picture.width as usize * picture.height as usize * 4;
        if !sides.contains(&picture.width) || !sides.contains(&picture.height) || !whole {
            let reason =
                format!("it has {}×{} pixels; each side must be 1 to {limit}", picture.width, picture.height);
            return Err(RenderError::Texture { name: "under the drawing".to_owned(), reason });
        }
        let view = MaterialLayout::new(gpu).upload_picture(gpu, picture);
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("reference"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: self.uniform.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(&view) },
                wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Sampler(&self.sampler) },
            ],
        });
        gpu.check()?;
        self.group = Some(group);
        Ok(())
    }

    pub(super) fn place(&mut self, canvas_from_unit: Affine2, opacity: f32) {
        self.placement = PlacementUniform::new(&canvas_from_unit, opacity);
    }

    pub(super) fn prepare(&self, gpu: &Gpu) {
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&self.placement));
    }

    /// Paints into a pass with the canvas's bind group already set.
    pub(super) fn paint(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some(group) = self.group.as_ref().filter(|_| self.placement.origin.z > 0.0) else { return };
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(1, group, &[]);
        pass.draw(0..4, 0..1);
    }
}
