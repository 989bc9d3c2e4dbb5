//! All text of the interface, in English and Simplified Chinese.
//!
//! Texts live in `assets/messages/*.toml`, one flat list per language. Code asks by [`Msg`], never by text, so a message
//! without a name does not compile, and the tests hold the files to the same keys and the same `{placeholders}`. Names
//! of species, parts, units and parameters are looked up by their own name; the English help of parameters is the doc
//! comment in the code, only translations of it are in the files.
//!
//! A text with a number may have two forms, `{ one = "{count} flower", other = "{count} flowers" }`: `one` where the value
//! of `{count}` is 1. Languages without plural forms, such as Chinese, write one text.
//!
//! Limits: what is wrong inside a damaged file or with a driver is said in English.

mod faults;
mod keys;
mod photos;
mod remarks;

pub use faults::Localize;
pub use keys::Msg;

use crate::params::Description;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use toml::{Table, Value};

/// A language of the interface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Language {
    /// English.
    #[default]
    #[serde(rename = "en")]
    English,
    /// Simplified Chinese.
    #[serde(rename = "zh-CN")]
    Chinese,
}

impl Language {
    /// Every language, in the order in which menus list them.
    pub const ALL: [Language; 2] = [Language::English, Language::Chinese];

    /// The language for a locale such as `zh_CN.UTF-8` or `en-GB`; English where there is no better one.
    pub fn from_locale(locale: &str) -> Self {
        let tag = locale.to_lowercase();
        if tag.split(['-', '_', '.']).next() == Some("zh") { Self::Chinese } else { Self::English }
    }

    /// The language of the system.
    pub fn of_system() -> Self {
        sys_locale::get_locale().map_or(Self::English, |locale| Self::from_locale(&locale))
    }

    /// The language's own name; its letters may need a font that the interface has not loaded.
    pub fn own_name(self) -> &'static str {
        match self {
            Self::English => "English",
            Self::Chinese => "简体中文",
        }
    }

    /// The name in Latin letters, for a system without a font for [`Language::own_name`].
    pub fn latin_name(self) -> &'static str {
        match self {
            Self::English => "English",
            Self::Chinese => "Chinese (Zhongwen)",
        }
    }

    fn file(self) -> &'static str {
        match self {
            Self::English => include_str!("../../assets/messages/en.toml"),
            Self::Chinese => include_str!("../../assets/messages/zh-CN.toml"),
        }
    }
}

/// Kinds of things that have a name in every language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Named {
    /// A built-in species.
    Species,
    /// A kind of part.
    Organ,
    /// The unit of a parameter.
    Unit,
    /// A group of parameters.
    Group,
    /// What strokes are read as.
    Reading,
    /// A value of a parameter that is one of a few things, behind the last part of its path.
    Choice,
}

impl Named {
    fn section(self) -> &'static str {
        match self {
            Self::Species => "species",
            Self::Organ => "organ",
            Self::Unit => "unit",
            Self::Group => "group",
            Self::Reading => "reading",
            Self::Choice => "choice",
        }
    }
}

/// A text, with a form of its own for the number 1 where the language has one.
#[derive(Clone, Debug)]
struct Text {
    one: Option<String>,
    other: String,
}

impl Text {
    fn of(value: &Value) -> Option<Self> {
        let form = |key: &str| value.get(key).and_then(Value::as_str).map(str::to_owned);
        match value {
            Value::String(text) => Some(Self { one: None, other: text.clone() }),
            _ => Some(Self { one: form("one"), other: form("other")? }),
        }
    }
}

/// What a language says of a parameter; empty where it says nothing.
#[derive(Clone, Debug)]
struct ParamText {
    name: String,
    help: String,
    /// What every value below zero means, where that is no number to the artist.
    below_zero: String,
}

/// The texts of one language.
#[derive(Clone, Debug)]
pub struct Messages {
    language: Language,
    texts: Vec<Text>,
    names: BTreeMap<String, String>,
    params: BTreeMap<String, ParamText>,
}

impl Messages {
    /// The texts of a language.
    pub fn new(language: Language) -> Self {
        let table: Table = language.file().parse().unwrap_or_default();
        let text = |msg: &Msg| {
            let found = msg.name().split_once('.').and_then(|(section, key)| table.get(section)?.get(key));
            let unknown = || Text { one: None, other: msg.name().to_owned() };
            found.and_then(Text::of).unwrap_or_else(unknown)
        };
        let mut names = BTreeMap::new();
        for (section, entries) in table_at(&table, "name") {
            for (name, value) in entries.as_table().into_iter().flatten() {
                names.insert(format!("{section}/{name}"), value.as_str().unwrap_or_default().to_owned());
            }
        }
        let param = |(path, entry): (&String, &Value)| {
            let field = |key: &str| entry.get(key).and_then(Value::as_str).unwrap_or_default().to_owned();
            (
                path.clone(),
                ParamText { name: field("name"), help: field("help"), below_zero: field("below_zero") },
            )
        };
        let params = table_at(&table, "param").map(param).collect();
        Self { language, texts: Msg::ALL.iter().map(text).collect(), names, params }
    }

    /// The language of these texts.
    pub fn language(&self) -> Language {
        self.language
    }

    /// One text.
    pub fn get(&self, msg: Msg) -> &str {
        self.texts.get(msg as usize).map_or(msg.name(), |text| &text.other)
    }

    /// One text with its `{placeholders}` filled, in the form that the value of `count` asks for.
    pub fn fill(&self, msg: Msg, values: &[(&str, &dyn std::fmt::Display)]) -> String {
        let is_one = values.iter().any(|(name, value)| *name == "count" && value.to_string() == "1");
        let one = self.texts.get(msg as usize).and_then(|text| text.one.as_ref()).filter(|_| is_one);
        let mut text = one.map_or_else(|| self.get(msg), String::as_str).to_owned();
        for (name, value) in values {
            text = text.replace(&format!("{{{name}}}"), &value.to_string());
        }
        text
    }

    /// What a thing is called; its own name with spaces where the files do not know it.
    pub fn name(&self, kind: Named, name: &str) -> String {
        let known = self.names.get(&format!("{}/{name}", kind.section()));
        known.cloned().unwrap_or_else(|| spoken(name))
    }

    /// What one of the things is called that a parameter may be.
    pub fn choice(&self, path: &str, name: &str) -> String {
        let last = path.rsplit('.').next().unwrap_or(path);
        let known = self.names.get(&format!("{}/{last}.{name}", Named::Choice.section()));
        known.cloned().unwrap_or_else(|| spoken(name))
    }

    /// A short name of a parameter.
    pub fn param_name(&self, path: &str) -> String {
        let known = self.params.get(path).map(|text| &text.name).filter(|name| !name.is_empty());
        known.cloned().unwrap_or_else(|| spoken(path.rsplit('.').next().unwrap_or(path)))
    }

    /// One line about a parameter.
    pub fn param_help(&self, of: &Description) -> String {
        let known = self.params.get(&of.path).map(|text| &text.help).filter(|help| !help.is_empty());
        known.unwrap_or(&of.help).clone()
    }

    /// What values of a parameter below zero mean, where that is no number to the artist.
    pub fn below_zero(&self, path: &str) -> Option<&str> {
        let known = self.params.get(path).map(|text| text.below_zero.as_str());
        known.filter(|words| !words.is_empty())
    }
}

fn table_at<'a>(table: &'a Table, key: &str) -> impl Iterator<Item = (&'a String, &'a Value)> {
    table.get(key).and_then(Value::as_table).into_iter().flatten()
}

/// `leaf_twigs` as people say it: `Leaf twigs`.
fn spoken(name: &str) -> String {
    let mut letters = name.replace('_', " ").chars().collect::<Vec<_>>();
    if let Some(first) = letters.first_mut() {
        *first = first.to_ascii_uppercase();
    }
    letters.into_iter().collect()
}

#[cfg(test)]
#[path = "messages/tests.rs"]
mod tests;
