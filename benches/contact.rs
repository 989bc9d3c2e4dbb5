//! Wood that is turned among other wood: what taking hold of it costs, and one move of the pointer. `cargo bench --bench contact`.
//!
//! Throughput counts internodes, those that turn and those that rest. Twigs are as dense as in a crown, so the way is nearly always
//! barred.

#![allow(clippy::unwrap_used, reason = "a bench that cannot go on has failed")]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::{Quat, Vec3};
use penstemon::modelling::{OnContact, Surroundings};
use penstemon::plant::{Branch, Origin, Role, WoodPart};
use std::hint::black_box;

/// The program's own.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

/// Internodes of a branch.
const INTERNODES: usize = 25;

fn branch(parent: Option<usize>, from: Vec3, to: Vec3, radius: f32) -> Branch {
    let points: Vec<Vec3> = (0..=INTERNODES).map(|k| from.lerp(to, k as f32 / INTERNODES as f32)).collect();
    let radii = vec![radius; points.len()];
    let (origin, role) = (Origin::Generated, Role::of(WoodPart::Stem));
    Branch { origin, parent, level: u32::from(parent.is_some()), points, radii, role }
}

/// Places in a ball of radius 1, evenly and always the same.
fn in_ball(k: usize) -> Vec3 {
    let part = |prime: f32| (k as f32 * prime).fract();
    let direction = Vec3::new(part(0.618_034) - 0.5, part(0.754_878) - 0.5, part(0.569_840) - 0.5);
    direction.normalize_or_zero() * part(0.430_16).cbrt()
}

/// A bough with twigs, `moved` internodes, in a crown of `resting`.
fn crown(moved: usize, resting: usize) -> Vec<Branch> {
    let twig = |parent: Option<usize>, k: usize, middle: Vec3, wide: f32| {
        let from = middle + wide * in_ball(k);
        branch(parent, from, from + 0.5 * in_ball(7 * k + 3), 0.002)
    };
    let mut all = vec![branch(None, Vec3::ZERO, Vec3::Y * 4.0, 0.1)];
    all.push(branch(Some(0), Vec3::Y * 2.0, Vec3::new(3.0, 3.0, 0.0), 0.04));
    all.extend((0..moved / INTERNODES).map(|k| twig(Some(1), k, Vec3::new(2.0, 2.7, 0.0), 1.0)));
    all.extend((0..resting / INTERNODES).map(|k| twig(Some(0), k + 11, Vec3::new(0.0, 3.0, 0.0), 3.0)));
    all
}

fn contacts(c: &mut Criterion) {
    let mut group = c.benchmark_group("contact");
    for (moved, resting) in [(100, 1_000), (1_000, 10_000), (10_000, 100_000)] {
        let plant = crown(moved, resting);
        group.throughput(Throughput::Elements((moved + resting) as u64));
        group.bench_function(BenchmarkId::new("take hold", moved), |b| {
            b.iter(|| Surroundings::of(black_box(&plant), 1).unwrap())
        });
        let around = Surroundings::of(&plant, 1).unwrap();
        // As far as a pointer comes between two pictures.
        let to = Quat::from_rotation_y(0.02);
        for (name, on_contact) in [("stop", OnContact::Stop), ("slide", OnContact::Slide)] {
            group.bench_function(BenchmarkId::new(name, moved), |b| {
                b.iter(|| around.turn(Quat::IDENTITY, black_box(to), on_contact))
            });
        }
    }
    group.finish();
}

criterion_group!(benches, contacts);
criterion_main!(benches);
