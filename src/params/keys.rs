//! Keys of a table, read as their places in the list of known ones.

use crate::{quote, suggest};
use serde::de::{DeserializeSeed, Deserializer, Error, Visitor};
use std::fmt;

/// Reads one of the known keys and gives its place in the list; an unknown one is refused with the nearest known key, or
/// with all of them where none is near.
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
            let nearest = suggest::nearest(name, self.0.iter().copied()).map(str::to_owned);
            let remedy = match nearest {
                None if !self.0.is_empty() => format!("; known are {}", self.0.join(", ")),
                nearest => suggest::did_you_mean(&nearest),
            };
            E::custom(format!("unknown key `{}`{remedy}", quote::name(name)))
        })
    }
}
