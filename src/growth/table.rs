//! Sections of a species file whose every key has a meaning, a unit, a range and a default, said once.
//!
//! [`growth_table!`](crate::growth_table!) declares the struct, its `Default`, its reading with the range of each value
//! checked in place, so that an error knows its line, unknown keys refused with the nearest known one, and the
//! [`Description`](crate::params::Description)s that panels and help pages show.

use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, Visitor};
use std::fmt;

/// A value that a growth table can hold.
pub trait TableValue: Sized {
    /// Reads a value and checks its range.
    ///
    /// # Errors
    /// A value of another type or outside the range.
    fn read<'de, D: Deserializer<'de>>(source: D, min: f64, max: f64) -> Result<Self, D::Error>;

    /// The value as a number, for panels: a schedule's at age 0.
    fn as_number(&self) -> f64;

    /// The value that a number in the source stands for.
    fn from_number(number: f64) -> Self;
}

macro_rules! plain_values {
    ($($ty:ty),*) => { $(
        impl TableValue for $ty {
            fn read<'de, D: Deserializer<'de>>(source: D, min: f64, max: f64) -> Result<Self, D::Error> {
                let value = <$ty>::deserialize(source)?;
                if (min..=max).contains(&f64::from(value)) {
                    return Ok(value);
                }
                Err(D::Error::custom(format!("{value} is outside {min} to {max}")))
            }

            fn as_number(&self) -> f64 {
                f64::from(*self)
            }

            fn from_number(number: f64) -> Self {
                number as $ty
            }
        }
    )* };
}
plain_values!(f32, u32);

/// Reads a [`TableValue`] within its range.
pub struct Ranged<T>(pub f64, pub f64, pub std::marker::PhantomData<T>);

impl<'de, T: TableValue> DeserializeSeed<'de> for Ranged<T> {
    type Value = T;

    fn deserialize<D: Deserializer<'de>>(self, source: D) -> Result<T, D::Error> {
        T::read(source, self.0, self.1)
    }
}

/// Reads one of the known keys and gives its place in the list.
pub struct Key(pub &'static [&'static str]);

impl<'de> DeserializeSeed<'de> for Key {
    type Value = usize;

    fn deserialize<D: Deserializer<'de>>(self, source: D) -> Result<usize, D::Error> {
        source.deserialize_identifier(self)
    }
}

impl Visitor<'_> for Key {
    type Value = usize;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a key")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<usize, E> {
        self.0.iter().position(|known| *known == name).ok_or_else(|| {
            let nearest = crate::suggest::nearest(name, self.0.iter().copied()).map(str::to_owned);
            E::custom(format!("unknown key `{name}`{}", crate::suggest::did_you_mean(&nearest)))
        })
    }
}

/// Declares a section of a species file. Each value reads `/// help` `name: Type = default, min..=max, "unit";`, then
/// after `choices:` values that are read as they are, `name: Type = default;`.
#[macro_export]
macro_rules! growth_table {
    ($(#[doc = $about:literal])* $vis:vis struct $name:ident {
        $($(#[doc = $help:literal])+ $field:ident: $ty:ty = $default:expr, $min:literal ..= $max:literal, $unit:literal;)*
        $(choices: $($(#[doc = $choice_help:literal])+ $choice:ident: $choice_ty:ty = $choice_default:expr;)*)?
    }) => {
        $(#[doc = $about])*
        #[derive(Clone, Debug, PartialEq)]
        $vis struct $name {
            $($(#[doc = $help])+
              #[doc = concat!(" Default `", stringify!($default), "`, range `", stringify!($min), "..=", stringify!($max), "` ", $unit, ".")]
              pub $field: $ty,)*
            $($($(#[doc = $choice_help])+ pub $choice: $choice_ty,)*)?
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: <$ty as $crate::growth::table::TableValue>::from_number(f64::from($default)),)* $($($choice: $choice_default,)*)? }
            }
        }

        impl $name {
            /// What a panel or a help page shows for each number.
            pub fn describe() -> Vec<$crate::params::Description> {
                use $crate::growth::table::TableValue;
                let default = Self::default();
                vec![$($crate::params::Description {
                    path: stringify!($field).to_owned(),
                    help: concat!($($help),+).trim().to_owned(),
                    unit: $unit,
                    min: f64::from($min),
                    max: f64::from($max),
                    default: default.$field.as_number(),
                },)*]
            }
        }

        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(source: D) -> Result<Self, D::Error> {
                use $crate::growth::table::{Key, Ranged};
                const KEYS: &[&str] = &[$(stringify!($field),)* $($(stringify!($choice),)*)?];
                struct Table;
                impl<'de> serde::de::Visitor<'de> for Table {
                    type Value = $name;

                    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        f.write_str("a table")
                    }

                    fn visit_map<A: serde::de::MapAccess<'de>>(self, mut map: A) -> Result<$name, A::Error> {
                        let mut out = $name::default();
                        while let Some(key) = map.next_key_seed(Key(KEYS))? {
                            let key = KEYS[key];
                            $(if key == stringify!($field) {
                                let range = Ranged(f64::from($min), f64::from($max), std::marker::PhantomData::<$ty>);
                                out.$field = map.next_value_seed(range)?;
                                continue;
                            })*
                            $($(if key == stringify!($choice) {
                                out.$choice = map.next_value()?;
                                continue;
                            })*)?
                        }
                        Ok(out)
                    }
                }
                source.deserialize_map(Table)
            }
        }
    };
}
