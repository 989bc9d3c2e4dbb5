//! The inflorescences that are part of the program, as grammars: `assets/inflorescences`.

use super::error::GrammarError;
use super::rules::Grammar;
use crate::quote;
use crate::suggest::nearest;
use include_dir::{Dir, include_dir};

static INFLORESCENCES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/assets/inflorescences");

/// Names of all built-in inflorescences, sorted.
pub fn names() -> Vec<&'static str> {
    let files = INFLORESCENCES.files();
    let mut names: Vec<_> = files.filter_map(|file| file.path().to_str()?.strip_suffix(".lsys")).collect();
    names.sort_unstable();
    names
}

/// The text of a built-in inflorescence.
///
/// # Errors
/// An unknown name, with the nearest known one and all others.
pub fn text(name: &str) -> Result<&'static str, GrammarError> {
    let plain = name.trim().to_lowercase().replace([' ', '-'], "_");
    let file = INFLORESCENCES.get_file(format!("{plain}.lsys"));
    file.and_then(|file| file.contents_utf8()).ok_or_else(|| {
        let nearest = nearest(&plain, names()).map(str::to_owned);
        GrammarError::UnknownInflorescence { name: quote::name(name), nearest, known: names().join(", ") }
    })
}

/// The grammar of a built-in inflorescence. Case, spaces and hyphens do not matter.
///
/// # Errors
/// An unknown name, with the nearest known one and all others.
pub fn inflorescence(name: &str) -> Result<Grammar, GrammarError> {
    Grammar::parse(text(name)?)
}
