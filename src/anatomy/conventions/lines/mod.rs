//! Strokes to lines: how a line is divided into strokes is the hand's, not the plant's.
//!
//! | file | what |
//! | --- | --- |
//! | `chains` | strokes whose ends continue each other |
//! | `bundles` | strokes drawn over one another |
//! | `rounds` | outlines gone round more than once |
//! | `redrawn` | a drawing with some of its strokes put together |
//! | `restated` | the drawing with strokes over one another made one line each |
//! | `overlap` | where one line runs along another |
//!
//! Strokes over one another are taken for one line before anything else is looked at ([`restated()`]): nobody draws two things in
//! the same place. Strokes that only continue each other may be two things that meet, so what they are together is proposed
//! beside what they are by themselves, and readings that take one without the other have less that speaks for them
//! ([`chains::Chains`]). Sources: the idea of consolidation in X. Liu, T.-T. Wong and P.-A. Heng, “Closure-aware sketch simplification”
//! (2015), and of strips in D. Pagurek van Mossel et al., “StrokeStrip” (2021); the rules here are simpler and our own.
//! Limits: plants of a meadow are read by their strokes as drawn.

mod bundles;
pub(super) mod chains;
mod overlap;
mod redrawn;
mod restated;
mod rounds;

pub(super) use redrawn::Redrawn;
pub(super) use restated::restated;

#[cfg(test)]
mod tests {
    use super::{chains, restated};
    use crate::anatomy::conventions::page::{Page, even};
    use crate::anatomy::conventions::{ConventionParams, Habit, Interpretation, interpret, line};
    use crate::geom::polyline;
    use crate::sketch::{Reading, Remark};
    use crate::sketch::{Stroke, StrokePoint, Tool};
    use glam::Vec2;
    use std::sync::Arc;

    fn strokes(lines: &[Vec<Vec2>]) -> Vec<Arc<Stroke>> {
        let stroke = |(id, line): (usize, &Vec<Vec2>)| {
            let points = even(line, 120).into_iter().map(StrokePoint::at).collect();
            Arc::new(Stroke { id: id as u64 + 1, tool: Tool::Auto, points, brush: None })
        };
        lines.iter().enumerate().map(stroke).collect()
    }

    fn members(lines: &[Vec<Vec2>]) -> Option<Vec<Vec<usize>>> {
        let strokes = strokes(lines);
        restated(&Page::new(&strokes), &strokes, |_| true).map(|redrawn| redrawn.members)
    }

    fn read(lines: &[Vec<Vec2>]) -> Interpretation {
        interpret(&strokes(lines), &ConventionParams::default())
    }

    /// A line from (0, 0) to the right that sways about `y`.
    fn swaying(from: f32, to: f32, y: f32, sway: f32) -> Vec<Vec2> {
        let place = |k: usize| {
            let x = from + (to - from) * k as f32 / 60.0;
            Vec2::new(x, y + sway * (0.05 * x).sin())
        };
        (0..=60).map(place).collect()
    }

    fn circle(radius: f32, times: f32) -> Vec<Vec2> {
        let angle = |k: usize| 0.05 * k as f32;
        let place = |a: f32| (radius + 0.02 * radius * (0.7 * a).sin()) * Vec2::from_angle(a);
        (0..=(times * 126.0) as usize).map(angle).map(place).collect()
    }

    #[test]
    fn a_line_drawn_again_is_one_and_two_sides_of_a_stem_are_two() {
        let again = |y: f32, sway: f32| [swaying(0.0, 400.0, 0.0, 2.0), swaying(0.0, 390.0, y, sway)];
        assert_eq!(members(&again(0.0, -2.0)), Some(vec![vec![0, 1]]));
        assert_eq!(members(&again(6.0, 2.0)), None, "at one side all along");
        assert_eq!(members(&again(25.0, -2.0)), None, "far");
    }

    #[test]
    fn pieces_that_overlap_are_one_line_and_crossing_lines_are_not() {
        let pieces = [
            swaying(0.0, 160.0, 0.0, 2.0),
            swaying(120.0, 280.0, 1.0, 2.0),
            swaying(240.0, 400.0, -1.0, 2.0),
        ];
        let strokes = strokes(&pieces);
        let redrawn = restated(&Page::new(&strokes), &strokes, |_| true).unwrap();
        assert_eq!(redrawn.members, [[0, 1, 2]]);
        let whole: Vec<Vec2> = redrawn.strokes[0].points.iter().map(|p| p.position).collect();
        assert!((polyline::length(&whole) - 400.0).abs() < 12.0, "{}", polyline::length(&whole));
        assert!(whole[0].distance(whole[whole.len() - 1]) > 390.0);
        assert_eq!(members(&[line(&[(0.0, 0.0), (200.0, 80.0)]), line(&[(0.0, 80.0), (200.0, 0.0)])]), None);
    }

    #[test]
    fn an_outline_gone_round_twice_is_gone_round_once_and_a_spiral_is_not() {
        let strokes = strokes(&[circle(100.0, 2.0)]);
        let once = restated(&Page::new(&strokes), &strokes, |_| true).unwrap();
        let length = polyline::length(&once.strokes[0].points.iter().map(|p| p.position).collect::<Vec<_>>());
        assert!((length / 628.0 - 1.0).abs() < 0.06, "{length}");
        let spiral = (0..240).map(|k| (30.0 + 0.4 * k as f32) * Vec2::from_angle(0.05 * k as f32)).collect();
        assert_eq!(members(&[spiral]), None);
    }

    /// A crown in two strokes on a trunk of two sides, all but the crown's second half closed by `gap`.
    fn tree(gap: f32) -> Vec<Vec<Vec2>> {
        let bump = |k: usize| {
            let angle = 2.2 + 5.0 * k as f32 / 200.0;
            let reach = 90.0 * (0.92 + 0.08 * (4.0 * angle).sin().abs());
            Vec2::new(reach * angle.cos(), -200.0 + reach * angle.sin())
        };
        let half = |from: usize, to: usize| (from..=to).map(bump).collect::<Vec<_>>();
        let step = (gap / 2.2) as usize;
        let sides = [line(&[(-18.0, -125.0), (-18.0, 0.0)]), line(&[(18.0, -125.0), (18.0, 0.0)])];
        [vec![half(0, 90), half(90 + step, 200)], sides.to_vec()].concat()
    }

    #[test]
    fn a_crown_in_two_strokes_is_that_of_a_tree() {
        for gap in [0.0, 6.0] {
            assert_eq!(read(&tree(gap)).habit, Some(Habit::Tree), "{gap}");
        }
    }

    #[test]
    fn strokes_that_are_one_line_are_said_to_be_and_the_artist_may_part_them() {
        let drawn = strokes(&[swaying(0.0, 400.0, 0.0, 2.0), swaying(0.0, 390.0, 0.0, -2.0)]);
        let read = interpret(&drawn, &ConventionParams::default());
        assert_eq!(read.remarks.len(), 1);
        assert_eq!(read.remarks[0].remark, Remark::ReadAs(Reading::Line));
        assert_eq!((read.strokes.len(), read.readings[0].strokes.as_slice()), (1, &[1, 2][..]));
    }

    #[test]
    fn ends_that_continue_each_other_are_joined_unless_a_third_is_there() {
        let chains = |lines: &[Vec<Vec2>]| {
            let strokes = strokes(lines);
            let chains = chains::Chains::of(&mut chains::Joined::default(), &Page::new(&strokes), &strokes);
            chains.map(|chains| chains.redrawn.members)
        };
        let (left, right) = (line(&[(0.0, 0.0), (100.0, 0.0)]), line(&[(206.0, 3.0), (106.0, 0.0)]));
        let corner = line(&[(101.0, 2.0), (100.0, 100.0)]);
        assert_eq!(chains(&[left.clone(), right.clone()]), Some(vec![vec![0, 1]]));
        assert_eq!(chains(&[left.clone(), corner.clone()]), Some(vec![vec![0, 1]]));
        let beside = line(&[(102.0, -2.0), (40.0, -100.0)]);
        assert_eq!(chains(&[left.clone(), corner, beside]), None, "three meet");
        assert_eq!(chains(&[left, line(&[(130.0, 0.0), (200.0, 60.0)])]), None, "far");
    }
}
