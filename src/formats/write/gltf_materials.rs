//! Materials, pictures and samplers of a glTF document.
//!
//! glTF is physically based, the plant Blinn-Phong. The diffuse colour becomes the base colour of a dielectric, the
//! highlight that of a microfacet surface ([`Material::roughness`]); what else a material has is in `gltf_extensions.rs`.
//! `Ka` has no place: ambient light is the viewer's.

use super::{ImageFiles, Scene};
use crate::formats::gltf_extensions;
use crate::plant::Material;
use gltf_json as json;
use json::validation::Checked::Valid;
use json::{Index, material, texture};
use std::collections::BTreeSet;

/// Pushes the materials that parts use, with their textures; image `i` shows picture `i`. Returns each model
/// material's index in the document.
pub(super) fn push_materials(
    root: &mut json::Root,
    scene: &Scene<'_>,
    pictures: &ImageFiles,
) -> serde_json::Result<Vec<Option<Index<json::Material>>>> {
    let textures = push_textures(root, pictures);
    let mut pushed = Vec::with_capacity(scene.model.materials.len());
    let mut used_extensions = BTreeSet::new();
    for (i, (material, used)) in scene.model.materials.iter().zip(scene.used_materials()).enumerate() {
        let [colour, relief] = [&pictures.of_material, &pictures.relief_of_material]
            .map(|of_material| of_material[i].map(|picture| textures[picture]));
        let converted = if used { Some(converted(material, colour, relief)?) } else { None };
        let extensions = converted.iter().filter_map(|material| material.extensions.as_ref());
        used_extensions.extend(extensions.flat_map(|extensions| extensions.others.keys().cloned()));
        pushed.push(converted.map(|material| root.push(material)));
    }
    root.extensions_used.extend(used_extensions);
    Ok(pushed)
}

fn push_textures(root: &mut json::Root, pictures: &ImageFiles) -> Vec<Index<json::Texture>> {
    if pictures.all.is_empty() {
        return Vec::new();
    }
    let sampler = root.push(texture::Sampler {
        mag_filter: Some(Valid(texture::MagFilter::Linear)),
        min_filter: Some(Valid(texture::MinFilter::LinearMipmapLinear)),
        ..Default::default()
    });
    let texture = |image| json::Texture {
        name: None,
        sampler: Some(sampler),
        source: Index::new(image),
        extensions: None,
        extras: Default::default(),
    };
    (0..pictures.all.len() as u32).map(|image| root.push(texture(image))).collect()
}

fn converted(
    material: &Material,
    texture: Option<Index<json::Texture>>,
    relief: Option<Index<json::Texture>>,
) -> serde_json::Result<json::Material> {
    let [r, g, b] = material.diffuse.map(|c| c.clamp(0.0, 1.0));
    let base_color_texture = texture.map(|index| texture::Info {
        index,
        tex_coord: 0,
        extensions: None,
        extras: Default::default(),
    });
    let others = gltf_extensions::written(material, [r, g, b], base_color_texture.clone())?;
    Ok(json::Material {
        name: Some(material.name.clone()),
        alpha_mode: Valid(if material.cut_out {
            material::AlphaMode::Mask
        } else {
            material::AlphaMode::Opaque
        }),
        double_sided: material.double_sided,
        normal_texture: relief.map(|index| material::NormalTexture {
            index,
            scale: 1.0,
            tex_coord: 0,
            extensions: None,
            extras: Default::default(),
        }),
        pbr_metallic_roughness: material::PbrMetallicRoughness {
            base_color_factor: material::PbrBaseColorFactor([r, g, b, 1.0]),
            base_color_texture,
            metallic_factor: material::StrengthFactor(0.0),
            roughness_factor: material::StrengthFactor(material.roughness()),
            ..Default::default()
        },
        extensions: (!others.is_empty()).then_some(json::extensions::material::Material { others }),
        ..Default::default()
    })
}
