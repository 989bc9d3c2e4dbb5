//! Stroke features for the classifier (002 §4.1).
//!
//! Three numbers say how much a stroke looks like an outline: how far its ends are apart, how round its spread is, and
//! how much area its bounding box encloses for the ink spent. They come from principal component analysis of the drawn
//! line itself: moments are integrated along each segment instead of summed over samples, so that a slow hand, which
//! leaves many samples in one place, changes nothing.
//!
//! Departures from the paper: the eigenvalue ratio is turned over and its root taken (ratio of the spreads), because
//! major/minor grows without bound on straight strokes; the box area is divided by the squared length, because area over
//! length depends on the size of the canvas. All three are then unchanged by moving, turning, scaling and reversing
//! the stroke.
//!
//! Limit: a spread that is the same in all directions (an exact square) has no principal axes, and its box may be taken
//! at any angle.

use glam::{DVec2, Vec2};

/// What the classifier looks at; every value is a pure number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrokeFeatures {
    /// Distance between the ends over arc length: 0 closed, 1 straight.
    pub openness: f32,
    /// Spread across the stroke over spread along it (root of minor/major eigenvalue): 0 straight, 1 round.
    pub roundness: f32,
    /// Area of the principal-axes box over squared arc length: 0 straight, 1/π² for a circle, at most 1/4.
    pub fullness: f32,
}

impl StrokeFeatures {
    /// A stroke without extent in any but one direction.
    const STRAIGHT: Self = Self { openness: 1.0, roundness: 0.0, fullness: 0.0 };

    /// The features in the order in which the classifier was trained.
    pub fn as_array(self) -> [f32; 3] {
        [self.openness, self.roundness, self.fullness]
    }
}

/// Measures the polyline through `points` (canvas pixels, any spacing).
///
/// A stroke without length, or with a coordinate that is not finite, counts as straight.
pub fn stroke_features(points: &[Vec2]) -> StrokeFeatures {
    let (Some(first), Some(last)) = (points.first(), points.last()) else {
        return StrokeFeatures::STRAIGHT;
    };
    let spread = Spread::of(points, first.as_dvec2());
    if !spread.length.is_finite() || spread.length <= 0.0 {
        return StrokeFeatures::STRAIGHT;
    }
    let (major, minor, axis) = spread.principal();
    let box_area = extent(points, axis) * extent(points, axis.perp());
    StrokeFeatures {
        openness: (first.as_dvec2().distance(last.as_dvec2()) / spread.length) as f32,
        roundness: (minor / major).sqrt() as f32,
        fullness: (box_area / (spread.length * spread.length)) as f32,
    }
}

/// Moments of a polyline about an origin, integrated along its length.
struct Spread {
    length: f64,
    first: DVec2,
    xx: f64,
    xy: f64,
    yy: f64,
}

impl Spread {
    fn of(points: &[Vec2], origin: DVec2) -> Self {
        let mut sum = Self { length: 0.0, first: DVec2::ZERO, xx: 0.0, xy: 0.0, yy: 0.0 };
        for pair in points.windows(2) {
            let (a, b) = (pair[0].as_dvec2() - origin, pair[1].as_dvec2() - origin);
            let (mid, along, length) = ((a + b) / 2.0, b - a, a.distance(b));
            sum.length += length;
            sum.first += mid * length;
            sum.xx += length * (mid.x * mid.x + along.x * along.x / 12.0);
            sum.xy += length * (mid.x * mid.y + along.x * along.y / 12.0);
            sum.yy += length * (mid.y * mid.y + along.y * along.y / 12.0);
        }
        sum
    }

    /// Variances along the two principal axes, larger first, and the direction of the larger.
    fn principal(&self) -> (f64, f64, DVec2) {
        let mean = self.first / self.length;
        let xx = self.xx / self.length - mean.x * mean.x;
        let xy = self.xy / self.length - mean.x * mean.y;
        let yy = self.yy / self.length - mean.y * mean.y;
        let (center, radius) = ((xx + yy) / 2.0, ((xx - yy) / 2.0).hypot(xy));
        let angle = (2.0 * xy).atan2(xx - yy) / 2.0;
        // Rounding can push the smaller variance of a straight line just below zero.
        (center + radius, (center - radius).max(0.0), DVec2::from_angle(angle))
    }
}

fn extent(points: &[Vec2], axis: DVec2) -> f64 {
    let along = points.iter().map(|p| p.as_dvec2().dot(axis));
    let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (lo.min(x), hi.max(x)));
    high - low
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::f32::consts::{PI, TAU};

    fn circle(samples: usize) -> Vec<Vec2> {
        (0..=samples).map(|i| Vec2::from_angle(TAU * i as f32 / samples as f32) * 50.0).collect()
    }

    #[test]
    fn a_straight_line_is_open_thin_and_empty() {
        let f = stroke_features(&[Vec2::new(3.0, 4.0), Vec2::new(10.0, 11.0), Vec2::new(40.0, 41.0)]);
        assert!((f.openness - 1.0).abs() < 1e-6 && f.roundness < 1e-4 && f.fullness < 1e-6, "{f:?}");
    }

    #[test]
    fn a_circle_is_closed_round_and_encloses_one_over_pi_squared() {
        let f = stroke_features(&circle(200));
        assert!(f.openness < 1e-5 && (f.roundness - 1.0).abs() < 1e-4, "{f:?}");
        assert!((f.fullness - 1.0 / (PI * PI)).abs() < 1e-4, "{f:?}");
    }

    #[test]
    fn a_right_angle_has_the_fullest_box_and_known_moments() {
        let f = stroke_features(&[Vec2::new(0.0, 100.0), Vec2::ZERO, Vec2::new(100.0, 0.0)]);
        assert!((f.openness - 0.5_f32.sqrt()).abs() < 1e-6, "{f:?}");
        assert!((f.roundness - 0.5).abs() < 1e-6, "variances 1/6 and 1/24 of the leg squared: {f:?}");
        assert!((f.fullness - 0.25).abs() < 1e-6, "{f:?}");
    }

    #[test]
    fn sampling_density_does_not_matter() {
        let even = circle(96);
        let crowded: Vec<Vec2> = even
            .windows(2)
            .enumerate()
            .flat_map(|(i, p)| subdivided(p, if i < 20 { 9 } else { 1 }))
            .collect();
        assert_close(stroke_features(&crowded), stroke_features(&even[..96]), 0.02);
    }

    fn subdivided(pair: &[Vec2], parts: usize) -> Vec<Vec2> {
        (0..parts).map(|k| pair[0].lerp(pair[1], k as f32 / parts as f32)).collect()
    }

    #[test]
    fn dots_and_broken_numbers_count_as_straight() {
        for points in [vec![], vec![Vec2::ONE], vec![Vec2::ONE; 5], vec![Vec2::ZERO, Vec2::NAN, Vec2::ONE]] {
            assert_eq!(stroke_features(&points), StrokeFeatures::STRAIGHT, "{points:?}");
        }
    }

    fn assert_close(a: StrokeFeatures, b: StrokeFeatures, tolerance: f32) {
        for (x, y) in a.as_array().into_iter().zip(b.as_array()) {
            assert!((x - y).abs() <= tolerance, "{a:?} against {b:?}");
        }
    }

    proptest! {
        #[test]
        fn moving_turning_scaling_and_reversing_change_nothing(
            steps in prop::collection::vec((-1.0_f32..1.0, -1.0_f32..1.0), 3..60),
            shift in (-500.0_f32..500.0, -500.0_f32..500.0),
            angle in 0.0_f32..TAU,
            scale in prop::sample::select(vec![0.1_f32, 1.0, 10.0]),
        ) {
            // Stretched, so that the principal axes are well defined.
            let mut at = Vec2::ZERO;
            let points: Vec<Vec2> = steps.iter().map(|&(x, y)| { at += Vec2::new(40.0 + 30.0 * x, 25.0 * y); at }).collect();
            let turn = Vec2::from_angle(angle);
            let moved: Vec<Vec2> =
                points.iter().rev().map(|&p| turn.rotate(p) * scale + Vec2::from(shift)).collect();
            assert_close(stroke_features(&moved), stroke_features(&points), 2e-3);
        }
    }
}
