//! What closes an outline whose arcs end without meeting, at a leaf's tip or its base.
//!
//! Ends of arcs that are nearest to one another are joined: straight on to where both arcs lead, if that is near, or else straight
//! across. Closed as an area alone, such a gap would be a bite out of the leaf.
//!
//! Limits: gaps wider than [`MEET`]; outlines of more than [`MOST`] arcs; a line that is no arc closes nothing. Cost: the square of the arcs of a group.

use crate::anatomy::conventions::page::{self, Line, Page, even, is_bow};
use glam::Vec2;

/// Least opening of an arc.
const OPEN: f32 = 0.25;
/// Most arcs of an outline: more are the twigs of a tree.
const MOST: usize = 4;
/// Widest gap, as a share of the group's diagonal.
const MEET: f32 = 0.2;
/// How far the place where both arcs lead is from the middle of the gap at most, in widths of the gap.
const AHEAD: f32 = 1.0;
/// Part of a line at whose end its direction is measured.
const END: usize = 10;
/// Points of what closes a gap.
const POINTS: usize = 24;

/// An end of a line: the line's number, the place, and where it leads.
type End = (usize, Vec2, Vec2);

/// Lines that join the open ends of the arcs in a group.
pub(super) fn closing(page: &Page, group: &[usize]) -> Vec<Vec<Vec2>> {
    let (low, high) = page::bounds(group.iter().map(|i| &page.lines[*i]));
    let most = MEET * low.distance(high);
    let is_arc = |line: &Line| line.openness > OPEN && is_bow(&line.points);
    let arcs = group.iter().filter(|i| is_arc(&page.lines[**i]));
    let ends: Vec<End> = arcs.flat_map(|i| ends_of(*i, &page.lines[*i])).collect();
    if ends.len() > 2 * MOST {
        return Vec::new();
    }
    let gap = |a: usize, b: usize| ends[a].1.distance(ends[b].1);
    let nearest = |from: usize| {
        let others = (0..ends.len()).filter(|to| ends[*to].0 != ends[from].0);
        others.min_by(|a, b| gap(from, *a).total_cmp(&gap(from, *b)))
    };
    let pair = |a: usize| nearest(a).filter(|b| a < *b && nearest(*b) == Some(a)).map(|b| (a, b));
    let pairs = (0..ends.len()).filter_map(pair).filter(|(a, b)| gap(*a, *b) < most);
    pairs.map(|(a, b)| joined(ends[a], ends[b])).collect()
}

/// Both ends of a line.
fn ends_of(number: usize, line: &Line) -> [End; 2] {
    let points = &line.points;
    let last = points.len() - 1;
    let inner = (points.len() / END).clamp(1, last.max(1)).min(last);
    [
        (number, points[0], points[0] - points[inner]),
        (number, points[last], points[last] - points[last - inner]),
    ]
}

/// From one end to the other by the place where both lead, if that is near.
fn joined((_, a, along): End, (_, b, back): End) -> Vec<Vec2> {
    let turn = along.perp_dot(back);
    let (ahead, beyond) = ((b - a).perp_dot(back) / turn, (b - a).perp_dot(along) / turn);
    let tip = a + ahead * along;
    let leads_there = ahead > 0.0 && beyond > 0.0 && tip.distance(a.midpoint(b)) < AHEAD * a.distance(b);
    if leads_there { even(&[a, tip, b], POINTS) } else { even(&[a, b], POINTS) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One side of a lens from (0, 0) to (0, -100), without a share of it at its tip.
    fn side(sign: f32, less: f32) -> Vec<Vec2> {
        let place = |t: f32| Vec2::new(sign * 120.0 * t * (1.0 - t), -100.0 * t);
        (0..=50).map(|k| place((1.0 - less) * k as f32 / 50.0)).collect()
    }

    #[test]
    fn arcs_that_lead_to_one_place_are_joined_there() {
        let page = Page::of_lines(&[side(1.0, 0.06), side(-1.0, 0.06)]);
        let closing = closing(&page, &[0, 1]);
        let highest = closing.iter().flatten().map(|p| p.y).fold(0.0, f32::min);
        assert!(highest < -97.0 && highest > -104.0, "{highest}");
    }

    #[test]
    fn many_bent_twigs_are_no_outline() {
        let twig = |k: usize| side(1.0, 0.1).into_iter().map(|p| p + Vec2::X * 6.0 * k as f32).collect();
        let twigs: Vec<Vec<Vec2>> = (0..6).map(twig).collect();
        assert!(closing(&Page::of_lines(&twigs), &[0, 1, 2, 3, 4, 5]).is_empty());
    }

    #[test]
    fn ends_that_are_far_apart_stay_open() {
        let page = Page::of_lines(&[side(1.0, 0.45), side(-1.0, 0.45)]);
        assert!(closing(&page, &[0, 1]).iter().flatten().all(|p| p.y > -10.0));
    }
}
