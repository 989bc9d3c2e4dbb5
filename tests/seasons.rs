//! Plants through the year, from drawing or seed to surfaces: leaves come and go, all else stays, nothing breaks.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use crate::drawings::leafy_tree;
use penstemon::pipeline::{self, Built, Seed, params_of_species};
use penstemon::plant::{Organ, OrganClass, OrganKind, OrganPart};
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
    // Nor does anything of its flower buds show.
    let is_left = |organ: &&Organ| organ.kind().class() == OrganClass::Flower;
    assert_eq!(grown("cherry", 2.7).plant.organs.iter().filter(is_left).count(), 0);
}

fn fruits(built: &Built) -> usize {
    built.plant.organs.iter().filter(|organ| organ.role.part == OrganPart::Fruit).count()
}

#[test]
fn grown_and_drawn_trees_bear_fruit_when_its_season_comes() {
    for name in ["apple", "oak", "spruce"] {
        let [spring, autumn] = [1.0, 3.4].map(|time| grown(name, time));
        assert_eq!(fruits(&spring), 0, "{name}");
        assert!(fruits(&autumn) > 4, "{name}: {} fruits", fruits(&autumn));
        let flat = autumn.model.flattened();
        let of_fruits = flat.parts.iter().filter(|part| part.name.contains("fruit"));
        assert!(of_fruits.map(|part| part.mesh.check_invariants().unwrap()).count() > 0, "{name}");
    }
    let (sketch, apple) = (leafy_tree(300), Species::built_in("apple").unwrap());
    let build = |more: &[String]| {
        let params = pipeline::params_of(&sketch, &apple, more).unwrap();
        pipeline::build(&sketch, &apple, &params)
    };
    let [usual, many, none] =
        ["1", "6", "0"].map(|share| build(&["season.time=3.4".into(), format!("season.fruits={share}")]));
    assert!(fruits(&usual) > 10 && fruits(&many) > 4 * fruits(&usual) && fruits(&none) == 0);
}

#[test]
fn fruits_leave_the_triangles_to_the_tree() {
    let build = |more: &[String]| {
        let species = Species::built_in("apple").unwrap();
        // On cards fruits are painted.
        let all = ["season.time=3.4", "season.fruits=8", "cards.below=0"].map(str::to_owned);
        let all = [&all, more].concat();
        let params = params_of_species(&species, &all).unwrap();
        pipeline::build(&Seed { number: 3, age: Some(9.0), ..Seed::default() }, &species, &params)
    };
    let whole = build(&[]);
    let within = |triangles: usize| build(&[format!("model.budget.triangles={triangles}")]);
    let small = within(6000);
    let count = |built: &Built, of_fruits: bool| {
        let flat = built.model.flattened();
        let parts = flat.parts.iter().filter(|part| !of_fruits || part.name.contains("fruit"));
        parts.map(|part| part.mesh.triangles.len()).sum::<usize>()
    };
    assert!((count(&small, false) as f32 / 6000.0 - 1.0).abs() < 0.035, "{}", count(&small, false));
    // Where there is nearly room for all, some fruits go and nothing else.
    let wanted = count(&whole, false) - count(&whole, true) / 3;
    let few_go = within(wanted);
    assert!((count(&few_go, false) as f32 / wanted as f32 - 1.0).abs() < 0.035, "{}", count(&few_go, false));
    assert_eq!(few_go.plant.branches, whole.plant.branches);
    assert_eq!(leaves(&few_go), leaves(&whole));
    assert!(count(&whole, true) > 6000, "{}", count(&whole, true));
    assert!((1..=1100).contains(&count(&small, true)), "{}", count(&small, true));
    // Each that stays has its stalk.
    let stalks = small.plant.organs.iter().filter(|organ| organ.role.part == OrganPart::FruitStalk).count();
    assert_eq!(stalks, fruits(&small));
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
