//! What every species that grows by itself looks like in numbers, and how its crown stands out from the others.
//!
//! Blessed by one variable: `INSTA_UPDATE=always cargo test --test plants grown`.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use glam::Vec3;
use penstemon::growth::{Habit, Limits, Obstacles, Outcome, PlantAtAge, Simulation, plant_at};
use penstemon::pipeline::{self, Built, Seed};
use penstemon::plant::{Branch, FinishedPlant, Plant, Provenance};
use penstemon::sketch::Remark;
use penstemon::species::{self, Species};
use rayon::prelude::*;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// A species as old as it says, grown once for all tests.
fn full_grown(name: &str) -> &'static (Simulation, FinishedPlant) {
    static GROWN: OnceLock<BTreeMap<&str, (Simulation, FinishedPlant)>> = OnceLock::new();
    let grow = |name: &'static str| {
        let age = Species::built_in(name).unwrap().growth.unwrap().age;
        (name, grown(name, age as f32))
    };
    &GROWN.get_or_init(|| Species::growing().into_par_iter().map(grow).collect())[name]
}

/// A plant of an age with its species applied.
fn finished_at(simulation: &Simulation, age: f32, species: &Species, seed: u64) -> FinishedPlant {
    let PlantAtAge { plant, buds } = plant_at(simulation, age);
    let plant = species::apply(plant, &buds, &Provenance::default(), species, seed).plant;
    plant.check_invariants().unwrap();
    plant
}

fn grown(name: &str, age: f32) -> (Simulation, FinishedPlant) {
    let species = Species::built_in(name).unwrap();
    let habit = species.growth.as_ref().unwrap();
    let mut simulation = Simulation::new(habit, 1, Limits::default());
    let outcome = simulation.grow_to(age as u16, &|| false);
    assert!(matches!(outcome, Outcome::Growing), "{name}: {outcome}");
    let plant = finished_at(&simulation, age, &species, 1);
    (simulation, plant)
}

/// The distance of a point from a branch's axis, in radii of the branch there.
fn off_axis(branch: &Branch, p: Vec3) -> f32 {
    let off = |k: usize| {
        let (from, along) = (branch.points[k], branch.points[k + 1] - branch.points[k]);
        let share = ((p - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        let radius = branch.radii[k] + (branch.radii[k + 1] - branch.radii[k]) * share;
        p.distance(from + along * share) / radius
    };
    (0..branch.points.len() - 1).map(off).fold(f32::INFINITY, f32::min)
}

/// No twig hangs in the air: every branch begins inside of the wood that carries it, at every age, on the ground too.
#[test]
fn every_branch_begins_inside_of_its_parent() {
    let check = |what: &str, plant: &Plant| {
        let carried = |branch: &Branch| Some((branch.parent?, branch.points[0]));
        let feet = plant.branches.iter().filter_map(carried);
        let off = feet.map(|(parent, foot)| off_axis(&plant.branches[parent], foot)).fold(0.0, f32::max);
        assert!(off < 1.0, "{what}: a branch begins {off} radii from the axis of its parent");
    };
    Species::growing().into_par_iter().for_each(|name| {
        let (oldest, plant) = full_grown(name);
        check(name, plant);
        let species = Species::built_in(name).unwrap();
        for seed in 1..=3 {
            let mut younger = Simulation::new(species.growth.as_ref().unwrap(), seed, Limits::default());
            for age in [2u16, 3, 5, 8, 12].into_iter().filter(|age| *age < oldest.age()) {
                younger.grow_to(age, &|| false);
                let plant = finished_at(&younger, f32::from(age), &species, seed);
                check(&format!("{name} of {age} years, seed {seed}"), &plant);
            }
        }
    });
}

fn size(plant: &Plant) -> Vec3 {
    let points =
        plant.organs.iter().map(|o| o.base()).chain(plant.branches.iter().flat_map(|b| b.points.clone()));
    let (low, high) = points.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(l, h), p| (l.min(p), h.max(p)));
    high - low
}

/// Two leading digits, so that another processor's last bits do not matter.
fn rounded(x: f64) -> Value {
    let step = 10f64.powf(x.abs().max(1e-9).log10().floor() - 1.0);
    json!(((x / step).round() * step * 1e4).round() / 1e4)
}

#[test]
fn every_species_grows_as_before() {
    for name in Species::growing() {
        let (simulation, plant) = full_grown(name);
        let size = size(plant).to_array().map(|x| rounded(f64::from(x)));
        let trunk = plant.branches[0].radii[0];
        let summary = json!({
            "age": simulation.age(),
            "nodes": rounded(simulation.tree().len() as f64),
            "branches": rounded(plant.branches.len() as f64),
            "organs": rounded(plant.organs.len() as f64),
            "deepest_level": plant.branches.iter().map(|b| b.level).max(),
            "trunk_radius_m": rounded(f64::from(trunk)),
            "size_m": size,
        });
        // Under the name that it has had since before these tests were one module of many.
        insta::with_settings!({ prepend_module_to_snapshot => false }, {
            insta::assert_json_snapshot!(format!("grown__{name}"), summary);
        });
    }
}

#[test]
fn fruit_trees_flower_when_they_are_of_age_and_their_flowers_open() {
    let flowers = |age: f32| grown("cherry", age).1.flowers.len();
    let species = Species::built_in("cherry").unwrap();
    let habit =
        Habit { flowering: 0.0.into(), flowering_side: 0.0.into(), ..species.growth.clone().unwrap() };
    let mut bare = Simulation::new(&habit, 1, Limits::default());
    bare.grow_to(20, &|| false);
    let of_leaves = finished_at(&bare, 20.0, &species, 1).flowers.len();
    assert!(flowers(20.0) > of_leaves + 100, "{} with and {of_leaves} without fates", flowers(20.0));
    let buds = |age: f32| plant_at(&grown("cherry", 20.0).0, age).buds.buds.len();
    assert_eq!((buds(3.0), buds(20.0) > 100), (0, true), "flowering age is 4");
    assert!(buds(20.0) > buds(6.0));
}

#[test]
fn flowers_that_a_tree_may_not_have_are_remarked_once_with_the_number_that_it_has() {
    let species = Species::built_in("cherry").unwrap();
    let params = pipeline::params_of_species(&species, &[]).unwrap();
    let built = |flower_buds: usize, age: f32| {
        let limits = Limits { flower_buds, ..Limits::default() };
        let seed = Seed { number: 1, age: Some(age), limits, ..Seed::default() };
        let built = pipeline::build(&seed, &species, &params);
        let thinned = built.remarks.iter().filter_map(|warning| match warning.remark {
            Remark::BlossomThinned { flowers } => Some(flowers),
            _ => None,
        });
        (thinned.collect::<Vec<_>>(), built.plant.flowers.len())
    };
    let (remarked, whole) = built(6000, 16.0);
    assert!(remarked.is_empty(), "{remarked:?}");
    let (remarked, thinned) = built(10, 16.0);
    assert_eq!(remarked, [thinned]);
    assert!(thinned >= 10 && thinned + 20 < whole, "{thinned} of {whole}");
    assert!(built(10, 3.0).0.is_empty(), "flowering age is 4");
}

/// How high a climbing species grows on a high wall behind it, metres.
fn on_a_wall(name: &str) -> f32 {
    let wall = Obstacles::wall(Vec3::new(8.0, 8.0, 0.2)).moved(Vec3::Z * -0.3);
    let habit = Species::built_in(name).unwrap().growth.unwrap();
    let mut simulation = Simulation::new(&habit, 1, Limits::default()).among(std::sync::Arc::new(wall));
    simulation.grow_to(habit.age as u16, &|| false);
    size(&plant_at(&simulation, habit.age as f32).plant).y
}

/// Drawings are scaled by it: what is drawn as high as a grown plant goes on like one.
#[test]
fn species_grow_as_high_as_they_say() {
    for name in Species::growing() {
        let said = Species::built_in(name).unwrap().growth.unwrap().height;
        // What climbs grows as high as it says on a wall that is higher.
        let climbs = Species::built_in(name).unwrap().growth.unwrap().climb.is_some();
        let high = if climbs { on_a_wall(name) } else { size(&full_grown(name).1).y };
        assert!((high / said - 1.0).abs() < 0.12, "{name} says {said} m and grows {high} m high");
    }
}

#[test]
fn flowers_open_gradually_and_old_ones_do_not_close() {
    let species = Species::built_in("cherry").unwrap();
    let mut simulation = Simulation::new(species.growth.as_ref().unwrap(), 1, Limits::default());
    simulation.grow_to(20, &|| false);
    let reaches = |age: f32| {
        let plant = finished_at(&simulation, age, &species, 1);
        let mut reaches: Vec<f32> = plant.flowers.iter().map(|flower| flower.reach).collect();
        reaches.sort_by(f32::total_cmp);
        (reaches[0], reaches[reaches.len() - 1])
    };
    let (at_rest, early, late) = (reaches(19.0), reaches(19.02), reaches(20.0));
    assert!(early.0 < 0.1 * early.1, "new flowers begin small: {early:?}");
    assert!((early.1 / at_rest.1 - 1.0).abs() < 0.1, "{at_rest:?} then {early:?}");
    assert!(late.0 > 0.4 * late.1, "whole by the end of the year: {late:?}");
}

#[test]
fn crowns_have_the_proportions_of_their_species() {
    let slender = |name: &str| {
        let size = size(&full_grown(name).1);
        size.y / size.x.max(size.z)
    };
    for column in ["poplar", "cypress"] {
        assert!(slender(column) > 2.5, "{column} is a column: {}", slender(column));
    }
    for broad in ["acacia", "maple", "oak"] {
        assert!(slender(broad) < 1.25, "{broad} is broad: {}", slender(broad));
    }
    assert!(slender("spruce") > 0.8 && slender("birch") > 1.0);
}

/// A species grown to an age with some parameters set.
fn grown_with(name: &str, age: f32, set: &[&str]) -> Built {
    let species = Species::built_in(name).unwrap();
    let set: Vec<String> = set.iter().map(|s| (*s).to_owned()).collect();
    let params = pipeline::params_of_species(&species, &set).unwrap();
    pipeline::build(&Seed { number: 1, age: Some(age), ..Seed::default() }, &species, &params)
}

#[test]
fn habits_are_what_the_species_files_say_until_they_are_set() {
    for name in Species::growing() {
        let species = Species::built_in(name).unwrap();
        let params = pipeline::params_of_species(&species, &[]).unwrap();
        assert_eq!(Some(params.habit), species.growth, "{name}");
    }
}

#[test]
fn lambda_decides_between_a_leader_and_laterals() {
    let height_and_width = |lambda: &str| {
        let set = format!("habit.lambda={lambda}");
        let params =
            pipeline::params_of_species(&Species::built_in("maple").unwrap(), std::slice::from_ref(&set))
                .unwrap();
        let everywhere = |age: &f32| params.habit.lambda.at(*age).to_string() == lambda;
        assert!([0.0, 5.0, 12.0].iter().all(everywhere), "at every age");
        let grown = grown_with("maple", 12.0, &[&set]);
        let size = size(&grown.plant);
        (size.y, size.x.max(size.z))
    };
    let (low, wide) = height_and_width("0.45");
    let (high, narrow) = height_and_width("0.55");
    assert!(high > 1.25 * low, "a leader is taller: {low} m, {high} m");
    assert!(high / narrow > 1.5 * low / wide, "laterals are wider: {low} × {wide} m, {high} × {narrow} m");
}

#[test]
fn willow_twigs_hang_and_poplar_twigs_stand() {
    let fall = |name: &str| {
        let plant = &full_grown(name).1;
        let last = plant.branches.iter().filter(|b| b.level >= 2 && b.points.len() > 3);
        let ways: Vec<f32> =
            last.map(|b| (b.points[b.points.len() - 1] - b.points[1]).normalize().y).collect();
        ways.iter().sum::<f32>() / ways.len() as f32
    };
    assert!(fall("willow") < -0.3, "{}", fall("willow"));
    assert!(fall("poplar") > 0.5, "{}", fall("poplar"));
}

#[test]
fn a_plant_is_taller_and_thicker_every_five_years() {
    let (simulation, _) = full_grown("oak");
    let mut last = (0.0, 0.0);
    for age in [5.0, 10.0, 15.0, 20.0] {
        let plant = plant_at(simulation, age).plant;
        let now = (size(&plant).y, plant.branches[0].radii[0]);
        assert!(now.0 > last.0 && now.1 > last.1, "{last:?} then {now:?} at {age}");
        last = now;
    }
}
