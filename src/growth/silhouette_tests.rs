//! Plants that fill drawn outlines: from the front they cover the outline and nothing else.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use super::*;
use crate::geom::region::Region;
use crate::plant::{Plant, Shape};
use glam::{Vec2, Vec3};
use std::f32::consts::TAU;
use std::sync::Arc;

/// Cells along one side of the raster on which silhouettes are compared.
const CELLS: usize = 120;

fn ring(count: usize, at: impl Fn(f32) -> Vec2) -> Vec<Vec2> {
    (0..count).map(|k| at(k as f32 / count as f32 * TAU)).collect()
}

fn mirrored(right: &[(f32, f32)]) -> Vec<Vec2> {
    let left = right.iter().rev().map(|&(x, y)| Vec2::new(-x, y));
    right.iter().map(|&(x, y)| Vec2::new(x, y)).chain(left).collect()
}

fn outlines() -> Vec<(&'static str, Vec<Vec<Vec2>>)> {
    let circle = |radius: f32| ring(48, move |t| Vec2::from_angle(t) * radius + Vec2::Y * 3.0);
    let heart = ring(60, |t| {
        let y = 13.0 * t.cos() - 5.0 * (2.0 * t).cos() - 2.0 * (3.0 * t).cos() - (4.0 * t).cos();
        Vec2::new(16.0 * t.sin().powi(3), y + 20.0) * 0.15
    });
    let cloud = ring(90, |t| {
        Vec2::new(3.0 * t.cos(), 1.6 * t.sin() + 3.4) + Vec2::from_angle(t) * 0.4 * (5.0 * t).sin().abs()
    });
    let goblet =
        mirrored(&[(1.2, 0.4), (1.2, 0.8), (0.5, 1.1), (0.5, 2.3), (1.3, 3.0), (1.7, 4.0), (1.6, 5.2)]);
    let head = [(1.0, 2.9), (1.3, 3.5), (1.1, 4.1), (1.0, 5.4), (0.9, 6.2), (0.4, 6.2), (0.25, 4.5)];
    let rabbit = mirrored(&[&[(1.2, 0.6), (1.8, 1.4), (1.6, 2.4)][..], &head[..]].concat());
    vec![
        ("heart", vec![heart]),
        ("cloud", vec![cloud]),
        ("goblet", vec![goblet]),
        ("rabbit", vec![rabbit]),
        ("ring", vec![circle(2.6), circle(1.1)]),
    ]
}

/// Marks the cells that leaves and wood cover from the front.
fn drawn(plant: &Plant, low: Vec2, cell: f32) -> Vec<bool> {
    let mut covered = vec![false; CELLS * CELLS];
    let place = |p: Vec2| ((p - low) / cell).clamp(Vec2::ZERO, Vec2::splat(CELLS as f32 - 1.0));
    for organ in &plant.organs {
        let Shape::Blade(blade) = &organ.shape else { continue };
        let leaf = Region::new(blade.outline.iter().map(|uv| blade.at_rest(*uv).truncate()).collect());
        let (a, b) = leaf.bounds().unwrap_or_default();
        for y in place(a).y as usize..=place(b).y as usize {
            for x in place(a).x as usize..=place(b).x as usize {
                covered[y * CELLS + x] |= leaf.contains(low + (Vec2::new(x as f32, y as f32) + 0.5) * cell);
            }
        }
    }
    for branch in plant.branches.iter().filter(|b| b.level > 0) {
        for p in &branch.points {
            let at = place(p.truncate());
            covered[at.y as usize * CELLS + at.x as usize] = true;
        }
    }
    covered
}

#[test]
fn the_front_of_a_plant_in_a_drawn_outline_is_the_outline() {
    for (name, outline) in outlines() {
        let volume = Arc::new(Inflated::new(outline, 1.0).unwrap());
        let (low, high): (Vec3, Vec3) = volume.bounds();
        let cell = (high - low).truncate().max_element() * 1.1 / CELLS as f32;
        let low = low.midpoint(high).truncate() - 0.5 * cell * CELLS as f32;
        let habit = Habit::default();
        let mut simulation =
            Simulation::in_envelope(&habit, Envelope::Inflated(volume.clone()), 4, Limits::default());
        simulation.grow_to(60, &|| false);
        simulation.check_envelope().unwrap();
        let covered = drawn(&plant_at(&simulation, 60.0), low, cell);
        let (mut both, mut either) = (0, 0);
        for (k, covered) in covered.into_iter().enumerate() {
            let middle = low + (Vec2::new((k % CELLS) as f32, (k / CELLS) as f32) + 0.5) * cell;
            let wanted = volume.covers(middle);
            both += usize::from(covered && wanted);
            either += usize::from(covered || wanted);
        }
        let share = both as f32 / either as f32;
        assert!(share >= 0.85, "{name}: intersection over union {share}");
    }
}
