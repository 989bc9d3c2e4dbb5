//! Heads in a row that are flowers, and what only looks like them.

use super::*;
use crate::anatomy::conventions::beneath::{ground, pot};
use crate::anatomy::conventions::{line, read_above, read_by};
use std::f32::consts::TAU;

fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
    read_by(propose, lines)
}

fn on_ground(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
    read_above(ground::propose, propose, lines)
}

fn best(found: &[Hypothesis]) -> f32 {
    found.iter().map(|flower| flower.score).fold(f32::NEG_INFINITY, f32::max)
}

fn stem(x: f32, height: f32) -> Vec<Vec2> {
    line(&[(x, 0.0), (x + 3.0, -height)])
}

/// Around a place, from below, so many turns.
fn ring(x: f32, y: f32, radius: f32, turns: f32) -> Vec<Vec2> {
    let angle = |k: usize| 0.25 * TAU + turns * TAU * k as f32 / 60.0;
    (0..=60).map(|k| Vec2::new(x, y) + radius * Vec2::from_angle(angle(k))).collect()
}

/// Outward, so many turns.
fn spiral(x: f32, y: f32, radius: f32, turns: f32) -> Vec<Vec2> {
    let place = |k: usize| Vec2::from_angle(0.25 * TAU + turns * TAU * k as f32 / 120.0) * k as f32 / 120.0;
    (0..=120).map(|k| Vec2::new(x, y) + radius * place(k)).collect()
}

fn earth() -> Vec<Vec2> {
    line(&[(-80.0, 2.0), (250.0, 6.0), (620.0, 1.0)])
}

#[test]
fn open_heads_spirals_and_rays_in_a_row_are_flowers_each_of_the_strokes_of_its_head() {
    let rays = (0..4).map(|k| Vec2::from_angle(0.3 + 0.125 * TAU * k as f32) * 30.0);
    let rays = rays.map(|ray| vec![Vec2::new(500.0, -150.0) - ray, Vec2::new(500.0, -150.0) + ray]);
    let mut drawn = vec![stem(100.0, 130.0), ring(102.0, -160.0, 30.0, 0.8), stem(300.0, 150.0)];
    drawn.extend([spiral(302.0, -180.0, 32.0, 2.4), stem(498.0, 140.0)]);
    drawn.extend(rays);
    drawn.push(earth());
    let mut found = on_ground(&drawn);
    found.sort_by_key(|flower| flower.uses[0]);
    let uses: Vec<&[usize]> = found.iter().map(|flower| &flower.uses[..]).collect();
    assert_eq!(uses, [&[1][..], &[3], &[5, 6, 7, 8]]);
    assert!(found.iter().all(|flower| flower.score > 2.5 && flower.habit == Some(Habit::Flower)));
    assert_eq!(found[2].parts.len(), 8, "a petal along each half of a ray");
}

#[test]
fn stem_and_head_in_one_stroke_are_cut_whichever_is_drawn_first() {
    let flower = |x: f32| [stem(x, 130.0), ring(x + 3.0, -162.0, 32.0, 1.0)].concat();
    let mut late = flower(300.0);
    late.reverse();
    let found = read(&[flower(100.0), late]);
    assert_eq!(found.len(), 2);
    for (flower, x) in found.iter().zip([100.0, 300.0]) {
        let stem = flower.parts.last().unwrap();
        assert_eq!(stem.tool, Tool::Branch);
        assert!(stem.points[0].position.distance(Vec2::new(x, 0.0)) < 3.0, "from its foot");
        assert!(stem.points.iter().all(|p| p.position.y > -140.0), "to its head");
    }
}

#[test]
fn each_flower_speaks_for_the_others_and_so_does_the_ground() {
    let flower = |x: f32| [stem(x, 130.0), ring(x + 3.0, -162.0, 32.0, 0.8)];
    let [one, two, four] =
        [1, 2, 4].map(|n| (0..n).flat_map(|k| flower(150.0 * k as f32)).collect::<Vec<_>>());
    assert!(read(&one).is_empty());
    assert!(best(&read(&two)) < best(&read(&four)));
    assert!(best(&read(&two)) < best(&on_ground(&[two.clone(), vec![earth()]].concat())));
    let bare = [one, vec![stem(150.0, 120.0), stem(300.0, 140.0), earth()]].concat();
    assert_eq!(on_ground(&bare).len(), 1, "beside bare stems");
}

#[test]
fn trunks_arches_pots_and_what_grows_in_an_outline_speak_against() {
    let two_lines = |x: f32| [stem(x - 8.0, 130.0), stem(x + 8.0, 130.0), ring(x, -170.0, 45.0, 0.95)];
    assert!(read(&[two_lines(0.0), two_lines(200.0)].concat()).is_empty(), "trees");
    let arch = |x: f32| {
        line(&[(x, 0.0), (x + 5.0, -90.0), (x + 40.0, -120.0), (x + 75.0, -80.0), (x + 80.0, -30.0)])
    };
    assert!(read(&[arch(0.0), arch(120.0), arch(240.0)]).is_empty(), "a fence");
    let flower = |x: f32| [stem(x, 130.0), ring(x + 3.0, -162.0, 32.0, 0.8)];
    let flowers = [flower(0.0), flower(90.0)].concat();
    let pot = line(&[(-30.0, -60.0), (-20.0, 60.0), (110.0, 60.0), (120.0, -60.0)]);
    let potted = read_above(pot::propose, propose, &[flowers.clone(), vec![pot]].concat());
    assert!(potted.is_empty() && !read(&flowers).is_empty());
    let outline = line(&[(-400.0, 80.0), (-400.0, -400.0), (500.0, -400.0), (500.0, 80.0), (-400.0, 80.0)]);
    assert!(read(&[flowers, vec![outline]].concat()).is_empty());
}

#[test]
fn lines_that_cross_on_a_stem_are_a_flower_even_if_it_is_the_only_one() {
    let rays = (0..4).map(|k| Vec2::from_angle(0.3 + 0.125 * TAU * k as f32) * 30.0);
    let rays = rays.map(|ray| vec![Vec2::new(100.0, -150.0) - ray, Vec2::new(100.0, -150.0) + ray]);
    let drawn: Vec<Vec<Vec2>> = std::iter::once(stem(98.0, 140.0)).chain(rays).collect();
    assert_eq!(read(&drawn).iter().map(|flower| flower.uses.len()).collect::<Vec<_>>(), [4]);
    assert!(read(&drawn[..3]).is_empty());
}

#[test]
fn in_a_pot_heads_are_flowers_if_one_of_them_shows_it() {
    let body = line(&[(40.0, 0.0), (50.0, 110.0), (140.0, 110.0), (150.0, 0.0), (40.0, 0.0)]);
    let lower = |mut drawn: Vec<Vec2>| {
        drawn.iter_mut().for_each(|p| p.y += 10.0);
        drawn
    };
    let stems = [lower(stem(70.0, 130.0)), lower(stem(120.0, 130.0))];
    let ring = ring(123.0, -145.0, 22.0, 1.0);
    let wound = [&stems[..], &[spiral(70.0, -145.0, 22.0, 2.4), ring.clone(), body.clone()]].concat();
    assert_eq!(read_above(pot::propose, propose, &wound).len(), 2);
    let leaf =
        |x: f32| line(&[(x, -122.0), (x - 18.0, -140.0), (x, -180.0), (x + 18.0, -140.0), (x, -122.0)]);
    let leaves = [&stems[..], &[leaf(71.0), leaf(123.0), body]].concat();
    assert!(read_above(pot::propose, propose, &leaves).is_empty());
}

#[test]
fn leaves_that_lean_from_stems_in_a_pot_are_no_heads() {
    let stem = |x: f32| (0..=20).map(|k| Vec2::new(x, -8.0 * k as f32)).collect::<Vec<_>>();
    // Outlines that are left open at their stems.
    let leaf = |x: f32, side: f32| {
        let at = |t: f32, wide: f32| {
            Vec2::new(x + side * (4.0 + 38.0 * t), -160.0 - 22.0 * t + wide * (3.1 * t).sin())
        };
        let out = (3..=20).map(|k| at(k as f32 / 20.0, 9.0));
        let back = (3..20).rev().map(|k| at(k as f32 / 20.0, -9.0));
        out.chain(back).collect::<Vec<_>>()
    };
    let rim = vec![Vec2::new(-60.0, 2.0), Vec2::new(60.0, 2.0)];
    let pot = [(-60.0, 2.0), (-40.0, 80.0), (40.0, 80.0), (60.0, 2.0)].map(Vec2::from).to_vec();
    let drawn = [rim, pot, stem(-30.0), stem(30.0), leaf(-30.0, -1.0), leaf(30.0, 1.0)];
    let found = read_above(pot::propose, propose, &drawn);
    assert!(found.is_empty(), "{found:?}");
}
