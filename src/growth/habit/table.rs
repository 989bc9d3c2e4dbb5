//! Sections of a species file whose every key has a meaning, a unit, a range and a default, said once.
//!
//! [`growth_table!`](crate::growth_table!) declares the struct, its `Default`, its reading with the range of each value
//! checked in place, so that an error knows its line, and unknown keys refused with the nearest known one. Its numbers are
//! [`Parameters`](crate::params::Parameters) like any other.

use crate::params::ParamValue;
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, Visitor};
use std::fmt;

/// A value that a growth table can hold.
pub(crate) trait TableValue: ParamValue + Sized {
    /// Reads a value and checks its range.
    ///
    /// # Errors
    /// A value of another type or outside the range.
    fn read<'de, D: Deserializer<'de>>(source: D, min: f64, max: f64) -> Result<Self, D::Error>;

    /// The value that a number in the source stands for.
    fn from_number(number: f64) -> Self;
}

macro_rules! plain_values {
    ($($ty:ty),*) => { $(
        impl TableValue for $ty {
            fn read<'de, D: Deserializer<'de>>(source: D, min: f64, max: f64) -> Result<Self, D::Error> {
                let value = <$ty>::deserialize(source)?;
                // As what is read: 0.6 is the number above it in 32 bits.
                if (min as $ty..=max as $ty).contains(&value) {
                    return Ok(value);
                }
                Err(D::Error::custom(format!("{value} is outside {min} to {max}")))
            }

            fn from_number(number: f64) -> Self {
                number as $ty
            }
        }
    )* };
}
plain_values!(f32, u32);

impl TableValue for bool {
    fn read<'de, D: Deserializer<'de>>(source: D, _: f64, _: f64) -> Result<Self, D::Error> {
        Self::deserialize(source)
    }

    fn from_number(number: f64) -> Self {
        number > 0.5
    }
}

/// Reads a [`TableValue`] within its range.
pub(crate) struct Ranged<T>(pub f64, pub f64, pub std::marker::PhantomData<T>);

impl<'de, T: TableValue> DeserializeSeed<'de> for Ranged<T> {
    type Value = T;

    fn deserialize<D: Deserializer<'de>>(self, source: D) -> Result<T, D::Error> {
        T::read(source, self.0, self.1)
    }
}

/// Reads one of the known keys and gives its place in the list.
pub(crate) struct Key(pub &'static [&'static str]);

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
            let name = crate::quote::name(name);
            E::custom(format!("unknown key `{name}`{}", crate::suggest::did_you_mean(&nearest)))
        })
    }
}

/// Declares a section of a species file. Each value reads `/// help` `name: Type = default, min..=max, "unit";`, then
/// after `choices:` values that are read as they are and after `sections:` tables below this one, both
/// `name: Type = default;`.
#[macro_export]
macro_rules! growth_table {
    ($(#[doc = $about:literal])* $vis:vis struct $name:ident {
        $($(#[doc = $help:literal])+ $field:ident: $ty:ty = $default:expr, $min:literal ..= $max:literal, $unit:literal;)*
        $(choices: $($(#[doc = $choice_help:literal])+ $choice:ident: $choice_ty:ty = $choice_default:expr;)*)?
        $(sections: $($(#[doc = $section_help:literal])+ $section:ident: $section_ty:ty = $section_default:expr;)*)?
    }) => {
        $(#[doc = $about])*
        #[derive(Clone, Debug, PartialEq, serde::Serialize)]
        $vis struct $name {
            $($(#[doc = $help])+
              #[doc = concat!(" Default `", stringify!($default), "`, range `", stringify!($min), "..=", stringify!($max), "` ", $unit, ".")]
              pub $field: $ty,)*
            $($($(#[doc = $choice_help])+ pub $choice: $choice_ty,)*)?
            $($($(#[doc = $section_help])+ pub $section: $section_ty,)*)?
        }

        impl Default for $name {
            fn default() -> Self {
                Self {
                    $($field: <$ty as $crate::growth::habit::table::TableValue>::from_number(f64::from($default)),)*
                    $($($choice: $choice_default,)*)?
                    $($($section: $section_default,)*)?
                }
            }
        }

        impl $crate::params::Parameters for $name {
            fn describe_into(&self, prefix: &str, age: f32, out: &mut Vec<$crate::params::Description>) {
                $(out.push($crate::params::Description::of(
                    (prefix, stringify!($field)),
                    (concat!($($help),+), $unit),
                    (f64::from($min), f64::from($max)),
                    (&self.$field, age),
                ));)*
                $($(self.$section.describe_into(
                    &$crate::params::join(prefix, stringify!($section)), age, out);)*)?
            }
        }

        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(source: D) -> Result<Self, D::Error> {
                use $crate::growth::habit::table::{Key, Ranged};
                const KEYS: &[&str] = &[
                    $(stringify!($field),)* $($(stringify!($choice),)*)? $($(stringify!($section),)*)?
                ];
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
                            $($(if key == stringify!($section) {
                                out.$section = map.next_value()?;
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
