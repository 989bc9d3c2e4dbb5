//! Rotation-minimising frames along a curve, by double reflection.
//!
//! A reference direction is carried from point to point with as little twist as possible: reflected in the plane half
//! way between the points, then in the plane that brings the reflected tangent onto the next one. The error against
//! the true frame falls with the fourth power of the step.
//!
//! Limits: where the curve turns straight back, the turn has no plane and any transport is as good as another.
//! Source: Wang, Jüttler, Zheng and Liu, *Computation of rotation minimizing frames*, ACM TOG 27(1), 2008, table I.
//! The papers' rings (000 §5.3.3) start from `(0, 0, r)` and turn about a cross product; both vanish on plain branches.

use glam::Vec3;

/// A unit vector square to `tangent` that points backward (−z) where it can, so that seams hide behind the plant.
pub fn hidden_side(tangent: Vec3) -> Vec3 {
    let back = Vec3::NEG_Z.reject_from_normalized(tangent);
    if back.length_squared() > 0.01 {
        return back.normalize();
    }
    Vec3::X
        .reject_from_normalized(tangent)
        .try_normalize()
        .unwrap_or_else(|| tangent.any_orthonormal_vector())
}

/// Carries `reference`, square to the unit tangent `t0` at `p0`, to the unit tangent `t1` at `p1`.
pub fn transport(reference: Vec3, (p0, t0): (Vec3, Vec3), (p1, t1): (Vec3, Vec3)) -> Vec3 {
    let reflect = |v: Vec3, mirror: Vec3, squared: f32| v - mirror * (2.0 / squared * mirror.dot(v));
    let step = p1 - p0;
    let squared = step.length_squared();
    let (mut carried, mut tangent) = (reference, t0);
    if squared > f32::MIN_POSITIVE {
        (carried, tangent) = (reflect(carried, step, squared), reflect(tangent, step, squared));
    }
    let turn = t1 - tangent;
    let squared = turn.length_squared();
    if squared > 1e-12 {
        carried = reflect(carried, turn, squared);
    }
    // Rounding must not add up along a long branch.
    carried.reject_from_normalized(t1).try_normalize().unwrap_or_else(|| hidden_side(t1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn carried_along(curve: impl Fn(f32) -> (Vec3, Vec3), steps: usize) -> Vec3 {
        let at = |k: usize| curve(k as f32 / steps as f32);
        let start = hidden_side(at(0).1);
        (0..steps).fold(start, |r, k| transport(r, at(k), at(k + 1)))
    }

    #[test]
    fn a_flat_curve_does_not_twist() {
        let circle = |s: f32| {
            let a = s * 6.0;
            (Vec3::new(a.cos(), a.sin(), 0.0), Vec3::new(-a.sin(), a.cos(), 0.0))
        };
        assert!((carried_along(circle, 40) - Vec3::NEG_Z).length() < 1e-3);
    }

    #[test]
    fn a_helix_turns_by_its_torsion() {
        // Torsion of a helix of radius 1 and rise 1 per radian is 1/2 per arc length √2: about the tangent, the frame
        // falls behind the Frenet frame by torsion times length.
        let helix = |s: f32| {
            let a = s * std::f32::consts::TAU;
            let tangent = Vec3::new(-a.sin(), a.cos(), 1.0).normalize();
            (Vec3::new(a.cos(), a.sin(), a), tangent)
        };
        let (start, end) = (hidden_side(helix(0.0).1), carried_along(helix, 200));
        let tangent = helix(1.0).1;
        let twist = tangent.dot(start.cross(end)).atan2(start.dot(end));
        let expected = -std::f32::consts::TAU * std::f32::consts::FRAC_1_SQRT_2;
        let wrapped = (twist - expected).rem_euclid(std::f32::consts::TAU);
        assert!(wrapped.min(std::f32::consts::TAU - wrapped) < 0.01, "{twist} instead of {expected}");
    }

    #[test]
    fn straight_and_reversing_steps_stay_square() {
        for (t0, t1) in [(Vec3::Z, Vec3::Z), (Vec3::Z, Vec3::NEG_Z), (Vec3::Y, Vec3::X)] {
            let r = transport(hidden_side(t0), (Vec3::ZERO, t0), (t0, t1));
            assert!(r.is_normalized() && r.dot(t1).abs() < 1e-5);
        }
    }
}
