//! GLB to a model that can be drawn: meshes where the nodes put them, materials as far as Blinn-Phong reaches.
//!
//! The inverse of `formats/write/gltf_materials.rs`: base colour to diffuse, roughness to exponent, extensions to highlight and
//! translucency; v is turned round again.
//!
//! Limits: the first scene, or all roots where there is none; masks and blending both cut out; pictures outside the file
//! are not read.

use super::error::Malformed;
use super::glb_container;
use super::glb_surfaces::{assembled, check_nodes};
use super::gltf_accessor::{Budget, Data};
use super::loaded::{Loaded, clay, is_picture};
use crate::formats::gltf_extensions;
use crate::model::Mesh;
use crate::plant::{Material, Texture};
use crate::quote;
use glam::{Mat3, Mat4, Quat, Vec3};
use gltf_json as json;
use json::material::AlphaMode;
use json::validation::Checked;
use std::slice;

/// Most extensions that remarks name.
const MOST_NAMED: usize = 8;

pub(super) fn load(bytes: &[u8]) -> Result<Loaded, Malformed> {
    let (root, buffer) = glb_container::open(bytes)?;
    check_nodes(&root)?;
    let data = Data { root: &root, buffer };
    let mut loaded = Loaded::default();
    // None is known that changes where surfaces are.
    for extension in root.extensions_required.iter().take(MOST_NAMED) {
        let extension = quote::name(extension);
        loaded.warnings.push(format!(
            "the file requires {extension}, which is not read, so surfaces are missing; write it without, as \
             `--instances nodes` does"
        ));
    }
    let textures = load_pictures(data, &mut loaded);
    for material in &root.materials {
        let converted = converted(material, &root, &textures);
        loaded.push_material(converted);
    }
    let plain = loaded.push_material(clay());
    let mut budget = Budget::of(buffer);
    for (node, world_from_node) in placed(&root) {
        let Some(mesh) = root.nodes[node].mesh.and_then(|mesh| root.meshes.get(mesh.value())) else {
            continue;
        };
        for primitive in &mesh.primitives {
            let name = root.nodes[node].name.clone().unwrap_or_else(|| format!("node {node}"));
            let mut surface = assembled(name, slice::from_ref(primitive), data, &mut budget)?;
            transform(&mut surface.mesh, world_from_node);
            let material = primitive.material.map_or(plain, |index| index.value().min(plain));
            loaded.push(surface.name, surface.mesh, material);
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

/// Every node that is shown, with its place in the world. The nodes are a forest, which bounds the walk.
fn placed(root: &json::Root) -> Vec<(usize, Mat4)> {
    let shown = root.scene.map_or(0, |scene| scene.value());
    let mut placed: Vec<(usize, Mat4)> = match root.scenes.get(shown) {
        Some(scene) => scene.nodes.iter().map(|node| (node.value(), Mat4::IDENTITY)).collect(),
        None => free(root).map(|node| (node, Mat4::IDENTITY)).collect(),
    };
    // A scene may name a node twice, or one that hangs on another.
    let is_free: Vec<usize> = free(root).collect();
    placed.retain(|(node, _)| is_free.binary_search(node).is_ok());
    placed.sort_by_key(|(node, _)| *node);
    placed.dedup_by_key(|(node, _)| *node);
    let mut next = 0;
    while let Some(&(index, parent)) = placed.get(next) {
        let node = &root.nodes[index];
        let world_from_node = parent * parent_from_node(node);
        placed[next].1 = world_from_node;
        placed.extend(node.children.iter().flatten().map(|child| (child.value(), world_from_node)));
        next += 1;
    }
    placed
}

/// Nodes that hang on no other, in order.
fn free(root: &json::Root) -> impl Iterator<Item = usize> {
    let mut hangs = vec![false; root.nodes.len()];
    let children = root.nodes.iter().flat_map(|node| node.children.iter().flatten());
    children.for_each(|child| hangs[child.value()] = true);
    hangs.into_iter().enumerate().filter(|(_, hangs)| !hangs).map(|(node, _)| node)
}

fn parent_from_node(node: &json::Node) -> Mat4 {
    match node.matrix {
        Some(matrix) => Mat4::from_cols_array(&matrix),
        None => Mat4::from_scale_rotation_translation(
            node.scale.map_or(Vec3::ONE, Vec3::from),
            node.rotation.map_or(Quat::IDENTITY, |q| Quat::from_array(q.0)),
            node.translation.map_or(Vec3::ZERO, Vec3::from),
        ),
    }
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
