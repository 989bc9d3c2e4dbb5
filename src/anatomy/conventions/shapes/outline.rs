//! How wide a closed outline is, and where it stands.
//!
//! Outlines are polygons without their first point repeated. Cost: linear.

use crate::geom::polyline;
use glam::Vec2;

/// Slopes of the ground that are tried besides the level, and how much of the width of a foot there the outline runs at least.
const SLOPES: [f32; 2] = [0.1, -0.1];
const RUNS: f32 = 0.8;

/// The least and the greatest place across an outline where its height is so much, both measured by `height` and `across`; nothing where
/// it does not go so far.
pub(crate) fn ends_at(
    outline: &[Vec2],
    level: f32,
    height: impl Fn(Vec2) -> f32,
    across: impl Fn(Vec2) -> f32,
) -> Option<(f32, f32)> {
    let next = outline.iter().cycle().skip(1);
    let edges = outline.iter().zip(next).map(|(a, b)| ((height(*a) - level, *a), (height(*b) - level, *b)));
    let crossing = edges.filter(|(a, b)| (a.0 < 0.0) != (b.0 < 0.0));
    let places = crossing.map(|(a, b)| across(a.1.lerp(b.1, a.0 / (a.0 - b.0))));
    let ends = places.fold((f32::INFINITY, f32::NEG_INFINITY), |(l, r), x| (l.min(x), r.max(x)));
    (ends.0 < ends.1).then_some(ends)
}

/// How wide an outline is at a height, pixels; 0 above and below it.
pub(crate) fn width_at(outline: &[Vec2], y: f32) -> f32 {
    ends_at(outline, y, |p| p.y, |p| p.x).map_or(0.0, |(left, right)| right - left)
}

/// Left and right end of the lowest part of an outline of even points, so high as this share of the whole, or of a stretch of it that
/// runs along ground with a slope, if that is wider: nobody draws quite level.
pub(crate) fn foot(outline: &[Vec2], share: f32) -> (Vec2, Vec2) {
    let step = polyline::length(outline) / outline.len().max(1) as f32;
    let on = |slope: f32| {
        let height = |p: &Vec2| slope * p.x - p.y;
        let ends = outline
            .iter()
            .map(height)
            .fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), h| (low.min(h), high.max(h)));
        let lowest: Vec<Vec2> =
            outline.iter().copied().filter(|p| height(p) <= ends.0 + share * (ends.1 - ends.0)).collect();
        let by_place = |a: &&Vec2, b: &&Vec2| a.x.total_cmp(&b.x);
        let (left, right) = (lowest.iter().min_by(by_place), lowest.iter().max_by(by_place));
        let foot = left.copied().unwrap_or_default();
        (foot, right.copied().unwrap_or_default(), lowest.len() as f32 * step)
    };
    let width = |foot: &(Vec2, Vec2, f32)| foot.1.x - foot.0.x;
    let level = on(0.0);
    let sloped = SLOPES.into_iter().map(on).filter(|foot| foot.2 > RUNS * width(foot));
    let widest = sloped.fold(level, |best, it| if width(&it) > width(&best) { it } else { best });
    (widest.0, widest.1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::conventions::line;
    use crate::anatomy::conventions::page::even;

    /// A square on one of its corners.
    const DIAMOND: [Vec2; 4] =
        [Vec2::new(0.0, 0.0), Vec2::new(10.0, -10.0), Vec2::new(0.0, -20.0), Vec2::new(-10.0, -10.0)];

    #[test]
    fn the_width_of_a_diamond_grows_to_its_middle() {
        for (y, width) in [(-5.0, 10.0), (-10.0, 20.0), (-18.0, 4.0), (1.0, 0.0), (-30.0, 0.0)] {
            assert!((width_at(&DIAMOND, y) - width).abs() < 1e-4, "{y}");
        }
    }

    #[test]
    fn ends_are_measured_across_any_direction() {
        let ends = ends_at(&DIAMOND, 5.0, |p| p.x, |p| p.y).unwrap();
        assert!((ends.0 + 15.0).abs() < 1e-4 && (ends.1 + 5.0).abs() < 1e-4, "{ends:?}");
    }

    fn foot_of(outline: &[(f32, f32)]) -> f32 {
        let (left, right) = foot(&even(&line(outline), 200), 0.12);
        right.x - left.x
    }

    #[test]
    fn ground_with_a_slope_is_a_foot_and_two_tips_that_hang_are_none() {
        let level = [(0.0, 0.0), (100.0, 0.0), (100.0, -60.0), (0.0, -60.0), (0.0, 0.0)];
        let sloped = [(0.0, 0.0), (100.0, 10.0), (100.0, -60.0), (0.0, -60.0), (0.0, 0.0)];
        let hanging = [
            (0.0, 0.0),
            (10.0, -40.0),
            (90.0, -40.0),
            (100.0, 10.0),
            (100.0, -60.0),
            (0.0, -60.0),
            (0.0, 0.0),
        ];
        assert!(
            foot_of(&level) > 95.0 && foot_of(&sloped) > 95.0,
            "{} {}",
            foot_of(&level),
            foot_of(&sloped)
        );
        assert!(foot_of(&hanging) < 40.0, "{}", foot_of(&hanging));
    }
}
