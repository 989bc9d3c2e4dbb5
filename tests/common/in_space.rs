//! A drawing in space, and plants that are sound whatever was done to it.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use penstemon::pipeline::{self, Built};
use penstemon::sketch::{self, Sketch};
use std::path::Path;

/// A trunk on the sheet and sixteen branches in space, the trunk bent, a bough turned.
pub(crate) fn in_space() -> Sketch {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/in_space.penstemon");
    sketch::read(&path).unwrap().0
}

/// The plant of a drawing, whose invariants and those of its meshes hold.
pub(crate) fn built(sketch: &Sketch) -> Built {
    let species = pipeline::species_of(sketch, Path::new("")).unwrap();
    let params = pipeline::params_of(sketch, &species, &[]).unwrap();
    let built = pipeline::build(sketch, &species, &params);
    built.plant.check_invariants().unwrap();
    built.model.parts.iter().for_each(|part| part.mesh.check_invariants().unwrap());
    built
}
