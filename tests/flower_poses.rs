//! Flowers stand still while they are edited: a petal erased turns a flower by a few degrees only, and no stem, as thick as
//! it is, touches a petal of its own flower; petals do not pass through each other.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use glam::Vec3;
use penstemon::model::Mesh;
use penstemon::model::crossing::crossing_faces;
use penstemon::pipeline::{self, Built};
use penstemon::plant::{Flower, OrganKind};
use penstemon::sketch::{self, Sketch};
use std::path::{Path, PathBuf};

fn drawings() -> Vec<(String, Sketch)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sketches");
    let mut files: Vec<PathBuf> = folder.read_dir().unwrap().map(|entry| entry.unwrap().path()).collect();
    // Whole corollas in one stroke have no petals that could be erased.
    files.retain(|path| !path.file_stem().unwrap().to_string_lossy().starts_with("freehand"));
    files.sort();
    let read = |path: PathBuf| {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        // What stands beside the drawn plant has no part in its flowers.
        (name, Sketch { plants: Vec::new(), ..sketch::read::read(&path).unwrap().0 })
    };
    files.into_iter().map(read).collect()
}

fn built(sketch: &Sketch) -> Built {
    let species = pipeline::species_of(sketch, Path::new("")).unwrap();
    let params = pipeline::params_of(sketch, &species, &[]).unwrap();
    pipeline::build(sketch, &species, &params)
}

fn petals(built: &Built, flower: usize) -> Vec<u64> {
    let of = built.plant.organs.iter().filter(|o| o.flower == Some(flower) && o.kind() == OrganKind::Petal);
    of.filter_map(|organ| built.provenance.stroke(organ.origin)).collect()
}

/// The flower of a plant that stands where this one does in the drawing.
fn same<'a>(built: &'a Built, flower: &Flower) -> (usize, &'a Flower) {
    let off = |other: &Flower| other.cone.apex.truncate().distance(flower.cone.apex.truncate());
    let flowers = built.plant.flowers.iter().enumerate();
    flowers.min_by(|a, b| off(a.1).total_cmp(&off(b.1))).unwrap()
}

/// Distance of a point from a segment, and the share of the segment before the place nearest to it.
fn off((a, b): (Vec3, Vec3), p: Vec3) -> (f32, f32) {
    let share = ((p - a).dot(b - a) / (b - a).length_squared().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
    (p.distance(a.lerp(b, share)), share)
}

/// Whether any of a petal lies within a stem, beyond the receptacle in which both end: faces of petals are smaller than
/// stems are thick, so their corners and the middles of their edges tell.
fn is_pierced(built: &Built, index: usize) -> bool {
    let flower = &built.plant.flowers[index];
    let Some(stem) = flower.branch.map(|branch| &built.plant.branches[branch]) else { return false };
    let is_within = |p: Vec3| {
        p.distance(flower.cone.apex) > flower.centre_radius
            && (1..stem.points.len()).any(|i| {
                let (distance, share) = off((stem.points[i - 1], stem.points[i]), p);
                distance < stem.radii[i - 1] + (stem.radii[i] - stem.radii[i - 1]) * share
            })
    };
    let enters = |mesh: &Mesh| {
        mesh.triangles.iter().any(|face| {
            let [a, b, c] = mesh.corners(*face);
            [a, b, c, a.midpoint(b), b.midpoint(c), c.midpoint(a)].into_iter().any(is_within)
        })
    };
    let own = format!("petal_{index}_");
    let mut parts = built.model.parts.iter().filter(|part| part.name.starts_with(&own));
    assert!(parts.clone().next().is_some(), "no petals of flower {index}");
    parts.any(|part| enters(&part.flattened_mesh()))
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

#[test]
fn petals_of_single_flowers_keep_out_of_each_other() {
    // The rose of the bouquet has two whorls.
    for (name, sketch) in drawings().iter().filter(|(name, _)| name != "bouquet") {
        let mut petals = Mesh::default();
        for part in built(sketch).model.parts.iter().filter(|part| part.name.starts_with("petal")) {
            petals.append(&part.flattened_mesh());
        }
        let crossing = crossing_faces(&petals).unwrap();
        assert!(
            100 * crossing <= 3 * petals.triangles.len(),
            "{name}: {crossing} of {} faces pass through others",
            petals.triangles.len()
        );
    }
}
