//! The whole way from drawing to meshes: the eight reference plants against `spade` alone on the same points, and
//! growing drawings. `cargo bench --bench pipeline`.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use penstemon::model::{BladeMeshParams, triangulation_input};
use penstemon::pipeline::{self, Params};
use penstemon::plant::{Plant, Shape};
use penstemon::sketch::{self, Sketch};
use penstemon::species::Species;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

#[path = "../tests/common/drawings.rs"]
mod drawings;

/// The program's own.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

const REFERENCE: [&str; 8] =
    ["daisy", "hepatica_red", "hepatica_blue", "jasmine", "mallow", "balloon_flower", "plumeria", "oxalis"];

fn load(name: &str) -> (Sketch, Species, Params) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/sketches/{name}.penstemon"));
    let sketch = sketch::read(&path).unwrap().0;
    set_up(sketch)
}

fn set_up(sketch: Sketch) -> (Sketch, Species, Params) {
    let species = pipeline::species_of(&sketch, Path::new("")).unwrap();
    let params = pipeline::params_of(&sketch, &species, &[]).unwrap();
    (sketch, species, params)
}

fn single_threaded<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(work)
}

/// Points and edges of one blade.
type SpadeInput = (Vec<Point2<f64>>, Vec<[usize; 2]>);

/// What spade is given for every blade of a plant.
fn spade_inputs(plant: &Plant, params: &BladeMeshParams) -> Vec<SpadeInput> {
    let blades = plant.organs.iter().filter_map(|organ| match &organ.shape {
        Shape::Blade(blade) => triangulation_input(&plant.templates.resolve(blade), params),
        _ => None,
    });
    blades.map(|graph| graph.spade_input()).collect()
}

/// Spade alone, by its own bulk loading; gives the number of triangles.
fn triangulate(points: &[Point2<f64>], edges: &[[usize; 2]]) -> usize {
    let mesh =
        ConstrainedDelaunayTriangulation::<Point2<f64>>::bulk_load_cdt(points.to_vec(), edges.to_vec())
            .unwrap();
    black_box(mesh.num_inner_faces())
}

/// Whole pipeline on one thread, and spade on the very points that it was given.
fn reference_plants(c: &mut Criterion) {
    let mut group = c.benchmark_group("reference");
    for name in REFERENCE {
        let (sketch, species, params) = load(name);
        let plant = pipeline::build(&sketch, &species, &params).plant;
        let inputs = spade_inputs(&plant, &params.model.blade);
        group.bench_function(BenchmarkId::new("pipeline", name), |b| {
            single_threaded(|| b.iter(|| black_box(pipeline::build(&sketch, &species, &params))));
        });
        group.bench_function(BenchmarkId::new("spade", name), |b| {
            b.iter(|| inputs.iter().map(|(points, edges)| triangulate(points, edges)).sum::<usize>());
        });
    }
    group.finish();
}

/// How many times each of the two is timed in [`ratios`].
const ROUNDS: usize = 400;

/// Pipeline and spade turn by turn, so that both see the same moods of the machine: medians and their ratio.
fn ratios(_: &mut Criterion) {
    let median = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    for name in REFERENCE {
        let (sketch, species, params) = load(name);
        let inputs = spade_inputs(&pipeline::build(&sketch, &species, &params).plant, &params.model.blade);
        let (mut ours, mut theirs) = (Vec::with_capacity(ROUNDS), Vec::with_capacity(ROUNDS));
        let time = |times: &mut Vec<f64>, work: &dyn Fn()| {
            let start = Instant::now();
            work();
            times.push(1e3 * start.elapsed().as_secs_f64());
        };
        let build = || drop(black_box(pipeline::build(&sketch, &species, &params)));
        let spade = || {
            black_box(inputs.iter().map(|(points, edges)| triangulate(points, edges)).sum::<usize>());
        };
        single_threaded(|| {
            for _ in 0..ROUNDS {
                // Warmed up, so that each finds its own data in the caches.
                build();
                time(&mut ours, &build);
                spade();
                time(&mut theirs, &spade);
            }
        });
        let (ours, theirs) = (median(&mut ours), median(&mut theirs));
        eprintln!("{name}: {ours:.2} ms, spade {theirs:.2} ms, ratio {:.2}", ours / theirs);
    }
}

fn trees(c: &mut Criterion) {
    let mut group = c.benchmark_group("tree");
    for name in ["tree_round", "tree_willow"] {
        let (sketch, species, params) = load(name);
        group.bench_function(name, |b| b.iter(|| black_box(pipeline::build(&sketch, &species, &params))));
    }
    group.finish();
}

fn growing_drawings(c: &mut Criterion) {
    let mut group = c.benchmark_group("strokes");
    group.sample_size(10);
    for strokes in [10, 40, 160, 640, 2560, 10_000] {
        let (sketch, species, params) = set_up(drawings::meadow(strokes));
        group.bench_function(BenchmarkId::from_parameter(strokes), |b| {
            b.iter(|| black_box(pipeline::build(&sketch, &species, &params)));
        });
    }
    group.finish();
    let mut group = c.benchmark_group("leaves");
    group.sample_size(10);
    for leaves in [10, 100, 1000, 10_000, 100_000] {
        let (sketch, species, params) = set_up(drawings::leafy_tree(leaves));
        group.bench_function(BenchmarkId::from_parameter(leaves), |b| {
            b.iter(|| black_box(pipeline::build(&sketch, &species, &params)));
        });
    }
    group.finish();
}

criterion_group!(benches, ratios, reference_plants, trees, growing_drawings);
criterion_main!(benches);
