//! Reads what a module is replaced by: modules with their parameters.

use super::code::{Code, Op, Span};
use super::constants;
use super::cursor::Cursor;
use super::error::{GrammarError, Place};
use super::expression::{self, Scope};
use super::lexer::Kind;
use super::rules::{OrganUse, Template};
use super::symbols::{self, Meaning};
use crate::quote;
use crate::random::mix;
use crate::suggest::{did_you_mean, nearest};
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

/// What a grammar has names for.
#[derive(Debug, Default)]
pub(super) struct Known<'a> {
    /// Places of the symbols that have rules.
    pub(super) symbols: BTreeMap<&'a str, usize>,
    /// How many parameters each of them has.
    pub(super) counts: Vec<usize>,
    pub(super) constants: Vec<&'a str>,
}

/// What is read so far of all successors.
#[derive(Debug, Default)]
pub(super) struct Body {
    pub(super) code: Code,
    pub(super) templates: Vec<Template>,
    pub(super) organs: Vec<OrganUse>,
    /// Names of organs, each held once.
    pub(super) names: BTreeMap<String, Arc<str>>,
}

/// A symbol where it stands, without its parameters.
struct Sign<'a> {
    /// As it is written.
    text: &'a str,
    symbol: Option<usize>,
    meaning: Meaning,
    place: Place,
}

impl Body {
    /// Reads modules up to the end of the statement, or up to the next alternative.
    ///
    /// # Errors
    /// Unknown symbols, wrong numbers of parameters, alternatives inside of brackets.
    pub(super) fn modules(
        &mut self,
        cursor: &mut Cursor<'_, '_>,
        known: &Known<'_>,
        parameters: &[&str],
    ) -> Result<Range<u32>, GrammarError> {
        let start = self.templates.len() as u32;
        let mut seen: BTreeMap<(&str, &str), u64> = BTreeMap::new();
        let mut depth = 0;
        while let Some(kind) = cursor.peek() {
            let place = cursor.place();
            if kind == Kind::Mark("|") && cursor.peek_second() == Some(Kind::Mark("(")) {
                if depth == 0 {
                    break;
                }
                let remedy = "give a symbol in the bracket a rule of its own with these alternatives";
                return Err(GrammarError::at(place, "an alternative begins inside of a bracket", remedy));
            }
            depth += i32::from(kind == Kind::Mark("[")) - i32::from(kind == Kind::Mark("]"));
            let prefix = if let Kind::Mark(mark @ ("*" | "@")) = kind { mark } else { "" };
            let sign = sign(cursor, known)?;
            let times = seen.entry((prefix, sign.text)).or_default();
            let name = mix(mix(constants::name(prefix), constants::name(sign.text)), *times);
            *times += 1;
            let (parameters, count) = self.parameters(cursor, &sign, known, parameters)?;
            let is_organ = matches!(sign.meaning, Meaning::Organ(_));
            let meaning = if is_organ { self.organ(sign.text, count, place) } else { sign.meaning };
            let symbol = sign.symbol.map(|symbol| symbol as u32);
            self.templates.push(Template { symbol, meaning, parameters, name, place });
        }
        Ok(start..self.templates.len() as u32)
    }

    /// Reads the parameters behind a symbol; also how many they are.
    fn parameters(
        &mut self,
        cursor: &mut Cursor<'_, '_>,
        sign: &Sign<'_>,
        known: &Known<'_>,
        parameters: &[&str],
    ) -> Result<(Span, usize), GrammarError> {
        let start = self.code.len();
        let mut scope = Scope { parameters, constants: &known.constants, site: 0, drawn: 0 };
        let mut count = 0;
        if cursor.takes("(") {
            while !cursor.takes(")") {
                if count > 0 {
                    cursor.expect(",", "the next parameter begins")?;
                }
                expression::read(cursor, &mut scope, &mut self.code)?;
                count += 1;
            }
        } else if let Meaning::Turn(_) = sign.meaning {
            let angle = known.constants.iter().position(|name| *name == "angle");
            count = usize::from(angle.is_some());
            angle.into_iter().for_each(|at| self.code.push(Op::Constant(at as u16), sign.place));
        }
        let rules = sign.symbol.map(|symbol| known.counts[symbol]);
        let is_right = rules.map_or_else(|| sign.meaning.parameters().contains(&count), |n| n == count);
        if !is_right {
            let what = format!("`{}` has {count} parameters here", quote::name(sign.text));
            let as_in_rules = |n| format!("give it {n}, as in its rules");
            let remedy = rules.map_or_else(|| sign.meaning.usage().to_owned(), as_in_rules);
            return Err(GrammarError::at(sign.place, what, remedy));
        }
        Ok((self.code.since(start), count))
    }

    /// Takes an organ into the list.
    fn organ(&mut self, name: &str, arguments: usize, place: Place) -> Meaning {
        let name = self.names.entry(name.to_owned()).or_insert_with(|| name.into()).clone();
        self.organs.push(OrganUse { name, arguments, place });
        Meaning::Organ(self.organs.len() as u32 - 1)
    }
}

/// Reads a symbol.
fn sign<'a>(cursor: &mut Cursor<'a, '_>, known: &Known<'_>) -> Result<Sign<'a>, GrammarError> {
    let place = cursor.place();
    let kind = cursor.peek();
    cursor.skip();
    let (text, meaning) = match kind {
        Some(Kind::Mark("*")) => {
            (word(cursor, "the name of an organ", "as in `*flower(1)`")?, Meaning::Organ(0))
        }
        Some(Kind::Mark("@")) => {
            let text = word(cursor, "the name of a solid", "`@ball(radius)` or `@cylinder(radius, length)`")?;
            let unknown = || {
                let known = symbols::SOLIDS.iter().map(|(name, _)| *name);
                unknown(&format!("@{text}"), nearest(text, known).map(|name| format!("@{name}")), place)
            };
            (text, symbols::solid(text).ok_or_else(unknown)?)
        }
        Some(Kind::Name(text)) => {
            let symbol = known.symbols.get(text).copied();
            let meaning = symbols::letter(text).or(symbol.map(|_| Meaning::Nothing));
            let names = known.symbols.keys().copied().chain(symbols::LETTERS.iter().map(|(name, _)| *name));
            let unknown = || unknown(text, nearest(text, names).map(str::to_owned), place);
            return Ok(Sign { text, symbol, meaning: meaning.ok_or_else(unknown)?, place });
        }
        Some(Kind::Mark(text)) => (text, symbols::mark(text).ok_or_else(|| unknown(text, None, place))?),
        Some(Kind::Number(_)) | None => {
            let remedy = "write parameters in brackets right behind their symbol";
            return Err(GrammarError::at(place, "a number stands where a symbol is expected", remedy));
        }
    };
    Ok(Sign { text, symbol: None, meaning, place })
}

/// Reads the word behind `*` or `@`.
fn word<'a>(cursor: &mut Cursor<'a, '_>, expected: &str, usage: &str) -> Result<&'a str, GrammarError> {
    let Some(Kind::Name(text)) = cursor.peek() else {
        return Err(cursor.unexpected(expected, &format!("write {usage}")));
    };
    cursor.skip();
    Ok(text)
}

fn unknown(text: &str, nearest: Option<String>, place: Place) -> GrammarError {
    let what = format!("`{}` is no symbol{}", quote::name(text), did_you_mean(&nearest));
    let is_run = text.len() > 1 && text.chars().all(|c| c == 'F' || c == 'f');
    let remedy = if is_run {
        "put spaces between symbols that are letters"
    } else {
        "give it a rule, or write `*` before it if it is an organ"
    };
    GrammarError::at(place, what, remedy)
}
