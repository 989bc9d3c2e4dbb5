//! Crowns of which one side was left out.
//!
//! A quick hand draws a crown as an arch that begins at one side of the trunk and ends high up on the other, or the other way round. Such
//! an arch is most of what is drawn above the trunk, bends one way, and one of its ends only comes down. What is missing is taken
//! from the other side: the arch and its mirror image about the trunk's axis enclose the crown together.
//!
//! Limits: crowns that lean to one side, and those with strokes inside.

use crate::anatomy::conventions::page::is_bow;
use crate::geom::{polyline, simple_loop::hull_area};
use glam::Vec2;

/// Least share of the hull of all that the arch's has.
const MAIN: f32 = 0.8;
/// How far below the arch's top its ends are, as shares of its height: the lower at least, the higher at most.
const ENDS: (f32, f32) = (0.7, 0.85);
/// How far from its left and right an arch ends that turns back, as a share of its width.
const INNER: f32 = 0.06;
/// Width about the axis that is on neither side, as a share of the arch's.
const SIDE: f32 = 0.1;
/// Most arches.
const MOST: usize = 4;
/// Least reach of the arch to its other side of the axis, as a share of that to the first.
const BOTH: f32 = 0.25;

/// What is drawn above a trunk with this axis, and what of a crown's outline was left out; nothing where no side was.
pub(crate) fn completed(above: &[Vec<Vec2>], axis: f32) -> Option<Vec<Vec<Vec2>>> {
    let main = outline(above)?;
    let (high, low) = polyline::bounds(main.iter().flat_map(|run| run.iter().copied()));
    let size = low - high;
    // How far it comes down on either side.
    let depth = |is_there: &dyn Fn(f32) -> bool| {
        let side = main.iter().flat_map(|run| run.iter()).filter(|p| is_there(p.x));
        side.map(|p| (p.y - high.y) / size.y.max(f32::MIN_POSITIVE)).fold(0.0, f32::max)
    };
    let (left, right) = (axis - high.x, low.x - axis);
    let ends = (depth(&|x| x < axis - SIDE * size.x), depth(&|x| x > axis + SIDE * size.x));
    let is_half = ends.0.max(ends.1) > ENDS.0 && ends.0.min(ends.1) < ENDS.1;
    if !is_half || left.min(right) < BOTH * left.max(right) {
        return None;
    }
    // An arch that turns back on both sides has its middle in itself.
    let inner = INNER * size.x;
    let is_inner = |p: Vec2| p.x > high.x + inner && p.x < low.x - inner;
    let turns_back = |run: &[Vec2]| is_inner(run[0]) && is_inner(run[run.len() - 1]);
    let axis = if main.len() == 1 && turns_back(main[0]) { high.x.midpoint(low.x) } else { axis };
    let image = |run: &&[Vec2]| run.iter().map(|p| Vec2::new(2.0 * axis - p.x, p.y)).collect();
    Some(above.iter().cloned().chain(main.iter().map(image)).collect())
}

/// The arches that draw a crown's outline: one that is most of what is drawn there, or a few.
fn outline(above: &[Vec<Vec2>]) -> Option<Vec<&[Vec2]>> {
    let largest = above.iter().max_by(|a, b| hull_area(a).total_cmp(&hull_area(b)))?;
    let all: Vec<Vec2> = above.iter().flatten().copied().collect();
    if hull_area(largest) > MAIN * hull_area(&all) {
        return is_bow(largest).then(|| vec![largest.as_slice()]);
    }
    let bows: Vec<&[Vec2]> = above.iter().map(Vec::as_slice).filter(|run| is_bow(run)).collect();
    ((2..=MOST).contains(&bows.len()) && bows.len() == above.len()).then_some(bows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::TAU;

    /// An arch around a place above the origin, from one share of a turn to another, 0 being straight down.
    fn arch(from: f32, to: f32) -> Vec<Vec2> {
        let angle = |k: usize| TAU * (from + (to - from) * k as f32 / 60.0);
        (0..=60).map(|k| Vec2::new(-50.0 * angle(k).sin(), -100.0 + 50.0 * angle(k).cos())).collect()
    }

    #[test]
    fn an_arch_that_comes_down_on_one_side_only_is_completed() {
        let both = completed(&[arch(0.05, 0.7)], 0.0).unwrap();
        assert_eq!(both.len(), 2);
        let right = both[1].iter().map(|p| p.x).fold(0.0, f32::max);
        assert!((right - 50.0).abs() < 2.0, "{right}");
        assert_eq!(completed(&[arch(0.05, 0.4), arch(0.38, 0.7)], 0.0).unwrap().len(), 4);
    }

    #[test]
    fn a_whole_crown_and_one_on_one_side_of_its_trunk_are_not() {
        assert!(completed(&[arch(0.02, 0.98)], 0.0).is_none());
        assert!(completed(&[arch(0.05, 0.7)], 60.0).is_none());
    }
}
