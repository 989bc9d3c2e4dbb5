//! Plants of several makers in one drawing: each is what it is alone, and together they keep all that holds of one.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use glam::Vec2;
use penstemon::budget::Budget;
use penstemon::pipeline::{self, Built, Cache, Seed};
use penstemon::sketch::{self, Canvas, Maker, PlacedPlant, Remark, SeedOf, Sketch, Stroke, limits};
use penstemon::species::Species;
use std::collections::BTreeSet;
use std::path::Path;
use std::sync::Arc;

fn daisy() -> Sketch {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sketches/daisy.penstemon");
    sketch::read(&path).unwrap().0
}

fn grown(species: &str, age: f32, foot: [f32; 2], height: Option<f32>) -> PlacedPlant {
    let seed = SeedOf { species: species.to_owned(), seed: 1, age: Some(age) };
    PlacedPlant { maker: Maker::Growth(seed), foot: foot.into(), height }
}

fn with(plants: Vec<PlacedPlant>) -> Sketch {
    Sketch { plants, ..daisy() }
}

fn build_with(cache: &mut Cache, sketch: &Sketch) -> Built {
    let species = pipeline::species_of(sketch, Path::new("")).unwrap();
    let params = pipeline::params_of(sketch, &species, &[]).unwrap();
    pipeline::build_with(cache, sketch, &species, &params, &|| false).unwrap()
}

fn build(sketch: &Sketch) -> Built {
    build_with(&mut Cache::default(), sketch)
}

fn alone(species: &str, age: f32) -> Built {
    let species = Species::built_in(species).unwrap();
    let params = pipeline::params_of_species(&species, &[]).unwrap();
    pipeline::build(&Seed { number: 1, age: Some(age), ..Seed::default() }, &species, &params)
}

/// Everything that holds of a plant and its model.
fn assert_sound(built: &Built) {
    built.plant.check_invariants().unwrap();
    let parts = &built.model.parts;
    assert_eq!(built.model.materials, built.plant.materials());
    assert_eq!(parts.iter().map(|part| &part.name).collect::<BTreeSet<_>>().len(), parts.len());
    let materials: BTreeSet<&str> = built.model.materials.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(materials.len(), built.model.materials.len(), "materials of one name");
    for (i, part) in parts.iter().enumerate() {
        assert!(part.parent.is_none_or(|parent| parent < i && parts[parent].specimen == part.specimen));
        assert!(part.material_slots().all(|(material, _)| material < built.model.materials.len()));
        part.mesh.check_invariants().unwrap_or_else(|e| panic!("{}: {e}", part.name));
    }
    assert!(built.model.triangle_count() as u64 <= Budget::PLANT.triangles);
}

#[test]
fn all_plants_have_the_time_of_the_year_of_the_drawing() {
    let at = |season: Option<f32>| {
        let mut sketch = with(vec![grown("hazel", 6.0, [700.0, 900.0], Some(500.0))]);
        let time = season.map(|time| ("season".to_owned(), serde_json::json!({ "time": time })));
        sketch.params.extend(time);
        sketch
    };
    let organs = |built: &Built| built.beside[0].as_ref().unwrap().organs.len();
    let (summer, winter) = (build(&at(None)), build(&at(Some(4.9))));
    assert!(organs(&summer) > 50 && organs(&winter) < organs(&summer) / 4, "{}", organs(&winter));
    // What was kept of one time is not what is shown at another.
    let mut cache = Cache::default();
    for season in [Some(4.9), None, Some(3.0), Some(4.9)] {
        let fresh = build(&at(season));
        assert!(build_with(&mut cache, &at(season)).model == fresh.model, "{season:?}");
    }
}

#[test]
fn a_grown_plant_stands_behind_the_drawn_one_as_it_is_alone() {
    let (drawn, hazel) = (build(&daisy()), alone("hazel", 3.0));
    let both = build(&with(vec![grown("hazel", 3.0, [700.0, 900.0], Some(500.0))]));
    assert_sound(&both);
    // What was drawn is as it was.
    assert_eq!(both.model.parts[..drawn.model.parts.len()], drawn.model.parts[..]);
    assert_eq!(both.plant.branches[..drawn.plant.branches.len()], drawn.plant.branches[..]);
    assert_eq!(both.anatomy.flowers.len(), drawn.anatomy.flowers.len());
    // What grew is the plant that grows alone, at another place and size.
    let branches = &both.plant.branches[drawn.plant.branches.len()..];
    assert_eq!(branches.len(), hazel.plant.branches.len());
    assert_eq!(both.plant.organs.len(), drawn.plant.organs.len() + hazel.plant.organs.len());
    let parts = &both.model.parts[drawn.model.parts.len()..];
    let names: Vec<String> = hazel.model.parts.iter().map(|part| format!("hazel_{}", part.name)).collect();
    assert_eq!(parts.iter().map(|part| part.name.to_string()).collect::<Vec<_>>(), names);
    let drawn_specimens = drawn.model.parts.iter().map(|part| part.specimen).max().unwrap();
    assert!(parts.iter().all(|part| part.specimen > drawn_specimens));
    // It is known which branches and organs are its own.
    let placed = both.beside[0].as_ref().unwrap();
    assert_eq!(placed.branches, drawn.plant.branches.len()..both.plant.branches.len());
    assert_eq!(placed.organs, drawn.plant.organs.len()..both.plant.organs.len());
    // It stands where the sketch says, as high as it says.
    let world = both.provenance.world_from_canvas;
    let foot = world.point(Vec2::new(700.0, 900.0));
    assert!(branches[0].points[0].distance(foot) < 0.02 * world.scale * 500.0);
    let top = branches.iter().flat_map(|b| &b.points).map(|p| p.y).fold(f32::MIN, f32::max);
    let height = (top - foot.y) / world.scale;
    assert_eq!(placed.foot, foot);
    assert!((placed.height / world.scale - 500.0).abs() < 0.5, "{placed:?}");
    assert!((400.0..=501.0).contains(&height), "{height} pixels");
}

#[test]
fn plants_of_every_maker_keep_what_holds_of_one() {
    let plants = vec![
        grown("birch", 5.0, [100.0, 880.0], Some(700.0)),
        grown("birch", 5.0, [200.0, 880.0], Some(40.0)),
        grown("cherry", 6.0, [-3000.0, 1200.0], Some(900.0)),
        grown("spruce", 4.0, [900.0, 880.0], None),
        grown("hazel", 0.0, [400.0, 880.0], Some(90.0)),
    ];
    let built = build(&with(plants));
    assert_sound(&built);
    let names = |prefix: &str| built.model.parts.iter().filter(|part| part.name.starts_with(prefix)).count();
    let remarks: Vec<String> = built.remarks.iter().map(ToString::to_string).collect();
    assert!(names("birch_2_") > 0 && names("cherry_") > 0 && names("spruce_") > 0, "{remarks:?}");
    assert_eq!(built.remarks, build(&daisy()).remarks);
    assert!(built.model.parts.iter().any(|part| part.name.starts_with("cherry") && part.copies.is_some()));
}

#[test]
fn what_cannot_stand_there_is_left_out_and_said() {
    let wrong = vec![
        grown("oka", 3.0, [0.0; 2], Some(100.0)),
        grown("mallow", 3.0, [0.0; 2], Some(100.0)),
        grown("hazel", 3.0, [limits::MAX_COORDINATE, 0.0], Some(100.0)),
        grown("hazel", 3.0, [0.0; 2], Some(limits::MAX_CANVAS_SIDE)),
        grown("hazel", 3.0, [0.0; 2], Some(limits::MIN_PLANT_HEIGHT)),
        grown("hazel", 2.0, [0.0, 880.0], Some(100.0)),
    ];
    let (built, drawn) = (build(&with(wrong)), build(&daisy()));
    assert_sound(&built);
    let remarks: Vec<String> = built.remarks[drawn.remarks.len()..].iter().map(ToString::to_string).collect();
    assert_eq!(remarks.len(), 5, "{remarks:?}");
    for (k, word) in ["oak", "oak", "away", "large", "small"].into_iter().enumerate() {
        let begin = format!("plant {} (`", k + 1);
        assert!(remarks[k].starts_with(&begin) && remarks[k].contains(word), "{}", remarks[k]);
    }
    assert!(remarks[0].contains("`oka`"));
    assert!(built.remarks[drawn.remarks.len()..].iter().all(|warning| warning.remark.is_shortfall()));
    assert!(matches!(built.remarks[drawn.remarks.len()].remark, Remark::OfPlant { place: 1, .. }));
    assert!(built.model.parts.iter().any(|part| part.name == "hazel_wood"));
    let stand: Vec<bool> = built.beside.iter().map(Option::is_some).collect();
    assert_eq!(stand, [false, false, false, false, false, true]);
}

#[test]
fn a_sheet_without_strokes_has_its_plants_all_the_same() {
    let canvas = Canvas { width: 800.0, height: 600.0 };
    let plants = vec![grown("birch", 8.0, [400.0, 600.0], Some(600.0))];
    let built = build(&Sketch { canvas, plants, ..Sketch::empty() });
    assert_sound(&built);
    let (low, high) = built.model.bounds().unwrap();
    let height = pipeline::Params::default().depth.world.height;
    assert!(low.y > -0.2 * height && (0.8..1.5).contains(&(high.y / height)), "{low} to {high}");
}

#[test]
fn a_stroke_leaves_the_other_plants_the_very_same() {
    let mut cache = Cache::default();
    let mut sketch = with(vec![grown("birch", 6.0, [700.0, 900.0], Some(500.0))]);
    let before = build_with(&mut cache, &sketch);
    // A petal moves inside of the drawing, so that its scale stays.
    let petal = sketch.strokes.iter().position(|stroke| stroke.points.len() > 20).unwrap();
    let mut moved = Stroke::clone(&sketch.strokes[petal]);
    moved.points.iter_mut().for_each(|point| point.pressure *= 0.5);
    sketch.strokes[petal] = Arc::new(moved);
    let after = build_with(&mut cache, &sketch);
    let birch = |built: &Built| -> Vec<_> {
        let parts = built.model.parts.iter().filter(|part| part.name.starts_with("birch"));
        parts.map(|part| part.mesh.clone()).collect()
    };
    let (before_birch, after_birch) = (birch(&before), birch(&after));
    assert!(!before_birch.is_empty());
    assert_eq!(before_birch.len(), after_birch.len());
    assert!(before_birch.iter().zip(&after_birch).all(|(a, b)| Arc::ptr_eq(a, b)));
    assert!(before.model != after.model, "the stroke itself shows");
}
