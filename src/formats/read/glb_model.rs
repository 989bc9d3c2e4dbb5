//! GLB to a model that can be drawn: meshes where the nodes put them, copies included, materials as far as Blinn-Phong reaches.
//!
//! The inverse of `formats/write/gltf_materials.rs`: base colour to diffuse, roughness to exponent, extensions to highlight and
//! translucency; v is turned round again.
//!
//! Limits: masks and blending both cut out; pictures outside the file are not read.

use super::error::Malformed;
use super::glb_container;
use super::glb_nodes::{self, Shown};
use super::glb_surfaces::{assembled, check_nodes};
use super::gltf_accessor::{Budget, Data};
use super::loaded::{Loaded, clay, is_picture};
use crate::formats::gltf_extensions::{self, INSTANCING};
use crate::model::Mesh;
use crate::plant::{Material, Texture};
use crate::quote;
use glam::{Mat3, Mat4};
use gltf_json as json;
use json::material::AlphaMode;
use json::mesh::Primitive;
use json::validation::Checked;
use std::slice;

/// Most extensions that remarks name.
const MOST_NAMED: usize = 8;

pub(super) fn load(bytes: &[u8]) -> Result<Loaded, Malformed> {
    let (root, buffer) = glb_container::open(bytes)?;
    check_nodes(&root)?;
    let data = Data { root: &root, buffer };
    let mut loaded = Loaded::default();
    let unknown = root.extensions_required.iter().filter(|extension| *extension != INSTANCING);
    for extension in unknown.take(MOST_NAMED) {
        let extension = quote::name(extension);
        loaded.warnings.push(format!(
            "the file requires {extension}, which is not read, so surfaces may be missing; write it without"
        ));
    }
    let textures = load_pictures(data, &mut loaded);
    for material in &root.materials {
        let converted = converted(material, &root, &textures);
        loaded.push_material(converted);
    }
    let plain = loaded.push_material(clay());
    let (mut budget, mut room) = (Budget::of(buffer), Budget::of_copies(buffer));
    let shown = glb_nodes::shown(data, &mut budget)?;
    let mut uses = vec![0_usize; root.meshes.len()];
    shown.iter().for_each(|shown| uses[shown.mesh] += 1);
    let mut decoded: Vec<Option<Vec<Mesh>>> = vec![None; root.meshes.len()];
    for Shown { node, mesh, world_from_copies } in shown {
        let name = root.nodes[node].name.clone().unwrap_or_else(|| format!("node {node}"));
        let primitives = &root.meshes[mesh].primitives;
        let surfaces = match decoded[mesh].take() {
            Some(surfaces) => surfaces,
            None => primitives_of(&name, primitives, data, &mut budget)?,
        };
        for (surface, primitive) in surfaces.iter().zip(primitives) {
            let elements = surface.vertices.len() + surface.triangles.len();
            let spent = room.spend(elements.saturating_mul(world_from_copies.len()));
            spent.map_err(|reason| Malformed::new(format!("node {node}"), reason))?;
            let material = primitive.material.map_or(plain, |index| index.value().min(plain));
            loaded.push(name.clone(), placed(surface, &world_from_copies), material);
        }
        uses[mesh] -= 1;
        if uses[mesh] > 0 {
            decoded[mesh] = Some(surfaces);
        }
    }
    Ok(loaded)
}

/// For each image of the document its texture, where it is a picture inside the file. Altogether they may be as large
/// as the file's data: many images that name the same bytes must not multiply them.
fn load_pictures(data: Data<'_>, loaded: &mut Loaded) -> Vec<Option<Texture>> {
    let mut textures = Vec::with_capacity(data.root.images.len());
    let mut room = data.buffer.len();
    for (i, image) in data.root.images.iter().enumerate() {
        let bytes = image.buffer_view.and_then(|view| data.region(view));
        let picture = bytes.filter(|bytes| is_picture(bytes) && bytes.len() <= room).map(|bytes| {
            room -= bytes.len();
            loaded.embedded.push(bytes)
        });
        if picture.is_none() {
            loaded
                .warnings
                .push(format!("image {i} is no PNG or JPEG inside the file; its surfaces stay plain"));
        }
        textures.push(picture);
    }
    textures
}

fn converted(material: &json::Material, root: &json::Root, textures: &[Option<Texture>]) -> Material {
    let pbr = &material.pbr_metallic_roughness;
    let [r, g, b, _] = pbr.base_color_factor.0;
    let texture = pbr.base_color_texture.as_ref().and_then(|info| root.textures.get(info.index.value()));
    let (reflectance, translucency) = gltf_extensions::read(material);
    let plain = Material::plain(material.name.as_deref().unwrap_or("material"), [r, g, b]);
    Material {
        translucency,
        texture: texture.and_then(|texture| textures.get(texture.source.value())?.clone()),
        cut_out: !matches!(material.alpha_mode, Checked::Valid(AlphaMode::Opaque)),
        double_sided: material.double_sided,
        ..plain.with_microfacets(pbr.roughness_factor.0, reflectance)
    }
}

/// Each primitive of a mesh by itself, without the faces of which a corner does not exist.
fn primitives_of(
    name: &str,
    primitives: &[Primitive],
    data: Data<'_>,
    budget: &mut Budget,
) -> Result<Vec<Mesh>, Malformed> {
    let mut surfaces = Vec::with_capacity(primitives.len());
    for primitive in primitives {
        let mut mesh = assembled(name.to_owned(), slice::from_ref(primitive), data, budget)?.mesh;
        let count = mesh.vertices.len();
        mesh.triangles.retain(|corners| corners.iter().all(|corner| (*corner as usize) < count));
        surfaces.push(mesh);
    }
    Ok(surfaces)
}

/// A surface at each of these places, as one mesh.
fn placed(surface: &Mesh, world_from_copies: &[Mat4]) -> Mesh {
    let mut all = Mesh::default();
    for world_from_copy in world_from_copies {
        let mut copy = surface.clone();
        transform(&mut copy, *world_from_copy);
        all.append(&copy);
    }
    all
}

fn transform(mesh: &mut Mesh, world_from_node: Mat4) {
    // Normals keep at right angles to the surface under the inverse transpose; a flat scale has none, and no surface.
    let linear = Mat3::from_mat4(world_from_node);
    let normals = if linear.determinant() == 0.0 { linear } else { linear.inverse().transpose() };
    for point in &mut mesh.points {
        *point = world_from_node.transform_point3(*point);
    }
    for vertex in &mut mesh.vertices {
        vertex.normal = (normals * vertex.normal).normalize_or_zero();
        vertex.uv.y = 1.0 - vertex.uv.y;
    }
    if linear.determinant() < 0.0 {
        mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    }
}
