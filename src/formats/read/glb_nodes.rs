//! Where a GLB document shows its meshes: the walk over its nodes, and the copies that a node has by a table of poses.
//!
//! A node shows its mesh once, or with [`INSTANCING`] as often as the extension's table has rows; translations, rotations
//! and scales are columns of that table, and what is missing is none.
//!
//! Limits: the first scene, or all roots where there is none; tables of 32-bit floats.

use super::error::Malformed;
use super::gltf_accessor::{Budget, Data};
use crate::formats::gltf_extensions::INSTANCING;
use glam::{Mat4, Quat, Vec3};
use gltf_json as json;
use serde_json::Value;

/// A mesh where a node shows it.
pub(super) struct Shown {
    /// Index of the node.
    pub(super) node: usize,
    /// Index of the mesh.
    pub(super) mesh: usize,
    /// The place in the world of each of its copies, one where the node has no table.
    pub(super) world_from_copies: Vec<Mat4>,
}

/// All meshes that are shown. The nodes are a forest and the meshes of nodes exist.
pub(super) fn shown(data: Data<'_>, budget: &mut Budget) -> Result<Vec<Shown>, Malformed> {
    let mut shown = Vec::new();
    for (node, world_from_node) in placed(data.root) {
        let Some(mesh) = data.root.nodes[node].mesh else { continue };
        let world_from_copies = match poses(node, data, budget)? {
            Some(poses) => poses.into_iter().map(|node_from_copy| world_from_node * node_from_copy).collect(),
            None => vec![world_from_node],
        };
        shown.push(Shown { node, mesh: mesh.value(), world_from_copies });
    }
    Ok(shown)
}

/// The poses in a node's table of copies, none without a table.
fn poses(node: usize, data: Data<'_>, budget: &mut Budget) -> Result<Option<Vec<Mat4>>, Malformed> {
    let extensions = data.root.nodes[node].extensions.as_ref();
    let Some(table) = extensions.and_then(|extensions| extensions.others.get(INSTANCING)) else {
        return Ok(None);
    };
    let fault = |reason: &str| Malformed::new(format!("node {node}"), format!("{INSTANCING}: {reason}"));
    let column = |name: &str| {
        let accessor = table.get("attributes").and_then(|attributes| attributes.get(name));
        let index = |value: &Value| value.as_u64().and_then(|index| u32::try_from(index).ok());
        let index = accessor.map(|value| index(value).ok_or_else(|| fault("an attribute is no accessor")));
        index.transpose().map(|index| index.map(json::Index::new))
    };
    let translations = column("TRANSLATION")?.map(|index| data.floats::<3>(index, budget)).transpose()?;
    let rotations = column("ROTATION")?.map(|index| data.floats::<4>(index, budget)).transpose()?;
    let scales = column("SCALE")?.map(|index| data.floats::<3>(index, budget)).transpose()?;
    let counts = [
        translations.as_ref().map(Vec::len),
        rotations.as_ref().map(Vec::len),
        scales.as_ref().map(Vec::len),
    ];
    let mut counts = counts.into_iter().flatten();
    let count = counts.next().ok_or_else(|| fault("its table has no columns"))?;
    if counts.any(|other| other != count) {
        return Err(fault("the columns of its table differ in length"));
    }
    let pose = |i: usize| {
        Mat4::from_scale_rotation_translation(
            scales.as_ref().map_or(Vec3::ONE, |scales| scales[i].into()),
            rotations.as_ref().map_or(Quat::IDENTITY, |rotations| Quat::from_array(rotations[i])),
            translations.as_ref().map_or(Vec3::ZERO, |translations| translations[i].into()),
        )
    };
    Ok(Some((0..count).map(pose).collect()))
}

/// Every node that is shown, with its place in the world. That the nodes are a forest bounds the walk.
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
