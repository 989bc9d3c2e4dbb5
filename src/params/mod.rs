//! Parameters: numbers that are described where they are declared, and read by everybody from that description.
//!
//! [`parameters!`](crate::parameters!) declares a struct together with what an artist needs to know of each number: help
//! text (the field's own doc comment), default, unit and range. The parameters of every stage, a species' way of growing
//! and its looks are declared so; panels, the command line (`--set PATH=VALUE`), species files and sketch files all go
//! through the same description. [`parameter_groups!`](crate::parameter_groups!) nests such structs; a field's path is the
//! field names joined by dots.
//!
//! A description is of a value: the defaults it shows are the value's own numbers, so that a species' numbers are the
//! defaults of its plants. A number that a species lets change with age is shown at one age, and set for all ages.
//!
//! | file | what |
//! | --- | --- |
//! | `declare` | the two macros |
//! | `value` | what a parameter can hold, read within its range |
//! | `choice` | parameters that are one of a few things, by name |
//! | `keys` | keys of a table, the nearest known one named where one is unknown |
//! | `overrides` | values set by path |
//!
//! Limits: a parameter is a number, an integer, a switch or one of a few names. Other names, colours and lists stand beside them
//! in a declaration and are neither described nor set by path.

pub mod choice;
mod declare;
pub mod keys;
mod overrides;
pub mod value;

pub use choice::Choice;
pub use overrides::{Overrides, ParamError};
pub use value::{ParamValue, Range};

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
    /// One of these names; as a number its place among them.
    Choice(&'static [&'static str]),
}

impl Kind {
    /// The first and the last place among so many names.
    pub fn places(names: &[&str]) -> (f64, f64) {
        (0.0, names.len().saturating_sub(1) as f64)
    }

    /// A value as files and `--set` write it; numbers in 32 bits, as they are described.
    pub fn written(self, value: f64) -> String {
        match self {
            Self::Number | Self::Aged => (value as f32).to_string(),
            Self::Whole => format!("{value:.0}"),
            Self::Switch => (value > 0.5).to_string(),
            Self::Choice(names) => names.get(value.round() as usize).copied().unwrap_or_default().to_owned(),
        }
    }

    /// What a value that a file or `--set` gives is as a number, whatever its range; none for one of another kind.
    pub fn number(self, value: &serde_json::Value) -> Option<f64> {
        match (self, value) {
            (Self::Choice(names), value) => {
                names.iter().position(|name| value.as_str() == Some(name)).map(|place| place as f64)
            }
            (_, serde_json::Value::Bool(on)) => Some(f64::from(u8::from(*on))),
            (_, value) => value.as_f64(),
        }
    }
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
    /// Value when nothing is said; switches are 0 or 1, names their places.
    pub default: f64,
}

/// A struct whose fields are described parameters, or groups of them.
pub trait Parameters {
    /// Smallest and largest allowed value of each of its own numbers, in declaration order.
    const RANGES: &'static [(f64, f64)] = &[];

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

#[cfg(test)]
mod tests {
    use super::*;

    crate::parameters! {
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
    crate::parameter_groups! {
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

    crate::parameters! {
        /// A table with keys that must be given.
        struct Look {
            /// How wide.
            width: f32, 0.0..=1.0, "";
            /// How many.
            count: u32 = 3, 1..=9, "";
            choices:
            /// How it stands.
            pose: Pose = Pose::Upright;
            others:
            /// Its name.
            name: String;
            /// Words about it.
            words: Vec<String> = Vec::new();
            /// In small letters.
            small: String = String::new(), lowercase;
        }
    }

    crate::parameter_choice! {
        /// A pose.
        enum Pose {
            /// It stands.
            Upright = "upright",
            /// It lies.
            Lying = "lying",
        }
    }

    #[test]
    fn one_of_a_few_is_described_and_set_by_name() {
        let look: Look = toml::from_str("width = 0.5\nname = \"leaf\"").unwrap();
        let described = look.describe();
        let pose = described.iter().find(|d| d.path == "pose").unwrap();
        assert_eq!((pose.kind, pose.max, pose.default), (Kind::Choice(&["upright", "lying"]), 1.0, 0.0));
        assert_eq!(
            (pose.kind.written(1.0), pose.kind.number(&"lying".into())),
            ("lying".to_owned(), Some(1.0))
        );
        let mut o = Overrides::over(&look);
        o.set_text("pose=lying").unwrap();
        assert_eq!(o.finish::<Look>().unwrap().pose, Pose::Lying);
        let refused = |text: &str| Overrides::over(&look).set_text(text).unwrap_err().to_string();
        let strange = refused("pose=lyin");
        assert!(
            strange.contains("`pose`: needs one of upright, lying, not `lyin`; did you mean `lying`?"),
            "{strange}"
        );
        assert!(refused("pose=1").contains("needs one of upright, lying, not `1`"));
        assert!(refused("width=lying").contains("needs a number"));
        let fault =
            toml::from_str::<Look>("width = 1\nname = \"a\"\npose = \"flat\"").unwrap_err().to_string();
        assert!(
            fault.contains("`pose`: needs one of upright, lying, not `flat`") && fault.contains("line 3"),
            "{fault}"
        );
    }

    fn lowercase<'de, D: serde::Deserializer<'de>>(source: D) -> Result<String, D::Error> {
        <String as serde::Deserialize>::deserialize(source).map(|text| text.to_lowercase())
    }

    #[test]
    fn tables_are_read_with_what_is_left_out() {
        let look: Look =
            toml::from_str("width = 0.5\nname = \"leaf\"\nsmall = \"LEAF\"\npose = \"lying\"").unwrap();
        let (name, small) = ("leaf".to_owned(), "leaf".to_owned());
        let expected = Look { width: 0.5, count: 3, pose: Pose::Lying, name, words: Vec::new(), small };
        assert_eq!(look, expected);
        assert_eq!(Look::RANGES, [(0.0, 1.0), (1.0, 9.0)]);
    }

    #[test]
    fn reading_says_key_value_range_and_line() {
        let fault = |text: &str| toml::from_str::<Look>(text).unwrap_err().to_string();
        let wide = fault("name = \"leaf\"\nwidth = 1.5");
        assert!(wide.contains("`width`: 1.5 is outside 0 to 1") && wide.contains("line 2"), "{wide}");
        assert!(fault("width = nan\nname = \"leaf\"").contains("`width`: NaN is outside 0 to 1"));
        assert!(fault("name = \"leaf\"").contains("missing field `width`"));
        assert!(fault("width = 1\nnmae = \"leaf\"").contains("unknown key `nmae`; did you mean `name`?"));
        let strange = fault("helicopter = 1");
        assert!(strange.contains("known are width, count, pose, name, words, small"), "{strange}");
        let inner = |json: &str| serde_json::from_str::<Inner>(json).unwrap_err().to_string();
        assert!(inner("{\n\"reach\": 2.0}").contains("`reach`: 2 is outside 0 to 1 at line 2"));
        assert!(inner("{\"count\": 10}").contains("`count`: 10 is outside 1 to 9"));
    }
}
