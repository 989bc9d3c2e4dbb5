//! Firs of which one side is hidden by what stands before them, or was left out.
//!
//! The line of such a fir begins at its foot, goes out and up in teeth to the tip, and ends there or a little way down the other side.
//! That side is mirrored about the upright through the tip.
//!
//! Limits: firs that lean; hidden ones of which the tip cannot be seen.

use crate::anatomy::conventions::page::{Line, notches};
use crate::geom::polyline;
use glam::Vec2;

/// Least height of the drawn side, as a share of the line's, and most of the other.
const SIDES: (f32, f32) = (0.85, 0.5);
/// Fewest notches of the drawn side.
const TEETH: usize = 1;
/// How far beyond the tip's upright the foot of the drawn side may go, as a share of its width, and how high that is, of its height.
const FOOT: (f32, f32) = (1.15, 0.1);
/// Largest opening of the line, as its chord over its length: a zigzag goes farther.
const OPEN: (f32, f32) = (0.12, 0.85);

/// The outline of the whole fir of which a line is one side.
pub(crate) fn completed(line: &Line) -> Option<Line> {
    let chord = line.ends().0.distance(line.ends().1) / line.length;
    if !(OPEN.0..OPEN.1).contains(&chord) {
        return None;
    }
    let size = line.size();
    let tip = (0..line.points.len()).min_by(|a, b| line.points[*a].y.total_cmp(&line.points[*b].y))?;
    let (before, after) = (&line.points[..=tip], &line.points[tip..]);
    let depth = |side: &[Vec2]| side.iter().map(|p| p.y - line.bounds.0.y).fold(0.0, f32::max) / size.y;
    let (drawn, other) = if depth(before) > depth(after) {
        (before.iter().rev().copied().collect::<Vec<_>>(), after)
    } else {
        (after.to_vec(), before)
    };
    if depth(&drawn) < SIDES.0 || depth(other) > SIDES.1 {
        return None;
    }
    let axis = drawn[0].x;
    let aside: f32 = drawn.iter().map(|p| p.x - axis).sum();
    let away = |p: &Vec2| (p.x - axis) * aside.signum();
    let reach = drawn.iter().map(away).fold(0.0, f32::max);
    let is_foot = |p: &&Vec2| p.y > line.bounds.1.y - FOOT.1 * size.y;
    let beyond =
        |is_low: bool| drawn.iter().filter(|p| is_foot(p) == is_low).map(|p| -away(p)).fold(0.0, f32::max);
    if reach <= 0.0 || beyond(true) > FOOT.0 * reach || beyond(false) > 0.02 * reach {
        return None;
    }
    let side: Vec<Vec2> = drawn.into_iter().take_while(|p| away(p) >= -0.02 * reach).collect();
    let image = side.iter().rev().map(|p| Vec2::new(2.0 * axis - p.x, p.y));
    let whole: Vec<Vec2> = side.iter().copied().chain(image).collect();
    let is_toothed = notches(&crate::anatomy::conventions::page::even(&whole, 160)).len() >= 2 * TEETH;
    (is_toothed && polyline::length(&whole) > 0.0).then(|| line.part(whole)).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::{line, page::Page};

    fn whole(points: &[(f32, f32)]) -> Option<Line> {
        completed(&Page::of_lines(&[line(points)]).lines[0])
    }

    #[test]
    fn one_side_with_teeth_is_mirrored_about_the_tip() {
        let side = [
            (0.0, 0.0),
            (60.0, 0.0),
            (30.0, -50.0),
            (45.0, -50.0),
            (15.0, -100.0),
            (30.0, -100.0),
            (0.0, -150.0),
        ];
        let fir = whole(&side).unwrap();
        assert!((fir.bounds.0.x + 60.0).abs() < 2.0 && (fir.bounds.1.x - 60.0).abs() < 2.0);
        let hidden: Vec<(f32, f32)> = side.iter().copied().chain([(-14.0, -125.0)]).collect();
        let fir = whole(&hidden).unwrap();
        assert!((fir.bounds.0.x + 60.0).abs() < 2.0);
    }

    #[test]
    fn whole_firs_and_smooth_sides_are_not() {
        let side = [(60.0, 0.0), (30.0, -50.0), (45.0, -50.0), (0.0, -150.0)];
        let other = side.iter().rev().skip(1).map(|(x, y)| (-x, *y));
        assert!(whole(&side.iter().copied().chain(other).collect::<Vec<_>>()).is_none());
        assert!(whole(&[(0.0, 0.0), (60.0, 0.0), (40.0, -80.0), (0.0, -150.0)]).is_none());
    }
}
