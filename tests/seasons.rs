//! Plants through the year, from drawing or seed to surfaces: leaves come and go, all else stays, nothing breaks.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use crate::drawings::leafy_tree;
use penstemon::pipeline::{self, Built, Seed, params_of_species};
use penstemon::plant::OrganKind;
use penstemon::sketch::Sketch;
use penstemon::species::Species;

const TIMES: [f32; 6] = [0.0, 0.6, 2.0, 3.6, 4.5, 5.0];

fn params(species: &Species, time: f32) -> pipeline::Params {
    params_of_species(species, &[format!("season.time={time}")]).unwrap()
}

fn grown(name: &str, time: f32) -> Built {
    let species = Species::built_in(name).unwrap();
    let seed = Seed { number: 3, age: Some(9.0), ..Seed::default() };
    pipeline::build(&seed, &species, &params(&species, time))
}

fn leaves(built: &Built) -> usize {
    built.plant.organs.iter().filter(|organ| organ.kind() == OrganKind::Leaf).count()
}

#[test]
fn a_grown_tree_keeps_its_wood_and_loses_its_leaves() {
    let summer = grown("ash", 2.0);
    for time in TIMES {
        let built = grown("ash", time);
        assert_eq!(built.plant.branches, summer.plant.branches, "{time}");
        assert_eq!(built.plant.check_invariants(), Ok(()), "{time}");
        for part in &built.model.parts {
            assert_eq!(part.mesh.check_invariants(), Ok(()), "{time}");
        }
        let left = leaves(&built) as f32 / leaves(&summer) as f32;
        let expected = [1.0, 1.0, 1.0, 1.0, 0.5, 0.0][TIMES.iter().position(|t| *t == time).unwrap()];
        assert!((left - expected).abs() < 0.08, "at {time} {left} of the leaves");
    }
}

#[test]
fn a_drawn_tree_has_seasons_too() {
    let sketch = leafy_tree(60);
    let species = Species::built_in("birch").unwrap();
    let [summer, autumn, winter] =
        [2.0, 4.0, 5.0].map(|time| pipeline::build(&sketch, &species, &params(&species, time)));
    assert!(leaves(&summer) >= 60 && leaves(&winter) == 0);
    assert_eq!(summer.plant.branches, winter.plant.branches);
    let coloured = |built: &Built| {
        let materials = built.plant.materials();
        let is = |name: &str| name.contains("-autumn");
        built
            .plant
            .organs
            .iter()
            .filter(|organ| is(&materials[built.plant.material(organ.role)].name))
            .count()
    };
    assert_eq!(coloured(&summer), 0);
    assert!(coloured(&autumn) > 30, "{} coloured leaves", coloured(&autumn));
}

#[test]
fn a_cherry_is_in_blossom_in_spring_only() {
    let flowers = |time| grown("cherry", time).plant.flowers.len();
    assert!(flowers(0.6) > 50);
    assert_eq!([0.0, 2.7, 5.0].map(flowers), [0; 3]);
}

#[test]
fn a_rose_takes_its_year_from_the_same_parameter_as_all_plants() {
    let rose = Species::built_in("rose").unwrap();
    let season = |sketch: &Sketch, assignments: &[String]| {
        pipeline::params_of(sketch, &rose, assignments).unwrap().season.time
    };
    // What drawings said when roses had one of their own.
    let mut sketch = leafy_tree(3);
    sketch.params.insert("rose".into(), serde_json::json!({ "season": 3.0 }));
    assert_eq!(season(&sketch, &[]), 3.0);
    sketch.params.insert("season".into(), serde_json::json!({ "time": 4.5 }));
    assert_eq!(season(&sketch, &[]), 4.5);
    assert_eq!(season(&sketch, &["season.time=0.5".into()]), 0.5);
    let hips = |time: f32| {
        let params = pipeline::params_of_species(&rose, &[format!("season.time={time}")]).unwrap();
        let built = pipeline::build(&Seed { number: 3, ..Seed::default() }, &rose, &params);
        built.plant.organs.iter().filter(|organ| organ.kind() == OrganKind::Fruit).count()
    };
    assert_eq!(hips(2.0), 0);
    assert!(hips(3.5) > 0);
}
