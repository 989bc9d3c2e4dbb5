//! Identifiers are the field's standard terms: words that only the authors understood stay out.
//!
//! A word is a part of an identifier between underscores or capitals. Looked at are names that a file gives: functions,
//! types, modules, constants, fields, variants, variables and parameters. Strings and comments are left out, as are names
//! that only come from elsewhere. [`ALLOWED`] lists modules in which a word means what it says: shapes of hearts.
//!
//! Limits: of names that a pattern binds in brackets only those that follow `mut` are seen.

use crate::source::words;
use crate::{root, rust_files};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;

/// Words that are not to be used, and what to use instead.
const BANNED: &[(&str, &str)] = &[
    ("coat", "submesh: triangles of a part that share a material slot"),
    ("coats", "submeshes"),
    ("wears", "uses, for a material"),
    ("worn", "used, for a material"),
    ("told", "reported, logged, message"),
    ("untold", "ambiguous, unknown"),
    ("tell", "report, notify, log, send"),
    ("tells", "reports, identifies, describes"),
    ("telling", "reporting, identifying"),
    ("hear", "receive, handle, read"),
    ("hears", "receiver, receives"),
    ("heard", "received, handled, passed"),
    ("standing", "placed, allowed, upright"),
    ("heart", "centre of a flower, receptacle"),
    ("hearts", "centres of flowers, receptacles"),
    ("carrier", "parent"),
    ("desk", "context, state, fixture; surround for what lies around a sheet"),
    ("bench", "context, state"),
    ("easel", "painter"),
    ("wish", "request, action"),
    ("wishes", "requests, actions"),
    ("wished", "requested"),
    ("news", "changes, updates, notices"),
    ("scribe", "writer, journal thread"),
    ("farewell", "a guard named after what its drop does"),
];

/// Words that mean something else in a module.
const ALLOWED: &[(&str, &[&str])] = &[("growth", &["heart"]), ("model", &["heart"])];

/// Keywords after which a name is given.
const BEFORE_A_NAME: &[&str] =
    &["fn", "struct", "enum", "mod", "trait", "type", "const", "static", "let", "mut", "for"];

/// Names that a text gives: those behind a keyword, and those before a colon or, as variants, before a bracket or comma.
fn given_names(text: &str) -> BTreeSet<String> {
    let words = words(text);
    let is_name = |word: &str| word.starts_with(|c: char| c.is_alphabetic() || c == '_');
    let word = |k: usize| words.get(k).map_or("", String::as_str);
    let given = |k: &usize| {
        let before = if *k == 0 { "" } else { word(k - 1) };
        let is_variant = word(*k).starts_with(char::is_uppercase) && matches!(before, "{" | "," | "]");
        BEFORE_A_NAME.contains(&before) || word(k + 1) == ":" || before == "|" || is_variant
    };
    (0..words.len()).filter(|k| is_name(word(*k))).filter(given).map(|k| words[k].clone()).collect()
}

/// The words of an identifier, in small letters.
fn parts(name: &str) -> Vec<String> {
    let mut parts = vec![String::new()];
    let mut was_small = false;
    for c in name.chars() {
        if c == '_' || (c.is_uppercase() && was_small) {
            parts.push(String::new());
        }
        was_small = c.is_lowercase();
        if c != '_' {
            parts.last_mut().unwrap().extend(c.to_lowercase());
        }
    }
    parts
}

/// Banned words in a text, each with a name that has it.
fn banned_in(text: &str) -> BTreeMap<&'static str, String> {
    let mut found = BTreeMap::new();
    for name in given_names(text) {
        let parts = parts(&name);
        for (word, _) in BANNED.iter().filter(|(word, _)| parts.iter().any(|part| part == word)) {
            found.entry(*word).or_insert_with(|| name.clone());
        }
    }
    found
}

#[test]
fn identifiers_are_standard_terms() {
    let folder = root().join("src");
    let mut files = Vec::new();
    rust_files(&folder, &mut files);
    assert!(files.len() > 300, "only {} files were found", files.len());
    let (mut wrong, mut left) = (Vec::new(), BTreeSet::new());
    for file in files {
        let path = file.strip_prefix(&folder).unwrap().to_string_lossy().replace('\\', "/");
        let module = path.split(['/', '.']).next().unwrap_or_default().to_owned();
        for (word, name) in banned_in(&fs::read_to_string(&file).unwrap()) {
            if ALLOWED.iter().any(|(of, words)| *of == module && words.contains(&word)) {
                left.insert((module.clone(), word));
            } else {
                let (_, instead) = BANNED.iter().find(|(banned, _)| *banned == word).unwrap();
                wrong.push(format!("src/{path}: `{name}` has `{word}`; use {instead}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let listed = ALLOWED.iter().flat_map(|(of, words)| words.iter().map(|word| ((*of).to_owned(), *word)));
    let gone: Vec<_> = listed.filter(|entry| !left.contains(entry)).collect();
    assert!(gone.is_empty(), "nothing has these words, take them off the list: {gone:?}");
}

#[test]
fn banned_words_are_found_in_names_and_nowhere_else() {
    let text = "//! told\nmod easel { enum WayBack { GoodNews, Old(u8) } struct S { told_ms: f64 } }\n\
                fn f(is_heard: bool) { let mut desk = \"coat: wish\"; desktop.tell(); heart.each(|wish| wish); }";
    let found: Vec<_> = banned_in(text).into_iter().collect();
    let expected = [
        ("desk", "desk"),
        ("easel", "easel"),
        ("heard", "is_heard"),
        ("news", "GoodNews"),
        ("told", "told_ms"),
        ("wish", "wish"),
    ];
    assert_eq!(found, expected.map(|(word, name)| (word, name.to_owned())));
}
