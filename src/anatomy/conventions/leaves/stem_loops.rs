//! Leaves that are loops in the stroke of their stem: the hand runs up, out around a leaf, back, and on.
//!
//! Along the stroke, wherever it comes back to a place where it was and what lies between encloses enough ([`loops`]), that is a leaf
//! and is taken out. What is left must be nearly straight: the stem. A single loop at the end of a line is a leaf on its stalk,
//! which [`leaf`](super::leaf) reads. Limits: leaves whose loops do not close are not found.

use crate::anatomy::conventions::page::Page;
use crate::anatomy::conventions::shapes::{lobes, loops};
use crate::anatomy::conventions::{Hypothesis, Made};
use crate::geom::polyline;
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Least length of a loop, as a share of the line's.
const LOOP: f32 = 0.1;
/// Most loops.
const MOST: usize = 8;
/// Least chord of the stem over its length, and least length, as a share of the longest loop's.
const STRAIGHT: f32 = 0.85;
const LONG: f32 = 0.5;
/// Least part of the stem on either side of a single loop.
const MIDST: f32 = 0.12;

/// Proposes a stem with leaves for each line that has loops on a straight way.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    out.extend((0..page.lines.len()).filter_map(|i| stem(page, i)));
}

fn stem(page: &Page, number: usize) -> Option<Hypothesis> {
    let line = &page.lines[number];
    let (loops, way) = loops::taken_apart(line, LOOP);
    let length = polyline::length(&way);
    let longest = loops.iter().map(|points| polyline::length(points)).fold(0.0, f32::max);
    let is_straight = way[0].distance(way[way.len() - 1]) > STRAIGHT * length && length > LONG * longest;
    if loops.is_empty() || loops.len() > MOST || !is_straight {
        return None;
    }
    let share = |points: &Vec<Vec2>| way[0].distance(points[0]) / length;
    if loops.len() == 1 && !(MIDST..1.0 - MIDST).contains(&share(&loops[0])) {
        return None;
    }
    let leaves = loops.iter().map(|points| Made::new(Tool::Leaf, lobes::rooted(points, points[0])));
    let parts = std::iter::once(Made::new(Tool::Branch, way.iter().copied())).chain(leaves).collect();
    let score = 2.2 * page.weight(line.size().length());
    Some(Hypothesis {
        uses: vec![number],
        score,
        parts,
        solids: Vec::new(),
        reading: Reading::Leaf,
        habit: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(drawn: Vec<Vec2>) -> Vec<Hypothesis> {
        let mut out = Vec::new();
        propose(&Page::of_lines(&[drawn]), &mut out);
        out
    }

    #[test]
    fn loops_on_a_stem_are_leaves_and_the_way_without_them_is_the_stem() {
        let circle = |middle: Vec2, from: f32| {
            (0..=40).map(move |k| {
                middle + 30.0 * Vec2::from_angle(from + std::f32::consts::TAU * k as f32 / 40.0)
            })
        };
        let mut drawn = vec![Vec2::new(0.0, 200.0)];
        drawn.extend(circle(Vec2::new(30.0, 130.0), std::f32::consts::PI));
        drawn.extend(circle(Vec2::new(-30.0, 90.0), 0.0));
        drawn.push(Vec2::ZERO);
        let found = read(drawn);
        let tools: Vec<Tool> = found[0].parts.iter().map(|part| part.tool).collect();
        assert_eq!(tools, [Tool::Branch, Tool::Leaf, Tool::Leaf]);
        assert!(found[0].parts.iter().skip(1).all(|leaf| leaf.points[0].position.x.abs() < 12.0));
        assert!(found[0].parts[0].points.iter().all(|p| p.position.x.abs() < 12.0));
    }

    #[test]
    fn a_loop_at_the_end_and_a_line_without_loops_are_none() {
        assert!(read(vec![Vec2::new(0.0, 200.0), Vec2::ZERO]).is_empty());
        let mut lasso = vec![Vec2::new(0.0, 200.0)];
        lasso.extend(
            (0..=40).map(|k| 40.0 * Vec2::from_angle(1.57 + std::f32::consts::TAU * k as f32 / 40.0)),
        );
        assert!(read(lasso).is_empty());
    }
}
