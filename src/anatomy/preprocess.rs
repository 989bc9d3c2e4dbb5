//! Raw pen samples to an even, smooth line (002 §3.1, §3.2).
//!
//! Resampling is by arc length (000 §2.2.1 used Manhattan distance, which makes the spacing depend on direction).
//! Smoothing is a one-dimensional Gaussian over neighbours, 002 eq. 1. Ends stay where the hand put them, and so do
//! corners: the window never reaches across a sharp turn, so tips, notches and teeth survive while wobble goes.

use super::Sample;
use crate::geom::polyline;
use crate::sketch::StrokePoint;
use glam::Vec2;

crate::parameters! {
    /// How strokes are evened out before anything looks at them.
    pub struct PreprocessParams {
        /// Distance between samples.
        spacing: f32 = 0.004, 0.0005..=0.05, "of the drawing's diagonal";
        /// Fewest samples on a stroke, so that small flowers in a large drawing keep their shape.
        min_samples: u32 = 40, 8..=400, "";
        /// Most samples on a stroke.
        max_samples: u32 = 400, 16..=4000, "";
        /// Smoothing window: neighbours taken on each side; 0 switches smoothing off.
        window: u32 = 2, 0..=20, "samples";
        /// Smoothing weight: standard deviation of the Gaussian.
        weight: f32 = 1.2, 0.1..=20.0, "samples";
        /// Turns sharper than this are corners and are not smoothed away.
        corner: f32 = 50.0, 10.0..=180.0, "degrees";
    }
}

/// How far from a sample its turn is measured, in samples.
const TURN_REACH: usize = 2;

/// Length of a stroke as it was drawn, pixels.
pub fn length(points: &[StrokePoint]) -> f32 {
    polyline::arc_lengths(points.iter().map(|p| p.position)).last().copied().unwrap_or(0.0)
}

/// How many samples a stroke of some length has in a drawing with the given diagonal, both in pixels: at least two unless it
/// has no length.
pub fn count(length: f32, diagonal: f32, params: &PreprocessParams) -> usize {
    if length <= 0.0 {
        return 1;
    }
    let (least, most) = (params.min_samples as usize, params.max_samples.max(params.min_samples) as usize);
    ((length / (params.spacing * diagonal)).ceil() as usize).saturating_add(1).clamp(least, most)
}

/// Resamples a stroke to so many samples, see [`count`], and smooths them. One sample comes out where all points coincide.
pub fn preprocess(points: &[StrokePoint], count: usize, params: &PreprocessParams) -> Vec<Sample> {
    smooth(&resample(points, count), params)
}

/// Samples at equal arc length, first and last point included; pressure and tilt are interpolated.
pub fn resample(points: &[StrokePoint], count: usize) -> Vec<Sample> {
    let arcs = polyline::arc_lengths(points.iter().map(|p| p.position));
    let total = arcs.last().copied().unwrap_or(0.0);
    if total <= 0.0 || count < 2 {
        return points.first().map(sample_of).into_iter().collect();
    }
    let step = total / (count - 1) as f32;
    let mut segment = 0;
    (0..count)
        .map(|k| {
            let arc = if k + 1 == count { total } else { k as f32 * step };
            while segment + 2 < arcs.len() && arcs[segment + 1] < arc {
                segment += 1;
            }
            let span = arcs[segment + 1] - arcs[segment];
            let share = if span > 0.0 { ((arc - arcs[segment]) / span).clamp(0.0, 1.0) } else { 0.0 };
            Sample::lerp(&sample_of(&points[segment]), &sample_of(&points[segment + 1]), share)
        })
        .collect()
}

fn sample_of(point: &StrokePoint) -> Sample {
    Sample { position: point.position, pressure: point.pressure, tilt_deg: point.tilt_deg }
}

/// Gaussian smoothing (002 eq. 1) between ends and corners.
pub fn smooth(samples: &[Sample], params: &PreprocessParams) -> Vec<Sample> {
    let window = params.window as usize;
    if window == 0 || samples.len() < 3 {
        return samples.to_vec();
    }
    let weights: Vec<f32> =
        (0..=window).map(|j| (-((j * j) as f32) / (2.0 * params.weight * params.weight)).exp()).collect();
    let per_total: Vec<f32> =
        (0..=window).map(|reach| 1.0 / (weights[0] + 2.0 * weights[1..=reach].iter().sum::<f32>())).collect();
    let fixed = fixed_samples(samples, params.corner.to_radians());
    let mut out = samples.to_vec();
    for piece in fixed.windows(2) {
        for i in piece[0] + 1..piece[1] {
            let reach = window.min(i - piece[0]).min(piece[1] - i);
            let (before, after) = (samples[i - reach..i].iter().rev(), &samples[i + 1..=i + reach]);
            let mut sum = samples[i].position * weights[0];
            for ((b, a), weight) in before.zip(after).zip(&weights[1..]) {
                sum += (b.position + a.position) * *weight;
            }
            out[i].position = sum * per_total[reach];
        }
    }
    out
}

/// Ends and corners: indices that smoothing must not move, ascending.
fn fixed_samples(samples: &[Sample], corner_rad: f32) -> Vec<usize> {
    let last = samples.len() - 1;
    let gentle = (0.99 * corner_rad).cos();
    let turn = |i: usize| {
        let before = samples[i].position - samples[i.saturating_sub(TURN_REACH)].position;
        let after = samples[(i + TURN_REACH).min(last)].position - samples[i].position;
        // The arc tangent is dear and most samples lie on gentle curves.
        let is_gentle =
            before.dot(after) > gentle * (before.length_squared() * after.length_squared()).sqrt();
        if is_gentle { 0.0 } else { turning(before, after) }
    };
    let mut fixed = vec![0];
    let turns: Vec<f32> = (0..=last).map(turn).collect();
    for i in 1..last {
        let sharpest_around = turns[i.saturating_sub(1)] <= turns[i] && turns[i + 1] < turns[i];
        if turns[i] > corner_rad && sharpest_around {
            fixed.push(i);
        }
    }
    fixed.push(last);
    fixed
}

/// Angle between two directions, radians 0 to π; 0 where either vanishes.
pub fn turning(before: Vec2, after: Vec2) -> f32 {
    before.perp_dot(after).atan2(before.dot(after)).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stroke(points: impl Iterator<Item = (f32, f32)>) -> Vec<StrokePoint> {
        points.map(|(x, y)| StrokePoint::at(Vec2::new(x, y))).collect()
    }

    fn evened(points: &[StrokePoint], diagonal: f32, params: &PreprocessParams) -> Vec<Sample> {
        preprocess(points, count(length(points), diagonal, params), params)
    }

    #[test]
    fn spacing_is_even_in_every_direction() {
        let params = PreprocessParams::default();
        let points = stroke([(0.0, 0.0), (30.0, 0.0), (60.0, 40.0)].into_iter());
        let samples = resample(&points, count(length(&points), 1000.0, &params));
        let steps: Vec<f32> = samples.windows(2).map(|w| w[0].position.distance(w[1].position)).collect();
        let mean = steps.iter().sum::<f32>() / steps.len() as f32;
        assert!((mean - 80.0 / (samples.len() - 1) as f32).abs() < 0.02);
        assert_eq!(samples.last().unwrap().position, Vec2::new(60.0, 40.0));
    }

    #[test]
    fn pressure_follows_along() {
        let mut points = stroke([(0.0, 0.0), (100.0, 0.0)].into_iter());
        (points[0].pressure, points[1].pressure) = (0.0, 1.0);
        let samples = resample(&points, 40);
        assert!(samples.iter().all(|s| (s.pressure - s.position.x / 100.0).abs() < 1e-5));
    }

    #[test]
    fn smoothing_takes_wobble_and_leaves_ends() {
        let wobbly = stroke((0..101).map(|k| (k as f32 * 4.0, if k % 2 == 0 { 0.5 } else { -0.5 })));
        let params = PreprocessParams { spacing: 0.01, window: 4, weight: 2.0, ..Default::default() };
        let out = evened(&wobbly, 400.0, &params);
        assert!(out[10..90].iter().all(|s| s.position.y.abs() < 0.1));
        assert_eq!(out[0].position, wobbly[0].position);
        assert_eq!(out.last().unwrap().position, wobbly.last().unwrap().position);
    }

    #[test]
    fn a_corner_keeps_its_point() {
        let tent = stroke([(0.0, 0.0), (50.0, 80.0), (100.0, 0.0)].into_iter());
        let params = PreprocessParams { min_samples: 41, spacing: 0.05, ..Default::default() };
        let out = evened(&tent, 140.0, &params);
        let top = out.iter().map(|s| s.position.y).fold(0.0, f32::max);
        assert!(top > 79.9, "{top}");
    }

    #[test]
    fn a_dot_stays_one_sample() {
        let dot = stroke([(5.0, 5.0), (5.0, 5.0)].into_iter());
        assert_eq!(evened(&dot, 100.0, &PreprocessParams::default()).len(), 1);
    }
}
