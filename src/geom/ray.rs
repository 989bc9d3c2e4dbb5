//! A ray and where it meets triangles.

use glam::Vec3;

/// A half line in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it begins, metres.
    pub origin: Vec3,
    /// Unit direction.
    pub direction: Vec3,
}

impl Ray {
    /// The point at a distance along it, metres.
    pub fn at(&self, distance: f32) -> Vec3 {
        self.origin + self.direction * distance
    }

    /// Distance to a triangle, seen from either side, metres; `None` where it passes by or lies in the triangle's plane.
    /// Möller and Trumbore, *Fast, Minimum Storage Ray-Triangle Intersection*, 1997.
    pub fn meets(&self, [a, b, c]: [Vec3; 3]) -> Option<f32> {
        let (ab, ac) = (b - a, c - a);
        let normal = self.direction.cross(ac);
        let determinant = ab.dot(normal);
        if determinant == 0.0 {
            return None;
        }
        let from_a = self.origin - a;
        let along_ab = from_a.dot(normal) / determinant;
        let across = from_a.cross(ab);
        let along_ac = self.direction.dot(across) / determinant;
        let inside = along_ab >= 0.0 && along_ac >= 0.0 && along_ab + along_ac <= 1.0;
        Some(ac.dot(across) / determinant).filter(|distance| inside && *distance >= 0.0)
    }

    /// Distance to where the ray enters a box between two corners; `None` where it misses it or begins inside.
    pub fn enters(&self, (low, high): (Vec3, Vec3)) -> Option<f32> {
        let (a, b) = ((low - self.origin) / self.direction, (high - self.origin) / self.direction);
        let (enters, leaves) = (a.min(b).max_element(), a.max(b).min_element());
        (enters > 0.0 && enters <= leaves).then_some(enters)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::Y];

    #[test]
    fn a_box_is_entered_from_outside_only() {
        let (low, high) = (Vec3::splat(-1.0), Vec3::ONE);
        let enters = |origin, direction| Ray { origin, direction }.enters((low, high));
        assert_eq!(enters(Vec3::new(0.5, 0.5, 4.0), Vec3::NEG_Z), Some(3.0));
        for (origin, direction) in [
            (Vec3::new(0.0, 0.0, 4.0), Vec3::Z),
            (Vec3::new(2.0, 0.0, 4.0), Vec3::NEG_Z),
            (Vec3::ZERO, Vec3::X),
        ] {
            assert_eq!(enters(origin, direction), None, "{origin} {direction}");
        }
    }

    #[test]
    fn a_triangle_is_met_from_both_sides_and_missed_beside_and_behind() {
        let ray = |x: f32, z: f32, to: Vec3| Ray { origin: Vec3::new(x, 0.2, z), direction: to };
        assert_eq!(ray(0.2, 3.0, Vec3::NEG_Z).meets(TRIANGLE), Some(3.0));
        assert_eq!(ray(0.2, -2.0, Vec3::Z).meets(TRIANGLE), Some(2.0));
        assert_eq!(ray(0.9, 3.0, Vec3::NEG_Z).meets(TRIANGLE), None);
        assert_eq!(ray(0.2, 3.0, Vec3::Z).meets(TRIANGLE), None);
        assert_eq!(ray(0.2, 0.0, Vec3::X).meets(TRIANGLE), None);
    }
}
