//! What belongs to a blade: midrib, veins, stalk, and where the blade grows from its stalk.
//!
//! Lines in the outline are its midrib and veins; the midrib is the longest narrow one along the blade, drawn to and fro or
//! as two lines just as well, or the end of the outline's own stroke that runs back through it. What of it is outside is the stalk, as
//! is a tail of the outline, or two lines side by side that end there. The blade's root is where the stalk begins; else where a stem ends at the outline, else at the end of the midrib.

use super::blade::Blade;
use crate::anatomy::conventions::page::{Line, Page, even};
use crate::anatomy::conventions::shapes::forks;
use crate::geom::{polyline, simple_loop};
use glam::Vec2;

/// Least share of a vein's points in the outline, and of a midrib's that goes on as a stalk.
const INSIDE: (f32, f32) = (0.7, 0.3);
/// Least length of a midrib, as a share of the blade's diagonal, its least chord over its length, and the largest area of its
/// hull, as a share of the square of its extent, where it is drawn to and fro.
const MIDRIB: (f32, f32) = (0.28, 0.75);
const THROUGHOUT: f32 = 0.5;
const NARROW: f32 = 0.1;
/// Least length over the extent of a line that is drawn to and fro.
const TO_AND_FRO: f32 = 1.6;
/// Longest vein, over the diagonal of its bounds.
const VEIN: f32 = 2.0;
/// Shortest tail that is a stalk, as a share of the blade's diagonal, and the longest; where nothing else speaks for a leaf, the
/// shortest is twice as long.
const STALK: (f32, f32) = (0.1, 3.0);
/// Longest tail that is neither stalk nor midrib, as a share of the blade's diagonal: an end that went too far; and beside a stalk.
const OVERSHOT: (f32, f32) = (0.2, 0.25);
/// Least area of such an outline, as a share of the square of its diagonal: the sides of a narrow one may cross anywhere.
const FAT: f32 = 0.2;
/// Least distance of a stalk's end from the outline, as a share of its length: what runs along it is no stalk.
const OUTWARD: f32 = 0.6;
/// How far from the outline a stem or a midrib may end to be at it, as a share of the blade's diagonal.
pub(crate) const AT: f32 = 0.15;
/// How near to the outline a line stays that draws a piece of it again, as a share of the blade's diagonal and of its own length.
const ALONG: (f32, f32) = (0.1, 0.3);
/// Least opening of such a line: one that closes is a blade of its own.
const OPEN: f32 = 0.5;
/// Farthest that a midrib or a stalk passes from the middle of a wide gap, in widths of the gap.
const THROUGH: f32 = 0.6;
/// Least distance of half of a midrib from the outline, as a share of the blade's mean width: in the middle of a lens about 0.5.
const AMID: f32 = 0.2;
/// Farthest distance of a vein's end from the midrib, as a share of the blade's diagonal, and log-odds of each.
const JOINED: f32 = 0.06;
const VEINS: f32 = 0.25;
/// Log-odds of a midrib that stands below a blade without a tip and has twigs: a tree.
const FORKED: f32 = -2.0;
/// Points of a line drawn to and fro that is taken as one.
const POINTS: usize = 60;

/// The lines in and at a blade.
pub(crate) struct Parts<'a> {
    page: &'a Page,
    blade: &'a Blade,
    pub diagonal: f32,
    /// The longest straight line along the blade.
    midrib: Option<usize>,
    /// All lines inside, the midrib among them, and those of a stalk in two lines.
    pub inside: Vec<usize>,
    /// Lines that end at the outline from outside, and where.
    stems: Vec<(usize, Vec2)>,
    /// From the outline outward.
    pub stalks: Vec<Vec<Vec2>>,
    /// A midrib in one stroke with the outline, from where it begins.
    inner_tail: Option<Vec<Vec2>>,
}

impl<'a> Parts<'a> {
    /// Sorts the lines near a blade; nothing where one inside is no vein.
    pub(crate) fn of(page: &'a Page, blade: &'a Blade, near: &[usize]) -> Option<Self> {
        let mut it = Self {
            page,
            blade,
            diagonal: blade.diagonal(),
            midrib: None,
            inside: Vec::new(),
            stems: Vec::new(),
            stalks: Vec::new(),
            inner_tail: None,
        };
        it.inner_tail = blade.midrib.clone().filter(|points| it.is_amid(points));
        for &i in near.iter().filter(|i| blade.lines.binary_search(i).is_err()) {
            it.sort(i)?;
        }
        let least = if it.inside.is_empty() { 2.0 * STALK.0 } else { STALK.0 };
        blade.tails.iter().try_for_each(|tail| it.sort_tail(tail, least))?;
        it.leave_overshot();
        it.passes_gap().then_some(it)
    }

    /// Sorts one line; nothing where it is inside and no vein.
    fn sort(&mut self, i: usize) -> Option<()> {
        let line = &self.page.lines[i];
        let share = self.blade.share_of(line);
        let is_long = share * extent(line) > MIDRIB.0 * self.diagonal && share > INSIDE.1;
        let is_midrib =
            is_long && (is_straight(line) || self.is_double_stalk(line)) && self.is_amid(&line.points);
        let away = || self.blade.farthest(line);
        let is_restated =
            || line.openness > OPEN && away() < (ALONG.0 * self.diagonal).min(ALONG.1 * line.length);
        if share > INSIDE.0 && !is_midrib && !is_vein(line) {
            return None;
        }
        if is_midrib || share > INSIDE.0 || is_restated() {
            self.inside.push(i);
        } else if let Some(end) = stem_end(line, self.blade, AT * self.diagonal) {
            self.stems.push((i, end));
        }
        let is_longer = self.midrib.is_none_or(|known| self.page.lines[known].length < line.length);
        if is_midrib && is_longer {
            self.midrib = Some(i);
        }
        Some(())
    }

    /// Whether a line is a midrib drawn to and fro: its ends are outside, where it is the stalk.
    fn is_double_stalk(&self, line: &Line) -> bool {
        let is_out = |p: Vec2| !self.blade.holds(p) && self.blade.nearest(p).1 > STALK.0 * self.diagonal;
        let extent = line.size().length();
        let is_narrow = line.hull_area < NARROW * extent * extent;
        is_to_and_fro(line) && is_narrow && is_out(line.ends().0) && is_out(line.ends().1)
    }

    /// Whether what of a line is inside keeps away from the outline: what runs along it is the ground, or draws it again.
    fn is_amid(&self, points: &[Vec2]) -> bool {
        let inside = points.iter().step_by(3).filter(|p| self.blade.holds(**p));
        let mut away: Vec<f32> = inside.map(|p| self.blade.nearest(*p).1).collect();
        let middle = away.len() / 2;
        let least = AMID * simple_loop::area(&self.blade.ring) / self.diagonal;
        away.is_empty() || *away.select_nth_unstable_by(middle, f32::total_cmp).1 > least
    }

    /// How many lines inside begin at the midrib.
    fn joined_veins(&self) -> usize {
        let Some(midrib) = self.midrib else { return 0 };
        let points = &self.page.lines[midrib].points;
        let at = |p: Vec2| polyline::nearest(points, p).is_some_and(|(gap, _)| gap < JOINED * self.diagonal);
        let is_joined = |i: &&usize| {
            let (first, last) = self.page.lines[**i].ends();
            **i != midrib && (at(first) || at(last))
        };
        self.inside.iter().filter(is_joined).count()
    }

    /// Sorts a tail of the outline: through the blade it is the midrib, from there or from the outline outward the stalk.
    fn sort_tail(&mut self, tail: &[Vec2], least: f32) -> Option<()> {
        let within = tail.iter().rposition(|p| self.blade.holds(*p)).unwrap_or(0);
        let held: usize = tail.iter().filter(|p| self.blade.holds(**p)).count();
        let length = polyline::length(tail) / self.diagonal;
        let is_straight = tail[0].distance(tail[within]) > MIDRIB.1 * polyline::length(&tail[..=within]);
        let is_midrib =
            is_straight && length * held as f32 > MIDRIB.0 * tail.len() as f32 && self.is_amid(tail);
        let outside = if is_midrib { &tail[within..] } else { tail };
        if is_midrib {
            self.inner_tail = Some(tail[..=within].to_vec());
        }
        let length = polyline::length(outside) / self.diagonal;
        let reach = self.blade.nearest(outside[outside.len() - 1]).1 / self.diagonal;
        let least = if is_midrib { STALK.0 } else { least };
        if (least..STALK.1).contains(&length) && reach > OUTWARD * length {
            self.stalks.push(outside.to_vec());
        } else if length > OVERSHOT.0 {
            return None;
        }
        Some(())
    }

    /// Of two stalks, leaves out the one that is a short end beside a long stalk: an outline that crosses its own stem.
    fn leave_overshot(&mut self) {
        let length = |stalk: &Vec<Vec2>| polyline::length(stalk);
        if simple_loop::area(&self.blade.ring) < FAT * self.diagonal * self.diagonal {
            return;
        }
        self.stalks.sort_by(|a, b| length(b).total_cmp(&length(a)));
        if let [long, short] = &self.stalks[..]
            && length(short) < (OVERSHOT.1 * self.diagonal).min(0.4 * length(long))
        {
            self.stalks.pop();
        }
    }

    /// Whether a midrib or a stem passes the gap of the outline, if that is wide.
    fn passes_gap(&self) -> bool {
        let Some((a, b)) = self.blade.gap else { return true };
        let (middle, reach) = (a.midpoint(b), THROUGH * a.distance(b));
        let passes = |points: &[Vec2]| points.iter().any(|p| p.distance(middle) < reach);
        let of_line = |i: usize| passes(&self.page.lines[i].points);
        self.midrib.is_some_and(of_line) || self.inner_tail.as_ref().is_some_and(|points| passes(points))
    }

    pub(crate) fn has_midrib(&self) -> bool {
        self.midrib.is_some() || self.inner_tail.is_some()
    }

    /// Length of the midrib in the outline, as a share of the blade's diagonal.
    fn reach_of_midrib(&self) -> f32 {
        let of_line = self.midrib.map(|i| {
            let line = &self.page.lines[i];
            self.blade.share_of(line) * extent(line)
        });
        let of_tail = self.inner_tail.as_ref().map(|points| polyline::length(points));
        of_line.into_iter().chain(of_tail).fold(0.0, f32::max) / self.diagonal
    }

    /// Whether lobes may be those of a leaf: the midrib goes on as a stalk, and veins leave it, or it goes through most of the blade.
    pub(crate) fn speak_for_lobes(&self) -> bool {
        let is_veined = self.veins() > 0 || self.reach_of_midrib() > THROUGHOUT;
        self.has_midrib() && self.has_stalk() && is_veined
    }

    /// Whether a stem ends at the outline.
    pub(crate) fn has_stem(&self) -> bool {
        !self.stems.is_empty()
    }

    /// Whether the midrib or the outline goes on as a stalk.
    fn has_stalk(&self) -> bool {
        !self.stalks.is_empty() || self.stalk_of_midrib().is_some()
    }

    /// How many lines inside are not the midrib.
    fn veins(&self) -> usize {
        self.inside.len() - usize::from(self.midrib.is_some())
    }

    /// Whether all lines of a group belong to the blade or are stems at it.
    pub(crate) fn explain(&self, group: &[usize]) -> bool {
        let is_own = |i: &usize| self.blade.lines.contains(i) || self.inside.contains(i);
        group.iter().all(|i| is_own(i) || self.stems.iter().any(|stem| stem.0 == *i))
    }

    /// Where the blade grows from its stalk.
    pub(crate) fn root(&self) -> Vec2 {
        let of_midrib = self.stalk_of_midrib().map(|stalk| stalk[stalk.len() - 1]);
        let tail = of_midrib.or_else(|| self.stalks.first().map(|tail| tail[0]));
        let stem = self.stems.last().map(|stem| stem.1);
        let midribs =
            self.midrib.map(|i| along(&self.page.lines[i])).into_iter().chain(self.inner_tail.clone());
        let longest = midribs.max_by(|a, b| polyline::length(a).total_cmp(&polyline::length(b)));
        let base = || longest.map(|points| self.base_of(&points));
        tail.or(stem).or_else(base).unwrap_or_else(|| self.sharper_end())
    }

    /// Where a midrib begins at the outline.
    fn base_of(&self, midrib: &[Vec2]) -> Vec2 {
        let (first, last) = (midrib[0], midrib[midrib.len() - 1]);
        // The end that is outside or nearer to the outline; of equals the lower.
        let out =
            |p: Vec2| if self.blade.holds(p) { -self.blade.nearest(p).1 } else { self.blade.nearest(p).1 };
        let difference = out(first) - out(last);
        let is_first =
            if difference.abs() > AT * self.diagonal { difference > 0.0 } else { first.y > last.y };
        let (base, tip) = if is_first { (first, last) } else { (last, first) };
        if !self.blade.holds(base) {
            let from_base: Vec<Vec2> =
                if is_first { midrib.to_vec() } else { midrib.iter().rev().copied().collect() };
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

    /// A stalk, a tail of the midrib or of the outline, the longer of them.
    pub(crate) fn stalk(&self) -> Option<Vec<Vec2>> {
        self.stalk_of_midrib().or_else(|| self.stalks.first().cloned())
    }

    /// What of the midrib is outside, from its free end to the blade.
    fn stalk_of_midrib(&self) -> Option<Vec<Vec2>> {
        let points = along(&self.page.lines[self.midrib?]);
        let begins_outside = !self.blade.holds(points[0]);
        let from_end: Vec<Vec2> = if begins_outside { points } else { points.into_iter().rev().collect() };
        let outside = from_end.iter().take_while(|p| !self.blade.holds(**p)).count();
        let stalk: Vec<Vec2> = from_end[..(outside + 1).min(from_end.len())].to_vec();
        let length = polyline::length(&stalk);
        let other = self.stalks.first().map_or(0.0, |tail| polyline::length(tail));
        (length > STALK.0 * self.diagonal && length > other).then_some(stalk)
    }

    /// Whether midrib and veins are a trunk that forks.
    fn is_tree(&self) -> bool {
        let Some(midrib) = self.midrib else { return false };
        let inside = self.inside.iter().filter(|i| **i != midrib).map(|i| &self.page.lines[*i]);
        forks::is_tree(&self.blade.ring, &self.page.lines[midrib].points, inside)
    }

    /// What speaks for a leaf.
    pub(crate) fn score(&self) -> f32 {
        let through = if self.reach_of_midrib() > THROUGHOUT { 0.5 } else { 0.0 };
        let midrib = if self.has_midrib() { 1.4 + through } else { 0.0 };
        let stalk = if self.stalks.len() == 1 || self.has_stem() { 0.4 } else { 0.0 };
        let explained = self.inside.len() + self.blade.lines.len() - 1;
        let veins = VEINS * self.joined_veins().min(6) as f32;
        let tree = if self.is_tree() { FORKED } else { 0.0 };
        1.6 + midrib + stalk + veins + 0.1 * explained.min(12) as f32 + tree
    }
}

/// Distance between the places of a line that are farthest apart, about.
fn extent(line: &Line) -> f32 {
    let (first, last) = line.ends();
    if is_to_and_fro(line) { line.size().length() } else { first.distance(last).max(0.7 * line.length) }
}

/// Whether a line goes one way.
fn is_straight(line: &Line) -> bool {
    line.ends().0.distance(line.ends().1) > MIDRIB.1 * line.length
}

/// Whether a line comes back the way it went.
fn is_to_and_fro(line: &Line) -> bool {
    (TO_AND_FRO..3.0).contains(&(line.length / line.size().length())) && line.openness < 0.4
}

/// A line as its middle, if it was drawn to and fro.
fn along(line: &Line) -> Vec<Vec2> {
    if !is_to_and_fro(line) {
        return line.points.clone();
    }
    let middle = line.ends().0.midpoint(line.ends().1);
    let away = |i: &usize| line.points[*i].distance_squared(middle);
    let turn = (0..line.points.len()).max_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(0);
    let there = even(&line.points[..=turn], POINTS);
    let back = even(&line.points[turn..], POINTS);
    there.iter().zip(back.iter().rev()).map(|(a, b)| a.midpoint(*b)).collect()
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
