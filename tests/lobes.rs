//! Lobes from their strokes to plants that fill them: sound surfaces, starts without twists, silhouettes, what is bad input.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use glam::{Quat, Vec2, Vec3};
use penstemon::geom::region::Region;
use penstemon::growth::{Envelope, Lobes, lead_into};
use penstemon::lobes::pairing::{Start, start_pair};
use penstemon::lobes::{
    Crown, Fault, Lobe, Pose, Remark, Remesh, Shaped, SpaceStroke, shape, shape_all, text,
};
use penstemon::model::{Mesh, crossing};
use penstemon::pipeline::{self, Built, Cache, Seed};
use penstemon::plant::{OrganKind, Plant, Shape};
use penstemon::species::Species;
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::f32::consts::TAU;
use std::path::Path;
use std::sync::Arc;

/// Cells along one side of the raster on which silhouettes are compared.
const CELLS: usize = 120;
const EXAMPLES: [&str; 4] = ["round", "bonsai", "swan", "goblet"];

fn example(name: &str) -> Crown {
    text::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/lobes/{name}.json"))).unwrap()
}

fn closed(points: Vec<Vec3>) -> SpaceStroke {
    SpaceStroke { closed: Some(true), points }
}

fn open(points: Vec<Vec3>) -> SpaceStroke {
    SpaceStroke { closed: Some(false), points }
}

fn lobe(strokes: Vec<SpaceStroke>) -> Lobe {
    Lobe { name: "lobe".to_owned(), strokes, ..Lobe::default() }
}

fn ring(height: f32, radius: f32, count: usize) -> SpaceStroke {
    let at = |k: usize| {
        let (sin, cos) = (k as f32 / count as f32 * TAU).sin_cos();
        Vec3::new(radius * cos, height, radius * sin)
    };
    closed((0..count).map(at).collect())
}

/// What every lobe promises.
fn check(shaped: &Shaped) {
    shaped.surface.check_invariants().unwrap();
    assert!(shaped.surface.signed_volume() > 0.0);
    let mesh = Mesh::smooth(shaped.surface.points.clone(), &shaped.surface.triangles);
    mesh.check_invariants().unwrap();
    assert_eq!(crossing::crossing_faces(&mesh), Some(0), "{}", shaped.name);
}

#[test]
fn the_examples_are_sound_and_written_as_they_are_read() {
    for name in EXAMPLES {
        let crown = example(name);
        let shaped = shape_all(&crown, &Remesh::default()).unwrap();
        shaped.iter().for_each(check);
        assert!(shaped.iter().all(|lobe| lobe.remarks.is_empty()), "{name}");
        assert_eq!(text::from_json(&text::to_json(&crown), "again").unwrap(), crown);
    }
}

#[test]
fn surfaces_are_the_same_on_any_number_of_threads() {
    let crown = example("bonsai");
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| shape_all(&crown, &Remesh::default()).unwrap())
    };
    assert!(on(1) == on(2), "other surfaces on two threads");
}

/// A loop as a hand draws it: begun anywhere, in either sense, tilted, with a tremble.
fn drawn(random: &mut Pcg64Mcg, height: f32) -> Vec<Vec3> {
    let mut unit = |low: f32, high: f32| random.random_range(low..high);
    let (count, phase) = (unit(40.0, 96.0) as usize, unit(0.0, TAU));
    let [wide, deep] = [unit(0.4, 1.6), unit(0.4, 1.6)];
    let (lobes, lobed) = (unit(2.0, 5.0).floor(), unit(0.0, 0.15));
    let tilt = Quat::from_rotation_x(unit(-0.5, 0.5)) * Quat::from_rotation_z(unit(-0.5, 0.5));
    let (sense, turned) = (if unit(0.0, 1.0) < 0.5 { 1.0 } else { -1.0 }, unit(0.0, TAU));
    let shift = Vec3::new(unit(-0.4, 0.4), height, unit(-0.4, 0.4));
    let mut points: Vec<Vec3> = Vec::new();
    for k in 0..count {
        let a = phase + sense * k as f32 / count as f32 * TAU;
        let r = 1.0 + lobed * (lobes * (a - turned)).sin() + unit(-0.01, 0.01);
        points.push(tilt * Vec3::new(wide * r * a.cos(), unit(-0.01, 0.01), deep * r * a.sin()) + shift);
    }
    points
}

/// The loop with so many samples, evenly by length.
fn even(points: &[Vec3], count: usize) -> Vec<Vec3> {
    let around: Vec<Vec3> = points.iter().chain([&points[0]]).copied().collect();
    let arcs = penstemon::geom::polyline::arc_lengths(around.iter().copied());
    let at =
        |k: usize| penstemon::geom::polyline::locate(&arcs, arcs[arcs.len() - 1] * k as f32 / count as f32);
    (0..count).map(|k| penstemon::geom::polyline::interpolate(&around, at(k))).collect()
}

/// The single pair of most similar directions to the centroids, in the sense in which loops were drawn (001 eq. 5.1).
fn by_one_pair(a: &[Vec3], b: &[Vec3]) -> Start {
    let unit = |points: &[Vec3]| -> Vec<Vec3> {
        let middle = points.iter().copied().sum::<Vec3>() / points.len() as f32;
        points.iter().map(|p| (middle - p).normalize()).collect()
    };
    let (a, b) = (unit(a), unit(b));
    let pairs = (0..a.len()).flat_map(|i| (0..b.len()).map(move |j| (i, j)));
    let (i, j) = pairs.max_by(|x, y| a[x.0].dot(b[x.1]).total_cmp(&a[y.0].dot(b[y.1]))).unwrap();
    Start { reversed: false, shift: (j + b.len() - i) % b.len() }
}

/// Whether a strip from this start turns by more than 45° between its loops, or joins them in opposite senses.
fn is_twisted(a: &[Vec3], b: &[Vec3], start: Start) -> bool {
    let b: Vec<Vec3> = if start.reversed { b.iter().rev().copied().collect() } else { b.to_vec() };
    let flat = |points: &[Vec3]| -> Vec<Vec2> {
        let middle = points.iter().copied().sum::<Vec3>() / points.len() as f32;
        points.iter().map(|p| Vec2::new(p.x - middle.x, p.z - middle.z)).collect()
    };
    let (a, b) = (flat(a), flat(&b));
    let pairs = (0..a.len()).map(|i| (a[i], b[(i + start.shift) % b.len()]));
    let sum: Vec2 = pairs.map(|(p, q)| Vec2::new(p.dot(q), p.perp_dot(q)).normalize_or_zero()).sum();
    // Where senses are opposite, turns of all sizes cancel out.
    let mean = sum / a.len() as f32;
    mean.length() < 0.5 || mean.to_angle().abs() > 45_f32.to_radians()
}

#[test]
fn hardly_a_start_is_twisted() {
    let mut random = Pcg64Mcg::seed_from_u64(7);
    let (mut ours, mut theirs) = (0, 0);
    for _ in 0..1000 {
        let (a, b) = (even(&drawn(&mut random, 0.0), 64), even(&drawn(&mut random, 1.0), 64));
        ours += u32::from(is_twisted(&a, &b, start_pair(&a, &b)));
        theirs += u32::from(is_twisted(&a, &b, by_one_pair(&a, &b)));
    }
    assert!(ours <= 10, "{ours} of 1000 strips are twisted");
    assert!(theirs > 20 * ours.max(1), "{theirs} by one pair");
}

fn leaf_shape(plant: &Plant, seen: fn(Vec3) -> Vec2) -> Vec<Region> {
    let leaves = plant.organs.iter().filter_map(|organ| match &organ.shape {
        Shape::Blade(blade) => Some(plant.templates.resolve(blade)),
        _ => None,
    });
    leaves
        .map(|blade| {
            Region::new(blade.template.outline().iter().map(|uv| seen(blade.at_rest(*uv))).collect())
        })
        .collect()
}

/// How a plant's leaves and its lobes agree in a view: intersection over union, and the largest part in one piece that has no
/// leaf, as a share of all.
fn agreement(plant: &Plant, shaped: &[Shaped], lobes: &Lobes, seen: fn(Vec3) -> Vec2) -> (f32, f32) {
    let (low, high) = lobes.bounds();
    let (low, high) = (seen(low).min(seen(high)), seen(low).max(seen(high)));
    let cell = (high - low).max_element() * 1.15 / CELLS as f32;
    let low = low.midpoint(high) - 0.5 * cell * CELLS as f32;
    let raster = |regions: &[Region]| {
        let mut covered = vec![false; CELLS * CELLS];
        let place = |p: Vec2| ((p - low) / cell).clamp(Vec2::ZERO, Vec2::splat(CELLS as f32 - 1.0));
        for region in regions {
            let (a, b) = region.bounds().unwrap_or_default();
            for y in place(a).y as usize..=place(b).y as usize {
                for x in place(a).x as usize..=place(b).x as usize {
                    covered[y * CELLS + x] |=
                        region.contains(low + (Vec2::new(x as f32, y as f32) + 0.5) * cell);
                }
            }
        }
        covered
    };
    let faces = shaped.iter().filter(|lobe| !lobe.negative).flat_map(|lobe| {
        lobe.surface.triangles.iter().map(|t| Region::new(lobe.surface.corners(*t).map(seen).to_vec()))
    });
    let (wanted, covered) = (raster(&faces.collect::<Vec<_>>()), raster(&leaf_shape(plant, seen)));
    let both = wanted.iter().zip(&covered).filter(|(w, c)| **w && **c).count();
    let either = wanted.iter().zip(&covered).filter(|(w, c)| **w || **c).count();
    let mut missing: Vec<bool> = wanted.iter().zip(&covered).map(|(w, c)| *w && !*c).collect();
    let mut largest = 0;
    for first in 0..missing.len() {
        let (mut open, mut size) = (vec![first], 0);
        while let Some(k) = open.pop() {
            if std::mem::take(&mut missing[k]) {
                size += 1;
                let (x, y) = (k % CELLS, k / CELLS);
                open.extend(
                    [
                        (x > 0, k.wrapping_sub(1)),
                        (x + 1 < CELLS, k + 1),
                        (y > 0, k.wrapping_sub(CELLS)),
                        (y + 1 < CELLS, k + CELLS),
                    ]
                    .iter()
                    .filter(|near| near.0)
                    .map(|near| near.1),
                );
            }
        }
        largest = largest.max(size);
    }
    let area = wanted.iter().filter(|w| **w).count();
    (both as f32 / either as f32, largest as f32 / area as f32)
}

fn grown(crown: &Crown, species: &str) -> (Built, Cache, Vec<Shaped>, Arc<Lobes>) {
    let shaped = shape_all(crown, &Remesh::default()).unwrap();
    let lobes = Arc::new(Lobes::new(&shaped).unwrap());
    let wood = lead_into(&crown.trunks, &lobes);
    let species = Species::built_in(species).unwrap();
    let params = pipeline::params_of_species(&species, &[]).unwrap();
    let seed =
        Seed { number: 3, volume: Some(Arc::new(Envelope::Lobes(lobes.clone()))), wood, ..Seed::default() };
    let mut cache = Cache::default();
    let built = pipeline::build_with(&mut cache, &seed, &species, &params, &|| false).unwrap();
    (built, cache, shaped, lobes)
}

#[test]
fn plants_fill_their_lobes_and_nothing_else() {
    // Least intersection over union from the front, the side and above; most of a silhouette that is missing in one piece.
    let bounds = [
        ("swan", [0.78, 0.82, 0.86], 0.06),
        ("bonsai", [0.85, 0.88, 0.88], 0.04),
        ("round", [0.92, 0.92, 0.92], 0.02),
    ];
    for (name, least, most) in bounds {
        let (built, cache, shaped, lobes) = grown(&example(name), "box");
        let simulation = cache.seed.simulation().unwrap();
        simulation.check_envelope().unwrap();
        let nodes = &simulation.tree().nodes;
        let outside =
            (0..simulation.tree().len()).filter(|k| nodes.born[*k] > 0 && !lobes.contains(nodes.at[*k]));
        assert_eq!(outside.count(), 0, "{name}: nodes outside of every lobe");
        let leaves: Vec<_> = built.plant.organs.iter().filter(|o| o.kind() == OrganKind::Leaf).collect();
        let near = 0.25 * simulation.habit().internode + 0.01;
        let around = [Vec3::ZERO, Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
        let inside = |p: Vec3| around.iter().any(|d| lobes.contains(p + d * near));
        let out = leaves.iter().filter(|leaf| !inside(leaf.base())).count();
        assert!(out * 100 <= leaves.len(), "{name}: {out} of {} leaves", leaves.len());
        let views: [fn(Vec3) -> Vec2; 3] =
            [|p| Vec2::new(p.x, p.y), |p| Vec2::new(p.z, p.y), |p| Vec2::new(p.x, p.z)];
        for (seen, least) in views.into_iter().zip(least) {
            let (share, missing) = agreement(&built.plant, &shaped, &lobes, seen);
            assert!(share >= least, "{name}: intersection over union {share}");
            assert!(missing <= most, "{name}: {missing} of the silhouette is missing in one piece");
        }
    }
}

#[test]
fn what_is_taken_away_stays_empty() {
    let (built, _, _, lobes) = grown(&example("goblet"), "box");
    let middle = Vec3::Y * 1.9;
    assert!(!lobes.contains(middle));
    let inside = built.plant.organs.iter().filter(|leaf| leaf.base().distance(middle) < 0.4).count();
    assert!(built.plant.organs.len() > 500 && inside == 0, "{inside} of {} leaves", built.plant.organs.len());
}

#[test]
fn bad_strokes_end_in_a_lobe_or_in_a_reason() {
    let params = Remesh::default();
    let remarks = |lobe: &Lobe| {
        let shaped = shape(lobe, &params).unwrap();
        check(&shaped);
        shaped.remarks
    };
    let refused = |lobe: &Lobe| shape(lobe, &params).unwrap_err();
    let line = |y: f32| open((0..20).map(|k| Vec3::new(k as f32 * 0.1, y, 0.3 * y)).collect());
    assert_eq!(refused(&lobe(vec![])), Fault::NoStrokes);
    assert_eq!(refused(&lobe(vec![line(1.0)])), Fault::OneOpenStroke, "one stroke");
    assert_eq!(remarks(&lobe(vec![line(1.0), line(1.5), line(2.0)])), [], "all open: a sheet");
    let same = lobe(vec![ring(1.0, 1.0, 40), ring(1.0, 1.0, 40)]);
    assert_eq!(remarks(&same), [Remark::Untangled], "two rings in one place");
    let turned = |stroke: SpaceStroke| {
        let turn = |p: &Vec3| Vec3::Y * 1.5 + Quat::from_rotation_x(1.3) * (*p - Vec3::Y * 1.5);
        closed(stroke.points.iter().map(turn).collect())
    };
    let through = lobe(vec![ring(1.0, 1.0, 40), turned(ring(1.5, 1.0, 40))]);
    assert!(remarks(&through).iter().all(|remark| *remark == Remark::Untangled), "a ring through another");
    assert_eq!(remarks(&lobe(vec![ring(1.0, 1.0, 3), ring(2.0, 1.0, 40)])), [], "a ring of three samples");
    let eight = |y: f32| {
        let at = |k: usize| {
            let t = k as f32 / 80.0 * TAU;
            Vec3::new((2.0 * t).sin() * 0.5, y, t.cos() * if t.cos() > 0.0 { 2.0 } else { 1.0 })
        };
        closed((0..80).map(at).collect())
    };
    assert_eq!(remarks(&lobe(vec![eight(1.0), ring(2.0, 0.5, 40)])), [Remark::Cut { stroke: 1 }]);
    let spot = open(vec![Vec3::ONE; 9]);
    assert_eq!(
        remarks(&lobe(vec![spot, ring(1.0, 1.0, 30), ring(2.0, 1.0, 30)])),
        [Remark::NoLength { stroke: 1 }]
    );
    let mut backward = ring(2.0, 1.0, 30);
    backward.points.reverse();
    assert_eq!(remarks(&lobe(vec![ring(1.0, 1.0, 30), backward])), [], "loops of opposite sense");
    assert_eq!(refused(&lobe(vec![line(1.0); 500])), Fault::TooManyStrokes { count: 500, most: 256 });
    let flat = lobe(vec![closed(vec![Vec3::Y, Vec3::new(1.0, 1.0, 0.0), Vec3::new(2.0, 1.0, 0.0)])]);
    assert!(matches!(refused(&flat), Fault::Flat | Fault::NoStrokes), "a flat lobe");
    let caps = vec![ring(1.0, 1.0, 30), ring(2.0, 1.0, 30), line(3.0), line(0.5), line(3.5)];
    assert_eq!(remarks(&lobe(caps)), [Remark::LeftOut { stroke: 5 }]);
    let sunk = lobe(vec![ring(-0.6, 1.0, 30), ring(1.0, 1.0, 30)]);
    assert_eq!(remarks(&sunk), [Remark::Clipped], "partly below the ground");
    let low = shape(&sunk, &params).unwrap().surface.bounds().0.y;
    assert!(low > -0.05, "{low}");
    let pose = Pose { shift: Vec3::NEG_Y * 9.0, ..Pose::default() };
    assert_eq!(refused(&Lobe { pose, ..lobe(vec![ring(1.0, 1.0, 30)]) }), Fault::Buried);
    let nan = lobe(vec![closed(vec![Vec3::NAN, Vec3::X, Vec3::Y]), ring(1.0, 1.0, 9)]);
    assert!(shape(&nan, &params).is_ok_and(|shaped| shaped.remarks == [Remark::NoLength { stroke: 1 }]));
}

#[test]
fn offsets_of_vertices_that_are_gone_are_remarked() {
    let mut deformed = lobe(vec![ring(1.0, 1.0, 40), ring(2.0, 1.0, 40)]);
    let plain = shape(&deformed, &Remesh::default()).unwrap();
    let offset = |vertex: u32| penstemon::lobes::Offset { vertex, by: Vec3::Z * 0.1 };
    deformed.deform = vec![offset(5), offset(1_000_000)];
    let shaped = shape(&deformed, &Remesh::default()).unwrap();
    check(&shaped);
    assert_eq!(shaped.remarks, [Remark::LostOffsets { count: 1 }]);
    let moved =
        plain.surface.points.iter().zip(&shaped.surface.points).filter(|(a, b)| a.distance(**b) > 0.05);
    assert_eq!(moved.count(), 1);
}

#[test]
fn lobes_apart_without_a_trunk_are_all_grown_into() {
    let at = |x: f32| Lobe {
        name: format!("at {x}"),
        ..lobe(vec![closed(
            ring(0.0, 0.5, 40).points.iter().map(|p| Vec3::new(p.x + x, 2.0 + p.z, 0.1 * x)).collect(),
        )])
    };
    let crown = Crown { lobes: vec![at(-1.5), at(0.0), at(2.0)], trunks: Vec::new() };
    let (built, _, shaped, _) = grown(&crown, "box");
    for lobe in &shaped {
        let (low, high) = lobe.surface.bounds();
        let inside = |p: Vec3| p.cmpge(low).all() && p.cmple(high).all();
        let leaves = built.plant.organs.iter().filter(|leaf| inside(leaf.base())).count();
        assert!(leaves > 100, "{}: {leaves} leaves", lobe.name);
    }
}

fn strokes() -> impl Strategy<Value = Vec<SpaceStroke>> {
    let loops = prop::collection::vec(
        (3..60_usize, 0.2..1.5_f32, -0.5..0.5_f32, -0.5..0.5_f32, 0.0..TAU, any::<bool>()),
        1..6,
    );
    (loops, any::<bool>()).prop_map(|(loops, capped)| {
        let mut strokes: Vec<SpaceStroke> = Vec::new();
        for (k, (count, radius, tilt, shift, phase, reversed)) in loops.iter().enumerate() {
            let at = |i: usize| {
                let angle = phase + if *reversed { -1.0 } else { 1.0 } * i as f32 / *count as f32 * TAU;
                Vec3::new(
                    radius * angle.cos() + shift,
                    2.0 + k as f32 + tilt * angle.cos(),
                    radius * angle.sin(),
                )
            };
            strokes.push(closed((0..*count).map(at).collect()));
        }
        if capped {
            let top = 2.6 + loops.len() as f32;
            strokes.push(open((0..9).map(|i| Vec3::new(i as f32 * 0.1 - 0.4, top, 0.0)).collect()));
        }
        strokes
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 10, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_stack_of_loops_is_a_sound_surface(strokes in strokes()) {
        let shaped = shape(&lobe(strokes), &Remesh { fineness: 16.0, ..Remesh::default() }).unwrap();
        check(&shaped);
    }

    #[test]
    fn any_strokes_end_in_a_sound_surface_or_a_reason(
        strokes in prop::collection::vec((any::<Option<bool>>(), prop::collection::vec((-2.0..2.0_f32, 1.0..5.0_f32, -2.0..2.0_f32), 0..12)), 0..5)
    ) {
        let strokes = strokes.into_iter().map(|(closed, points)| SpaceStroke { closed, points: points.into_iter().map(Vec3::from).collect() });
        if let Ok(shaped) = shape(&lobe(strokes.collect()), &Remesh { fineness: 16.0, ..Remesh::default() }) {
            check(&shaped);
        }
    }
}
