//! The text of a grammar as tokens with their places, and these as statements.
//!
//! A statement begins at the start of a line and goes on over lines that begin further to the right, and over all lines
//! up to the end of a bracket that is open. `#` begins a comment.

use super::error::{GrammarError, Place};
use super::limits;
use crate::quote;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind<'a> {
    /// A number without sign.
    Number(f64),
    /// A word.
    Name(&'a str),
    /// Anything else: one character, or two that belong together.
    Mark(&'a str),
}

/// A token where it stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Token<'a> {
    pub(super) kind: Kind<'a>,
    pub(super) place: Place,
    /// Whether it is the first of its line.
    pub(super) is_first: bool,
}

impl Token<'_> {
    /// The token as a message quotes it.
    pub(super) fn quoted(&self) -> String {
        match self.kind {
            Kind::Number(number) => format!("`{number}`"),
            Kind::Name(text) | Kind::Mark(text) => format!("`{}`", quote::name(text)),
        }
    }
}

/// All tokens of a text, and the comments by their lines.
#[derive(Debug, Default)]
pub(super) struct Tokens<'a> {
    pub(super) all: Vec<Token<'a>>,
    pub(super) comments: Vec<(u32, &'a str)>,
}

/// Marks of two characters.
const PAIRS: [&str; 5] = ["->", "<=", ">=", "==", "!="];
/// Marks of one character.
const MARKS: &str = "+-*/^%()[]<>=:,|&\\$!\"~@";

/// Takes a text apart.
///
/// # Errors
/// A text that is too long, a character that means nothing, a number that is none.
pub(super) fn tokens(text: &str) -> Result<Tokens<'_>, GrammarError> {
    if text.len() > limits::TEXT {
        let what = format!("the grammar has {} bytes", text.len());
        let remedy = format!("it may have {}", limits::TEXT);
        return Err(GrammarError::at(Place { line: 1, column: 1 }, what, remedy));
    }
    let mut tokens = Tokens::default();
    for (number, line) in (1..).zip(text.lines()) {
        read_line(line, number, &mut tokens)?;
    }
    Ok(tokens)
}

fn read_line<'a>(line: &'a str, number: u32, tokens: &mut Tokens<'a>) -> Result<(), GrammarError> {
    let (mut rest, mut column, mut is_first) = (line, 1, true);
    while let Some(c) = rest.chars().next() {
        let place = Place { line: number, column };
        if c == '#' {
            tokens.comments.push((number, rest[1..].trim()));
            break;
        }
        let length = if c.is_whitespace() { c.len_utf8() } else { token_length(rest, c, place)? };
        let (text, after) = rest.split_at(length);
        if !c.is_whitespace() {
            tokens.all.push(Token { kind: kind(text, c, place)?, place, is_first });
            is_first = false;
        }
        // Tokens are ASCII; white space may be one character of several bytes.
        column += if c.is_whitespace() { 1 } else { length as u32 };
        rest = after;
    }
    Ok(())
}

fn token_length(rest: &str, c: char, place: Place) -> Result<usize, GrammarError> {
    let bytes = rest.as_bytes();
    if c.is_ascii_alphabetic() || c == '_' {
        let is_inside = |b: &u8| b.is_ascii_alphanumeric() || *b == b'_';
        return Ok(bytes.iter().take_while(|b| is_inside(b)).count());
    }
    if c.is_ascii_digit() || (c == '.' && bytes.get(1).is_some_and(u8::is_ascii_digit)) {
        return Ok(number_length(bytes));
    }
    if PAIRS.iter().any(|pair| rest.starts_with(pair)) {
        return Ok(2);
    }
    if MARKS.contains(c) {
        return Ok(1);
    }
    let what = format!("`{}` means nothing in a grammar", quote::name(&c.to_string()));
    Err(GrammarError::at(place, what, "take it out, or put `#` before it if it is a comment"))
}

/// Digits, a point with digits, a power of ten.
fn number_length(bytes: &[u8]) -> usize {
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let mut length = digits(0);
    if bytes.get(length) == Some(&b'.') {
        length += 1 + digits(length + 1);
    }
    if matches!(bytes.get(length), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
        let power = if length + 1 + sign < bytes.len() { digits(length + 1 + sign) } else { 0 };
        if power > 0 {
            length += 1 + sign + power;
        }
    }
    length
}

fn kind(text: &str, c: char, place: Place) -> Result<Kind<'_>, GrammarError> {
    if c.is_ascii_digit() || (c == '.' && text.len() > 1) {
        let number = text.parse::<f64>().ok().filter(|number| number.is_finite());
        let too_large = || {
            let what = format!("`{}` is no number that can be used", quote::name(text));
            GrammarError::at(place, what, "write one below 1e300")
        };
        return number.map(Kind::Number).ok_or_else(too_large);
    }
    let is_name = c.is_ascii_alphabetic() || c == '_';
    Ok(if is_name { Kind::Name(text) } else { Kind::Mark(text) })
}

/// The tokens of each statement. Brackets are balanced in all of them.
///
/// # Errors
/// A bracket that is not closed, or closes nothing.
pub(super) fn statements<'t, 'a>(tokens: &'t [Token<'a>]) -> Result<Vec<&'t [Token<'a>]>, GrammarError> {
    let mut statements = Vec::new();
    let mut open: Vec<Token<'_>> = Vec::new();
    let mut start = 0;
    for (at, token) in tokens.iter().enumerate() {
        let is_next = token.is_first && open.is_empty() && token.place.column <= tokens[start].place.column;
        if is_next && at > start {
            statements.push(&tokens[start..at]);
            start = at;
        }
        match token.kind {
            Kind::Mark("(" | "[") => open.push(*token),
            Kind::Mark(closing @ (")" | "]")) => close(open.pop(), closing, token.place)?,
            _ => {}
        }
    }
    if let Some(token) = open.pop() {
        let closing = if token.kind == Kind::Mark("(") { ")" } else { "]" };
        let what = format!("{} is never closed", token.quoted());
        return Err(GrammarError::at(token.place, what, format!("write `{closing}` where it ends")));
    }
    statements.extend(Some(&tokens[start..]).filter(|rest| !rest.is_empty()));
    Ok(statements)
}

fn close(opened: Option<Token<'_>>, closing: &str, place: Place) -> Result<(), GrammarError> {
    let opening = if closing == ")" { "(" } else { "[" };
    match opened {
        Some(token) if token.kind == Kind::Mark(opening) => Ok(()),
        Some(token) => {
            let Place { line, column } = token.place;
            let what = format!(
                "`{closing}` stands where {} of line {line}, column {column} is open",
                token.quoted()
            );
            Err(GrammarError::at(place, what, "close brackets in the opposite order of opening them"))
        }
        None => {
            let what = format!("`{closing}` closes nothing");
            Err(GrammarError::at(place, what, format!("take it out, or write `{opening}` before it")))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(text: &str) -> Vec<String> {
        tokens(text).unwrap().all.iter().map(Token::quoted).collect()
    }

    fn said(text: &str) -> String {
        let tokens = tokens(text).map_err(|e| e.to_string());
        tokens.and_then(|t| statements(&t.all).map(|_| ()).map_err(|e| e.to_string())).unwrap_err()
    }

    #[test]
    fn text_is_taken_apart() {
        assert_eq!(texts("A_1(.5)->+F"), ["`A_1`", "`(`", "`0.5`", "`)`", "`->`", "`+`", "`F`"]);
        assert_eq!(texts("1.5e-3e 2e+ 3.x"), ["`0.0015`", "`e`", "`2`", "`e`", "`+`", "`3`", "`x`"]);
        assert_eq!(texts("a<=b!=c # d"), ["`a`", "`<=`", "`b`", "`!=`", "`c`"]);
    }

    #[test]
    fn places_count_characters() {
        let all = tokens("a\n\u{3000} b c").unwrap().all;
        let places: Vec<_> = all.iter().map(|t| (t.place.line, t.place.column, t.is_first)).collect();
        assert_eq!(places, [(1, 1, true), (2, 3, true), (2, 5, false)]);
    }

    #[test]
    fn lines_further_right_and_open_brackets_continue_a_statement() {
        let all = tokens("  a b\n   c\n  d [\ne ]\n f").unwrap().all;
        let lengths: Vec<_> = statements(&all).unwrap().iter().map(|s| s.len()).collect();
        assert_eq!(lengths, [3, 4, 1]);
        assert!(statements(&[]).unwrap().is_empty());
    }

    #[test]
    fn brackets_that_do_not_match_are_named() {
        assert_eq!(said("a (\n b ["), "line 2, column 4: `[` is never closed; write `]` where it ends");
        assert!(said("a )").starts_with("line 1, column 3: `)` closes nothing"));
        assert!(
            said("a ( ]").starts_with("line 1, column 5: `]` stands where `(` of line 1, column 3 is open")
        );
    }

    #[test]
    fn what_means_nothing_is_named() {
        assert!(said("a\n  ü").starts_with("line 2, column 3: `ü` means nothing"));
        assert!(said("a\u{1b}").starts_with("line 1, column 2: `\\u{1b}` means nothing"));
        assert!(said("1e999").contains("no number that can be used"));
        assert!(said(&"a ".repeat(40_000)).contains("80000 bytes"));
    }
}
