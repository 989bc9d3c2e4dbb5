//! Flowers in layers: what must hold of every species at every opening.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use glam::{Vec2, Vec3};
use penstemon::model::crossing::crossing_faces;
use penstemon::model::quality::judge_model;
use penstemon::model::{Mesh, Model};
use penstemon::pipeline::{self, Bloom, Built, Seed};
use penstemon::plant::OrganKind;
use penstemon::sketch::{Sketch, Stroke, StrokePoint, Tool};
use penstemon::species::Species;
use rayon::prelude::*;

const DOUBLE: [&str; 10] = [
    "peony",
    "rose",
    "camellia",
    "lotus",
    "water_lily",
    "chrysanthemum",
    "dahlia",
    "carnation",
    "ranunculus",
    "marigold",
];

fn bloom(name: &str, assignments: &[&str]) -> Built {
    let species = Species::built_in(name).unwrap();
    let assignments: Vec<String> = assignments.iter().map(|&assignment| assignment.to_owned()).collect();
    let params = pipeline::params_of_species(&species, &assignments).unwrap();
    pipeline::build(&Bloom { number: 1 }, &species, &params)
}

/// The share of the faces of parts with these beginnings of names that pass through others.
fn crossing(model: &Model, names: &[&str]) -> f32 {
    let mut mesh = Mesh::default();
    for part in model.parts.iter().filter(|part| names.iter().any(|name| part.name.starts_with(name))) {
        mesh.append(&part.flattened_mesh());
    }
    assert!(!mesh.triangles.is_empty(), "no such parts");
    crossing_faces(&mesh).unwrap() as f32 / mesh.triangles.len() as f32
}

#[test]
fn petals_of_double_flowers_pass_through_each_other_at_no_opening() {
    let worst = |name: &&str| {
        let open = |percent: u32| {
            let built = bloom(name, &[&format!("flower.open={}", percent as f32 / 100.0)]);
            crossing(&built.model, &["petal"])
        };
        let on_the_way = [0, 10, 25, 40, 50, 60, 75, 90].map(open).into_iter().fold(0.0, f32::max);
        (open(100), on_the_way)
    };
    for (name, (full, on_the_way)) in DOUBLE.iter().zip(DOUBLE.par_iter().map(worst).collect::<Vec<_>>()) {
        assert!(full <= 0.03, "{name} in full bloom: {full}");
        assert!(on_the_way <= 0.045, "{name} while it opens: {on_the_way}");
    }
}

#[test]
fn nothing_in_a_flower_passes_through_the_rest_of_it() {
    let names = ["petal", "stamen", "anther", "pistil", "stigma", "receptacle", "sepal"];
    let single = ["tulip", "lily", "poppy", "sunflower", "daisy"];
    for name in DOUBLE.iter().chain(&single) {
        let share = crossing(&bloom(name, &[]).model, &names);
        assert!(share <= 0.035, "{name}: {share}");
    }
}

#[test]
fn every_flower_is_closed_and_sound_at_every_opening() {
    let all: Vec<(&str, f32)> =
        Species::blooming().into_iter().flat_map(|name| [0.0, 0.5, 1.0].map(|open| (name, open))).collect();
    all.par_iter().for_each(|(name, open)| {
        let built = bloom(name, &[&format!("flower.open={open}")]);
        let report = judge_model(&built.model);
        assert!(report.is_clean(), "{name} open to {open}: {:?}", report.defects());
        assert!(built.remarks.is_empty(), "{name}: {:?}", built.remarks);
    });
}

/// How far petals reach from the axis of their flower.
fn width(built: &Built) -> f32 {
    let flower = &built.plant.flowers[0];
    let axis = flower.cone.axis.normalize();
    let out = |p: Vec3| (p - flower.cone.apex).reject_from_normalized(axis).length();
    let petals = built.model.parts.iter().filter(|part| part.name.starts_with("petal"));
    petals.flat_map(|part| part.flattened_mesh().points.clone()).map(out).fold(0.0, f32::max)
}

#[test]
fn buds_are_slender_and_widen_steadily() {
    for name in DOUBLE.iter().chain(&["tulip", "lily", "poppy"]) {
        let alone = "flower.clump.stems=1";
        let width = |k: u32| width(&bloom(name, &[alone, &format!("flower.open={}", k as f32 / 8.0)]));
        let widths: Vec<f32> = (0..=8).map(width).collect();
        let steady = widths.windows(2).all(|pair| pair[1] > 0.93 * pair[0]);
        assert!(steady && widths[0] < 0.75 * widths[8], "{name}: {widths:?}");
    }
}

#[test]
fn flowers_are_the_same_on_any_number_of_threads() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let model = bloom("peony", &["flower.open=0.7"]).model;
            let bits = |p: &Vec3| p.to_array().map(f32::to_bits);
            let of = |part: &penstemon::model::Part| -> Vec<_> {
                part.flattened_mesh().points.iter().map(bits).collect()
            };
            model.parts.iter().map(of).collect::<Vec<_>>()
        })
    };
    assert_eq!(on(1), on(4));
}

#[test]
fn roses_stay_within_their_budget() {
    let species = Species::built_in("rose").unwrap();
    let params = pipeline::params_of_species(&species, &[]).unwrap();
    for number in 0..12 {
        let built = pipeline::build(&Seed { number, ..Seed::default() }, &species, &params);
        assert!(built.plant.flowers.len() <= 8 && built.plant.flowers.len() >= 6);
        assert!(built.model.triangle_count() <= 80_000, "{}", built.model.triangle_count());
        assert!(judge_model(&built.model).is_clean());
    }
}

/// A drawing of one line with the branch tool, of this species, so high.
fn one_line(points: &[(f32, f32)], species: &str, height: f64) -> Built {
    let line = (0..=40).map(|k| {
        let t = k as f32 / 40.0 * (points.len() - 1) as f32;
        let (i, part) = ((t as usize).min(points.len() - 2), t.fract());
        let part = if t as usize > i { 1.0 } else { part };
        let ((x0, y0), (x1, y1)) = (points[i], points[i + 1]);
        StrokePoint::at(Vec2::new(x0 + (x1 - x0) * part, y0 + (y1 - y0) * part))
    });
    let stroke = Stroke { id: 1, tool: Tool::Branch, points: line.collect(), brush: None };
    let mut sketch =
        Sketch { species: Some(species.to_owned()), strokes: vec![stroke.into()], ..Sketch::empty() };
    sketch.params.insert("depth.world.height".to_owned(), height.into());
    let species = Species::built_in(species).unwrap();
    let params = pipeline::params_of(&sketch, &species, &[]).unwrap();
    pipeline::build(&sketch, &species, &params)
}

fn organs(built: &Built, kind: OrganKind) -> usize {
    built.plant.organs.iter().filter(|organ| organ.kind() == kind).count()
}

#[test]
fn clumps_have_their_stems_and_stems_their_leaves() {
    let count = |assignments: &[&str]| {
        let built = bloom("tulip", assignments);
        assert_eq!(built.plant.check_invariants(), Ok(()));
        (built.plant.flowers.len(), organs(&built, OrganKind::Leaf))
    };
    assert_eq!(count(&["flower.leaves.nodes=0"]), (1, 0));
    let pairs = ["flower.leaves.nodes=3", "flower.leaves.per_node=2", "flower.leaves.rosette=4"];
    assert_eq!(count(&pairs), (1, 10));
    assert_eq!(count(&[&pairs[..], &["flower.clump.stems=5"]].concat()), (5, 34));
    let spikes =
        |stems: &str| organs(&bloom("lavender", &[stems, "flower.leaves.nodes=0"]), OrganKind::Petal);
    assert!(spikes("flower.clump.stems=3") > 2 * spikes("flower.clump.stems=1"));
}

#[test]
fn bare_stems_come_into_leaf_and_flower_by_their_species() {
    let upright = [(200.0, 580.0), (190.0, 420.0), (215.0, 250.0), (205.0, 60.0)];
    let rose = one_line(&upright, "rose", 0.6);
    assert_eq!(rose.plant.flowers.len(), 1);
    assert!(organs(&rose, OrganKind::Leaf) > 15 && organs(&rose, OrganKind::Thorn) > 3);
    let end = rose.plant.branches[0].points.last().unwrap();
    assert!(rose.plant.flowers[0].cone.apex.distance(*end) < 0.03);
    let peony = one_line(&upright, "peony", 0.6);
    assert_eq!((peony.plant.flowers.len(), organs(&peony, OrganKind::Leaf)), (1, 0));
    // Species without full flowers leave stems as they are.
    assert_eq!(one_line(&upright, "mallow", 0.6).plant.flowers.len(), 0);
    for built in [rose, peony] {
        assert!(judge_model(&built.model).is_clean());
    }
}

#[test]
fn roses_climb_along_a_drawn_arch() {
    let arch = [
        (100.0, 580.0),
        (95.0, 300.0),
        (200.0, 100.0),
        (300.0, 60.0),
        (400.0, 100.0),
        (505.0, 300.0),
        (500.0, 560.0),
    ];
    let rose = one_line(&arch, "rose", 2.2);
    assert!(rose.plant.flowers.len() > 15, "{}", rose.plant.flowers.len());
    assert!(rose.plant.branches[1..].iter().all(|branch| branch.parent == Some(0)));
    assert!(judge_model(&rose.model).is_clean());
}
