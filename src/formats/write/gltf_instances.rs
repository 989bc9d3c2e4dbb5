//! Copies of one shape in a glTF document: nodes that share a mesh, or one node with a table of poses.
//!
//! A group of copies hangs on the part that carries it. As nodes, each copy has its own translation, rotation and scale
//! below the group's node, which every program reads. As a table ([`INSTANCING`]) the poses stand in the buffer: all
//! translations of a group, then its rotations, then its scales, 40 bytes a copy. A viewer that does not know the
//! extension could show one leaf of thousands only, so the document requires it.

use super::Scene;
use super::gltf_buffer::{accessor, view};
use super::gltf_tree::node;
use super::scene::InstanceForm;
use crate::formats::gltf_extensions::INSTANCING;
use crate::model::{InstanceGroup, Pose};
use gltf_json as json;
use json::Index;
use json::accessor::{ComponentType, Type};
use json::buffer::View;
use json::extensions::scene::Node as NodeExtensions;
use json::scene::UnitQuaternion;
use serde_json::{Value, json};

/// Its attributes, and how many numbers each has.
const ATTRIBUTES: [(&str, Type, usize); 3] =
    [("TRANSLATION", Type::Vec3, 3), ("ROTATION", Type::Vec4, 4), ("SCALE", Type::Vec3, 3)];
/// Bytes of a pose in a table.
const POSE_BYTES: usize = 40;

/// The groups that are written as tables.
fn tables<'a>(scene: &Scene<'a>) -> &'a [InstanceGroup] {
    match scene.instances {
        Some((groups, InstanceForm::Gpu)) => groups,
        _ => &[],
    }
}

/// How many bytes the tables have.
pub(super) fn table_bytes(scene: &Scene<'_>) -> usize {
    POSE_BYTES * tables(scene).iter().map(|group| group.poses.len()).sum::<usize>()
}

/// Writes the tables, poses relative to their group's pivot.
pub(super) fn write_tables(out: &mut Vec<u8>, scene: &Scene<'_>) {
    let mut write = |values: &[f32]| out.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    for InstanceGroup { shape, poses } in tables(scene) {
        poses.iter().for_each(|pose| write(&(pose.base - shape.pivot).to_array()));
        poses.iter().for_each(|pose| write(&pose.rotation.to_array()));
        poses.iter().for_each(|pose| write(&pose.scale.to_array()));
    }
}

/// Pushes the nodes of all copies. `first_part` is the node of the model's first part, `meshes` are those of the groups,
/// and the tables begin at byte `at` of the buffer.
pub(super) fn push(
    root: &mut json::Root,
    scene: &Scene<'_>,
    first_part: u32,
    meshes: &[Index<json::Mesh>],
    at: usize,
) {
    let Some((groups, form)) = scene.instances.filter(|(groups, _)| !groups.is_empty()) else { return };
    let mut table = None;
    if form == InstanceForm::Gpu {
        table = Some(Table { view: root.push(view(at, table_bytes(scene), None)), used: 0 });
        root.extensions_used.push(INSTANCING.to_owned());
        root.extensions_required.push(INSTANCING.to_owned());
    }
    for (group, mesh) in groups.iter().zip(meshes) {
        let above =
            group.shape.parent.map(|parent| (first_part as usize + parent, scene.model.parts[parent].pivot));
        let mut of_group =
            node(group.shape.name.to_string(), group.shape.pivot - above.map_or(glam::Vec3::ZERO, |a| a.1));
        match &mut table {
            Some(table) => {
                of_group.mesh = Some(*mesh);
                of_group.extensions = Some(table.next(root, group.poses.len()));
            }
            None => of_group.children = Some(copies(root, group, *mesh)),
        }
        let index = root.push(of_group);
        match above {
            Some((parent, _)) => root.nodes[parent].children.get_or_insert_default().push(index),
            None => root.scenes.iter_mut().for_each(|scene| scene.nodes.push(index)),
        }
    }
}

/// A node for each copy of a group.
fn copies(root: &mut json::Root, group: &InstanceGroup, mesh: Index<json::Mesh>) -> Vec<Index<json::Node>> {
    let copy = |Pose { base, rotation, scale }: &Pose| json::Node {
        mesh: Some(mesh),
        translation: Some((base - group.shape.pivot).to_array()),
        rotation: Some(UnitQuaternion(rotation.to_array())),
        scale: Some(scale.to_array()),
        ..Default::default()
    };
    group.poses.iter().map(|pose| root.push(copy(pose))).collect()
}

/// The view of the tables, and how far it is used up.
struct Table {
    view: Index<View>,
    used: usize,
}

impl Table {
    /// The extension of a node with the next `count` copies.
    fn next(&mut self, root: &mut json::Root, count: usize) -> NodeExtensions {
        let mut attributes = serde_json::Map::new();
        for (name, kind, numbers) in ATTRIBUTES {
            let accessor = accessor(Some(self.view), self.used, count, ComponentType::F32, kind);
            self.used += 4 * numbers * count;
            attributes.insert(name.to_owned(), Value::from(root.push(accessor).value()));
        }
        let others = [(INSTANCING.to_owned(), json!({ "attributes": attributes }))];
        NodeExtensions { others: others.into_iter().collect() }
    }
}
