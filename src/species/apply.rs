//! Applying a species to a plant: materials and forms for what was drawn, and the parts that nobody draws.
//!
//! Pure and deterministic: the same plant, species and seed give the same plant. Every blade, flower and branch has
//! a random stream of its own, so that one more petal does not change all the others: blades and branches are told
//! apart by the stroke that drew them, or by where they stand if they were generated; flowers by their order.

use super::blossom::blossom;
use super::cap::caps;
use super::compound_leaves;
use super::form;
use super::fruits::fruits;
use super::full::{self, FullSeat};
use super::ground;
use super::looks::{FlowerLook, PetalLook, Species};
use super::materials::with_materials;
use super::pot::pot;
use super::receptacle::{Petals, flower_centre};
use super::season;
use super::thorns::thorns;
use crate::budget::Budget;
use crate::plant::{
    BladeForm, Branch, Detail, FinishedPlant, FlowerBuds, Organ, OrganKind, OrganPart, Origin, Plant,
    Provenance, RestSurface, Role, Shape, Templates, WoodPart,
};
use glam::Vec3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::prelude::*;

/// Blades that one thread shapes at a time.
const BATCH: usize = 256;

/// What a random stream is for.
#[derive(Clone, Copy)]
enum Purpose {
    Blade = 1,
    FlowerCentre,
    Thorns,
    Blossom,
    Variant,
}

fn stream(seed: u64, purpose: Purpose, key: u64) -> Pcg64Mcg {
    let key = ((purpose as u64) << 48) ^ key;
    Pcg64Mcg::seed_from_u64(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ key)
}

/// What tells a blade or branch from the others, whatever their number and order: its stroke or, without one, its place
/// to a tenth of a millimetre and its direction.
fn identity(stroke: Option<u64>, base: Vec3, direction: Vec3) -> u64 {
    let mixed =
        |key: u64, x: f32| (key ^ u64::from(x.round() as i32 as u32)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    stroke.unwrap_or_else(|| {
        let places = (base * 1e4).to_array().into_iter().chain((direction * 1e3).to_array());
        places.fold(1, |key, x| mixed(key, x).rotate_left(23))
    })
}

/// A plant to which a species was applied.
#[derive(Clone, Debug, PartialEq)]
pub struct Applied {
    /// The plant with its materials.
    pub plant: FinishedPlant,
    /// Whether fewer flowers of its blossom open than the species asks for, because a plant may not have more.
    pub is_blossom_thinned: bool,
}

/// Gives a plant with flower buds its species' materials and forms and adds what the drawing does not say: receptacles with stamens and
/// styles, sepals, blossom, thorns, pot.
///
/// Buds open where the species says how it blossoms. The flowers' looks are taken in turn. Petals of a species without flowers look like leaves
/// ([`Species::take_flowers_of`] gives it some).
pub fn apply(
    plant: Plant,
    buds: &FlowerBuds,
    provenance: &Provenance,
    species: &Species,
    seed: u64,
) -> Applied {
    apply_within(plant, buds, provenance, species, seed, &Budget::PLANT)
}

/// The same for a plant that has its own budget: no more flowers of its blossom open.
pub fn apply_within(
    mut plant: Plant,
    buds: &FlowerBuds,
    provenance: &Provenance,
    species: &Species,
    seed: u64,
    budget: &Budget,
) -> Applied {
    let mut is_blossom_thinned = false;
    set_roles_of_wood(&mut plant, species);
    if let Some(look) = species.blossom.as_ref().filter(|_| !species.flowers.is_empty()) {
        let rng = &mut stream(seed, Purpose::Blossom, 0);
        is_blossom_thinned = blossom(&mut plant, buds, look, budget.blossoms, rng);
    }
    let looks = species.looks_of_drawn();
    for flower in &mut plant.flowers {
        flower.look = looks.get(flower.look % looks.len().max(1)).copied().unwrap_or(0);
    }
    let (fruits, flat) = fruiting(&plant, provenance, species, seed, budget);
    season::turn(&mut plant, provenance, species, seed);
    compound_leaves::divide(&mut plant, &species.leaf, seed);
    let openings = full::open_buds(&mut plant, buds, species, budget.blossoms);
    let seats = full::add_layers(&mut plant, &openings, species, seed);
    let petals = petals_of(&plant, &seats);
    shape_blades(&mut plant, provenance, species, &petals, seed);
    let has_drawn_pot = plant.organs.iter().any(|organ| organ.kind() == OrganKind::Pot);
    if species.pot.is_none() || has_drawn_pot {
        ground::keep_above(&mut plant);
    }
    let (centres, templates) = flower_centres(&plant, species, &petals, seed);
    let mut added = thorny(&plant, provenance, species, seed);
    if species.fruit.as_ref().is_some_and(|fruit| fruit.underside.is_some()) {
        added.extend(caps(&mut plant));
    }
    if !has_drawn_pot {
        added.extend(potted(&plant, species));
    }
    plant.add_organs(centres, templates);
    plant.add_organs(fruits, flat);
    plant.add_organs(added, Templates::default());
    Applied { plant: with_materials(plant, species), is_blossom_thinned }
}

/// Tells young, thin wood from stems where the species does.
fn set_roles_of_wood(plant: &mut Plant, species: &Species) {
    let look = &species.stem;
    let foot = |branch: &Branch| branch.radii.first().copied().unwrap_or(0.0);
    let thickest = |branches: &mut dyn Iterator<Item = &Branch>| branches.map(foot).reduce(f32::max);
    // The first stem of a bush is as thick at its foot as the base of all.
    let stems = thickest(&mut plant.branches.iter().filter(|branch| branch.is_basal_stem()));
    let thick = look.twig_thickest * stems.or_else(|| thickest(&mut plant.branches.iter())).unwrap_or(0.0);
    for branch in &mut plant.branches {
        let is_young = branch.level >= look.twig_level && foot(branch) <= thick;
        let is_twig = is_young && look.twig.is_some();
        branch.role = Role::of(if is_twig { WoodPart::Twig } else { WoodPart::Stem });
    }
}

/// Gives petals and leaves their form, and chooses among the materials of their part.
fn shape_blades(plant: &mut Plant, provenance: &Provenance, species: &Species, petals: &[Petals], seed: u64) {
    let mut done = vec![0; plant.flowers.len()];
    for organ in &mut plant.organs {
        let look = organ.flower.map_or(0, |flower| plant.flowers[flower].look);
        organ.role.look = look as u32;
        let is_petal = organ.kind() == OrganKind::Petal && !has_its_form(&organ.shape);
        if let (true, Some(flower), Some(look)) = (is_petal, organ.flower, species.flowers.get(look)) {
            organ.role.variant = (done[flower] % look.petals.materials.0.len()) as u32;
            done[flower] += 1;
        }
    }
    let leaf = &species.leaf;
    let templates = &plant.templates;
    plant.organs.par_iter_mut().with_min_len(BATCH).for_each(|organ| {
        let flower = organ.flower.filter(|_| organ.kind() == OrganKind::Petal);
        if has_its_form(&organ.shape) {
            return;
        }
        let Shape::Blade(blade) = &mut organ.shape else { return };
        let template = &templates[blade.template];
        let key = identity(provenance.stroke(organ.origin), blade.base, blade.v);
        let rng = &mut stream(seed, Purpose::Blade, key);
        match flower.zip(species.flowers.get(organ.role.look as usize)) {
            Some((flower, FlowerLook { petals: look, .. })) => {
                let form = petal_form(look, template.length(), petals[flower].longest);
                blade.form = varied(seed, template.detail(), &form, look.vary, rng);
            }
            None => {
                // Copies, whatever made them, have less detail than what somebody drew.
                let any = rng.random_range(leaf.variants(template.detail() == Detail::Full));
                let (variant, _) = season::untinted(species, organ.role.variant);
                if leaf.variants(false).contains(&variant) {
                    organ.role.variant = organ.role.variant - variant + any;
                }
                blade.form = varied(seed, template.detail(), &leaf.form, leaf.vary, rng);
            }
        }
    });
}

/// Whether whoever made an organ gave it the form that it has.
fn has_its_form(shape: &Shape) -> bool {
    match shape {
        Shape::Blade(blade) => matches!(blade.rest, RestSurface::Ring(_)),
        _ => true,
    }
}

/// How many forms the copies of a template of reduced detail have.
const VARIANTS: u64 = 4;

/// A form that varies from blade to blade: freely in full detail, otherwise among a few, which are then bent only once each.
fn varied(seed: u64, detail: Detail, form: &BladeForm, vary: f32, rng: &mut Pcg64Mcg) -> BladeForm {
    match detail {
        Detail::Full => form::varied(form, vary, rng),
        Detail::Reduced | Detail::Moderate => {
            let variant = rng.random_range(0..VARIANTS);
            form::varied(form, vary, &mut stream(seed, Purpose::Variant, variant))
        }
    }
}

/// The form of a petal between the longest, outer ones and those half as long, the inner ones.
fn petal_form(look: &PetalLook, length: f32, longest: f32) -> BladeForm {
    match &look.inner {
        Some(inner) => form::blend(&look.form, inner, (2.0 - 2.0 * length / longest).clamp(0.0, 1.0)),
        None => look.form,
    }
}

/// What is known of the petals of each flower.
fn petals_of(plant: &Plant, seats: &[Option<FullSeat>]) -> Vec<Petals> {
    let mut petals: Vec<Petals> =
        seats.iter().map(|seat| Petals { full: *seat, ..Petals::default() }).collect();
    for organ in plant.organs.iter().filter(|organ| organ.kind() == OrganKind::Petal) {
        if let (Some(flower), Shape::Blade(blade)) = (organ.flower, &organ.shape) {
            let of = &mut petals[flower];
            of.count += 1;
            let blade = plant.templates.resolve(blade);
            of.longest = of.longest.max(blade.template.length() * blade.v.length());
            of.first_tip.get_or_insert_with(|| blade.tip_at_rest());
        }
    }
    petals
}

/// The parts of every flower that nobody draws, with their templates.
fn flower_centres(plant: &Plant, species: &Species, petals: &[Petals], seed: u64) -> (Vec<Organ>, Templates) {
    let (mut out, mut templates) = (Vec::new(), Templates::default());
    for (index, flower) in plant.flowers.iter().enumerate() {
        let Some(look) = species.flowers.get(flower.look) else { continue };
        // One petal does not show where the middle of its flower is.
        if petals[index].count < 2 {
            continue;
        }
        let rng = &mut stream(seed, Purpose::FlowerCentre, index as u64);
        out.extend(flower_centre(plant, index, &petals[index], look, &mut templates, rng));
    }
    (out, templates)
}

/// The fruits that a species' plants bear by themselves.
fn fruiting(
    plant: &Plant,
    provenance: &Provenance,
    species: &Species,
    seed: u64,
    budget: &Budget,
) -> (Vec<Organ>, Templates) {
    let Some(set) = species.fruit.as_ref().and_then(|fruit| fruit.set.as_ref()) else {
        return Default::default();
    };
    fruits(plant, provenance, (set, &species.season), budget.blossoms, seed)
}

fn thorny(plant: &Plant, provenance: &Provenance, species: &Species, seed: u64) -> Vec<Organ> {
    let Some(look) = &species.thorns else { return Vec::new() };
    let on = |(index, branch): (usize, &Branch)| {
        let ends = branch.points.first().zip(branch.points.last());
        let (base, end) = ends.map_or((Vec3::ZERO, Vec3::Y), |(base, end)| (*base, *end));
        let key = identity(provenance.stroke(branch.origin), base, end - base);
        let shapes = thorns(look, branch, &mut stream(seed, Purpose::Thorns, key));
        shapes.into_iter().map(move |shape| Organ {
            role: Role::of(OrganPart::Thorn),
            origin: Origin::Generated,
            branch: Some(index),
            flower: None,
            shape,
        })
    };
    plant.branches.iter().enumerate().flat_map(on).collect()
}

fn potted(plant: &Plant, species: &Species) -> Vec<Organ> {
    let Some(shapes) = species.pot.as_ref().and_then(|look| pot(look, plant)) else { return Vec::new() };
    let organ = |(shape, part)| Organ {
        role: Role::of(part),
        origin: Origin::Generated,
        branch: None,
        flower: None,
        shape,
    };
    shapes.into_iter().zip([OrganPart::Pot, OrganPart::Soil]).map(organ).collect()
}

#[cfg(test)]
#[path = "apply_tests.rs"]
mod tests;
