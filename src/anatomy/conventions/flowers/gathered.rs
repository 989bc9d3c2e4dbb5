//! Petals without a drawn centre that gather at one place, drawn one by one or several in one stroke.
//!
//! A hand draws out from the middle of a flower, around a petal's tip, and back, once for each stroke or again and again. All
//! lines near a place where lines begin or end are cut there ([`lobes`](super::lobes)); what leaves that place, encloses
//! enough and comes back is a petal. Petals all around the place, of about one size and side by side, are a flower; three are
//! enough where a stem ends there. What lies between their feet, a dot or a scribble, is the centre's ornament. A stem in one
//! stroke with petals is cut off, and so are the leaves that are loops in it.
//!
//! Petals that are single strokes, closed at their foot, as in the papers, are left to the classifier. Lines that rise from the
//! place say that leaves gather at a stem's foot.
//!
//! Limits: petals whose feet are as far apart as they are long are read where a disc stands between them
//! ([`corolla`](super::corolla)) only.

use crate::anatomy::conventions::page::{Line, Page};
use crate::anatomy::conventions::shapes::lobes::{self, Focus};
use crate::anatomy::conventions::shapes::loops::taken_apart;
use crate::anatomy::conventions::{Habit, Hypothesis, Made};
use crate::geom::{convex_hull::convex_hull, polyline, simple_loop};
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Fewest petals, without a stem and on one, and most.
const PETALS: (usize, usize, usize) = (4, 3, 24);
/// Widest gap between petals, without a stem and on one, radians.
const GAP: (f32, f32) = (2.2, 2.8);
/// Most lines of a group that are looked at, and most places.
const MOST: (usize, usize) = (48, 12);
/// Farthest end of a petal from the place, as a share of the petal's reach, and its widest foot.
const BACK: f32 = 0.42;
const FOOT: f32 = 0.55;
/// Least area of a petal, as a share of the square of its length, and of its hull.
const FAT: f32 = 0.022;
const SOLID: f32 = 0.75;
/// Least area of the smallest petal, as a share of the largest one's.
const EVEN: f32 = 0.12;
/// Most angle that petals fill together, over the angle that they fill by themselves.
const OVERLAP: f32 = 1.6;
/// Widest foot of a petal in a stroke of its own that the classifier reads as one.
const CLOSED: f32 = 0.18;
/// Distance of a stem's end from the place, as a share of the petals' reach, and least length and chord of a stem.
const AT: f32 = 0.5;
const STEM: (f32, f32) = (0.6, 0.85);
/// How far what lies within reaches from the place, as a share of the petals' reach.
const WITHIN: f32 = 0.45;
/// What each further line of petals speaks for a flower: as much as for a leaf by itself.
const EACH: f32 = 2.2;
/// Least share of the points of what follows petals that a leaf in it has.
const LEAF: f32 = 0.1;
/// Least part of a line that must be petals and stem.
const MOSTLY: f32 = 0.7;

/// Proposes a flower for each group of lines whose petals gather.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    out.extend(page.groups.iter().chain(&page.wide_groups).filter_map(|group| flower(page, group)));
}

fn flower(page: &Page, group: &[usize]) -> Option<Hypothesis> {
    if group.len() > MOST.0 {
        return None;
    }
    let found = places(page, group).into_iter().filter_map(|place| {
        let first = Petals::at(page, group, place);
        Petals::at(page, group, first.middle()?).hypothesis(page, group)
    });
    found.max_by(|a, b| a.score.total_cmp(&b.score))
}

/// Where petals may gather: at the ends of lines that turn back, those apart.
fn places(page: &Page, group: &[usize]) -> Vec<Vec2> {
    let mut places: Vec<Vec2> = Vec::new();
    for line in group.iter().map(|i| &page.lines[*i]) {
        let (first, last) = line.ends();
        let size = line.size().length();
        let is_far = |place: &Vec2| places.iter().all(|other| other.distance(*place) > 0.08 * size);
        let new: Vec<Vec2> = if line.openness < FOOT {
            [first.midpoint(last)].into_iter().filter(is_far).collect()
        } else {
            [first, last].into_iter().filter(is_far).collect()
        };
        places.extend(new);
    }
    places.truncate(MOST.1);
    places
}

/// A petal, and the line that it comes from.
struct Petal {
    line: usize,
    points: Vec<Vec2>,
}

impl Petal {
    fn foot(&self) -> Vec2 {
        self.points[0].midpoint(self.points[self.points.len() - 1])
    }
}

/// What gathers at a place.
struct Petals {
    place: Vec2,
    petals: Vec<Petal>,
    /// Stems that are one stroke with petals.
    stems: Vec<Vec<Vec2>>,
    /// Leaves along such stems.
    leaves: Vec<Vec<Vec2>>,
}

impl Petals {
    fn at(page: &Page, group: &[usize], place: Vec2) -> Self {
        let mut it = Self { place, petals: Vec::new(), stems: Vec::new(), leaves: Vec::new() };
        group.iter().for_each(|line| it.cut(*line, &page.lines[*line]));
        it
    }

    /// The middle of the petals' feet.
    fn middle(&self) -> Option<Vec2> {
        let sum: Vec2 = self.petals.iter().map(Petal::foot).sum();
        (self.petals.len() >= PETALS.1).then(|| sum / self.petals.len() as f32)
    }

    /// Takes the petals of a line, if it is little else but they and a stem.
    fn cut(&mut self, number: usize, line: &Line) {
        let focus = Focus::round(self.place, 1.0);
        let reach = focus.reach(&line.points);
        let ends_there = line.ends().0.distance(self.place) < BACK * reach;
        let is_ring = line.openness < 0.1 && !ends_there;
        let stretches = lobes::cut(&line.points, &focus, is_ring);
        let (petals, rest): (Vec<_>, Vec<_>) =
            stretches.into_iter().partition(|points| is_petal(points, &focus, reach));
        let is_stem = |points: &Vec<Vec2>| is_stem(points, self.place, reach);
        let mut stems: Vec<Vec<Vec2>> = rest.into_iter().filter(is_stem).collect();
        let mut leaves = Vec::new();
        if stems.is_empty()
            && let Some((way, loops)) = leafy_tail(line, &petals).filter(|(way, _)| is_stem(way))
        {
            (stems, leaves) = (vec![way], loops);
        }
        let parts = petals.iter().chain(&stems).chain(&leaves);
        let length: f32 = parts.map(|points| polyline::length(points)).sum();
        // A line may wind on in the centre.
        let at_centre = line.points.windows(2).filter(|p| focus.distance(p[0]) < 0.25 * reach);
        let wound: f32 = at_centre.map(|p| p[0].distance(p[1])).sum();
        if !petals.is_empty() && length + wound > MOSTLY * line.length && stems.len() < 2 {
            self.petals.extend(petals.into_iter().map(|points| Petal { line: number, points }));
            self.stems.extend(stems);
            self.leaves.extend(leaves);
        }
    }

    fn hypothesis(self, page: &Page, group: &[usize]) -> Option<Hypothesis> {
        let focus = Focus::round(self.place, 1.0);
        let outlines: Vec<Vec<Vec2>> = self.petals.iter().map(|petal| petal.points.clone()).collect();
        let reach = outlines.iter().map(|points| focus.reach(points)).fold(0.0, f32::max);
        let mut lines: Vec<usize> = self.petals.iter().map(|petal| petal.line).collect();
        lines.dedup();
        let others = || group.iter().copied().filter(|i| lines.binary_search(i).is_err());
        let stem_lines =
            others().map(|i| &page.lines[i].points).filter(|p| is_stem(p, self.place, 0.8 * reach));
        let stems = || stem_lines.clone().chain(&self.stems);
        let rises = |points: &Vec<Vec2>| far_end(points, self.place).y < self.place.y;
        if stems().any(rises)
            || stems().count() > 1
            || !are_a_flower(&outlines, self.place, stems().count() > 0)
        {
            return None;
        }
        if self.leaves_petals_out(page, others(), reach) {
            return None;
        }
        let is_of_papers = |petal: &&Petal| {
            let (first, last) = (petal.points[0], petal.points[petal.points.len() - 1]);
            let is_closed = first.distance(last) < CLOSED * focus.reach(&petal.points);
            is_closed && self.petals.iter().filter(|other| other.line == petal.line).count() == 1
        };
        if 2 * self.petals.iter().filter(is_of_papers).count() > outlines.len() {
            return None;
        }
        let is_within = |i: &usize| focus.reach(&page.lines[*i].points) < WITHIN * reach;
        let mut uses: Vec<usize> = others().filter(is_within).chain(lines.iter().copied()).collect();
        uses.sort_unstable();
        let root = |points: &[Vec2]| self.place + 0.02 * reach * lobes::direction(points, self.place);
        let petals =
            outlines.iter().map(|points| Made::new(Tool::Petal, lobes::rooted(points, root(points))));
        let own_stems = self.stems.iter().map(|points| Made::new(Tool::Branch, points.iter().copied()));
        let own_leaves =
            self.leaves.iter().map(|points| Made::new(Tool::Leaf, lobes::rooted(points, points[0])));
        let parts = petals.chain(own_stems).chain(own_leaves).collect();
        let score = 4.2 + 0.1 * outlines.len().min(8) as f32 + EACH * (lines.len() - 1) as f32;
        let (reading, habit) = (Reading::Corolla, Some(Habit::Flower));
        Some(Hypothesis { uses, score, parts, solids: Vec::new(), reading, habit })
    }
}

impl Petals {
    /// Whether more than half as many lines again, about as long as its petals' and open or closed as they are, begin and end near the place.
    fn leaves_petals_out(&self, page: &Page, others: impl Iterator<Item = usize>, reach: f32) -> bool {
        let mean = self.petals.iter().map(|petal| page.lines[petal.line].length).sum::<f32>()
            / self.petals.len().max(1) as f32;
        let is_like_them = |line: &Line| {
            let (first, last) = line.ends();
            let turns_back = first.distance(last) < FOOT * line.length;
            let is_near = first.distance(self.place).max(last.distance(self.place)) < reach;
            let is_as_long = (0.5 * mean..2.0 * mean).contains(&line.length);
            turns_back && is_near && is_as_long
        };
        let left = others.filter(|i| is_like_them(&page.lines[*i])).count();
        2 * left > self.petals.len()
    }
}

/// Whether a stretch leaves the focus, encloses enough and comes back.
fn is_petal(points: &[Vec2], focus: &Focus, farthest: f32) -> bool {
    let (first, last) = (points[0], points[points.len() - 1]);
    let reach = focus.reach(points);
    let length = polyline::length(points) + first.distance(last);
    let area = simple_loop::area(points);
    reach > 0.3 * farthest
        && focus.distance(first).max(focus.distance(last)) < BACK * reach
        && first.distance(last) < FOOT * reach
        && area > FAT * length * length
        && area > SOLID * simple_loop::area(&convex_hull(points, |p| *p))
}

/// What a line goes on to after its petals, or from which it comes, with the loops in it taken out: a stem with its leaves.
fn leafy_tail(line: &Line, petals: &[Vec<Vec2>]) -> Option<(Vec<Vec2>, Vec<Vec<Vec2>>)> {
    let (first, last) = (petals.first()?.first()?, petals.last()?.last()?);
    let begin = line.points.iter().position(|p| p == first)?;
    let end = line.points.iter().rposition(|p| p == last)?;
    let tail = if begin > line.points.len() - end { &line.points[..=begin] } else { &line.points[end..] };
    let (loops, way) = taken_apart(&line.part(tail.to_vec())?, LEAF);
    (!loops.is_empty()).then_some((way, loops))
}

/// Whether a line is nearly straight, goes away from a place, and is long beside this reach.
fn is_stem(points: &[Vec2], place: Vec2, reach: f32) -> bool {
    let (first, last) = (points[0], points[points.len() - 1]);
    let run = first.distance(last);
    let near = first.distance(place).min(last.distance(place));
    near < AT * reach && run > STEM.0 * reach && run > STEM.1 * polyline::length(points)
}

/// The end of a line that is farther from a place.
fn far_end(points: &[Vec2], place: Vec2) -> Vec2 {
    let (first, last) = (points[0], points[points.len() - 1]);
    if first.distance(place) > last.distance(place) { first } else { last }
}

/// Whether petals stand all around a place, side by side, about of one size.
fn are_a_flower(petals: &[Vec<Vec2>], place: Vec2, has_stem: bool) -> bool {
    let (fewest, gap) = if has_stem { (PETALS.1, GAP.1) } else { (PETALS.0, GAP.0) };
    let areas = || petals.iter().map(|points| simple_loop::area(points));
    let (least, most) = (areas().fold(f32::INFINITY, f32::min), areas().fold(0.0, f32::max));
    // Feet lie around the place itself.
    let outer = |points: &Vec<Vec2>| -> Vec<Vec2> {
        let reach = points.iter().map(|p| p.distance(place)).fold(0.0, f32::max);
        points.iter().copied().filter(|p| p.distance(place) > 0.5 * reach).collect()
    };
    let outer: Vec<Vec<Vec2>> = petals.iter().map(outer).collect();
    let single: f32 = outer.iter().map(|points| lobes::around(std::slice::from_ref(points), place)).sum();
    (fewest..=PETALS.2).contains(&petals.len())
        && lobes::widest_gap(petals, place) < gap
        && least > EVEN * most
        && single < OVERLAP * lobes::around(&outer, place)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::{PI, TAU};

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    /// A petal from near the origin and back, `turn` away from the right, its ends so far apart.
    fn petal(turn: f32, foot: f32) -> Vec<Vec2> {
        let place = |k: usize| {
            let angle = PI * k as f32 / 60.0;
            let along = 8.0 + 92.0 * angle.sin();
            Vec2::new(along, 0.5 * foot * angle.cos() + 30.0 * (2.0 * angle).sin() * angle.sin())
        };
        (0..=60).map(|k| Vec2::from_angle(turn).rotate(place(k))).collect()
    }

    fn petals(count: usize, foot: f32) -> Vec<Vec<Vec2>> {
        (0..count).map(|k| petal(0.4 + TAU * k as f32 / count as f32, foot)).collect()
    }

    fn stem(from: f32, to: f32) -> Vec<Vec2> {
        vec![Vec2::new(0.0, from), Vec2::new(3.0, to)]
    }

    fn counts(found: &[Hypothesis]) -> Vec<(usize, usize)> {
        let of =
            |flower: &Hypothesis, tool: Tool| flower.parts.iter().filter(|part| part.tool == tool).count();
        found.iter().map(|flower| (of(flower, Tool::Petal), of(flower, Tool::Branch))).collect()
    }

    #[test]
    fn open_petals_around_one_place_are_a_flower() {
        let found = read(&[petals(5, 30.0), vec![stem(5.0, 300.0)]].concat());
        assert_eq!(counts(&found), [(5, 0)]);
        assert_eq!(found[0].uses, [0, 1, 2, 3, 4], "the stem stays");
        assert!(found[0].parts.iter().all(|petal| petal.points[0].position.length() < 20.0));
    }

    #[test]
    fn petals_in_one_stroke_and_one_beside_them_are_a_flower_with_or_without_a_stem() {
        let drawn = petals(5, 6.0);
        let mut most: Vec<Vec2> = drawn[..4].concat();
        assert_eq!(counts(&read(&[most.clone(), drawn[4].clone()])), [(5, 0)]);
        most.extend(stem(5.0, 300.0));
        assert_eq!(counts(&read(&[most, drawn[4].clone()])), [(5, 1)], "a stem in the same stroke");
    }

    #[test]
    fn a_leaf_in_the_stem_of_the_same_stroke_stays_a_leaf() {
        let mut drawn = petals(5, 6.0).concat();
        let leaf = [(2.0, 180.0), (30.0, 150.0), (70.0, 140.0), (45.0, 175.0), (4.0, 186.0), (3.0, 300.0)];
        drawn.extend(crate::anatomy::conventions::page::even(
            &[&[Vec2::new(0.0, 5.0)], &leaf.map(Vec2::from)[..]].concat(),
            120,
        ));
        let found = crate::anatomy::conventions::read_as_drawn(propose, &[drawn]);
        let of = |tool: Tool| found[0].parts.iter().filter(|part| part.tool == tool).count();
        assert_eq!((of(Tool::Petal), of(Tool::Branch), of(Tool::Leaf)), (5, 1, 1));
    }

    #[test]
    fn petals_in_one_stroke_on_a_stem_are_no_crown_and_several_strokes_speak_for_one_flower() {
        let drawn = petals(5, 6.0);
        let alone = read(&[vec![drawn.concat()], vec![stem(5.0, 300.0)]].concat());
        assert!(alone[0].score > 4.3, "more than a crown with lobes");
        let parted = read(&[vec![drawn[..3].concat(), drawn[3..].concat()], vec![stem(5.0, 300.0)]].concat());
        assert!(parted[0].score > alone[0].score + 2.0, "more than a leaf for each stroke");
    }

    #[test]
    fn three_need_a_stem() {
        assert!(read(&petals(3, 30.0)).is_empty());
        assert_eq!(counts(&read(&[petals(3, 30.0), vec![stem(5.0, 300.0)]].concat())), [(3, 0)]);
    }

    #[test]
    fn closed_petals_leaves_at_a_foot_and_fans_are_none() {
        assert!(read(&petals(5, 0.0)).is_empty(), "the papers' way");
        assert!(read(&[petals(5, 30.0), vec![stem(-5.0, -300.0)]].concat()).is_empty());
        let fan: Vec<Vec<Vec2>> = (0..5).map(|k| petal(-0.2 * PI * (k as f32 + 0.5), 30.0)).collect();
        assert!(read(&fan).is_empty());
    }
}
