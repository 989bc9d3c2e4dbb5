//! Where keys stand in a species file: the lines of messages that only a second look at the file's contents gives.
//!
//! Keys are dotted paths without the places of lists: `flowers.petals.materials`. What a list holds has the list's key.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The values of a file in the order in which they are nested.
#[derive(Debug, Default)]
pub(super) struct Places {
    all: Vec<Found>,
}

#[derive(Debug)]
struct Found {
    key: String,
    /// What it says, where that is a text.
    text: Option<String>,
    line: usize,
}

impl Places {
    /// Of a text that is TOML; of any other there are none.
    pub(super) fn of(text: &str) -> Self {
        let mut all = Vec::new();
        if let Ok(table) = DeTable::parse(text) {
            below("", table.get_ref(), &mut |key, value| {
                let line = text.get(..value.span().start).unwrap_or_default().matches('\n').count() + 1;
                let text = value.get_ref().as_str().map(str::to_owned);
                all.push(Found { key: key.to_owned(), text, line });
            });
        }
        Self { all }
    }

    /// The line of a key, from 1, where it says `text` if one is given; that of the file's first line if it is nowhere.
    pub(super) fn line(&self, key: &str, text: Option<&str>) -> usize {
        let plain: Vec<&str> = key.split('.').map(|part| part.split('[').next().unwrap_or(part)).collect();
        let plain = plain.join(".");
        let is = |found: &&Found| {
            (found.key == plain || found.key == key) && (text.is_none() || found.text.as_deref() == text)
        };
        self.all.iter().find(is).map_or(1, |found| found.line)
    }

    /// The lines of all keys below a section, from which their own begin.
    pub(super) fn below(&self, section: &str) -> Vec<(String, usize)> {
        let of = |found: &Found| {
            Some((found.key.strip_prefix(section)?.strip_prefix('.')?.to_owned(), found.line))
        };
        self.all.iter().filter_map(of).collect()
    }
}

fn below(prefix: &str, table: &DeTable<'_>, found: &mut dyn FnMut(&str, &Spanned<DeValue<'_>>)) {
    for (key, value) in table.iter() {
        let key = crate::params::join(prefix, key.get_ref());
        visit(&key, value, found);
    }
}

fn visit(key: &str, value: &Spanned<DeValue<'_>>, found: &mut dyn FnMut(&str, &Spanned<DeValue<'_>>)) {
    found(key, value);
    match value.get_ref() {
        DeValue::Table(table) => below(key, table, found),
        DeValue::Array(array) => array.iter().for_each(|item| visit(key, item, found)),
        _ => {}
    }
}
