//! Leaves whose one edge is the stem: arcs that leave a stem and come back to it.
//!
//! A hand draws a leaf at a stem as a bow from the stem out and back, and takes the stem for its other side, or its midrib. Such an
//! arc has both ends at one nearly straight, longer line ([`AT`]), lies on one side of it and bulges; the leaf is what lies between the arc
//! and the stem, its root the lower end. Two arcs or more on one stem, or one beside other blades, are leaves; a single arc at a
//! line alone may be anything. Two arcs that leave the stem a little apart and meet at their other ends are both sides of one leaf, which the
//! stem closes.
//!
//! Limits: arcs at a stem that bends much are not found; a cactus' arm has one end at its body.

use crate::anatomy::conventions::page::{Line, Page};
use crate::anatomy::conventions::{Hypothesis, Made};
use crate::geom::polyline;
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Farthest distance of an arc's ends from the stem, as a share of its chord.
const AT: f32 = 0.15;
/// Least and most distance of an arc from its chord, as a share of the chord.
const BULGE: (f32, f32) = (0.15, 1.2);
/// Longest chord of an arc, as a share of the stem's, and the least chord of a stem over its length.
const SHORT: f32 = 0.6;
const STRAIGHT: f32 = 0.8;
/// Most of an arc's points beyond the stem's line on the other side.
const BEYOND: f32 = 0.1;
/// Fewest arcs on one stem, and most.
const ARCS: (usize, usize) = (2, 24);
/// Of two arcs that are a leaf: most distance of their ends from the stem, as a share of an arc's chord, and from each other at the tip and at
/// the stem; least and most width of the leaf, as a share of its length; least length of one arc, as a share of the other's.
const SIDES: (f32, f32, f32) = (0.15, 0.12, 0.45);
const WIDTH: (f32, f32) = (0.2, 1.0);
const EVEN: f32 = 0.6;
/// Log-odds of each, and of a leaf of two: one with its midrib is known better by others.
const SCORE: f32 = 1.5;
const SCORE_OF_TWO: f32 = 1.2;
/// So many leaves of two on one stem, and log-odds of each: no twigs of a bare tree meet in pairs.
const MANY_OF_TWO: (usize, f32) = (3, 3.0);

/// Proposes leaves for the arcs at each stem.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let chord = |line: &Line| line.ends().0.distance(line.ends().1);
    let is_stem = |i: &usize| chord(&page.lines[*i]) > STRAIGHT * page.lines[*i].length;
    let stems: Vec<usize> = (0..page.lines.len()).filter(|i| is_stem(i) && !page.is_apart(*i)).collect();
    // Edges of leaves may begin beside their stem.
    let grown = |line: &Line| {
        let margin = Vec2::splat(SIDES.0 * SHORT * chord(line));
        (line.bounds.0 - margin, line.bounds.1 + margin)
    };
    let boxes: Vec<(Vec2, Vec2)> = stems.iter().map(|i| grown(&page.lines[*i])).collect();
    for (&stem, near) in stems.iter().zip(page.lines_at(&boxes)) {
        leaves_of_two(page, stem, &near, out);
        let arcs: Vec<usize> =
            near.into_iter().filter(|i| *i != stem && is_arc(&page.lines[*i], &page.lines[stem])).collect();
        if (ARCS.0..=ARCS.1).contains(&arcs.len()) {
            out.extend(arcs.into_iter().map(|arc| leaf(page, arc)));
        }
    }
}

/// Whether a line leaves a stem and comes back to it.
fn is_arc(line: &Line, stem: &Line) -> bool {
    let (first, last) = line.ends();
    let chord = first.distance(last);
    let (foot, tip) = stem.ends();
    let long = foot.distance(tip);
    if chord > SHORT * long || line.openness < 0.25 || line.is_scribble() {
        return false;
    }
    let away = |p: Vec2| polyline::nearest(&stem.points, p).map_or(f32::INFINITY, |(distance, _)| distance);
    let deep = depths(line);
    let bulge = deep.iter().fold(0.0_f32, |most, depth| if depth.abs() > most.abs() { *depth } else { most });
    let beyond = deep.iter().filter(|depth| **depth * bulge.signum() < -0.05).count();
    (BULGE.0..BULGE.1).contains(&bulge.abs())
        && (beyond as f32) < BEYOND * deep.len() as f32
        && away(first).max(away(last)) < AT * chord
        && along(line, stem) > 0.7
}

/// A line from the stem to the tip of a leaf.
struct Side {
    number: usize,
    points: Vec<Vec2>,
}

impl Side {
    /// The side that a line is: one of its ends is at the stem, the other away from it.
    fn of(page: &Page, number: usize, stem: &Line) -> Option<Self> {
        let line = &page.lines[number];
        let (first, last) = line.ends();
        let (chord, long) = (first.distance(last), stem.ends().0.distance(stem.ends().1));
        let away = |p: Vec2| polyline::nearest(&stem.points, p).map_or(f32::INFINITY, |(gap, _)| gap);
        let is_at = |p: Vec2| away(p) < SIDES.0 * chord;
        let is_one = chord < SHORT * long && chord > 0.6 * line.length;
        if !is_one || is_at(first) == is_at(last) {
            return None;
        }
        let mut points = line.points.clone();
        if is_at(last) {
            points.reverse();
        }
        Some(Self { number, points })
    }

    fn foot(&self) -> Vec2 {
        self.points[0]
    }

    fn tip(&self) -> Vec2 {
        self.points[self.points.len() - 1]
    }

    fn length(&self) -> f32 {
        self.foot().distance(self.tip())
    }

    /// How far it bulges from the line through two places at most, to the left and to the right of it.
    fn bulge(&self, foot: Vec2, tip: Vec2) -> f32 {
        let way = (tip - foot).normalize_or_zero();
        let aside = self.points.iter().map(|p| way.perp_dot(*p - foot));
        aside.fold(0.0, |most: f32, aside| if aside.abs() > most.abs() { aside } else { most })
    }
}

/// Proposes leaves whose two sides are arcs that leave the stem apart from each other.
fn leaves_of_two(page: &Page, stem: usize, near: &[usize], out: &mut Vec<Hypothesis>) {
    let line = &page.lines[stem];
    let sides: Vec<Side> =
        near.iter().filter(|i| **i != stem).filter_map(|i| Side::of(page, *i, line)).take(ARCS.1).collect();
    let mut is_used = vec![false; sides.len()];
    let mut pairs = Vec::new();
    for a in 0..sides.len() {
        let fits = |b: &usize| !is_used[*b] && is_leaf_of(&sides[a], &sides[*b]);
        let Some(b) = (a + 1..sides.len()).find(fits).filter(|_| !is_used[a]) else { continue };
        (is_used[a], is_used[b]) = (true, true);
        pairs.push((&sides[a], &sides[b]));
    }
    let score = if pairs.len() < MANY_OF_TWO.0 { SCORE_OF_TWO } else { MANY_OF_TWO.1 };
    out.extend(pairs.into_iter().map(|pair| leaf_of_two(page, pair, line, score)));
}

/// Whether two sides meet at a tip, stand apart on the stem and bulge away from each other.
fn is_leaf_of(a: &Side, b: &Side) -> bool {
    let (short, long) = (a.length().min(b.length()), a.length().max(b.length()));
    let (foot, tip) = (a.foot().midpoint(b.foot()), a.tip().midpoint(b.tip()));
    let (left, right) = (a.bulge(foot, tip), b.bulge(foot, tip));
    let width = (left - right).abs() / foot.distance(tip).max(f32::MIN_POSITIVE);
    short > EVEN * long
        && a.tip().distance(b.tip()) < SIDES.1 * long
        && a.foot().distance(b.foot()) < SIDES.2 * short
        && left * right < 0.0
        && (WIDTH.0..WIDTH.1).contains(&width)
}

fn leaf_of_two(page: &Page, (a, b): (&Side, &Side), stem: &Line, score: f32) -> Hypothesis {
    let between = a.foot().midpoint(b.foot());
    let root = polyline::nearest(&stem.points, between).map_or(between, |(_, arc)| {
        let arcs = polyline::arc_lengths(stem.points.iter().copied());
        polyline::interpolate(&stem.points, polyline::locate(&arcs, arc))
    });
    let outline: Vec<Vec2> = [root]
        .into_iter()
        .chain(a.points.iter().copied())
        .chain(b.points.iter().rev().copied())
        .chain([root])
        .collect();
    let mut uses = vec![a.number, b.number];
    uses.sort_unstable();
    Hypothesis {
        uses,
        score: score * page.weight(2.0 * a.length().max(b.length())),
        parts: vec![Made::new(Tool::Leaf, outline)],
        solids: Vec::new(),
        reading: Reading::Leaf,
        habit: None,
    }
}

/// How far each point of a line is from its chord, with the side, as a share of the chord.
fn depths(line: &Line) -> Vec<f32> {
    let (first, last) = line.ends();
    let chord = last - first;
    let square = chord.length_squared().max(f32::MIN_POSITIVE);
    line.points.iter().map(|p| chord.perp_dot(*p - first) / square).collect()
}

/// Cosine between an arc's chord and its stem's.
fn along(line: &Line, stem: &Line) -> f32 {
    let direction = |line: &Line| (line.ends().1 - line.ends().0).normalize_or_zero();
    direction(line).dot(direction(stem)).abs()
}

fn leaf(page: &Page, arc: usize) -> Hypothesis {
    let line = &page.lines[arc];
    let mut points = line.upward();
    points.push(points[0]);
    Hypothesis {
        uses: vec![arc],
        score: SCORE * page.weight(2.0 * line.size().length()),
        parts: vec![Made::new(Tool::Leaf, points)],
        solids: Vec::new(),
        reading: Reading::Leaf,
        habit: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bow(x: f32, low: f32, high: f32) -> Vec<Vec2> {
        let place = |t: f32| Vec2::new(x * (std::f32::consts::PI * t).sin(), low + (high - low) * t);
        (0..=30).map(|k| place(k as f32 / 30.0)).collect()
    }

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    #[test]
    fn bows_at_a_stem_are_leaves_that_grow_from_their_lower_ends() {
        let stem = vec![Vec2::new(0.0, 100.0), Vec2::new(0.0, -100.0)];
        let found = read(&[stem, bow(30.0, 60.0, 10.0), bow(-25.0, -20.0, 30.0)]);
        assert_eq!(found.len(), 2);
        for (leaf, low) in found.iter().zip([60.0, 30.0]) {
            assert_eq!(leaf.parts[0].tool, Tool::Leaf);
            assert!(leaf.parts[0].points[0].position.distance(Vec2::new(0.0, low)) < 1.0);
        }
    }

    #[test]
    fn two_arcs_that_leave_a_stem_apart_and_meet_are_one_leaf_of_it() {
        let stem = vec![Vec2::new(0.0, 100.0), Vec2::new(0.0, -100.0)];
        let arc = |from: Vec2, by: Vec2| {
            let (to, along) = (Vec2::new(80.0, -30.0), |t: f32| (std::f32::consts::PI * t).sin());
            (0..=30).map(|k| k as f32 / 30.0).map(|t| from.lerp(to, t) + by * along(t)).collect::<Vec<_>>()
        };
        let (upper, lower) = (
            arc(Vec2::new(0.0, -2.0), Vec2::new(-8.0, -14.0)),
            arc(Vec2::new(0.0, 14.0), Vec2::new(8.0, 14.0)),
        );
        let found = read(&[stem.clone(), upper.clone(), lower]);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].uses, [1, 2]);
        let root = found[0].parts[0].points[0].position;
        assert!(root.distance(Vec2::new(0.0, 6.0)) < 3.0, "on the stem: {root}");
        let far = arc(Vec2::new(0.0, 60.0), Vec2::new(8.0, 14.0));
        assert!(read(&[stem, upper, far]).is_empty(), "two twigs that meet");
    }

    #[test]
    fn several_leaves_of_two_arcs_are_likelier_than_twigs() {
        let stem = vec![Vec2::new(0.0, 100.0), Vec2::new(0.0, -200.0)];
        let arc = |y: f32, by: f32| {
            let along =
                |t: f32| Vec2::new(7.0 + 75.0 * t, y - 40.0 * t + by * (std::f32::consts::PI * t).sin());
            (0..=30).map(|k| along(k as f32 / 30.0)).collect::<Vec<_>>()
        };
        let leaves = |count: usize| {
            let sides = (0..count).flat_map(|k| [-12.0, 12.0].map(|by| arc(60.0 - 70.0 * k as f32, by)));
            read(&std::iter::once(stem.clone()).chain(sides).collect::<Vec<_>>())
        };
        assert_eq!((leaves(2).len(), leaves(3).len()), (2, 3));
        assert!(leaves(3)[0].score > 2.0 * leaves(2)[0].score);
    }

    #[test]
    fn one_bow_alone_twigs_and_waves_are_none() {
        let stem = vec![Vec2::new(0.0, 100.0), Vec2::new(0.0, -100.0)];
        assert!(read(&[stem.clone(), bow(30.0, 60.0, 10.0)]).is_empty());
        let twig = |y: f32| vec![Vec2::new(0.0, y), Vec2::new(30.0, y - 20.0), Vec2::new(45.0, y - 50.0)];
        assert!(read(&[stem.clone(), twig(60.0), twig(0.0)]).is_empty());
        let wave =
            |y: f32| (0..=40).map(|k| Vec2::new(15.0 * (0.157 * k as f32).sin(), y + k as f32)).collect();
        assert!(read(&[stem, wave(-60.0), wave(20.0)]).is_empty());
    }
}
