//! Plants drawn by people look from the front like the crowns and bodies that they drew.

#![allow(clippy::unwrap_used, reason = "a failure here is a failed test")]

use crate::crowns;
use crate::people::{Drawing, Share, drawings};
use glam::Vec2;
use penstemon::model::PartKind;
use penstemon::pipeline::{self, Built};
use penstemon::plant::OrganKind;
use penstemon::sketch::{Reading, Stroke};
use rayon::prelude::*;
use std::path::Path;
use std::sync::Arc;

/// Cells along one side of the raster on which bodies are compared.
const CELLS: usize = 120;

fn build(drawing: &Drawing) -> Built {
    let species = pipeline::species_of(&drawing.sketch, Path::new("")).unwrap();
    let params = pipeline::params_of(&drawing.sketch, &species, &[]).unwrap();
    pipeline::build(&drawing.sketch, &species, &params)
}

/// What `measure` says of the drawings of these classes that may be looked at, those first that agree least.
fn measured(classes: &[&str], measure: impl Fn(&Drawing) -> Option<f32> + Sync) -> Vec<(f32, String)> {
    let shares = [Share::Development, Share::Opened, Share::Added];
    let all: Vec<Drawing> = shares.iter().flat_map(|share| drawings(*share).unwrap()).collect();
    let of = |drawing: &Drawing| Some((measure(drawing)?, format!("{} {}", drawing.class, drawing.name)));
    let wanted = |drawing: &&Drawing| classes.contains(&drawing.class.as_str());
    let mut found: Vec<_> = all.par_iter().filter(wanted).filter_map(of).collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found
}

/// How many of these agree less than that, and who.
fn below(found: &[(f32, String)], least: f32) -> &[(f32, String)] {
    &found[..found.partition_point(|(share, _)| *share < least)]
}

#[test]
fn trees_and_bushes_fill_the_crowns_that_were_drawn() {
    let found = measured(&["broccoli", "bush", "tree"], |drawing| {
        let built = build(drawing);
        (!built.anatomy.crowns.is_empty()).then(|| crowns::agreement(&built).0)
    });
    let few = below(&found, 0.8);
    assert!(found.len() > 60 && few.len() <= 2, "{few:?} of {}", found.len());
}

#[test]
fn cacti_and_mushrooms_fill_the_bodies_that_were_drawn() {
    let found = measured(&["cactus", "mushroom"], |drawing| {
        let built = build(drawing);
        let is_body = |reading: Reading| matches!(reading, Reading::Cactus | Reading::Mushroom);
        let together = built.anatomy.readings.iter().find(|read| is_body(read.reading))?.strokes.clone();
        let drawn = drawing.sketch.strokes.iter().filter(|stroke| together.contains(&stroke.id));
        agreement(&built, drawn)
    });
    let few = below(&found, 0.8);
    assert!(found.len() > 20 && few.len() <= 5, "{few:?} of {}", found.len());
    assert!(found[0].0 > 0.5, "{few:?}");
}

/// Intersection over union of stems with their caps and what strokes enclose together with the ground between their lowest ends; none where
/// that is little more than the strokes themselves.
fn agreement<'a>(built: &Built, drawn: impl Iterator<Item = &'a Arc<Stroke>>) -> Option<f32> {
    let points =
        |stroke: &Arc<Stroke>| stroke.points.iter().map(|point| point.position).collect::<Vec<Vec2>>();
    let mut lines: Vec<Vec<Vec2>> = drawn.map(points).collect();
    let all = || lines.iter().flatten().copied();
    let (low, high) = (all().reduce(Vec2::min)?, all().reduce(Vec2::max)?);
    let ends = lines.iter().flat_map(|line| [line[0], line[line.len() - 1]]);
    let mut feet: Vec<Vec2> = ends.filter(|end| high.y - end.y < FOOT * (high.y - low.y)).collect();
    feet.sort_by(|a, b| a.x.total_cmp(&b.x));
    lines.push(feet);
    let cell = 1.2 * (high - low).max_element() / CELLS as f32;
    let low = low.midpoint(high) - 0.5 * cell * CELLS as f32;
    let inside = enclosed(&lines, low, cell);
    let covered = body(built, low, cell);
    let count = |of: &dyn Fn(bool, bool) -> bool| {
        inside.iter().zip(&covered).filter(|(inside, covered)| of(**inside, **covered)).count() as f32
    };
    let ink =
        lines.iter().flat_map(|line| line.windows(2)).map(|pair| pair[0].distance(pair[1])).sum::<f32>();
    let is_area = count(&|inside, _| inside) > 3.0 * ink / cell;
    is_area.then(|| count(&|inside, covered| inside && covered) / count(&|inside, covered| inside || covered))
}

/// How high above the lowest point ends of strokes stand on the ground, as a share of the height.
const FOOT: f32 = 0.15;
/// Cells by which lines are thickened, so that small gaps are closed.
const THICK: i32 = 2;

/// The cells that cannot be reached from outside around the thickened lines, thickened back.
fn enclosed(lines: &[Vec<Vec2>], low: Vec2, cell: f32) -> Vec<bool> {
    let near = |from: &[bool]| -> Vec<bool> {
        let at = |x: i32, y: i32| {
            let is_in = (0..CELLS as i32).contains(&x) && (0..CELLS as i32).contains(&y);
            is_in && from[y as usize * CELLS + x as usize]
        };
        let around = || (-THICK..=THICK).flat_map(|y| (-THICK..=THICK).map(move |x| (x, y)));
        let round = || around().filter(|(x, y)| x * x + y * y <= THICK * THICK);
        let place = |k: usize| ((k % CELLS) as i32, (k / CELLS) as i32);
        (0..CELLS * CELLS).map(|k| round().any(|(x, y)| at(place(k).0 + x, place(k).1 + y))).collect()
    };
    let mut ink = vec![false; CELLS * CELLS];
    for pair in lines.iter().flat_map(|line| line.windows(2)) {
        let steps = (2.0 * pair[0].distance(pair[1]) / cell).ceil().max(1.0);
        for k in 0..=steps as usize {
            let at = ((pair[0].lerp(pair[1], k as f32 / steps) - low) / cell).as_ivec2();
            ink[at.y as usize * CELLS + at.x as usize] = true;
        }
    }
    let wall = near(&ink);
    let (mut outside, mut open) = (vec![false; CELLS * CELLS], vec![0]);
    while let Some(k) = open.pop() {
        if !outside[k] && !wall[k] {
            outside[k] = true;
            let beside = [(k % CELLS > 0, k.wrapping_sub(1)), (k % CELLS < CELLS - 1, k + 1)];
            let over = [(k >= CELLS, k.wrapping_sub(CELLS)), (k + CELLS < CELLS * CELLS, k + CELLS)];
            open.extend(beside.into_iter().chain(over).filter(|(is_in, _)| *is_in).map(|(_, k)| k));
        }
    }
    near(&outside).into_iter().map(|outside| !outside).collect()
}

/// The cells of the canvas that wood and the caps of mushrooms, which are fruits, cover from the front.
fn body(built: &Built, low: Vec2, cell: f32) -> Vec<bool> {
    let mut covered = vec![false; CELLS * CELLS];
    let place = |p: Vec2| ((p - low) / cell).clamp(Vec2::ZERO, Vec2::splat(CELLS as f32 - 1.0));
    let is_body = |kind| matches!(kind, PartKind::Wood | PartKind::Organ(OrganKind::Fruit));
    for part in built.model.parts.iter().filter(|part| is_body(part.kind)) {
        for triangle in &part.mesh.triangles {
            let corners = part.mesh.corners(*triangle).map(|p| built.provenance.world_from_canvas.canvas(p));
            let (a, b) = (
                place(corners[0].min(corners[1]).min(corners[2])),
                place(corners[0].max(corners[1]).max(corners[2])),
            );
            let sides = [0, 1, 2].map(|k| (corners[k], corners[(k + 1) % 3] - corners[k]));
            for y in a.y as usize..=b.y as usize {
                for x in a.x as usize..=b.x as usize {
                    let middle = low + (Vec2::new(x as f32, y as f32) + 0.5) * cell;
                    let turns = sides.map(|(corner, side)| side.perp_dot(middle - corner));
                    let is_in =
                        turns.iter().all(|turn| *turn >= 0.0) || turns.iter().all(|turn| *turn <= 0.0);
                    covered[y * CELLS + x] |= is_in;
                }
            }
        }
    }
    covered
}
