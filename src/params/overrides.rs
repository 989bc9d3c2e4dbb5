//! Values that files and the command line set, laid over the defaults one path at a time, each checked against its
//! description.

use super::choice::none_of;
use super::{Description, Kind, Parameters, join};
use crate::quote;
use crate::suggest::{did_you_mean, nearest};
use serde::{Serialize, de::DeserializeOwned};
use serde_json::{Map, Value};
use thiserror::Error;

/// A parameter that cannot be used.
#[derive(Debug, Error, PartialEq)]
pub enum ParamError {
    /// The path names no parameter.
    #[error("there is no parameter `{path}`{}", did_you_mean(.nearest))]
    Unknown {
        /// The path as it was given.
        path: String,
        /// The known path that looks most like it.
        nearest: Option<String>,
    },
    /// The value has the wrong type.
    #[error("parameter `{path}`: {reason}")]
    Type {
        /// Path of the parameter.
        path: String,
        /// What was expected.
        reason: String,
    },
    /// The value lies outside its range.
    #[error("parameter `{path}` is {value}, outside {min} to {max}")]
    Range {
        /// Path of the parameter.
        path: String,
        /// The refused value.
        value: f64,
        /// Smallest allowed value.
        min: f64,
        /// Largest allowed value.
        max: f64,
    },
}

impl ParamError {
    /// Path of the parameter, as it was given; shortened where it is too long to be one.
    pub fn path(&self) -> &str {
        match self {
            Self::Unknown { path, .. } | Self::Type { path, .. } | Self::Range { path, .. } => path,
        }
    }
}

/// A set of parameters with overrides laid over the defaults, one path at a time.
///
/// Later layers win: species file, then sketch file, then command line.
pub struct Overrides {
    known: Vec<Description>,
    values: Value,
}

impl Overrides {
    /// Starts from these defaults.
    pub fn over(defaults: &(impl Parameters + Serialize)) -> Self {
        let values = serde_json::to_value(defaults).unwrap_or_else(|_| Value::Object(Map::new()));
        Self { known: defaults.describe(), values }
    }

    /// Lays a tree of values (`{"anatomy": {"preprocess": {…}}}`) over what is there; dotted keys work at any depth.
    ///
    /// # Errors
    /// The first unknown path, wrong type or value out of range.
    pub fn merge(&mut self, tree: &Map<String, Value>) -> Result<(), ParamError> {
        self.merge_below("", tree, &[])
    }

    /// As [`Overrides::merge`], but what is known `elsewhere` alone may stay in the tree: it is checked and has no effect.
    ///
    /// # Errors
    /// The first path that is unknown everywhere, wrong type or value out of range.
    pub fn merge_what_applies(
        &mut self,
        tree: &Map<String, Value>,
        elsewhere: &[Description],
    ) -> Result<(), ParamError> {
        self.merge_below("", tree, elsewhere)
    }

    fn merge_below(
        &mut self,
        prefix: &str,
        tree: &Map<String, Value>,
        elsewhere: &[Description],
    ) -> Result<(), ParamError> {
        let is_known = |all: &[Description], path: &str| all.iter().any(|known| known.path == path);
        for (key, value) in tree {
            let path = join(prefix, key);
            match value {
                Value::Object(inner) => self.merge_below(&path, inner, elsewhere)?,
                leaf if !is_known(&self.known, &path) && is_known(elsewhere, &path) => {
                    checked(elsewhere, &path, leaf.clone())?;
                }
                leaf => self.set(&path, leaf.clone())?,
            }
        }
        Ok(())
    }

    /// Sets one parameter from `PATH=VALUE` as typed on a command line.
    ///
    /// # Errors
    /// A text without `=`, an unknown path, a wrong type or a value out of range.
    pub fn set_text(&mut self, assignment: &str) -> Result<(), ParamError> {
        let Some((path, text)) = assignment.split_once('=') else {
            let reason = "write it as PATH=VALUE".to_owned();
            return Err(ParamError::Type { path: quote::name(assignment), reason });
        };
        let value = serde_json::from_str(text.trim()).unwrap_or_else(|_| Value::String(text.to_owned()));
        self.set(path.trim(), value)
    }

    fn set(&mut self, path: &str, value: Value) -> Result<(), ParamError> {
        let value = checked(&self.known, path, value)?;
        let slot = path.split('.').try_fold(&mut self.values, |tree, key| tree.get_mut(key));
        let Some(slot) = slot else {
            return Err(ParamError::Unknown { path: quote::name(path), nearest: None });
        };
        *slot = value;
        Ok(())
    }

    /// The parameters with every override applied.
    ///
    /// # Errors
    /// A value that the struct cannot hold.
    pub fn finish<P: DeserializeOwned>(self) -> Result<P, ParamError> {
        serde_json::from_value(self.values)
            .map_err(|e| type_error("parameters", &quote::name(&e.to_string())))
    }
}

/// A value as the parameter of that path takes it.
fn checked(all: &[Description], path: &str, value: Value) -> Result<Value, ParamError> {
    let Some(known) = all.iter().find(|d| d.path == path) else {
        let known = all.iter().map(|d| d.path.as_str());
        let nearest = nearest(path, known).map(str::to_owned);
        return Err(ParamError::Unknown { path: quote::name(path), nearest });
    };
    if let Kind::Choice(names) = known.kind {
        let name = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        let is_known = known.kind.number(&value).is_some();
        return is_known.then_some(value).ok_or_else(|| type_error(path, &none_of(names, &name)));
    }
    let number = match &value {
        Value::Bool(on) => f64::from(u8::from(*on)),
        Value::Number(n) => n.as_f64().unwrap_or(f64::NAN),
        other => {
            let other = quote::name(&other.to_string());
            return Err(type_error(path, &format!("needs a number or true/false, not {other}")));
        }
    };
    if !(known.min..=known.max).contains(&number) {
        return Err(ParamError::Range {
            path: path.to_owned(),
            value: number,
            min: known.min,
            max: known.max,
        });
    }
    coerced(known.kind, value, number).map_err(|reason| type_error(path, reason))
}

/// Keeps the JSON type that the struct expects: switches stay switches, counts stay whole.
fn coerced(kind: Kind, value: Value, number: f64) -> Result<Value, &'static str> {
    match (kind, &value) {
        (Kind::Switch, Value::Bool(_)) => Ok(value),
        (Kind::Switch, _) => Err("needs true or false"),
        (_, Value::Bool(_)) => Err("needs a number"),
        (Kind::Whole, _) if number.fract() == 0.0 => Ok(Value::from(number as u64)),
        (Kind::Whole, _) => Err("needs a whole number"),
        (Kind::Number | Kind::Aged | Kind::Choice(_), _) => Ok(value),
    }
}

fn type_error(path: &str, reason: &str) -> ParamError {
    ParamError::Type { path: path.to_owned(), reason: reason.to_owned() }
}
