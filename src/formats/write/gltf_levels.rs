//! Levels of detail in a glTF document: the extension `MSFT_lod`.
//!
//! A node for each level, called like `oak_LOD1`, carries its plants. The scene has that of the finest alone, which names the
//! others; a viewer that does not know the extension shows the finest. Which share of the screen's height the plant has to fill for
//! each level stands in the node's extras: it falls with the square root of the triangles, so that these are about equally dense on
//! the screen, and below the last nothing is shown.

use super::Scene;
use super::gltf_tree::node;
use crate::formats::gltf_extensions::LEVELS;
use crate::model::Part;
use glam::Vec3;
use gltf_json as json;
use json::Index;
use json::extensions::scene::Node as NodeExtensions;
use serde_json::json;
use serde_json::value::to_raw_value;

/// The share of the screen below which the second level is shown, and the last of all.
const SECOND: f32 = 0.5;
const NOTHING: f32 = 0.004;

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
        Some(to_raw_value(&json!({ "MSFT_screencoverage": coverages(&triangles(scene, count)) }))?);
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

/// For each level the share of the screen down to which it is shown.
fn coverages(triangles: &[usize]) -> Vec<f32> {
    let of_second = triangles.get(1).copied().unwrap_or(1).max(1) as f32;
    let share = |of: &usize| (SECOND * (*of as f32 / of_second).sqrt()).max(NOTHING);
    triangles.iter().skip(1).map(share).chain([NOTHING]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coarser_levels_are_for_smaller_pictures() {
        let found = coverages(&[400_000, 40_000, 10_000, 8]);
        assert!((found[0] - 0.5).abs() < 1e-6 && (found[1] - 0.25).abs() < 1e-6, "{found:?}");
        assert!(found.is_sorted_by(|a, b| a > b) && found[3] == NOTHING, "{found:?}");
    }
}
