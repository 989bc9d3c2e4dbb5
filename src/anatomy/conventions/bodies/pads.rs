//! Prickly pears: oval pads, each an outline of its own, that stand on one another's upper edges.
//!
//! The lowest pad stands on the ground; every other one touches a lower pad, its own lower part on the upper part of that one. Each becomes a
//! branch as thick as it is wide, which begins in the pad that carries it. Lines in pads and ticks across their edges are spines.
//!
//! Petals around a centre stand beside it and below, as well; circles of a bush stand side by side on the ground.
//!
//! Limits: fewer than three pads; pads that hang.

use super::swollen;
use crate::anatomy::conventions::page::{Line, Page, bounds};
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::sketch::{Reading, StrokePoint};
use glam::Vec2;
use std::f32::consts::FRAC_PI_4;

/// Fewest and most pads, and most lines of a group.
const PADS: (usize, usize) = (3, 24);
const MOST_LINES: usize = 200;
/// Largest opening of a pad, narrower over wider side of its bounds, and the share of the ellipse there that its hull fills: a pad may lean.
const OPEN: f32 = 0.25;
const NARROW: f32 = 0.4;
const FILL: (f32, f32) = (0.75, 1.15);
/// Smallest pad, as a share of the drawing's diagonal, and of the largest one's size.
const SMALLEST: f32 = 0.06;
const ALIKE: f32 = 0.3;
/// How far a pad is from the one that carries it at most, as a share of its size, and least cosine between straight down and the way from its
/// middle to where it touches, and straight up and the way there from the other's middle.
const GAP: f32 = 0.15;
const BELOW: f32 = 0.25;
const ABOVE: f32 = 0.1;
/// Most pads that touch one: petals around a centre are more.
const TOUCHING: usize = 4;
/// Least share of what is drawn that the pads' outlines are.
const MOSTLY: f32 = 0.65;
/// How far into the pad below a pad's branch begins, and how thick it is there, as shares of its own half width.
const INTO: f32 = 0.5;
const NECK: f32 = 0.35;
/// Log-odds, and more for each pad up to so many.
const SCORE: (f32, f32, usize) = (4.4, 0.2, 8);

/// Proposes a prickly pear for each group of pads.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    out.extend(page.groups.iter().chain(&page.wide_groups).filter_map(|group| pear(page, group)));
}

/// A pad and how it stands on another.
struct Pad<'a> {
    number: usize,
    line: &'a Line,
    /// The place among the pads of that which carries it, and where it touches that; nothing for the lowest.
    on: Option<(usize, Vec2)>,
}

fn pear(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    if group.len() > MOST_LINES {
        return None;
    }
    let largest = group.iter().map(|i| page.lines[*i].size().max_element()).fold(0.0, f32::max);
    let is_large = |line: &Line| {
        let size = line.size().max_element();
        size > SMALLEST * page.diagonal && size > ALIKE * largest
    };
    let (pads, others): (Vec<usize>, Vec<usize>) =
        group.iter().partition(|i| is_pad(&page.lines[**i]) && is_large(&page.lines[**i]));
    let length = |lines: &[usize]| lines.iter().map(|i| page.lines[*i].length).sum::<f32>();
    if !(PADS.0..=PADS.1).contains(&pads.len()) || length(&pads) < MOSTLY * length(group) {
        return None;
    }
    let pads = stacked(page, &pads)?;
    let is_spine = |i: &usize| page.lines[*i].size().max_element() < 0.5 * largest;
    if !others.iter().all(is_spine) {
        return None;
    }
    let parts = pads.iter().map(|pad| branch(pad, &pads)).collect::<Option<Vec<Made>>>()?;
    let score = SCORE.0 + SCORE.1 * pads.len().min(SCORE.2) as f32;
    let (low, high) = bounds(pads.iter().map(|pad| pad.line));
    Some(Hypothesis {
        uses: group.to_vec(),
        score: score * page.weight(low.distance(high)),
        parts,
        solids: Vec::new(),
        reading: Reading::Cactus,
        habit: Some(Habit::Succulent),
    })
}

/// Whether a line is an oval.
fn is_pad(line: &Line) -> bool {
    let size = line.size();
    let fill = line.hull_area / (FRAC_PI_4 * size.x * size.y).max(f32::MIN_POSITIVE);
    line.openness < OPEN
        && line.solidity() > 0.85
        && size.min_element() > NARROW * size.max_element()
        && (FILL.0..FILL.1).contains(&fill)
        && !line.is_scribble()
}

/// The pads from the lowest up, each with the one that carries it; nothing unless all but the lowest stand on another.
fn stacked<'a>(page: &'a Page, numbers: &[usize]) -> Option<Vec<Pad<'a>>> {
    let mut order: Vec<usize> = numbers.to_vec();
    let middle = |i: usize| page.lines[i].middle().y;
    order.sort_by(|a, b| middle(*b).total_cmp(&middle(*a)).then(a.cmp(b)));
    let touching = |a: &Line, b: &Line| {
        let most = GAP * a.size().max_element();
        let apart = (a.bounds.0 - b.bounds.1).max(b.bounds.0 - a.bounds.1).max_element();
        if apart > most { None } else { touch(a, b).filter(|(_, gap)| *gap < most) }
    };
    let mut pads: Vec<Pad> = Vec::new();
    for number in order {
        let line = &page.lines[number];
        let on = pads.iter().enumerate().filter_map(|(k, below)| {
            let (place, gap) = touching(line, below.line)?;
            stands_on(line, below.line, place).then_some((k, place, gap))
        });
        let on = on.min_by(|a, b| a.2.total_cmp(&b.2)).map(|(k, place, _)| (k, place));
        let is_lowest = pads.is_empty();
        // What stands beside the lowest stands on the ground as well.
        let is_above = pads
            .first()
            .is_none_or(|first| line.bounds.1.y < first.line.bounds.1.y - 0.25 * first.line.size().y);
        if !is_lowest && (on.is_none() || !is_above) {
            return None;
        }
        pads.push(Pad { number, line, on });
    }
    let neighbours = |pad: &Pad| {
        pads.iter()
            .filter(|other| other.number != pad.number && touching(other.line, pad.line).is_some())
            .count()
    };
    pads.iter().all(|pad| neighbours(pad) <= TOUCHING).then_some(pads)
}

/// Where two lines are nearest, between both, and how near.
fn touch(a: &Line, b: &Line) -> Option<(Vec2, f32)> {
    let pairs = a.points.iter().flat_map(|p| b.points.iter().map(move |q| (p.midpoint(*q), p.distance(*q))));
    pairs.min_by(|p, q| p.1.total_cmp(&q.1))
}

/// Whether a pad that touches another there stands on it.
fn stands_on(pad: &Line, below: &Line, place: Vec2) -> bool {
    let down = (place - pad.middle()).normalize_or_zero().y;
    let up = -(place - below.middle()).normalize_or_zero().y;
    down > BELOW && up > ABOVE
}

/// The branch that a pad is, from within the pad that carries it to its farthest point.
fn branch(pad: &Pad, pads: &[Pad]) -> Option<Made> {
    let line = pad.line;
    let foot = Vec2::new(line.middle().x, line.bounds.1.y);
    let root = pad.on.map_or(foot, |(_, place)| place);
    let tip = line
        .points
        .iter()
        .copied()
        .max_by(|a, b| a.distance_squared(root).total_cmp(&b.distance_squared(root)))?;
    let mut made = swollen::branch(&line.points, root, tip)?;
    if let (Some((below, place)), Some(half)) = (pad.on, made.half_width) {
        let into = (pads[below].line.middle() - place).normalize_or_zero();
        let begin = StrokePoint { pressure: NECK, ..StrokePoint::at(place + INTO * half * into) };
        made.points.insert(0, begin);
    }
    Some(made)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::{line, read_by};
    use std::f32::consts::TAU;

    fn oval(x: f32, y: f32, half: (f32, f32), lean: f32) -> Vec<Vec2> {
        let place = |k: usize| {
            let at = Vec2::from(half) * Vec2::from_angle(TAU * k as f32 / 60.0);
            Vec2::new(x, y) + Vec2::from_angle(lean).rotate(at)
        };
        (0..=60).map(place).collect()
    }

    fn pear() -> Vec<Vec<Vec2>> {
        vec![
            oval(0.0, 0.0, (45.0, 62.0), 0.0),
            oval(-45.0, -95.0, (30.0, 45.0), -0.5),
            oval(45.0, -95.0, (30.0, 45.0), 0.5),
            oval(-75.0, -165.0, (20.0, 32.0), -0.3),
        ]
    }

    #[test]
    fn pads_on_pads_are_swollen_branches_that_begin_in_the_one_below() {
        let found = read_by(propose, &pear());
        assert!(!found.is_empty());
        assert_eq!((found[0].reading, found[0].parts.len()), (Reading::Cactus, 4));
        let begins = |k: usize| found[0].parts[k].points[0].position;
        assert!(found[0].parts.iter().all(|part| part.half_width.is_some()));
        let in_lowest = (begins(1) / Vec2::new(45.0, 62.0)).length();
        assert!(in_lowest < 1.0, "{in_lowest}");
    }

    #[test]
    fn petals_and_rows_and_a_crown_on_a_trunk_are_none() {
        let petals: Vec<Vec<Vec2>> = (0..6)
            .map(|k| TAU * k as f32 / 6.0)
            .map(|a| oval(60.0 * a.cos(), 60.0 * a.sin(), (28.0, 28.0), 0.0))
            .chain([oval(0.0, 0.0, (28.0, 28.0), 0.0)])
            .collect();
        assert!(read_by(propose, &petals).is_empty());
        let row: Vec<Vec<Vec2>> = (0..3).map(|k| oval(80.0 * k as f32, 0.0, (42.0, 50.0), 0.0)).collect();
        assert!(read_by(propose, &row).is_empty());
        let mut tree = pear();
        tree.push(line(&[(0.0, 60.0), (0.0, 200.0)]));
        assert!(read_by(propose, &tree).is_empty());
    }
}
