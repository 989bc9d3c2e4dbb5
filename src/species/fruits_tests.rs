//! Fruits through the year.

use super::*;
use crate::plant::{
    Blade, BladeForm, Branch, Detail, FinishedPlant, FlowerBuds, RestSurface, Template, WoodPart,
};
use crate::species::{Species, apply};
use std::collections::BTreeSet;

const LEAVES: usize = 1200;

/// A straight stem with leaves 20 cm long, of a species at a time of the year.
fn in_leaf(species: &Species) -> FinishedPlant {
    let mut plant = Plant::default();
    let points = vec![Vec3::ZERO, Vec3::Y * 4.0];
    let (origin, role) = (Origin::Generated, Role::of(WoodPart::Stem));
    plant.branches.push(Branch { origin, parent: None, level: 0, points, radii: vec![0.05; 2], role });
    let outline = vec![Vec2::ZERO, Vec2::new(0.3, 0.5), Vec2::Y, Vec2::new(-0.3, 0.5)];
    let template = plant.templates.add(Template::new(outline, Vec::new(), 1.0, Detail::Reduced));
    let leaf = |k: usize| {
        let base = Vec3::new(0.05, 4.0 * k as f32 / LEAVES as f32, 0.0);
        let (u, v, rest) = (Vec3::Z * 0.2, Vec3::X * 0.2, RestSurface::Plane);
        let shape = Shape::Blade(Blade { template, base, u, v, rest, form: BladeForm::default() });
        let role = Role::of(OrganPart::Leaf);
        Organ { role, origin: Origin::Generated, branch: Some(0), flower: None, shape }
    };
    plant.organs = (0..LEAVES).map(leaf).collect();
    let applied = apply(plant, &FlowerBuds::default(), &Provenance::default(), species, 1);
    assert_eq!(applied.plant.check_invariants(), Ok(()));
    applied.plant
}

fn of(name: &str, time: f32) -> Species {
    let mut species = Species::built_in(name).unwrap();
    species.season.time = time;
    species
}

fn bodies(plant: &FinishedPlant) -> Vec<&Organ> {
    plant.organs.iter().filter(|organ| organ.role.part == OrganPart::Fruit).collect()
}

/// How many fruits of a species there are at a time, and how many of them are ripe.
fn count(name: &str, time: f32) -> (usize, usize) {
    let plant = in_leaf(&of(name, time));
    let bodies = bodies(&plant);
    (bodies.len(), bodies.iter().filter(|organ| organ.role.variant == RIPE).count())
}

#[test]
fn fruits_come_ripen_and_fall_one_by_one() {
    assert_eq!(count("apple", 2.5), (0, 0));
    let (all, ripe) = count("apple", 2.6);
    let share = Species::built_in("apple").unwrap().fruit.unwrap().set.unwrap().share;
    assert!((all as f32 / (share * LEAVES as f32) - 1.0).abs() < 0.25 && ripe == 0, "{all} {ripe}");
    let (same, half) = count("apple", 3.3);
    assert!(same == all && half > all / 4 && half < 3 * all / 4, "{half} of {all}");
    assert_eq!(count("apple", 3.65), (all, all));
    let (left, _) = count("apple", 4.05);
    assert!(left > all / 4 && left < 3 * all / 4, "{left} of {all}");
    assert_eq!(count("apple", 5.0), (0, 0));
}

#[test]
fn those_that_are_left_were_there_before_and_have_grown() {
    let at = |time| -> (BTreeSet<[u32; 3]>, f32) {
        let plant = in_leaf(&of("oak", time));
        let stalks = plant.organs.iter().filter(|organ| organ.role.part == OrganPart::FruitStalk);
        let widest = |organ: &&Organ| match &organ.shape {
            Shape::Lathe { profile, .. } => profile.iter().map(|point| point.x).fold(0.0, f32::max),
            _ => 0.0,
        };
        let width = bodies(&plant).iter().map(widest).sum::<f32>() / bodies(&plant).len() as f32;
        (stalks.map(|stalk| stalk.base().to_array().map(f32::to_bits)).collect(), width)
    };
    let ((young, small), (ripe, large), (left, _)) = (at(2.7), at(3.6), at(4.0));
    assert!(young == ripe && left.is_subset(&ripe) && left.len() < ripe.len() && !left.is_empty());
    assert!(small < 0.7 * large, "{small} {large}");
}

#[test]
fn a_fruit_hangs_from_the_end_of_its_stalk() {
    let plant = in_leaf(&of("cherry", 2.95));
    let (mut fruits, organs) = (0, &plant.organs);
    for pair in organs.windows(2).filter(|pair| pair[1].role.part == OrganPart::Fruit) {
        let [Shape::Filament { points, .. }, Shape::Lathe { base, axis, profile }] =
            [&pair[0].shape, &pair[1].shape]
        else {
            panic!("a cherry has a stalk")
        };
        let hollow = profile[0].y;
        assert!((*base + *axis * hollow).distance(points[2]) < 1e-5);
        assert!(axis.y < -0.5 && points[2].y < points[0].y);
        fruits += 1;
    }
    assert!(fruits > 100);
}

#[test]
fn berries_are_the_heads_of_their_stalks() {
    let mut rowan = of("rowan", 3.65);
    rowan.fruit.as_mut().unwrap().set.as_mut().unwrap().share = 0.04;
    let plant = in_leaf(&rowan);
    assert!(bodies(&plant).is_empty());
    let stalks = plant.organs.iter().filter(|organ| organ.role.part == OrganPart::FruitStalk);
    let heads: Vec<Vec2> = stalks
        .map(|organ| match &organ.shape {
            Shape::Filament { head, .. } => *head,
            _ => Vec2::ZERO,
        })
        .collect();
    assert!(heads.len() > 1000 && heads.iter().all(|head| head.x > 0.0 && head.x == head.y));
}

#[test]
fn cones_stand_where_their_species_has_them() {
    let spruce = in_leaf(&of("spruce", 4.5));
    let lowest = bodies(&spruce).iter().map(|organ| organ.base().y).fold(f32::MAX, f32::min);
    assert!(lowest > 0.55 * 4.0, "{lowest}");
    let mut larch = of("larch", 4.5);
    larch.fruit.as_mut().unwrap().set.as_mut().unwrap().share = 0.2;
    let larch = in_leaf(&larch);
    let upright = |organ: &&&Organ| matches!(organ.shape, Shape::Lathe { axis, .. } if axis.y > 0.5);
    let of_larch = bodies(&larch);
    assert!(of_larch.iter().filter(upright).count() > of_larch.len() * 9 / 10 && of_larch.len() > 100);
}

#[test]
fn what_hung_on_a_shoot_that_has_fallen_hangs_on_the_wood() {
    let farthest = |time: f32| {
        let mut larch = of("larch", time);
        larch.fruit.as_mut().unwrap().set.as_mut().unwrap().share = 0.2;
        let plant = in_leaf(&larch);
        let of_larch = bodies(&plant);
        assert!(of_larch.len() > 100);
        of_larch.iter().map(|organ| organ.base().x).fold(0.0, f32::max)
    };
    let (summer, winter) = (farthest(3.65), farthest(5.5));
    assert!(summer > 0.15 && winter < 0.08, "{summer} {winter}");
}

#[test]
fn none_hangs_below_the_ground_and_none_is_one_too_many() {
    let mut species = of("apple", 3.65);
    let set = species.fruit.as_mut().unwrap().set.as_mut().unwrap();
    (set.share, set.stalk) = (1.0, 20.0);
    let plant = in_leaf(&species);
    let low = |organ: &&Organ| match &organ.shape {
        Shape::Lathe { base, axis, profile } => base.y + axis.y.min(0.0) * profile[profile.len() - 1].y,
        _ => f32::MAX,
    };
    assert!(bodies(&plant).iter().map(low).all(|y| y >= 0.0));
    let mut all = Plant::default();
    (all.organs, all.templates) = (plant.organs.clone(), plant.templates.clone());
    all.organs.retain(|organ| organ.kind() == OrganKind::Leaf);
    let set = species.fruit.as_ref().unwrap().set.as_ref().unwrap();
    let (few, _) = fruits(&all, &Provenance::default(), (set, &species.season), 60, 1);
    let count = few.iter().filter(|organ| organ.role.part == OrganPart::Fruit).count();
    assert!((30..=90).contains(&count), "{count}");
}

#[test]
fn where_fruits_were_drawn_there_are_no_others() {
    let species = of("apple", 3.65);
    let mut plant = Plant::default();
    let ripe = in_leaf(&species);
    (plant.organs, plant.templates) = (ripe.organs.clone(), ripe.templates.clone());
    let set = species.fruit.as_ref().unwrap().set.as_ref().unwrap();
    let mut provenance = Provenance::default();
    let count = |plant: &Plant, provenance: &Provenance| {
        fruits(plant, provenance, (set, &species.season), 9999, 1).0.len()
    };
    assert!(count(&plant, &provenance) > 0);
    let drawn = provenance.record(Some(1));
    plant.organs.iter_mut().rfind(|organ| organ.role.part == OrganPart::Fruit).unwrap().origin = drawn;
    assert_eq!(count(&plant, &provenance), 0);
}

#[test]
fn times_that_are_no_times_are_refused() {
    let text = |ripe: &str| {
        format!(
            "name = \"x\"\nlatin = \"X\"\n[materials]\na = {{}}\n[stem]\nmaterial = \"a\"\n[leaf]\nmaterials = [\"a\"]\n[fruit]\n\
             material = \"a\"\n[fruit.set]\nshape = \"apple\"\nshare = 0.1\nradius = 0.1\nripe = {ripe}\n"
        )
    };
    assert!(Species::from_toml(&text("[3.0, 3.5]"), "x").is_ok());
    for ripe in ["[3.5, 3.0]", "[1.0, 3.0]", "[3.0, nan]"] {
        let refused = Species::from_toml(&text(ripe), "x").unwrap_err().to_string();
        assert!(refused.contains("from 2.5 to 6"), "{refused}");
    }
}

#[test]
fn keys_and_pods_are_flat_and_hang_without_stalks_of_their_own() {
    for (name, blades) in [("ash", 1), ("maple", 2), ("acacia", 1)] {
        let species = of(name, 3.95);
        let plant = in_leaf(&species);
        let fruits = bodies(&plant);
        let set = species.fruit.as_ref().unwrap().set.as_ref().unwrap();
        let expected = set.share * LEAVES as f32 * set.cluster as f32 * blades as f32;
        assert!((fruits.len() as f32 / expected - 1.0).abs() < 0.3, "{name}: {} of {expected}", fruits.len());
        for fruit in fruits {
            let Shape::Blade(blade) = &fruit.shape else { panic!("{name}: a blade") };
            assert!(blade.v.length() < 0.25 && plant.templates[blade.template].length() == 1.0);
        }
        assert!(plant.organs.iter().all(|organ| organ.role.part != OrganPart::FruitStalk));
        let fallen = in_leaf(&of(name, 6.0));
        assert!(bodies(&fallen).is_empty(), "{name}");
    }
}
