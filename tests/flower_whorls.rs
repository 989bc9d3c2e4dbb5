//! Flowers drawn with several rings of petals: whorls are told apart, each on a cone of its own with one apex and axis, and
//! petals that others hide are filled in.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use crate::cone_flowers::{self, Hand, Ring, Truth};
use crate::drawings;
use glam::{Vec2, Vec3};
use penstemon::depth::cone_pose::{ConeParams, FlowerPose, PetalOutline, flower_pose};
use penstemon::pipeline::{self, Built};
use penstemon::plant::{OrganKind, Origin, Shape};
use penstemon::sketch::{Sketch, Tool};
use penstemon::species::Species;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::f32::consts::TAU;

/// Flowers of each number of rings.
const FLOWERS: u64 = 200;

/// A flower of so many rings; inner petals are shorter and steeper, and stand between those outside.
fn flower(rings: usize, rng: &mut Pcg64Mcg) -> Truth {
    let axis = cone_flowers::axis(rng, (25.0, 80.0));
    let petals = rng.random_range(5..=8);
    let (outer, shorter) = (rng.random_range(60f32..80.0), rng.random_range(0.7..0.85f32));
    let (steeper, start) = (rng.random_range(0.6..0.8f32), rng.random_range(0.0..TAU));
    let ring = |k: usize| Ring {
        petals,
        opening: (outer * steeper.powi(k as i32)).to_radians(),
        length: 200.0 * shorter.powi(k as i32),
        start: start + (k % 2) as f32 * 0.5 * TAU / petals as f32,
        fullness: 0.9,
        foot: 0.05,
    };
    let shape = rng.random_range(0..3);
    Truth { center: Vec2::splat(500.0), axis, rings: (0..rings).map(ring).collect(), shape }
}

fn pose(petals: &[Vec<Vec2>]) -> FlowerPose {
    let outlines: Vec<_> = petals.iter().map(|p| PetalOutline { points: p, root: p[0] }).collect();
    flower_pose(&outlines, None, &ConeParams::default())
}

#[test]
fn whorls_of_drawn_flowers_are_told_apart() {
    let careful = Hand { noise: 0.003, ..Hand::default() };
    let shaky = Hand { lengths: 0.03, turns: 0.03, ..careful };
    // Of one hundred flowers of 1, 2, 3 and 4 rings, so many are found as such; half of all axes are so near, degrees.
    let hands = [("careful", careful, [98, 97, 94, 70], 1.0), ("3 %", shaky, [98, 97, 93, 68], 3.0)];
    eprintln!("| hand | rings | found right | axis | 95 % |");
    for (name, hand, least, nearest) in hands {
        for rings in 1..=4 {
            let (mut right, mut axes) = (0, Vec::new());
            for seed in 0..FLOWERS {
                let mut rng = Pcg64Mcg::seed_from_u64(4 * seed + rings as u64);
                let truth = flower(rings, &mut rng);
                let found = pose(&truth.drawn(&hand, &mut rng));
                right += u64::from(found.whorls.len() == rings);
                axes.push(found.axis.angle_between(truth.axis).to_degrees());
            }
            axes.sort_by(f32::total_cmp);
            let share = 100 * right / FLOWERS;
            let at = |share: usize| axes[axes.len() * share / 100];
            eprintln!("| {name} | {rings} | {share} % | {:.1} | {:.1} |", at(50), at(95));
            assert!(share >= least[rings - 1] && at(50) <= nearest, "{name}, {rings} rings");
        }
    }
}

fn built(sketch: &Sketch, set: &[&str]) -> Built {
    let species = Species::built_in("plant").unwrap();
    let set: Vec<String> = set.iter().map(|set| (*set).to_owned()).collect();
    pipeline::build(sketch, &species, &pipeline::params_of(sketch, &species, &set).unwrap())
}

/// Middles of petals that were drawn, and of those that were not.
fn middles(built: &Built) -> [Vec<Vec3>; 2] {
    let plant = &built.plant;
    let middles = |is_drawn: bool| {
        let petals = plant.organs.iter().filter(|organ| organ.kind() == OrganKind::Petal);
        let wanted = petals.filter(|organ| (organ.origin != Origin::Generated) == is_drawn);
        wanted
            .filter_map(|organ| match &organ.shape {
                Shape::Blade(blade) => Some(plant.templates.resolve(blade)),
                _ => None,
            })
            .map(|blade| {
                let outline = blade.template.outline();
                outline.iter().map(|uv| blade.at_rest(*uv)).sum::<Vec3>() / outline.len() as f32
            })
            .collect()
    };
    [middles(true), middles(false)]
}

#[test]
fn hidden_petals_of_whorls_are_filled_in_where_they_were() {
    let mut rng = Pcg64Mcg::seed_from_u64(11);
    let axis = Vec3::new(0.25, 0.5, 0.8).normalize();
    let truth = Truth { axis, shape: 1, ..flower(3, &mut rng) };
    let count = truth.rings[0].petals;
    let all = truth.drawn(&Hand::default(), &mut rng);
    let is_hidden = |petal: usize| [1, count + 2, 2 * count + 3].contains(&petal);
    let sketch = |petals: Vec<Vec<Vec2>>| drawings::sketch(petals.into_iter().map(|p| (Tool::Petal, p)));
    let seen = all.iter().enumerate().filter(|(k, _)| !is_hidden(*k)).map(|(_, petal)| petal.clone());
    let seen = sketch(seen.collect());
    let (whole, filled) = (built(&sketch(all), &[]), built(&seen, &[]));
    let ([drawn, none], [_, copies]) = (middles(&whole), middles(&filled));
    assert_eq!((none.len(), copies.len()), (0, 3));
    let reach = whole.plant.flowers[0].reach;
    // The ground moves with what is drawn, so places are counted from the centres.
    let [before, after] = [&whole, &filled].map(|built| built.plant.flowers[0].cone.apex);
    for copy in copies {
        let off = |petal: &Vec3| ((*petal - before) - (copy - after)).length() / reach;
        let nearest = drawn.iter().map(off).fold(f32::INFINITY, f32::min);
        assert!(nearest < 0.08, "{nearest} of the reach from any petal");
    }
    let without = built(&seen, &["depth.cone.fill_hidden=false"]);
    assert!(middles(&without)[1].is_empty());
}
