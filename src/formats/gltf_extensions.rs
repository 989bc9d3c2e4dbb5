//! What glTF's core cannot say: of a material in two extensions that are never required, of levels of detail in one more, of copies in one that is.
//!
//! - `KHR_materials_specular`: the strength of the highlight ([`Material::reflectance`]) where it is not the 4 % of an
//!   ordinary dielectric.
//! - `KHR_materials_diffuse_transmission`: translucency. Leaves scatter the light that shines through them, which then has
//!   the surface's colour; `KHR_materials_transmission` would make them clear as glass.
//!
//! - [`LEVELS`]: a node that is the finest of several levels of detail, and which are the others.
//! - [`INSTANCING`]: a node with a table of poses for the copies of its mesh.
//!
//! Limits: the extensions' pictures for strength and thickness are neither written nor read.

use crate::plant::Material;
use crate::plant::material::DIELECTRIC;
use gltf_json as json;
use json::texture;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// The extension of nodes that are the finest of several levels of detail.
pub(super) const LEVELS: &str = "MSFT_lod";
/// The extension of nodes that show a mesh many times.
pub(super) const INSTANCING: &str = "EXT_mesh_gpu_instancing";
const SPECULAR: &str = "KHR_materials_specular";
const DIFFUSE_TRANSMISSION: &str = "KHR_materials_diffuse_transmission";

/// `KHR_materials_specular`.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct Specular {
    specular_factor: f32,
    specular_color_factor: [f32; 3],
}

impl Default for Specular {
    fn default() -> Self {
        Self { specular_factor: 1.0, specular_color_factor: [1.0; 3] }
    }
}

impl Specular {
    fn of(material: &Material) -> Self {
        let relative = material.reflectance().map(|f0| f0 / DIELECTRIC);
        let strongest = relative.iter().copied().fold(0.0, f32::max);
        // The factor also dims what is seen at a slant, the colour does not; so it says as much as it can.
        let specular_factor = strongest.min(1.0);
        let specular_color_factor =
            if strongest > 0.0 { relative.map(|f0| f0 / specular_factor) } else { [1.0; 3] };
        Self { specular_factor, specular_color_factor }
    }

    fn reflectance(&self) -> [f32; 3] {
        self.specular_color_factor.map(|colour| DIELECTRIC * self.specular_factor * colour)
    }
}

/// `KHR_materials_diffuse_transmission`.
#[derive(Debug, Serialize, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct DiffuseTransmission {
    diffuse_transmission_factor: f32,
    diffuse_transmission_color_factor: [f32; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    diffuse_transmission_color_texture: Option<texture::Info>,
}

impl Default for DiffuseTransmission {
    fn default() -> Self {
        Self {
            diffuse_transmission_factor: 0.0,
            diffuse_transmission_color_factor: [1.0; 3],
            diffuse_transmission_color_texture: None,
        }
    }
}

/// The extensions of a material by name; `colour` and `texture` are those of its surface.
///
/// # Errors
/// The encoder's.
pub(super) fn written(
    material: &Material,
    colour: [f32; 3],
    texture: Option<texture::Info>,
) -> serde_json::Result<Map<String, Value>> {
    let mut extensions = Map::new();
    let specular = Specular::of(material);
    if specular != Specular::default() {
        extensions.insert(SPECULAR.to_owned(), serde_json::to_value(specular)?);
    }
    if material.translucency > 0.0 {
        let transmission = DiffuseTransmission {
            diffuse_transmission_factor: material.translucency.min(1.0),
            diffuse_transmission_color_factor: colour,
            diffuse_transmission_color_texture: texture,
        };
        extensions.insert(DIFFUSE_TRANSMISSION.to_owned(), serde_json::to_value(transmission)?);
    }
    Ok(extensions)
}

/// Reflectance at right angles and translucency of a material in a document, each 0 to 1; what is malformed counts as not
/// there.
pub(super) fn read(material: &json::Material) -> ([f32; 3], f32) {
    let others = material.extensions.as_ref().map(|extensions| &extensions.others);
    let value = |name: &str| others.and_then(|others| others.get(name)).cloned().unwrap_or_default();
    let specular: Specular = serde_json::from_value(value(SPECULAR)).unwrap_or_default();
    let transmission: DiffuseTransmission =
        serde_json::from_value(value(DIFFUSE_TRANSMISSION)).unwrap_or_default();
    (
        specular.reflectance().map(|f0| f0.clamp(0.0, 1.0)),
        transmission.diffuse_transmission_factor.clamp(0.0, 1.0),
    )
}
