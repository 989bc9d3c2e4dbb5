//! A stem drawn in one stroke with what it carries.
//!
//! From one end of the stroke the line runs up nearly straight; what follows stands above and comes back to it. Limits: stems that lean by more than
//! half a right angle, or bend much, are not cut off.

use crate::anatomy::conventions::page::Line;
use glam::Vec2;

/// Least chord of a stem over its length.
const STRAIGHT: f32 = 0.95;
/// Least length of a stem, as a share of the diagonal of what it carries, and most of its stroke's points.
const LONG: (f32, f32) = (0.35, 0.7);
/// How far below what it carries a stem begins, as a share of that one's height, and how far in that it ends at most.
const BELOW: f32 = 0.3;
const INTO: f32 = 0.6;
/// Largest opening of what it carries: an outline comes back to the stem, if it is no scribble.
const OPEN: f32 = 0.35;
/// Least share of its bounds that the hull of a scribble fills.
const FULL: f32 = 0.4;

/// The stem, from its foot, and the rest of its line; nothing where neither end of the line is a stem.
pub(crate) fn cut(line: &Line) -> Option<(Vec<Vec2>, Line)> {
    let reversed = || line.points.iter().rev().copied().collect();
    of_beginning(line, line.points.clone()).or_else(|| of_beginning(line, reversed()))
}

fn of_beginning(line: &Line, points: Vec<Vec2>) -> Option<(Vec<Vec2>, Line)> {
    let foot = points[0];
    let mut length = 0.0;
    let mut top = 0;
    for k in 1..(points.len() as f32 * LONG.1) as usize {
        length += points[k].distance(points[k - 1]);
        let run = foot - points[k];
        if run.length() > STRAIGHT * length && run.y > run.x.abs() {
            top = k;
        }
    }
    let rest = line.part(points[top..].to_vec())?;
    let size = rest.size();
    let is_long = foot.distance(points[top]) > LONG.0 * size.length();
    let is_below =
        foot.y > rest.bounds.1.y + BELOW * size.y && points[top].y > rest.bounds.1.y - INTO * size.y;
    let is_whole = rest.openness < OPEN || rest.is_scribble() && rest.hull_area > FULL * size.x * size.y;
    (is_whole && is_long && is_below).then(|| (points[..=top].to_vec(), rest))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::page::Page;
    use std::f32::consts::TAU;

    fn ring() -> impl Iterator<Item = Vec2> {
        (0..=60).map(|k| TAU * k as f32 / 60.0).map(|angle| 40.0 * Vec2::new(-angle.sin(), angle.cos()))
    }

    fn cut_of(points: Vec<Vec2>) -> Option<(Vec<Vec2>, Line)> {
        cut(&Page::of_lines(&[points]).lines[0])
    }

    #[test]
    fn the_line_up_to_a_ring_is_its_stem_whichever_end_is_drawn_first() {
        let up: Vec<Vec2> = std::iter::once(Vec2::new(0.0, 140.0)).chain(ring()).collect();
        for drawn in [up.clone(), up.into_iter().rev().collect()] {
            let (stem, rest) = cut_of(drawn).unwrap();
            assert!(stem[0].distance(Vec2::new(0.0, 140.0)) < 1.0);
            assert!(stem[stem.len() - 1].distance(Vec2::new(0.0, 40.0)) < 15.0);
            assert!(rest.bounds.1.y < 50.0);
        }
    }

    #[test]
    fn rings_arcs_and_lines_have_none() {
        assert!(cut_of(ring().collect()).is_none());
        assert!(cut_of(ring().take(31).collect()).is_none());
        assert!(cut_of(vec![Vec2::new(0.0, 100.0), Vec2::ZERO]).is_none());
    }
}
