//! What is drawn at a palm's fronds that is none: fruit, and the leaflets of fronds that are lines.
//!
//! Fruit are small round outlines at the trunk's top. Leaflets are several short straight lines that begin at longer ones. The
//! model has no fruit, and gives fronds leaflets of its own.
//!
//! Limits: leaflets that do not touch their frond are taken for fronds.

use crate::anatomy::conventions::page::{Line, Page};
use crate::anatomy::conventions::trees::trunk_sides::TrunkSides;
use crate::geom::polyline;
use glam::Vec2;
use std::collections::BTreeSet;

/// Largest fruit and its distance from the trunk's top, as shares of the reach of all.
const FRUIT: (f32, f32) = (0.25, 0.4);
/// Longest leaflet and how near it begins to its frond, as shares of the reach of all; fewest, and most lines that are looked at.
const LEAFLET: (f32, f32) = (0.4, 0.05);
const FEWEST_LEAFLETS: usize = 6;
const MOST_LINES: usize = 64;

/// Distance of the farthest point of a line from a place.
pub(crate) fn reach_of(line: &Line, place: Vec2) -> f32 {
    line.points.iter().map(|p| p.distance(place)).fold(0.0, f32::max)
}

/// Whether a line is a small round outline at the top of a trunk.
pub(crate) fn is_fruit(line: &Line, trunk: &TrunkSides, reach: f32) -> bool {
    let size = line.size();
    let is_round = size.max_element() < FRUIT.0 * reach && size.min_element() > 0.6 * size.max_element();
    is_round && line.is_closed_and_solid() && line.middle().distance(trunk.top()) < FRUIT.1 * reach
}

/// Short straight lines that begin at longer ones, if there are several: leaflets of fronds.
pub(crate) fn leaflets(page: &Page, group: &[usize], reach: f32) -> BTreeSet<usize> {
    if group.len() > MOST_LINES {
        return BTreeSet::new();
    }
    let begins_at = |line: &Line, other: &Line| {
        let near = |end: Vec2| {
            let margin = Vec2::splat(LEAFLET.1 * reach);
            let is_beside =
                end.cmpgt(other.bounds.0 - margin).all() && end.cmplt(other.bounds.1 + margin).all();
            is_beside && polyline::nearest(&other.points, end).is_some_and(|(gap, _)| gap < margin.x)
        };
        other.length > 2.0 * line.length && (near(line.ends().0) || near(line.ends().1))
    };
    let is_leaflet = |i: &&usize| {
        let line = &page.lines[**i];
        let is_short = line.length < LEAFLET.0 * reach && line.openness > 0.8;
        is_short && group.iter().any(|k| k != *i && begins_at(line, &page.lines[*k]))
    };
    let found: BTreeSet<usize> = group.iter().filter(is_leaflet).copied().collect();
    if found.len() < FEWEST_LEAFLETS { BTreeSet::new() } else { found }
}
