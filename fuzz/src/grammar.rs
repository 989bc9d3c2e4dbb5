//! Any text as a grammar ends in a message or in a sound figure, the same each time; nothing panics.

use penstemon::grammar::{Grammar, Limits, Settings};

/// Little enough for many runs a second.
const LIMITS: Limits = Limits { modules: 20_000, brackets: 60, steps: 5_000, operations: 1_000_000 };

/// Fails where what the head of this file says does not hold of these bytes.
pub fn check(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let grammar = match Grammar::parse(text) {
        Ok(grammar) => grammar,
        Err(error) => return assert!(error.place().is_some(), "{error} has no place"),
    };
    let settings = Settings { seed: 7, constants: &[], limits: LIMITS };
    let drawn = grammar.draw(&settings);
    assert_eq!(drawn, grammar.draw(&settings));
    match drawn {
        Ok(figure) => assert_eq!(figure.check_invariants(), Ok(())),
        Err(error) => assert!(error.place().is_some(), "{error} has no place"),
    }
}
