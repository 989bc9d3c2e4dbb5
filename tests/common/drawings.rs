//! Synthetic drawings of any size, for tests and benches.

#![allow(dead_code, reason = "each user takes some of them")]

use glam::{Quat, Vec2, Vec3};
use penstemon::sketch::{Canvas, Sketch, Stroke, StrokePoint, Tool};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::sync::Arc;

/// A drawing from strokes given as a tool and positions.
pub(crate) fn sketch(strokes: impl IntoIterator<Item = (Tool, Vec<Vec2>)>) -> Sketch {
    let strokes = strokes.into_iter().zip(1..).map(|((tool, points), id)| {
        let points = points.into_iter().map(StrokePoint::at).collect();
        Stroke { id, tool, points, brush: None }
    });
    let canvas = Canvas { width: 1024.0, height: 768.0 };
    Sketch { canvas, strokes: strokes.map(Arc::new).collect(), ..Sketch::empty() }
}

/// The same drawing at another size.
pub(crate) fn scaled(sketch: &Sketch, factor: f32) -> Sketch {
    let mut scaled = sketch.clone();
    for point in scaled.strokes.iter_mut().flat_map(|s| &mut Arc::make_mut(s).points) {
        point.position *= factor;
    }
    for plant in &mut scaled.plants {
        plant.foot *= factor;
        plant.height = plant.height.map(|height| height * factor);
    }
    scaled
}

/// A straight-ish stroke with a bend to one side.
pub(crate) fn curve(from: Vec2, to: Vec2, bend: f32) -> Vec<Vec2> {
    let side = (to - from).perp() * bend;
    (0..=40).map(|k| k as f32 / 40.0).map(|t| from.lerp(to, t) + side * (4.0 * t * (1.0 - t))).collect()
}

/// A pointed blade from root to tip and back.
pub(crate) fn blade(root: Vec2, tip: Vec2, width: f32) -> Vec<Vec2> {
    let side = (tip - root).perp() * 0.5 * width;
    let half = |t: f32| side * (std::f32::consts::PI * t).sin();
    let out = (0..=30).map(|k| k as f32 / 30.0).map(|t| root.lerp(tip, t) + half(t));
    let back = (0..30).rev().map(|k| k as f32 / 30.0).map(|t| root.lerp(tip, t) - half(t));
    out.chain(back).collect()
}

/// Petals on a cone, projected straight onto the sheet. `axis` in world directions (y up), `opening` in radians.
pub(crate) fn cone_flower(
    center: Vec2,
    axis: Vec3,
    opening: f32,
    slant: f32,
    petals: usize,
) -> Vec<Vec<Vec2>> {
    let across = axis.any_orthonormal_vector();
    let half_width = 0.8 * std::f32::consts::PI / petals as f32;
    let on_cone = |s: f32, around: f32| {
        let out = Quat::from_axis_angle(axis, around) * across;
        let p = s * slant * (axis * opening.cos() + out * opening.sin());
        center + Vec2::new(p.x, -p.y)
    };
    (0..petals)
        .map(|k| {
            let middle = k as f32 / petals as f32 * std::f32::consts::TAU;
            let edge =
                |s: f32, side: f32| on_cone(s, middle + side * half_width * (std::f32::consts::PI * s).sin());
            let there = (0..=30).map(|i| i as f32 / 30.0).map(|s| edge(s, 1.0));
            let back = (0..30).rev().map(|i| i as f32 / 30.0).map(|s| edge(s, -1.0));
            there.chain(back).collect()
        })
        .collect()
}

/// A field of herbs, each a stem, a flower of eight petals and two leaves, until there are `strokes` strokes.
pub(crate) fn meadow(strokes: usize) -> Sketch {
    let columns = ((strokes as f32 / 11.0).sqrt().ceil() as usize).max(1);
    let herb = |i: usize| {
        let foot = Vec2::new((i % columns) as f32 * 220.0, (i / columns) as f32 * 420.0 + 400.0);
        let center = foot + Vec2::new(10.0, -300.0);
        let axis = Vec3::new(0.2, 0.6, 0.77).normalize();
        let mut drawn = vec![(Tool::Auto, curve(foot, center, 0.05))];
        drawn.extend(cone_flower(center, axis, 1.0, 60.0, 8).into_iter().map(|p| (Tool::Auto, p)));
        for (side, up) in [(-1.0, 80.0), (1.0, 140.0)] {
            let root = foot + Vec2::new(3.0, -up);
            drawn.push((Tool::Auto, blade(root, root + Vec2::new(side * 90.0, -30.0), 0.4)));
        }
        drawn
    };
    sketch((0..).flat_map(herb).take(strokes))
}

/// A tree whose leaf outline asks for about `leaves` leaves.
pub(crate) fn leafy_tree(leaves: usize) -> Sketch {
    let mut strokes = vec![(Tool::Branch, curve(Vec2::new(500.0, 1000.0), Vec2::new(500.0, 120.0), 0.02))];
    for k in 0..12 {
        let side = if k % 2 == 0 { 1.0 } else { -1.0 };
        let from = Vec2::new(500.0, 800.0 - 50.0 * k as f32);
        strokes.push((Tool::Branch, curve(from, from + Vec2::new(side * 320.0, -160.0), 0.1)));
    }
    let crown =
        |k: usize| Vec2::new(500.0, 450.0) + Vec2::from_angle(k as f32 * 0.0982) * Vec2::new(430.0, 420.0);
    strokes.push((Tool::BranchOutline, (0..64).map(crown).collect()));
    strokes.push((Tool::LeafOutline, (0..64).map(crown).collect()));
    let mut tree = sketch(strokes);
    let length = (1.4 / (leaves as f64).sqrt()).clamp(0.002, 0.3);
    tree.params.insert("anatomy.leaf_fill.default_length".into(), length.into());
    tree.params.insert("anatomy.leaf_fill.max_leaves".into(), (2 * leaves).into());
    tree
}

/// What a calm hand draws, anywhere on the sheet: bent branches and blades of petals, each said to be one.
pub(crate) fn gentle(seed: u64, branches: usize, petals: usize) -> Sketch {
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let mut reach = |least: f32, most: f32| {
        let from = Vec2::new(rng.random_range(0.0..1000.0), rng.random_range(0.0..800.0));
        let way = Vec2::from_angle(rng.random_range(0.0..6.3)) * rng.random_range(least..most);
        (from, from + way, rng.random_range(0.0..1.0f32))
    };
    let mut strokes = Vec::new();
    for _ in 0..branches {
        let (from, to, share) = reach(150.0, 500.0);
        strokes.push((Tool::Branch, curve(from, to, 0.6 * share - 0.3)));
    }
    for _ in 0..petals {
        let (root, tip, share) = reach(60.0, 200.0);
        strokes.push((Tool::Petal, blade(root, tip, 0.2 + 0.6 * share)));
    }
    sketch(strokes)
}

/// Anything a hand might do: wild strokes with every tool.
pub(crate) fn scribble(seed: u64, strokes: usize) -> Sketch {
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let mut stroke = |_| {
        let tool = Tool::ALL[rng.random_range(0..Tool::ALL.len())];
        let count = [1, 2, 3, 8, 40][rng.random_range(0..5)];
        let step = [0.0, 1.0, 20.0, 150.0][rng.random_range(0..4)];
        let mut at = Vec2::new(rng.random_range(0.0..1000.0), rng.random_range(0.0..800.0));
        let mut heading: f32 = rng.random_range(0.0..6.3);
        let turn: f32 = rng.random_range(-1.0..1.0);
        let walk = (0..count).map(|_| {
            heading += turn + rng.random_range(-0.3..0.3f32);
            at += step * Vec2::from_angle(heading);
            at
        });
        (tool, walk.collect())
    };
    let mut drawn = sketch((0..strokes).map(&mut stroke));
    // Crowns are filled with few and large leaves.
    drawn.params.insert("growth.fineness".into(), 0.4.into());
    for point in drawn.strokes.iter_mut().flat_map(|s| &mut Arc::make_mut(s).points) {
        point.pressure = rng.random_range(0.0..=1.0);
        point.tilt_deg = Vec2::new(rng.random_range(-90.0..90.0), rng.random_range(-90.0..90.0));
    }
    drawn
}
