//! Grass at the foot of something else: short lines side by side on the lowest level of a drawing.
//!
//! [`grass`](super::grass) asks that its blades are most of what is drawn. Below a large flower or beside a tree a hand draws a row of
//! short strokes. They are straight, upright, low beside the drawing, several, spread out, and their feet are at one level, the
//! lowest. Each becomes a blade.
//!
//! Limits: fewer than [`FEWEST`] strokes are twigs; so are strokes that carry something.

use super::grass::upright_blades;
use crate::anatomy::conventions::page::{Line, Page};
use crate::anatomy::conventions::{Habit, Hypothesis};
use crate::geom::polyline;
use crate::sketch::Reading;

/// Fewest blades, and most: more short strokes are hatching, or grass by itself.
const FEWEST: usize = 4;
const MOST: usize = 100;
/// Least chord of a blade over its length, least rise over its run, greatest height as a share of the drawing's.
const STRAIGHT: f32 = 0.85;
const UPRIGHT: f32 = 1.0;
const SHORT: f32 = 0.3;
/// How far above the lowest foot others are at most, as a share of the drawing's height.
const LEVEL: f32 = 0.12;
/// Least distance of the outer feet, as a share of the drawing's width.
const SPREAD: f32 = 0.3;
/// Most of the drawing that they are, as a share of its length: more is a lawn by itself.
const SOME: f32 = 0.6;
/// Log-odds, and for each blade up to so many.
const SCORE: (f32, f32, usize) = (1.4, 0.15, 12);

/// Distance from a line's upper end within which it carries something, as a share of its length.
const CARRIED: f32 = 0.4;

/// Whether something but blades is at the upper end of a line: a stem.
fn carries(page: &Page, number: usize, blades: &[usize]) -> bool {
    let line = &page.lines[number];
    let (first, last) = line.ends();
    let top = if first.y < last.y { first } else { last };
    let reach = CARRIED * line.length;
    let is_there = |i: usize| {
        let (low, high) = page.lines[i].bounds;
        let may_be = (low - reach).cmple(top).all() && (high + reach).cmpge(top).all();
        may_be
            && blades.binary_search(&i).is_err()
            && !page.is_apart(i)
            && polyline::nearest(&page.lines[i].points, top).is_some_and(|(gap, _)| gap < reach)
    };
    (0..page.lines.len()).any(|i| i != number && is_there(i))
}

/// Proposes the short lines at the foot of a drawing.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let height = page.bounds.1.y - page.bounds.0.y;
    let is_blade = |line: &Line| {
        let way = line.ends().1 - line.ends().0;
        way.length() > STRAIGHT * line.length
            && way.y.abs() > UPRIGHT * way.x.abs()
            && line.size().y < SHORT * height
            && line.bounds.1.y > page.bounds.1.y - 2.0 * LEVEL * height
    };
    let mut uses: Vec<usize> =
        (0..page.lines.len()).filter(|i| !page.is_apart(*i) && is_blade(&page.lines[*i])).collect();
    let foot = |line: &usize| page.lines[*line].bounds.1.y;
    let Some(lowest) = uses.iter().map(foot).reduce(f32::max) else { return };
    uses.retain(|line| foot(line) > lowest - LEVEL * height);
    if uses.len() > MOST {
        return;
    }
    let known = uses.clone();
    uses.retain(|line| !carries(page, *line, &known));
    let blades: Vec<&Line> = uses.iter().map(|line| &page.lines[*line]).collect();
    let left = blades.iter().map(|line| line.middle().x).fold(f32::INFINITY, f32::min);
    let right = blades.iter().map(|line| line.middle().x).fold(f32::NEG_INFINITY, f32::max);
    let is_spread = right - left > SPREAD * (page.bounds.1.x - page.bounds.0.x);
    let is_some = blades.iter().map(|line| line.length).sum::<f32>() < SOME * page.length;
    if uses.len() < FEWEST || !is_spread || !is_some {
        return;
    }
    let score = SCORE.0 + SCORE.1 * uses.len().min(SCORE.2) as f32;
    let parts = upright_blades(&blades);
    let (reading, habit) = (Reading::Grass, Some(Habit::Grass));
    out.push(Hypothesis { uses, score, parts, solids: Vec::new(), reading, habit });
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    fn blade(x: f32) -> Vec<Vec2> {
        vec![Vec2::new(x, 2.0), Vec2::new(x + 3.0, -28.0)]
    }

    fn flower() -> Vec<Vec<Vec2>> {
        let petal = |k: usize| Vec2::new(80.0, -170.0) + 40.0 * Vec2::from_angle(0.157 * k as f32);
        vec![vec![Vec2::new(80.0, 0.0), Vec2::new(82.0, -130.0)], (0..=40).map(petal).collect()]
    }

    #[test]
    fn short_lines_at_the_foot_of_a_flower_are_blades() {
        let drawn = [flower(), [0.0, 25.0, 60.0, 110.0, 150.0].map(blade).to_vec()].concat();
        let found = read(&drawn);
        assert_eq!(found.len(), 1);
        assert_eq!((&found[0].uses[..], found[0].parts.len()), (&[2, 3, 4, 5, 6][..], 5));
    }

    #[test]
    fn few_lines_very_many_and_stems_are_none() {
        assert!(read(&[flower(), [0.0, 25.0, 60.0].map(blade).to_vec()].concat()).is_empty());
        let row = |count: usize| (0..count).map(|k| blade(150.0 * k as f32 / count as f32)).collect();
        // So tall that the blades are some of the drawing only.
        let tall: Vec<Vec2> =
            (0..900).map(|k| Vec2::new(if k % 2 == 0 { 0.0 } else { 150.0 }, -200.0 - k as f32)).collect();
        assert_eq!(read(&[vec![tall.clone()], row(MOST)].concat()).len(), 1);
        assert!(read(&[vec![tall], row(MOST + 1)].concat()).is_empty());
        let small = |x: f32| {
            let ring = |k: usize| Vec2::new(x, -40.0) + 10.0 * Vec2::from_angle(0.157 * k as f32);
            vec![blade(x), (0..=40).map(ring).collect()]
        };
        let row: Vec<Vec<Vec2>> = [0.0, 30.0, 120.0, 160.0].into_iter().flat_map(small).collect();
        assert!(read(&[flower(), row].concat()).is_empty());
    }
}
