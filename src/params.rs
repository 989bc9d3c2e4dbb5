//! Parameters: one struct beside each stage, described once and read by everybody.
//!
//! [`parameters!`](crate::parameters!) declares a struct of plain numbers together with what an artist needs to know of each field:
//! help text (the field's own doc comment), default, unit and range. Panels, the command line (`--set PATH=VALUE`),
//! species files and sketch files all go through the same description, so nothing is said twice.
//! [`parameter_groups!`](crate::parameter_groups!) nests such structs; a field's path is the field names joined by dots.
//!
//! What is described is a value: its fields are the defaults that are told, so that a species' own numbers are the
//! defaults of its plants. A number that a species lets change with age is told at one age, and set for all.
//!
//! Limits: a parameter is a number, an integer or a switch. Anything richer belongs in a species file.

use crate::quote;
use crate::suggest::{did_you_mean, nearest};
use serde::{Serialize, de::DeserializeOwned};
use serde_json::{Map, Value};
use thiserror::Error;

/// What kind of value a parameter has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A number.
    Number,
    /// A number that a species may let change with the plant's age; a number that is set for it holds at every age.
    Aged,
    /// A whole number.
    Whole,
    /// On or off.
    Switch,
}

/// What a panel or a help page shows for one parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// Dotted path, such as `anatomy.preprocess.spacing`.
    pub path: String,
    /// One line for the artist.
    pub help: String,
    /// What kind of value it has.
    pub kind: Kind,
    /// Unit of the value, empty for plain counts and factors.
    pub unit: &'static str,
    /// Smallest allowed value.
    pub min: f64,
    /// Largest allowed value.
    pub max: f64,
    /// Value when nothing is said; switches are 0 or 1.
    pub default: f64,
}

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

/// A struct whose fields are described parameters, or groups of them.
pub trait Parameters: Serialize + DeserializeOwned {
    /// Appends the description of every field below `prefix`, in declaration order, with its value at an age as default.
    fn describe_into(&self, prefix: &str, age: f32, out: &mut Vec<Description>);

    /// Every parameter of this struct, in declaration order, as it is at an age in years.
    fn describe_at(&self, age: f32) -> Vec<Description> {
        let mut out = Vec::new();
        self.describe_into("", age, &mut out);
        out
    }

    /// Every parameter of this struct, in declaration order, as it is at age 0.
    fn describe(&self) -> Vec<Description> {
        self.describe_at(0.0)
    }
}

/// A group that may be missing.
impl<P: Parameters> Parameters for Option<P> {
    fn describe_into(&self, prefix: &str, age: f32, out: &mut Vec<Description>) {
        if let Some(group) = self {
            group.describe_into(prefix, age, out);
        }
    }
}

/// A value that a parameter can hold; switches count as 0 and 1.
pub trait ParamValue {
    /// Its kind.
    const KIND: Kind;

    /// The value at an age as a number, for ranges and panels.
    fn at_age(&self, age: f32) -> f64;
}

macro_rules! plain_params {
    ($($ty:ty: $kind:ident),*) => { $(impl ParamValue for $ty {
        const KIND: Kind = Kind::$kind;

        fn at_age(&self, _: f32) -> f64 {
            *self as f64
        }
    })* };
}
plain_params!(f32: Number, u32: Whole, usize: Whole);

impl ParamValue for bool {
    const KIND: Kind = Kind::Switch;

    fn at_age(&self, _: f32) -> f64 {
        f64::from(*self)
    }
}

impl Description {
    /// The description of a field below `prefix`; `text` is its help and its unit.
    pub fn of<V: ParamValue>(
        (prefix, name): (&str, &str),
        text: (&str, &'static str),
        (min, max): (f64, f64),
        (value, age): (&V, f32),
    ) -> Self {
        let (help, unit) = (text.0.trim().to_owned(), text.1);
        Self { path: join(prefix, name), help, kind: V::KIND, unit, min, max, default: value.at_age(age) }
    }
}

/// Joins a group's prefix and a field name into a path.
pub fn join(prefix: &str, name: &str) -> String {
    if prefix.is_empty() { name.to_owned() } else { format!("{prefix}.{name}") }
}

/// Declares a struct of parameters. Each field reads
/// `/// help` `name: type = default, min..=max, "unit";`.
#[macro_export]
macro_rules! parameters {
    ($(#[doc = $about:literal])* $vis:vis struct $name:ident {
        $($(#[doc = $help:literal])+ $field:ident: $ty:ty = $default:expr, $min:literal ..= $max:literal, $unit:literal;)*
    }) => {
        $(#[doc = $about])*
        #[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
        #[serde(default, deny_unknown_fields)]
        $vis struct $name {
            $($(#[doc = $help])+
              #[doc = concat!(" Default `", stringify!($default), "`, range `", stringify!($min), "..=", stringify!($max), "` ", $unit, ".")]
              pub $field: $ty,)*
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $default,)* }
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
            }
        }
    };
}

/// Declares a struct whose fields are themselves parameter structs.
#[macro_export]
macro_rules! parameter_groups {
    ($(#[doc = $about:literal])* $vis:vis struct $name:ident {
        $($(#[doc = $help:literal])+ $field:ident: $ty:ty;)*
    }) => {
        $(#[doc = $about])*
        #[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
        #[serde(default, deny_unknown_fields)]
        $vis struct $name {
            $($(#[doc = $help])+ pub $field: $ty,)*
        }

        impl $crate::params::Parameters for $name {
            fn describe_into(&self, prefix: &str, age: f32, out: &mut Vec<$crate::params::Description>) {
                $($crate::params::Parameters::describe_into(
                    &self.$field, &$crate::params::join(prefix, stringify!($field)), age, out);)*
            }
        }
    };
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
    pub fn over(defaults: &impl Parameters) -> Self {
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
    pub fn finish<P: Parameters>(self) -> Result<P, ParamError> {
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
        (Kind::Number | Kind::Aged, _) => Ok(value),
    }
}

fn type_error(path: &str, reason: &str) -> ParamError {
    ParamError::Type { path: path.to_owned(), reason: reason.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    parameters! {
        /// Parameters of a stage that exists only here.
        struct Inner {
            /// How far.
            reach: f32 = 0.5, 0.0..=1.0, "of the diagonal";
            /// How many.
            count: u32 = 3, 1..=9, "";
            /// Whether at all.
            on: bool = true, 0..=1, "";
        }
    }
    parameter_groups! {
        /// A group.
        struct Outer {
            /// The inner stage.
            inner: Inner;
        }
    }

    #[test]
    fn descriptions_carry_path_help_and_range() {
        let all = Outer::default().describe();
        assert_eq!(all[0].path, "inner.reach");
        assert_eq!(all[0].help, "How far.");
        assert_eq!((all[1].min, all[1].max, all[1].default), (1.0, 9.0, 3.0));
    }

    #[test]
    fn overrides_reach_the_struct() {
        let mut o = Overrides::over(&Outer::default());
        o.set_text("inner.reach=0.25").unwrap();
        o.set_text("inner.on=false").unwrap();
        let outer: Outer = o.finish().unwrap();
        assert_eq!(outer, Outer { inner: Inner { reach: 0.25, count: 3, on: false } });
    }

    #[test]
    fn refusals_say_which_parameter_and_why() {
        let mut o = Overrides::over(&Outer::default());
        let message = |r: Result<(), ParamError>| r.unwrap_err().to_string();
        assert!(message(o.set_text("inner.reahc=1")).contains("did you mean `inner.reach`?"));
        assert!(message(o.set_text("inner.reach=2")).contains("outside 0 to 1"));
        assert!(message(o.set_text("inner.count=2.5")).contains("whole number"));
        assert!(message(o.set_text("inner.on=1")).contains("true or false"));
        assert!(message(o.set_text("inner.reach")).contains("PATH=VALUE"));
    }
}
