//! Which lines around a flower's centre are its petals, and which speak against a flower there.
//!
//! A petal's line comes near the centre and reaches out from there: with both ends near it, with notches toward it, or all around it as a ring of
//! lobes. An arc that ends at two petals is one partly behind them. A straight line through the centre and beyond the petals is a twig, and
//! a ring on the two sides of a trunk a crown.
//!
//! Distances are measured in half sizes of the centre ([`Focus`]).

use crate::anatomy::conventions::page::{Line, Page, even};
use crate::anatomy::conventions::shapes::lobes::{self, Focus};
use crate::anatomy::conventions::shapes::stem_tail;
use crate::geom::polyline;
use glam::Vec2;
use std::borrow::Cow;
use std::f32::consts::{PI, TAU};

/// Largest opening of a round stroke.
pub(super) const OPEN: f32 = 0.35;
/// How far from the middle a petal reaches, in half sizes of the centre, and where petals' lines come nearest to it.
pub(super) const REACH: (f32, f32) = (1.3, 6.0);
pub(super) const NEAREST: f32 = 2.2;
/// The same for a petal in a stroke of its own that encloses so much of its hull: a small centre has long petals.
const FAR: (f32, f32) = (12.0, 0.85);
/// How far away a ring of lobes is at most, in half sizes of the centre.
const RING_FAR: f32 = 9.0;
/// Farthest end of an arc for one petal, as a share of its reach.
const BACK: f32 = 0.7;
/// Least area between a petal's arc and its chord, over the square of its length, if only one of its ends is near the centre, and greatest
/// chord over its length.
const BULGE: (f32, f32) = (0.05, 0.75);
/// Fewest petals beside one that is partly behind them, least angle that its arc fills, how near to them it ends, as a share of its size,
/// and its greatest chord over its length.
const BESIDE: (usize, f32, f32, f32) = (2, 0.3, 0.1, 0.9);
/// How far from the middle of a ring of lobes that is far around it a centre may be, as a share of the ring's size; least turns and
/// lobes of that: a crown has apples in any place.
const RING_OFF: f32 = 0.16;
const RING_TURNS: f32 = 0.85;
const RING_LOBES: usize = 5;

/// How far below such a ring the sides of a trunk go, and where they begin, as shares of its height; width of both sides in one line, as a
/// share of its width.
const TRUNK: (f32, f32, f32) = (0.25, 0.08, 0.12);

/// Least chord of a line through a corolla over its length, and how far its ends are from the centre, in reaches of the petals.
const THROUGH: (f32, f32) = (0.85, 1.1);

/// A line around a centre, without the stem that is one stroke with it.
pub(super) struct Around<'a> {
    pub(super) line: Cow<'a, Line>,
    pub(super) stem: Option<Vec<Vec2>>,
}

impl<'a> Around<'a> {
    pub(super) fn new(line: &'a Line, focus: &Focus) -> Option<Self> {
        let of_rest = stem_tail::cut(line).filter(|(_, rest)| is_around(rest, focus));
        match of_rest {
            Some((stem, rest)) => Some(Self { line: Cow::Owned(rest), stem: Some(stem) }),
            None => is_around(line, focus).then_some(Self { line: Cow::Borrowed(line), stem: None }),
        }
    }

    /// An arc behind petals, led on to the centre from both of its ends.
    pub(super) fn behind(line: &'a Line, focus: &Focus) -> Option<Self> {
        let edge = |end: Vec2| {
            focus.place + REACH.0 * focus.half * ((end - focus.place) / focus.half).normalize_or_zero()
        };
        let (first, last) = line.ends();
        let points = [&[edge(first)], &line.points[..], &[edge(last)]].concat();
        Some(Self { line: Cow::Owned(line.part(even(&points, points.len()))?), stem: None })
    }
}

/// Whether an arc bulges outward between petals at which it ends, or between one and the centre: a petal partly behind them.
pub(super) fn is_behind(line: &Line, focus: &Focus, petals: &[(usize, Around)]) -> bool {
    let (first, last) = line.ends();
    let reach = focus.reach(&line.points);
    let is_one = petals.len() >= BESIDE.0
        && (REACH.0..FAR.0).contains(&reach)
        && first.distance(last) < BESIDE.3 * line.length
        && line.area > BULGE.0 * line.length * line.length
        && (BESIDE.1..PI).contains(&lobes::winding(&line.points, focus.place))
        && line.points.iter().all(|p| focus.distance(*p) > REACH.0 - 0.3);
    let is_at_petal = |end: Vec2| {
        let gap = |(_, around): &(usize, Around)| {
            polyline::nearest(&around.line.points, end).map_or(f32::INFINITY, |(gap, _)| gap)
        };
        petals.iter().map(gap).fold(f32::INFINITY, f32::min) < BESIDE.2 * line.size().length()
    };
    let is_at = |end: Vec2| focus.distance(end) < NEAREST || is_at_petal(end);
    let bulge = focus.distance(line.points[line.points.len() / 2]) - focus.distance(first.midpoint(last));
    is_one
        && is_at(first)
        && is_at(last)
        && bulge > 0.0
        && petals.iter().all(|(_, it)| !std::ptr::eq(&*it.line, line))
}

/// Whether a line comes near a centre and reaches out from there, with both ends near it, with notches, or around it.
fn is_around(line: &Line, focus: &Focus) -> bool {
    let reach = focus.reach(&line.points);
    let nearest = line.points.iter().map(|p| focus.distance(*p)).fold(f32::INFINITY, f32::min);
    let (first, last) = line.ends();
    let is_left_open = focus.distance(first).min(focus.distance(last)) < NEAREST
        && line.area > BULGE.0 * line.length * line.length
        && first.distance(last) < BULGE.1 * line.length;
    let comes_back = focus.distance(first).max(focus.distance(last)) < BACK * reach
        || line.openness < OPEN
        || is_left_open;
    let has_notches =
        || lobes::winding(&line.points, focus.place) > PI || lobes::cut(&line.points, focus, false).len() > 1;
    let ends_there = focus.distance(first).max(focus.distance(last)) < NEAREST;
    let is_petal = || {
        line.solidity() > FAR.1 && (ends_there || is_left_open || line.openness < OPEN && nearest < REACH.0)
    };
    let farthest = if reach > REACH.1 && is_petal() { FAR.0 } else { REACH.1 };
    (REACH.0..farthest).contains(&reach) && nearest < NEAREST && (comes_back || has_notches())
        || (NEAREST..RING_FAR).contains(&nearest) && reach < RING_FAR && is_ring(line, focus)
}

/// Whether a line is a ring of many lobes about a small centre in its middle.
fn is_ring(line: &Line, focus: &Focus) -> bool {
    let off = (line.middle() - focus.place).abs() / line.size();
    line.openness < OPEN
        && off.max_element() < RING_OFF
        && lobes::winding(&line.points, focus.place) > RING_TURNS * TAU
        && lobes::cut(&line.points, focus, true).len() >= RING_LOBES
}

/// Whether a line is nearly straight, passes a centre and goes on beyond the petals on either side: a twig with leaves has no corolla.
pub(super) fn goes_through(line: &Line, focus: &Focus, reach: f32) -> bool {
    let (first, last) = line.ends();
    let nearest = line.points.iter().map(|p| focus.distance(*p)).fold(f32::INFINITY, f32::min);
    nearest < REACH.0
        && first.distance(last) > THROUGH.0 * line.length
        && focus.distance(first).min(focus.distance(last)) > THROUGH.1 * reach
        && (first - focus.place).dot(last - focus.place) < 0.0
}

/// Whether a ring far around a centre has the two sides of a trunk below, or something as wide.
pub(super) fn stands_on_trunk(page: &Page, ring: &Line, focus: &Focus) -> bool {
    if !is_ring(ring, focus) || ring.points.iter().any(|p| focus.distance(*p) < NEAREST) {
        return false;
    }
    let ((_, foot), size) = (ring.bounds, ring.size());
    let sides = |line: &Line| {
        let hangs =
            line.bounds.1.y > foot.y + TRUNK.0 * size.y && line.bounds.0.y < foot.y + TRUNK.1 * size.y;
        let is_wide = line.size().x > TRUNK.2 * size.x && line.openness < 0.8;
        usize::from(hangs) * if is_wide { 2 } else { 1 }
    };
    let grown = TRUNK.1 * size;
    let below = page.lines_at(&[(ring.bounds.0, foot + grown)]);
    below.iter().flatten().map(|i| sides(&page.lines[*i])).sum::<usize>() > 1
}
