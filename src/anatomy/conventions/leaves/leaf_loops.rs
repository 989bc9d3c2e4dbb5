//! Several leaves in one stroke: loops that return to one place, or along a stem.
//!
//! A hand that does not lift draws leaf after leaf: out and back to the place where the stroke began or ended, or to where it
//! meets itself; or down along a stem that is another stroke. The line is cut where it comes near that place or stem; each stretch that is closed there and encloses enough is a leaf, what is open is a leaf-like line and stays
//! a branch. Five loops or more all around one place are a corolla.
//!
//! Loops within a larger outline are what fills a crown, no leaves.
//!
//! Limits: loops must not lie over one another, or it is a scribble.

use crate::anatomy::conventions::page::{Line, Page};
use crate::anatomy::conventions::shapes::lobes::{self, Focus};
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::{convex_hull::convex_hull, polyline, simple_loop};
use crate::sketch::{Reading, Tool};
use glam::Vec2;
use std::f32::consts::TAU;

/// Fewest leaves and most.
const LEAVES: (usize, usize) = (2, 12);
/// Farthest distance of a loop's ends from the place that it returns to, as a share of the line's reach from there.
const BACK: f32 = 0.4;
/// Largest opening of a loop at its foot, as a share of its reach from there.
const OPEN: f32 = 0.5;
/// The same for a loop beside others that are closed: a short leaf between long ones.
const OPEN_BESIDE: f32 = 1.0;
/// Farthest distance between two places of a line where it meets itself, as a share of the diagonal of its bounds.
const MEET: f32 = 0.05;
/// Least area of a loop, as a share of the square of its length, and where the line begins and ends elsewhere: the sides of a
/// narrow blade may cross before its tip. A lens eight times as long as wide has 0.019, one of four times 0.036.
const FAT: (f32, f32) = (0.012, 0.03);
/// Least share of its hull that a loop fills: a long leaf that bends fills little.
const SOLID: f32 = 0.33;
/// Least share of the line's length in its loops.
const MOSTLY: f32 = 0.7;
/// Most angle that loops fill together, over the angle that they fill by themselves: loops one over the other fill it twice.
const OVERLAP: f32 = 1.5;
/// Loops around one place that are a corolla, and the least angle that they fill.
const COROLLA: (usize, f32) = (5, 0.75 * TAU);
/// Least chord of a stem over its length, and its least length, as a share of the diagonal of the line beside it.
const STEM: (f32, f32) = (0.8, 0.4);
/// Farthest distance from the stem where a line returns to it, as a share of the line's diagonal.
const AT_STEM: f32 = 0.1;
/// Least distance of a leaf's tip from the stem, as a share of the leaf's length along it.
const AWAY: f32 = 0.3;
/// Largest opening of a line that is closed, and the least area of its smallest loop, as a share of the largest one's: a single
/// blade may end in a small loop.
const CLOSED: f32 = 0.25;
const EVEN: f32 = 0.35;
/// Least length of a line along a stem, over the diagonal of its bounds.
const WINDING: f32 = 1.5;
/// Most stems that one line is held against.
const MOST_STEMS: usize = 6;

/// Proposes leaves for each line that returns to one place or to a stem.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let boxes: Vec<(Vec2, Vec2)> = page.lines.iter().map(|line| line.bounds).collect();
    let near = page.lines_at(&boxes);
    let is_ornament = |i: usize| near[i].iter().any(|k| page.lines[*k].is_around(&page.lines[i]));
    let alone: Vec<usize> = (0..page.lines.len()).filter(|i| !is_ornament(*i)).collect();
    out.extend(alone.iter().filter_map(|i| at_one_place(page, *i)));
    out.extend(alone.iter().filter_map(|i| along_stems(page, *i, &near[*i])));
}

fn at_one_place(page: &Page, number: usize) -> Option<Hypothesis> {
    let line = &page.lines[number];
    let (first, last) = line.ends();
    let ends = [first, last].map(|place| (place, FAT.0));
    let meeting = own_meeting(line).map(|place| (place, FAT.1));
    let loops = ends
        .into_iter()
        .chain(meeting)
        .map(|(place, fat)| Loops::around(line, place, fat))
        .filter(|loops| loops.are_leaves(line));
    let best = loops.max_by(|a, b| a.length().total_cmp(&b.length()))?;
    let count = best.closed.len();
    let is_corolla = count >= COROLLA.0 && lobes::around(&best.closed, best.place) > COROLLA.1;
    let tool = if is_corolla { Tool::Petal } else { Tool::Leaf };
    let leaves = best.closed.iter().map(|points| Made::new(tool, lobes::rooted(points, best.root(points))));
    let parts = leaves
        .chain(best.open.iter().map(|points| Made::new(Tool::Branch, points.iter().copied())))
        .collect();
    let score = (2.8 - 2.0 * best.opening()) * page.weight(line.size().length());
    let (reading, habit) =
        if is_corolla { (Reading::Corolla, Some(Habit::Flower)) } else { (Reading::Leaf, None) };
    Some(Hypothesis { uses: vec![number], score, parts, solids: Vec::new(), reading, habit })
}

/// The loops of a line at one place, and the stretches that do not return there.
struct Loops {
    place: Vec2,
    closed: Vec<Vec<Vec2>>,
    open: Vec<Vec<Vec2>>,
}

impl Loops {
    fn around(line: &Line, place: Vec2, fat: f32) -> Self {
        let focus = Focus::round(place, 1.0);
        let reach = focus.reach(&line.points);
        let starts_there = line.ends().0.distance(place) < BACK * reach;
        let stretches = lobes::cut(&line.points, &focus, line.openness < 0.1 && !starts_there);
        let is_loop = |points: &Vec<Vec2>, most: f32| {
            let (first, last) = (points[0], points[points.len() - 1]);
            let foot = first.midpoint(last);
            let length = points.iter().map(|p| p.distance(foot)).fold(0.0, f32::max);
            let is_back = first.distance(place).max(last.distance(place)) < BACK * reach;
            is_back && first.distance(last) < most * length && is_leaf(points, fat)
        };
        let closed = stretches.iter().filter(|points| is_loop(points, OPEN)).count();
        let most = if closed >= LEAVES.0 { OPEN_BESIDE } else { OPEN };
        let (closed, open) = stretches.into_iter().partition(|points| is_loop(points, most));
        Self { place, closed, open }
    }

    /// How wide the loops are open at their feet on the average, as a share of their reach.
    fn opening(&self) -> f32 {
        let opening = |points: &Vec<Vec2>| {
            let foot = self.root(points);
            let reach = points.iter().map(|p| p.distance(foot)).fold(f32::MIN_POSITIVE, f32::max);
            2.0 * foot.distance(points[0]) / reach
        };
        self.closed.iter().map(opening).sum::<f32>() / self.closed.len().max(1) as f32
    }

    fn length(&self) -> f32 {
        self.closed.iter().map(|points| polyline::length(points)).sum()
    }

    /// Area of the smallest loop, as a share of the largest one's.
    fn evenness(&self) -> f32 {
        let areas = || self.closed.iter().map(|points| simple_loop::area(points));
        areas().fold(f32::INFINITY, f32::min) / areas().fold(f32::MIN_POSITIVE, f32::max)
    }

    /// Whether the line is little but leaves that do not lie over one another.
    fn are_leaves(&self, line: &Line) -> bool {
        let single = self
            .closed
            .iter()
            .map(|points| lobes::around(std::slice::from_ref(points), self.place))
            .sum::<f32>();
        (LEAVES.0..=LEAVES.1).contains(&self.closed.len())
            && self.length() > MOSTLY * line.length
            && self.open.len() < self.closed.len()
            && (line.openness > CLOSED || self.evenness() > EVEN)
            && single < OVERLAP * lobes::around(&self.closed, self.place)
    }

    /// The foot of a leaf.
    fn root(&self, points: &[Vec2]) -> Vec2 {
        points[0].midpoint(points[points.len() - 1])
    }
}

/// Whether an outline encloses enough and is not jagged.
fn is_leaf(points: &[Vec2], fat: f32) -> bool {
    let length = polyline::length(points) + points[0].distance(points[points.len() - 1]);
    let hull = convex_hull(points, |p| *p);
    let area = simple_loop::area(points);
    area > fat * length * length && area > SOLID * simple_loop::area(&hull)
}

/// Where a line comes nearest to itself with a good part of it on both sides, if it is hardly apart there.
fn own_meeting(line: &Line) -> Option<Vec2> {
    let points = &line.points;
    let least = points.len() / 5;
    let mut best = (MEET * line.size().length(), None);
    for i in 0..points.len() - least {
        for j in i + least..points.len().min(i + points.len() - least) {
            let gap = points[i].distance(points[j]);
            if gap < best.0 {
                best = (gap, Some(points[i].midpoint(points[j])));
            }
        }
    }
    best.1
}

/// Leaves of a line that returns to one of the lines near it again and again.
fn along_stems(page: &Page, number: usize, near: &[usize]) -> Option<Hypothesis> {
    let line = &page.lines[number];
    // A closed line is one blade, even if the stem reaches into it.
    if line.openness < CLOSED || line.length < WINDING * line.size().length() {
        return None;
    }
    let is_stem = |k: &&usize| {
        let stem = &page.lines[**k];
        let chord = stem.ends().0.distance(stem.ends().1);
        **k != number && chord > STEM.0 * stem.length && chord > STEM.1 * line.size().length()
    };
    near.iter().filter(is_stem).take(MOST_STEMS).find_map(|k| along_stem(page, number, &page.lines[*k]))
}

fn along_stem(page: &Page, number: usize, stem: &Line) -> Option<Hypothesis> {
    let line = &page.lines[number];
    let away = |p: &Vec2| polyline::nearest(&stem.points, *p).map_or(f32::INFINITY, |(distance, _)| distance);
    let distances: Vec<f32> = line.points.iter().map(away).collect();
    let at = AT_STEM * line.size().length();
    let returns: Vec<usize> = lobes::valleys(&distances).into_iter().filter(|k| distances[*k] < at).collect();
    let is_beside = |points: &Vec<Vec2>| {
        let foot = points[0].distance(points[points.len() - 1]);
        let reach = points.iter().map(away).fold(0.0, f32::max);
        away(&points[0]).max(away(&points[points.len() - 1])) < at
            && reach > AWAY * foot
            && is_leaf(points, FAT.0)
    };
    let (leaves, open): (Vec<_>, Vec<_>) =
        lobes::stretches(&line.points, &returns).into_iter().partition(is_beside);
    let length: f32 = leaves.iter().map(|points| polyline::length(points)).sum();
    if !(LEAVES.0..=LEAVES.1).contains(&leaves.len()) || length < MOSTLY * line.length {
        return None;
    }
    let score = (2.2 + 0.3 * leaves.len() as f32) * page.weight(line.size().length());
    // A leaf grows from the lower of the two places where it is at the stem.
    let lower = |points: &[Vec2]| {
        if points[0].y > points[points.len() - 1].y { points[0] } else { points[points.len() - 1] }
    };
    let parts = leaves.iter().map(|points| Made::new(Tool::Leaf, lobes::rooted(points, lower(points))));
    let parts = parts.chain(open.into_iter().map(|points| Made::new(Tool::Branch, points))).collect();
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

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    /// A leaf from the origin and back to it, `turn` away from the right.
    fn leaf(turn: f32) -> impl Iterator<Item = Vec2> {
        let place = |k: usize| {
            let angle = std::f32::consts::PI * k as f32 / 60.0;
            Vec2::new(100.0 * angle.sin(), 50.0 * (2.0 * angle).sin() * angle.sin())
        };
        (0..=60).map(move |k| Vec2::from_angle(turn).rotate(place(k)))
    }

    #[test]
    fn a_stroke_that_comes_back_twice_is_two_leaves() {
        for begin in [0, 30] {
            let mut drawn: Vec<Vec2> = leaf(-0.6).chain(leaf(-2.5).skip(1)).collect();
            drawn.pop();
            drawn.rotate_left(begin);
            drawn.push(drawn[0]);
            let found = read(&[drawn]);
            let [pair] = &found[..] else { panic!("{} hypotheses", found.len()) };
            assert_eq!(pair.parts.len(), 2);
            let root = |part: &Made| part.points[0].position;
            assert!(pair.parts.iter().all(|part| part.tool == Tool::Leaf && root(part).length() < 10.0));
        }
    }

    #[test]
    fn six_loops_around_one_place_are_a_corolla() {
        let drawn: Vec<Vec2> = (0..6).flat_map(|k| leaf(k as f32 * TAU / 6.0)).collect();
        let found = read(&[drawn]);
        assert_eq!(found[0].parts.len(), 6);
        assert!(found[0].parts.iter().all(|part| part.tool == Tool::Petal));
    }

    #[test]
    fn a_line_that_winds_along_a_stem_is_leaves_on_it() {
        let stem = vec![Vec2::new(0.0, 200.0), Vec2::new(0.0, -20.0)];
        let bow = |k: usize| {
            let t = k as f32 / 50.0;
            let away = 45.0 * (std::f32::consts::PI * t.fract()).sin();
            Vec2::new(if (t as usize).is_multiple_of(2) { away } else { -away }, 60.0 * t)
        };
        let found = read(&[stem, (0..=149).map(bow).collect()]);
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].uses.len(), found[0].parts.len()), (1, 3));
    }

    #[test]
    fn single_leaves_zigzags_and_scribbles_are_none() {
        assert!(read(&[leaf(0.3).collect()]).is_empty());
        let zigzag =
            (0..9).map(|k| Vec2::new(20.0 * k as f32, if k % 2 == 0 { 0.0 } else { -90.0 })).collect();
        assert!(read(&[zigzag]).is_empty());
        let circles = (0..=300)
            .map(|k| 60.0 * Vec2::from_angle(TAU * k as f32 / 70.0) + Vec2::new(0.05 * k as f32, 0.0));
        assert!(read(&[circles.collect()]).is_empty());
    }
}
