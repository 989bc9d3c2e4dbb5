//! Outlines of blades, drawn in one stroke or in two: where a line comes back to itself, or where two arcs meet at both ends.
//!
//! People draw the stalk and the blade on it in one go, overshoot, or draw a leaf's two sides one by one. Of one line the outline
//! is the largest loop between two places of it that are hardly apart ([`GAP`]); of two it is what lies between the places near
//! their ends where they come nearest to one another. What is left over beyond these places are tails: a stalk, or an end that
//! went too far.
//!
//! Limits: an outline of three strokes or more is not put together. Cost: the square of a line's points, which are at most
//! [`MOST_POINTS`](super::page); of pairs of lines only those whose ends are near.

use crate::anatomy::conventions::page::{Line, Page};
use crate::geom::{polyline, simple_loop};
use glam::Vec2;

/// Farthest distance of two places of a line that count as one, as a share of the diagonal of its bounds.
const GAP: f32 = 0.06;
/// The same for the ends of a line, between which the hand has lifted.
const END_GAP: f32 = 0.25;
/// The same where a stalk or a midrib leaves the outline through the gap.
const STALK_GAP: f32 = 0.42;
/// Least share of a line's points that lie in its loop.
const LOOP: f32 = 0.4;
/// Farthest gap between two arcs at their ends, as a share of the shorter one's chord, and the same at one of them where a stalk or
/// a midrib leaves the outline there.
const MEET: f32 = 0.12;
const STALK_MEET: f32 = 0.38;
/// Share of an arc near its ends in which it meets the other.
const END: f32 = 0.35;
/// Least area between two arcs, as a share of the square of the distance between the places where they meet.
const ENCLOSED: f32 = 0.08;
/// Least depth of the flatter of two arcs of a lens over its chord, as a share of the deeper one's.
const BULGE: f32 = 0.2;

/// An outline and what is left over of its strokes.
#[derive(Clone, Debug)]
pub(crate) struct Blade {
    /// Its lines, ascending.
    pub lines: Vec<usize>,
    /// The outline, first point not repeated.
    pub ring: Vec<Vec2>,
    /// Left-over ends, each beginning at the outline.
    pub tails: Vec<Vec<Vec2>>,
    /// Whether it bulges to both sides: the rim of a pot or the ground under a hill is flat.
    pub is_lens: bool,
    /// A gap so wide that something must pass it.
    pub gap: Option<(Vec2, Vec2)>,
    /// The midrib, where it is in one stroke with the outline.
    pub midrib: Option<Vec<Vec2>>,
    /// Whether it is what a whole group of lines encloses: nothing of the group may be left over.
    pub is_whole: bool,
}

impl Blade {
    /// An outline of some lines, still without places.
    pub(crate) fn of(lines: Vec<usize>) -> Self {
        let (ring, tails) = (Vec::new(), Vec::new());
        Self { lines, ring, tails, is_lens: true, gap: None, midrib: None, is_whole: false }
    }

    /// Smallest and largest corner of the outline.
    pub(crate) fn bounds(&self) -> (Vec2, Vec2) {
        polyline::bounds(self.ring.iter().copied())
    }

    /// Diagonal of its bounds.
    pub(crate) fn diagonal(&self) -> f32 {
        let (low, high) = self.bounds();
        low.distance(high)
    }

    /// Whether a place lies in the outline.
    pub(crate) fn holds(&self, p: Vec2) -> bool {
        let next = self.ring.iter().cycle().skip(1);
        let crosses = |(a, b): (&Vec2, &Vec2)| {
            (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
        };
        self.ring.iter().zip(next).filter(|(a, b)| crosses((a, b))).count() % 2 == 1
    }

    /// Share of a line that lies in the outline, by every third of its points.
    pub(crate) fn share_of(&self, line: &Line) -> f32 {
        let (low, high) = polyline::bounds(self.ring.iter().copied());
        if line.bounds.0.cmpgt(high).any() || line.bounds.1.cmplt(low).any() {
            return 0.0;
        }
        let points = line.points.iter().step_by(3);
        let is_inside = |p: &&Vec2| p.cmpge(low).all() && p.cmple(high).all() && self.holds(**p);
        points.clone().filter(is_inside).count() as f32 / points.len() as f32
    }

    /// The point of the outline nearest to a place, and how far it is.
    pub(crate) fn nearest(&self, p: Vec2) -> (usize, f32) {
        let away = |i: &usize| self.ring[*i].distance(p);
        let nearest = (0..self.ring.len()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(0);
        (nearest, self.ring.get(nearest).map_or(f32::INFINITY, |at| at.distance(p)))
    }

    /// How far a line goes away from the outline, by every third of its points.
    pub(crate) fn farthest(&self, line: &Line) -> f32 {
        line.points.iter().step_by(3).map(|p| self.nearest(*p).1).fold(0.0, f32::max)
    }

    /// Share of its convex hull that it fills.
    pub(crate) fn solidity(&self) -> f32 {
        let hull = crate::geom::convex_hull::convex_hull(&self.ring, |p| *p);
        simple_loop::area(&self.ring) / simple_loop::area(&hull).max(f32::MIN_POSITIVE)
    }
}

/// The largest loop of a line, if it has one.
pub(crate) fn of_one(number: usize, line: &Line) -> Option<Blade> {
    let points = &line.points;
    let last = points.len() - 1;
    let diagonal = line.size().length();
    // Areas from the first point, so that the area of a loop is a difference.
    let mut sums = vec![0.0; points.len()];
    for i in 1..=last {
        sums[i] = sums[i - 1] + (points[i - 1] - points[0]).perp_dot(points[i] - points[0]);
    }
    let least = ((last as f32 * LOOP) as usize).max(3);
    let mut best = (0.0, 0, 0);
    for i in 0..last.saturating_sub(least) {
        for j in i + least..=last {
            let gap = points[i].distance(points[j]) / diagonal;
            let most = if i == 0 && j == last { STALK_GAP } else { GAP };
            if gap > most {
                continue;
            }
            let twice: f32 = sums[j] - sums[i] + (points[j] - points[0]).perp_dot(points[i] - points[0]);
            // Of loops of nearly one size, the one that closes best.
            let worth = twice.abs() * (1.0 - gap);
            if worth > best.0 {
                best = (worth, i, j);
            }
        }
    }
    let (worth, i, j) = best;
    let mut tails = vec![points[..=i].iter().rev().copied().collect::<Vec<Vec2>>(), points[j..].to_vec()];
    tails.retain(|tail| tail.len() > 1);
    let gap = (points[i].distance(points[j]) > END_GAP * diagonal).then_some((points[i], points[j]));
    let blade = Blade { ring: points[i..j].to_vec(), tails, gap, ..Blade::of(vec![number]) };
    (worth > 0.0).then_some(blade)
}

/// All outlines of two arcs each.
pub(crate) fn of_two(page: &Page) -> Vec<Blade> {
    let chord = |line: &Line| line.ends().0.distance(line.ends().1);
    let is_arc = |i: &usize| page.lines[*i].openness > END_GAP;
    let arcs: Vec<usize> = (0..page.lines.len()).filter(is_arc).collect();
    let around = |i: &usize, end: Vec2| {
        let margin = Vec2::splat(MEET * chord(&page.lines[*i]));
        (end - margin, end + margin)
    };
    let ends = |i: &usize| {
        let (first, last) = page.lines[*i].ends();
        [around(i, first), around(i, last)]
    };
    let boxes: Vec<(Vec2, Vec2)> = arcs.iter().flat_map(ends).collect();
    let near = page.lines_at(&boxes);
    let mut pairs: Vec<(usize, usize)> = Vec::new();
    for (a, near) in arcs.iter().flat_map(|a| [a, a]).zip(near) {
        let others = near.into_iter().filter(|b| b != a && arcs.binary_search(b).is_ok()).take(MOST_PAIRS);
        pairs.extend(others.map(|b| (*a.min(&b), *a.max(&b))));
    }
    pairs.sort_unstable();
    pairs.dedup();
    pairs.into_iter().filter_map(|(a, b)| of_pair(page, a, b)).collect()
}

/// Most arcs with which one is paired.
const MOST_PAIRS: usize = 16;

fn of_pair(page: &Page, a: usize, b: usize) -> Option<Blade> {
    let one = &page.lines[a].points;
    let mut other = page.lines[b].points.clone();
    let gaps =
        |other: &[Vec2]| one[0].distance(other[0]) + one[one.len() - 1].distance(other[other.len() - 1]);
    let reversed: Vec<Vec2> = other.iter().rev().copied().collect();
    if gaps(&reversed) < gaps(&other) {
        other = reversed;
    }
    let ends = |points: &[Vec2]| points[0].distance(points[points.len() - 1]);
    let chord = ends(one).min(ends(&other));
    let (begin, end) = [false, true].map(|at_end| meeting(one, &other, MEET * chord, at_end)).into();
    let open = |at_end: bool| meeting(one, &other, STALK_MEET * chord, at_end);
    let ((i, j), (k, l)) = match (begin, end) {
        (None, None) => return None,
        (begin, end) => (begin.or_else(|| open(false))?, end.or_else(|| open(true))?),
    };
    let gap = match (begin, end) {
        (None, _) => Some((one[i], other[j])),
        (_, None) => Some((one[k], other[l])),
        _ => None,
    };
    let tips = one[i].distance(one[k]);
    let ring: Vec<Vec2> = one[i..=k].iter().chain(other[j..=l].iter().rev()).copied().collect();
    let depths = (depth(&one[i..=k]), -depth(&other[j..=l]));
    let bulge = depths.0.abs().max(depths.1.abs()) * BULGE;
    let is_lens = depths.0.signum() == depths.1.signum() && depths.0.abs().min(depths.1.abs()) > bulge;
    if simple_loop::area(&ring) < ENCLOSED * tips * tips {
        return None;
    }
    let back = |points: &[Vec2]| points.iter().rev().copied().collect::<Vec<Vec2>>();
    let mut tails = vec![back(&one[..=i]), one[k..].to_vec(), back(&other[..=j]), other[l..].to_vec()];
    tails.retain(|tail| tail.len() > 1);
    Some(Blade { ring, tails, is_lens, gap, ..Blade::of(vec![a, b]) })
}

/// Where two arcs come nearest to one another near their beginnings or their ends.
fn meeting(one: &[Vec2], other: &[Vec2], most: f32, at_end: bool) -> Option<(usize, usize)> {
    let range = |points: &[Vec2]| {
        let share = (points.len() as f32 * END) as usize;
        if at_end { points.len() - share..points.len() } else { 0..share }
    };
    let mut best = (most, None);
    for i in range(one) {
        for j in range(other) {
            let gap = one[i].distance(other[j]);
            if gap < best.0 {
                best = (gap, Some((i, j)));
            }
        }
    }
    best.1
}

/// Largest distance of an arc from its chord with the side on which it lies, as a share of the chord.
fn depth(arc: &[Vec2]) -> f32 {
    let (first, last) = (arc[0], arc[arc.len() - 1]);
    let chord = last - first;
    let away = |p: &Vec2| chord.perp_dot(*p - first) / chord.length_squared().max(f32::MIN_POSITIVE);
    arc.iter().map(away).fold(0.0, |most, depth| if depth.abs() > f32::abs(most) { depth } else { most })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A lens from (0, 0) to (0, -100): one side of it.
    fn side(sign: f32) -> Vec<Vec2> {
        (0..=50)
            .map(|k| k as f32 / 50.0)
            .map(|t| Vec2::new(sign * 100.0 * t * (1.0 - t), -100.0 * t))
            .collect()
    }

    #[test]
    fn the_stalk_below_a_loop_is_a_tail() {
        let mut drawn = vec![Vec2::new(0.0, 60.0)];
        drawn.extend(side(1.0));
        drawn.extend(side(-1.0).into_iter().rev());
        let page = Page::of_lines(&[drawn]);
        let blade = of_one(0, &page.lines[0]).unwrap();
        let [tail] = &blade.tails[..] else { panic!("{} tails", blade.tails.len()) };
        assert!(tail[0].length() < 8.0 && tail[tail.len() - 1].distance(Vec2::new(0.0, 60.0)) < 1.0);
        assert!(blade.bounds().1.y < 8.0 && blade.bounds().0.y < -95.0);
        assert!(blade.holds(Vec2::new(0.0, -50.0)) && !blade.holds(Vec2::new(0.0, 30.0)));
    }

    #[test]
    fn two_sides_make_one_outline_whichever_way_they_are_drawn() {
        for turned in [false, true] {
            let mut other = side(-1.0);
            other.iter_mut().for_each(|p| p.y += 3.0);
            if turned {
                other.reverse();
            }
            let found = of_two(&Page::of_lines(&[side(1.0), other]));
            let [blade] = &found[..] else { panic!("{} outlines", found.len()) };
            assert!(blade.is_lens && blade.solidity() > 0.9);
            assert!((simple_loop::area(&blade.ring) / 3333.0 - 1.0).abs() < 0.1);
        }
    }

    #[test]
    fn a_rim_over_a_bowl_is_no_lens_and_sides_that_keep_apart_are_nothing() {
        let rim = vec![Vec2::ZERO, Vec2::new(0.0, -100.0)];
        assert!(of_two(&Page::of_lines(&[side(1.0), rim])).iter().all(|blade| !blade.is_lens));
        let away = side(-1.0).into_iter().map(|p| p - Vec2::new(40.0, 0.0)).collect();
        assert!(of_two(&Page::of_lines(&[side(1.0), away])).is_empty());
    }
}
