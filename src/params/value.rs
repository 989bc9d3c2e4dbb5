//! What a parameter can hold: numbers, whole numbers and switches, each read within its range.

use super::Kind;
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error};
use std::fmt::Display;
use std::marker::PhantomData;

/// A value that a parameter can hold; switches count as 0 and 1.
pub trait ParamValue: Sized {
    /// Its kind.
    const KIND: Kind;

    /// The value at an age as a number, for ranges and panels.
    fn at_age(&self, age: f32) -> f64;

    /// The value that a number in the source stands for.
    fn from_number(number: f64) -> Self;

    /// Reads a value and checks its range.
    ///
    /// # Errors
    /// A value of another type; a value outside the range, with the key, the value and the range.
    fn read<'de, D: Deserializer<'de>>(source: D, range: &Range<Self>) -> Result<Self, D::Error>;
}

/// The range of the value of a key; as a seed it reads the value.
pub struct Range<T> {
    key: &'static str,
    /// Smallest allowed value.
    pub min: f64,
    /// Largest allowed value.
    pub max: f64,
    value: PhantomData<T>,
}

impl<T> Range<T> {
    /// The range of this key's value, both ends included.
    pub fn new(key: &'static str, min: f64, max: f64) -> Self {
        Self { key, min, max, value: PhantomData }
    }

    /// A message about the value, with its key.
    pub fn named(&self, reason: &str) -> String {
        format!("`{}`: {reason}", self.key)
    }

    /// That a value is outside, with its key.
    pub fn refusal(&self, value: impl Display) -> String {
        self.named(&format!("{value} is outside {} to {}", self.min, self.max))
    }
}

impl<'de, T: ParamValue> DeserializeSeed<'de> for Range<T> {
    type Value = T;

    fn deserialize<D: Deserializer<'de>>(self, source: D) -> Result<T, D::Error> {
        T::read(source, &self)
    }
}

macro_rules! numbers {
    ($($ty:ty: $kind:ident),*) => { $(
        impl ParamValue for $ty {
            const KIND: Kind = Kind::$kind;

            fn at_age(&self, _: f32) -> f64 {
                *self as f64
            }

            fn from_number(number: f64) -> Self {
                number as $ty
            }

            fn read<'de, D: Deserializer<'de>>(source: D, range: &Range<Self>) -> Result<Self, D::Error> {
                let value = <$ty>::deserialize(source)?;
                // As what is read: 0.6 is the number above it in 32 bits.
                if (range.min as $ty..=range.max as $ty).contains(&value) {
                    return Ok(value);
                }
                Err(D::Error::custom(range.refusal(value)))
            }
        }
    )* };
}
numbers!(f32: Number, u32: Whole, usize: Whole);

impl ParamValue for bool {
    const KIND: Kind = Kind::Switch;

    fn at_age(&self, _: f32) -> f64 {
        f64::from(*self)
    }

    fn from_number(number: f64) -> Self {
        number > 0.5
    }

    fn read<'de, D: Deserializer<'de>>(source: D, _: &Range<Self>) -> Result<Self, D::Error> {
        Self::deserialize(source)
    }
}
