//! A leaf of several strokes, or of one with its stalk: outline, midrib, veins.
//!
//! Lines in a blade's outline ([`blade`](super::blade)) are its midrib and veins: the model draws veins of its own, so they only
//! say where the leaf's base is. The part of a midrib that sticks out is the stalk, as is a tail of the outline, and the blade's
//! root is where the stalk begins; else where a stem ends at the outline, else at the end of the midrib.
//!
//! What speaks for a leaf is a midrib along most of it with veins that begin there; a crown has lobes all around, a disc or a face
//! has something round inside, a body has spines that are short. A plain closed outline is one leaf as it is: no hypothesis.
//!
//! Limits: an outline inside of another is not understood.

use super::blade::{self, Blade};
use super::lobes::{self, Focus};
use super::page::{Line, Page};
use super::{Hypothesis, Made};
use crate::sketch::{Reading, Tool};
use glam::Vec2;

/// Least share of its hull that a blade fills.
const SOLID: f32 = 0.75;
/// Most of its bounds that a blade fills: an ellipse fills 0.79, a pot more.
const BOX: f32 = 0.85;
/// Most lobes around the middle of a blade.
const LOBES: usize = 4;
/// Least share of a vein's points in the outline, and of a midrib's that goes on as a stalk.
const INSIDE: (f32, f32) = (0.7, 0.3);
/// Least length of a midrib, as a share of the blade's diagonal, and its least chord over its length.
const MIDRIB: (f32, f32) = (0.28, 0.75);
/// Longest vein, over the diagonal of its bounds.
const VEIN: f32 = 2.0;
/// Shortest tail that is a stalk, as a share of the blade's diagonal, and the longest; where nothing else speaks for a leaf, the
/// shortest is twice as long.
const STALK: (f32, f32) = (0.1, 3.0);
/// Longest tail that is neither stalk nor midrib, as a share of the blade's diagonal: an end that went too far.
const OVERSHOT: f32 = 0.15;
/// Least distance of a stalk's end from the outline, as a share of its length: what runs along it is no stalk.
const OUTWARD: f32 = 0.6;
/// How far from the outline a stem or a midrib may end to be at it, as a share of the blade's diagonal.
const AT: f32 = 0.15;
/// Most lines that are looked at in one outline.
const MOST_LINES: usize = 64;

/// Proposes a leaf for each outline that has more than itself.
pub(super) fn propose(page: &Page, out: &mut Vec<Hypothesis>) {
    let of_one = (0..page.lines.len()).filter_map(|i| blade::of_one(i, &page.lines[i]));
    let blades: Vec<Blade> = of_one.chain(blade::of_two(page)).collect();
    let grown = |blade: &Blade| {
        let ((low, high), margin) = (blade.bounds(), Vec2::splat(AT * blade.diagonal()));
        (low - margin, high + margin)
    };
    let boxes: Vec<(Vec2, Vec2)> = blades.iter().map(grown).collect();
    let near = page.lines_at(&boxes);
    out.extend(blades.iter().zip(near).filter_map(|(blade, near)| leaf(page, blade, &near)));
}

/// The lines in and at a blade.
struct Parts<'a> {
    blade: &'a Blade,
    diagonal: f32,
    /// The longest straight line along the blade.
    midrib: Option<usize>,
    /// All lines inside, the midrib among them.
    inside: Vec<usize>,
    /// A line that ends at the outline from outside.
    stem: Option<Vec2>,
    stalks: Vec<Vec<Vec2>>,
    /// A midrib in one stroke with the outline, from the outline inward.
    inner_tail: Option<Vec<Vec2>>,
}

fn leaf(page: &Page, blade: &Blade, near: &[usize]) -> Option<Hypothesis> {
    if near.len() > MOST_LINES || blade.solidity() < SOLID || is_lobed(blade) {
        return None;
    }
    let size = blade.bounds().1 - blade.bounds().0;
    if lobes::area(&blade.ring) > BOX * size.x * size.y {
        return None;
    }
    let parts = Parts::of(page, blade, near)?;
    let is_plain = parts.inside.is_empty() && parts.stalks.is_empty() && blade.lines.len() == 1;
    if is_plain || parts.stalks.len() > 1 {
        return None;
    }
    let is_leaf = parts.has_midrib() || (blade.is_lens && (parts.inside.is_empty() || parts.stem.is_some()));
    let is_in_crown = |i: &usize| near.iter().any(|k| page.lines[*k].is_around(&page.lines[*i]));
    if !is_leaf || (!parts.has_midrib() && blade.lines.iter().any(is_in_crown)) {
        return None;
    }
    let root = parts.root(page);
    let mut ring = blade.ring.clone();
    ring.rotate_left(blade.nearest(root).0);
    ring.push(ring[0]);
    let mut made = vec![Made::new(Tool::Leaf, ring)];
    made.extend(parts.stalk(page).map(|points| Made::new(Tool::Branch, points)));
    let mut uses: Vec<usize> = blade.lines.iter().chain(&parts.inside).copied().collect();
    uses.sort_unstable();
    let score = parts.score() * page.weight(parts.diagonal);
    Some(Hypothesis { uses, score, parts: made, solids: Vec::new(), reading: Reading::Leaf, habit: None })
}

/// Whether an outline has lobes all around its middle.
fn is_lobed(blade: &Blade) -> bool {
    let (low, high) = blade.bounds();
    let focus = Focus { place: low.midpoint(high), half: 0.5 * (high - low) };
    let mut closed = blade.ring.clone();
    closed.push(closed[0]);
    lobes::cut(&closed, &focus, true).len() > LOBES
}

impl<'a> Parts<'a> {
    /// Sorts the lines near a blade; nothing where one inside is no vein.
    fn of(page: &Page, blade: &'a Blade, near: &[usize]) -> Option<Self> {
        let diagonal = blade.diagonal();
        let mut it = Self {
            blade,
            diagonal,
            midrib: None,
            inside: Vec::new(),
            stem: None,
            stalks: Vec::new(),
            inner_tail: None,
        };
        for &i in near.iter().filter(|i| blade.lines.binary_search(i).is_err()) {
            let line = &page.lines[i];
            let share = blade.share_of(line);
            let is_straight = line.ends().0.distance(line.ends().1) > MIDRIB.1 * line.length;
            let is_midrib = is_straight && share * line.length > MIDRIB.0 * diagonal && share > INSIDE.1;
            if share > INSIDE.0 && !is_midrib && !is_vein(line) {
                return None;
            }
            if is_midrib || share > INSIDE.0 {
                it.inside.push(i);
            } else if let Some(end) = stem_end(line, blade, AT * diagonal) {
                it.stem = Some(end);
            }
            let is_longer = it.midrib.is_none_or(|known| page.lines[known].length < line.length);
            if is_midrib && is_longer {
                it.midrib = Some(i);
            }
        }
        let least = if it.inside.is_empty() { 2.0 * STALK.0 } else { STALK.0 };
        for tail in &blade.tails {
            let length = crate::geom::polyline::length(tail) / diagonal;
            let end = tail[tail.len() - 1];
            let reach = blade.nearest(end).1 / diagonal;
            if blade.holds(end) {
                it.inner_tail = Some(tail.clone()).filter(|_| length > MIDRIB.0);
            } else if (least..STALK.1).contains(&length) && reach > OUTWARD * length {
                it.stalks.push(tail.clone());
            } else if length > OVERSHOT {
                return None;
            }
        }
        Some(it)
    }

    fn has_midrib(&self) -> bool {
        self.midrib.is_some() || self.inner_tail.is_some()
    }

    /// Where the blade grows from its stalk.
    fn root(&self, page: &Page) -> Vec2 {
        let tail = self.stalks.first().or(self.inner_tail.as_ref()).map(|tail| tail[0]);
        let midrib = || self.midrib.map(|i| self.base_of(&page.lines[i]));
        tail.or(self.stem).or_else(midrib).unwrap_or_else(|| self.sharper_end())
    }

    /// Where a midrib begins at the outline.
    fn base_of(&self, midrib: &Line) -> Vec2 {
        let (first, last) = midrib.ends();
        // The end that is outside or nearer to the outline; of equals the lower.
        let out =
            |p: Vec2| if self.blade.holds(p) { -self.blade.nearest(p).1 } else { self.blade.nearest(p).1 };
        let difference = out(first) - out(last);
        let is_first =
            if difference.abs() > AT * self.diagonal { difference > 0.0 } else { first.y > last.y };
        let (base, tip) = if is_first { (first, last) } else { (last, first) };
        if !self.blade.holds(base) {
            let from_base: Vec<Vec2> =
                if is_first { midrib.points.clone() } else { midrib.points.iter().rev().copied().collect() };
            return from_base.into_iter().find(|p| self.blade.holds(*p)).unwrap_or(base);
        }
        // Ahead of where the midrib begins.
        let along = (base - tip).normalize_or_zero();
        let off = |p: &Vec2| {
            let way = *p - base;
            way.perp_dot(along).abs() + 0.1 * way.length() - 10.0 * way.dot(along).min(0.0)
        };
        self.blade.ring.iter().copied().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(base)
    }

    /// Of an outline of two arcs the lower of its ends; of one stroke where it begins.
    fn sharper_end(&self) -> Vec2 {
        let ring = &self.blade.ring;
        if self.blade.lines.len() == 1 {
            return ring[0];
        }
        // The outline runs along one arc from end to end and back along the other.
        let far =
            (0..ring.len()).max_by(|a, b| ring[*a].distance(ring[0]).total_cmp(&ring[*b].distance(ring[0])));
        let other = far.map_or(ring[0], |i| ring[i]);
        if other.y > ring[0].y { other } else { ring[0] }
    }

    /// A stalk from the blade outward, a tail of the outline or of the midrib.
    fn stalk(&self, page: &Page) -> Option<Vec<Vec2>> {
        let of_midrib = || {
            let points = &page.lines[self.midrib?].points;
            let begins_outside = !self.blade.holds(points[0]);
            let from_end: Vec<Vec2> =
                if begins_outside { points.clone() } else { points.iter().rev().copied().collect() };
            let outside = from_end.iter().take_while(|p| !self.blade.holds(**p)).count();
            let stalk: Vec<Vec2> = from_end[..(outside + 1).min(from_end.len())].to_vec();
            (crate::geom::polyline::length(&stalk) > STALK.0 * self.diagonal).then_some(stalk)
        };
        self.stalks.first().cloned().or_else(of_midrib)
    }

    /// What speaks for a leaf.
    fn score(&self) -> f32 {
        let midrib = if self.has_midrib() { 1.4 } else { 0.0 };
        let stalk = if self.stalks.len() == 1 || self.stem.is_some() { 0.4 } else { 0.0 };
        1.6 + midrib + stalk + 0.1 * self.inside.len().min(8) as f32
    }
}

/// Whether a line may be a vein: open, and not to and fro.
fn is_vein(line: &Line) -> bool {
    line.openness > 0.3 && line.length < VEIN * line.size().length()
}

/// The end of a line that is at an outline while the other is away from it.
fn stem_end(line: &Line, blade: &Blade, at: f32) -> Option<Vec2> {
    let (first, last) = line.ends();
    let is_at = |p: Vec2| blade.nearest(p).1 < at;
    let is_away = |p: Vec2| !blade.holds(p) && blade.nearest(p).1 > at;
    if is_at(first) && is_away(last) {
        return Some(first);
    }
    (is_at(last) && is_away(first)).then_some(last)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::TAU;

    fn read(lines: &[Vec<Vec2>]) -> Vec<Hypothesis> {
        let mut out = Vec::new();
        propose(&Page::of_lines(lines), &mut out);
        out
    }

    fn line(places: &[(f32, f32)]) -> Vec<Vec2> {
        places.iter().map(|p| Vec2::from(*p)).collect()
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
        let [leaf] = found else { panic!("{} leaves", found.len()) };
        assert_eq!(leaf.parts[0].tool, Tool::Leaf);
        leaf
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
}
