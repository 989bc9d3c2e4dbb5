//! The individuals of a garden: each kind's variants with one mesh for each of their materials.
//!
//! Who makes them is the pipeline's (`pipeline/individuals.rs`). Materials that are the same are one for the whole garden.
//!
//! Limits: each individual with cards has a picture of its own.

use crate::geom::polyline;
use crate::model::{Mesh, Model, PartKind};
use crate::plant::Material;
use glam::Vec3Swizzles as _;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

/// Different remarks about the individuals of a kind that are kept.
const MOST_REMARKS: usize = 20;

/// A surface of an individual in one material.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Index into [`Stock::materials`].
    pub material: usize,
    /// What it is.
    pub kind: PartKind,
    /// Its triangles, around the foot of the plant.
    pub mesh: Arc<Mesh>,
}

/// An individual.
#[derive(Clone, Debug, Default)]
pub struct Individual {
    /// Its surfaces, by rising material.
    pub surfaces: Vec<Surface>,
}

impl Individual {
    /// How many triangles it has.
    pub fn triangle_count(&self) -> usize {
        self.surfaces.iter().map(|surface| surface.mesh.triangles.len()).sum()
    }

    /// How high it is above its foot, metres.
    pub fn height(&self) -> f32 {
        let points = self.surfaces.iter().flat_map(|surface| &surface.mesh.points);
        points.map(|point| point.y).fold(0.0, f32::max)
    }

    /// How wide it is, on average of its two sides, metres.
    fn width(&self) -> f32 {
        let points = self.surfaces.iter().flat_map(|surface| &surface.mesh.points);
        let (low, high) = polyline::bounds(points.map(|point| point.xz()));
        if low.cmple(high).all() { (high - low).element_sum() / 2.0 } else { 0.0 }
    }

    fn scaled(&self, by: f32) -> Self {
        let scaled = |surface: &Surface| {
            let points = surface.mesh.points.iter().map(|point| point * by).collect();
            Surface { mesh: Arc::new(Mesh { points, ..Mesh::clone(&surface.mesh) }), ..surface.clone() }
        };
        Self { surfaces: self.surfaces.iter().map(scaled).collect() }
    }
}

/// Individuals of one kind.
#[derive(Clone, Debug)]
pub struct KindStock {
    /// The kind's name, of letters, digits and `_`; no other has it.
    pub name: String,
    /// The individuals.
    pub individuals: Vec<Individual>,
    /// What was odd about them, each said once.
    pub remarks: Vec<String>,
}

impl KindStock {
    /// How wide they are on average, metres.
    pub fn width(&self) -> f32 {
        self.individuals.iter().map(Individual::width).sum::<f32>() / self.individuals.len().max(1) as f32
    }
}

/// All individuals of a garden.
#[derive(Clone, Debug, Default)]
pub struct Stock {
    /// Their materials.
    pub materials: Vec<Material>,
    /// The kinds.
    pub kinds: Vec<KindStock>,
}

impl Stock {
    /// Adds a further kind of such individuals, each with what was odd about it; with `height` above 0 their mean height becomes
    /// that, metres.
    pub fn add(&mut self, name: &str, grown: Vec<(Model, Vec<String>)>, height: f32) {
        let name = self.unused_name(name);
        let (mut individuals, mut remarks) = (Vec::with_capacity(grown.len()), Vec::new());
        for (model, said) in grown {
            individuals.push(self.individual(&name, &model));
            for remark in said {
                if remarks.len() < MOST_REMARKS && !remarks.contains(&remark) {
                    remarks.push(remark);
                }
            }
        }
        let mean = individuals.iter().map(Individual::height).sum::<f32>() / individuals.len().max(1) as f32;
        if height > 0.0 && mean > 0.0 {
            individuals.iter_mut().for_each(|individual| *individual = individual.scaled(height / mean));
        }
        self.kinds.push(KindStock { name, individuals, remarks });
    }

    /// How many individuals there are.
    pub fn individual_count(&self) -> usize {
        self.kinds.iter().map(|kind| kind.individuals.len()).sum()
    }

    /// How many triangles they have.
    pub fn triangle_count(&self) -> usize {
        self.kinds.iter().flat_map(|kind| &kind.individuals).map(Individual::triangle_count).sum()
    }

    fn unused_name(&self, name: &str) -> String {
        let stem = name.rsplit(['/', '\\']).next().unwrap_or(name);
        let stem = stem.rsplit_once('.').map_or(stem, |(stem, _)| stem);
        let plain: String = stem.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
        let plain = if plain.is_empty() { "plant".to_owned() } else { plain };
        let is_free = |name: &String| self.kinds.iter().all(|kind| kind.name != *name);
        let mut names = std::iter::once(plain.clone()).chain((2..).map(|n| format!("{plain}_{n}")));
        names.find(is_free).unwrap_or(plain)
    }

    /// A model by its materials, which join those of the garden.
    fn individual(&mut self, kind: &str, model: &Model) -> Individual {
        let mut meshes: BTreeMap<usize, (PartKind, Mesh)> = BTreeMap::new();
        for part in &model.flattened().parts {
            for (material, triangles) in part.material_slots() {
                let material = self.material(kind, &model.materials[material]);
                let (_, mesh) = meshes.entry(material).or_insert_with(|| (part.kind, Mesh::default()));
                append_some(mesh, &part.mesh, triangles);
            }
        }
        let surface = |(material, (kind, mesh))| Surface { material, kind, mesh: Arc::new(mesh) };
        Individual { surfaces: meshes.into_iter().map(surface).collect() }
    }

    /// The garden's number of a material, whose name gets that of the kind before it if another has it.
    fn material(&mut self, kind: &str, material: &Material) -> usize {
        let named = |name: String| Material { name, ..material.clone() };
        let prefixed = format!("{kind}_{}", material.name);
        let numbered = (2..).map(|number| named(format!("{prefixed}_{number}")));
        let mut candidates = [material.clone(), named(prefixed.clone())].into_iter().chain(numbered);
        loop {
            let Some(candidate) = candidates.next() else { return 0 };
            match self.materials.iter().position(|known| known.name == candidate.name) {
                Some(known) if self.materials[known] == candidate => return known,
                Some(_) => {}
                None => {
                    self.materials.push(candidate);
                    return self.materials.len() - 1;
                }
            }
        }
    }
}

/// Appends some triangles of a mesh with what they need of it.
fn append_some(to: &mut Mesh, from: &Mesh, triangles: Range<usize>) {
    if triangles.len() == from.triangles.len() {
        to.append(from);
        return;
    }
    let mut points: Vec<Option<u32>> = vec![None; from.points.len()];
    let mut vertices: Vec<Option<u32>> = vec![None; from.vertices.len()];
    for triangle in &from.triangles[triangles] {
        let corner = triangle.map(|old| {
            let vertex = from.vertices[old as usize];
            *vertices[old as usize].get_or_insert_with(|| {
                let point = *points[vertex.point as usize].get_or_insert_with(|| {
                    to.points.push(from.points[vertex.point as usize]);
                    to.points.len() as u32 - 1
                });
                to.vertices.push(crate::model::Vertex { point, ..vertex });
                to.vertices.len() as u32 - 1
            })
        });
        to.triangles.push(corner);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn some_triangles_of_a_mesh_come_with_what_they_need() {
        let vertex = |point| crate::model::Vertex { point, normal: Vec3::Y, uv: glam::Vec2::ZERO };
        let points = (0..5).map(|k| Vec3::new(k as f32, 0.0, (k * k) as f32)).collect();
        let triangles = vec![[0, 1, 2], [2, 3, 4]];
        let from = Mesh { points, vertices: (0..5).map(vertex).collect(), triangles, breaks: vec![1] };
        let mut to = Mesh::default();
        append_some(&mut to, &from, 1..2);
        append_some(&mut to, &from, 0..1);
        assert_eq!((to.points.len(), to.triangles.len()), (6, 2));
        assert_eq!(to.corners(to.triangles[0]), from.corners([2, 3, 4]));
        assert_eq!(to.corners(to.triangles[1]), from.corners([0, 1, 2]));
    }
}
