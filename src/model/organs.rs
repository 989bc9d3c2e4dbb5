//! Organs to meshes: blades, solids and filaments, one of them or many in one part.
//!
//! Blades of one template are triangulated once, before any part is made, and those that are copies of one shape bent once.
//! Bodies are appended in their order; where a part has several materials its triangles are ordered by them.

use super::blade::{self, BladeScratch};
use super::cache::{Cache, Template};
use super::copies::Copies;
use super::flat::{self, FlatScratch};
use super::instances::Pose;
use super::mesh::Mesh;
use super::parts::Piece;
use super::recipe::Recipe;
use super::solids::{self, Stand};
use super::tube::TubeScratch;
use super::{ModelParams, filaments};
use crate::plant::{Blade, Organ, Plant, Shape};
use std::collections::BTreeMap;

/// Memory that is used again for every part.
#[derive(Default)]
pub(super) struct OrganScratch {
    flat: FlatScratch,
    blade: BladeScratch,
    tube: TubeScratch,
}

/// What the organs of one plant have in common.
pub(super) struct OrganWorkshop<'a> {
    plant: &'a Plant,
    params: &'a ModelParams,
    templates: BTreeMap<u32, Template>,
    copies: Copies,
}

impl<'a> OrganWorkshop<'a> {
    pub(super) fn new(plant: &'a Plant, params: &'a ModelParams, cache: &mut Cache) -> Self {
        Self { plant, params, templates: templates(plant, params, cache), copies: Copies::of(plant) }
    }

    /// Everything that [`Self::mesh`] reads but the parameters.
    pub(super) fn write_recipe(&self, slots: &[Vec<(usize, Piece)>], recipe: &mut Recipe) {
        let described = |&(organ, piece): &(usize, Piece)| {
            let shape = self.shape(organ);
            let template = if let Shape::Blade(blade) = shape { self.template(blade) } else { None };
            (shape, piece, template.map(|shared| shared.name))
        };
        recipe.organs(slots.iter().map(|pieces| pieces.iter().map(described)));
    }

    /// The mesh of pieces of organs, a list for each material.
    pub(super) fn mesh(&self, slots: &[Vec<(usize, Piece)>], scratch: &mut OrganScratch) -> Mesh {
        let mut mesh = Mesh::default();
        for (slot, pieces) in slots.iter().enumerate() {
            if slot > 0 {
                mesh.breaks.push(mesh.triangles.len() as u32);
            }
            for run in pieces.chunk_by(|a, b| self.is_filament(a.0) == self.is_filament(b.0)) {
                if self.is_filament(run[0].0) {
                    let pieces = run.iter().map(|&(organ, piece)| (self.shape(organ), piece));
                    filaments::append(&mut mesh, pieces, &self.params.solid, &mut scratch.tube);
                } else {
                    self.append_bodies(run, &mut mesh, scratch);
                }
            }
        }
        mesh
    }

    /// Takes the blades that are copies of a shape out of a part's pieces: their poses by material slot and shape.
    pub(super) fn take_copies(
        &self,
        slots: &mut [Vec<(usize, Piece)>],
        scratch: &mut OrganScratch,
    ) -> BTreeMap<(usize, u32), Vec<Pose>> {
        let mut copies: BTreeMap<(usize, u32), Vec<Pose>> = BTreeMap::new();
        for (slot, pieces) in slots.iter_mut().enumerate() {
            pieces.retain(|&(organ, _)| match self.pose(organ, scratch) {
                Some((shape, pose)) => {
                    copies.entry((slot, shape)).or_default().push(pose);
                    false
                }
                None => true,
            });
        }
        copies
    }

    fn pose(&self, organ: usize, scratch: &mut OrganScratch) -> Option<(u32, Pose)> {
        let Shape::Blade(blade) = self.shape(organ) else { return None };
        let flat = self.template(blade)?.flat.as_ref().as_ref()?;
        let make =
            |standing: &Blade| blade::copied_shape(standing, flat, &self.params.blade, &mut scratch.blade);
        self.copies.pose(organ, blade, make)
    }

    /// The mesh of a shape of which there are copies.
    pub(super) fn copied_mesh(&self, shape: u32) -> Mesh {
        self.copies.mesh(shape).cloned().unwrap_or_default()
    }

    fn shape(&self, organ: usize) -> &'a Shape {
        &self.plant.organs[organ].shape
    }

    fn is_filament(&self, organ: usize) -> bool {
        matches!(self.shape(organ), Shape::Filament { .. })
    }

    /// Appends blades and solids.
    fn append_bodies(&self, run: &[(usize, Piece)], mesh: &mut Mesh, scratch: &mut OrganScratch) {
        for (done, &(organ, _)) in run.iter().enumerate() {
            let before = mesh.counts();
            match self.shape(organ) {
                Shape::Blade(blade) => self.append_blade((organ, blade), mesh, scratch),
                Shape::Dome { base, axis, radius, height } => {
                    let stand = Stand { base: *base, axis: *axis };
                    take_in(mesh, solids::dome(stand, (*radius, *height), &self.params.solid));
                }
                Shape::Lathe { base, axis, profile } => {
                    let stand = Stand { base: *base, axis: *axis };
                    take_in(mesh, solids::lathe(stand, profile, &self.params.solid));
                }
                Shape::Filament { .. } => {}
            }
            if done == 0 {
                mesh.reserve_more(before, run.len() - 1);
            }
        }
    }

    /// The triangulation that a blade shares with others.
    fn template(&self, blade: &Blade) -> Option<&Template> {
        blade.template.and_then(|number| self.templates.get(&number))
    }

    /// Appends the blade of an organ to an empty mesh or to other organs.
    fn append_blade(&self, (organ, blade): (usize, &Blade), mesh: &mut Mesh, scratch: &mut OrganScratch) {
        let params = &self.params.blade;
        let Some(Template { flat, .. }) = self.template(blade) else {
            let flat = flat::flatten(blade, params, &mut scratch.flat);
            let own = flat.and_then(|flat| blade::mesh(blade, &flat, params, &mut scratch.blade));
            return own.into_iter().for_each(|own| take_in(mesh, own));
        };
        let Some(flat) = flat.as_ref() else { return };
        let shape = |standing: &Blade| blade::copied_shape(standing, flat, params, &mut scratch.blade);
        if !self.copies.append(organ, blade, mesh, shape) {
            let own = blade::mesh(blade, flat, params, &mut scratch.blade);
            own.into_iter().for_each(|own| take_in(mesh, own));
        }
    }
}

/// Appends a mesh to another, or puts it into its place where that is empty.
fn take_in(mesh: &mut Mesh, own: Mesh) {
    if *mesh == Mesh::default() {
        *mesh = own;
    } else {
        mesh.append(&own);
    }
}

fn blade_of(organ: &Organ) -> Option<&Blade> {
    match &organ.shape {
        Shape::Blade(blade) => Some(blade),
        _ => None,
    }
}

/// The triangulations of all templates.
fn templates(plant: &Plant, params: &ModelParams, cache: &mut Cache) -> BTreeMap<u32, Template> {
    let mut firsts: BTreeMap<u32, &Blade> = BTreeMap::new();
    for blade in plant.organs.iter().filter_map(blade_of) {
        if let Some(template) = blade.template {
            firsts.entry(template).or_insert(blade);
        }
    }
    let (mut scratch, mut recipe) = (FlatScratch::default(), Recipe::default());
    let mut triangulated = |(number, blade): (u32, &Blade)| {
        recipe.template(blade);
        (number, cache.template(&recipe, || flat::flatten(blade, &params.blade, &mut scratch)))
    };
    firsts.into_iter().map(&mut triangulated).collect()
}
