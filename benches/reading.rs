//! Bytes in memory to a drawing, both formats, over growing numbers of strokes. `cargo bench --bench reading`.

#![allow(
    clippy::unwrap_used,
    missing_docs,
    reason = "a bench that cannot go on has failed; criterion's macros have no docs"
)]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use penstemon::sketch::{self, Sketch};
use std::fmt::Write;
use std::hint::black_box;

#[path = "../tests/common/drawings.rs"]
mod drawings;

/// The same strokes as an SVG of polygonal paths.
fn svg(sketch: &Sketch) -> String {
    let mut text = String::from("<svg xmlns=\"http://www.w3.org/2000/svg\">");
    for stroke in &sketch.strokes {
        text.push_str("<path fill=\"none\" stroke=\"black\" d=\"M");
        for point in &stroke.points {
            write!(text, " {},{}", point.position.x, point.position.y).unwrap();
        }
        text.push_str("\"/>");
    }
    text + "</svg>"
}

fn reading(c: &mut Criterion) {
    for (format, write) in [("json", sketch::json::write as fn(&Sketch) -> String), ("svg", svg)] {
        let mut group = c.benchmark_group(format!("read_{format}"));
        for strokes in [10, 160, 2_560, 10_000] {
            let text = write(&drawings::meadow(strokes));
            group.throughput(Throughput::Bytes(text.len() as u64));
            group.sample_size(if strokes > 1000 { 10 } else { 50 });
            group.bench_function(BenchmarkId::from_parameter(strokes), |b| {
                b.iter(|| black_box(sketch::from_bytes(text.as_bytes(), "drawing").unwrap()));
            });
        }
        group.finish();
    }
}

criterion_group!(benches, reading);
criterion_main!(benches);
