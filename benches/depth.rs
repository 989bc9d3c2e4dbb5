//! Flat to space, alone, on one thread: the reference plants, whose time goes into the poses of flowers, growing trees, and what a network says.
//! `cargo bench --bench depth`.

#![allow(
    clippy::unwrap_used,
    missing_docs,
    reason = "a bench that cannot go on has failed; criterion's macros have no docs"
)]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use penstemon::anatomy::analyse;
use penstemon::depth::learned::field_of;
use penstemon::depth::{DepthParams, recover};
use penstemon::learned_depth::Memory;
use penstemon::pipeline;
use penstemon::sketch::{self, Sketch};
use penstemon::species::Species;
use std::hint::black_box;
use std::path::Path;

#[path = "../tests/common/drawings.rs"]
mod drawings;

fn measure(c: &mut Criterion, group: &str, name: &str, sketch: &Sketch) {
    let species = pipeline::species_of(sketch, Path::new("")).unwrap();
    let params = pipeline::params_of(sketch, &species, &[]).unwrap();
    let anatomy = analyse(sketch, &params.anatomy);
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let mut group = c.benchmark_group(group);
    group.throughput(Throughput::Elements((anatomy.petals.len() + anatomy.leaves.len()) as u64));
    let depth: &DepthParams = &params.depth;
    group.bench_function(BenchmarkId::from_parameter(name), |b| {
        one_thread.install(|| b.iter(|| black_box(recover(&anatomy, sketch.seed, depth))));
    });
    group.finish();
}

fn flowers(c: &mut Criterion) {
    for name in ["daisy", "hepatica_red", "plumeria", "bouquet"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/sketches/{name}.penstemon"));
        measure(c, "depth", name, &sketch::read(&path).unwrap().0);
    }
}

fn trees(c: &mut Criterion) {
    for leaves in [100, 1_000, 10_000] {
        measure(c, "depth/leaves", &leaves.to_string(), &drawings::leafy_tree(leaves));
    }
}

/// What a network says of a crown with a trunk: asked anew, and where nothing has changed.
fn learned(c: &mut Criterion) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/crowns/round.svg");
    let sketch = sketch::read(&path).unwrap().0;
    let params = pipeline::params_of(&sketch, &Species::built_in("oak").unwrap(), &[]).unwrap();
    let anatomy = analyse(&sketch, &params.anatomy);
    let ask = |memory: &mut Memory| field_of(memory, &anatomy, Some("oak"), 0.2, &params.depth.learned);
    c.bench_function("depth/learned", |b| b.iter(|| black_box(ask(&mut Memory::default()))));
    let mut memory = Memory::default();
    c.bench_function("depth/learned again", |b| b.iter(|| black_box(ask(&mut memory))));
}

criterion_group!(benches, flowers, trees, learned);
criterion_main!(benches);
