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
    /// Whether the picture's alpha cuts the surface out.
    pub cut_out: bool,
    /// Whether both sides are seen.
    pub double_sided: bool,
}

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
            cut_out: false,
            double_sided: false,
        }
    }
}
