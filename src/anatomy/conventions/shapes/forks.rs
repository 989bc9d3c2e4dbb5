//! Twigs in a crown on a single line, which a leaf's veins are like.
//!
//! A trunk forks: one line leaves it, or two do where one line touches it between its ends, and all end before the outline. Veins reach
//! the edge of their blade, and the midrib goes on nearly to the tip.

use crate::anatomy::conventions::page::{self, Line};
use crate::geom::polyline;
use glam::Vec2;

/// How near to the trunk twigs begin, as a share of the whole height, and how far from the outline they end, at least.
const AT: f32 = 0.05;
const FREE: f32 = 0.08;
/// Least distance of a trunk's end below the top of a crown with a single twig, as a share of the crown's height, and the same of any.
const SHORT: (f32, f32) = (0.18, 0.08);
/// Part of a crown's height, from below, where it may have a tip, at which it rests on its trunk.
const RESTS: f32 = 0.25;
/// Stretch of an outline over which a tip turns, as a share of its length, and least turn there, radians.
const TIP: (f32, f32) = (0.06, 1.1);
/// Least part of a trunk below its crown, as a share of the crown's height.
const STANDS: f32 = 0.12;
/// Most lines on a trunk, those of the crown's outline among them.
const MOST: usize = 10;
/// Most run of a trunk over its rise.
const PLUMB: f32 = 0.3;

/// A trunk and the crown around its upper end.
pub(crate) struct Forked<'a> {
    /// A closed ring.
    outline: Vec<Vec2>,
    /// From its foot up.
    trunk: &'a [Vec2],
    low: Vec2,
    high: Vec2,
}

impl<'a> Forked<'a> {
    /// The crown that a ring is on a trunk of these points, from its foot up.
    pub(crate) fn new(ring: &[Vec2], trunk: &'a [Vec2]) -> Self {
        let outline: Vec<Vec2> = ring.iter().chain(ring.first()).copied().collect();
        let (low, high) = polyline::bounds(ring.iter().copied());
        Self { outline, trunk, low, high }
    }

    /// Whether the outline has a sharp tip but where it rests on its trunk.
    pub(crate) fn has_tip(&self) -> bool {
        let rests = |tip: &Vec2| self.high.y - tip.y < RESTS * (self.high.y - self.low.y);
        !page::tips(&self.outline[1..], TIP).iter().all(rests)
    }

    /// Whether these few lines fork the trunk, one twig at least, and two where it ends near the top: many are a web of branches.
    pub(crate) fn has_twigs<'b>(&self, lines: impl Iterator<Item = &'b Line> + Clone) -> bool {
        if lines.clone().count() > MOST {
            return false;
        }
        let (Some(foot), Some(top)) = (self.trunk.first(), self.trunk.last()) else { return false };
        let below = (top.y - self.low.y) / (self.high.y - self.low.y).max(f32::MIN_POSITIVE);
        let is_plumb = (foot.x - top.x).abs() < PLUMB * (foot.y - top.y);
        match lines.map(|line| self.twigs(line)).sum::<usize>() {
            0 => false,
            1 => is_plumb && below > SHORT.0,
            _ => below > SHORT.1,
        }
    }

    /// How many twigs a line draws.
    fn twigs(&self, line: &Line) -> usize {
        let foot = self.trunk.first().map_or(self.high.y, |foot| foot.y);
        let height = foot.max(self.high.y) - self.low.y;
        let gap = |way: &[Vec2], p: Vec2| polyline::nearest(way, p).map_or(f32::INFINITY, |(gap, _)| gap);
        let is_at_trunk = |p: Vec2| gap(self.trunk, p) < AT * height;
        let is_inside = |p: Vec2| p.cmpgt(self.low).all() && p.cmplt(self.high).all();
        let is_free = |p: Vec2| is_inside(p) && !is_at_trunk(p) && gap(&self.outline, p) > FREE * height;
        let (a, b) = line.ends();
        if is_at_trunk(a) || is_at_trunk(b) {
            return usize::from(line.openness > 0.6 && (is_free(a) || is_free(b)));
        }
        2 * usize::from(is_free(a) && is_free(b) && line.points.iter().any(|p| is_at_trunk(*p)))
    }
}

/// Whether the lines in a blade are a trunk with its twigs, from those of a midrib that stands on its foot.
pub(crate) fn is_tree<'b>(
    ring: &[Vec2],
    midrib: &[Vec2],
    inside: impl Iterator<Item = &'b Line> + Clone,
) -> bool {
    let mut trunk = midrib.to_vec();
    let (Some(first), Some(last)) = (trunk.first(), trunk.last()) else { return false };
    if first.y < last.y {
        trunk.reverse();
    }
    let run = trunk[0] - trunk[trunk.len() - 1];
    let forked = Forked::new(ring, &trunk);
    run.x.abs() < PLUMB * run.y
        && trunk[0].y > forked.high.y + STANDS * (forked.high.y - forked.low.y)
        && !forked.has_tip()
        && forked.has_twigs(inside)
}
