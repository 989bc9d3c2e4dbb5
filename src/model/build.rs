//! The whole stage: plans the parts, meshes them on all cores and puts them together in order.
//!
//! Every part is made from the plant alone and results keep their places, so the bytes do not depend on the number of
//! threads.
//!
//! Limits: a blade too small or too thin to be seen has no mesh and no part.

use super::cache::Cache;
use super::limbs::WoodBranch;
use super::organs::{OrganScratch, OrganWorkshop};
use super::params::ModelParams;
use super::part_memory::Made;
use super::parts::{self, Plan, Source};
use super::recipe::Recipe;
use super::tube::{self, TubeScratch};
use super::wood::{self, WoodScratch};
use super::wood_memory::WoodMemory;
use super::{Mesh, Model, Part};
use crate::plant::{Branch, FinishedPlant, Organ, Plant};
use glam::Vec3;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Fewest branches of one wood that are worth being known from build to build.
const FEWEST_KNOWN: usize = 24;

/// Says whether to give up; asked from any thread.
type Stop<'a> = &'a (dyn Fn() -> bool + Sync);

/// Parts that one thread takes at a time: fewer are not worth waking another thread for.
const BATCH: usize = 4;

/// Memory that each thread uses again for all its parts.
#[derive(Default)]
struct Scratch<'a> {
    organs: OrganScratch,
    tube: TubeScratch,
    wood: WoodScratch,
    recipe: Recipe<'a>,
}

/// What the parts of one plant have in common.
struct Workshop<'a> {
    plant: &'a FinishedPlant,
    params: &'a ModelParams,
    organs: OrganWorkshop<'a>,
    plant_size: f32,
}

/// Builds the meshes of a plant that keeps its invariants.
pub fn build(plant: &FinishedPlant, params: &ModelParams) -> Model {
    // Nothing stops it, so there is a model.
    rebuild(plant, params, &mut Cache::for_one_build(), &|| false).unwrap_or_default()
}

/// Builds the same model as [`build`], taking from the cache what has not changed since it was last used. `stop` is
/// asked before every part, from any thread; where it ever says yes there is no model.
pub fn rebuild(
    plant: &FinishedPlant,
    params: &ModelParams,
    cache: &mut Cache,
    stop: Stop<'_>,
) -> Option<Model> {
    cache.begin(params);
    let mut plans = parts::plan(plant, params);
    let workshop = Workshop::new(plant, params, cache);
    workshop.take_copies(&mut plans);
    let meshes = if cache.is_for_one_build {
        workshop.meshes(&plans, stop)?
    } else {
        workshop.changed_meshes(&plans, cache, stop)?
    };
    cache.finish();
    Some(assembled(plant, plans, meshes))
}

/// What is known of the larger woods, by their parts.
fn known_woods(plans: &[Plan], cache: &mut Cache) -> BTreeMap<usize, Mutex<WoodMemory>> {
    let wood = |(part, plan): (usize, &Plan)| {
        let is_large = matches!(&plan.source, Source::Wood(limbs) if limbs.len() >= FEWEST_KNOWN);
        is_large.then(|| (part, Mutex::new(cache.take_wood(plan.pivot))))
    };
    plans.iter().enumerate().filter_map(wood).collect()
}

/// Puts plans and meshes together; what cannot be seen is left out. Wood, which comes first, always has a mesh, so that
/// parents need no renumbering.
fn assembled(plant: &FinishedPlant, plans: Vec<Plan>, meshes: Vec<Arc<Mesh>>) -> Model {
    let part = |(plan, mesh): (Plan, Arc<Mesh>)| {
        let Plan { name, kind, parent, specimen, pivot, material, mut more_materials, copies, .. } = plan;
        more_materials.truncate(mesh.breaks.len());
        let is_seen = !mesh.triangles.is_empty() || copies.is_some();
        is_seen.then_some(Part {
            name,
            kind,
            parent,
            specimen,
            pivot,
            material,
            more_materials,
            mesh,
            copies,
        })
    };
    let parts = plans.into_iter().zip(meshes).filter_map(part).collect();
    Model { parts, materials: plant.materials().to_vec() }
}

/// The largest extent of the skeleton and of where organs stand, metres: the unit of all branch tolerances. It goes in
/// steps of √2, so that most strokes of a growing drawing leave the tubes of the others alone.
pub(super) fn size_of(plant: &Plant) -> f32 {
    let skeleton = plant.branches.iter().flat_map(|b| b.points.iter().copied());
    let points = skeleton.chain(plant.organs.iter().map(Organ::base));
    let (lo, hi) = points.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(lo, hi), p| (lo.min(p), hi.max(p)));
    let size = (hi - lo).max_element();
    if size > 0.0 { (0.5 * (2.0 * size.log2()).round()).exp2() } else { 1.0 }
}

impl<'a> Workshop<'a> {
    fn new(plant: &'a FinishedPlant, params: &'a ModelParams, cache: &mut Cache) -> Self {
        let organs = OrganWorkshop::new(plant, params, cache);
        Self { plant, params, organs, plant_size: size_of(plant) }
    }

    /// Takes the copies out of every plan.
    fn take_copies(&self, plans: &mut [Plan]) {
        for plan in plans {
            if let Source::Organs(slots) = &mut plan.source {
                plan.copies = self.organs.take_copies(slots).map(Arc::new);
            }
        }
    }

    /// The meshes of all parts; nothing if `stop` said yes.
    fn meshes(&self, plans: &[Plan], stop: Stop<'_>) -> Option<Vec<Arc<Mesh>>> {
        let make = |scratch: &mut Scratch<'a>, plan: &Plan| {
            (!stop()).then(|| Arc::new(self.mesh(&plan.source, scratch)))
        };
        plans.par_iter().with_min_len(BATCH).map_init(Scratch::default, make).collect()
    }

    /// The same, where only those are made that the cache does not know.
    fn changed_meshes(&self, plans: &[Plan], cache: &mut Cache, stop: Stop<'_>) -> Option<Vec<Arc<Mesh>>> {
        let woods = known_woods(plans, cache);
        let known = cache.parts.search(plans.len());
        let make = |scratch: &mut Scratch<'a>, (part, plan): (usize, &Plan)| {
            if stop() {
                return None;
            }
            self.write_recipe(&plan.source, &mut scratch.recipe);
            known.find(part, &scratch.recipe).or_else(|| {
                let mesh = match (woods.get(&part), &plan.source) {
                    (Some(wood), Source::Wood(limbs)) => self.known_wood(limbs, wood, scratch),
                    _ => Arc::new(self.mesh(&plan.source, scratch)),
                };
                Some(Made::new(&scratch.recipe, mesh))
            })
        };
        let plans = plans.par_iter().enumerate().with_min_len(BATCH);
        let made: Vec<Option<Made>> = plans.map_init(Scratch::default, make).collect();
        let woods = woods.into_values().map(|wood| wood.into_inner().unwrap_or_else(PoisonError::into_inner));
        cache.keep_woods(woods);
        if made.iter().any(Option::is_none) {
            cache.parts.add(made);
            return None;
        }
        Some(cache.parts.keep(made))
    }

    /// Everything that [`Self::mesh`] reads but the parameters.
    fn write_recipe(&self, source: &Source, recipe: &mut Recipe<'a>) {
        match source {
            Source::Wood(branches) => recipe.wood(self.wood_branches(branches), self.plant_size),
            Source::Organ(piece) => self.organs.write_recipe(&[[*piece]], recipe),
            Source::Organs(slots) => self.organs.write_recipe(slots, recipe),
        }
    }

    fn look(&self, branch: &Branch) -> tube::TubeLook {
        tube::look(branch, &self.params.tube, self.plant_size)
    }

    fn wood_branches<'t>(
        &'t self,
        limbs: &'t [WoodBranch<usize>],
    ) -> impl Iterator<Item = WoodBranch<&'t Branch>> {
        let borrowed = |&WoodBranch { branch, parent, slot }| WoodBranch {
            branch: &self.plant.branches[branch],
            parent,
            slot,
        };
        limbs.iter().map(borrowed)
    }

    /// Wood made anew only near what changed.
    fn known_wood(
        &self,
        limbs: &[WoodBranch<usize>],
        wood: &Mutex<WoodMemory>,
        scratch: &mut Scratch<'_>,
    ) -> Arc<Mesh> {
        let branches: Vec<WoodBranch<&Branch>> = self.wood_branches(limbs).collect();
        let mut wood = wood.lock().unwrap_or_else(PoisonError::into_inner);
        wood.mesh(&branches, |branch| self.look(branch), self.plant_size, &mut scratch.wood)
    }

    fn mesh(&self, source: &Source, scratch: &mut Scratch<'_>) -> Mesh {
        match source {
            Source::Wood(branches) => {
                if let [WoodBranch { branch, .. }] = branches[..] {
                    let branch = &self.plant.branches[branch];
                    return tube::branch(branch, self.look(branch), &mut scratch.tube);
                }
                let branches: Vec<WoodBranch<&Branch>> = self.wood_branches(branches).collect();
                wood::mesh(&branches, |branch| self.look(branch), &mut scratch.wood)
            }
            Source::Organ(piece) => self.organs.mesh(&[[*piece]], &mut scratch.organs),
            Source::Organs(slots) => self.organs.mesh(slots, &mut scratch.organs),
        }
    }
}
