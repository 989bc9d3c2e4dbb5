//! Leaves along the stem of a herb: a rosette at the ground, and above it nodes with one leaf, a pair or a whorl.
//!
//! Leaves of the rosette, and those that stand singly, follow one another by the golden angle; pairs stand crosswise, and the
//! leaves of a whorl above the gaps of the one below (phyllotaxis). All lengths are shares of the stem's, so that a plant that
//! is scaled keeps its shape.
//!
//! Limits: all leaves of a stem have one outline; those of its rosette differ from the others in length and angle alone.

use super::compound::LeafPose;
use crate::geom::{GOLDEN_RAD, polyline};
use crate::random::stream;
use glam::{Quat, Vec3};
use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use std::f32::consts::PI;

/// How far within the stem a leaf begins, share of the stem's radius.
const WITHIN: f32 = 0.6;
/// Part of the stem on which the leaves of a rosette stand, share of its length.
const ROSETTE: f32 = 0.02;
/// How much steeper the innermost leaves of a rosette stand than the outermost, share of their angle.
const STEEPER: f32 = 0.4;

crate::parameters! {
    /// Leaves of a flower's stem that nobody drew.
    pub struct StemLeaves {
        /// Leaves at the foot of the stem.
        rosette: u32 = 0, 0..=60, "";
        /// Length of those.
        rosette_length: f32 = 0.5, 0.02..=3.0, "of the stem's length";
        /// Angle between the stem and the outermost of those.
        rosette_angle_deg: f32 = 60.0, 0.0..=110.0, "degrees";
        /// Places along the stem at which leaves stand.
        nodes: u32 = 0, 0..=60, "";
        /// Leaves at each: 1 one after the other around the stem, 2 pairs, from 3 on whorls.
        per_node: u32 = 1, 1..=12, "";
        /// Where the lowest of these places is.
        from: f32 = 0.1, 0.0..=1.0, "of the stem's length";
        /// Where the uppermost is.
        to: f32 = 0.75, 0.0..=1.0, "of the stem's length";
        /// Length of the lowest leaves.
        length: f32 = 0.3, 0.02..=3.0, "of the stem's length";
        /// Length of the uppermost against that.
        shrink: f32 = 0.6, 0.02..=2.0, "";
        /// Angle between the stem and its leaves.
        angle_deg: f32 = 50.0, 0.0..=110.0, "degrees";
        /// How much leaves differ in length, angle and place.
        vary: f32 = 0.2, 0.0..=1.0, "";
    }
}

/// A leaf before it varies: where on the stem, which way around, how long, how far from the stem.
struct Stand {
    /// Whether it stands as on a stem that is upright: rosettes lie on the ground.
    is_upright: bool,
    share: f32,
    azimuth_rad: f32,
    length: f32,
    angle_rad: f32,
}

impl StemLeaves {
    /// How many leaves a stem has.
    pub fn count(&self) -> u32 {
        self.rosette + self.nodes * self.per_node
    }

    /// Where the leaves of a stem stand, those of the rosette first. The stem has at least two points, foot first, and a radius
    /// at each, metres; nothing stands on a stem without length.
    pub fn poses(&self, points: &[Vec3], radii: &[f32], seed: u64) -> Vec<LeafPose> {
        let arcs = polyline::arc_lengths(points.iter().copied());
        let whole = arcs.last().copied().unwrap_or(0.0);
        if whole <= 0.0 {
            return Vec::new();
        }
        let rng = &mut stream(seed, "leaves of a stem", 0);
        let first_rad = rng.random_range(-PI..PI);
        let stands: Vec<Stand> = self.in_rosette().chain(self.at_nodes()).collect();
        let pose = |stand: Stand| {
            let Stand { is_upright, share, azimuth_rad, length, angle_rad } = self.varied(stand, rng);
            let (i, t) = polyline::locate(&arcs, share * whole);
            let base = polyline::interpolate(points, (i, t));
            let next = (i + 1).min(points.len() - 1);
            let along = (points[next] - points[next - 1]).normalize_or(Vec3::Y);
            let axis = if is_upright { Vec3::Y } else { along };
            let radius = radii[i] + (radii[next] - radii[i]) * t;
            let outward = outward(axis, first_rad + azimuth_rad);
            let v = axis * angle_rad.cos() + outward * angle_rad.sin();
            let face = axis * angle_rad.sin() - outward * angle_rad.cos();
            let base = base + outward * (WITHIN * radius);
            LeafPose { base, u: v.cross(face), v, length: length * whole }
        };
        stands.into_iter().map(pose).collect()
    }

    fn in_rosette(&self) -> impl Iterator<Item = Stand> {
        let angle_rad = self.rosette_angle_deg.to_radians();
        (0..self.rosette).map(move |k| {
            let inward = k as f32 / self.rosette as f32;
            Stand {
                is_upright: true,
                share: ROSETTE * inward,
                azimuth_rad: GOLDEN_RAD * k as f32,
                length: self.rosette_length,
                angle_rad: angle_rad * (1.0 - STEEPER * inward),
            }
        })
    }

    fn at_nodes(&self) -> impl Iterator<Item = Stand> {
        let (nodes, around) = (self.nodes, self.per_node.max(1));
        let turn = if around == 1 { GOLDEN_RAD } else { PI / around as f32 };
        (0..nodes * around).map(move |k| {
            let (node, beside) = (k / around, k % around);
            let up = if nodes > 1 { node as f32 / (nodes - 1) as f32 } else { 0.0 };
            Stand {
                is_upright: false,
                share: self.from + (self.to - self.from) * up,
                azimuth_rad: turn * node as f32 + 2.0 * PI * beside as f32 / around as f32,
                length: self.length * (1.0 + (self.shrink - 1.0) * up),
                angle_rad: self.angle_deg.to_radians(),
            }
        })
    }

    /// A leaf that differs from the others a little.
    fn varied(&self, stand: Stand, rng: &mut Pcg64Mcg) -> Stand {
        let mut by = |most: f32| self.vary * rng.random_range(-most..most);
        Stand {
            is_upright: stand.is_upright,
            share: stand.share,
            azimuth_rad: stand.azimuth_rad + by(0.5),
            length: stand.length * (1.0 + by(0.6)),
            angle_rad: stand.angle_rad * (1.0 + by(0.6)),
        }
    }
}

/// The direction across a stem at that angle around it.
fn outward(axis: Vec3, azimuth_rad: f32) -> Vec3 {
    let across = Vec3::X - axis * axis.x;
    let across = across.normalize_or(axis.any_orthonormal_vector());
    Quat::from_axis_angle(axis, azimuth_rad) * across
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEM: [Vec3; 3] = [Vec3::ZERO, Vec3::new(0.0, 0.2, 0.0), Vec3::new(0.0, 0.4, 0.0)];
    const RADII: [f32; 3] = [0.004; 3];

    fn exact(leaves: StemLeaves) -> Vec<LeafPose> {
        StemLeaves { vary: 0.0, ..leaves }.poses(&STEM, &RADII, 3)
    }

    #[test]
    fn leaves_stand_where_asked_for_and_are_as_long() {
        let leaves =
            StemLeaves { nodes: 3, from: 0.25, to: 0.75, length: 0.5, shrink: 0.5, ..StemLeaves::default() };
        let poses = exact(leaves);
        let heights: Vec<f32> = poses.iter().map(|pose| pose.base.y).collect();
        let lengths: Vec<f32> = poses.iter().map(|pose| pose.length).collect();
        assert!(heights.iter().zip([0.1, 0.2, 0.3]).all(|(a, b)| (a - b).abs() < 1e-5), "{heights:?}");
        assert!(lengths.iter().zip([0.2, 0.15, 0.1]).all(|(a, b)| (a - b).abs() < 1e-5), "{lengths:?}");
    }

    #[test]
    fn pairs_stand_crosswise_and_whorls_above_gaps() {
        for (around, apart) in [(2, 90.0), (3, 60.0), (5, 36.0_f32)] {
            let poses = exact(StemLeaves { nodes: 2, per_node: around, ..StemLeaves::default() });
            let side = |pose: &LeafPose| Vec3::new(pose.v.x, 0.0, pose.v.z);
            let angle = |a: &LeafPose, b: &LeafPose| side(a).angle_between(side(b)).to_degrees();
            let above = &poses[around as usize];
            let nearest = poses[..around as usize].iter().map(|below| angle(below, above));
            assert!((nearest.fold(f32::MAX, f32::min) - apart).abs() < 0.1, "{around}");
        }
    }

    #[test]
    fn faces_look_up_and_no_leaf_leaves_the_stem() {
        let leaves = StemLeaves { rosette: 9, nodes: 5, vary: 1.0, ..StemLeaves::default() };
        let poses = leaves.poses(&STEM, &RADII, 7);
        assert_eq!(poses.len() as u32, leaves.count());
        for pose in poses {
            assert!(pose.u.cross(pose.v).y > 0.0 && pose.u.is_normalized() && pose.v.is_normalized());
            assert!(Vec3::new(pose.base.x, 0.0, pose.base.z).length() < RADII[0]);
        }
    }

    #[test]
    fn a_stem_without_length_bears_nothing() {
        let leaves = StemLeaves { nodes: 4, ..StemLeaves::default() };
        assert!(leaves.poses(&[Vec3::ONE; 2], &RADII[..2], 1).is_empty());
    }
}
