//! The node tree of a glTF document: the branch tree with pivots.
//!
//! A root node per specimen stands at the plant's base; below it every part hangs on the part that carries it, its
//! origin at its own base. So a rotated node turns a branch with all it carries about the place where it is attached.
//! Translations are relative to the parent's pivot and meshes relative to their own; both are rounded to single
//! precision, which puts a vertex within a few ulps of its place in the model.

use super::scene::specimen_name;
use crate::model::{Model, Part};
use glam::Vec3;
use gltf_json as json;
use json::Index;
use std::collections::BTreeMap;

/// Pushes the scene and all nodes; `mesh_of_part` gives each part's mesh, `None` for one without surface. Returns the
/// index of the first part's node.
pub(super) fn push_nodes(
    root: &mut json::Root,
    model: &Model,
    mesh_of_part: &[Option<Index<json::Mesh>>],
) -> u32 {
    let bases = specimen_bases(model);
    let root_of_specimen: BTreeMap<usize, u32> = bases.keys().copied().zip(0..).collect();
    for (&specimen, &base) in &bases {
        root.push(node(specimen_name(specimen), base));
    }
    let first_part = bases.len() as u32;
    for (part, &mesh) in model.parts.iter().zip(mesh_of_part) {
        let (parent, pivot) = match part.parent {
            Some(parent) => (first_part + parent as u32, model.parts[parent].pivot),
            None => (root_of_specimen[&part.specimen], bases[&part.specimen]),
        };
        let mut node = node(part.name.to_string(), part.pivot - pivot);
        node.mesh = mesh;
        let index = root.push(node);
        root.nodes[parent as usize].children.get_or_insert_default().push(index);
    }
    let scene = json::Scene {
        name: None,
        nodes: (0..first_part).map(Index::new).collect(),
        extensions: None,
        extras: Default::default(),
    };
    root.scene = Some(root.push(scene));
    first_part
}

/// For each specimen where it stands: the pivot of its first part that nothing carries.
fn specimen_bases(model: &Model) -> BTreeMap<usize, Vec3> {
    let mut bases = BTreeMap::new();
    let free = |part: &&Part| part.parent.is_none();
    for part in model.parts.iter().filter(free) {
        bases.entry(part.specimen).or_insert(part.pivot);
    }
    bases
}

pub(super) fn node(name: String, translation: Vec3) -> json::Node {
    let translation = (translation != Vec3::ZERO).then(|| translation.to_array());
    json::Node { name: Some(name), translation, ..Default::default() }
}
