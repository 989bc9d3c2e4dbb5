//! What a part looks like: Blinn-Phong colours as in 000 §6.1.1, a picture, and what a plant needs beyond them.

use crate::picture::Picture;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::path::{Path, PathBuf};

/// A picture, by where its bytes are found.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Texture {
    /// File name in the program's own `assets/textures`.
    BuiltIn(String),
    /// A user's file, PNG or JPEG. Written without its folders, which are nobody else's business.
    #[serde(serialize_with = "without_folders")]
    File(PathBuf),
    /// The artist's own picture; written as base64.
    #[serde(serialize_with = "as_base64", deserialize_with = "from_base64")]
    Own(Picture),
}

fn without_folders<S: Serializer>(path: &Path, serializer: S) -> Result<S::Ok, S::Error> {
    let name = path.file_name().unwrap_or_default();
    serializer.serialize_str(&name.to_string_lossy())
}

fn as_base64<S: Serializer>(picture: &Picture, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&picture.to_base64())
}

fn from_base64<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Picture, D::Error> {
    Picture::from_base64(&String::deserialize(deserializer)?).map_err(D::Error::custom)
}

/// Look of a surface. Colours are linear RGB, 0 to 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Material {
    /// Unique within a plant; becomes the material's name in exported files.
    pub name: String,
    /// Ambient reflection `Ka`.
    pub ambient: [f32; 3],
    /// Diffuse reflection `Kd`, multiplied with the texture.
    pub diffuse: [f32; 3],
    /// Specular reflection `Ks`.
    pub specular: [f32; 3],
    /// Blinn-Phong exponent `Ns`, 0 to 1000.
    pub shininess: f32,
    /// Share of light that passes through, 0 to 1: leaves glow against the sun.
    pub translucency: f32,
    /// Picture multiplied onto the diffuse colour.
    pub texture: Option<Texture>,
    /// How much higher light places of the picture are than dark ones, in widths of the picture, 0 to 0.2: bark has grooves.
    #[serde(default)]
    pub relief: f32,
    /// Whether the picture's alpha cuts the surface out.
    pub cut_out: bool,
    /// Where the surface is cut out: the picture's opacity is how much of a place is covered, as that of a plant from afar; otherwise there is
    /// something where it is one half.
    pub covers_in_part: bool,
    /// Whether both sides are seen.
    pub double_sided: bool,
}

/// Reflectance at right angles of an ordinary dielectric, of refractive index 1.5.
pub const DIELECTRIC: f32 = 0.04;

impl Material {
    /// A matt surface of one colour.
    pub fn plain(name: &str, diffuse: [f32; 3]) -> Self {
        Self {
            name: name.to_owned(),
            ambient: diffuse.map(|c| c * 0.3),
            diffuse,
            specular: [0.04; 3],
            shininess: 20.0,
            translucency: 0.0,
            texture: None,
            relief: 0.0,
            cut_out: false,
            covers_in_part: false,
            double_sided: false,
        }
    }

    /// Roughness, 0 to 1, of the microfacet surface with an equally wide highlight: α² = 2 / (Ns + 2) with
    /// α = roughness² (Karis 2013, "Specular BRDF Reference").
    pub fn roughness(&self) -> f32 {
        (2.0 / (self.shininess.max(0.0) + 2.0)).powf(0.25)
    }

    /// Reflectance at right angles, 0 to 1, of the microfacet surface of that roughness with an equally bright highlight:
    /// where the lamp is mirrored it shines with F₀ / 4α² of its light, this material with `Ks`.
    pub fn reflectance(&self) -> [f32; 3] {
        self.specular.map(|ks| (8.0 * ks / (self.shininess.max(0.0) + 2.0)).clamp(0.0, 1.0))
    }

    /// The material with the highlight of a microfacet surface: the inverse of [`Self::roughness`] and
    /// [`Self::reflectance`]. Roughness below 0.05 counts as 0.05.
    #[must_use]
    pub fn with_microfacets(self, roughness: f32, reflectance: [f32; 3]) -> Self {
        let shininess = (2.0 / roughness.clamp(0.05, 1.0).powi(4) - 2.0).clamp(0.0, 1000.0);
        let specular = reflectance.map(|f0| (f0 * (shininess + 2.0) / 8.0).clamp(0.0, 1.0));
        Self { specular, shininess, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn microfacets_come_back_as_the_same_highlight() {
        for (specular, shininess) in [(0.0, 20.0), (0.04, 20.0), (0.25, 60.0), (0.1, 5.0)] {
            let shiny = Material { specular: [specular; 3], shininess, ..Material::plain("leaf", [0.5; 3]) };
            let back =
                Material::plain("leaf", [0.5; 3]).with_microfacets(shiny.roughness(), shiny.reflectance());
            assert!((back.shininess - shininess).abs() < 1e-3 * shininess, "{back:?}");
            assert!((back.specular[0] - specular).abs() < 1e-4, "{back:?}");
        }
    }
}
