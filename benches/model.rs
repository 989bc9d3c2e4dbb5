//! The model stage against `spade` alone on the same points, and its growth with the number of leaves.

use criterion::{BatchSize, BenchmarkId, Criterion, criterion_group, criterion_main};
use glam::{Vec2, Vec3};
use penstemon::model::{
    BladeMeshParams, ModelParams, PlanarGraph, TriangulationScratch, build, triangulation_input,
};
use penstemon::plant::{
    Blade, BladeForm, Branch, Cone, Detail, FinishedPlant, Flower, Organ, OrganPart, Origin, Plant,
    RestSurface, Role, Shape, Template, TemplateId, Templates, WoodPart,
};
use spade::{ConstrainedDelaunayTriangulation, Point2};
use std::f32::consts::TAU;
use std::hint::black_box;

/// A petal as a pen draws it: 140 points, a notch at the tip, a little wobble.
fn outline(length: f32, wobble: f32) -> Vec<Vec2> {
    let at = |k: usize| {
        let s = k as f32 / 70.0;
        let (side, s) = if s < 1.0 { (1.0, s) } else { (-1.0, 2.0 - s) };
        let width = 0.28 * (s * 2.9).sin().abs() * (0.6 + 0.5 * s) + 0.002 * (k as f32 * wobble).sin();
        Vec2::new(side * width, s - 0.1 * ((s - 0.85).max(0.0) * 6.0).powi(2)) * length
    };
    (0..140).map(at).collect()
}

/// The template of a petal or leaf of a length.
fn template(length: f32, turn: f32, detail: Detail) -> Template {
    Template::new(outline(length, 1.0 + turn), Vec::new(), length, detail)
}

fn blade(template: TemplateId, turn: f32, rest: RestSurface, base: Vec3) -> Blade {
    let (sin, cos) = turn.sin_cos();
    let (u, v) = (Vec3::new(cos, sin, 0.0), Vec3::new(-sin, cos, 0.0));
    Blade { template, base, u, v, rest, form: BladeForm::default() }
}

fn organ(part: OrganPart, flower: Option<usize>, blade: Blade) -> Organ {
    Organ {
        role: Role::of(part),
        origin: Origin::Generated,
        branch: Some(0),
        flower,
        shape: Shape::Blade(blade),
    }
}

fn branch(parent: Option<usize>, base: Vec3, radius: f32) -> Branch {
    let points: Vec<Vec3> = (0..60)
        .map(|k| {
            base + Vec3::new(0.05 * (k as f32 * 0.05).sin(), k as f32 * 0.01, 0.02 * (k as f32 * 0.07).cos())
        })
        .collect();
    let radii = (0..60).map(|k| radius * (1.0 - 0.01 * k as f32)).collect();
    let (level, role) = (u32::from(parent.is_some()), Role::of(WoodPart::Stem));
    Branch { origin: Origin::Generated, parent, level, points, radii, role }
}

/// A flower of 13 petals on a stem with two side branches and 4 leaves.
fn flower() -> Plant {
    let apex = Vec3::new(0.0, 0.6, 0.0);
    let cone = Cone { apex, axis: Vec3::new(0.0, 0.5, 0.866), opening_rad: 1.1, height: 0.05 };
    let mut templates = Templates::default();
    let mut organs = Vec::new();
    for k in 0..13 {
        let turn = TAU * k as f32 / 13.0;
        let (template, rest) = (
            templates.add(template(0.1, turn, Detail::Full)),
            RestSurface::Cone { cone, hint: 0.03, sight: Vec3::Z },
        );
        organs.push(organ(OrganPart::Petal, Some(0), blade(template, turn, rest, apex)));
    }
    for k in 0..4 {
        let (turn, base) = (0.8 * k as f32, Vec3::Y * (0.1 + 0.1 * k as f32));
        let template = templates.add(template(0.15, turn, Detail::Full));
        organs.push(organ(OrganPart::Leaf, None, blade(template, turn, RestSurface::Plane, base)));
    }
    Plant {
        branches: vec![
            branch(None, Vec3::ZERO, 0.006),
            branch(Some(0), Vec3::Y * 0.2, 0.004),
            branch(Some(0), Vec3::Y * 0.3, 0.004),
        ],
        flowers: vec![Flower {
            origin: Origin::Generated,
            branch: Some(0),
            cone,
            centre_radius: 0.01,
            reach: 0.1,
            look: 0,
        }],
        organs,
        templates,
    }
}

/// Copies of one leaf, all over.
fn foliage(count: usize) -> Plant {
    let mut templates = Templates::default();
    let template = templates.add(template(0.05, 0.0, Detail::Reduced));
    let leaf = |k: usize| {
        let base = Vec3::new((k as f32 * 0.37).sin(), k as f32 / count as f32, (k as f32 * 0.61).cos());
        let turned = blade(template, 0.0, RestSurface::Plane, base);
        let turn = glam::Quat::from_rotation_y(k as f32);
        organ(OrganPart::Leaf, None, Blade { u: turn * turned.u, v: turn * turned.v, ..turned })
    };
    Plant { organs: (0..count).map(leaf).collect(), templates, flowers: Vec::new(), ..flower() }
}

fn graphs(plant: &Plant) -> Vec<PlanarGraph> {
    let params = BladeMeshParams::default();
    let blades = plant.blades().map(|blade| plant.templates.resolve(blade));
    blades.filter_map(|blade| triangulation_input(&blade, &params)).collect()
}

fn against_spade(c: &mut Criterion) {
    let plant = flower();
    let graphs = graphs(&plant);
    let single = rayon::ThreadPoolBuilder::new().num_threads(1).build().ok();
    let mut group = c.benchmark_group("flower");
    group.bench_function("spade_alone", |b| {
        b.iter_batched(
            || graphs.iter().map(PlanarGraph::spade_input).collect::<Vec<_>>(),
            |inputs| {
                for (points, edges) in inputs {
                    let cdt = ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(
                        points,
                        edges,
                        |_| (),
                    );
                    let _ = black_box(cdt);
                }
            },
            BatchSize::SmallInput,
        );
    });
    group.bench_function("spade_in_row_order", |b| {
        let mut scratch = TriangulationScratch::default();
        b.iter(|| {
            let faces = graphs.iter().filter_map(|graph| black_box(graph).triangulate(&mut scratch));
            faces.map(|triangles| triangles.len()).sum::<usize>()
        });
    });
    let plant = FinishedPlant::plain(plant);
    group.bench_function("model", |b| {
        let run = || build(black_box(&plant), &ModelParams::default());
        b.iter(|| single.as_ref().map(|pool| pool.install(run)));
    });
    group.finish();
}

fn leaves(c: &mut Criterion) {
    let mut group = c.benchmark_group("template_leaves");
    let single = rayon::ThreadPoolBuilder::new().num_threads(1).build().ok();
    for count in [10, 100, 1_000, 10_000, 100_000] {
        let plant = FinishedPlant::plain(foliage(count));
        group.sample_size(if count > 10_000 { 10 } else { 50 });
        group.bench_with_input(BenchmarkId::from_parameter(count), &plant, |b, plant| {
            let run = || build(black_box(plant), &ModelParams::default());
            b.iter(|| single.as_ref().map(|pool| pool.install(run)));
        });
    }
    group.finish();
}

criterion_group!(benches, against_spade, leaves);
criterion_main!(benches);
