//! A leaf with pointed lobes on its stalk, such as a maple's: one closed outline and one line that ends at it.
//!
//! What tells it from a star of petals, a fir and the arms of a cactus: its lobes end in sharp tips, they stand about the end of
//! the stalk on both sides and opposite of it, and none points toward the stalk. What tells it from a crown of fronds: the stalk is no
//! longer than the leaf. Lines inside are veins. Lobes that are round, as an oak's, are those of a leaf where the stalk runs on through it
//! nearly to its end as its midrib, has notches on both sides, and the leaf is longer than wide: no stem goes on so far into a flower, and
//! no trunk into a crown. A midrib of its own says so of a broad one as well. Without a midrib it must be longer still, and taper toward the stalk, as no crown does.
//!
//! Limits: a leaf without a stalk.

use crate::anatomy::conventions::page::{Line, Page, even, notches, tips};
use crate::anatomy::conventions::shapes::{outline, stem_tail};
use crate::anatomy::conventions::{Hypothesis, Made};
use crate::geom::polyline;
use crate::sketch::{Reading, Tool};
use glam::Vec2;
use std::borrow::Cow;
use std::f32::consts::PI;

/// Points of an outline.
const POINTS: usize = 160;
/// Stretch of an outline over which a tip turns, as a share of its length, and least turn there.
const TIP: (f32, f32) = (0.06, 1.5);
/// Fewest and most lobes, and fewest notches between them.
const LOBES: (usize, usize) = (3, 11);
const NOTCHES: usize = 2;
/// Shortest line that goes round lobes, in diagonals of its bounds: stems are shorter.
const LONG: f32 = 1.8;
/// Largest opening of the outline, least of its hull that it fills, and most of it with pointed lobes, with round ones along a midrib and
/// without one.
const OPEN: f32 = 0.2;
const SOLID: f32 = 0.35;
const FULL: (f32, f32, f32) = (0.85, 0.93, 0.89);
/// Least distance of a lobe's tip from the middle, as a share of the farthest's.
const FAR: f32 = 0.5;
/// Least angle between a lobe and the stalk about the stalk's end, and most between one of them and the stalk's opposite, radians; least distance
/// of a tip from there, as a share of the outline's diagonal.
const BESIDE: f32 = 0.36 * PI;
const OPPOSITE: f32 = 0.25 * PI;
const OFF: f32 = 0.15;
/// How near the stalk ends to the outline, and how long it is outside of it, least and most, as shares of the outline's diagonal.
const AT: f32 = 0.06;
const STALK: (f32, f32) = (0.08, 0.8);
/// Least chord of a stalk over its length.
const STRAIGHT: f32 = 0.8;
/// Log-odds of such a leaf, and more for each lobe, up to so many.
const SCORE: f32 = 4.4;
const EACH: (f32, usize) = (0.2, 5);
/// Fewest lines inside that are its veins, and log-odds of them: leaflets have none across their feet.
const VEINS: (usize, f32) = (2, 0.8);
/// Of round lobes: fewest notches, and of each side of the midrib; least length of the midrib, as a share of the leaf's, and least length of the
/// leaf over its width; log-odds; how far into a leaf without a midrib its stalk goes at most, as a share of its length.
const ROUND: (usize, usize, f32, f32, f32, f32) = (4, 2, 0.68, 1.15, 6.0, 0.15);
/// Most of its hull that a leaf with deep round lobes fills, and least length over its width then.
const DEEP: (f32, f32) = (0.8, 0.8);
/// Of round lobes without a midrib: least length of the leaf over its width, where along it its width is measured and the most of its
/// greatest width there, and log-odds: a crown has a broad foot.
const TAPERED: (f32, f32, f32, f32) = (1.3, 0.05, 0.42, 6.0);
/// Most lines that are looked at near one outline.
const MOST_LINES: usize = 32;

/// Proposes a leaf for each lobed outline on a stalk.
pub(crate) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let blades: Vec<Blade> = (0..page.lines.len()).filter_map(|i| Blade::of(page, i)).collect();
    let grown = |blade: &Blade| {
        let margin = Vec2::splat(AT * blade.line.size().length());
        (blade.line.bounds.0 - margin, blade.line.bounds.1 + margin)
    };
    let boxes: Vec<(Vec2, Vec2)> = blades.iter().map(grown).collect();
    let near = page.lines_at(&boxes);
    out.extend(blades.iter().zip(near).filter_map(|(blade, near)| blade.leaf(page, &near)));
}

/// An outline with pointed lobes.
struct Blade<'a> {
    number: usize,
    line: Cow<'a, Line>,
    /// The stalk in one stroke with it, from its foot.
    stalk: Option<Vec<Vec2>>,
    /// Even points of the outline, the first not repeated.
    ring: Vec<Vec2>,
    /// The tips of its lobes, and the notches between them.
    tips: Vec<Vec2>,
    notches: Vec<Vec2>,
}

impl<'a> Blade<'a> {
    fn of(page: &'a Page, number: usize) -> Option<Self> {
        let line = &page.lines[number];
        if line.length < LONG * line.size().length() {
            return None;
        }
        if line.openness < OPEN {
            return Self::of_outline(number, Cow::Borrowed(line), None);
        }
        let (stalk, rest) = stem_tail::cut(line)?;
        Self::of_outline(number, Cow::Owned(rest), Some(stalk))
    }

    fn of_outline(number: usize, line: Cow<'a, Line>, stalk: Option<Vec<Vec2>>) -> Option<Self> {
        if line.is_scribble() || line.solidity() < SOLID {
            return None;
        }
        let mut closed = line.points.clone();
        closed.push(closed[0]);
        let mut ring = even(&closed, POINTS + 1);
        ring.pop();
        let middle = line.middle();
        let mut tips = tips(&ring, TIP);
        let farthest = tips.iter().map(|tip| tip.distance(middle)).fold(0.0, f32::max);
        tips.retain(|tip| tip.distance(middle) > FAR * farthest);
        let notches = notches(&ring);
        let blade = Self { number, line, stalk, ring, tips, notches };
        (blade.has_pointed_lobes() || blade.notches.len() >= ROUND.0).then_some(blade)
    }

    fn has_pointed_lobes(&self) -> bool {
        (LOBES.0..=LOBES.1).contains(&self.tips.len())
            && self.notches.len() >= NOTCHES
            && self.line.solidity() < FULL.0
    }

    /// Whether a midrib from the end of the stalk makes a leaf of round lobes: along one of the lines inside, or along the stalk.
    fn has_midrib<'l>(
        &self,
        along: &Along,
        mut inside: impl Iterator<Item = &'l Line>,
        stalk: Option<&Line>,
    ) -> bool {
        let is_midrib = |line: &Line| {
            let (first, last) = line.ends();
            let end = along.height(first).max(along.height(last));
            let runs_along = first.distance(last) > STRAIGHT * line.length
                && (last - first).normalize_or_zero().dot(along.way).abs() > STRAIGHT;
            runs_along
                && along.height(first).min(along.height(last)) < 0.2 * along.length
                && end > ROUND.2 * along.length
        };
        // No crown has lobes so deep.
        let longer = if self.line.solidity() < DEEP.0 { DEEP.1 } else { ROUND.3 };
        let is_of_stalk = || along.length > longer * along.width() && stalk.is_some_and(is_midrib);
        let mut is_inside = || along.length > DEEP.1 * along.width() && inside.any(is_midrib);
        self.line.solidity() < FULL.1 && self.has_notches_beside(along) && (is_of_stalk() || is_inside())
    }

    /// Whether a leaf without a midrib has round lobes on both sides and tapers toward its stalk.
    fn is_tapered(&self, along: &Along) -> bool {
        let cut = TAPERED.1 * along.length;
        let ends = outline::ends_at(&self.ring, cut, |p| along.height(p), |p| along.across(p));
        let foot = ends.map_or(0.0, |(left, right)| right - left);
        along.length > TAPERED.0 * along.width()
            && self.line.solidity() < FULL.2
            && self.has_notches_beside(along)
            && foot < TAPERED.2 * along.width()
    }

    fn has_notches_beside(&self, along: &Along) -> bool {
        let of_side =
            |sense: f32| self.notches.iter().filter(|notch| sense * along.across(**notch) > 0.0).count();
        self.notches.len() >= ROUND.0 && of_side(1.0).min(of_side(-1.0)) >= ROUND.1
    }

    /// The leaf with its stalk, if one of the lines that are near, or the rest of its own, is that and no other speaks against it.
    fn leaf(&self, page: &Page, near: &[usize]) -> Option<Hypothesis> {
        let others: Vec<usize> = near.iter().copied().filter(|i| *i != self.number).collect();
        let (low, high) = self.line.bounds;
        let is_inside = |i: &usize| {
            let line = &page.lines[*i];
            line.bounds.0.cmpge(low).all() && line.bounds.1.cmple(high).all() && !line.is_closed_and_solid()
        };
        let (inside, outside): (Vec<usize>, Vec<usize>) = others.iter().partition(|i| is_inside(i));
        let (stalk, of_line) = match (&self.stalk, &outside[..]) {
            (Some(own), []) => (self.outside(own)?, None),
            (None, [one]) => (self.outside(&page.lines[*one].points)?, Some(*one)),
            _ => return None,
        };
        let (base, foot) = (stalk[stalk.len() - 1], stalk[0]);
        let ribs = inside.iter().map(|i| &page.lines[*i]);
        let along = Along::new(&self.ring, (base, foot))?;
        let is_round = self.has_midrib(&along, ribs, of_line.map(|i| &page.lines[i]));
        let ends_there = |line: usize| {
            let (first, last) = page.lines[line].ends();
            along.height(first).max(along.height(last)) < ROUND.5 * along.length
        };
        let is_tapered = inside.is_empty() && of_line.is_none_or(ends_there) && self.is_tapered(&along);
        let is_pointed = self.has_pointed_lobes() && self.stands_about(base, foot);
        if others.len() > MOST_LINES || !(is_pointed || is_round || is_tapered) {
            return None;
        }
        let from = (0..POINTS).min_by(|a, b| {
            self.ring[*a].distance_squared(base).total_cmp(&self.ring[*b].distance_squared(base))
        })?;
        let mut ring = self.ring.clone();
        ring.rotate_left(from);
        ring.push(ring[0]);
        let parts = vec![Made::new(Tool::Leaf, ring), Made::new(Tool::Branch, stalk)];
        let veins = if inside.len() >= VEINS.0 { VEINS.1 } else { 0.0 };
        let mut uses: Vec<usize> = inside.into_iter().chain(of_line).chain([self.number]).collect();
        uses.sort_unstable();
        let of_lobes = SCORE + EACH.0 * self.tips.len().min(EACH.1) as f32 + veins;
        let score = match (is_round, is_tapered) {
            (true, _) => ROUND.4,
            (_, true) => of_lobes.max(TAPERED.3),
            _ => of_lobes,
        };
        let score = score * page.weight(self.line.size().length());
        Some(Hypothesis { uses, score, parts, solids: Vec::new(), reading: Reading::Leaf, habit: None })
    }

    /// The part of a line outside of the outline, from its free end to where it comes in, if that may be a stalk.
    fn outside(&self, points: &[Vec2]) -> Option<Vec<Vec2>> {
        let size = self.line.size().length();
        let gap = |p: Vec2| polyline::nearest(&self.ring, p).map_or(f32::INFINITY, |(gap, _)| gap);
        let mut stalk = points.to_vec();
        if gap(stalk[0]) < gap(stalk[stalk.len() - 1]) {
            stalk.reverse();
        }
        let end = stalk.iter().position(|p| gap(*p) < AT * size)?;
        stalk.truncate(end + 1);
        let (chord, length) = (stalk[0].distance(stalk[end]), polyline::length(&stalk));
        let is_stalk = (STALK.0 * size..STALK.1 * size).contains(&length) && chord > STRAIGHT * length;
        (is_stalk && end > 1).then_some(stalk)
    }

    /// Whether lobes stand on both sides of a stalk that ends at `base` and opposite of it, and none toward its foot.
    fn stands_about(&self, base: Vec2, foot: Vec2) -> bool {
        let angles: Vec<f32> = self.tips.iter().map(|tip| (foot - base).angle_to(*tip - base)).collect();
        let is_beside =
            |sense: f32| angles.iter().any(|angle| sense * angle > 0.0 && angle.abs() < PI - 0.5 * OPPOSITE);
        let is_off = |tip: &Vec2| tip.distance(base) > OFF * self.line.size().length();
        self.tips.iter().all(is_off)
            && angles.iter().all(|angle| angle.abs() > BESIDE)
            && angles.iter().any(|angle| angle.abs() > PI - OPPOSITE)
            && is_beside(1.0)
            && is_beside(-1.0)
    }
}

/// A leaf as it lies along the direction of its stalk.
struct Along {
    base: Vec2,
    way: Vec2,
    /// How far it reaches from the end of the stalk, and to either side.
    length: f32,
    sides: (f32, f32),
}

impl Along {
    fn new(ring: &[Vec2], (base, foot): (Vec2, Vec2)) -> Option<Self> {
        let way = (base - foot).try_normalize()?;
        let mut it = Self { base, way, length: 0.0, sides: (0.0, 0.0) };
        it.length = ring.iter().map(|p| it.height(*p)).fold(0.0, f32::max);
        let across = ring.iter().map(|p| it.across(*p));
        it.sides = across.fold((0.0, 0.0), |(l, r): (f32, f32), x| (l.min(x), r.max(x)));
        Some(it)
    }

    fn height(&self, p: Vec2) -> f32 {
        (p - self.base).dot(self.way)
    }

    fn across(&self, p: Vec2) -> f32 {
        self.way.perp_dot(p - self.base)
    }

    fn width(&self) -> f32 {
        self.sides.1 - self.sides.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        crate::anatomy::conventions::read_by(propose, lines)
    }

    /// Lobes of a leaf around (0, -100), at such angles from straight up in parts of a turn, with notches between them.
    fn star(angles: &[f32]) -> Vec<Vec2> {
        let at = |reach: f32, turns: f32| {
            let (sin, cos) = (std::f32::consts::TAU * turns).sin_cos();
            (reach * sin, -100.0 - reach * cos)
        };
        let mut places = vec![at(28.0, 0.5)];
        for (k, angle) in angles.iter().enumerate() {
            if k > 0 {
                places.push(at(32.0, 0.5 * (angle + angles[k - 1])));
            }
            places.push(at(90.0, *angle));
        }
        places.push(at(28.0, 0.5));
        line(&places)
    }

    #[test]
    fn pointed_lobes_that_turn_away_from_a_stalk_are_a_leaf_on_it() {
        let maple = star(&[-0.3, -0.15, 0.0, 0.15, 0.3]);
        let stalk = line(&[(0.0, -70.0), (5.0, -20.0)]);
        let vein = line(&[(0.0, -75.0), (30.0, -120.0)]);
        let found = read(&[maple, stalk, vein]);
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].reading, &found[0].uses[..]), (Reading::Leaf, &[0, 1, 2][..]));
        let [leaf, stalk] = &found[0].parts[..] else { panic!("{} parts", found[0].parts.len()) };
        assert_eq!((leaf.tool, stalk.tool), (Tool::Leaf, Tool::Branch));
        let joint = stalk.points[stalk.points.len() - 1].position;
        assert!(leaf.points[0].position.distance(joint) < 15.0);
    }

    #[test]
    fn round_lobes_along_a_midrib_are_a_leaf_and_without_one_are_not() {
        // Up one side of an oak's leaf and down the other.
        let side = |sign: f32| {
            let place = move |k: usize| {
                let t = k as f32 / 60.0;
                let width =
                    30.0 * (std::f32::consts::PI * t).sin() + 12.0 * (6.0 * std::f32::consts::PI * t).sin();
                Vec2::new(sign * width.max(0.0), -20.0 - 150.0 * t)
            };
            (0..=60).map(place).collect::<Vec<_>>()
        };
        let mut oak = side(1.0);
        oak.extend(side(-1.0).into_iter().rev());
        let to = |y: f32| line(&[(0.0, 10.0), (0.0, y)]);
        let found = read(&[oak.clone(), to(-150.0)]);
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].reading, &found[0].uses[..]), (Reading::Leaf, &[0, 1][..]));
        assert!(read(&[oak.clone(), to(-90.0)]).is_empty(), "the stem of a flower ends in its middle");
        let wide: Vec<Vec2> = oak.iter().map(|p| Vec2::new(2.2 * p.x, p.y)).collect();
        assert!(read(&[wide.clone(), to(-150.0)]).is_empty(), "a crown");
        let (stalk, midrib) = (line(&[(0.0, 30.0), (0.0, -18.0)]), line(&[(0.0, -24.0), (0.0, -150.0)]));
        assert_eq!(read(&[wide, stalk, midrib])[0].uses, [0, 1, 2], "its midrib is no stem");
    }

    #[test]
    fn petals_toward_the_stem_and_long_stems_make_no_leaf() {
        let stem = |foot: f32| line(&[(0.0, -70.0), (5.0, foot)]);
        let flower = star(&[-0.42, -0.25, -0.08, 0.08, 0.25, 0.42]);
        assert!(read(&[flower, stem(-10.0)]).is_empty());
        let palm = star(&[-0.3, -0.15, 0.0, 0.15, 0.3]);
        assert!(read(&[palm.clone(), stem(200.0)]).is_empty());
        assert!(read(&[palm]).is_empty(), "no stalk");
    }
}
