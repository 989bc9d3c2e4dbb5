//! Constants: numbers with a name, a range and a help, which a caller may set by name.

use super::code::{Code, Span, Surroundings};
use super::cursor::Cursor;
use super::error::{GrammarError, Place};
use super::expression::{self, Scope};
use super::lexer::Kind;
use super::rules::{Constant, Grammar};
use crate::quote;
use crate::random::mix;
use crate::suggest::nearest;

/// Most constants of a grammar.
const MOST: usize = 1000;

/// Reads what follows `name =`: an expression, `from low to high`, `whole`.
///
/// # Errors
/// A second constant of the name, what is no expression, a value that is not in its range.
pub(super) fn read<'a>(
    (name, place, help): (&'a str, Place, &str),
    mut cursor: Cursor<'a, '_>,
    (names, before): (&[&'a str], &[Constant]),
    code: &mut Code,
) -> Result<Constant, GrammarError> {
    if names.contains(&name) {
        let what = format!("there is a constant `{}` already", quote::name(name));
        return Err(GrammarError::at(place, what, "choose another name, or take one of them out"));
    }
    if names.len() == MOST {
        let what = format!("there are more than {MOST} constants");
        return Err(GrammarError::at(place, what, "write numbers that nobody changes where they are used"));
    }
    let mut scope = Scope { parameters: &[], constants: names, site: 0, drawn: 0 };
    let span = expression::read(&mut cursor, &mut scope, code)?;
    let mut range = None;
    if cursor.peek() == Some(Kind::Name("from")) {
        cursor.skip();
        let low = signed(&mut cursor)?;
        if cursor.peek() != Some(Kind::Name("to")) {
            return Err(cursor.unexpected("`to`", "write the range as in `n = 12 from 1 to 60`"));
        }
        cursor.skip();
        range = Some((low, signed(&mut cursor)?));
    }
    let is_whole = cursor.peek() == Some(Kind::Name("whole"));
    if is_whole {
        cursor.skip();
    }
    if cursor.peek().is_some() {
        let remedy = "write a constant as in `n = 12`, `n = 12 from 1 to 60` or `n = 12 from 1 to 60 whole`";
        return Err(cursor.unexpected("the end of the line", remedy));
    }
    let (name, help) = (name.to_owned(), help.to_owned());
    let mut constant = Constant { name, value: 0.0, range, is_whole, help, place, code: span };
    let values: Vec<f64> = before.iter().map(|constant| constant.value).collect();
    constant.value = value(&constant, code, &values, 0)?;
    check(&constant, constant.value)?;
    Ok(constant)
}

/// A number with its sign.
fn signed(cursor: &mut Cursor<'_, '_>) -> Result<f64, GrammarError> {
    let sign = if cursor.takes("-") { -1.0 } else { 1.0 };
    match cursor.peek() {
        Some(Kind::Number(number)) => {
            cursor.skip();
            Ok(sign * number)
        }
        _ => Err(cursor.unexpected("a number", "write the range as in `n = 12 from 1 to 60`")),
    }
}

fn value(constant: &Constant, code: &Code, before: &[f64], seed: u64) -> Result<f64, GrammarError> {
    let with = Surroundings { constants: before, base: 0, stream: mix(seed, name(&constant.name)) };
    let value = code.number(constant.code, with, &mut Vec::new())?;
    Ok(if constant.is_whole { value.round() } else { value })
}

fn check(constant: &Constant, value: f64) -> Result<(), GrammarError> {
    let (low, high) = constant.range.unwrap_or((f64::MIN, f64::MAX));
    if (low..=high).contains(&value) {
        return Ok(());
    }
    let what = format!("the constant `{}` is {value}", quote::name(&constant.name));
    Err(GrammarError::at(constant.place, what, format!("give it a value from {low} to {high}")))
}

/// A word as part of the name of a stream.
pub(super) fn name(word: &str) -> u64 {
    word.bytes().fold(0, |hash, byte| mix(hash, u64::from(byte)))
}

impl Grammar {
    /// The values of all constants, some of them given by name.
    ///
    /// # Errors
    /// An unknown name, a value out of range, an expression without a value.
    pub(super) fn values(&self, given: &[(&str, f64)], seed: u64) -> Result<Vec<f64>, GrammarError> {
        let mut set = vec![None; self.constants.len()];
        for (name, value) in given {
            let Some(place) = self.constants.iter().position(|constant| constant.name == *name) else {
                let names = || self.constants.iter().map(|constant| constant.name.as_str());
                let nearest = nearest(name, names()).map(str::to_owned);
                let known = names().collect::<Vec<_>>().join(", ");
                return Err(GrammarError::UnknownConstant { name: quote::name(name), nearest, known });
            };
            set[place] = Some(*value);
        }
        let mut values = Vec::with_capacity(set.len());
        for (constant, set) in self.constants.iter().zip(set) {
            let value = match set {
                Some(set) if constant.is_whole => set.round(),
                Some(set) => set,
                None => value(constant, &self.code, &values, seed)?,
            };
            check(constant, value)?;
            values.push(value);
        }
        Ok(values)
    }

    /// The value of an expression in which only constants are named.
    pub(super) fn constant_expression(&self, code: Span, values: &[f64]) -> Result<f64, GrammarError> {
        let with = Surroundings { constants: values, base: 0, stream: 0 };
        self.code.number(code, with, &mut Vec::new())
    }
}
