//! The individuals of a garden: each kind's variants with one mesh for each of their materials.
//!
//! Who makes them is the pipeline's (`pipeline/individuals.rs`). Materials that are the same are one for the whole garden. An individual
//! may have coarser forms for where its copies are small in a picture (`seen.rs`).
//!
//! Limits: each individual with cards has a picture of its own.

use crate::geom::polyline;
use crate::model::{Mesh, Model, PartKind};
use crate::plant::Material;
use glam::{Vec3, Vec3Swizzles as _};
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

/// Different remarks about the individuals of a kind that are kept.
const MOST_REMARKS: usize = 20;

/// What a plant of the garden was grown to.
#[derive(Clone, Debug, Default)]
pub struct Grown {
    /// Its model.
    pub model: Model,
    /// Coarser ones for where it is small in a picture, by falling size.
    pub coarser: Vec<Coarser<Model>>,
    /// Ones for where it is smaller still.
    pub views: Views<Model>,
    /// What was odd about it.
    pub remarks: Vec<String>,
}

impl From<Model> for Grown {
    fn from(model: Model) -> Self {
        Self { model, ..Self::default() }
    }
}

/// A coarser form of a plant.
#[derive(Clone, Debug, PartialEq)]
pub struct Coarser<T> {
    /// The form.
    pub form: T,
    /// It is fine enough where the sphere around the plant is at most so wide in a picture, pixels.
    pub pixels: f32,
}

/// Forms of a plant that are seen from one side each.
#[derive(Clone, Debug, PartialEq)]
pub struct Views<T> {
    /// The form of each side, with the direction toward the viewer, of length 1.
    pub forms: Vec<(Vec3, T)>,
    /// As of [`Coarser`].
    pub pixels: f32,
}

impl<T> Default for Views<T> {
    fn default() -> Self {
        Self { forms: Vec::new(), pixels: 0.0 }
    }
}

/// A surface of an individual in one material.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Index into [`Stock::materials`].
    pub material: usize,
    /// What it is.
    pub kind: PartKind,
    /// Its triangles, around the foot of the plant.
    pub mesh: Arc<Mesh>,
}

/// An individual.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Individual {
    /// Its surfaces, by rising material.
    pub surfaces: Vec<Surface>,
    /// Coarser forms for where it is small in a picture, by falling size.
    pub coarser: Vec<Coarser<Vec<Surface>>>,
    /// Forms for where it is smaller still.
    pub views: Views<Vec<Surface>>,
}

impl Individual {
    /// How many triangles it has.
    pub fn triangle_count(&self) -> usize {
        triangles_of(&self.surfaces)
    }

    /// How many corners its triangles share.
    pub fn vertex_count(&self) -> usize {
        self.surfaces.iter().map(|surface| surface.mesh.vertices.len()).sum()
    }

    /// All forms of it: the finest, the coarser ones, those from one side each.
    pub fn forms(&self) -> impl Iterator<Item = &[Surface]> {
        let coarser = self.coarser.iter().map(|coarser| &*coarser.form);
        std::iter::once(&*self.surfaces)
            .chain(coarser)
            .chain(self.views.forms.iter().map(|(_, form)| &**form))
    }

    /// How many triangles its coarsest form has.
    pub fn fewest_triangles(&self) -> usize {
        let view = self.views.forms.first().map(|(_, form)| form);
        triangles_of(view.or(self.coarser.last().map(|last| &last.form)).unwrap_or(&self.surfaces))
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
        let all_scaled = |surfaces: &[Surface]| surfaces.iter().map(scaled).collect();
        let coarser = |of: &Coarser<Vec<Surface>>| Coarser { form: all_scaled(&of.form), pixels: of.pixels };
        let Views { forms, pixels } = &self.views;
        let forms = forms.iter().map(|(toward, form)| (*toward, all_scaled(form))).collect();
        Self {
            surfaces: all_scaled(&self.surfaces),
            coarser: self.coarser.iter().map(coarser).collect(),
            views: Views { forms, pixels: *pixels },
        }
    }
}

fn triangles_of(surfaces: &[Surface]) -> usize {
    surfaces.iter().map(|surface| surface.mesh.triangles.len()).sum()
}

/// Individuals of one kind.
#[derive(Clone, Debug, PartialEq)]
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
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stock {
    /// Their materials.
    pub materials: Vec<Material>,
    /// The kinds.
    pub kinds: Vec<KindStock>,
}

impl Stock {
    /// Adds a further kind of such individuals; with `height` above 0 their mean height becomes that, metres.
    pub fn add(&mut self, name: &str, grown: Vec<Grown>, height: f32) {
        let name = self.unused_name(name);
        let (mut individuals, mut remarks) = (Vec::with_capacity(grown.len()), Vec::new());
        for Grown { model, coarser, views, remarks: said } in grown {
            let surfaces = self.surfaces(&name, &model);
            let coarser = coarser
                .into_iter()
                .map(|Coarser { form, pixels }| Coarser { form: self.surfaces(&name, &form), pixels });
            let coarser = coarser.collect();
            let forms = views.forms.into_iter().map(|(toward, form)| (toward, self.surfaces(&name, &form)));
            let views = Views { forms: forms.collect(), pixels: views.pixels };
            individuals.push(Individual { surfaces, coarser, views });
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
    fn surfaces(&mut self, kind: &str, model: &Model) -> Vec<Surface> {
        let mut meshes: BTreeMap<usize, (PartKind, Mesh)> = BTreeMap::new();
        for part in &model.flattened().parts {
            for (material, triangles) in part.material_slots() {
                let material = self.material(kind, &model.materials[material]);
                let (_, mesh) = meshes.entry(material).or_insert_with(|| (part.kind, Mesh::default()));
                append_some(mesh, &part.mesh, triangles);
            }
        }
        let surface = |(material, (kind, mesh))| Surface { material, kind, mesh: Arc::new(mesh) };
        meshes.into_iter().map(surface).collect()
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
