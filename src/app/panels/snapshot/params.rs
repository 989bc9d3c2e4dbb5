//! Values of parameters by path, as the panel of parameters shows them.

use crate::params::join;
use serde_json::{Map, Value};
use std::collections::BTreeMap;

/// Values of parameters by path, where they are not the program's defaults.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ParamValues {
    /// What the species says.
    pub species: BTreeMap<String, f64>,
    /// What the artist changed; switches are 0 or 1.
    pub own: BTreeMap<String, f64>,
}

impl ParamValues {
    /// Flattens the overrides of a species and of a drawing, as [`crate::pipeline::params_of`] lays them over the defaults.
    pub fn of(species: &Map<String, Value>, own: &Map<String, Value>) -> Self {
        let mut out = Self::default();
        flatten("", species, &mut out.species);
        flatten("", own, &mut out.own);
        out
    }
}

fn flatten(prefix: &str, tree: &Map<String, Value>, out: &mut BTreeMap<String, f64>) {
    for (key, value) in tree {
        let path = join(prefix, key);
        let number = match value {
            Value::Object(inner) => {
                flatten(&path, inner, out);
                None
            }
            Value::Bool(on) => Some(f64::from(u8::from(*on))),
            other => other.as_f64(),
        };
        if let Some(number) = number {
            out.insert(path, number);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overrides_are_flattened_in_any_spelling() {
        let species = serde_json::json!({"depth": {"world": {"height": 2.0}, "cone.flip": true}});
        let own = serde_json::json!({"depth.world": {"height": 3}});
        let values = ParamValues::of(species.as_object().unwrap(), own.as_object().unwrap());
        assert_eq!(
            values.species,
            [("depth.world.height".into(), 2.0), ("depth.cone.flip".into(), 1.0)].into()
        );
        assert_eq!(values.own, [("depth.world.height".into(), 3.0)].into());
    }
}
