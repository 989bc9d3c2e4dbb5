//! The common base of a bush's stems, its root crown: how thick it is and where each stem stands on it.
//!
//! The base is wood like any other. The skeleton of the first stem runs through it from the middle of its foot and says how
//! thick it is; the other stems are branches that begin inside of it and leave its bark alternately low and high, evenly
//! around it. A maker of bushes brings stems to these places. A surface needs to know of no base, only of joints; what
//! joints need of bark is reckoned with here, beside what they need anywhere ([`junction`](super::junction)).
//!
//! Limits: all stems are reckoned as thick as the thickest where heights are concerned. The base stands upright. Joints
//! of more than 25 stems of one thickness that rise steeply do not find room.

use super::junction::APART;
use glam::Vec3;
use std::f32::consts::TAU;

/// Radius of the base over the root of the sum of the stems' squared radii: a little more than as thick as all of them.
const THICK: f32 = 1.2;
/// Heights at which stems leave the base in turn, and of its shoulder, in radii of the thickest stem: half of a stem's
/// joint is some 2.5 high.
const LOW: f32 = 2.4;
const HIGH: f32 = 6.4;
const SHOULDER: f32 = 8.0;
/// Height from the shoulder to the first stem, in radii of the base.
const TOP: f32 = 0.8;
/// Height by which stems rise from where they begin to the bark, in radii of the base: by about
/// [`LEAST_ANGLE_RAD`](super::junction::LEAST_ANGLE_RAD), so that joints hardly bend them.
const RISE: f32 = 0.8;

/// The common base of stems.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StemBase {
    /// Middle of its foot, metres.
    pub middle: Vec3,
    /// Its radius, metres.
    pub radius: f32,
    /// Radius of the thickest stem, metres.
    pub thickest: f32,
}

impl StemBase {
    /// The base of stems that have these radii, metres: with bark for every one of them.
    pub fn below(middle: Vec3, stems: impl Iterator<Item = f32> + Clone) -> Self {
        let squares: f32 = stems.clone().map(|r| r * r).sum();
        // A part of its girth for each stem, so wide that no two of one height touch.
        let girth = 2.0 * APART * stems.clone().sum::<f32>();
        Self {
            middle,
            radius: (THICK * squares.sqrt()).max(girth / TAU),
            thickest: stems.fold(0.0, f32::max),
        }
    }

    /// From the middle of its foot to where the first stem stands on its top, metres.
    pub fn to_top(&self) -> Vec3 {
        Vec3::Y * (SHOULDER * self.thickest + TOP * self.radius)
    }

    /// From the middle of its foot to where each of the other stems leaves its bark, metres, in the order in which they
    /// stand around it; the first at this angle about the vertical, radians from x toward z.
    pub fn to_sides(&self, first_rad: f32, count: usize) -> impl Iterator<Item = Vec3> + use<> {
        let Self { radius, thickest, .. } = *self;
        (0..count).map(move |k| {
            let (sin, cos) = (first_rad + TAU * k as f32 / count as f32).sin_cos();
            let height = thickest * if k % 2 == 0 { LOW } else { HIGH };
            Vec3::new(radius * cos, height, radius * sin)
        })
    }

    /// The skeleton of the base, points with radii, below a first stem whose foot is there.
    pub fn skeleton(&self, foot: Vec3) -> [(Vec3, f32); 2] {
        let shoulder = foot - Vec3::Y * (TOP * self.radius).min(0.5 * (foot.y - self.middle.y));
        [(self.middle, self.radius), (shoulder, self.radius)]
    }

    /// Where a stem begins inside of the base that leaves its bark there.
    pub fn start(&self, leaves: Vec3) -> Vec3 {
        self.middle.with_y((leaves.y - RISE * self.radius).max(self.middle.y))
    }
}

#[cfg(test)]
mod tests {
    use super::super::junction::LEAST_ANGLE_RAD;
    use super::*;

    #[test]
    fn every_stem_has_a_part_of_the_girth() {
        for radii in [vec![0.02; 2], vec![0.02; 30], vec![0.01, 0.03, 0.002]] {
            let base = StemBase::below(Vec3::X, radii.iter().copied());
            assert!(base.radius * TAU > 2.0 * APART * radii.iter().sum::<f32>() * 0.999, "{radii:?}");
            assert!(base.radius > base.thickest && base.to_top().y > HIGH * base.thickest);
        }
    }

    #[test]
    fn stems_begin_inside_and_rise_about_as_steeply_as_joints_let_them() {
        let base = StemBase::below(Vec3::ZERO, [0.02; 5].into_iter());
        for side in base.to_sides(0.0, 4) {
            let rise = side - base.start(side);
            assert!(
                base.start(side).y == 0.0 || (rise.angle_between(Vec3::Y) - LEAST_ANGLE_RAD).abs() < 0.06
            );
            assert!((rise.with_y(0.0).length() - base.radius).abs() < 1e-6);
        }
        assert_eq!(base.start(Vec3::X * base.radius), Vec3::ZERO, "not below the foot");
    }
}
