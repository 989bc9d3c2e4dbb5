//! Materials, pictures and samplers of a glTF document.
//!
//! glTF is physically based, the plant Blinn-Phong. The diffuse colour becomes the base colour of a dielectric; the
//! exponent becomes roughness so that both highlights are equally wide: α² = 2 / (Ns + 2) (Karis 2013, "Specular BRDF
//! Reference") with α = roughness². `Ka` and `Ks` have no place: ambient light is the viewer's, and a dielectric
//! reflects 4 %. Translucency would need an extension that few programs read, and is left out.

use super::{Pictures, Scene};
use crate::plant::Material;
use gltf_json as json;
use json::validation::Checked::Valid;
use json::{Index, material, texture};

/// Pushes the materials that parts use, with their textures; image `i` shows picture `i`. Returns each model
/// material's index in the document.
pub(super) fn push_materials(
    root: &mut json::Root,
    scene: &Scene<'_>,
    pictures: &Pictures,
) -> Vec<Option<Index<json::Material>>> {
    let textures = push_textures(root, pictures);
    let materials = scene.model.materials.iter().zip(scene.used_materials()).enumerate();
    materials
        .map(|(i, (material, used))| {
            let texture = pictures.of_material[i].map(|picture| textures[picture]);
            used.then(|| root.push(converted(material, texture)))
        })
        .collect()
}

fn push_textures(root: &mut json::Root, pictures: &Pictures) -> Vec<Index<json::Texture>> {
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

fn converted(material: &Material, texture: Option<Index<json::Texture>>) -> json::Material {
    let [r, g, b] = material.diffuse.map(|c| c.clamp(0.0, 1.0));
    let base_color_texture = texture.map(|index| texture::Info {
        index,
        tex_coord: 0,
        extensions: None,
        extras: Default::default(),
    });
    json::Material {
        name: Some(material.name.clone()),
        alpha_mode: Valid(if material.cut_out {
            material::AlphaMode::Mask
        } else {
            material::AlphaMode::Opaque
        }),
        double_sided: material.double_sided,
        pbr_metallic_roughness: material::PbrMetallicRoughness {
            base_color_factor: material::PbrBaseColorFactor([r, g, b, 1.0]),
            base_color_texture,
            metallic_factor: material::StrengthFactor(0.0),
            roughness_factor: material::StrengthFactor(roughness(material.shininess)),
            ..Default::default()
        },
        ..Default::default()
    }
}

fn roughness(shininess: f32) -> f32 {
    (2.0 / (shininess.max(0.0) + 2.0)).powf(0.25)
}

/// The exponent of a highlight as wide as that of a roughness; the other way round.
pub(super) fn shininess(roughness: f32) -> f32 {
    (2.0 / roughness.clamp(0.05, 1.0).powi(4) - 2.0).clamp(0.0, 1000.0)
}
