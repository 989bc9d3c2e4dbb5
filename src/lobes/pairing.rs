//! Where two loops begin to be joined: which sample of one belongs to which of the other, and in which sense.
//!
//! Both loops, with equally many samples, are moved over each other by their centroids; of all shifts in both senses the one
//! is taken for which samples that belong together are nearest and lie most alike from their centroids:
//!
//! E(s) = Σ |a_i − b_{i+s} − (c_A − c_B)|² + w Σ (1 − dir(a_i)·dir(b_{i+s})), w the mean squared radius.
//!
//! n² for each sense, n ≤ 96.
//!
//! Source: 001 §5.2.1, eq. 5.1, where the single pair of most similar directions to the centroids decides. Departures: the sum
//! of eq. 5.1 is a multiple of c − p_i, so directions take O(n); one pair is fragile, as every ellipse has two equal best ones,
//! and says nothing of the sense, so all pairs decide together.

use glam::Vec3;

/// How the samples of a loop belong to those of another with as many.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Start {
    /// Whether the second loop runs the other way.
    pub reversed: bool,
    /// The sample of the second loop, counted after it is turned round, that belongs to the first of the first loop.
    pub shift: usize,
}

/// The best start for two loops of equally many samples.
pub fn start_pair(a: &[Vec3], b: &[Vec3]) -> Start {
    let count = a.len().min(b.len());
    let (a, scale_a) = about_centroid(&a[..count]);
    let (b, scale_b) = about_centroid(&b[..count]);
    let weight = 0.5 * (scale_a + scale_b);
    let turned: Vec<Vec3> = b.iter().rev().copied().collect();
    let mut best = (f32::INFINITY, Start { reversed: false, shift: 0 });
    for (reversed, b) in [(false, &b), (true, &turned)] {
        let unit: Vec<Vec3> = b.iter().map(|p| p.normalize_or_zero()).collect();
        for shift in 0..count {
            let at = |i: usize| if i + shift < count { i + shift } else { i + shift - count };
            let apart = |(i, p): (usize, &Vec3)| {
                let alike = p.normalize_or_zero().dot(unit[at(i)]);
                p.distance_squared(b[at(i)]) + weight * (1.0 - alike)
            };
            let cost = a.iter().enumerate().map(apart).sum();
            if cost < best.0 {
                best = (cost, Start { reversed, shift });
            }
        }
    }
    best.1
}

/// Samples from their centroid, and their mean squared distance from it.
fn about_centroid(points: &[Vec3]) -> (Vec<Vec3>, f32) {
    let count = points.len().max(1) as f32;
    let centroid = points.iter().copied().sum::<Vec3>() / count;
    let from: Vec<Vec3> = points.iter().map(|p| p - centroid).collect();
    let squared = from.iter().map(|p| p.length_squared()).sum::<f32>() / count;
    (from, squared)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::TAU;

    fn ellipse(count: usize) -> Vec<Vec3> {
        let at = |k: usize| {
            let (sin, cos) = (k as f32 / count as f32 * TAU).sin_cos();
            Vec3::new(2.0 * cos, 0.0, sin + 0.2 * cos * cos)
        };
        (0..count).map(at).collect()
    }

    #[test]
    fn shift_and_sense_are_found_again() {
        let a = ellipse(40);
        for shift in [0, 7, 33] {
            let moved = |k: usize| a[(k + 40 - shift) % 40] * 1.3 + Vec3::new(0.3, 1.0, -0.2);
            let mut b: Vec<Vec3> = (0..40).map(moved).collect();
            assert_eq!(start_pair(&a, &b), Start { reversed: false, shift });
            b.reverse();
            assert_eq!(start_pair(&a, &b), Start { reversed: true, shift });
        }
    }

    #[test]
    fn loops_without_extent_are_no_trouble() {
        assert_eq!(start_pair(&[Vec3::ONE; 5], &[Vec3::ZERO; 5]), Start { reversed: false, shift: 0 });
    }
}
