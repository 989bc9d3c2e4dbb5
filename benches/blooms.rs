//! Flowers in layers, inflorescences and roses, from the species to finished surfaces. `cargo bench --bench blooms`.
//!
//! Throughput counts petals or florets; a nearly linear program has the same in every row of a group. The goals: 20 layers with
//! 300 petals in 25 ms, a peony in 3 ms, a rose with eight flowers in 10 ms.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use penstemon::pipeline::{self, Bloom, Built, Params, Seed};
use penstemon::species::Species;
use std::hint::black_box;

/// The program's own.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn with(name: &str, assignments: &[String]) -> (Species, Params) {
    let species = Species::built_in(name).unwrap();
    let params = pipeline::params_of_species(&species, assignments).unwrap();
    (species, params)
}

/// A species of which one stem stands without leaves.
fn alone(name: &str, assignment: String) -> (Species, Params) {
    let bare = ["flower.clump.stems=1", "flower.leaves.rosette=0", "flower.leaves.nodes=0"];
    with(name, &bare.map(str::to_owned).into_iter().chain([assignment]).collect::<Vec<_>>())
}

fn bloom((species, params): &(Species, Params)) -> Built {
    pipeline::build(&Bloom { number: 1 }, species, params)
}

/// Fifteen petals in each layer.
fn layers(c: &mut Criterion) {
    let mut group = c.benchmark_group("layers");
    group.sample_size(20);
    for count in [1, 2, 5, 10, 20] {
        let mut made = alone("chrysanthemum", format!("flower.layers.count={count}"));
        made.1.flower.layers.as_mut().unwrap().petals = vec![(0, 15)];
        let per_flower = bloom(&made).plant.organs.len() as u64;
        group.throughput(Throughput::Elements(per_flower));
        group.bench_function(BenchmarkId::from_parameter(count), |b| {
            b.iter_with_large_drop(|| black_box(bloom(&made)));
        });
    }
    group.finish();
}

fn florets(c: &mut Criterion) {
    let mut group = c.benchmark_group("florets of a sunflower");
    group.sample_size(10);
    for count in [100, 300, 1000, 3000] {
        let made = alone("sunflower", format!("flower.inflorescence.n={count}"));
        group.throughput(Throughput::Elements(count));
        group.bench_function(BenchmarkId::from_parameter(count), |b| {
            b.iter_with_large_drop(|| black_box(bloom(&made)));
        });
    }
    group.finish();
}

/// What the window does while its slider moves.
fn opening(c: &mut Criterion) {
    let mut group = c.benchmark_group("one opening");
    for name in ["peony", "rose", "camellia", "lilac", "dandelion"] {
        let made = alone(name, "flower.open=0.6".to_owned());
        group.bench_function(name, |b| b.iter_with_large_drop(|| black_box(bloom(&made))));
        let leafy = with(name, &["flower.open=0.6".to_owned()]);
        group.bench_function(format!("{name} with its leaves"), |b| {
            b.iter_with_large_drop(|| black_box(bloom(&leafy)));
        });
    }
    group.finish();
}

fn roses(c: &mut Criterion) {
    let made = with("rose", &[]);
    let rose = || pipeline::build(&Seed { number: 1, ..Seed::default() }, &made.0, &made.1);
    c.bench_function("a rose with eight flowers", |b| b.iter_with_large_drop(|| black_box(rose())));
}

criterion_group!(benches, layers, florets, opening, roses);
criterion_main!(benches);
