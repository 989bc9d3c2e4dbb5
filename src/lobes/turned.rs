//! A lobe from two profiles: circles between two open strokes.
//!
//! At every share of their lengths the circle stands on the line between the two strokes, across the middle line. Where both
//! strokes lie in one plane with a straight axis between them, this is a surface of revolution; where the axis bends, the circles
//! follow it. Ends that meet are a point, all others get a round cap as any loop does.
//!
//! Source: `Profile` in the window's terms; the paper (001 §5.2.1) has no such stroke. Limits: what bulges must be seen in the profiles,
//! the section across is round everywhere.

use super::stroke::Line;
use glam::Vec3;
use std::f32::consts::TAU;

/// Circles between two profiles.
const CIRCLES: usize = 25;
/// Samples of a circle.
const AROUND: usize = 48;
/// Share of the largest radius below which an end is a point.
const POINT: f32 = 0.04;
/// How near the ends of two strokes are, as a share of the largest distance between them, where they are taken as profiles.
const MEETING: f32 = 0.4;

/// The circles between two open strokes, as loops.
pub(super) fn circles(a: &Line, b: &Line) -> Vec<Line> {
    let (a, b) = alike(a, b);
    let centre = |k: usize| a[k].midpoint(b[k]);
    let radius = |k: usize| 0.5 * a[k].distance(b[k]);
    let widest = (0..CIRCLES).map(radius).fold(0.0, f32::max);
    let circle = |k: usize| {
        let along = centre((k + 1).min(CIRCLES - 1)) - centre(k.saturating_sub(1));
        let across = (a[k] - b[k]).normalize_or(Vec3::X);
        let side = along.cross(across).normalize_or(across.any_orthonormal_vector());
        let at = |i: usize| {
            let (sin, cos) = (i as f32 / AROUND as f32 * TAU).sin_cos();
            centre(k) + (across * cos + side * sin) * radius(k)
        };
        Line { closed: true, points: (0..AROUND).map(at).collect() }
    };
    let wide = (0..CIRCLES).filter(|k| radius(*k) > POINT * widest);
    wide.map(circle).collect()
}

/// Whether two open strokes look like the two sides of one body: they meet at both ends, or nearly.
pub(super) fn are_profiles(a: &Line, b: &Line) -> bool {
    let (a, b) = alike(a, b);
    let apart = |k: usize| a[k].distance(b[k]);
    let widest = (0..CIRCLES).map(apart).fold(0.0, f32::max);
    apart(0) < MEETING * widest && apart(CIRCLES - 1) < MEETING * widest
}

/// Both strokes with equally many samples, running the same way.
fn alike(a: &Line, b: &Line) -> (Vec<Vec3>, Vec<Vec3>) {
    let (a, mut b) = (a.resampled(CIRCLES).points, b.resampled(CIRCLES).points);
    let ends = |b: &[Vec3]| a[0].distance(b[0]) + a[CIRCLES - 1].distance(b[CIRCLES - 1]);
    let turned: Vec<Vec3> = b.iter().rev().copied().collect();
    if ends(&turned) < ends(&b) {
        b = turned;
    }
    (a, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn side(sign: f32, reversed: bool) -> Line {
        let at = |k: u32| {
            let t = if reversed { 40 - k } else { k } as f32 / 40.0 * std::f32::consts::PI;
            Vec3::new(sign * t.sin(), 2.0 - t.cos(), 0.0)
        };
        Line { closed: false, points: (0..=40).map(at).collect() }
    }

    #[test]
    fn two_half_circles_are_a_ball() {
        let (a, b) = (side(1.0, false), side(-1.0, true));
        assert!(are_profiles(&a, &b));
        let circles = circles(&a, &b);
        assert_eq!(circles.len(), CIRCLES - 2);
        for p in circles.iter().flat_map(|circle| &circle.points) {
            assert!((p.distance(Vec3::Y * 2.0) - 1.0).abs() < 0.01, "{p}");
        }
    }

    #[test]
    fn parallel_strokes_are_no_profiles() {
        let at =
            |x: f32| Line { closed: false, points: vec![Vec3::new(x, 0.0, 0.0), Vec3::new(x, 1.0, 0.0)] };
        assert!(!are_profiles(&at(0.0), &at(1.0)));
    }
}
