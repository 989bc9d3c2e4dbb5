//! How hard a hand presses, made into what the drawing takes.
//!
//! Two bounds cut off what a hand never reaches, an exponent makes the pen softer or harder, and two bounds keep lines
//! from vanishing or from growing too wide. The default changes nothing.

use crate::sketch::StrokePoint;
use serde::{Deserialize, Serialize};

/// A curve from the pressure that a pen reports to the pressure that a stroke keeps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PressureCurve {
    /// Reported pressure up to which the pen counts as just touching, 0 to 1; default 0.
    pub input_min: f32,
    /// Reported pressure from which the pen counts as fully pressed, 0 to 1; default 1.
    pub input_max: f32,
    /// Exponent: below 1 softer (light hands), above 1 harder; 0.1 to 10; default 1.
    pub gamma: f32,
    /// Pressure of the lightest touch, 0 to 1; default 0.
    pub output_min: f32,
    /// Pressure of the hardest press, 0 to 1; default 1.
    pub output_max: f32,
}

impl Default for PressureCurve {
    fn default() -> Self {
        Self { input_min: 0.0, input_max: 1.0, gamma: 1.0, output_min: 0.0, output_max: 1.0 }
    }
}

impl PressureCurve {
    /// Smallest and largest exponent.
    pub const GAMMA_RANGE: (f32, f32) = (0.1, 10.0);

    /// A curve for a light hand.
    pub fn soft() -> Self {
        Self { gamma: 0.6, ..Self::default() }
    }

    /// A curve for a heavy hand.
    pub fn hard() -> Self {
        Self { gamma: 1.7, ..Self::default() }
    }

    /// The stroke's pressure, 0 to 1 for any input and any settings; it never falls while the hand presses harder.
    pub fn apply(&self, pressure: f32) -> f32 {
        if pressure.is_nan() {
            return StrokePoint::NEUTRAL_PRESSURE;
        }
        let share =
            |value: f32, otherwise: f32| if value.is_nan() { otherwise } else { value.clamp(0.0, 1.0) };
        let (low, high) = (share(self.input_min, 0.0), share(self.input_max, 1.0));
        let pressed = pressure.clamp(0.0, 1.0);
        let reached = if high > low {
            ((pressed - low) / (high - low)).clamp(0.0, 1.0)
        } else {
            f32::from(pressed > low)
        };
        let (softest, hardest) = Self::GAMMA_RANGE;
        let gamma = if self.gamma.is_nan() { 1.0 } else { self.gamma.clamp(softest, hardest) };
        let (least, most) = (share(self.output_min, 0.0), share(self.output_max, 1.0));
        (least + (most.max(least) - least) * reached.powf(gamma)).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_default_changes_nothing() {
        for k in 0..=1000 {
            let p = k as f32 / 1000.0;
            assert_eq!(PressureCurve::default().apply(p), p);
        }
    }

    #[test]
    fn soft_gives_more_and_hard_gives_less() {
        assert!(PressureCurve::soft().apply(0.3) > 0.4);
        assert!(PressureCurve::hard().apply(0.3) < 0.2);
    }

    #[test]
    fn bounds_cut_and_lift() {
        let curve =
            PressureCurve { input_min: 0.2, input_max: 0.6, output_min: 0.1, output_max: 0.9, gamma: 1.0 };
        assert_eq!(curve.apply(0.1), 0.1);
        assert!((curve.apply(0.4) - 0.5).abs() < 1e-6);
        assert!((curve.apply(0.8) - 0.9).abs() < 1e-6);
    }

    proptest! {
        #[test]
        fn any_settings_give_a_rising_curve_within_bounds(
            numbers in prop::array::uniform5(any::<f32>()), a in any::<f32>(), b in any::<f32>()
        ) {
            let [input_min, input_max, gamma, output_min, output_max] = numbers;
            let curve = PressureCurve { input_min, input_max, gamma, output_min, output_max };
            let (x, y) = (curve.apply(a), curve.apply(b));
            prop_assert!((0.0..=1.0).contains(&x));
            if a < b {
                prop_assert!(x <= y);
            }
        }
    }
}
