//! A number that changes with the plant's age, piecewise linear: one plant is a whip at 5 and a wide crown at 30
//! (001 fig. 2.7), and a willow droops late.
//!
//! In a species file a schedule is a number, or a list of `[age, value]` pairs with rising ages. Before the first age
//! and after the last the value stays as it is there.

use crate::params::{Kind, ParamValue, Range};
use serde::Serialize;
use serde::de::{Deserializer, Error, SeqAccess, Visitor};
use std::fmt;

/// A piecewise linear function of the age in years.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Schedule {
    /// (age, value), ages strictly rising, never empty.
    knots: Vec<(f32, f32)>,
}

impl Schedule {
    /// The same value at every age.
    pub fn constant(value: f32) -> Self {
        Self { knots: vec![(0.0, value)] }
    }

    /// A schedule through these (age, value) pairs.
    ///
    /// # Errors
    /// No pair, a number that is not finite, an age that does not rise, a value outside the range.
    pub fn new(knots: Vec<(f32, f32)>, min: f32, max: f32) -> Result<Self, String> {
        if knots.is_empty() {
            return Err(
                "an empty schedule; write a number, or pairs such as [[0, 1.0], [20, 0.5]]".to_owned()
            );
        }
        for (k, &(age, value)) in knots.iter().enumerate() {
            if !(0.0..=10_000.0).contains(&age) {
                return Err(format!("the age {age} is outside 0 to 10000"));
            }
            if k > 0 && age <= knots[k - 1].0 {
                return Err(format!("the age {age} stands after {}; ages must rise", knots[k - 1].0));
            }
            check(value, min, max)?;
        }
        Ok(Self { knots })
    }

    /// The schedule with every value at least this.
    #[must_use]
    pub fn at_least(&self, least: f32) -> Self {
        Self { knots: self.knots.iter().map(|(age, value)| (*age, value.max(least))).collect() }
    }

    /// The schedule with every value above 0 brought into a range; 0 stays 0.
    #[must_use]
    pub fn clamped_unless_0(&self, least: f32, most: f32) -> Self {
        let clamp = |value: f32| if value > 0.0 { value.clamp(least, most) } else { value };
        Self { knots: self.knots.iter().map(|(age, value)| (*age, clamp(*value))).collect() }
    }

    /// The schedule with every value multiplied.
    #[must_use]
    pub fn times(&self, factor: f32) -> Self {
        Self { knots: self.knots.iter().map(|(age, value)| (*age, value * factor)).collect() }
    }

    /// The value at an age.
    pub fn at(&self, age: f32) -> f32 {
        let after = self.knots.partition_point(|(a, _)| *a <= age);
        match (after.checked_sub(1).and_then(|k| self.knots.get(k)), self.knots.get(after)) {
            (Some(&(a, x)), Some(&(b, y))) => x + (y - x) * ((age - a) / (b - a)),
            (Some(&(_, x)), None) | (None, Some(&(_, x))) => x,
            (None, None) => 0.0,
        }
    }
}

impl From<f32> for Schedule {
    fn from(value: f32) -> Self {
        Self::constant(value)
    }
}

/// Refuses a value outside its range; so does it NaN.
fn check(value: f32, min: f32, max: f32) -> Result<(), String> {
    if (min..=max).contains(&value) { Ok(()) } else { Err(format!("{value} is outside {min} to {max}")) }
}

impl ParamValue for Schedule {
    const KIND: Kind = Kind::Aged;

    fn at_age(&self, age: f32) -> f64 {
        f64::from(self.at(age))
    }

    fn read<'de, D: Deserializer<'de>>(source: D, range: &Range<Self>) -> Result<Self, D::Error> {
        struct NumberOrPairs<'r>(&'r Range<Schedule>);
        impl NumberOrPairs<'_> {
            fn schedule(&self, knots: Vec<(f32, f32)>) -> Result<Schedule, String> {
                let Range { min, max, .. } = *self.0;
                Schedule::new(knots, min as f32, max as f32).map_err(|reason| self.0.named(&reason))
            }
        }
        impl<'de> Visitor<'de> for NumberOrPairs<'_> {
            type Value = Schedule;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number or a list of [age, value] pairs")
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<Schedule, E> {
                self.schedule(vec![(0.0, value as f32)]).map_err(E::custom)
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Schedule, E> {
                self.visit_f64(value as f64)
            }

            fn visit_u64<E: Error>(self, value: u64) -> Result<Schedule, E> {
                self.visit_f64(value as f64)
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Schedule, A::Error> {
                let mut knots = Vec::new();
                while let Some(pair) = list.next_element::<(f32, f32)>()? {
                    knots.push(pair);
                }
                self.schedule(knots).map_err(A::Error::custom)
            }
        }
        source.deserialize_any(NumberOrPairs(range))
    }

    fn from_number(number: f64) -> Self {
        Self::constant(number as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_run_straight_between_ages_and_stay_beyond_them() {
        let s = Schedule::new(vec![(2.0, 1.0), (4.0, 3.0), (10.0, 0.0)], -9.0, 9.0).unwrap();
        assert_eq!(
            [0.0, 2.0, 3.0, 4.0, 7.0, 10.0, 99.0].map(|age| s.at(age)),
            [1.0, 1.0, 2.0, 3.0, 1.5, 0.0, 0.0]
        );
    }

    #[test]
    fn values_above_0_are_clamped_and_0_stays() {
        let s = Schedule::new(vec![(0.0, 0.0), (4.0, 9.0), (5.0, 0.5)], 0.0, 9.0).unwrap();
        assert_eq!(
            [0.0, 2.0, 4.0, 5.0].map(|age| s.clamped_unless_0(1.0, 2.0).at(age)),
            [0.0, 1.0, 2.0, 1.0]
        );
    }

    #[test]
    fn what_is_no_schedule_is_refused() {
        let fault = |knots: &[(f32, f32)]| Schedule::new(knots.to_vec(), 0.0, 1.0).unwrap_err();
        assert!(fault(&[]).contains("empty"));
        assert!(fault(&[(3.0, 0.5), (3.0, 0.6)]).contains("ages must rise"));
        assert!(fault(&[(0.0, f32::NAN)]).contains("outside"));
        assert!(fault(&[(f32::NAN, 0.5)]).contains("outside"));
        assert!(fault(&[(0.0, 1.5)]).contains("1.5 is outside 0 to 1"));
    }
}
