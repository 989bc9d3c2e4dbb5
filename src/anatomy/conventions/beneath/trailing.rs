//! Stems that trail over the edge of a pot, with their leaves.
//!
//! A stem begins in the mouth of the pot, passes over one side and ends below the edge beside it, or below the pot. What lies on such
//! stems are their leaves. A palm has such fronds as well, but its trunk is not wider above than below.
//!
//! Limits: stems that trail before the pot; leaves on stalks of their own.

use super::pot_rows::Row;
use crate::anatomy::conventions::page::{Line, Page};
use crate::geom::polyline;
use glam::Vec2;
use std::collections::BTreeSet;

/// Least width of a pot's upper third, in widths of its lower third.
const WIDER: f32 = 1.04;
/// Least width of a pot over which stems trail, as a share of the drawing's diagonal: small ones are leaves.
const WIDE: f32 = 0.12;
/// How far from its sides a stem begins at least, as a share of the pot's width, and how far above and below the edge at most, in its heights.
const MOUTH: (f32, f32, f32) = (0.08, 0.3, 0.35);
/// How far below the edge a stem ends at least, in heights of the pot, and least distance of its ends over the diagonal of its bounds.
const DOWN: f32 = 0.5;
const OPEN: f32 = 0.4;
/// How near to a stem a leaf is, as a share of its size, and its greatest size, as a share of the stem's.
const NEAR: f32 = 0.3;
const LEAF: f32 = 0.6;

/// The lines that trail over the edge of a pot of these bounds and rows, with what lies on them; none where it is narrower above.
pub(super) fn over(page: &Page, own: &[usize], (low, high): (Vec2, Vec2), rows: &[Row]) -> BTreeSet<usize> {
    let others = || (0..page.lines.len()).filter(|i| own.binary_search(i).is_err() && !page.is_apart(*i));
    if !is_wider_above(rows) || high.x - low.x < WIDE * page.diagonal {
        return BTreeSet::new();
    }
    let stems: Vec<usize> = others().filter(|i| trails(&page.lines[*i], (low, high))).collect();
    let lies_on = |line: &Line, stem: &Line| {
        let size = line.size().max_element();
        let gap = |p: &Vec2| polyline::nearest(&stem.points, *p).map_or(f32::INFINITY, |(gap, _)| gap);
        size < LEAF * stem.length && line.points.iter().map(gap).fold(f32::INFINITY, f32::min) < NEAR * size
    };
    let is_leaf = |i: &usize| stems.iter().any(|stem| lies_on(&page.lines[*i], &page.lines[*stem]));
    others().filter(|i| stems.contains(i) || is_leaf(i)).collect()
}

fn is_wider_above(rows: &[Row]) -> bool {
    let third = rows.len() / 3;
    let width = |part: &[Row]| part.iter().map(Row::width).sum::<f32>();
    third > 0 && width(&rows[..third]) > WIDER * width(&rows[rows.len() - third..])
}

/// Whether a line begins in the mouth and hangs over one side.
fn trails(line: &Line, (low, high): (Vec2, Vec2)) -> bool {
    let size = high - low;
    let is_in_mouth = |p: Vec2| {
        (low.x + MOUTH.0 * size.x..high.x - MOUTH.0 * size.x).contains(&p.x)
            && (low.y - MOUTH.1 * size.y..low.y + MOUTH.2 * size.y).contains(&p.y)
    };
    let hangs = |p: Vec2| {
        let is_beside = p.x < low.x || p.x > high.x;
        p.y > low.y + DOWN * size.y && (is_beside || p.y > high.y)
    };
    let (first, last) = line.ends();
    let passes_a_side = line.bounds.0.x < low.x || line.bounds.1.x > high.x;
    line.openness > OPEN
        && passes_a_side
        && (is_in_mouth(first) && hangs(last) || is_in_mouth(last) && hangs(first))
}
