//! How hard a hand presses, made into what the drawing takes.
//!
//! A cubic Bézier curve between two ends: what a hand never reaches lies before the first and after the last, and two
//! handles make the pen softer or harder. Handles stay inside the ends' box, where such a curve never falls and never
//! turns back, whatever they are (its slopes' Bernstein form is least for crossed handles, and there a square). The
//! default changes nothing.

use crate::sketch::StrokePoint;
use kurbo::{CubicBez, ParamCurve as _, Point};
use serde::{Deserialize, Serialize};

/// Halvings that find a pressure on the curve: to a millionth.
const HALVINGS: u32 = 20;

/// A curve from the pressure that a pen reports to the pressure that a stroke keeps; both 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct PressureCurve {
    /// Reported pressure up to which the pen counts as just touching (its minimum force), and what a stroke then keeps;
    /// default (0, 0).
    pub start: [f32; 2],
    /// Reported pressure from which the pen counts as fully pressed, and what a stroke then keeps; default (1, 1).
    pub end: [f32; 2],
    /// Where the curve leaves the start and reaches the end, as shares of the box between them; default thirds.
    pub handles: [[f32; 2]; 2],
}

impl Default for PressureCurve {
    fn default() -> Self {
        let third = 1.0 / 3.0;
        Self { start: [0.0; 2], end: [1.0; 2], handles: [[third; 2], [2.0 * third; 2]] }
    }
}

impl PressureCurve {
    /// A curve for a light hand.
    pub fn soft() -> Self {
        Self { handles: [[0.1, 0.4], [0.5, 0.9]], ..Self::default() }
    }

    /// A curve for a heavy hand.
    pub fn hard() -> Self {
        Self { handles: [[0.5, 0.1], [0.9, 0.6]], ..Self::default() }
    }

    /// The same curve with every number within its bounds and the end beyond the start.
    #[must_use]
    pub fn sound(&self) -> Self {
        let share =
            |value: f32, otherwise: f32| if value.is_nan() { otherwise } else { value.clamp(0.0, 1.0) };
        let default = Self::default();
        let start = [share(self.start[0], 0.0), share(self.start[1], 0.0)];
        let end = [share(self.end[0], 1.0).max(start[0]), share(self.end[1], 1.0).max(start[1])];
        let handle = |k: usize| {
            let [x, y] = self.handles[k];
            [share(x, default.handles[k][0]), share(y, default.handles[k][1])]
        };
        Self { start, end, handles: [handle(0), handle(1)] }
    }

    /// The stroke's pressure, 0 to 1 for any input and any settings; it never falls while the hand presses harder.
    pub fn apply(&self, pressure: f32) -> f32 {
        if pressure.is_nan() {
            return StrokePoint::NEUTRAL_PRESSURE;
        }
        let pressed = pressure.clamp(0.0, 1.0);
        if *self == Self::default() {
            return pressed;
        }
        let Self { start, end, handles: [a, b] } = self.sound();
        if pressed <= start[0] {
            return start[1];
        }
        if pressed >= end[0] {
            return end[1];
        }
        let share = f64::from((pressed - start[0]) / (end[0] - start[0]));
        let point = |[x, y]: [f32; 2]| Point::new(x.into(), y.into());
        let curve = CubicBez::new(Point::ZERO, point(a), point(b), Point::new(1.0, 1.0));
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if curve.eval(middle).x < share { low = middle } else { high = middle }
        }
        let reached = (curve.eval(high).y as f32).clamp(0.0, 1.0);
        start[1] + (end[1] - start[1]) * reached
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_default_changes_nothing() {
        let almost = PressureCurve { end: [1.0, 0.999_999], ..PressureCurve::default() };
        for k in 0..=1000 {
            let p = k as f32 / 1000.0;
            assert_eq!(PressureCurve::default().apply(p), p);
            assert!((almost.apply(p) - p).abs() < 1e-5);
        }
    }

    #[test]
    fn soft_gives_more_and_hard_gives_less() {
        assert!(PressureCurve::soft().apply(0.3) > 0.4);
        assert!(PressureCurve::hard().apply(0.3) < 0.2);
    }

    #[test]
    fn bounds_cut_and_lift() {
        let curve = PressureCurve { start: [0.2, 0.1], end: [0.6, 0.9], ..PressureCurve::default() };
        assert_eq!(curve.apply(0.1), 0.1);
        assert!((curve.apply(0.4) - 0.5).abs() < 1e-5);
        assert_eq!(curve.apply(0.8), 0.9);
    }

    proptest! {
        #[test]
        fn any_settings_give_a_rising_curve_within_bounds(
            ends in prop::array::uniform4(any::<f32>()),
            handles in prop::array::uniform4(prop_oneof![any::<f32>(), 0.0f32..=1.0]),
            a in prop_oneof![any::<f32>(), 0.0f32..=1.0],
            b in 0.0f32..=1.0,
        ) {
            let [x0, y0, x1, y1] = ends;
            let [hx0, hy0, hx1, hy1] = handles;
            for (start, end) in [([x0, y0], [x1, y1]), ([0.0; 2], [1.0; 2])] {
                let curve = PressureCurve { start, end, handles: [[hx0, hy0], [hx1, hy1]] };
                let (x, y) = (curve.apply(a), curve.apply(b));
                prop_assert!((0.0..=1.0).contains(&x));
                if a < b {
                    prop_assert!(x <= y + 1e-6);
                }
            }
        }
    }
}
