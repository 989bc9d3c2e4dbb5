//! Nothing of a plant reaches below its ground, at any age and in any drawing; pots aside, which stand where they stand.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use penstemon::model::{Model, PartKind};
use penstemon::pipeline::{self, Seed};
use penstemon::plant::OrganKind;
use penstemon::sketch;
use penstemon::species::Species;
use std::path::{Path, PathBuf};

/// How far below the ground the bark around the lowest point that was drawn may be, as a share of the plant's height.
const SKIN: f32 = 0.01;
/// How far below the ground a leaf or petal may reach, metres: what rounding and its curl do.
const LEAF_M: f32 = 0.005;

fn assert_above(name: &str, model: &Model) {
    let heights = |part: &penstemon::model::Part| part.points().map(|p| p.y).collect::<Vec<_>>();
    let high = model.parts.iter().flat_map(heights).fold(0.0, f32::max);
    if model.parts.iter().any(|part| part.kind == PartKind::Organ(OrganKind::Pot)) {
        return;
    }
    for part in &model.parts {
        let low = heights(part).into_iter().fold(0.0, f32::min);
        let allowed =
            if matches!(part.kind, PartKind::Organ(_)) { LEAF_M.min(SKIN * high) } else { SKIN * high };
        assert!(low >= -allowed, "{name}: {} reaches {} m under the ground", part.name, -low);
    }
}

#[test]
fn drawn_plants_stand_on_their_ground() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sketches");
    let files = folder.read_dir().unwrap().map(|entry| entry.unwrap().path());
    for file in files.collect::<Vec<PathBuf>>() {
        let (sketch, _) = sketch::read::read(&file).unwrap();
        let species = pipeline::species_of(&sketch, Path::new("")).unwrap();
        let params = pipeline::params_of(&sketch, &species, &[]).unwrap();
        assert_above(&file.display().to_string(), &pipeline::build(&sketch, &species, &params).model);
    }
}

#[test]
fn grown_plants_stand_on_their_ground_at_every_age() {
    for name in Species::growing() {
        let species = Species::built_in(name).unwrap();
        let params = pipeline::params_of_species(&species, &[]).unwrap();
        let own = species.growth.as_ref().unwrap().age as f32;
        for age in [1.0, 2.0, 3.5, 8.0, own] {
            let age = age.min(own);
            let grown =
                pipeline::build(&Seed { number: 1, age: Some(age), ..Seed::default() }, &species, &params);
            assert_above(&format!("{name} of {age} years"), &grown.model);
        }
    }
}
