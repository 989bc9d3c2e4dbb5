//! A leaf of several strokes, or of one with its stalk: outline, midrib, veins.
//!
//! Outlines come from one stroke or two ([`blade`](super::blade)), or are what a group of lines encloses ([`leaf_area`](super::leaf_area));
//! what lies in and at them is sorted in [`leaf_parts`](super::leaf_parts). The model draws veins of its own, so drawn ones only
//! say where the leaf's base is.
//!
//! What speaks for a leaf is a midrib along most of it with veins that begin there; a crown has lobes all around, a disc or a face
//! has something round inside, a body has spines that are short. A blade with lobes is a leaf if a midrib runs through it and on as a
//! stalk, and its lobes are no rounder than its notches. A plain closed outline is one leaf as it is: no hypothesis.
//!
//! Limits: an outline inside of another is not understood.

use super::blade::{self, Blade};
use super::leaf_area::{has_lobes_of_a_leaf, of_group};
use super::leaf_parts::{AT, Parts};
use crate::anatomy::conventions::page::Page;
use crate::anatomy::conventions::shapes::lobes::{self, Focus};
use crate::anatomy::conventions::{Hypothesis, Made};
use crate::geom::simple_loop;
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Least share of its hull that a blade fills, and that one with lobes fills.
const SOLID: (f32, f32) = (0.75, 0.45);
/// Most of its bounds that a blade fills: an ellipse fills 0.79, a pot more, as do window frames, which have bars like midribs.
const BOX: (f32, f32) = (0.85, 0.8);
/// Most lobes around the middle of a blade, and around one with a midrib that goes on as a stalk.
const LOBES: (usize, usize) = (4, 12);
/// Most lines that are looked at in one outline.
const MOST_LINES: usize = 64;
/// More log-odds of a blade with lobes, which looks like a corolla without its midrib.
const LOBED: f32 = 0.8;

/// Proposes a leaf for each outline that has more than itself.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let of_one = (0..page.lines.len()).filter_map(|i| blade::of_one(i, &page.lines[i]));
    let mut blades: Vec<Blade> = of_one.chain(blade::of_two(page)).collect();
    blades.extend(page.groups.iter().filter_map(|group| of_group(page, group)));
    let grown = |blade: &Blade| {
        let ((low, high), margin) = (blade.bounds(), Vec2::splat(AT * blade.diagonal()));
        (low - margin, high + margin)
    };
    let boxes: Vec<(Vec2, Vec2)> = blades.iter().map(grown).collect();
    let near = page.lines_at(&boxes);
    let begin = out.len();
    for found in blades.iter().zip(near).filter_map(|(blade, near)| leaf(page, blade, &near)) {
        // What one or two strokes draw needs no contour of an area.
        if !out[begin..].iter().any(|other| other.uses == found.uses) {
            out.push(found);
        }
    }
}

fn leaf(page: &Page, blade: &Blade, near: &[usize]) -> Option<Hypothesis> {
    let (solidity, lobes) = (blade.solidity(), lobes_of(blade));
    if near.len() > MOST_LINES || solidity < SOLID.1 || lobes > LOBES.1 {
        return None;
    }
    let is_lobed = solidity < SOLID.0 || lobes > LOBES.0;
    let size = blade.bounds().1 - blade.bounds().0;
    let boxy = if blade.is_whole { BOX.1 } else { BOX.0 };
    if simple_loop::area(&blade.ring) > boxy * size.x * size.y {
        return None;
    }
    let parts = Parts::of(page, blade, near)?;
    let is_plain = parts.inside.is_empty() && parts.stalks.is_empty() && blade.lines.len() == 1;
    let is_odd = is_lobed && !parts.speak_for_lobes();
    if is_plain || parts.stalks.len() > 1 || is_odd || !has_lobes_of_a_leaf(page, blade) {
        return None;
    }
    let is_leaf = parts.has_midrib() || (blade.is_lens && (parts.inside.is_empty() || parts.has_stem()));
    let is_in_crown = |i: &usize| near.iter().any(|k| page.lines[*k].is_around(&page.lines[*i]));
    if !is_leaf || (!parts.has_midrib() && blade.lines.iter().any(is_in_crown)) {
        return None;
    }
    if blade.is_whole && !(parts.has_midrib() && parts.explain(&group_of(page, blade))) {
        return None;
    }
    let mut ring = blade.ring.clone();
    ring.rotate_left(blade.nearest(parts.root()).0);
    ring.push(ring[0]);
    let mut made = vec![Made::new(Tool::Leaf, ring)];
    made.extend(parts.stalk().map(|points| Made::new(Tool::Branch, points)));
    let mut uses: Vec<usize> = blade.lines.iter().chain(&parts.inside).copied().collect();
    uses.sort_unstable();
    let score = (parts.score() + if is_lobed { LOBED } else { 0.0 }) * page.weight(parts.diagonal);
    Some(Hypothesis { uses, score, parts: made, solids: Vec::new(), reading: Reading::Leaf, habit: None })
}

/// The lines that touch a blade, directly or through others.
fn group_of(page: &Page, blade: &Blade) -> Vec<usize> {
    let is_own = |group: &&Vec<usize>| blade.lines.first().is_some_and(|i| group.binary_search(i).is_ok());
    page.groups.iter().find(is_own).cloned().unwrap_or_default()
}

/// How many lobes an outline has around its middle.
fn lobes_of(blade: &Blade) -> usize {
    let (low, high) = blade.bounds();
    let focus = Focus { place: low.midpoint(high), half: 0.5 * (high - low) };
    let mut closed = blade.ring.clone();
    closed.push(closed[0]);
    lobes::cut(&closed, &focus, true).len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;
    use std::f32::consts::{PI, TAU};

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    /// A blade from (0, 0) up to (0, -100), begun at its side.
    fn outline() -> Vec<Vec2> {
        let place = |k: usize| {
            let (angle, pointed) = (TAU * k as f32 / 100.0, |y: f32| 1.0 - (y / 50.0).powi(2));
            let y = 50.0 * angle.sin();
            Vec2::new(30.0 * angle.cos().signum() * pointed(y), y - 50.0)
        };
        (0..=100).map(place).collect()
    }

    fn leaf(found: &[Hypothesis]) -> &Hypothesis {
        let best = found.iter().max_by(|a, b| a.score.total_cmp(&b.score)).unwrap();
        assert_eq!(best.parts[0].tool, Tool::Leaf);
        best
    }

    #[test]
    fn midrib_and_veins_are_the_leafs_and_what_sticks_out_is_its_stalk() {
        let midrib = line(&[(0.0, 60.0), (0.0, -80.0)]);
        let veins = [line(&[(0.0, -30.0), (15.0, -40.0)]), line(&[(0.0, -50.0), (-15.0, -60.0)])];
        let found = read(&[outline(), midrib, veins[0].clone(), veins[1].clone()]);
        let leaf = leaf(&found);
        assert_eq!(leaf.uses, [0, 1, 2, 3]);
        assert!(leaf.parts[0].points[0].position.length() < 6.0, "the root is where the stalk is");
        let [_, stalk] = &leaf.parts[..] else { panic!("{} parts", leaf.parts.len()) };
        assert_eq!(stalk.tool, Tool::Branch);
        assert!(stalk.points.iter().all(|p| p.position.y > -6.0) && stalk.points[0].position.y > 55.0);
    }

    #[test]
    fn the_root_of_a_blade_without_a_stalk_is_where_its_midrib_begins() {
        for (from, to) in [(-5.0, -70.0), (-70.0, -5.0)] {
            let found = read(&[outline(), line(&[(1.0, from), (0.0, to)])]);
            assert!(leaf(&found).parts[0].points[0].position.length() < 6.0);
        }
    }

    #[test]
    fn stalk_and_blade_in_one_stroke_are_cut() {
        let mut drawn = line(&[(-5.0, 70.0)]);
        let (right, left): (Vec<Vec2>, Vec<Vec2>) = outline().into_iter().partition(|p| p.x > 0.0);
        let sorted = |mut side: Vec<Vec2>, up: f32| {
            side.sort_by(|a, b| (up * a.y).total_cmp(&(up * b.y)));
            side
        };
        drawn.extend(sorted(right, -1.0));
        drawn.extend(sorted(left, 1.0));
        let found = read(&[drawn]);
        let tools: Vec<Tool> = leaf(&found).parts.iter().map(|part| part.tool).collect();
        assert_eq!(tools, [Tool::Leaf, Tool::Branch]);
    }

    #[test]
    fn plain_leaves_crowns_faces_and_pots_are_none() {
        assert!(read(&[outline()]).is_empty());
        assert!(
            read(&[outline(), line(&[(0.0, 100.0), (0.0, 0.0)])]).is_empty(),
            "a stem below changes nothing"
        );
        let cloud: Vec<Vec2> = (0..=200)
            .map(|k| TAU * k as f32 / 200.0)
            .map(|angle| (40.0 + 15.0 * (4.0 * angle).sin().abs()) * Vec2::from_angle(angle))
            .collect();
        assert!(read(&[cloud, line(&[(0.0, 100.0), (0.0, -20.0)])]).is_empty());
        let eye: Vec<Vec2> =
            (0..=30).map(|k| Vec2::new(0.0, -50.0) + 8.0 * Vec2::from_angle(TAU * k as f32 / 30.0)).collect();
        assert!(read(&[outline(), line(&[(0.0, 60.0), (0.0, -80.0)]), eye]).is_empty());
        let pot = line(&[(-30.0, 0.0), (-30.0, 60.0), (30.0, 60.0), (30.0, 0.0), (-30.0, 0.0)]);
        assert!(read(&[pot, line(&[(0.0, -100.0), (0.0, 50.0)])]).is_empty());
    }

    /// One side of a leaf from (0, 0) up to (0, -100), `gap` pixels from the other at the foot.
    fn side(sign: f32, gap: f32) -> Vec<Vec2> {
        let place = |t: f32| Vec2::new(sign * (120.0 * t * (1.0 - t) + 0.5 * gap * (1.0 - t)), -100.0 * t);
        (0..=40).map(|k| place(k as f32 / 40.0)).collect()
    }

    fn back(mut points: Vec<Vec2>) -> Vec<Vec2> {
        points.reverse();
        points
    }

    fn midrib() -> Vec<Vec2> {
        line(&[(0.0, 45.0), (0.0, -85.0)])
    }

    #[test]
    fn an_outline_that_is_open_at_its_foot_is_closed_where_the_stalk_passes() {
        let arcs = [side(-1.0, 24.0), side(1.0, 24.0)];
        let in_one = [side(-1.0, 40.0), back(side(1.0, 40.0))].concat();
        for outline in [arcs.to_vec(), vec![in_one]] {
            let with = |others: Vec<Vec<Vec2>>| read(&[outline.clone(), others].concat());
            let tools: Vec<Tool> = leaf(&with(vec![midrib()])).parts.iter().map(|part| part.tool).collect();
            assert_eq!(tools, [Tool::Leaf, Tool::Branch]);
            assert!(with(Vec::new()).is_empty(), "nothing passes the gap");
        }
    }

    #[test]
    fn an_outline_in_four_strokes_is_one_blade() {
        let (left, right) = (side(-1.0, 0.0), side(1.0, 0.0));
        let pieces = [&left[..22], &left[20..], &right[..18], &right[19..]].map(<[Vec2]>::to_vec);
        let found = read(&[pieces.to_vec(), vec![midrib()]].concat());
        let leaf = leaf(&found);
        assert_eq!(leaf.uses, [0, 1, 2, 3, 4]);
        let drawn: Vec<Vec2> = leaf.parts[0].points.iter().map(|p| p.position).collect();
        assert!((simple_loop::area(&drawn) / 4000.0 - 1.0).abs() < 0.1, "{}", simple_loop::area(&drawn));
        assert!(drawn[0].length() < 8.0, "{}", drawn[0]);
    }

    #[test]
    fn two_halves_with_one_midrib_are_one_leaf() {
        let half = [side(-1.0, 0.0), line(&[(0.0, -100.0), (0.0, 0.0)])].concat();
        let found = read(&[half, back(side(1.0, 0.0)), line(&[(0.0, -40.0), (20.0, -55.0)])]);
        let whole = found.iter().max_by(|a, b| a.score.total_cmp(&b.score)).unwrap();
        assert_eq!(whole.uses, [0, 1, 2]);
        assert!(whole.parts[0].points[0].position.length() < 8.0);
    }

    #[test]
    fn midrib_and_stalk_may_follow_the_outline_in_its_stroke_or_be_two_lines() {
        let outline = [side(-1.0, 0.0), back(side(1.0, 0.0))].concat();
        let stroke = [back(side(-1.0, 0.0)), side(1.0, 0.0), line(&[(0.0, -100.0), (0.0, 40.0)])].concat();
        let double = line(&[(-3.0, 50.0), (-2.0, -70.0), (2.0, -70.0), (3.0, 50.0)]);
        for drawn in [vec![stroke], vec![outline, double]] {
            let found = read(&drawn);
            let [blade, stalk] = &leaf(&found).parts[..] else { panic!("no stalk") };
            assert!(blade.points[0].position.length() < 8.0, "{}", blade.points[0].position);
            assert!(stalk.points.iter().all(|p| p.position.x.abs() < 3.0 && p.position.y > -8.0));
        }
    }

    #[test]
    fn veins_at_a_midrib_speak_for_a_leaf() {
        let vein = |y: f32| line(&[(0.0, y), (18.0, y - 10.0)]);
        let apart = |y: f32| line(&[(10.0, y), (18.0, y - 10.0)]);
        let with = |vein: &dyn Fn(f32) -> Vec<Vec2>| {
            leaf(&read(&[outline(), midrib(), vein(-30.0), vein(-45.0), vein(-60.0)])).score
        };
        assert!(with(&vein) > with(&apart) + 0.5);
    }

    #[test]
    fn a_line_along_the_outline_is_no_midrib() {
        let mut ground = line(&[(-25.0, -20.0), (-29.0, -50.0), (-25.0, -80.0)]);
        ground.iter_mut().for_each(|p| p.x += 4.0);
        let found = read(&[outline(), ground]);
        assert!(found.iter().all(|leaf| leaf.score < 3.0), "{found:?}");
        assert!(leaf(&read(&[outline(), midrib()])).score > 3.0);
    }

    #[test]
    fn lobes_as_sharp_as_their_notches_are_a_leafs_and_round_ones_a_crowns() {
        let ring = |reach: fn(f32) -> f32| -> Vec<Vec2> {
            let turn = |k: usize| 1.75 + 5.93 * k as f32 / 240.0;
            let place = |k: usize| reach((5.0 * k as f32 / 240.0).fract()) * Vec2::from_angle(turn(k));
            (0..=240).map(|k| place(k) - 50.0 * Vec2::Y).collect()
        };
        let (pointed, round) =
            (ring(|t| 62.0 - 52.0 * (t - 0.5).abs()), ring(|t| 40.0 + 22.0 * (PI * t).sin()));
        let ribs = || vec![line(&[(0.0, 60.0), (0.0, -80.0)]), line(&[(0.0, -30.0), (25.0, -55.0)])];
        assert_eq!(leaf(&read(&[vec![pointed], ribs()].concat())).uses, [0, 1, 2]);
        assert!(read(&[vec![round], ribs()].concat()).is_empty());
    }
}
