//! Where a pen display's pen really is: what it says, put right by four crosses that were touched.
//!
//! The glass lies over the picture and the digitizer under it, so that what a pen display says is shifted, stretched and
//! slightly turned. That is an affine map; four crosses give it by least squares, and say by what is left over whether
//! they were touched well. Places are shares of the rectangle that the tablet covers.

use glam::{DAffine2, DMat2, DVec2};
use serde::{Deserialize, Serialize};

/// Where the crosses stand, in shares of the rectangle.
pub const CROSSES: [DVec2; 4] =
    [DVec2::new(0.1, 0.1), DVec2::new(0.9, 0.1), DVec2::new(0.9, 0.9), DVec2::new(0.1, 0.9)];
/// Farthest that a cross may be missed by what the correction makes of its touch, in shares.
const MOST_MISSED: f64 = 0.02;
/// A correction moves no place by more, in shares: beyond, something else is wrong than a display's glass.
const MOST_MOVED: f64 = 0.15;

/// Least spread of touches over both directions, in shares to the fourth; that of the crosses is 0.41.
const LEAST_SPREAD: f64 = 1e-3;

/// A correction of places; by itself it leaves them as they are.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "[f64; 6]", try_from = "[f64; 6]")]
pub struct Calibration(DAffine2);

impl Default for Calibration {
    fn default() -> Self {
        Self(DAffine2::IDENTITY)
    }
}

impl From<Calibration> for [f64; 6] {
    fn from(calibration: Calibration) -> Self {
        calibration.0.to_cols_array()
    }
}

impl TryFrom<[f64; 6]> for Calibration {
    type Error = &'static str;

    fn try_from(numbers: [f64; 6]) -> Result<Self, Self::Error> {
        Self::sound(DAffine2::from_cols_array(&numbers)).ok_or("a calibration moves places by a little only")
    }
}

impl Calibration {
    /// The correction that brings what the tablet said at each of [`CROSSES`] to it, on top of this one, which held then;
    /// `None` where the crosses were not touched well.
    pub fn refined(self, said: [DVec2; 4]) -> Option<Self> {
        let correction = fit(said)?;
        let missed =
            said.iter().zip(CROSSES).map(|(said, cross)| correction.transform_point2(*said).distance(cross));
        if !missed.into_iter().all(|missed| missed <= MOST_MISSED) {
            return None;
        }
        Self::sound(correction * self.0)
    }

    /// The place that a share stands for.
    pub fn apply(self, share: DVec2) -> DVec2 {
        self.0.transform_point2(share)
    }

    fn sound(map: DAffine2) -> Option<Self> {
        let moved = |corner: DVec2| map.transform_point2(corner).distance(corner);
        let corners = [DVec2::ZERO, DVec2::X, DVec2::Y, DVec2::ONE];
        (map.is_finite() && corners.into_iter().all(|corner| moved(corner) <= MOST_MOVED))
            .then_some(Self(map))
    }
}

/// The affine map that brings places to the crosses with the least squares left over.
fn fit(said: [DVec2; 4]) -> Option<DAffine2> {
    let mean = |places: [DVec2; 4]| places.into_iter().sum::<DVec2>() / 4.0;
    let (from, to) = (mean(said), mean(CROSSES));
    let outer = |a: DVec2, b: DVec2| DMat2::from_cols(a * b.x, a * b.y);
    let sum = |of: &dyn Fn(DVec2, DVec2) -> DMat2| {
        said.into_iter()
            .zip(CROSSES)
            .map(|(said, cross)| of(said - from, cross - to))
            .fold(DMat2::ZERO, |a, b| a + b)
    };
    let spread = sum(&|said, _| outer(said, said));
    let together = sum(&|said, cross| outer(cross, said));
    let determinant = spread.determinant().abs();
    // All at one place, on a line, or no numbers.
    if determinant.is_nan() || determinant <= LEAST_SPREAD {
        return None;
    }
    let turn = together * spread.inverse();
    Some(DAffine2::from_mat2_translation(turn, to - turn * from))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn four_touches_undo_what_the_glass_does() {
        let glass =
            DAffine2::from_scale_angle_translation(DVec2::new(1.02, 0.98), 0.01, DVec2::new(0.02, -0.01));
        let calibration =
            Calibration::default().refined(CROSSES.map(|cross| glass.transform_point2(cross))).unwrap();
        for place in [DVec2::ZERO, DVec2::splat(0.5), DVec2::new(1.0, 0.3)] {
            assert!(calibration.apply(glass.transform_point2(place)).distance(place) < 1e-12);
        }
        let again = calibration.refined(CROSSES).unwrap();
        assert!(again.apply(DVec2::X).distance(calibration.apply(DVec2::X)) < 1e-12, "it was right already");
    }

    #[test]
    fn touches_beside_the_crosses_change_nothing() {
        let touched = |place: usize, by: DVec2| {
            let mut said = CROSSES;
            said[place] += by;
            Calibration::default().refined(said)
        };
        assert!(touched(0, DVec2::new(0.3, 0.0)).is_none(), "one far beside");
        assert!(touched(2, DVec2::new(0.005, 0.0)).is_some(), "one slightly beside");
        assert!(Calibration::default().refined([DVec2::splat(0.5); 4]).is_none(), "all at one place");
        assert!(Calibration::default().refined(CROSSES.map(|cross| cross + 0.3)).is_none(), "all far away");
        assert!(Calibration::try_from([2.0, 0.0, 0.0, 1.0, 0.0, 0.0]).is_err());
    }

    proptest! {
        #[test]
        fn any_touches_end_in_a_sound_answer(numbers in prop::array::uniform8(prop::num::f64::ANY)) {
            let [a, b, c, d, e, f, g, h] = numbers;
            let said = [DVec2::new(a, b), DVec2::new(c, d), DVec2::new(e, f), DVec2::new(g, h)];
            if let Some(calibration) = Calibration::default().refined(said) {
                prop_assert!(calibration.apply(DVec2::splat(0.5)).is_finite());
                prop_assert_eq!(Calibration::try_from(<[f64; 6]>::from(calibration)), Ok(calibration));
            }
        }
    }
}
