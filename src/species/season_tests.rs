//! Leaves through the year.

use super::*;
use crate::plant::{Blade, BladeForm, Detail, FlowerBuds, OrganPart, Origin, RestSurface, Role, Template};
use crate::species::apply;
use glam::{Vec2, Vec3};

const LEAVES: usize = 2000;

/// A plant of nothing but leaves, of a species at a time of the year.
fn at(name: &str, time: f32) -> crate::plant::FinishedPlant {
    let mut plant = Plant::default();
    let outline = vec![Vec2::ZERO, Vec2::new(0.3, 0.5), Vec2::Y, Vec2::new(-0.3, 0.5)];
    let template = plant.templates.add(Template::new(outline, Vec::new(), 1.0, Detail::Reduced));
    let leaf = |k: usize| {
        let base = Vec3::new(k as f32 * 0.1, 1.0, 0.0);
        let (u, v, rest) = (Vec3::X * 0.1, Vec3::Y * 0.1, RestSurface::Plane);
        let shape = Shape::Blade(Blade { template, base, u, v, rest, form: BladeForm::default() });
        Organ {
            role: Role::of(OrganPart::Leaf),
            origin: Origin::Generated,
            branch: None,
            flower: None,
            shape,
        }
    };
    plant.organs = (0..LEAVES).map(leaf).collect();
    let mut species = Species::built_in(name).unwrap();
    species.season.time = time;
    // Fruits have tests of their own.
    species.fruit = None;
    let applied = apply(plant, &FlowerBuds::default(), &Provenance::default(), &species, 1);
    assert_eq!(applied.plant.check_invariants(), Ok(()));
    applied.plant
}

/// Shares of the leaves: those that are there, and of all those whose material's name has a word in it.
fn shares(name: &str, time: f32, word: &str) -> (f32, f32) {
    let plant = at(name, time);
    let is = |organ: &&Organ| plant.materials()[plant.material(organ.role)].name.contains(word);
    let count = plant.organs.iter().filter(is).count();
    (plant.organs.len() as f32 / LEAVES as f32, count as f32 / LEAVES as f32)
}

fn near(is: f32, wanted: f32) -> bool {
    (is - wanted).abs() < 0.04
}

#[test]
fn summer_is_what_the_species_describes() {
    let summer = at("oak", 2.0);
    assert_eq!(summer, at("oak", 3.0));
    assert_eq!(summer, at("oak", 1.6));
    assert_ne!(summer, at("oak", 3.6));
}

#[test]
fn leaves_unfold_turn_and_fall_one_by_one() {
    assert_eq!(shares("oak", 0.2, "spring"), (1.0, 1.0));
    let (all, turned) = shares("oak", 3.6, "autumn");
    assert!(all == 1.0 && near(turned, 0.5), "{turned}");
    let (left, withered) = shares("oak", 4.5, "withered");
    let keeps = Species::built_in("oak").unwrap().season.keeps;
    assert!(near(withered, 0.5 * keeps) && near(left, 0.5 + 0.5 * keeps), "{left} {withered}");
    let (left, withered) = shares("oak", 5.0, "withered");
    assert!(near(left, keeps) && left == withered, "{left} {withered}");
    assert_eq!(shares("birch", 5.0, ""), (0.0, 0.0));
}

#[test]
fn leaves_of_spring_are_small() {
    let longest = |time| {
        let of = |organ: &Organ| match &organ.shape {
            Shape::Blade(blade) => blade.v.length(),
            _ => 0.0,
        };
        at("oak", time).organs.iter().map(of).fold(0.0, f32::max)
    };
    assert!(longest(0.0) < 0.3 * longest(2.0) && longest(0.5) > longest(0.1) && longest(1.0) == longest(2.0));
}

#[test]
fn evergreens_stay_as_they_are() {
    for name in ["spruce", "pine", "cypress", "olive", "box", "palm", "bamboo"] {
        assert_eq!(at(name, 5.0), at(name, 2.0), "{name}");
        assert_eq!(at(name, 0.0), at(name, 2.0), "{name}");
    }
}

#[test]
fn every_colour_of_autumn_is_used_and_lies_in_the_leaf_s_own_picture() {
    let plant = at("maple", 4.0);
    assert!(plant.materials().iter().all(|material| material.texture.is_some()));
    let plant = at("birch", 3.9);
    let count = Species::built_in("birch").unwrap().season.autumn.len();
    for k in 1..=count {
        let named = |name: &str| name.ends_with(&format!("-autumn{k}"));
        let material = plant.materials().iter().find(|material| named(&material.name)).unwrap();
        assert!(matches!(material.texture, Some(crate::plant::Texture::Own(_))) && material.cut_out);
    }
}

#[test]
fn the_same_leaves_fall_again() {
    assert_eq!(at("oak", 4.4), at("oak", 4.4));
    let places = |time| -> std::collections::BTreeSet<u32> {
        let base = |organ: &Organ| organ.base().x.to_bits();
        at("birch", time).organs.iter().map(base).collect()
    };
    assert!(places(4.6).is_subset(&places(4.3)));
}

#[test]
fn blossom_comes_in_spring_and_goes_in_summer() {
    let is = |name, time| {
        let mut species = Species::built_in(name).unwrap();
        species.season.time = time;
        species.is_in_blossom()
    };
    let cherry = |time| is("cherry", time);
    assert_eq!([0.0, 0.6, 2.0, 2.8, 5.0].map(cherry), [false, true, true, false, false]);
    let apple = |time| is("apple", time);
    assert_eq!([0.0, 1.0, 2.0].map(apple), [false, true, false], "over before its leaves are as in summer");
}
