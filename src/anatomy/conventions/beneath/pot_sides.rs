//! The two sides of a pot whose bottom is a line of its own.
//!
//! From each end of the bottom a line rises. A stem rises as well, but it carries something on its upper end, and so none of the
//! two does, unless a third line goes from one end to the other: the mouth. Sides bulge less than half a circle does: those would be
//! arcs of a bush.
//!
//! Limits: sides in several strokes.

use crate::anatomy::conventions::page::{Line, Page};
use crate::geom::polyline;
use glam::Vec2;

/// How far from an end of the bottom a side begins at most, and its least height, as shares of the bottom's width.
const NEAR: f32 = 0.2;
const LOWEST: f32 = 0.15;
/// How far a side lies from its chord at most, as a share of that: half a circle has 0.5.
const BULGE: f32 = 0.4;
/// How near to the upper end of a side something else ends that it carries, as a share of its height.
const CARRIED: f32 = 0.12;
/// How near to the upper ends of both sides the ends of a mouth are, as a share of the bottom's width.
const MOUTH: f32 = 0.15;

/// A line that rises from an end of the bottom, and its upper end.
#[derive(Clone, Copy)]
struct Side {
    number: usize,
    top: Vec2,
}

/// A level line with the two lines that rise from its ends.
pub(super) fn with_bottom(page: &Page, bottom: usize) -> Option<[usize; 3]> {
    let line = &page.lines[bottom];
    let (width, (left, right)) = (line.size().x, line.ends());
    let rights = rising(page, right, width);
    let pairs = || rising(page, left, width).into_iter().flat_map(|a| rights.iter().map(move |b| (a, *b)));
    let stands_free = |side: Side| !carries(page, side, width);
    let are_sides = |(a, b): &(Side, Side)| {
        a.number != b.number && (has_mouth(page, (*a, *b), width) || stands_free(*a) && stands_free(*b))
    };
    pairs().find(are_sides).map(|(a, b)| [a.number, bottom, b.number])
}

/// All lines that rise from a corner.
fn rising(page: &Page, corner: Vec2, width: f32) -> Vec<Side> {
    let side = |number: usize| {
        let line = &page.lines[number];
        let (first, last) = line.ends();
        let (foot, top) = if first.y > last.y { (first, last) } else { (last, first) };
        let is_side = foot.distance(corner) < NEAR * width
            && line.size().y > line.size().x.max(LOWEST * width)
            && bulge(line) < BULGE;
        is_side.then_some(Side { number, top })
    };
    (0..page.lines.len()).filter_map(side).collect()
}

/// How far a line lies from its chord, as a share of that.
fn bulge(line: &Line) -> f32 {
    let (first, last) = line.ends();
    let chord = last - first;
    let away = line.points.iter().map(|p| chord.perp_dot(*p - first).abs()).fold(0.0, f32::max);
    away / chord.length_squared().max(f32::MIN_POSITIVE)
}

/// Whether a line goes from the upper end of one side to that of the other.
fn has_mouth(page: &Page, (a, b): (Side, Side), width: f32) -> bool {
    let near = MOUTH * width;
    page.lines.iter().any(|line| {
        let (first, last) = line.ends();
        let joins = |p: Vec2, q: Vec2| p.distance(a.top) < near && q.distance(b.top) < near;
        joins(first, last) || joins(last, first)
    })
}

/// Whether something no wider than the bottom stands on the upper end of a line, which is a stem then and no side.
fn carries(page: &Page, side: Side, width: f32) -> bool {
    let (line, top) = (&page.lines[side.number], side.top);
    let near = CARRIED * line.size().y;
    page.lines.iter().any(|other| {
        let (low, high) = other.bounds;
        let is_over = low.x - near < top.x && top.x < high.x + near && other.middle().y < top.y;
        let reach = near.max(0.3 * other.size().y);
        is_over
            && polyline::nearest(&other.points, top).is_some_and(|(gap, _)| gap < reach)
            && high.y > top.y - near
            && high.y < top.y + reach
            && high.x - low.x < width
    })
}
