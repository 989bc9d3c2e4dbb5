//! Parameters that are one of a few things, each by its name.

use super::Kind;
use super::value::{ParamValue, Range};
use crate::suggest::{did_you_mean, nearest};
use serde::de::Error;
use serde::{Deserialize, Deserializer};

/// One of a few things. As a number it is its place among them.
pub trait Choice: Copy + PartialEq + 'static {
    /// All of them.
    const ALL: &'static [Self];
    /// Their names, in the same order.
    const NAMES: &'static [&'static str];
}

impl<C: Choice> ParamValue for C {
    const KIND: Kind = Kind::Choice(C::NAMES);

    fn at_age(&self, _: f32) -> f64 {
        C::ALL.iter().position(|one| one == self).unwrap_or(0) as f64
    }

    fn from_number(number: f64) -> Self {
        C::ALL[(number as usize).min(C::ALL.len() - 1)]
    }

    fn read<'de, D: Deserializer<'de>>(source: D, range: &Range<Self>) -> Result<Self, D::Error> {
        let name = String::deserialize(source)?;
        let place = C::NAMES.iter().position(|known| *known == name);
        place
            .map(|place| C::ALL[place])
            .ok_or_else(|| D::Error::custom(range.named(&none_of(C::NAMES, &name))))
    }
}

/// That a name is none of these.
pub(super) fn none_of(names: &[&'static str], name: &str) -> String {
    let meant = nearest(name, names.iter().copied()).map(str::to_owned);
    format!("needs one of {}, not `{}`{}", names.join(", "), crate::quote::name(name), did_you_mean(&meant))
}

/// Declares an enum of which a parameter is one: `/// What it is` `Value = "name",`. Files and `--set` write the name.
#[macro_export]
macro_rules! parameter_choice {
    ($(#[$about:meta])* $vis:vis enum $name:ident { $($(#[doc = $help:literal])+ $value:ident = $word:literal,)+ }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
        $vis enum $name {
            $($(#[doc = $help])+ #[serde(rename = $word)] $value,)+
        }

        impl $crate::params::Choice for $name {
            const ALL: &'static [Self] = &[$(Self::$value),+];
            const NAMES: &'static [&'static str] = &[$($word),+];
        }
    };
}
