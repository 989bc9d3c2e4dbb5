//! What must hold for every drawing: no panic, sound plants and meshes, the drawing seen from the front, the same bytes
//! on any number of threads, the same plant at any scale.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

#[path = "common/drawings.rs"]
mod drawings;

use glam::{Vec2, Vec3};
use penstemon::export::{Scene, format_of};
use penstemon::geom::polyline;
use penstemon::pipeline::{self, Built};
use penstemon::plant::{OrganKind, Shape};
use penstemon::sketch::{self, Sketch, Stroke};
use penstemon::species;
use proptest::prelude::*;
use std::borrow::Cow;
use std::path::{Path, PathBuf};

fn build(sketch: &Sketch) -> Built {
    let species = pipeline::species_of(sketch, Path::new("")).unwrap();
    let params = pipeline::params_of(sketch, &species, &[]).unwrap();
    pipeline::build(sketch, &species, &params)
}

fn reference_sketches() -> Vec<(PathBuf, Sketch)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sketches");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut sketches: Vec<_> = files
        .filter(|path| path.extension().is_some_and(|e| e == "penstemon"))
        .map(|path| (path.clone(), sketch::read(&path).unwrap().0))
        .collect();
    sketches.sort_by(|a, b| a.0.cmp(&b.0));
    assert!(sketches.len() >= 12);
    sketches
}

fn glb(built: &Built) -> Vec<u8> {
    let textures = |name: &str| species::builtin_texture(name).map(Cow::Borrowed);
    let scene = Scene::new(&built.model, &built.plant, &textures, "plant".into()).unwrap();
    format_of(Path::new("plant.glb")).unwrap().encode(&scene).unwrap().bytes
}

fn with_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(work)
}

fn assert_sound(built: &Built) {
    assert_eq!(built.plant.check_invariants(), Ok(()));
    for part in &built.model.parts {
        assert_eq!(part.mesh.check_invariants(), Ok(()), "{}", part.name);
    }
}

/// Largest distance from a point to the stroke, canvas pixels.
fn farthest(points: impl Iterator<Item = Vec2>, stroke: &Stroke) -> f32 {
    let line: Vec<Vec2> = stroke.points.iter().map(|p| p.position).collect();
    points.map(|p| polyline::nearest(&line, p).unwrap().0).fold(0.0, f32::max)
}

#[test]
fn seen_from_the_front_plants_cover_their_drawings() {
    for (path, sketch) in reference_sketches() {
        let built = build(&sketch);
        let allowed = 0.005 * sketch.diagonal();
        let stroke_of = |id: Option<u64>| sketch.strokes.iter().find(|s| Some(s.id) == id);
        let front = |p: Vec3| built.plant.world_from_canvas.canvas(p);
        for (branch, flat) in built.plant.branches.iter().zip(&built.anatomy.branches) {
            let Some(stroke) = stroke_of(branch.stroke) else { continue };
            // What was added to reach a flower is no part of the drawing.
            let drawn = branch.points.iter().take(flat.line.len()).map(|&p| front(p));
            let off = farthest(drawn, stroke);
            assert!(off <= allowed, "{}: branch {} is {off} px off", path.display(), stroke.id);
        }
        for organ in built.plant.organs.iter().filter(|o| o.kind == OrganKind::Petal) {
            let (Some(stroke), Shape::Blade(blade)) = (stroke_of(organ.stroke), &organ.shape) else {
                continue;
            };
            let off = farthest(blade.outline.iter().map(|&uv| front(blade.at_rest(uv))), stroke);
            assert!(off <= allowed, "{}: petal {} is {off} px off", path.display(), stroke.id);
        }
    }
}

#[test]
fn reference_plants_are_sound_and_the_same_on_any_number_of_threads() {
    for (path, sketch) in reference_sketches() {
        let alone = with_threads(1, || build(&sketch));
        let together = with_threads(8, || build(&sketch));
        assert_sound(&alone);
        assert!(glb(&alone) == glb(&together), "{}: bytes differ between 1 and 8 threads", path.display());
    }
}

#[test]
fn scale_does_not_matter() {
    for (path, sketch) in reference_sketches() {
        let original = build(&sketch);
        for factor in [0.1, 10.0] {
            let scaled = build(&drawings::scaled(&sketch, factor));
            let name = path.display();
            assert_eq!(scaled.plant.branches.len(), original.plant.branches.len(), "{name} × {factor}");
            assert_eq!(scaled.plant.organs.len(), original.plant.organs.len(), "{name} × {factor}");
            // Rounding may keep or drop a point here and there.
            let (ours, theirs) = (scaled.model.triangle_count(), original.model.triangle_count());
            assert!(
                ours.abs_diff(theirs) * 200 <= theirs,
                "{name} × {factor}: {ours} and {theirs} triangles"
            );
            let ((lo, hi), (low, high)) = (scaled.model.bounds().unwrap(), original.model.bounds().unwrap());
            let off = lo.distance(low) + hi.distance(high);
            // A rose of two whorls fits no single cone well: rounding turns its pose by a few degrees.
            assert!(off < 0.03 * high.distance(low), "{name} × {factor}: bounds are {off} m off");
        }
    }
}

#[test]
fn several_plants_and_crossing_branches_are_built() {
    let meadow = build(&drawings::meadow(44));
    assert_sound(&meadow);
    assert_eq!(meadow.plant.flowers.len(), 4);
    assert_eq!(meadow.plant.branches.iter().filter(|b| b.parent.is_none() && b.stroke.is_some()).count(), 4);
}

#[test]
fn a_leaf_outline_gives_a_crown() {
    let tree = build(&drawings::leafy_tree(800));
    assert_sound(&tree);
    let leaves = tree.plant.organs.iter().filter(|o| o.kind == OrganKind::Leaf).count();
    assert!((500..=1600).contains(&leaves), "{leaves}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_scribble_is_built_soundly(seed: u64, strokes in 1usize..40) {
        let sketch = drawings::scribble(seed, strokes);
        assert_sound(&build(&sketch));
    }

    #[test]
    fn scribbles_are_the_same_on_any_number_of_threads(seed: u64) {
        let sketch = drawings::scribble(seed, 20);
        let (alone, together) = (with_threads(1, || build(&sketch)), with_threads(8, || build(&sketch)));
        prop_assert_eq!(alone.model, together.model);
    }

    #[test]
    fn synthetic_flowers_give_their_axis_back(
        petals in 5usize..=21,
        opening_deg in 20.0f32..75.0,
        elevation_deg in 25.0f32..80.0,
        heading in 0.0f32..6.28,
    ) {
        let flat = Vec2::from_angle(heading) * elevation_deg.to_radians().cos();
        let axis = flat.extend(elevation_deg.to_radians().sin());
        let drawn = drawings::cone_flower(Vec2::splat(400.0), axis, opening_deg.to_radians(), 200.0, petals);
        let sketch = drawings::sketch(drawn.into_iter().map(|p| (sketch::Tool::Petal, p)));
        let built = build(&sketch);
        prop_assert_eq!(built.plant.flowers.len(), 1);
        let off = built.plant.flowers[0].cone.axis.angle_between(axis).to_degrees();
        prop_assert!(off < 6.0, "axis is {off}° off");
    }
}
