//! What it saves that leaves of one shape stay copies: an oak of twenty years as copies, and with every leaf as triangles.
//!
//! In one run, taking turns: the time from the plant to its model, the memory of its meshes, the bytes that go to the
//! graphics card, and the bytes of its GLB file.

#![allow(clippy::unwrap_used, reason = "a bench that cannot go on has failed")]
#![allow(clippy::print_stdout, reason = "figures are what a bench is for")]

use penstemon::cli::common::built_in_texture;
use penstemon::formats::textures::fetch;
use penstemon::formats::write::{InstanceForm, Scene, format_of};
use penstemon::model::{InstancedModel, Mesh, Model, Placement, Vertex, build};
use penstemon::pipeline::{self, Seed};
use penstemon::plant::Texture;
use penstemon::render::{Renderer, Viewport};
use penstemon::species::Species;
use std::borrow::Cow;
use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};

/// Builds of each kind; the middle one counts.
const ROUNDS: usize = 15;

fn main() {
    let age = if std::env::args().any(|argument| argument == "--test") { 4.0 } else { 20.0 };
    let species = Species::built_in("oak").unwrap();
    let params = pipeline::params_of_species(&species, &[]).unwrap();
    let seed = Seed { number: 1, age: Some(age), ..Seed::default() };
    let built = pipeline::build(&seed, &species, &params);
    let plant = &built.plant;
    let mut gathered = params.model.clone();
    gathered.blade.gathered = true;
    let times = alternating(
        || drop(black_box(build(plant, &gathered))),
        || drop(black_box(build(plant, &gathered).flattened())),
    );
    let (copies, flat) = (&built.model, built.model.flattened());
    println!("oak of {age} years, {} triangles", flat.triangle_count());
    row("plant to model, µs", times.map(|time| time.as_micros() as u64));
    row("memory of meshes, bytes", [memory(copies), memory(&flat)]);
    row("to the graphics card, bytes", [uploaded(copies), uploaded(&flat)]);
    let scene =
        |model| Scene::new(model, (plant, &built.provenance), &built_in_texture, Cow::Borrowed("oak"));
    let glb = format_of(Path::new("oak.glb")).unwrap();
    let whole = glb.encode(&scene(copies).unwrap()).unwrap().bytes.len() as u64;
    let instanced = InstancedModel::from(copies);
    for form in [InstanceForm::Nodes, InstanceForm::Gpu] {
        let scene = scene(&instanced.model).unwrap().with_instances(&instanced.groups, form).unwrap();
        let bytes = glb.encode(&scene).unwrap().bytes.len() as u64;
        row(&format!("GLB with {form:?}, bytes"), [bytes, whole]);
    }
}

fn row(what: &str, [copies, triangles]: [u64; 2]) {
    println!("{what:30} {copies:>12} {triangles:>12}  {:.2}", copies as f64 / triangles as f64);
}

/// The middle times of two things that take turns.
fn alternating(one: impl Fn(), other: impl Fn()) -> [Duration; 2] {
    let timed = |run: &dyn Fn()| {
        let begun = Instant::now();
        run();
        begun.elapsed()
    };
    let mut times: [Vec<Duration>; 2] = Default::default();
    for _ in 0..ROUNDS {
        times[0].push(timed(&one));
        times[1].push(timed(&other));
    }
    times.map(|mut times| {
        times.sort();
        times[ROUNDS / 2]
    })
}

fn memory(model: &Model) -> u64 {
    let mesh = |mesh: &Mesh| {
        12 * mesh.points.len() + size_of::<Vertex>() * mesh.vertices.len() + 12 * mesh.triangles.len()
    };
    let of_parts = model.parts.iter().map(|part| {
        let copies = part.copies.as_ref().map_or(0, |copies| {
            let shapes: usize = copies.shapes.iter().map(|shape| mesh(shape)).sum();
            shapes + size_of::<Placement>() * copies.placements.len()
        });
        mesh(&part.mesh) + copies
    });
    of_parts.sum::<usize>() as u64
}

fn uploaded(model: &Model) -> u64 {
    let renderer = Renderer::new().unwrap();
    let mut view = Viewport::new(&renderer).unwrap();
    let textures = |texture: &Texture| Ok(fetch(texture, &built_in_texture)?);
    view.update(&renderer, model, &textures).unwrap().bytes
}
