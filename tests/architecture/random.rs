//! Random choices have names: nowhere but in `random` is a key mixed with a bare number.

use crate::source::words;
use crate::{root, rust_files};
use std::fs;

/// Calls of `mix` in a text whose last argument is a number.
fn bare_numbers(text: &str) -> usize {
    let words = words(text);
    let closes = |open: usize| {
        let mut depth = 0;
        (open..words.len()).find(|at| {
            depth += i32::from(words[*at] == "(") - i32::from(words[*at] == ")");
            depth == 0
        })
    };
    let calls = (1..words.len()).filter(|at| words[*at] == "(" && words[at - 1] == "mix");
    let is_number = |word: &str| word.starts_with(|c: char| c.is_ascii_digit());
    calls.filter_map(closes).filter(|end| words[end - 2] == "," && is_number(&words[end - 1])).count()
}

#[test]
fn no_choice_is_a_bare_number() {
    let mut files = Vec::new();
    rust_files(&root().join("src"), &mut files);
    let bare = |file: &std::path::PathBuf| bare_numbers(&fs::read_to_string(file).unwrap()) > 0;
    let found: Vec<_> = files.iter().filter(|f| !f.ends_with("random.rs") && bare(f)).collect();
    assert!(found.is_empty(), "name what is decided, in `random::Choice`: {found:?}");
}

#[test]
fn bare_numbers_are_found() {
    assert_eq!(bare_numbers("mix(mix(seed, 41), u64::from(k)); mix(seed, 0x2a)"), 2);
    assert_eq!(bare_numbers("mix(9, key); mix(seed, k + 1); \"mix(seed, 4)\" // mix(seed, 4)"), 0);
}
