//! The individuals of a garden: each kind's variants, built once, with one mesh for each of their materials.
//!
//! The individuals of a species have the seeds that follow each other from the kind's first one, so each is also to be had by itself:
//! `penstemon grow rose --seed 2`. A finished model has one. Materials that are the same are one for the whole garden.
//!
//! How they get few triangles is the pipeline's: what may lose foliage keeps to a budget of triangles, what may not becomes coarser
//! (`pipeline::triangle_budget`). For wide gardens their foliage may be cards, or each of them two crossing pictures ([`Form`]).
//!
//! Limits: a wide garden has plants of few triangles; how many is a share of what all may have ([`triangles_of_each`]). Each individual
//! with cards has a picture of its own.

use crate::model::{Mesh, Model, PartKind};
use crate::pipeline::{self, Bloom, Built, Level, Params, Seed, Source};
use crate::plant::Material;
use crate::sketch::Sketch;
use crate::species::Species;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

/// Triangles that the plants of a garden have together where nobody says otherwise, and its individuals.
const TRIANGLES_OF_ALL: (usize, usize) = (20_000_000, 500_000);
/// Most triangles that each has then.
const MOST_TRIANGLES: usize = 40_000;
/// Fewest triangles that it becomes coarser for; it may have more at its coarsest.
pub const FEWEST_TRIANGLES: u32 = 2000;

/// How many triangles a plant should have of which there are so many, copies of so many individuals.
pub fn triangles_of_each(plants: usize, individuals: usize) -> u32 {
    let share = (TRIANGLES_OF_ALL.0 / plants.max(1)).min(TRIANGLES_OF_ALL.1 / individuals.max(1));
    share.clamp(FEWEST_TRIANGLES as usize, MOST_TRIANGLES) as u32
}

/// Different remarks about the individuals of a kind that are kept.
const MOST_REMARKS: usize = 20;

/// What individuals are made of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Form {
    /// Wood, leaves and flowers.
    #[default]
    Whole,
    /// Wood, and cards of leaves, flowers and thin twigs.
    Cards,
    /// Two crossing pictures of the plant.
    Billboards,
}

/// What makes the individuals of a kind.
#[derive(Clone, Debug)]
pub enum Grower {
    /// A species that makes itself.
    Species {
        /// The species.
        species: Box<Species>,
        /// Its parameters.
        params: Box<Params>,
        /// Age in years, where it grows.
        age: Option<f32>,
        /// Seed of the first individual.
        first_seed: u64,
        /// What they are made of.
        form: Form,
    },
    /// A drawing.
    Drawing {
        /// The drawing; the first individual has its own seed.
        sketch: Box<Sketch>,
        /// Its species.
        species: Box<Species>,
        /// Its parameters.
        params: Box<Params>,
        /// What the individuals are made of.
        form: Form,
    },
    /// A finished model.
    Model(Box<Model>),
}

impl Grower {
    /// Makes individuals of at most about so many triangles, or of as many as its parameters say. Flowers and leaves of roses and
    /// blooms all stay while they are no cards, so there may be more; trees, drawings and cards lose foliage where they must, as
    /// `model.budget.triangles` says.
    pub fn fit(&mut self, usual: u32) {
        let (species, params, form) = match self {
            Self::Species { species, params, form, .. } => (Some(species), params, *form),
            Self::Drawing { params, form, .. } => (None, params, *form),
            Self::Model(_) => return,
        };
        params.cards.used |= form == Form::Cards;
        let may_thin = params.cards.used || species.is_none_or(|species| species.growth.is_some());
        let asked = std::mem::take(&mut params.model.budget.triangles);
        let wanted = if asked > 0 { asked } else { usual };
        if form == Form::Billboards {
            return;
        }
        let is_too_fine = |built: &Built| built.model.triangle_count() > wanted as usize;
        let Some(built) = self.built(0).filter(is_too_fine) else { return };
        match self {
            Self::Species { params, .. } | Self::Drawing { params, .. } if may_thin => {
                params.model.budget.triangles = wanted;
            }
            Self::Species { params, .. } | Self::Drawing { params, .. } => {
                params.model = pipeline::coarsened(&built.plant, &params.model, u64::from(wanted));
            }
            Self::Model(_) => {}
        }
    }

    /// How many individuals there are if so many are wanted.
    pub fn variants(&self, wanted: u32) -> u32 {
        if matches!(self, Self::Model(_)) { 1 } else { wanted.max(1) }
    }

    /// A finished individual; none of a finished model.
    fn built(&self, variant: u32) -> Option<Built> {
        match self {
            Self::Species { species, params, age, first_seed, form: _ } => {
                let number = first_seed + u64::from(variant);
                let seed = Seed { number, age: *age, ..Seed::default() };
                let grows = species.growth.is_some() || species.rose.is_some();
                let bloom = Bloom { number };
                let source = if grows { Source::Seed(&seed) } else { Source::Bloom(&bloom) };
                Some(pipeline::build(source, species, params))
            }
            Self::Drawing { sketch, species, params, form: _ } => {
                let sketch =
                    Sketch { seed: sketch.seed.wrapping_add(u64::from(variant)), ..Sketch::clone(sketch) };
                Some(pipeline::build(&sketch, species, params))
            }
            Self::Model(_) => None,
        }
    }

    /// The model of an individual, and what was odd about it.
    fn grow(&self, variant: u32) -> (Model, Vec<String>) {
        if let Self::Model(model) = self {
            return (Model::clone(model), Vec::new());
        }
        let Some(mut built) = self.built(variant) else { return Default::default() };
        let remarks = built.remarks.iter().map(ToString::to_string).collect();
        if let Self::Species { params, form: Form::Billboards, .. }
        | Self::Drawing { params, form: Form::Billboards, .. } = self
        {
            let flat = pipeline::levels(&built.plant, &built.model, params, &[Level::Billboards]).pop();
            built.model = flat.unwrap_or_default();
        }
        (built.model, remarks)
    }
}

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

/// All individuals of a garden.
#[derive(Clone, Debug, Default)]
pub struct Stock {
    /// Their materials.
    pub materials: Vec<Material>,
    /// The kinds.
    pub kinds: Vec<KindStock>,
}

impl Stock {
    /// Builds so many individuals of a further kind; with `height` above 0 their mean height becomes that, metres.
    pub fn add(&mut self, name: &str, grower: &Grower, variants: u32, height: f32) {
        let name = self.unused_name(name);
        let grown: Vec<(Model, Vec<String>)> =
            (0..grower.variants(variants)).into_par_iter().map(|variant| grower.grow(variant)).collect();
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
    fn triangles_are_shared_out_by_the_number_of_plants() {
        assert_eq!(
            [10, 1000, 5000, 1_000_000].map(|plants| triangles_of_each(plants, 1)),
            [40_000, 20_000, 4000, 2000]
        );
        assert_eq!(triangles_of_each(10, 50), 10_000);
    }

    #[test]
    fn individuals_have_a_mesh_for_each_material_and_all_their_triangles() {
        let species = Box::new(Species::built_in("daisy").unwrap());
        let params = pipeline::params_of_species(&species, &[]).unwrap();
        let mut grower = Grower::Species {
            species,
            params: Box::new(params),
            age: None,
            first_seed: 1,
            form: Form::Whole,
        };
        let whole = grower.grow(0).0.triangle_count();
        grower.fit(25_000);
        let fitted = grower.grow(0).0;
        assert!(whole > 30_000 && (15_000..=25_000).contains(&fitted.triangle_count()), "{whole}");
        let mut stock = Stock::default();
        stock.add("daisy", &grower, 2, 0.0);
        stock.add("fields/daisy.toml", &grower, 1, 0.5);
        let names: Vec<&str> = stock.kinds.iter().map(|kind| kind.name.as_str()).collect();
        assert_eq!(names, ["daisy", "daisy_2"]);
        let (model, _) = grower.grow(1);
        let individual = &stock.kinds[0].individuals[1];
        assert_eq!(individual.triangle_count(), model.triangle_count());
        assert!(individual.surfaces.is_sorted_by_key(|surface| surface.material));
        assert!(individual.surfaces.iter().all(|surface| surface.mesh.check_indices().is_ok()));
        assert!(individual.surfaces.len() > 2);
        assert_eq!(
            stock.materials.len(),
            model.materials.iter().filter(|m| stock.materials.contains(m)).count()
        );
        assert!((stock.kinds[1].individuals[0].height() - 0.5).abs() < 1e-4);
    }

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
