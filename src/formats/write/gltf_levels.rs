//! Levels of detail in a glTF document: the extension `MSFT_lod`.
//!
//! A node for each level, called like `oak_LOD1`, carries its plants. The scene has that of the finest alone, which names the
//! others; a viewer that does not know the extension shows the finest. Which share of the screen's height the plant has to fill for
//! each level stands in the node's extras (`model::screen_shares`); below the last nothing is shown.

use super::Scene;
use super::gltf_tree::node;
use crate::formats::gltf_extensions::LEVELS;
use crate::model::{Part, screen_shares};
use glam::Vec3;
use gltf_json as json;
use json::Index;
use json::extensions::scene::Node as NodeExtensions;
use serde_json::json;
use serde_json::value::to_raw_value;

/// Puts the plants of a document, whose nodes are its first, below nodes for their levels; does nothing without levels.
///
/// # Errors
/// The encoder's.
pub(super) fn push(root: &mut json::Root, scene: &Scene<'_>) -> serde_json::Result<()> {
    let count = scene.level_of_specimen.iter().max().map_or(0, |last| last + 1);
    if count < 2 {
        return Ok(());
    }
    let plants = |level: usize| {
        let of_level = scene.level_of_specimen.iter().zip(0..).filter(move |(of, _)| **of == level);
        of_level.map(|(_, plant)| Index::new(plant)).collect::<Vec<_>>()
    };
    let nodes: Vec<Index<json::Node>> = (0..count)
        .map(|level| {
            let mut of_level = node(format!("{}_LOD{level}", scene.stem), Vec3::ZERO);
            of_level.children = Some(plants(level));
            root.push(of_level)
        })
        .collect();
    let others: Vec<usize> = nodes[1..].iter().map(|node| node.value()).collect();
    let finest = &mut root.nodes[nodes[0].value()];
    let extension = (LEVELS.to_owned(), json!({ "ids": others }));
    finest.extensions = Some(NodeExtensions { others: [extension].into_iter().collect() });
    finest.extras =
        Some(to_raw_value(&json!({ "MSFT_screencoverage": screen_shares(&triangles(scene, count)) }))?);
    root.extensions_used.push(LEVELS.to_owned());
    root.scenes.iter_mut().for_each(|scene| scene.nodes = vec![nodes[0]]);
    Ok(())
}

/// Triangles of each level, copies counted.
fn triangles(scene: &Scene<'_>, levels: usize) -> Vec<usize> {
    let mut triangles = vec![0; levels];
    let of_groups = scene.groups().iter().map(|group| (&group.shape, group.poses.len()));
    let parts = scene.model.parts.iter().map(|part| (part, 1)).chain(of_groups);
    let mut count = |(part, times): (&Part, usize)| {
        if let Some(level) = scene.level_of_specimen.get(part.specimen) {
            triangles[*level] += times * part.mesh.triangles.len();
        }
    };
    parts.for_each(&mut count);
    triangles
}
