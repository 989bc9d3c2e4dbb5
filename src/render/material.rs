//! Materials on the GPU: colours and picture of each, in bind group 1.

use super::RenderError;
use super::gpu::Gpu;
use super::mipmap::{MipmapRenderer, TEXTURE_FORMAT};
use super::pipeline::{entry, texture, uniform};
use crate::picture::decode::{self, Rgba};
use crate::plant::{Material, Texture};
use bytemuck::{Pod, Zeroable};
use glam::{Vec3, Vec4};
use std::borrow::Cow;
use std::error::Error;
use wgpu::ShaderStages;

/// Where the bytes of a texture's file come from; its errors complete “texture X cannot be used:”.
pub type TextureSource<'a> =
    dyn Fn(&Texture) -> Result<Cow<'static, [u8]>, Box<dyn Error + Send + Sync>> + 'a;

/// The smallest copy that is shown of pictures that cut a surface out, by halvings: in smaller ones a shoot is a few pixels, none of which
/// may be shown (`cards/coverage.rs`).
const CUT_OUT_SMALLEST: f32 = 6.0;
/// Samples along the longer axis of a pixel's footprint; leaves are often seen at a slant.
const ANISOTROPY: u16 = 4;

/// `Material` in `material.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct MaterialUniform {
    ambient: Vec4,
    diffuse: Vec4,
    specular: Vec4,
    relief: Vec4,
}

impl From<&Material> for MaterialUniform {
    fn from(m: &Material) -> Self {
        let is_cut_out = m.cut_out && m.texture.is_some();
        let cut_out = f32::from(u8::from(is_cut_out) + u8::from(is_cut_out && m.covers_in_part));
        Self {
            ambient: Vec3::from(m.ambient).extend(m.translucency),
            diffuse: Vec3::from(m.diffuse).extend(cut_out),
            specular: Vec3::from(m.specular).extend(m.shininess),
            relief: Vec4::new(if m.texture.is_some() { m.relief } else { 0.0 }, 0.0, 0.0, 0.0),
        }
    }
}

/// Uploaded pictures by their texture; the one without a texture is white.
#[derive(Default)]
pub(super) struct Pictures(Vec<(Option<Texture>, wgpu::TextureView)>);

impl Pictures {
    /// Pictures in memory.
    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    /// Forgets pictures that none of `materials` uses.
    pub(super) fn keep_only(&mut self, materials: &[Material]) {
        self.0.retain(|(texture, _)| materials.iter().any(|m| m.texture == *texture));
    }
}

/// What all materials share.
pub(super) struct MaterialLayout {
    pub(super) layout: wgpu::BindGroupLayout,
    /// For pictures that lie once on a surface.
    clamped: wgpu::Sampler,
    /// For pictures that repeat, such as bark.
    repeated: wgpu::Sampler,
    /// For pictures that lie once on a surface and cut it out.
    cutting: wgpu::Sampler,
    mipmaps: MipmapRenderer,
}

impl MaterialLayout {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let fragment = ShaderStages::FRAGMENT;
        let colour = wgpu::TextureSampleType::Float { filterable: true };
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("material"),
            entries: &[
                entry(0, fragment, uniform(size_of::<MaterialUniform>(), false)),
                entry(1, fragment, texture(colour, wgpu::TextureViewDimension::D2)),
                entry(2, fragment, wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering)),
            ],
        });
        // Where a picture is squeezed to nothing in one direction, Mesa's software driver never ends an anisotropic lookup.
        let anisotropy = if gpu.is_software() { 1 } else { ANISOTROPY };
        let sampler = |mode, smallest| {
            gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("picture"),
                address_mode_u: mode,
                address_mode_v: mode,
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                mipmap_filter: wgpu::MipmapFilterMode::Linear,
                anisotropy_clamp: anisotropy,
                lod_max_clamp: smallest,
                ..Default::default()
            })
        };
        Self {
            layout,
            clamped: sampler(wgpu::AddressMode::ClampToEdge, f32::MAX),
            repeated: sampler(wgpu::AddressMode::Repeat, f32::MAX),
            cutting: sampler(wgpu::AddressMode::ClampToEdge, CUT_OUT_SMALLEST),
            mipmaps: MipmapRenderer::new(gpu),
        }
    }

    /// Bind groups of all `materials`; `repeats` says for each whether its picture repeats.
    ///
    /// # Errors
    /// A texture that is missing or unreadable.
    pub(super) fn upload(
        &self,
        gpu: &Gpu,
        materials: &[Material],
        repeats: &[bool],
        textures: &TextureSource<'_>,
    ) -> Result<Vec<wgpu::BindGroup>, RenderError> {
        let mut pictures = Pictures::default();
        let groups = materials.iter().zip(repeats).map(|(material, &repeat)| {
            let picture = self.picture(gpu, &mut pictures, material.texture.as_ref(), textures)?;
            Ok(self.bind(gpu, material, &picture, repeat))
        });
        groups.collect()
    }

    /// A material's picture, uploaded unless it is among `known`; white for a material without.
    ///
    /// # Errors
    /// A texture that is missing or unreadable.
    pub(super) fn picture(
        &self,
        gpu: &Gpu,
        known: &mut Pictures,
        texture: Option<&Texture>,
        textures: &TextureSource<'_>,
    ) -> Result<wgpu::TextureView, RenderError> {
        if let Some((_, view)) = known.0.iter().find(|(known, _)| known.as_ref() == texture) {
            return Ok(view.clone());
        }
        let picture = match texture {
            Some(texture) => load(texture, textures)?,
            None => Rgba { width: 1, height: 1, pixels: vec![255; 4] },
        };
        let view = self.upload_picture(gpu, &picture);
        known.0.push((texture.cloned(), view.clone()));
        Ok(view)
    }

    /// The bind group of a material; `repeat` says whether its picture repeats.
    pub(super) fn bind(
        &self,
        gpu: &Gpu,
        material: &Material,
        picture: &wgpu::TextureView,
        repeat: bool,
    ) -> wgpu::BindGroup {
        let once = if material.cut_out { &self.cutting } else { &self.clamped };
        let sampler = if repeat { &self.repeated } else { once };
        let uniform = MaterialUniform::from(material);
        let colours = gpu.buffer(&material.name, bytemuck::bytes_of(&uniform), wgpu::BufferUsages::UNIFORM);
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(&material.name),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: colours.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(picture) },
                wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Sampler(sampler) },
            ],
        })
    }

    /// Uploads a picture with all its smaller levels.
    pub(super) fn upload_picture(&self, gpu: &Gpu, picture: &Rgba) -> wgpu::TextureView {
        let size = wgpu::Extent3d { width: picture.width, height: picture.height, depth_or_array_layers: 1 };
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("picture"),
            size,
            mip_level_count: size.max_mips(wgpu::TextureDimension::D2),
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: TEXTURE_FORMAT,
            usage: wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_DST
                | wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        let rows = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(4 * picture.width),
            rows_per_image: None,
        };
        gpu.queue.write_texture(texture.as_image_copy(), &picture.pixels, rows, size);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.mipmaps.fill(gpu, &mut encoder, &texture);
        gpu.queue.submit([encoder.finish()]);
        texture.create_view(&Default::default())
    }
}

fn load(texture: &Texture, textures: &TextureSource<'_>) -> Result<Rgba, RenderError> {
    let refused = |reason: String| RenderError::Texture { name: name_of(texture), reason };
    let bytes = textures(texture).map_err(|e| refused(e.to_string()))?;
    decode::decode(&bytes).map_err(refused)
}

fn name_of(texture: &Texture) -> String {
    match texture {
        Texture::BuiltIn(name) => format!("`{name}` of the program"),
        Texture::File(path) => format!("`{}`", path.display()),
        Texture::Own(_) => "of the drawing's own pictures".to_owned(),
    }
}
