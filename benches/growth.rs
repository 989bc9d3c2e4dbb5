//! Growing plants: whole trees from seed to surfaces, crowding in ever larger volumes, and strokes of a brush. `cargo bench --bench growth`.
//!
//! Trees are grown on one thread, so that times are those of one processor core; throughput counts triangles. Volumes
//! hold one, four and sixteen parts of a million markers, on all cores; throughput counts internodes.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::Vec3;
use penstemon::growth::brush::{Memory, Paint};
use penstemon::growth::{Envelope, Habit, Limits, PlantAtAge, Simulation, Swept, habit::Resource};
use penstemon::pipeline::{self, Seed};
use penstemon::plant::{Branch, FlowerBuds, Origin, Plant, Provenance, Role, WoodPart};
use penstemon::species::Species;
use std::hint::black_box;
use std::sync::Arc;

/// The program's own.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Species and ages from a young tree of some 25,000 triangles to a grown crown.
const TREES: [(&str, f32); 4] = [("birch", 5.0), ("oak", 7.0), ("oak", 15.0), ("oak", 26.0)];

/// Side of the largest box, metres: a million markers of the default habit.
const WIDEST: f32 = 24.0;

fn single_threaded<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(work)
}

fn trees(c: &mut Criterion) {
    let mut group = c.benchmark_group("tree");
    group.sample_size(20);
    for (name, age) in TREES {
        let species = Species::built_in(name).unwrap();
        let params = pipeline::params_of_species(&species, &[]).unwrap();
        let seed = Seed { number: 1, age: Some(age), ..Seed::default() };
        // With every leaf as triangles, as other programs have them.
        let grow = || pipeline::build(&seed, &species, &params).model.flattened().into_owned();
        group.throughput(Throughput::Elements(grow().triangle_count() as u64));
        group.bench_function(BenchmarkId::new(name, age), |b| {
            single_threaded(|| b.iter_with_large_drop(|| black_box(grow())));
        });
    }
    group.finish();
}

fn boxed(side: f32) -> Simulation {
    let half = Vec3::new(0.5 * side, 0.0, 0.5 * side);
    let envelope = Envelope::Box { low: -half, high: half + Vec3::Y * side };
    let habit = Habit { resource: Resource::Space, height: side, ..Habit::default() };
    let mut simulation = Simulation::in_envelope(&habit, envelope, 1, Limits::default());
    simulation.grow_to(200, &|| false);
    simulation
}

fn volumes(c: &mut Criterion) {
    let mut group = c.benchmark_group("volume");
    group.sample_size(10);
    for parts in [16.0f32, 4.0, 1.0] {
        let side = WIDEST / parts.cbrt();
        let internodes = boxed(side).tree().len();
        group.throughput(Throughput::Elements(internodes as u64));
        group.bench_function(BenchmarkId::from_parameter(internodes), |b| b.iter(|| black_box(boxed(side))));
    }
    group.finish();
}

/// A bare trunk of ten metres.
fn trunk() -> PlantAtAge {
    let points: Vec<Vec3> = (0..=100).map(|k| Vec3::Y * (0.1 * k as f32)).collect();
    let radii = (0..=100).map(|k| 0.2 - 0.0015 * k as f32).collect();
    let (origin, role) = (Origin::Generated, Role::of(WoodPart::Stem));
    let trunk = Branch { origin, parent: None, level: 0, points, radii, role };
    let plant = Plant { branches: vec![trunk], ..Plant::default() };
    PlantAtAge { plant, buds: FlowerBuds::default() }
}

/// Strokes of a growth brush that wind around the trunk, on one core: about 5,000, 10,000 and 40,000 markers. Throughput counts
/// points of what grew.
fn brushes(c: &mut Criterion) {
    let habit = Species::built_in("oak").unwrap().growth.unwrap();
    let mut group = c.benchmark_group("brush");
    group.sample_size(10);
    for turns in [0.25f32, 1.0, 4.0] {
        let way = |k: usize| {
            let share = k as f32 / 1000.0;
            let (sin, cos) = (std::f32::consts::TAU * turns * share).sin_cos();
            (Vec3::new(2.5 * cos, 1.0 + 8.0 * share, 2.5 * sin), 0.25)
        };
        let way: Vec<_> = (0..=1000).map(way).collect();
        let paint = || {
            let swept = Arc::new(Swept::new(&way, 0.8).unwrap());
            let (mut plant, mut memory, provenance) = (trunk(), Memory::default(), Provenance::default());
            let paint = Paint { swept, obstacles: None, radius: 0.25, density: 1.0, seed: 1 };
            paint.grow((&mut plant, &provenance), (&mut memory, 0), (&habit, Limits::default()), &|| false);
            plant
        };
        let points =
            single_threaded(paint).plant.branches.iter().map(|branch| branch.points.len()).sum::<usize>();
        group.throughput(Throughput::Elements(points as u64));
        group.bench_function(BenchmarkId::from_parameter(points), |b| {
            single_threaded(|| b.iter_with_large_drop(|| black_box(paint())));
        });
    }
    group.finish();
}

criterion_group!(benches, trees, volumes, brushes);
criterion_main!(benches);
