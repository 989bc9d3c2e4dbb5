//! The inflorescence of a species: a grammar, one of the library by its kind or one of the species' own, and its numbers.
//!
//! In a species file the section `[inflorescence]` has `kind = "raceme"` or `grammar = """…"""`, and beside it any of the
//! grammar's constants. They are the parameters `flower.inflorescence.…`, with the ranges and helps that the grammar gives
//! them.
//!
//! What the grammar's organs become: `flower(open, size)` a flower of the first look that is not for drawn flowers, or else of
//! the first of all, `ray(open, size)` one of the second; `leaf(size)` and `bract(size)` leaves, `receptacle(radius, height)` a disc, `fruit(radius)` a fruit. Others are
//! refused where the grammar places them.

use crate::grammar::{Figure, Grammar, GrammarError, Settings, library};
use crate::params::{Description, Kind, Parameters, join};
use crate::suggest::{did_you_mean, nearest};
use serde::de::{self, MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

/// Organs that a grammar may place, each with the number of its arguments.
const ORGANS: [(&str, usize); 8] = [
    ("flower", 2),
    ("ray", 2),
    ("leaf", 1),
    ("bract", 1),
    ("receptacle", 2),
    ("fruit", 1),
    ("@ball", 1),
    ("@cylinder", 2),
];
/// The constant that says how far an inflorescence has come into flower.
const BLOOM: &str = "bloom";

/// A grammar with the values of its constants.
#[derive(Clone, Debug, PartialEq)]
pub struct Inflorescence {
    source: Source,
    grammar: Arc<Grammar>,
    /// Of all constants that may be set.
    values: BTreeMap<String, f64>,
}

/// Where the grammar comes from.
#[derive(Clone, Debug, PartialEq)]
enum Source {
    /// The library, by this name.
    Kind(String),
    /// This text.
    Text(String),
}

impl Inflorescence {
    /// The grammar of that kind in the library, with its own numbers.
    ///
    /// # Errors
    /// A kind that the library does not have.
    pub fn of_kind(kind: &str) -> Result<Self, String> {
        Self::new(Source::Kind(kind.to_owned()))
    }

    fn new(source: Source) -> Result<Self, String> {
        let grammar = match &source {
            Source::Kind(kind) => library::inflorescence(kind),
            Source::Text(text) => Grammar::parse(text),
        };
        let grammar = grammar.map_err(|error| error.to_string())?;
        if let Some(other) = grammar.organs().iter().find(|organ| !is_known(&organ.name, organ.arguments)) {
            return Err(unknown_organ(other));
        }
        let values = settable(&grammar).map(|constant| (constant.name.clone(), constant.value)).collect();
        Ok(Self { source, grammar: Arc::new(grammar), values })
    }

    /// What it draws when it has come into flower as far as `open` of what its numbers say.
    ///
    /// # Errors
    /// What its rules cannot do with these numbers, with the place in the grammar.
    pub fn draw(&self, seed: u64, open: f32) -> Result<Figure, GrammarError> {
        let value = |(name, value): (&String, &f64)| {
            (name.clone(), if name == BLOOM { value * f64::from(open) } else { *value })
        };
        let values: Vec<(String, f64)> = self.values.iter().map(value).collect();
        let constants: Vec<(&str, f64)> =
            values.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        self.grammar.draw(&Settings { seed, constants: &constants, ..Settings::default() })
    }

    /// Sets a constant that the grammar has, within its range.
    fn set(&mut self, name: &str, value: f64) -> Result<(), String> {
        let Some(constant) = settable(&self.grammar).find(|constant| constant.name == name) else {
            let nearest = nearest(name, settable(&self.grammar).map(|constant| constant.name.as_str()));
            let known: Vec<&str> = settable(&self.grammar).map(|constant| constant.name.as_str()).collect();
            let nearest = did_you_mean(&nearest.map(str::to_owned));
            return Err(format!("unknown key `{name}`{nearest}; the grammar has {}", known.join(", ")));
        };
        let (min, max) = constant.range.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        if !(min..=max).contains(&value) {
            return Err(format!("`{name}`: {value} is outside {min} to {max}"));
        }
        self.values.insert(name.to_owned(), value);
        Ok(())
    }
}

/// The constants that have a range: those that are meant to be set.
fn settable(grammar: &Grammar) -> impl Iterator<Item = &crate::grammar::Constant> {
    grammar.constants().iter().filter(|constant| constant.range.is_some())
}

fn is_known(name: &str, arguments: usize) -> bool {
    ORGANS.contains(&(name, arguments))
}

fn unknown_organ(organ: &crate::grammar::OrganUse) -> String {
    let known = |(name, arguments): &(&str, usize)| format!("{name} ({arguments})");
    let known: Vec<String> = ORGANS.iter().map(known).collect();
    let nearest = nearest(&organ.name, ORGANS.iter().map(|organ| organ.0)).map(str::to_owned);
    format!(
        "line {}, column {}: no organ is called `{}` with {} arguments{}; organs and the number of their arguments are {}",
        organ.place.line,
        organ.place.column,
        organ.name,
        organ.arguments,
        did_you_mean(&nearest),
        known.join(", ")
    )
}

impl Parameters for Inflorescence {
    fn describe_into(&self, prefix: &str, _age: f32, out: &mut Vec<Description>) {
        for constant in settable(&self.grammar) {
            let (min, max) = constant.range.unwrap_or((0.0, 0.0));
            let kind = if constant.is_whole { Kind::Whole } else { Kind::Number };
            let default = self.values.get(&constant.name).copied().unwrap_or(constant.value);
            let (path, help) = (join(prefix, &constant.name), constant.help.clone());
            out.push(Description { path, help, kind, unit: "", min, max, default });
        }
    }
}

impl Serialize for Inflorescence {
    fn serialize<S: Serializer>(&self, target: S) -> Result<S::Ok, S::Error> {
        let mut map = target.serialize_map(None)?;
        match &self.source {
            Source::Kind(kind) => map.serialize_entry("kind", kind)?,
            Source::Text(text) => map.serialize_entry("grammar", text)?,
        }
        self.values.iter().try_for_each(|(name, value)| map.serialize_entry(name, value))?;
        map.end()
    }
}

impl<'de> Deserialize<'de> for Inflorescence {
    fn deserialize<D: Deserializer<'de>>(source: D) -> Result<Self, D::Error> {
        struct Table;
        impl<'de> Visitor<'de> for Table {
            type Value = Inflorescence;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a table with `kind` or `grammar`, and numbers of that grammar")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Inflorescence, A::Error> {
                let (mut source, mut numbers) = (None, Vec::new());
                while let Some(key) = map.next_key::<String>()? {
                    match key.as_str() {
                        "kind" => source = Some(Source::Kind(map.next_value()?)),
                        "grammar" => source = Some(Source::Text(map.next_value()?)),
                        _ => numbers.push((key, map.next_value::<f64>()?)),
                    }
                }
                let source = source.ok_or_else(|| de::Error::missing_field("kind"))?;
                let mut made = Inflorescence::new(source).map_err(de::Error::custom)?;
                for (name, value) in numbers {
                    made.set(&name, value).map_err(de::Error::custom)?;
                }
                Ok(made)
            }
        }
        source.deserialize_map(Table)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(text: &str) -> String {
        toml::from_str::<Inflorescence>(text).unwrap_err().to_string()
    }

    #[test]
    fn numbers_of_a_kind_are_read_described_and_written() {
        let raceme: Inflorescence = toml::from_str("kind = \"raceme\"\nn = 12\nrachis = 0.2").unwrap();
        let described = raceme.describe();
        let n = described.iter().find(|described| described.path == "n").unwrap();
        assert_eq!((n.default, n.kind, n.min), (12.0, Kind::Whole, 1.0));
        assert!(!n.help.is_empty());
        let written = serde_json::to_string(&raceme).unwrap();
        assert_eq!(serde_json::from_str::<Inflorescence>(&written).unwrap(), raceme);
    }

    #[test]
    fn it_opens_as_far_as_asked_for() {
        let raceme = Inflorescence::of_kind("raceme").unwrap();
        let opened = |open: f32| {
            let figure = raceme.draw(1, open).unwrap();
            let flowers = figure.items.iter().filter(|item| &*item.name == "flower");
            flowers.filter(|item| item.args[0] > 0.5).count()
        };
        assert!(opened(0.0) == 0 && opened(1.0) > opened(0.4));
    }

    #[test]
    fn what_cannot_be_is_refused_with_the_remedy() {
        assert!(fault("n = 3").contains("missing field `kind`"));
        assert!(fault("kind = \"racem\"").contains("did you mean `raceme`?"));
        assert!(fault("kind = \"raceme\"\nrachsi = 1").contains("did you mean `rachis`?"));
        assert!(fault("kind = \"raceme\"\nn = 1000000").contains("outside"));
        assert!(fault("grammar = \"axiom: *flwoer(1, 1)\"").contains("did you mean `flower`?"));
        assert!(fault("grammar = \"axiom: F(1\"").contains("line 1"));
    }
}
