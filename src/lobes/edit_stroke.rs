//! A stroke changed by a handle on it.
//!
//! Two samples are marked, and the middle between them is dragged. The part between becomes a quadratic Bézier curve through the
//! handle; near both marks it goes over into the stroke as it was, so that it has no corner there.
//!
//! Source: 001 §5.2.2, eq. 5.2. Departure: there the control point is dragged, which lies off the curve; here the handle M lies on the
//! curve, and the control point is 2M − (P1 + P2)/2.

use glam::Vec3;

/// Share of the marked part, from each mark, along which the curve goes over into the stroke.
pub const BLEND: f32 = 0.15;

/// The number of the sample in the middle between two marks, by length; on a loop the part runs forward from the first mark.
pub fn middle(points: &[Vec3], closed: bool, marks: [usize; 2]) -> Option<usize> {
    let (part, shares) = part(points, closed, marks)?;
    let nearest =
        (0..part.len()).min_by(|a, b| (shares[*a] - 0.5).abs().total_cmp(&(shares[*b] - 0.5).abs()))?;
    Some(part[nearest])
}

/// The stroke after its middle between two marks was dragged to a place; `None` where the marks are no two samples with a sample
/// between them.
pub fn bent(points: &[Vec3], closed: bool, marks: [usize; 2], handle: Vec3) -> Option<Vec<Vec3>> {
    let (part, shares) = part(points, closed, marks)?;
    let (first, last) = (points[part[0]], points[*part.last()?]);
    let control = handle * 2.0 - (first + last) * 0.5;
    let mut moved = points.to_vec();
    for (i, t) in part.iter().zip(&shares) {
        let curve = first.lerp(control, *t).lerp(control.lerp(last, *t), *t);
        let near = (t.min(1.0 - t) / BLEND).clamp(0.0, 1.0);
        moved[*i] = points[*i].lerp(curve, near * near * (3.0 - 2.0 * near));
    }
    Some(moved)
}

/// The samples from one mark to the other, and how far along each is, from 0 to 1.
fn part(points: &[Vec3], closed: bool, [from, to]: [usize; 2]) -> Option<(Vec<usize>, Vec<f32>)> {
    let count = points.len();
    if from >= count || to >= count || from == to {
        return None;
    }
    let samples: Vec<usize> = if closed {
        (0..=(to + count - from) % count).map(|k| (from + k) % count).collect()
    } else {
        (from.min(to)..=from.max(to)).collect()
    };
    let mut along = vec![0.0];
    for pair in samples.windows(2) {
        along.push(along[along.len() - 1] + points[pair[0]].distance(points[pair[1]]));
    }
    let whole = along[along.len() - 1];
    let shares = along.iter().map(|at| at / whole).collect();
    (samples.len() > 2 && whole > 0.0).then_some((samples, shares))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;
    use std::f32::consts::FRAC_PI_6;

    fn line() -> Vec<Vec3> {
        (0..=20).map(|k| Vec3::X * k as f32).collect()
    }

    #[test]
    fn the_handle_lies_on_the_curve_and_the_rest_stays() {
        let handle = Vec3::new(10.0, 4.0, 1.0);
        assert_eq!(middle(&line(), false, [4, 16]), Some(10));
        let moved = bent(&line(), false, [16, 4], handle).unwrap();
        assert!(moved[10].distance(handle) < 1e-5);
        assert!((0..=4).chain(16..=20).all(|k| moved[k] == line()[k]));
        assert!(
            moved.windows(3).all(|w| (w[1] - w[0]).angle_between(w[2] - w[1]) < 0.8),
            "no corner: {moved:?}"
        );
    }

    #[test]
    fn a_part_of_a_loop_may_run_over_its_first_sample() {
        let ring: Vec<Vec3> = (0..12).map(|k| Vec2::from_angle(k as f32 * FRAC_PI_6).extend(0.0)).collect();
        assert_eq!(middle(&ring, true, [9, 3]), Some(0));
        let moved = bent(&ring, true, [9, 3], Vec3::X * 3.0).unwrap();
        assert!(moved[0].distance(Vec3::X * 3.0) < 1e-4 && (3..=9).all(|k| moved[k] == ring[k]));
    }

    #[test]
    fn marks_without_anything_between_are_refused() {
        for marks in [[3, 3], [3, 4], [3, 99], [99, 3]] {
            assert!(
                bent(&line(), false, marks, Vec3::ONE).is_none() && middle(&line(), false, marks).is_none()
            );
        }
        assert!(bent(&[Vec3::ONE; 5], false, [0, 4], Vec3::ONE).is_none());
    }
}
