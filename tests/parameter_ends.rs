//! Every parameter at both ends of its range, one at a time: no plant costs more than its budget.
//!
//! A drawing whose outlines are filled and a tree that grows with flowers are built in this process, once for each end of
//! each parameter. What was made is counted against [`Budget::PLANT`], and bytes are counted by the allocator at their
//! peak. What several parameters do together is tried by `tests/budgets.rs`, on the program under the system's limits.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use peak_alloc::PeakAlloc;
use penstemon::budget::Budget;
use penstemon::growth::Limits;
use penstemon::model::Model;
use penstemon::params::{Description, Parameters as _};
use penstemon::pipeline::{self, Cache, Seed};
use penstemon::plant::{OrganKind, Plant};
use penstemon::sketch::{self, Sketch};
use penstemon::species::Species;
use std::path::Path;

#[global_allocator]
static COUNTER: PeakAlloc = PeakAlloc;

/// Most bytes of one plant while it is built.
const BYTES: usize = 2 << 30;
/// Age of the tree, years: it has flowers, and is built in a fraction of a second.
const AGE: f32 = 10.0;

/// A parameter at its least or at its most, as `--set` writes it.
fn at_end(of: &Description, most: bool) -> String {
    let value = if most { of.max } else { of.min };
    format!("{}={}", of.path, of.kind.written(value))
}

/// Counts a plant and its model against the budget; `set` is what it was built with.
fn affordable(set: &str, plant: &Plant, model: &Model) {
    let Budget { twigs, leaves, blossoms, triangles, internodes, .. } = Budget::PLANT;
    let count = |kind: OrganKind| plant.organs.iter().filter(|organ| organ.kind() == kind).count();
    assert!(count(OrganKind::Leaf) <= leaves, "{set}: {} leaves", count(OrganKind::Leaf));
    assert!(plant.flowers.len() <= blossoms + 1000, "{set}: {} flowers", plant.flowers.len());
    assert!(plant.branches.len() <= twigs.max(internodes), "{set}: {} branches", plant.branches.len());
    assert!(model.triangle_count() as u64 <= triangles, "{set}: {} triangles", model.triangle_count());
}

/// Builds with every one of these parameters at both ends; the largest peak in bytes, and what made it.
fn largest(all: &[Description], mut build: impl FnMut(&[String])) -> (usize, String) {
    let ends = all.iter().flat_map(|of| [false, true].map(|most| at_end(of, most)));
    let peak = |set: String| {
        let before = COUNTER.current_usage();
        COUNTER.reset_peak_usage();
        build(std::slice::from_ref(&set));
        let peak = COUNTER.peak_usage() - before;
        assert!(peak <= BYTES, "{set}: {peak} bytes");
        (peak, set)
    };
    ends.map(peak).max().unwrap()
}

fn tree_round() -> Sketch {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sketches/tree_round.penstemon");
    sketch::read(&path).unwrap().0
}

// One test, so that the allocator counts one plant at a time.
#[test]
fn no_parameter_alone_exceeds_the_budget() {
    let sketch = tree_round();
    let species = pipeline::species_of(&sketch, Path::new("")).unwrap();
    let usual = pipeline::params_of(&sketch, &species, &[]).unwrap();
    let (bytes, set) = largest(&usual.describe(), |sets| {
        let params = pipeline::params_of(&sketch, &species, sets).unwrap();
        let built = pipeline::build(&sketch, &species, &params);
        affordable(&sets[0], &built.plant, &built.model);
    });
    eprintln!("the drawing: at most {} MB, with {set}", bytes >> 20);

    let species = Species::built_in("cherry").unwrap();
    let all = pipeline::params_of_species(&species, &[]).unwrap().describe();
    let of_grown = |of: &&Description| ["habit.", "model."].iter().any(|group| of.path.starts_with(group));
    let all: Vec<Description> = all.iter().filter(of_grown).cloned().collect();
    let limits = Limits::default();
    let (bytes, set) = largest(&all, |sets| {
        let params = pipeline::params_of_species(&species, sets).unwrap();
        let (mut cache, seed) = (Cache::default(), Seed { number: 1, age: Some(AGE), ..Seed::default() });
        let grown = pipeline::build_with(&mut cache, &seed, &species, &params, &|| false).unwrap();
        let simulation = cache.seed.simulation().unwrap();
        let (steps, internodes) = (simulation.steps(), simulation.tree().len());
        assert!(steps <= limits.steps, "{sets:?}: {steps} steps");
        assert!(internodes <= limits.internodes, "{sets:?}: {internodes} internodes");
        affordable(&sets[0], &grown.plant, &grown.model);
    });
    eprintln!("the tree: at most {} MB, with {set}", bytes >> 20);
}
