//! The whole stage: plans the parts, meshes them on all cores and puts them together in order.
//!
//! Every part is made from the plant alone and results keep their places, so the bytes do not depend on the number of
//! threads. Blades of one template are triangulated once, before the parallel pass.
//!
//! Limits: a blade too small or too thin to be seen has no mesh and no part.

use super::blade::{self, BladeScratch};
use super::flat::{self, BladeMeshParams, FlatBlade, FlatScratch};
use super::parts::{self, Plan, Source};
use super::solids::{self, SolidParams, Stand};
use super::tube::{self, TubeParams, TubeScratch};
use super::{Mesh, Model, Part, filaments};
use crate::plant::{Blade, Organ, Plant, Shape};
use glam::Vec3;
use rayon::prelude::*;
use std::collections::BTreeMap;

crate::parameter_groups! {
    /// How finely a plant is modelled.
    pub struct ModelParams {
        /// Petals, leaves and sepals.
        blade: BladeMeshParams;
        /// Branches and stems.
        tube: TubeParams;
        /// Hearts of flowers, fruits and pots.
        solid: SolidParams;
    }
}

/// Parts that one thread takes at a time: fewer are not worth waking another thread for.
const BATCH: usize = 4;

/// Memory that each thread uses again for all its parts.
#[derive(Default)]
struct Scratch {
    flat: FlatScratch,
    blade: BladeScratch,
    tube: TubeScratch,
}

/// What the parts of one plant have in common.
struct Workshop<'a> {
    plant: &'a Plant,
    params: &'a ModelParams,
    templates: BTreeMap<u32, Option<FlatBlade>>,
    plant_size: f32,
}

/// Builds the meshes of a plant that keeps its invariants.
pub fn build(plant: &Plant, params: &ModelParams) -> Model {
    let plans = parts::plan(plant);
    let workshop =
        Workshop { plant, params, templates: templates(plant, params), plant_size: size_of(plant) };
    let meshes: Vec<Mesh> = plans
        .par_iter()
        .with_min_len(BATCH)
        .map_init(Scratch::default, |scratch, plan| workshop.mesh(&plan.source, scratch))
        .collect();
    let seen = |(plan, mesh): (Plan, Mesh)| (!mesh.triangles.is_empty()).then(|| part(plan, mesh));
    Model {
        parts: plans.into_iter().zip(meshes).filter_map(seen).collect(),
        materials: plant.materials.clone(),
    }
}

/// Branches always have meshes, so they keep their indices and carriers need no renumbering.
fn part(plan: Plan, mesh: Mesh) -> Part {
    let Plan { name, kind, parent, specimen, pivot, material, .. } = plan;
    Part { name, kind, parent, specimen, pivot, material, mesh }
}

fn blade_of(organ: &Organ) -> Option<&Blade> {
    match &organ.shape {
        Shape::Blade(blade) => Some(blade),
        _ => None,
    }
}

/// The triangulations of all templates.
fn templates(plant: &Plant, params: &ModelParams) -> BTreeMap<u32, Option<FlatBlade>> {
    let mut firsts: BTreeMap<u32, &Blade> = BTreeMap::new();
    for blade in plant.organs.iter().filter_map(blade_of) {
        if let Some(template) = blade.template {
            firsts.entry(template).or_insert(blade);
        }
    }
    let mut scratch = FlatScratch::default();
    firsts
        .into_iter()
        .map(|(template, blade)| (template, flat::flatten(blade, &params.blade, &mut scratch)))
        .collect()
}

/// The largest extent of the skeleton and of where organs stand, metres: the unit of all branch tolerances.
fn size_of(plant: &Plant) -> f32 {
    let skeleton = plant.branches.iter().flat_map(|b| b.points.iter().copied());
    let points = skeleton.chain(plant.organs.iter().map(Organ::base));
    let (lo, hi) = points.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(lo, hi), p| (lo.min(p), hi.max(p)));
    let size = (hi - lo).max_element();
    if size > 0.0 { size } else { 1.0 }
}

impl Workshop<'_> {
    fn mesh(&self, source: &Source, scratch: &mut Scratch) -> Mesh {
        let params = self.params;
        match source {
            Source::Branch(i) => {
                tube::branch(&self.plant.branches[*i], &params.tube, self.plant_size, &mut scratch.tube)
            }
            Source::Filaments(pieces) => {
                let pieces = pieces.iter().map(|(i, piece)| (&self.plant.organs[*i], *piece));
                filaments::mesh(pieces, &params.solid, &mut scratch.tube)
            }
            Source::Organ(i) => match &self.plant.organs[*i].shape {
                Shape::Blade(blade) => self.blade(blade, scratch).unwrap_or_default(),
                Shape::Dome { base, axis, radius, height } => {
                    let stand = Stand { base: *base, axis: *axis };
                    solids::dome(stand, (*radius, *height), &params.solid)
                }
                Shape::Lathe { base, axis, profile } => {
                    let stand = Stand { base: *base, axis: *axis };
                    solids::lathe(stand, profile, &params.solid)
                }
                // Filaments are gathered by flower when the parts are planned.
                Shape::Filament { .. } => Mesh::default(),
            },
        }
    }

    fn blade(&self, blade: &Blade, scratch: &mut Scratch) -> Option<Mesh> {
        let params = &self.params.blade;
        match blade.template.and_then(|t| self.templates.get(&t)) {
            Some(flat) => blade::mesh(blade, flat.as_ref()?, params, &mut scratch.blade),
            None => {
                let flat = flat::flatten(blade, params, &mut scratch.flat)?;
                blade::mesh(blade, &flat, params, &mut scratch.blade)
            }
        }
    }
}
