//! Loops in a stroke: where the hand goes out around something, comes back to where it was, and goes on.
//!
//! Wherever a line comes back to one of its own places ([`GAP`]) and what lies between encloses enough and is not jagged, that is a loop, and is
//! taken out of the way. Cost: the square of a line's points.

use crate::anatomy::conventions::page::Line;
use crate::geom::{convex_hull::convex_hull, polyline, simple_loop};
use glam::Vec2;

/// Distance within which a line is back where it was, as a share of its diagonal.
const GAP: f32 = 0.03;
/// Least area of a loop, as a share of the square of its length, and of its hull.
const FAT: f32 = 0.025;
const SOLID: f32 = 0.6;

/// The loops of a line that have at least such a share of its points, and the way that is left without them.
pub(crate) fn taken_apart(line: &Line, share: f32) -> (Vec<Vec<Vec2>>, Vec<Vec2>) {
    let gap = GAP * line.size().length();
    let least = ((line.points.len() as f32 * share) as usize).max(4);
    let mut loops = Vec::new();
    let mut way: Vec<Vec2> = Vec::new();
    for &p in &line.points {
        way.push(p);
        let candidates = 0..way.len().saturating_sub(least);
        let nearest = candidates.min_by(|a, b| way[*a].distance(p).total_cmp(&way[*b].distance(p)));
        if let Some(i) = nearest.filter(|i| way[*i].distance(p) < gap && is_leaf(&way[*i..])) {
            loops.push(way.split_off(i));
            way.push(p);
        }
    }
    (loops, way)
}

/// Whether a closed stretch encloses enough, and is not jagged.
pub(crate) fn is_leaf(points: &[Vec2]) -> bool {
    let length = polyline::length(points);
    let area = simple_loop::area(points);
    area > FAT * length * length && area > SOLID * simple_loop::area(&convex_hull(points, |p| *p))
}
