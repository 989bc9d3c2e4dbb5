//! Render pipelines and bind group layouts with everything they have in common said once.

use super::gpu::Gpu;

/// Samples per pixel of every picture.
pub(super) const SAMPLES: u32 = 4;
/// Format of pictures. The alpha channel holds the share that is seen *through*: 0 where anything was drawn, so that
/// alpha-to-coverage and blending never have to agree about it.
pub(super) const COLOUR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
/// Format of depth and shadow maps.
pub(super) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// What a pipeline draws into.
#[derive(Clone, Copy)]
pub(super) enum Into {
    /// The picture; colours combine by `blend`, depth is tested and written when `solid`.
    Picture { blend: wgpu::BlendComponent, solid: bool, coverage_from_alpha: bool },
    /// The picture's depth alone, ahead of its colours.
    PictureDepth,
    /// A shadow map.
    ShadowMap,
    /// A level of a texture.
    Texture(wgpu::TextureFormat),
    /// The window's own surface: one sample, colours multiplied by their opacity.
    Window(wgpu::TextureFormat),
}

/// What is particular about one pipeline. Entry points are named `vertex` and `fragment`.
pub(super) struct PipelineSpec<'a> {
    pub(super) label: &'a str,
    pub(super) wgsl: &'a str,
    pub(super) groups: &'a [&'a wgpu::BindGroupLayout],
    pub(super) buffers: &'a [wgpu::VertexBufferLayout<'a>],
    pub(super) topology: wgpu::PrimitiveTopology,
    pub(super) cull: bool,
    pub(super) fragment: bool,
    pub(super) into: Into,
    /// Values of the module's `override` constants.
    pub(super) constants: &'a [(&'a str, f64)],
}

impl PipelineSpec<'_> {
    /// Builds the pipeline; the device keeps what goes wrong until it is checked.
    pub(super) fn build(&self, gpu: &Gpu) -> wgpu::RenderPipeline {
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(self.label),
            source: wgpu::ShaderSource::Wgsl(self.wgsl.into()),
        });
        let groups: Vec<_> = self.groups.iter().map(|&layout| Some(layout)).collect();
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(self.label),
            bind_group_layouts: &groups,
            immediate_size: 0,
        });
        let buffers: Vec<_> = self.buffers.iter().cloned().map(Some).collect();
        let target = self.colour_target();
        let constants = wgpu::PipelineCompilationOptions { constants: self.constants, ..Default::default() };
        let fragment = self.fragment.then(|| wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: constants.clone(),
            targets: target.as_slice(),
        });
        gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(self.label),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: constants.clone(),
                buffers: &buffers,
            },
            primitive: wgpu::PrimitiveState {
                topology: self.topology,
                cull_mode: self.cull.then_some(wgpu::Face::Back),
                ..Default::default()
            },
            depth_stencil: self.depth(),
            multisample: self.multisample(),
            fragment,
            multiview_mask: None,
            cache: None,
        })
    }

    fn colour_target(&self) -> Option<Option<wgpu::ColorTargetState>> {
        let (format, blend) = match self.into {
            Into::Picture { blend, .. } => (COLOUR_FORMAT, Some(blend)),
            Into::PictureDepth | Into::ShadowMap => return None,
            Into::Texture(format) => (format, None),
            Into::Window(format) => {
                let blend = Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING);
                return Some(Some(wgpu::ColorTargetState {
                    format,
                    blend,
                    write_mask: wgpu::ColorWrites::ALL,
                }));
            }
        };
        let covered = wgpu::BlendComponent {
            src_factor: wgpu::BlendFactor::Zero,
            dst_factor: wgpu::BlendFactor::Zero,
            operation: wgpu::BlendOperation::Add,
        };
        let blend = blend.map(|color| wgpu::BlendState { color, alpha: covered });
        Some(Some(wgpu::ColorTargetState { format, blend, write_mask: wgpu::ColorWrites::ALL }))
    }

    fn depth(&self) -> Option<wgpu::DepthStencilState> {
        let solid = match self.into {
            Into::Picture { solid, .. } => solid,
            Into::PictureDepth | Into::ShadowMap => true,
            Into::Texture(_) | Into::Window(_) => return None,
        };
        Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(solid),
            depth_compare: Some(if solid {
                wgpu::CompareFunction::LessEqual
            } else {
                wgpu::CompareFunction::Always
            }),
            stencil: Default::default(),
            bias: Default::default(),
        })
    }

    fn multisample(&self) -> wgpu::MultisampleState {
        let (count, alpha_to_coverage_enabled) = match self.into {
            Into::Picture { coverage_from_alpha, .. } => (SAMPLES, coverage_from_alpha),
            Into::PictureDepth => (SAMPLES, false),
            Into::ShadowMap | Into::Texture(_) | Into::Window(_) => (1, false),
        };
        wgpu::MultisampleState { count, alpha_to_coverage_enabled, ..Default::default() }
    }
}

/// One entry of a bind group layout.
pub(super) fn entry(
    binding: u32,
    visibility: wgpu::ShaderStages,
    ty: wgpu::BindingType,
) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None }
}

/// A uniform buffer of `size` bytes at an offset chosen when it is bound, or always the same.
pub(super) fn uniform(size: usize, has_dynamic_offset: bool) -> wgpu::BindingType {
    wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset,
        min_binding_size: wgpu::BufferSize::new(size as u64),
    }
}

/// A texture of one sample per texel.
pub(super) fn texture(
    sample_type: wgpu::TextureSampleType,
    view_dimension: wgpu::TextureViewDimension,
) -> wgpu::BindingType {
    wgpu::BindingType::Texture { sample_type, view_dimension, multisampled: false }
}
