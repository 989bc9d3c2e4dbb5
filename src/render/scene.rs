//! What all passes of a picture share: the frame, the light and the shadow maps, in bind group 0.

use super::frame::FrameUniform;
use super::gpu::Gpu;
use super::light::{LightUniform, SKY_LAMPS, SKY_MAP_SIZE};
use super::pipeline::{DEPTH_FORMAT, entry, texture, uniform};
use wgpu::{ShaderStages, TextureSampleType, TextureViewDimension};

/// What all scenes share.
pub(super) struct SceneLayout {
    pub(super) layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
}

impl SceneLayout {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("shadow"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            compare: Some(wgpu::CompareFunction::LessEqual),
            ..Default::default()
        });
        Self { layout: layout(gpu), sampler }
    }
}

/// The sky lamps' shadow maps.
pub(super) struct SkyMaps {
    all: wgpu::TextureView,
    each: Vec<wgpu::TextureView>,
}

impl SkyMaps {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let maps = shadow_map(gpu, "sky", SKY_MAP_SIZE, SKY_LAMPS as u32);
        let layer = |i| wgpu::TextureViewDescriptor {
            dimension: Some(TextureViewDimension::D2),
            base_array_layer: i,
            array_layer_count: Some(1),
            ..Default::default()
        };
        let each = (0..SKY_LAMPS as u32).map(|i| maps.create_view(&layer(i))).collect();
        Self { all: maps.create_view(&Default::default()), each }
    }
}

/// Shadow maps and uniforms, kept from picture to picture.
pub(super) struct Scene {
    pub(super) group: wgpu::BindGroup,
    /// One map per lamp in the order of [`LightUniform::lamps`].
    pub(super) maps: Vec<wgpu::TextureView>,
    /// Width of the sun's map in texels.
    pub(super) sun_map_size: u32,
    frame: wgpu::Buffer,
    light: wgpu::Buffer,
}

impl Scene {
    /// A scene with a sun's map of its own; the sky's maps may be shared with other scenes.
    pub(super) fn new(gpu: &Gpu, layout: &SceneLayout, sky: &SkyMaps, sun_map_size: u32) -> Self {
        let frame = uniform_buffer(gpu, "frame", size_of::<FrameUniform>());
        let light = uniform_buffer(gpu, "light", size_of::<LightUniform>());
        let sun = shadow_map(gpu, "sun", sun_map_size, 1).create_view(&Default::default());
        let resources = [
            frame.as_entire_binding(),
            light.as_entire_binding(),
            wgpu::BindingResource::Sampler(&layout.sampler),
            wgpu::BindingResource::TextureView(&sun),
            wgpu::BindingResource::TextureView(&sun),
            wgpu::BindingResource::TextureView(&sky.all),
        ];
        let entries: Vec<_> = (0..)
            .zip(resources)
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("scene"),
            layout: &layout.layout,
            entries: &entries,
        });
        let maps = sky.each.iter().cloned().chain([sun]).collect();
        Self { group, maps, sun_map_size, frame, light }
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
            entry(1, both, uniform(size_of::<LightUniform>(), false)),
            entry(2, both, wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison)),
            entry(3, fragment, texture(TextureSampleType::Depth, TextureViewDimension::D2)),
            entry(4, fragment, texture(raw, TextureViewDimension::D2)),
            entry(5, both, texture(TextureSampleType::Depth, TextureViewDimension::D2Array)),
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
