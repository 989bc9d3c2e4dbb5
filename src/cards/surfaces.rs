//! The triangles of a cluster, with what they look like: corners, colours and pictures of their materials.

use super::clusters::Cluster;
use crate::model::{self, Model, ModelParams};
use crate::picture::Picture;
use crate::picture::decode::{self, Rgba};
use crate::plant::{FinishedPlant, Material, Texture};
use crate::species::builtin_texture;
use crate::srgb::linear_from_srgb;
use glam::{Vec2, Vec3};
use std::sync::OnceLock;

/// A corner of a triangle.
#[derive(Clone, Copy)]
pub(super) struct Corner {
    /// Where it is, metres.
    pub(super) at: Vec3,
    pub(super) normal: Vec3,
    /// Its place in the picture of the material.
    pub(super) uv: Vec2,
}

/// A triangle and what it looks like.
pub(super) struct Triangle<'a> {
    pub(super) corners: [Corner; 3],
    pub(super) surface: &'a Surface,
}

/// What decides how a material looks in a picture: its colour, and what its picture is read from.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Look {
    diffuse: [u32; 3],
    texture: Option<Texture>,
}

impl Look {
    /// That of a material, with the bytes of a user's file.
    fn of(material: &Material) -> Self {
        // A picture that is missing is reported where the species takes it in.
        let texture = material.texture.as_ref().and_then(|texture| match texture {
            Texture::File(path) => Picture::read_header(path).ok().map(Texture::Own),
            known => Some(known.clone()),
        });
        Self { diffuse: material.diffuse.map(f32::to_bits), texture }
    }
}

/// A material's colour and picture.
pub(super) struct Surface {
    diffuse: Vec3,
    texture: Option<Rgba>,
    /// Light of encoded values.
    linear: [f32; 256],
}

impl Surface {
    fn new(Look { diffuse, texture }: &Look) -> Self {
        let linear = std::array::from_fn(|encoded| linear_from_srgb(encoded as f32 / 255.0));
        let texture = texture.as_ref().and_then(|texture| match texture {
            Texture::BuiltIn(name) => decode::decode(builtin_texture(name)?).ok(),
            Texture::File(_) => None,
            Texture::Own(picture) => picture.pixels().ok(),
        });
        Self { diffuse: diffuse.map(f32::from_bits).into(), texture, linear }
    }

    /// Colour at a place in linear light; none where the picture is clear.
    pub(super) fn colour(&self, uv: Vec2) -> Option<Vec3> {
        let Some(Rgba { width, height, pixels }) = &self.texture else { return Some(self.diffuse) };
        let texel = |share: f32, count: u32| {
            ((share - share.floor()) * count as f32).clamp(0.0, count as f32 - 1.0) as usize
        };
        let at = 4 * (texel(1.0 - uv.y, *height) * *width as usize + texel(uv.x, *width));
        let &[r, g, b, a] = pixels.get(at..at + 4)?.as_array()?;
        let light = |encoded: u8| self.linear[usize::from(encoded)];
        (a > 127).then(|| self.diffuse * Vec3::new(light(r), light(g), light(b)))
    }
}

/// The looks of a plant, each once something of it is seen.
pub(super) struct Surfaces<'a> {
    plant: &'a FinishedPlant,
    fineness: ModelParams,
    /// By the plant's materials.
    looks: Vec<Look>,
    of_look: Vec<OnceLock<Surface>>,
}

impl<'a> Surfaces<'a> {
    /// Those of a plant that is meshed so finely.
    pub(super) fn new(plant: &'a FinishedPlant, fineness: ModelParams) -> Self {
        let looks: Vec<Look> = plant.materials().iter().map(Look::of).collect();
        let of_look = looks.iter().map(|_| OnceLock::new()).collect();
        Self { plant, fineness, looks, of_look }
    }

    /// By the plant's materials.
    pub(super) fn looks(&self) -> &[Look] {
        &self.looks
    }

    /// A cluster by itself.
    pub(super) fn excerpt(&self, cluster: &Cluster) -> FinishedPlant {
        self.plant.excerpt(&cluster.branches, &cluster.organs)
    }

    /// The surface of a cluster; none once `stop` says yes.
    pub(super) fn triangles(
        &self,
        excerpt: &FinishedPlant,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Option<Vec<Triangle<'_>>> {
        let model = model::rebuild(excerpt, &self.fineness, &mut model::Cache::for_one_build(), stop)?;
        let surface =
            |material: usize| self.of_look[material].get_or_init(|| Surface::new(&self.looks[material]));
        Some(triangles_of(&model.flattened(), surface))
    }
}

/// The surfaces of materials.
pub(super) fn of_materials(materials: &[Material]) -> Vec<Surface> {
    materials.iter().map(|material| Surface::new(&Look::of(material))).collect()
}

/// The triangles of a model without copies, with the surface of each material.
pub(super) fn triangles_of<'a>(flat: &Model, surface: impl Fn(usize) -> &'a Surface) -> Vec<Triangle<'a>> {
    let mut triangles = Vec::new();
    for part in &flat.parts {
        let corner = |vertex: u32| {
            let vertex = part.mesh.vertices[vertex as usize];
            Corner { at: part.mesh.points[vertex.point as usize], normal: vertex.normal, uv: vertex.uv }
        };
        for (material, faces) in part.material_slots() {
            let surface = surface(material);
            let triangle = |face: &[u32; 3]| Triangle { corners: face.map(corner), surface };
            triangles.extend(part.mesh.triangles[faces].iter().map(triangle));
        }
    }
    triangles
}

/// How shoots are meshed: finely, for nothing of that is left but a picture.
pub(super) fn fine() -> ModelParams {
    let mut params = ModelParams::default();
    let blade = &mut params.blade;
    (blade.template_tolerance, blade.template_outline_points) = (0.004, 80);
    (blade.template_rows, blade.template_columns) = (4, 1);
    params
}
