//! How well the whole analysis recovers the pose of flowers projected from known cones, over several hundred drawings.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

use crate::drawings;
use glam::{Vec2, Vec3};
use penstemon::pipeline;
use penstemon::sketch::Tool;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::path::Path;
use std::sync::Arc;

/// Angle in degrees between the axis drawn and the axis recovered; `noise` is a share of the drawing's diagonal.
fn error_deg(rng: &mut Pcg64Mcg, noise: f32) -> f32 {
    let elevation = rng.random_range(25f32..80.0).to_radians();
    let flat = Vec2::from_angle(rng.random_range(0.0..std::f32::consts::TAU)) * elevation.cos();
    let axis: Vec3 = flat.extend(elevation.sin());
    let opening = rng.random_range(20f32..75.0).to_radians();
    let petals = rng.random_range(5..=21);
    let drawn = drawings::cone_flower(Vec2::splat(500.0), axis, opening, 300.0, petals);
    let mut sketch = drawings::sketch(drawn.into_iter().map(|p| (Tool::Petal, p)));
    let shake = noise * sketch.diagonal();
    for point in sketch.strokes.iter_mut().flat_map(|s| &mut Arc::make_mut(s).points) {
        // Sum of uniforms: close enough to a Gaussian of standard deviation `shake`.
        let mut wobble = || (0..12).map(|_| rng.random_range(-0.5..0.5f32)).sum::<f32>();
        point.position += shake * Vec2::new(wobble(), wobble());
    }
    let species = pipeline::species_of(&sketch, Path::new("")).unwrap();
    let params = pipeline::params_of(&sketch, &species, &[]).unwrap();
    let built = pipeline::build(&sketch, &species, &params);
    built.plant.flowers[0].cone.axis.angle_between(axis).to_degrees()
}

fn median_and_95th(noise: f32) -> (f32, f32) {
    let mut rng = Pcg64Mcg::seed_from_u64(2026);
    let mut errors: Vec<f32> = (0..300).map(|_| error_deg(&mut rng, noise)).collect();
    errors.sort_by(f32::total_cmp);
    (errors[150], errors[285])
}

#[test]
fn exact_drawings_within_1_and_3_degrees() {
    let (median, p95) = median_and_95th(0.0);
    assert!(median <= 1.0 && p95 <= 3.0, "median {median}°, 95th percentile {p95}°");
}

#[test]
fn noisy_drawings_within_4_and_12_degrees() {
    let (median, p95) = median_and_95th(0.005);
    assert!(median <= 4.0 && p95 <= 12.0, "median {median}°, 95th percentile {p95}°");
}
