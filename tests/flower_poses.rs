//! Flowers stand still while they are edited: a petal erased turns a flower by a few degrees only, and no stem passes
//! through a petal of its own flower.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use glam::Vec3;
use penstemon::model::Mesh;
use penstemon::pipeline::{self, Built};
use penstemon::plant::{Flower, OrganKind};
use penstemon::sketch::{self, Sketch};
use std::path::{Path, PathBuf};

fn drawings() -> Vec<(String, Sketch)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sketches");
    let mut files: Vec<PathBuf> = folder.read_dir().unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let read = |path: PathBuf| {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        (name, sketch::read::read(&path).unwrap().0)
    };
    files.into_iter().map(read).collect()
}

fn built(sketch: &Sketch) -> Built {
    let species = pipeline::species_of(sketch, Path::new("")).unwrap();
    let params = pipeline::params_of(sketch, &species, &[]).unwrap();
    pipeline::build(sketch, &species, &params)
}

fn petals(built: &Built, flower: usize) -> Vec<u64> {
    let of = built.plant.organs.iter().filter(|o| o.flower == Some(flower) && o.kind == OrganKind::Petal);
    of.filter_map(|organ| organ.stroke).collect()
}

/// The flower of a plant that stands where this one does in the drawing.
fn same<'a>(built: &'a Built, flower: &Flower) -> (usize, &'a Flower) {
    let off = |other: &Flower| other.cone.apex.truncate().distance(flower.cone.apex.truncate());
    let flowers = built.plant.flowers.iter().enumerate();
    flowers.min_by(|a, b| off(a.1).total_cmp(&off(b.1))).unwrap()
}

fn passes(p: Vec3, q: Vec3, [a, b, c]: [Vec3; 3]) -> bool {
    let normal = (b - a).cross(c - a);
    let (before, after) = ((p - a).dot(normal), (q - a).dot(normal));
    let at = p.lerp(q, before / (before - after));
    let inside = |u: Vec3, v: Vec3| (v - u).cross(at - u).dot(normal) >= 0.0;
    before * after < 0.0 && inside(a, b) && inside(b, c) && inside(c, a)
}

/// Whether a stem's middle passes through a petal, beyond the receptacle in which both end.
fn is_pierced(built: &Built, index: usize) -> bool {
    let flower = &built.plant.flowers[index];
    let Some(stem) = flower.branch.map(|branch| &built.plant.branches[branch]) else { return false };
    let meets = |mesh: &Mesh| {
        let at = |vertex: u32| mesh.points[mesh.vertices[vertex as usize].point as usize];
        mesh.triangles.iter().map(|face| face.map(at)).any(|face| {
            let middle = (face[0] + face[1] + face[2]) / 3.0;
            let is_outside = middle.distance(flower.cone.apex) > flower.heart_radius;
            is_outside && stem.points.windows(2).any(|w| passes(w[0], w[1], face))
        })
    };
    let own = format!("petal_{index}_");
    let mut parts = built.model.parts.iter().filter(|part| part.name.starts_with(&own));
    assert!(parts.clone().next().is_some(), "no petals of flower {index}");
    parts.any(|part| meets(&part.mesh))
}

#[test]
fn a_petal_erased_turns_a_flower_by_few_degrees_and_no_stem_pierces_a_petal() {
    let mut swings = Vec::new();
    for (name, sketch) in drawings() {
        let whole = built(&sketch);
        for (index, flower) in whole.plant.flowers.iter().enumerate() {
            assert!(!is_pierced(&whole, index), "{name}: flower {index}");
            for stroke in petals(&whole, index) {
                let mut less = sketch.clone();
                less.strokes.retain(|s| s.id != stroke);
                let less = built(&less);
                let (now, other) = same(&less, flower);
                let swing = other.cone.axis.angle_between(flower.cone.axis).to_degrees();
                assert!(swing <= 9.0, "{name}: flower {index} turns by {swing}° without stroke {stroke}");
                assert!(!is_pierced(&less, now), "{name}: flower {index} without stroke {stroke}");
                swings.push(swing);
            }
        }
    }
    swings.sort_by(f32::total_cmp);
    let [median, p95] = [50, 95].map(|percent| swings[swings.len() * percent / 100]);
    eprintln!(
        "{} petals: median {median}°, 95th percentile {p95}°, most {}°",
        swings.len(),
        swings[swings.len() - 1]
    );
    assert!(median <= 1.5 && p95 <= 7.0, "median {median}°, 95th percentile {p95}°");
}
