//! The `params` of a drawing: groups of numbers, switches and names, nothing else, and not too many.
//!
//! What each parameter means and whether it exists is known to [`crate::params`], which lays them over the defaults.

use super::progress::Progress;
use crate::quote;
use crate::sketch::error::Fault;
use crate::sketch::limits;
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, Visitor};
use serde_json::{Map, Number, Value};
use std::cell::Cell;
use std::fmt;

/// Reads one group of parameters.
pub(super) struct GroupSeed<'p> {
    pub(super) progress: &'p Progress,
    /// Parameters and groups read so far, in all groups together.
    pub(super) count: &'p Cell<usize>,
    /// Groups around this one.
    pub(super) depth: usize,
}

impl<'de> DeserializeSeed<'de> for GroupSeed<'_> {
    type Value = Map<String, Value>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for GroupSeed<'_> {
    type Value = Map<String, Value>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object of parameters")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
        if self.depth > limits::MAX_PARAM_DEPTH {
            return Err(self.progress.refuse(Fault::TooDeep));
        }
        let mut group = Map::new();
        while let Some(name) = map.next_key::<String>()? {
            self.count.set(self.count.get() + 1);
            if self.count.get() > limits::MAX_PARAMS {
                return Err(self
                    .progress
                    .refuse(Fault::TooMany { what: "parameters", limit: limits::MAX_PARAMS }));
            }
            let value = map.next_value_seed(ValueSeed(&self))?;
            if group.contains_key(&name) {
                return Err(self
                    .progress
                    .malformed(format!("parameter `{}` is set twice; keep one", quote::name(&name))));
            }
            group.insert(name, value);
        }
        Ok(group)
    }
}

/// Reads what stands behind a parameter's name in a group.
struct ValueSeed<'g, 'p>(&'g GroupSeed<'p>);

impl<'de> DeserializeSeed<'de> for ValueSeed<'_, '_> {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Value, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for ValueSeed<'_, '_> {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, true or false, a name, or an object of further parameters")
    }

    fn visit_bool<E: Error>(self, on: bool) -> Result<Value, E> {
        Ok(Value::Bool(on))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Value, E> {
        Ok(Value::from(number))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Value, E> {
        Ok(Value::from(number))
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Value, E> {
        Number::from_f64(number).map(Value::Number).ok_or_else(|| E::custom("number out of range"))
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<Value, E> {
        Ok(Value::String(name.to_owned()))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Value, A::Error> {
        let Self(&GroupSeed { progress, count, depth }) = self;
        GroupSeed { progress, count, depth: depth + 1 }.visit_map(map).map(Value::Object)
    }
}
