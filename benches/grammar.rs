//! Grammars: derivation and turtle on growing words, parsing, built-in inflorescences. `cargo bench --bench grammar`.
//!
//! Throughput counts modules; a nearly linear program has the same in every row of a group.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use penstemon::grammar::{Grammar, Settings, library};
use std::hint::black_box;

/// The program's own.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Modules of the words.
const SIZES: [u32; 4] = [1_000, 10_000, 100_000, 1_000_000];

/// A chain of internodes with a floret each, ten modules a link; a tree that forks, nine modules a fork.
const TEXTS: [(&str, f64, &str); 2] = [
    (
        "chain",
        10.0,
        "n = 1\naxiom: A(0)\n\
         A(i) : i < n -> F(0.0001, 0.002) [ /(137.5 * i) &(60) F(0.01, 0.001) *flower(rand(0.5, 1), i / n) ] A(i + 1)",
    ),
    (
        "tree",
        9.0,
        "n = 1\naxiom: A(n)\n\
         A(m) : m >= 1 -> F(0.01) [ +(rand(10, 40)) A(floor((m - 1) / 2)) ] [ -(30) A(m - 1 - floor((m - 1) / 2)) ]",
    ),
];

fn words(c: &mut Criterion) {
    for (name, each, text) in TEXTS {
        let grammar = Grammar::parse(text).unwrap();
        let mut group = c.benchmark_group(name);
        group.sample_size(10);
        for size in SIZES {
            let constants = [("n", (f64::from(size) / each).floor() - 1.0)];
            let settings = Settings { seed: 1, constants: &constants, ..Settings::default() };
            group.throughput(Throughput::Elements(u64::from(size)));
            group.bench_function(BenchmarkId::from_parameter(size), |b| {
                b.iter_with_large_drop(|| black_box(grammar.draw(&settings).unwrap()));
            });
        }
        group.finish();
    }
}

fn parsing(c: &mut Criterion) {
    let rule = "A(i) : i < 9 -> F(0.02, 0.002) [ /(137.5 * i) &(60) *flower(0.8) ] A(i + 1)\n";
    let mut group = c.benchmark_group("parse");
    for rules in [10, 100, 700] {
        let text = format!("axiom: A(0)\n{}", rule.repeat(rules));
        group.throughput(Throughput::Bytes(text.len() as u64));
        group.bench_function(BenchmarkId::from_parameter(rules), |b| {
            b.iter(|| black_box(Grammar::parse(&text).unwrap()));
        });
    }
    group.finish();
}

fn inflorescences(c: &mut Criterion) {
    let mut group = c.benchmark_group("inflorescence");
    for name in library::names() {
        let grammar = library::inflorescence(name).unwrap();
        group
            .throughput(Throughput::Elements(grammar.draw(&Settings::default()).unwrap().items.len() as u64));
        group.bench_function(name, |b| b.iter(|| black_box(grammar.draw(&Settings::default()).unwrap())));
    }
    group.finish();
}

criterion_group!(benches, words, parsing, inflorescences);
criterion_main!(benches);
