//! What all passes of a picture share: the frame, the light and the shadow maps, in bind group 0.

use super::frame::FrameUniform;
use super::gpu::Gpu;
use super::light::{LightUniform, SKY_LAMPS, SKY_MAP_SIZE, SUN_MAP_SIZE};
use super::pipeline::{DEPTH_FORMAT, entry, texture, uniform};
use wgpu::{ShaderStages, TextureSampleType, TextureViewDimension};

/// Shadow maps and uniforms, kept from picture to picture.
pub(super) struct Scene {
    pub(super) layout: wgpu::BindGroupLayout,
    pub(super) group: wgpu::BindGroup,
    /// One map per lamp in the order of [`LightUniform::lamps`].
    pub(super) maps: Vec<wgpu::TextureView>,
    frame: wgpu::Buffer,
    light: wgpu::Buffer,
}

impl Scene {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let layout = layout(gpu);
        let frame = uniform_buffer(gpu, "frame", size_of::<FrameUniform>());
        let light = uniform_buffer(gpu, "light", size_of::<LightUniform>());
        let sun = shadow_map(gpu, "sun", SUN_MAP_SIZE, 1);
        let sky = shadow_map(gpu, "sky", SKY_MAP_SIZE, SKY_LAMPS as u32);
        let sun_view = sun.create_view(&Default::default());
        let sky_view = sky.create_view(&Default::default());
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("shadow"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            compare: Some(wgpu::CompareFunction::LessEqual),
            ..Default::default()
        });
        let resources = [
            frame.as_entire_binding(),
            light.as_entire_binding(),
            wgpu::BindingResource::Sampler(&sampler),
            wgpu::BindingResource::TextureView(&sun_view),
            wgpu::BindingResource::TextureView(&sun_view),
            wgpu::BindingResource::TextureView(&sky_view),
        ];
        let entries: Vec<_> = (0..)
            .zip(resources)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("scene"),
            layout: &layout,
            entries: &entries,
        });
        let layer = |i| wgpu::TextureViewDescriptor {
            dimension: Some(TextureViewDimension::D2),
            base_array_layer: i,
            array_layer_count: Some(1),
            ..Default::default()
        };
        let mut maps: Vec<_> = (0..SKY_LAMPS as u32).map(|i| sky.create_view(&layer(i))).collect();
        maps.push(sun_view);
        Self { layout, group, maps, frame, light }
    }

    /// Sets the view and the light of the next picture.
    pub(super) fn set(&self, gpu: &Gpu, frame: &FrameUniform, light: &LightUniform) {
        gpu.queue.write_buffer(&self.frame, 0, bytemuck::bytes_of(frame));
        gpu.queue.write_buffer(&self.light, 0, bytemuck::bytes_of(light));
    }
}

fn layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let both = ShaderStages::VERTEX_FRAGMENT;
    let fragment = ShaderStages::FRAGMENT;
    let raw = TextureSampleType::Float { filterable: false };
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("scene"),
        entries: &[
            entry(0, both, uniform(size_of::<FrameUniform>(), false)),
            entry(1, fragment, uniform(size_of::<LightUniform>(), false)),
            entry(2, fragment, wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison)),
            entry(3, fragment, texture(TextureSampleType::Depth, TextureViewDimension::D2)),
            entry(4, fragment, texture(raw, TextureViewDimension::D2)),
            entry(5, fragment, texture(TextureSampleType::Depth, TextureViewDimension::D2Array)),
        ],
    })
}

fn uniform_buffer(gpu: &Gpu, label: &str, size: usize) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: size as u64,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

fn shadow_map(gpu: &Gpu, label: &str, size: u32, layers: u32) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: size, height: size, depth_or_array_layers: layers },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: DEPTH_FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    })
}
