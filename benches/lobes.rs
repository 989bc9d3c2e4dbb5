//! Lobes: strokes to surfaces, remeshing by size, drags. `cargo bench --bench lobes`.
//!
//! Throughput counts triangles, of drags vertices that move.

#![allow(clippy::unwrap_used, reason = "a bench that cannot go on has failed")]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec3;
use penstemon::lobes::drag::{Drag, Method};
use penstemon::lobes::remesh::remesh;
use penstemon::lobes::{Crown, Lobe, Remesh, SpaceStroke, lofted, shape, text, undeformed};
use std::f32::consts::TAU;
use std::hint::black_box;
use std::path::Path;

/// The program's own.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn example(name: &str) -> Crown {
    text::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/lobes/{name}.json"))).unwrap()
}

/// Loops of a ball.
fn ball(loops: usize) -> Lobe {
    let ring = |k: usize| {
        let (up, wide) = (TAU * 0.5 * (k as f32 + 1.0) / (loops + 1) as f32).sin_cos();
        let at = |i: usize| {
            let (sin, cos) = (i as f32 / 96.0 * TAU).sin_cos();
            Vec3::new(up * cos, 2.0 + wide, up * sin)
        };
        SpaceStroke { closed: Some(true), points: (0..96).map(at).collect() }
    };
    Lobe { name: "ball".to_owned(), strokes: (0..loops).map(ring).collect(), ..Lobe::default() }
}

fn strokes(c: &mut Criterion) {
    let mut group = c.benchmark_group("strips and caps");
    for loops in [2, 5, 10, 20, 40] {
        let lobe = ball(loops);
        group.throughput(Throughput::Elements(loops as u64));
        group.bench_with_input(BenchmarkId::from_parameter(loops), &lobe, |b, lobe| {
            b.iter(|| lofted(black_box(lobe)).unwrap())
        });
    }
    group.finish();
}

fn remeshing(c: &mut Criterion) {
    let lobe = ball(9);
    let raw = lofted(&lobe).unwrap();
    let mut group = c.benchmark_group("remesh");
    group.sample_size(10);
    for fineness in [20.0, 40.0, 48.0, 80.0] {
        let params = Remesh { fineness, ..Remesh::default() };
        let triangles = remesh(&raw, &params).unwrap().triangles.len();
        group.throughput(Throughput::Elements(triangles as u64));
        group.bench_function(BenchmarkId::from_parameter(triangles), |b| {
            b.iter(|| remesh(black_box(&raw), &params).unwrap())
        });
    }
    group.finish();
}

fn lobes(c: &mut Criterion) {
    let mut group = c.benchmark_group("from strokes to surfaces");
    group.sample_size(10);
    for name in ["round", "bonsai", "swan", "goblet"] {
        let crown = example(name);
        group.bench_function(name, |b| {
            b.iter(|| {
                crown.lobes.iter().map(|lobe| shape(lobe, &Remesh::default()).unwrap()).collect::<Vec<_>>()
            })
        });
    }
    group.finish();
}

fn drags(c: &mut Criterion) {
    let params = Remesh { fineness: 69.0, ..Remesh::default() };
    let surface = undeformed(&ball(9), &params, &mut Vec::new()).unwrap();
    let heights = surface.points.iter().enumerate();
    let top = heights.max_by(|a, b| a.1.y.total_cmp(&b.1.y)).unwrap().0 as u32;
    let to = surface.points[top as usize] + Vec3::Y * 0.3;
    let mut group = c.benchmark_group("drag");
    group.sample_size(20);
    for radius in [0.4, 1.0, 100.0] {
        let drag = Drag::begin(&surface, top, radius, Method::Rigid).unwrap();
        group.throughput(Throughput::Elements(drag.moving() as u64));
        group.bench_function(BenchmarkId::new("begin", drag.moving()), |b| {
            b.iter(|| Drag::begin(black_box(&surface), top, radius, Method::Rigid).unwrap())
        });
        group.bench_function(BenchmarkId::new("frame", drag.moving()), |b| b.iter(|| drag.to(black_box(to))));
    }
    group.finish();
}

criterion_group!(benches, strokes, remeshing, lobes, drags);
criterion_main!(benches);
