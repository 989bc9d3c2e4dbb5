//! Gardens around plants: what stands in them, what is kept between builds, what is said of beds that cannot be.

use super::super::{Cache, build, build_with, params_of};
use super::*;
use crate::sketch::{GardenDrawing, GardenPoint, GardenStroke, GardenTool, Stroke, StrokePoint, Tool};
use glam::Vec2;

fn stroke(tool: GardenTool, from: [f32; 2], to: [f32; 2]) -> Arc<GardenStroke> {
    let points = [from, to].map(|at| GardenPoint { at: at.into(), pressure: 0.5 }).to_vec();
    Arc::new(GardenStroke { tool, radius: 0.3, density: 1.0, points })
}

fn plants(species: Option<&str>) -> GardenTool {
    GardenTool::Plants(species.map_or(GardenPlant::Drawn, GardenPlant::species))
}

/// A stem and a leaf, and a garden around them.
fn drawn(garden: Vec<Arc<GardenStroke>>) -> Sketch {
    let line = |id, tool, points: &[[f32; 2]]| {
        let points = points.iter().map(|at| StrokePoint::at(Vec2::from(*at))).collect();
        Arc::new(Stroke { id, tool, points, brush: None })
    };
    let stem = line(1, Tool::Branch, &[[500.0, 700.0], [505.0, 500.0], [495.0, 300.0]]);
    let leaf = [[505.0, 500.0], [560.0, 450.0], [640.0, 440.0], [580.0, 500.0], [505.0, 500.0]];
    let strokes = vec![stem, line(2, Tool::Leaf, &leaf)];
    Sketch { garden: garden.into(), strokes, ..Sketch::empty() }
}

fn params(sketch: &Sketch, species: &Species) -> Params {
    params_of(sketch, species, &[]).unwrap()
}

#[test]
fn beds_stand_around_the_drawn_plant_which_is_as_it_was() {
    let species = Species::built_in("balloon_flower").unwrap();
    let alone = drawn(Vec::new());
    let garden = vec![
        stroke(plants(None), [-1.0, 1.0], [1.0, 1.0]),
        stroke(plants(Some("daisy")), [-1.0, -1.0], [1.0, -1.0]),
    ];
    let sketch = drawn(garden);
    let params = params(&sketch, &species);
    let (built, bare) = (build(&sketch, &species, &params), build(&alone, &species, &params));
    assert_eq!(built.model, bare.model);
    let garden = built.garden.as_ref().unwrap();
    let names: Vec<&str> = garden.stock.kinds.iter().map(|kind| kind.name.as_str()).collect();
    assert_eq!(names, ["drawn", "daisy"]);
    assert!(
        garden.plants_of_each_kind().iter().all(|count| *count > 2),
        "{:?}",
        garden.plants_of_each_kind()
    );
    let all = super::super::seen(&built);
    assert_eq!(all.model.check_invariants(), Ok(()));
    assert_eq!(all.counts()[1], bare.model.triangle_count() + garden.triangle_count());
    assert!(bare.garden.is_none());
}

#[test]
fn another_drawing_and_a_species_of_an_age_stand_in_the_garden_as_they_stand_alone() {
    let species = Species::built_in("balloon_flower").unwrap();
    let other = Sketch { species: Some("daisy".into()), ..drawn(Vec::new()) };
    let shrub = GardenDrawing::new("shrub", other.clone()).unwrap();
    let aged = |age| GardenTool::Plants(GardenPlant::Species { name: "oak".into(), age });
    let garden = vec![
        stroke(GardenTool::Plants(GardenPlant::Drawing(shrub)), [-1.0, 1.0], [1.0, 1.0]),
        stroke(aged(Some(3.0)), [-4.0, -4.0], [-4.0, -4.0]),
        stroke(aged(None), [9.0, -9.0], [9.0, -9.0]),
    ];
    let mut sketch = drawn(garden);
    let garden_of = |sketch: &Sketch| build(sketch, &species, &params(sketch, &species)).garden.unwrap();
    let garden = garden_of(&sketch);
    let counts = garden.plants_of_each_kind();
    assert!(counts[0] > 2 && counts[1..] == [1, 1], "{counts:?}");
    let kinds = &garden.stock.kinds;
    assert_eq!(kinds[0].name, "shrub");
    let height = |kind: usize| kinds[kind].individuals[0].height();
    let daisy = Species::built_in("daisy").unwrap();
    let alone = build(&other, &daisy, &params(&other, &daisy));
    assert_eq!(height(0), alone.model.bounds().unwrap().1.y, "as its own species has it");
    assert!(height(1) < 0.7 * height(2), "three years are not many");
    // The time of the year is that of all.
    let summer = kinds[2].individuals[0].triangle_count();
    sketch.params.insert("season".into(), serde_json::json!({"time": 5.0}));
    let bare = garden_of(&sketch).stock.kinds[2].individuals[0].triangle_count();
    assert_ne!(bare, summer, "the oak is bare");
}

#[test]
fn individuals_are_kept_while_they_are_wanted() {
    let species = Species::built_in("balloon_flower").unwrap();
    let mut cache = Cache::default();
    let bed = stroke(plants(Some("daisy")), [-1.0, -1.0], [1.0, -1.0]);
    let mut stock_of = |garden: Vec<Arc<GardenStroke>>| {
        let sketch = drawn(garden);
        let built = build_with(&mut cache, &sketch, &species, &params(&sketch, &species), &|| false).unwrap();
        built.garden.map(|garden| garden.stock.kinds[0].individuals[0].surfaces[0].mesh.clone())
    };
    let first = stock_of(vec![bed.clone()]).unwrap();
    let path = stroke(GardenTool::Path, [0.0, -1.0], [0.0, 1.0]);
    let second = stock_of(vec![bed.clone(), path]).unwrap();
    assert!(Arc::ptr_eq(&first, &second), "the graphics card has it already");
    assert!(stock_of(Vec::new()).is_none());
    assert!(!Arc::ptr_eq(&first, &stock_of(vec![bed]).unwrap()), "it was forgotten with the garden");
}

#[test]
fn beds_of_nothing_are_remarked_on() {
    let hollow = GardenDrawing::new("hollow", Sketch { strokes: Vec::new(), ..drawn(Vec::new()) }).unwrap();
    let garden = vec![
        stroke(plants(None), [-1.0, 1.0], [1.0, 1.0]),
        stroke(plants(Some("no such plant")), [-1.0, 2.0], [1.0, 2.0]),
        stroke(GardenTool::Path, [-1.0, 3.0], [1.0, 3.0]),
        stroke(GardenTool::Plants(GardenPlant::Drawing(hollow)), [-1.0, 4.0], [1.0, 4.0]),
    ];
    let sketch = Sketch { strokes: Vec::new(), ..drawn(garden) };
    let species = Species::built_in("balloon_flower").unwrap();
    let built = build(&sketch, &species, &params(&sketch, &species));
    let remarks: Vec<&Remark> = built.remarks.iter().map(|warning| &warning.remark).collect();
    assert!(remarks.contains(&&Remark::NothingToPlant { drawing: None }), "{remarks:?}");
    let of_name = |remark: &&Remark| matches!(remark, Remark::NoSuchPlantInGarden { species, .. } if species == "no such plant");
    assert!(remarks.iter().any(of_name), "{remarks:?}");
    let other = Remark::NothingToPlant { drawing: Some("hollow".into()) };
    assert!(remarks.contains(&&other), "{remarks:?}");
    let garden = built.garden.unwrap();
    assert!(garden.places.is_empty() && garden.ground.is_some(), "the path is there");
}

#[test]
fn a_wide_garden_has_coarser_plants_and_keeps_within_its_triangles() {
    let meadow = GardenStroke {
        radius: 3.0,
        ..GardenStroke::clone(&stroke(plants(Some("daisy")), [-9.0, 5.0], [9.0, 5.0]))
    };
    let sketch = drawn(vec![Arc::new(meadow)]);
    let species = Species::built_in("balloon_flower").unwrap();
    let built = build(&sketch, &species, &params(&sketch, &species));
    let garden = built.garden.unwrap();
    assert!(garden.places.len() > 1000, "{}", garden.places.len());
    assert!(
        garden.places.iter().map(|place| triangles_of(&garden.stock, place)).sum::<usize>()
            <= GardenBudget::PAINTED_TRIANGLES
    );
    let coarsest = garden.stock.kinds[0].individuals[0].triangle_count();
    assert_eq!(coarsest, 8, "two crossing pictures");
}
