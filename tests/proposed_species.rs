//! Drawings that name no species: those that their flowers look like are proposed, and nothing is changed by that.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use penstemon::pipeline;
use penstemon::sketch::{self, Remark, Sketch};
use std::path::Path;

/// What is proposed for a sketch that the program ships with; whether it keeps its species is up to the caller.
fn proposed(name: &str, names_it: bool) -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sketches");
    let (sketch, _) = sketch::read::read(&folder.join(format!("{name}.penstemon"))).unwrap();
    let sketch = Sketch { species: sketch.species.filter(|_| names_it), plants: Vec::new(), ..sketch };
    let species = pipeline::species_of(&sketch, &folder).unwrap();
    let params = pipeline::params_of(&sketch, &species, &[]).unwrap();
    let built = pipeline::build(&sketch, &species, &params);
    let list = built.remarks.iter().find_map(|warning| match &warning.remark {
        Remark::LooksLike { species } => Some(species.split(", ").map(str::to_owned).collect()),
        _ => None,
    });
    list.unwrap_or_default()
}

#[test]
fn the_species_of_a_drawing_is_among_those_that_it_looks_like() {
    let drawn = ["balloon_flower", "daisy", "hepatica_blue", "jasmine", "mallow", "oxalis", "plumeria"];
    let mut missed = Vec::new();
    for species in drawn {
        let list = proposed(species, false);
        eprintln!("{species}: {list:?}");
        if !list.iter().any(|name| name == species) {
            missed.push((species, list));
        }
    }
    assert!(missed.is_empty(), "{missed:?}");
}

#[test]
fn a_species_that_was_chosen_is_not_questioned_and_trees_look_like_no_flower() {
    assert!(proposed("daisy", true).is_empty());
    assert!(proposed("tree_round", false).is_empty());
    assert!(proposed("freehand_cactus", false).is_empty());
}
