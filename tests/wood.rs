//! Wood hardly passes through itself: grown at every age, drawn in the sample drawings; and `penstemon check` counts the
//! same faces in every format.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use penstemon::growth::{Limits, Simulation, plant_at};
use penstemon::model::crossing::crossing_faces;
use penstemon::model::quality::judge_model;
use penstemon::model::{self, ModelParams};
use penstemon::pipeline::{self, Built};
use penstemon::plant::{FinishedPlant, Plant, Templates};
use penstemon::sketch;
use penstemon::species::Species;
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Faces of the wood alone that pass through others, and all of its faces.
fn crossing_wood(name: &str, plant: &Plant) -> (usize, usize) {
    let bare = Plant { organs: Vec::new(), templates: Templates::default(), ..plant.clone() };
    let wood = FinishedPlant::plain(bare);
    let model = model::build(&wood, &ModelParams::default());
    let trunks = plant.branches.iter().filter(|branch| branch.parent.is_none()).count();
    let report = judge_model(&model);
    assert_eq!(
        (report.is_clean(), report.components),
        (true, trunks),
        "{name}: a sound surface for every trunk"
    );
    (model.parts.iter().map(|part| crossing_faces(&part.mesh).unwrap()).sum(), report.triangles)
}

/// The ages at which a species is looked at, its own last.
fn ages(species: &Species) -> Vec<f32> {
    let own = species.growth.as_ref().unwrap().age as f32;
    [2.0, 3.0, 5.0, 8.0, 12.0].into_iter().filter(|age| *age < own).chain([own]).collect()
}

/// Young wood has few faces, of which one joint that is too narrow is a large share.
#[test]
fn grown_wood_hardly_cuts_itself_at_any_age() {
    let (mut crossing, mut faces, mut above, mut plants) = (0, 0, Vec::new(), 0);
    for name in Species::growing() {
        let species = Species::built_in(name).unwrap();
        for seed in 1..=3 {
            let mut simulation = Simulation::new(species.growth.as_ref().unwrap(), seed, Limits::default());
            for age in ages(&species).into_iter().take(if seed == 1 { 6 } else { 5 }) {
                simulation.grow_to(age as u16, &|| false);
                let what = format!("{name} of {age} years, seed {seed}");
                let (count, all) = crossing_wood(&what, &plant_at(&simulation, age).plant);
                if count * 1000 > all {
                    above.push(format!("{what}: {count} of {all}"));
                }
                (crossing, faces, plants) = (crossing + count, faces + all, plants + 1);
            }
        }
    }
    eprintln!("{crossing} of {faces} faces of {plants} plants; more than 0.1 %: {above:#?}");
    assert!(crossing * 10_000 <= faces, "{crossing} of {faces}");
    assert!(above.is_empty() && plants > 200, "{} of {plants}: {above:?}", above.len());
}

/// Five plants of every species as old as it says: each keeps what is said of grown wood, without the exceptions of young wood.
#[test]
fn five_plants_of_every_species_hardly_cut_themselves() {
    let plants: Vec<(&str, u64)> =
        Species::growing().into_iter().flat_map(|name| (1..=5).map(move |seed| (name, seed))).collect();
    let crossing_of = |&(name, seed): &(&str, u64)| {
        let species = Species::built_in(name).unwrap();
        let habit = species.growth.as_ref().unwrap();
        let mut simulation = Simulation::new(habit, seed, Limits::default());
        simulation.grow_to(habit.age as u16, &|| false);
        let what = format!("{name} of {} years, seed {seed}", habit.age);
        let (count, all) = crossing_wood(&what, &plant_at(&simulation, habit.age as f32).plant);
        assert!(count * 1000 <= all, "{what}: {count} of {all} faces cross others");
        (count, all)
    };
    let counts: Vec<(usize, usize)> = plants.par_iter().map(crossing_of).collect();
    let (crossing, faces) = counts.iter().fold((0, 0), |sum, of| (sum.0 + of.0, sum.1 + of.1));
    eprintln!("{crossing} of {faces} faces of {} plants", counts.len());
    assert!(crossing * 10_000 <= faces, "{crossing} of {faces}");
    assert_eq!(counts.len(), 5 * Species::growing().len());
}

fn drawings() -> Vec<(String, Built)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sketches");
    let mut files: Vec<PathBuf> = folder.read_dir().unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let build = |path: PathBuf| {
        let sketch = sketch::read::read(&path).unwrap().0;
        let species = pipeline::species_of(&sketch, Path::new("")).unwrap();
        let params = pipeline::params_of(&sketch, &species, &[]).unwrap();
        (
            path.file_stem().unwrap().to_string_lossy().into_owned(),
            pipeline::build(&sketch, &species, &params),
        )
    };
    files.into_iter().map(build).collect()
}

#[test]
fn drawn_wood_hardly_cuts_itself() {
    let mut clean = 0;
    for (name, built) in drawings() {
        let (count, all) = crossing_wood(&name, &built.plant);
        eprintln!("{name}: {count} of {all}");
        assert!(count as f32 <= 0.005 * all as f32, "{name}: {count} of {all} faces cross others");
        clean += usize::from(count == 0);
    }
    assert!(clean >= 11, "only {clean} drawings are without crossing faces");
}

fn penstemon(arguments: &[&Path], flags: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_penstemon")).args(flags).args(arguments).output().unwrap()
}

#[test]
fn check_counts_the_same_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    let drawing = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sketches/tree_round.penstemon");
    let counts = ["tree.obj", "tree.glb"].map(|name| {
        let model = folder.path().join(name);
        let built = penstemon(&[&model, &drawing], &["build", "-o"]);
        assert!(built.status.success(), "{built:?}");
        let output = penstemon(&[&model], &["check", "--json"]);
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        report["crossing_faces"].as_u64().unwrap()
    });
    assert!(counts[0] > 0 && counts[0] == counts[1], "{counts:?}");
}
