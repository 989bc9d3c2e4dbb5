//! Understanding a drawing, alone: the daisy on one thread, growing meadows, crowds of drawings by people, and drawings that are meant to be hard.
//! `cargo bench --bench anatomy`.

#![allow(clippy::unwrap_used, reason = "a bench that cannot go on has failed")]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec2;
use penstemon::anatomy::conventions::{self, ConventionParams};
use penstemon::anatomy::{AnatomyParams, analyse};
use penstemon::sketch::{self, Sketch, Stroke, Tool};
use std::hint::black_box;
use std::path::Path;
use std::sync::Arc;

#[path = "../tests/common/drawings.rs"]
mod drawings;
#[path = "../tests/common/people.rs"]
mod people;

fn daisy(c: &mut Criterion) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/sketches/daisy.penstemon");
    let sketch = sketch::read(&path).unwrap().0;
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let params = AnatomyParams::default();
    let mut group = c.benchmark_group("anatomy");
    group.throughput(Throughput::Elements(sketch.strokes.len() as u64));
    group.bench_function("daisy", |b| {
        one_thread.install(|| b.iter(|| black_box(analyse(&sketch, &params))));
    });
    group.finish();
}

fn meadows(c: &mut Criterion) {
    let mut group = c.benchmark_group("anatomy/meadow");
    group.sample_size(10);
    for strokes in [40, 640, 10_000] {
        group.throughput(Throughput::Elements(strokes as u64));
        let meadow = drawings::meadow(strokes);
        group.bench_function(BenchmarkId::from_parameter(strokes), |b| {
            b.iter(|| black_box(analyse(&meadow, &AnatomyParams::default())));
        });
    }
    group.finish();
}

/// Drawings by people beside one another, as many as have about so many strokes.
fn crowd(strokes: usize) -> Vec<Arc<Stroke>> {
    let drawings = people::drawings(people::Share::Development).unwrap();
    let mut crowd: Vec<Arc<Stroke>> = Vec::new();
    for (place, drawing) in drawings.iter().cycle().enumerate() {
        if crowd.len() >= strokes {
            break;
        }
        let at = Vec2::new((place % 64) as f32, (place / 64) as f32) * 1500.0;
        for stroke in &drawing.sketch.strokes {
            let mut moved = Stroke::clone(stroke);
            moved.id = crowd.len() as u64;
            moved.points.iter_mut().for_each(|point| point.position += at);
            crowd.push(Arc::new(moved));
        }
    }
    crowd
}

fn conventions_of_crowds(c: &mut Criterion) {
    let mut group = c.benchmark_group("anatomy/conventions");
    group.sample_size(10);
    for strokes in [10, 100, 1000, 10_000] {
        let crowd = crowd(strokes);
        group.throughput(Throughput::Elements(crowd.len() as u64));
        group.bench_function(BenchmarkId::from_parameter(strokes), |b| {
            b.iter(|| black_box(conventions::interpret(&crowd, &ConventionParams::default())));
        });
    }
    group.finish();
}

const MANY: usize = 10_000;

/// Branches that all begin in one spot.
fn broom() -> Sketch {
    let root = Vec2::new(500.0, 500.0);
    let strand = |k: usize| root + Vec2::from_angle(k as f32 * 0.618) * (300.0 + (k % 97) as f32);
    drawings::sketch((0..MANY).map(|k| (Tool::Branch, drawings::curve(root, strand(k), 0.1))))
}

/// Rows of branches, each stopping a little short of the one before.
fn chains() -> Sketch {
    let link = |k: usize| {
        let start = Vec2::new((k % 100) as f32, (k / 100) as f32) * 20.0 + Vec2::new(4.0, 0.0);
        (Tool::Branch, drawings::curve(start, start + Vec2::new(16.0, 0.0), 0.0))
    };
    drawings::sketch((0..MANY).map(link))
}

/// Petals around one point.
fn pompon() -> Sketch {
    let petal = |k: usize| {
        let out = Vec2::from_angle(k as f32 * 0.618) * (100.0 + (k % 89) as f32);
        (Tool::Petal, drawings::blade(out * 0.1, out, 0.2))
    };
    drawings::sketch((0..MANY).map(petal))
}

/// One outline that crosses itself all the time.
fn knot() -> Sketch {
    let around =
        |k: usize| Vec2::new(300.0, 300.0) + Vec2::from_angle(k as f32 * 2.4) * (200.0 - k as f32 * 0.02);
    drawings::sketch([(Tool::Petal, (0..MANY).map(around).collect())])
}

/// Leaves that all begin in one spot.
fn tuft() -> Sketch {
    let root = Vec2::new(500.0, 500.0);
    let leaf = |k: usize| {
        let tip = root + Vec2::from_angle(k as f32 * 0.618) * (100.0 + (k % 89) as f32);
        (Tool::Auto, drawings::blade(root, tip, 0.2))
    };
    drawings::sketch((0..MANY).map(leaf))
}

fn hard(c: &mut Criterion) {
    let mut group = c.benchmark_group("anatomy/hard");
    group.sample_size(10);
    for (name, sketch) in
        [("broom", broom()), ("chains", chains()), ("pompon", pompon()), ("knot", knot()), ("tuft", tuft())]
    {
        group.bench_function(name, |b| b.iter(|| black_box(analyse(&sketch, &AnatomyParams::default()))));
    }
    group.finish();
}

criterion_group!(benches, daisy, meadows, conventions_of_crowds, hard);
criterion_main!(benches);
