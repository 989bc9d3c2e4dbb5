//! Plant to meshes: every branch and organ becomes a [`Part`] of a [`Model`].
//!
//! Blades and tubes are closed and manifold, wound counter-clockwise seen from outside, with UVs that fit the part's
//! texture. Nothing here knows a drawing: the input is a [`FinishedPlant`](crate::plant::FinishedPlant), the output plain arrays. [`build`] is the stage.
//!
//! | file | what |
//! | --- | --- |
//! | `parts`, `piece`, `part_names` | which organs are one part; names, parents, specimens |
//! | `params` | how finely a plant is modelled |
//! | `outline`, `sections`, `interior`, `planar_graph`, `flat` | a blade in its plane, triangulated |
//! | `sharp` | the same of leaves without a rim |
//! | `relief`, `blade` | the blade bent and given thickness |
//! | `blade_uv` | where a blade's points lie in its picture |
//! | `card` | rectangles with pictures of foliage |
//! | `shapes`, `copies` | blades that are copies of few shapes |
//! | `instances` | copies by their shapes, for glTF |
//! | `capsules` | wood as capsules, for what collides with it |
//! | `levels` | several models of one plant as one |
//! | `spine`, `tube` | single branches |
//! | `limbs`, `rows`, `joint`, `bend`, `window`, `strip`, `wood`, `sealing` | branches that grow out of one another |
//! | `surface`, `wood_changes`, `wood_memory` | their surface made anew only near what changed |
//! | `solids`, `filaments` | receptacles, fruits, pots |
//! | `fineness` | how finely these are made, by their size and number |
//! | `organs` | all organs of one part |
//! | `build` | all parts at once, on all cores |
//! | `afford` | how fine a plant can be |
//! | `recipe`, `part_memory`, `cache` | which parts are the same as last time |
//! | `quality`, `topology`, `crossing` | what is wrong with a mesh |
//! | `measure` | what there is of a model and how far it reaches, meshes measured once |
//! | `pick` | which branch or organ a ray meets |

mod afford;
mod bend;
mod blade;
mod blade_uv;
mod build;
mod cache;
pub mod capsules;
mod card;
pub mod copies;
pub mod crossing;
mod disjoint_sets;
mod filaments;
mod fineness;
mod flat;
pub mod instances;
mod interior;
pub mod invariants;
mod joint;
mod levels;
mod limbs;
mod measure;
pub mod mesh;
mod midline;
mod organs;
mod outline;
mod params;
mod part_memory;
mod part_names;
mod parts;
pub mod pick;
mod piece;
mod planar_graph;
pub mod quality;
mod recipe;
mod relief;
mod rows;
mod sealing;
mod sections;
mod shapes;
mod sharp;
mod solids;
mod spike;
mod spine;
mod strip;
mod surface;
#[cfg(test)]
mod tests;
mod topology;
mod tube;
mod window;
mod wood;
mod wood_changes;
mod wood_memory;

pub use afford::{affordable, coarser, coarser_each, refined};
pub use blade_uv::BladeUv;
pub use build::{build, rebuild};
pub use cache::Cache;
pub use copies::{Copies, Placement};
pub use fineness::SolidParams;
pub use flat::{BladeMeshParams, triangulation_input};
pub use instances::{InstanceGroup, InstancedModel, Pose};
pub use levels::{Levels, NOTHING, screen_shares, shown_at};
pub use measure::{Measure, Measures};
pub use mesh::{Mesh, Vertex};
pub use params::{ModelParams, TriangleParams};
pub use planar_graph::{PlanarGraph, TriangulationScratch};
pub use recipe::PlantRecipe;
pub use tube::TubeParams;

use crate::plant::{Material, OrganKind};
use glam::Vec3;
use smol_str::SmolStr;
use std::ops::Range;
use std::sync::Arc;

/// What a part is; `g` groups in OBJ and the part colours of the debugging view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PartKind {
    /// A branch.
    Wood,
    /// Anything that grows on one.
    Organ(OrganKind),
    /// The ground of a garden.
    Ground,
}

/// One connected piece of the plant.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Unique name, such as `wood` or `petal_12`.
    pub name: SmolStr,
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
    /// The surface in world metres without its copies; shared with other models built with the same [`Cache`] if it has not
    /// changed.
    pub mesh: Arc<Mesh>,
    /// Blades that are copies of few shapes, whose triangles are not in the mesh.
    pub copies: Option<Arc<Copies>>,
}

impl Part {
    /// A surface by itself, in one material, at the origin of the first plant.
    pub fn alone(name: impl Into<SmolStr>, kind: PartKind, material: usize, mesh: Arc<Mesh>) -> Self {
        Self {
            name: name.into(),
            kind,
            parent: None,
            specimen: 0,
            pivot: Vec3::ZERO,
            material,
            more_materials: Vec::new(),
            mesh,
            copies: None,
        }
    }

    /// The material of this slot, 0 for the first.
    pub fn material_of_slot(&self, slot: u32) -> usize {
        let more = (slot as usize).checked_sub(1).and_then(|more| self.more_materials.get(more));
        more.copied().unwrap_or(self.material)
    }

    /// The materials that something of the part has, possibly with repetitions.
    pub fn materials(&self) -> impl Iterator<Item = usize> {
        let of_copies =
            self.copies.iter().flat_map(|copies| copies.placements.chunk_by(|a, b| a.slot == b.slot));
        let of_copies = of_copies.map(|run| self.material_of_slot(run[0].slot));
        self.material_slots().map(|(material, _)| material).chain(of_copies)
    }

    /// Triangles that are seen, every copy counted.
    pub fn triangle_count(&self) -> usize {
        let copies = self.copies.iter().flat_map(|copies| copies.iter());
        self.mesh.triangles.len() + copies.map(|(shape, _)| shape.triangles.len()).sum::<usize>()
    }

    /// Vertices, every copy counted; as triangles, copies that are stretched may have a few more.
    pub fn vertex_count(&self) -> usize {
        let copies = self.copies.iter().flat_map(|copies| copies.iter());
        self.mesh.vertices.len() + copies.map(|(shape, _)| shape.vertices.len()).sum::<usize>()
    }

    /// Every place of the surface, those of copies included.
    pub fn points(&self) -> impl Iterator<Item = Vec3> {
        let copies = self.copies.iter().flat_map(|copies| copies.iter());
        let placed = copies.flat_map(|(shape, placement)| placement.places(&shape.points));
        self.mesh.points.iter().copied().chain(placed)
    }

    /// Every material of the part's mesh with its triangles, in their order; none of them is empty.
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

    /// Vertices over all parts, counted as [`Part::vertex_count`] does.
    pub fn vertex_count(&self) -> usize {
        self.parts.iter().map(Part::vertex_count).sum()
    }

    /// Triangles over all parts, every copy counted.
    pub fn triangle_count(&self) -> usize {
        self.parts.iter().map(Part::triangle_count).sum()
    }

    /// Height of the lowest place of its ground that is seen from above, metres; `None` without ground.
    pub fn ground_level(&self) -> Option<f32> {
        let grounds = self.parts.iter().filter(|part| part.kind == PartKind::Ground).map(|part| &*part.mesh);
        let upper = |mesh: &'_ Mesh| {
            let upper = mesh.vertices.iter().filter(|vertex| vertex.normal.y > 0.1);
            upper.map(|vertex| mesh.points[vertex.point as usize].y).reduce(f32::min)
        };
        grounds.filter_map(upper).reduce(f32::min)
    }

    /// Smallest and largest corner over all parts, `None` for an empty model.
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        let mut points = self.parts.iter().flat_map(Part::points);
        let first = points.next()?;
        Some(points.fold((first, first), |(lo, hi), p| (lo.min(p), hi.max(p))))
    }
}
