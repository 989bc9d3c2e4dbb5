//! The declaration of parameter structs.

/// Declares a struct of parameters, its `Default`, its description and its reading, which checks the range of each value
/// in place, so that an error knows its line, and refuses unknown keys with the nearest known one.
///
/// A number reads `/// help` `name: type = default, min..=max, "unit";`. After `choices:` follow those that are one of a few
/// things, `name: type = default;`, their types declared by [`parameter_choice!`](crate::parameter_choice!). After `others:`
/// follow values that are neither described nor set by path, `name: type = default;` or `name: type = default, reader;` with a
/// function that deserializes them; after `sections:` follow tables below this one, `name: type = default;`. A default may be left out everywhere but then the key is
/// required, and the struct has no `Default`.
#[macro_export]
macro_rules! parameters {
    // Everything has a default, so the whole has one.
    ($(#[$about:meta])* $vis:vis struct $name:ident {
        $($(#[doc = $help:literal])+ $field:ident: $ty:ty = $default:expr, $min:literal ..= $max:literal, $unit:literal;)*
        $(choices: $($(#[doc = $choice_help:literal])+ $choice:ident: $choice_ty:ty = $choice_default:expr;)*)?
        $(others: $($(#[doc = $other_help:literal])+ $other:ident: $other_ty:ty = $other_default:expr $(, $reader:path)?;)*)?
        $(sections: $($(#[doc = $section_help:literal])+ $section:ident: $section_ty:ty = $section_default:expr;)*)?
    }) => {
        $crate::parameters! { @struct $(#[$about])* $vis struct $name {
            $($(#[doc = $help])+ $field: $ty = $default, $min ..= $max, $unit;)*
            $(choices: $($(#[doc = $choice_help])+ $choice: $choice_ty = $choice_default;)*)?
            $(others: $($(#[doc = $other_help])+ $other: $other_ty = $other_default $(, $reader)?;)*)?
            $(sections: $($(#[doc = $section_help])+ $section: $section_ty = $section_default;)*)?
        } }

        impl Default for $name {
            fn default() -> Self {
                Self {
                    $($field: $crate::parameters!(@default $ty, $default),)*
                    $($($choice: $choice_default,)*)?
                    $($($other: $other_default,)*)?
                    $($($section: $section_default,)*)?
                }
            }
        }
    };
    (@default $ty:ty, $default:expr) => {
        <$ty as $crate::params::ParamValue>::from_number(f64::from($default))
    };
    (@required $key:ident) => {
        return Err(serde::de::Error::missing_field(stringify!($key)))
    };
    (@number_default $key:ident, $ty:ty) => { $crate::parameters!(@required $key) };
    (@number_default $key:ident, $ty:ty, $default:expr) => { $crate::parameters!(@default $ty, $default) };
    (@other_default $key:ident) => { $crate::parameters!(@required $key) };
    (@other_default $key:ident, $default:expr) => { $default };
    (@doc_default) => { "" };
    (@doc_default $default:expr) => { concat!(" Default `", stringify!($default), "`.") };
    (@next $map:ident, $ty:ty) => { $map.next_value()? };
    (@next $map:ident, $ty:ty, $reader:path) => {{
        struct Read;
        impl<'de> serde::de::DeserializeSeed<'de> for Read {
            type Value = $ty;

            fn deserialize<D: serde::Deserializer<'de>>(self, source: D) -> Result<$ty, D::Error> {
                $reader(source)
            }
        }
        $map.next_value_seed(Read)?
    }};
    (@struct $(#[$about:meta])* $vis:vis struct $name:ident {
        $($(#[doc = $help:literal])+ $field:ident: $ty:ty $(= $default:expr)?, $min:literal ..= $max:literal, $unit:literal;)*
        $(choices: $($(#[doc = $choice_help:literal])+ $choice:ident: $choice_ty:ty $(= $choice_default:expr)?;)*)?
        $(others: $($(#[doc = $other_help:literal])+ $other:ident: $other_ty:ty $(= $other_default:expr)? $(, $reader:path)?;)*)?
        $(sections: $($(#[doc = $section_help:literal])+ $section:ident: $section_ty:ty $(= $section_default:expr)?;)*)?
    }) => {
        $(#[$about])*
        #[derive(Clone, Debug, PartialEq, serde::Serialize)]
        $vis struct $name {
            $($(#[doc = $help])+
              #[doc = concat!($crate::parameters!(@doc_default $($default)?), " Range `", stringify!($min), "..=", stringify!($max), "` ", $unit, ".")]
              pub $field: $ty,)*
            $($($(#[doc = $choice_help])+ pub $choice: $choice_ty,)*)?
            $($($(#[doc = $other_help])+ pub $other: $other_ty,)*)?
            $($($(#[doc = $section_help])+ pub $section: $section_ty,)*)?
        }

        impl $crate::params::Parameters for $name {
            const RANGES: &'static [(f64, f64)] = &[$(($min as f64, $max as f64)),*];

            fn describe_into(&self, prefix: &str, age: f32, out: &mut Vec<$crate::params::Description>) {
                $(out.push($crate::params::Description::of(
                    (prefix, stringify!($field)),
                    (concat!($($help),+), $unit),
                    (f64::from($min), f64::from($max)),
                    (&self.$field, age),
                ));)*
                $($(out.push($crate::params::Description::of(
                    (prefix, stringify!($choice)),
                    (concat!($($choice_help),+), ""),
                    $crate::params::Kind::places(<$choice_ty as $crate::params::Choice>::NAMES),
                    (&self.$choice, age),
                ));)*)?
                $($($crate::params::Parameters::describe_into(
                    &self.$section, &$crate::params::join(prefix, stringify!($section)), age, out);)*)?
            }
        }

        impl<'de> serde::Deserialize<'de> for $name {
            fn deserialize<D: serde::Deserializer<'de>>(source: D) -> Result<Self, D::Error> {
                use $crate::params::keys::Key;
                const KEYS: &[&str] = &[
                    $(stringify!($field),)* $($(stringify!($choice),)*)? $($(stringify!($other),)*)?
                    $($(stringify!($section),)*)?
                ];
                struct Table;
                impl<'de> serde::de::Visitor<'de> for Table {
                    type Value = $name;

                    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                        f.write_str("a table")
                    }

                    fn visit_map<A: serde::de::MapAccess<'de>>(self, mut map: A) -> Result<$name, A::Error> {
                        $(let mut $field: Option<$ty> = None;)*
                        $($(let mut $choice: Option<$choice_ty> = None;)*)?
                        $($(let mut $other: Option<$other_ty> = None;)*)?
                        $($(let mut $section: Option<$section_ty> = None;)*)?
                        while let Some(key) = map.next_key_seed(Key(KEYS))? {
                            let key = KEYS[key];
                            $(if key == stringify!($field) {
                                let range = $crate::params::Range::<$ty>::new(key, f64::from($min), f64::from($max));
                                $field = Some(map.next_value_seed(range)?);
                                continue;
                            })*
                            $($(if key == stringify!($choice) {
                                let (min, max) = $crate::params::Kind::places(<$choice_ty as $crate::params::Choice>::NAMES);
                                $choice = Some(map.next_value_seed($crate::params::Range::<$choice_ty>::new(key, min, max))?);
                                continue;
                            })*)?
                            $($(if key == stringify!($other) {
                                $other = Some($crate::parameters!(@next map, $other_ty $(, $reader)?));
                                continue;
                            })*)?
                            $($(if key == stringify!($section) {
                                $section = Some(map.next_value()?);
                                continue;
                            })*)?
                        }
                        Ok($name {
                            $($field: match $field {
                                Some(value) => value,
                                None => $crate::parameters!(@number_default $field, $ty $(, $default)?),
                            },)*
                            $($($choice: match $choice {
                                Some(value) => value,
                                None => $crate::parameters!(@other_default $choice $(, $choice_default)?),
                            },)*)?
                            $($($other: match $other {
                                Some(value) => value,
                                None => $crate::parameters!(@other_default $other $(, $other_default)?),
                            },)*)?
                            $($($section: match $section {
                                Some(value) => value,
                                None => $crate::parameters!(@other_default $section $(, $section_default)?),
                            },)*)?
                        })
                    }
                }
                source.deserialize_map(Table)
            }
        }
    };
    // Some keys are required.
    ($(#[$about:meta])* $vis:vis struct $name:ident { $($body:tt)* }) => {
        $crate::parameters! { @struct $(#[$about])* $vis struct $name { $($body)* } }
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
