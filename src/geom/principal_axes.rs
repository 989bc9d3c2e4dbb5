//! Along which directions points are spread most and least: the axes of their covariance.
//!
//! By Jacobi's method, which turns pairs of axes until nothing is left between them; three axes take a few rounds.

use glam::{DMat3, DVec3, Vec3};

/// Rounds over all pairs of axes; single precision needs four or five.
const ROUNDS: usize = 12;

/// Middle of some points, and unit axes of their spread, widest first, right-handed. Points in one spot give the axes of the world.
pub fn principal_axes(points: &[Vec3]) -> (Vec3, [Vec3; 3]) {
    let middle = points.iter().map(|p| p.as_dvec3()).sum::<DVec3>() / points.len().max(1) as f64;
    let mut spread = DMat3::ZERO;
    for p in points {
        let d = p.as_dvec3() - middle;
        spread += DMat3::from_cols(d * d.x, d * d.y, d * d.z);
    }
    let mut axes = DMat3::IDENTITY;
    for _ in 0..ROUNDS {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let off = spread.col(q)[p];
            if off == 0.0 {
                continue;
            }
            let half = (spread.col(q)[q] - spread.col(p)[p]) / (2.0 * off);
            let tan = half.signum() / (half.abs() + (half * half + 1.0).sqrt());
            let cos = 1.0 / (tan * tan + 1.0).sqrt();
            let sin = tan * cos;
            let mut turn = DMat3::IDENTITY;
            turn.col_mut(p)[p] = cos;
            turn.col_mut(q)[q] = cos;
            turn.col_mut(q)[p] = sin;
            turn.col_mut(p)[q] = -sin;
            spread = turn.transpose() * spread * turn;
            axes *= turn;
        }
    }
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| spread.col(*b)[*b].total_cmp(&spread.col(*a)[*a]));
    let first = axes.col(order[0]).normalize_or(DVec3::X);
    let second = axes.col(order[1]).normalize_or(DVec3::Y);
    (middle.as_vec3(), [first, second, first.cross(second)].map(|axis| axis.as_vec3()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Quat;

    #[test]
    fn a_flat_ellipse_has_its_own_axes() {
        let turn = Quat::from_euler(glam::EulerRot::XYZ, 0.4, 1.1, -0.7);
        let place = |k: u32| {
            let (sin, cos) = (k as f32 / 40.0 * std::f32::consts::TAU).sin_cos();
            turn * Vec3::new(3.0 * cos, sin, 0.0) + Vec3::new(5.0, -2.0, 1.0)
        };
        let (middle, [wide, narrow, across]) = principal_axes(&(0..40).map(place).collect::<Vec<_>>());
        assert!(middle.distance(Vec3::new(5.0, -2.0, 1.0)) < 1e-5);
        for (axis, expected) in [(wide, Vec3::X), (narrow, Vec3::Y), (across, Vec3::Z)] {
            assert!(axis.dot(turn * expected).abs() > 0.9999, "{axis}");
        }
        assert!(wide.cross(narrow).dot(across) > 0.999);
    }

    #[test]
    fn points_in_one_spot_or_none_have_the_worlds_axes() {
        for points in [vec![], vec![Vec3::ONE; 4]] {
            assert_eq!(principal_axes(&points).1, Vec3::AXES);
        }
    }
}
