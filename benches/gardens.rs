//! Gardens: tiles by colours, places by number, the file of ten thousand roses. `cargo bench --bench gardens`.
//!
//! Throughput counts plants; places that are found without looking at their neighbours have the same in every row.

#![allow(clippy::unwrap_used, reason = "a bench that cannot go on has failed")]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::{Vec2, Vec3};
use penstemon::formats::write::{InstanceForm, Scene, format_of};
use penstemon::garden::ground::Ground;
use penstemon::garden::stock::{Individual, KindStock, Surface};
use penstemon::garden::{Area, Coarser, Garden, Kind, Plan, Share, Stands, Stock, TileSet, Variation, Views};
use penstemon::model::{Mesh, PartKind, Vertex};
use penstemon::pipeline::{self, Form, Grower};
use penstemon::plant::{FinishedPlant, Material, Plant, Provenance};
use penstemon::render::{CrowdChoice, OrbitCamera, Sight};
use penstemon::sketch::{self, GardenPlant, GardenPoint, GardenStroke, GardenTool, Sketch};
use penstemon::species::{Species, builtin_texture};
use std::borrow::Cow;
use std::hint::black_box;
use std::path::Path;
use std::sync::Arc;

/// The program's own.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Plants of the gardens.
const PLANTS: [u32; 5] = [100, 1_000, 10_000, 100_000, 1_000_000];
const SPACING: f32 = 0.5;
/// From where the pictures of far plants are seen.
const SIDES: [Vec3; 7] = [
    Vec3::X,
    Vec3::Z,
    Vec3::NEG_X,
    Vec3::NEG_Z,
    Vec3::new(1.0, 1.0, 1.0),
    Vec3::new(-1.0, 1.0, -1.0),
    Vec3::Y,
];

/// A square with room for about so many plants.
fn plan(plants: u32, tiles: &TileSet) -> Plan {
    let side = (plants as f32 / tiles.density()).sqrt() * SPACING;
    let (share, spacing, variants) = (1.0, SPACING, 16);
    let kind = Kind { share, spacing, variants, map: None, bed: None, stands: Stands::Spread, wall: None };
    Plan {
        seed: 1,
        area: Area::rectangle(Vec2::splat(side)).unwrap(),
        density: None,
        map: None,
        ground: Ground::default(),
        paths: Vec::new(),
        walls: Vec::new(),
        beds: Vec::new(),
        kinds: vec![kind],
        variation: Variation::default(),
    }
}

fn tiles(c: &mut Criterion) {
    let mut group = c.benchmark_group("tiles");
    group.sample_size(10);
    for colours in 1..=4 {
        group.bench_function(BenchmarkId::from_parameter(colours), |b| {
            b.iter(|| TileSet::new(black_box(colours), 1))
        });
    }
    group.finish();
}

fn places(c: &mut Criterion) {
    let tiles = TileSet::new(3, 1);
    let mut group = c.benchmark_group("places");
    group.sample_size(10);
    for plants in PLANTS {
        let plan = plan(plants, &tiles);
        group.throughput(Throughput::Elements(u64::from(plants)));
        group.bench_function(BenchmarkId::from_parameter(plants), |b| {
            b.iter_with_large_drop(|| black_box(plan.places(&tiles).unwrap()));
        });
    }
    let largest = plan(PLANTS[4], &tiles);
    let share: Share = "32/64".parse().unwrap();
    group.throughput(Throughput::Elements(u64::from(PLANTS[4] / share.of())));
    group.bench_function("a share of 64", |b| {
        b.iter_with_large_drop(|| black_box(largest.places_of(&tiles, share).unwrap()));
    });
    group.finish();
}

fn roses(c: &mut Criterion) {
    let tiles = TileSet::new(3, 1);
    let plan = plan(10_000, &tiles);
    let whole = || {
        let places = plan.places(&tiles).unwrap();
        let species = Box::new(Species::built_in("rose").unwrap());
        let params = Box::new(pipeline::params_of_species(&species, &[]).unwrap());
        let form = Form::Whole;
        let mut grower = Grower::Species { species, params, age: None, first_seed: 1, form, before: None };
        grower.fit(pipeline::triangles_of_each(places.len(), 16));
        let mut stock = Stock::default();
        stock.add("rose", grower.grow_all(16, false), 0.0);
        let garden = Garden { stock, places, ground: None, walls: Vec::new() };
        let plant = FinishedPlant::new(Plant::default(), &[], |_| Material::plain("plant", [0.5; 3]));
        let (provenance, instanced) = (Provenance::default(), garden.instanced());
        let built_in = |name: &str| builtin_texture(name).map(Cow::Borrowed);
        let scene =
            Scene::new(&instanced.model, (&plant, &provenance), &built_in, Cow::Borrowed("bed")).unwrap();
        let scene = scene.with_instances(&instanced.groups, InstanceForm::Nodes).unwrap();
        format_of(Path::new("bed.glb")).unwrap().encode(&scene).unwrap().bytes
    };
    let mut group = c.benchmark_group("10000 roses, GLB");
    group.sample_size(10);
    group.throughput(Throughput::Bytes(whole().len() as u64));
    group.bench_function("from the plan", |b| b.iter(|| black_box(whole())));
    group.finish();
}

/// The garden of a drawing while the pen paints on: all of it but the new bed is kept.
fn painted(c: &mut Criterion) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/painted_garden.penstemon");
    let sketch = sketch::read(&path).unwrap().0;
    let species = pipeline::species_of(&sketch, Path::new("")).unwrap();
    let params = pipeline::params_of(&sketch, &species, &[]).unwrap();
    let mut group = c.benchmark_group("painted garden");
    group.sample_size(10);
    let with = |samples: u32| {
        let point = |k: u32| GardenPoint { at: Vec2::new(-3.0 + 0.02 * k as f32, 4.8), pressure: 0.5 };
        let points = (0..=samples).map(point).collect();
        let bed =
            GardenStroke { tool: GardenTool::Plants(GardenPlant::Drawn), radius: 0.3, density: 1.0, points };
        Sketch { garden: sketch.garden.iter().cloned().chain([Arc::new(bed)]).collect(), ..sketch.clone() }
    };
    let mut cache = pipeline::Cache::default();
    let mut samples = 0;
    group.bench_function("one more sample", |b| {
        b.iter(|| {
            samples = (samples + 1) % 300;
            let sketch = with(samples);
            black_box(pipeline::build_with(&mut cache, &sketch, &species, &params, &|| false).unwrap())
        });
    });
    group.bench_function("from nothing", |b| {
        b.iter(|| black_box(pipeline::build(&sketch, &species, &params)));
    });
    group.finish();
}

/// The forms in which plants are drawn while somebody walks through them: what a frame of the window costs before the GPU.
fn choice(c: &mut Criterion) {
    let tiles = TileSet::new(3, 1);
    let mesh = || {
        let points = vec![Vec3::ZERO, Vec3::X * 0.5, Vec3::Y];
        let vertex = |point| Vertex { point, normal: Vec3::Z, uv: Vec2::ZERO };
        Arc::new(Mesh {
            points,
            vertices: (0..3).map(vertex).collect(),
            triangles: vec![[0, 1, 2]],
            breaks: Vec::new(),
        })
    };
    let form = || vec![Surface { material: 0, kind: PartKind::Wood, mesh: mesh() }];
    let individual = || Individual {
        surfaces: form(),
        coarser: [400.0, 200.0, 100.0].map(|pixels| Coarser { form: form(), pixels }).into(),
        views: Views { forms: SIDES.map(|side| (side.normalize(), form())).into(), pixels: 60.0 },
    };
    let individuals = (0..16).map(|_| individual()).collect();
    let kinds = vec![KindStock { name: "rose".to_owned(), individuals, remarks: Vec::new() }];
    let stock = Stock { kinds, ..Stock::default() };
    let mut group = c.benchmark_group("forms of plants, a step");
    for plants in PLANTS {
        let places = plan(plants, &tiles).places(&tiles).unwrap();
        let mut choice = CrowdChoice::new(&stock, &places).unwrap();
        let mut step = 0;
        group.throughput(Throughput::Elements(places.len() as u64));
        group.bench_function(BenchmarkId::from_parameter(plants), |b| {
            b.iter(|| {
                step = (step + 1) % 200;
                let at = Vec2::splat(5.0 + 0.05 * step as f32);
                let camera = OrbitCamera::at_eye(at, 1.6, Vec2::ONE, 0.0);
                let sight = Sight::of(&camera, (Vec3::ZERO, Vec3::splat(200.0)), [1920, 1080]);
                choice.choose(black_box(&sight)).map(|(order, forms)| (order.len(), forms.len()))
            });
        });
    }
    group.finish();
}

criterion_group!(benches, tiles, places, roses, painted, choice);
criterion_main!(benches);
