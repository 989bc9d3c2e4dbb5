//! A petal cut out of growing photographs, bark made a tile, and a whole plant found. `cargo bench --bench photographs`.

#![allow(
    clippy::unwrap_used,
    missing_docs,
    reason = "a bench that cannot go on has failed; criterion's macros have no docs"
)]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec2;
use penstemon::photo::plant::{Marks, PlantPhoto};
use penstemon::photo::{BarkPhoto, BladePhoto, PhotoParams, PlantParams};
use penstemon::picture::decode::Rgba;
use std::hint::black_box;

/// A speckled petal that fills most of a grey photograph.
fn photograph(side: u32) -> Rgba {
    let pixels = (0..side * side).flat_map(|i| {
        let at = Vec2::new((i % side) as f32 + 0.5, (i / side) as f32 + 0.5) / side as f32 - 0.5;
        let radius = 0.4 + 0.03 * (9.0 * at.x.atan2(at.y)).cos();
        let covered = ((radius - at.length()) * side as f32 + 0.5).clamp(0.0, 1.0);
        let speckle = (i.wrapping_mul(0x9e37_79b1) >> 28) as f32;
        let mixed = |petal: f32| (petal * covered + 200.0 * (1.0 - covered) + speckle) as u8;
        [mixed(220.0), mixed(60.0 + 90.0 * (at.y + 0.5)), mixed(120.0), 255]
    });
    Rgba { width: side, height: side, pixels: pixels.collect() }
}

fn photographs(c: &mut Criterion) {
    let params = PhotoParams {
        cutout: penstemon::photo::CutoutParams { side: 4096, ..Default::default() },
        ..Default::default()
    };
    let mut group = c.benchmark_group("photograph");
    group.sample_size(10);
    for side in [256, 512, 1024, 2048, 4096] {
        let picture = photograph(side);
        group.throughput(Throughput::Elements(u64::from(side) * u64::from(side)));
        group.bench_function(BenchmarkId::new("petal", side), |b| {
            b.iter(|| black_box(BladePhoto::of_photograph(&picture, None, &params).unwrap()));
        });
        group.bench_function(BenchmarkId::new("bark", side), |b| {
            b.iter(|| black_box(BarkPhoto::of_photograph(&picture, &params).unwrap()));
        });
    }
    for side in [256, 512, 1024] {
        let picture = photograph(side);
        let params = PlantParams { side, ..PlantParams::default() };
        group.throughput(Throughput::Elements(u64::from(side) * u64::from(side)));
        group.bench_function(BenchmarkId::new("plant", side), |b| {
            b.iter(|| black_box(PlantPhoto::of_photograph(&picture, &Marks::default(), &params).unwrap()));
        });
    }
    group.finish();
}

criterion_group!(benches, photographs);
criterion_main!(benches);
