//! Directions that are spread evenly over the upper half of a sphere.
//!
//! Their heights are evenly spaced, and each is turned by the golden angle from the one before it: a spiral of Fibonacci.

use glam::Vec3;
use std::f32::consts::PI;

/// How low the lowest directions come, share of the height of the half sphere: none is quite level.
const LOWEST: f32 = 0.1;

/// One of so many directions, of length 1, y up; the first is the highest.
pub fn direction(number: usize, of: usize) -> Vec3 {
    let height = 1.0 - (1.0 - LOWEST) * (number as f32 + 0.5) / of as f32;
    let (sin, cos) = (number as f32 * PI * (3.0 - 5.0_f32.sqrt())).sin_cos();
    let level = (1.0 - height * height).sqrt();
    Vec3::new(level * cos, height, level * sin)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_spread_evenly_over_the_upper_half() {
        let all: Vec<Vec3> = (0..64).map(|i| direction(i, 64)).collect();
        assert!(all.iter().all(|way| way.is_normalized() && way.y > 0.1));
        assert!(all.is_sorted_by(|a, b| a.y > b.y));
        let middle = all.iter().sum::<Vec3>() / 64.0;
        assert!(middle.distance(Vec3::Y * 0.55) < 0.03, "{middle}");
        let nearest = |a: &Vec3| all.iter().map(|b| a.dot(*b)).filter(|c| *c < 0.9999).fold(-1.0, f32::max);
        assert!(all.iter().all(|way| nearest(way).acos().to_degrees() > 8.0));
    }
}
