//! Plant to meshes: every branch and organ becomes a [`Part`] of a [`Model`].
//!
//! Blades and tubes are closed and manifold, wound counter-clockwise seen from outside, with UVs that fit the part's
//! texture. Nothing here knows a drawing: the input is a [`FinishedPlant`](crate::plant::FinishedPlant), the output plain arrays. [`build`] is the stage.
//!
//! | file | what |
//! | --- | --- |
//! | `parts`, `part_names` | names, parents, specimens |
//! | `outline`, `sections`, `interior`, `flat` | a blade in its plane, triangulated |
//! | `relief`, `blade` | the blade bent and given thickness |
//! | `copies`, `instances` | leaves that are copies of one shape: baked into one mesh, or kept as copies |
//! | `spine`, `tube` | single branches |
//! | `limbs`, `joint`, `strip`, `wood` | branches that grow out of one another |
//! | `solids`, `filaments` | receptacles, fruits, pots |
//! | `organs` | all organs of one part |
//! | `build` | all parts at once, on all cores |
//! | `afford` | how fine a plant can be |
//! | `recipe`, `cache` | which parts are the same as last time |
//! | `quality`, `topology`, `crossing` | what is wrong with a mesh |
//! | `pick` | which branch or organ a ray meets |

mod afford;
mod blade;
mod build;
mod cache;
mod copies;
pub mod crossing;
mod disjoint_sets;
mod filaments;
mod flat;
pub mod instances;
mod interior;
pub mod invariants;
mod joint;
mod limbs;
pub mod mesh;
mod midline;
mod organs;
mod outline;
mod part_names;
mod parts;
pub mod pick;
pub mod quality;
mod recipe;
mod relief;
mod sections;
mod solids;
mod spine;
mod strip;
#[cfg(test)]
mod tests;
mod topology;
mod tube;
mod wood;

pub use afford::affordable;
pub use build::{ModelParams, build, build_instanced, rebuild};
pub use cache::Cache;
pub use flat::{BladeMeshParams, PlanarGraph, TriangulationScratch, triangulation_input};
pub use instances::{InstanceGroup, InstancedModel, Pose};
pub use mesh::{Mesh, Vertex};
pub use solids::SolidParams;
pub use tube::TubeParams;

use crate::plant::{Material, OrganKind};
use glam::Vec3;
use std::ops::Range;
use std::sync::Arc;

/// What a part is; `g` groups in OBJ and the part colours of the debugging view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PartKind {
    /// A branch.
    Wood,
    /// Anything that grows on one.
    Organ(OrganKind),
}

/// One connected piece of the plant.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Unique name, such as `wood` or `petal_12`.
    pub name: String,
    /// What it is.
    pub kind: PartKind,
    /// Index of the part that carries it: a branch's parent branch, an organ's branch. Always smaller than its own.
    pub parent: Option<usize>,
    /// Index of the plant within the drawing, counted from 0; all parts of one plant have the same number.
    pub specimen: usize,
    /// Where the part is attached, metres: the origin of its node in exported files.
    pub pivot: Vec3,
    /// Index into [`Model::materials`].
    pub material: usize,
    /// The same for the triangles from each of the mesh's breaks on.
    pub more_materials: Vec<usize>,
    /// The surface in world metres; shared with other models built with the same [`Cache`] if it has not changed.
    pub mesh: Arc<Mesh>,
}

impl Part {
    /// Every material of the part with its triangles, in the order of the mesh; none of them is empty.
    pub fn material_slots(&self) -> impl Iterator<Item = (usize, Range<usize>)> {
        let breaks = || self.mesh.breaks.iter().map(|&first| first as usize);
        let materials = std::iter::once(self.material).chain(self.more_materials.iter().copied());
        let ranges = std::iter::once(0).chain(breaks()).zip(breaks().chain([self.mesh.triangles.len()]));
        materials.zip(ranges.map(|(from, to)| from..to)).filter(|(_, triangles)| !triangles.is_empty())
    }
}

/// A finished plant, ready to be drawn or exported.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    /// Parts, parents before children.
    pub parts: Vec<Part>,
    /// The looks that parts refer to.
    pub materials: Vec<Material>,
}

impl Model {
    /// Leaves out every part that `keep` does not want; what it carried stands on its own.
    pub fn keep_parts(&mut self, keep: impl Fn(&Part) -> bool) {
        let mut kept = 0;
        let places: Vec<Option<usize>> = self
            .parts
            .iter()
            .map(|part| {
                keep(part).then(|| {
                    kept += 1;
                    kept - 1
                })
            })
            .collect();
        let mut is_kept = places.iter().map(Option::is_some);
        self.parts.retain(|_| is_kept.next().unwrap_or(false));
        for part in &mut self.parts {
            part.parent = part.parent.and_then(|parent| places[parent]);
        }
    }

    /// Vertices over all parts, as a renderer counts them.
    pub fn vertex_count(&self) -> usize {
        self.parts.iter().map(|p| p.mesh.vertices.len()).sum()
    }

    /// Triangles over all parts.
    pub fn triangle_count(&self) -> usize {
        self.parts.iter().map(|p| p.mesh.triangles.len()).sum()
    }

    /// Smallest and largest corner over all parts, `None` for an empty model.
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        let mut points = self.parts.iter().flat_map(|p| &p.mesh.points).copied();
        let first = points.next()?;
        Some(points.fold((first, first), |(lo, hi), p| (lo.min(p), hi.max(p))))
    }
}
