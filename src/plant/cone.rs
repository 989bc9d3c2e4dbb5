//! The cone of a flower: petals stand on its side, their tips on its rim (000 §4.1, 002 §5.1).
//!
//! Seen from the front along −z, a vertical line through (x, y) meets the cone in up to two points, the roots of a
//! quadratic in z. [`Cone::depth_near`] takes the root on the petal's sheet that lies nearest to a hint; outside the
//! cone's silhouette it gives the depth of closest approach, so depth is continuous everywhere and never NaN.

use glam::{Vec2, Vec3};
use serde::Serialize;

/// A right circular cone.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Cone {
    /// Where the petals meet, metres.
    pub apex: Vec3,
    /// Unit direction from the apex to the middle of the rim.
    pub axis: Vec3,
    /// Angle between axis and side, radians, in (0, π/2).
    pub opening_rad: f32,
    /// Distance from the apex to the middle of the rim, metres.
    pub height: f32,
}

impl Cone {
    /// Depth of the cone's side over the front-view position `xy` (world metres): the root nearest to `hint`, on the
    /// sheet that opens along the axis where both sheets are met; the closest approach where none is.
    pub fn depth_near(&self, xy: Vec2, hint: f32) -> f32 {
        let d = xy - self.apex.truncate();
        let a = self.axis;
        let cos2 = self.opening_rad.cos().powi(2);
        let flat = a.x * d.x + a.y * d.y;
        // (w·a)² = cos²·|w|² with w = (d, z): A z² + 2 B z + C = 0
        let (qa, qb, qc) = (a.z * a.z - cos2, a.z * flat, flat * flat - cos2 * d.length_squared());
        let scale = d.length().max(f32::MIN_POSITIVE);
        if qa.abs() < 1e-6 {
            let z = if qb.abs() > 1e-12 { -qc / (2.0 * qb) } else { 0.0 };
            return self.apex.z + z.clamp(-8.0 * scale, 8.0 * scale);
        }
        let root = (qb * qb - qa * qc).max(0.0).sqrt();
        let (z0, z1) = ((-qb - root) / qa, (-qb + root) / qa);
        let on_sheet = |z: f32| flat + a.z * z >= 0.0;
        let hint = hint - self.apex.z;
        let z = match (on_sheet(z0), on_sheet(z1)) {
            (true, false) => z0,
            (false, true) => z1,
            _ if (z0 - hint).abs() <= (z1 - hint).abs() => z0,
            _ => z1,
        };
        self.apex.z + z.clamp(-8.0 * scale, 8.0 * scale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cone(axis: Vec3, opening_deg: f32) -> Cone {
        let opening_rad = opening_deg.to_radians();
        Cone { apex: Vec3::new(0.1, 0.2, -0.3), axis: axis.normalize(), opening_rad, height: 1.0 }
    }

    #[test]
    fn depth_puts_points_back_on_the_cone() {
        let cone = cone(Vec3::new(0.2, 0.9, 0.5), 40.0);
        let side = cone.axis.any_orthonormal_vector();
        for k in 0..24 {
            let around = glam::Quat::from_axis_angle(cone.axis, k as f32 * 0.26) * side;
            let direction = cone.axis * cone.opening_rad.cos() + around * cone.opening_rad.sin();
            let p = cone.apex + direction * 0.7;
            let z = cone.depth_near(p.truncate(), p.z);
            assert!((z - p.z).abs() < 1e-3, "{z} instead of {}", p.z);
        }
    }

    #[test]
    fn outside_the_silhouette_depth_is_finite() {
        let cone = cone(Vec3::new(0.0, 1.0, 0.05), 20.0);
        for x in [-3.0, -1.0, 1.0, 3.0] {
            assert!(cone.depth_near(Vec2::new(x, 0.3), 0.0).is_finite());
        }
    }
}
