//! Words of a user or of a file as messages quote them: short, on one line, with nothing that a terminal obeys.
//!
//! Control characters, and those that change the direction of text, become escapes such as `\u{1b}`. Of what is too long
//! for a message the beginning and the end stay.

use std::borrow::Cow;

/// Longest name that is quoted whole, characters.
pub const NAME: usize = 200;
/// Longest message, characters: room for any path with what is said of it.
pub const MESSAGE: usize = 6000;

/// A name, a value or a line as a message quotes it.
pub fn name(text: &str) -> String {
    quoted(text, NAME).into_owned()
}

/// A message that others put together.
pub fn message(text: &str) -> String {
    quoted(text, MESSAGE).into_owned()
}

/// The number of the line, from 1, in which a byte of a text stands, and what that line says.
pub fn line_at(text: &str, byte: usize) -> (usize, String) {
    let before = text.get(..byte.min(text.len())).unwrap_or_default();
    let line = before.matches('\n').count();
    (line + 1, name(text.lines().nth(line).unwrap_or_default().trim()))
}

fn quoted(text: &str, most: usize) -> Cow<'_, str> {
    // A text of so many bytes has no more characters.
    let is_short = text.len() <= most || text.chars().nth(most).is_none();
    if is_short && !text.chars().any(is_obeyed) {
        return Cow::Borrowed(text);
    }
    if is_short {
        return text.chars().flat_map(escaped).collect::<String>().into();
    }
    let tail = most / 3;
    let end = text.char_indices().rev().nth(tail - 1).map_or(text.len(), |(at, _)| at);
    let head = text.chars().take(most - tail - 1);
    head.chain(['…']).chain(text[end..].chars()).flat_map(escaped).collect::<String>().into()
}

fn escaped(c: char) -> impl Iterator<Item = char> {
    let (plain, escape) = if is_obeyed(c) { (None, Some(c.escape_default())) } else { (Some(c), None) };
    plain.into_iter().chain(escape.into_iter().flatten())
}

/// Whether a terminal or a line of text takes the character for an order: control characters, line and paragraph
/// separators, marks of direction.
fn is_obeyed(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{feff}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_words_stay_as_they_are() {
        for text in ["", "daisy", "菊花 “rose”", "a'b\\c"] {
            assert_eq!(name(text), text);
        }
        let longest = "é".repeat(NAME);
        assert_eq!(name(&longest), longest);
    }

    #[test]
    fn nothing_in_a_quotation_is_obeyed() {
        let text = "a\u{1b}[2J\r\nb\u{9b}31m\u{202e}c\u{2028}\0";
        assert_eq!(name(text), "a\\u{1b}[2J\\r\\nb\\u{9b}31m\\u{202e}c\\u{2028}\\u{0}");
    }

    #[test]
    fn of_long_words_both_ends_stay() {
        let long = format!("begin{}end", "ü".repeat(10_000_000));
        let quoted = name(&long);
        assert!(quoted.starts_with("begin") && quoted.ends_with("end") && quoted.contains('…'), "{quoted}");
        assert_eq!(quoted.chars().count(), NAME);
        assert_eq!(message(&long).chars().count(), MESSAGE);
    }
}
