//! Petals that the artist shaped: all of a flower alike, nothing else, in sound meshes, and kept in the file.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use glam::{Vec2, Vec3};
use penstemon::pipeline::{self, Built};
use penstemon::plant::{Organ, PetalFrame, RestSurface, Shape};
use penstemon::sketch::petal_shapes::Offsets;
use penstemon::sketch::{self, PetalShape, Sketch, StrokeId, json};
use std::path::Path;

/// Drawings with flowers.
const FLOWERS: [&str; 5] = ["daisy", "balloon_flower", "hepatica_red", "mallow", "plumeria"];

fn drawing(name: &str) -> Sketch {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/sketches/{name}.penstemon"));
    sketch::read(&path).unwrap().0
}

fn built(sketch: &Sketch) -> Built {
    let species = pipeline::species_of(sketch, Path::new("")).unwrap();
    let params = pipeline::params_of(sketch, &species, &[]).unwrap();
    pipeline::build(sketch, &species, &params)
}

/// The strokes that drew the petals of a flower.
fn strokes(built: &Built, flower: usize) -> Vec<StrokeId> {
    let members = built.plant.organs.iter().filter(|organ| organ.flower == Some(flower));
    members.filter_map(|organ| built.provenance.stroke(organ.origin)).collect()
}

fn shaped(sketch: &Sketch, strokes: Vec<StrokeId>, offsets: Offsets) -> Sketch {
    Sketch { petal_shapes: [PetalShape::new(strokes, offsets)].into(), ..sketch.clone() }
}

/// Where a petal's axis is at a share of its length, on its rest surface.
fn on_axis(built: &Built, organ: &Organ, share: f32) -> Vec3 {
    let Shape::Blade(blade) = &organ.shape else { panic!("no petal") };
    let blade = built.plant.templates.resolve(blade);
    blade.at_rest(Vec2::new(0.0, share * blade.template.length()))
}

fn is_petal_of(built: &Built, organ: &Organ, flower: usize) -> bool {
    organ.flower == Some(flower) && built.provenance.stroke(organ.origin).is_some()
}

fn frame(built: &Built, organ: &Organ) -> PetalFrame {
    let Shape::Blade(blade) = &organ.shape else { panic!("no petal") };
    PetalFrame::of(&built.plant.templates.resolve(blade))
}

/// The tip rolled in.
fn curl() -> Offsets {
    let mut offsets = Offsets::default();
    offsets[2] = [Vec3::new(0.0, 0.1, 0.1); 4];
    offsets[3] = [Vec3::new(0.0, -0.3, 0.5); 4];
    offsets
}

#[test]
fn all_petals_of_the_flower_curl_and_nothing_else_moves() {
    for name in FLOWERS {
        let sketch = drawing(name);
        let before = built(&sketch);
        let after = built(&shaped(&sketch, strokes(&before, 0), curl()));
        assert_eq!(before.plant.organs.len(), after.plant.organs.len());
        let mut moved = 0;
        for (old, new) in before.plant.organs.iter().zip(&after.plant.organs) {
            if !is_petal_of(&before, old, 0) {
                // Its sepals stand where its petals leave room.
                assert!(old == new || old.flower == Some(0), "{name}: {old:?}");
                continue;
            }
            moved += 1;
            let frame = frame(&before, old);
            let tip = frame.offset(on_axis(&after, new, 1.0) - on_axis(&before, old, 1.0));
            assert!(tip.distance(Vec3::new(0.0, -0.3, 0.5)) < 1e-3, "{name}: {tip}");
            let base = frame.offset(on_axis(&after, new, 0.0) - on_axis(&before, old, 0.0));
            assert!(base.length() < 1e-3, "{name}: {base}");
        }
        assert_eq!(before.plant.branches, after.plant.branches);
        assert!(moved >= 5, "{name}: {moved}");
        for part in after.model.parts.iter() {
            part.mesh.check_invariants().unwrap();
        }
    }
}

#[test]
fn petals_that_are_not_moved_stay_where_they_were() {
    for (name, flower) in FLOWERS.into_iter().flat_map(|name| [(name, 0), (name, 1)]) {
        let sketch = drawing(name);
        let before = built(&sketch);
        let after = built(&shaped(&sketch, strokes(&before, flower), Offsets::default()));
        let mut shaped = 0;
        for (old, new) in before.model.parts.iter().zip(&after.model.parts) {
            shaped += usize::from(old.mesh != new.mesh);
            assert_eq!(old.mesh.points.len(), new.mesh.points.len());
            let off = old.mesh.points.iter().zip(&new.mesh.points).map(|(a, b)| a.distance(*b));
            assert!(off.fold(0.0, f32::max) < 1e-6, "{name} {flower}");
        }
        assert_eq!(shaped, 0, "{name} {flower}");
    }
}

#[test]
fn a_shape_stays_in_the_file_and_while_petals_come_and_go() {
    let sketch = drawing("balloon_flower");
    let own = strokes(&built(&sketch), 0);
    let shaped = shaped(&sketch, own.clone(), curl());
    let text = json::write(&shaped);
    assert!(text.contains("\"version\": 5") && text.contains("\"petal_shapes\": ["), "{text}");
    assert!(!json::write(&sketch).contains("petal_shapes"));
    let (again, warnings) = sketch::from_bytes(text.as_bytes(), "shaped").unwrap();
    assert_eq!((&again, warnings.len()), (&shaped, 0));
    // A petal is erased: the others stay as they were shaped.
    let mut fewer = again;
    fewer.strokes.retain(|stroke| stroke.id != own[0]);
    let is_shaped = |rest: &RestSurface| matches!(rest, RestSurface::Shaped { .. });
    let left = built(&fewer).plant.blades().filter(|blade| is_shaped(&blade.rest)).count();
    assert_eq!(left, own.len() - 1);
}
