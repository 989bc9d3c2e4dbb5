//! Loops between drawn loops, so that a lobe is round along its length, too.
//!
//! All loops of a lobe are given equally many samples and turned to begin at the sample that belongs to the first of the loop before
//! ([`start_pair`]). Through the samples that belong together runs a cubic Hermite curve along the lobe; its tangents are parabolas
//! through three neighbours by their distances, at both ends straight. [`COUNT`] loops are taken from it between any two.
//!
//! Source: departure from 001 §5.2.1, whose strips are flat from stroke to stroke, so that five rings make a polygon of five
//! corners. With two loops everything is straight as there.

use super::pairing::start_pair;
use super::strip::densified;
use super::stroke::Line;
use glam::Vec3;

/// Loops between two drawn ones.
pub(super) const COUNT: usize = 4;
/// Samples by which loops are compared.
const SAMPLES: usize = 96;

/// The loops with those between them, in order, and the places of the drawn ones among them.
pub(super) fn with_loops_between(drawn: &[&Line]) -> (Vec<Line>, Vec<usize>) {
    if drawn.len() < 3 {
        return (drawn.iter().map(|line| (*line).clone()).collect(), (0..drawn.len()).collect());
    }
    let rows = alike(drawn);
    let gaps: Vec<f32> = rows.windows(2).map(|pair| distance(&pair[0], &pair[1])).collect();
    let mut loops = vec![drawn[0].clone()];
    let mut places = vec![0];
    for k in 0..drawn.len() - 1 {
        let count = (drawn[k].points.len() + drawn[k + 1].points.len()) / 2;
        // Loops in one place have nothing between them.
        let between = if gaps[k] > 0.0 { COUNT } else { 0 };
        for step in 1..=between {
            let t = step as f32 / (between + 1) as f32;
            let points = (0..SAMPLES).map(|i| on_curve(&rows, &gaps, (k, i), t)).collect();
            loops.push(Line { closed: true, points }.resampled(count));
        }
        places.push(loops.len());
        loops.push(drawn[k + 1].clone());
    }
    (loops, places)
}

/// The loops with equally many samples, those that belong together at the same place.
fn alike(drawn: &[&Line]) -> Vec<Vec<Vec3>> {
    let mut rows: Vec<Vec<Vec3>> = Vec::new();
    for line in drawn {
        let mut points: Vec<Vec3> =
            densified(&line.points, true, SAMPLES).iter().map(|sample| sample.at).take(SAMPLES).collect();
        if let Some(before) = rows.last() {
            let start = start_pair(before, &points);
            if start.reversed {
                points.reverse();
            }
            points.rotate_left(start.shift);
        }
        rows.push(points);
    }
    rows
}

/// Mean distance of samples that belong together.
fn distance(a: &[Vec3], b: &[Vec3]) -> f32 {
    a.iter().zip(b).map(|(p, q)| p.distance(*q)).sum::<f32>() / a.len().max(1) as f32
}

/// A place on the curve of sample `i` after loop `k`.
fn on_curve(rows: &[Vec<Vec3>], gaps: &[f32], (k, i): (usize, usize), t: f32) -> Vec3 {
    let (from, to) = (rows[k][i], rows[k + 1][i]);
    let slope = |k: usize| (rows[k + 1][i] - rows[k][i]) / gaps[k].max(f32::MIN_POSITIVE);
    // Of the parabola through a sample and its two neighbours; at an end that of the curve's last piece alone.
    let tangent = |at: usize| match at {
        0 => None,
        at if at == gaps.len() => None,
        at => {
            let (before, after) = (gaps[at - 1], gaps[at]);
            Some((slope(at - 1) * after + slope(at) * before) / (before + after))
        }
    };
    let straight = slope(k);
    let (leaving, arriving) = match (tangent(k), tangent(k + 1)) {
        (Some(one), Some(other)) => (one, other),
        (None, Some(other)) => ((straight * 3.0 - other) * 0.5, other),
        (Some(one), None) => (one, (straight * 3.0 - one) * 0.5),
        (None, None) => (straight, straight),
    };
    let (square, cube) = (t * t, t * t * t);
    from * (2.0 * cube - 3.0 * square + 1.0)
        + to * (3.0 * square - 2.0 * cube)
        + (leaving * (cube - 2.0 * square + t) + arriving * (cube - square)) * gaps[k]
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::TAU;

    fn ring(count: usize, radius: f32, height: f32, phase: f32) -> Line {
        let at = |k: usize| {
            let (sin, cos) = (phase + k as f32 / count as f32 * TAU).sin_cos();
            Vec3::new(radius * cos, height, radius * sin)
        };
        Line { closed: true, points: (0..count).map(at).collect() }
    }

    #[test]
    fn rings_of_a_ball_have_a_ball_between_them() {
        let heights = [-0.8_f32, -0.4, 0.0, 0.4, 0.8];
        let rings: Vec<Line> = heights.iter().map(|y| ring(60, (1.0 - y * y).sqrt(), *y, 5.0 * y)).collect();
        let (loops, places) = with_loops_between(&rings.iter().collect::<Vec<_>>());
        assert_eq!(loops.len(), 5 + 4 * COUNT);
        assert!(places.iter().zip(&rings).all(|(k, ring)| loops[*k] == *ring));
        for p in loops.iter().flat_map(|line| &line.points) {
            assert!((p.length() - 1.0).abs() < 0.03, "{p} {}", p.length());
        }
    }

    #[test]
    fn two_loops_or_loops_in_one_place_have_nothing_between() {
        let (a, b) = (ring(30, 1.0, 0.0, 0.0), ring(30, 1.0, 1.0, 0.0));
        assert_eq!(with_loops_between(&[&a, &b]).0.len(), 2);
        let (loops, _) = with_loops_between(&[&a, &a, &b]);
        assert!(loops.iter().flat_map(|line| &line.points).all(|p| p.is_finite()));
    }
}
