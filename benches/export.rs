//! How fast models become bytes in memory, and how fast meshes are judged, over growing plants; single thread.
//!
//! `cargo bench --bench export`. The throughput is that of the finished file's bytes.

#![allow(
    clippy::unwrap_used,
    missing_docs,
    reason = "a failure here stops the bench; criterion's macros have no docs"
)]

#[path = "../tests/common/mod.rs"]
mod common;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use penstemon::formats::write::{Exporter, Scene, glb::Glb, obj::Obj};
use penstemon::model::quality::{Attributes, judge};
use std::hint::black_box;

/// The program's own.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

const LEAVES: [usize; 4] = [10, 100, 1_000, 10_000];

fn encoding(criterion: &mut Criterion) {
    let formats: [&dyn Exporter; 2] = [&Glb, &Obj];
    for format in formats {
        let mut group = criterion.benchmark_group(format!("encode_{}", format.extension()));
        for leaves in LEAVES {
            let ((model, plant), provenance) = (common::leafy(leaves), common::provenance());
            let encode = || {
                let scene =
                    Scene::new(&model, (&plant, &provenance), &common::textures, "plant".into()).unwrap();
                format.encode(&scene).unwrap()
            };
            group.throughput(Throughput::Bytes(encode().bytes.len() as u64));
            group.bench_function(BenchmarkId::from_parameter(leaves), |b| b.iter(|| black_box(encode())));
        }
        group.finish();
    }
}

fn judging(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("judge");
    for sides in [14, 140, 1_400, 14_000] {
        let mesh = common::leaf(glam::Vec3::ZERO, glam::Vec3::X, glam::Vec3::Y, 6, sides);
        group.throughput(Throughput::Elements(mesh.triangles.len() as u64));
        group.bench_function(BenchmarkId::from_parameter(mesh.triangles.len()), |b| {
            b.iter(|| black_box(judge(&mesh, Attributes::ALL)))
        });
    }
    group.finish();
}

criterion_group!(benches, encoding, judging);
criterion_main!(benches);
