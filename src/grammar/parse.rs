//! Reads the text of a grammar.
//!
//! Twice over its statements: constants and the heads of rules first, so that every symbol is known and has a known
//! number of parameters, then what the rules say. What a rule does not close or does not count right is so found before
//! anything is drawn.

use super::code::{Code, Span};
use super::constants;
use super::cursor::Cursor;
use super::error::{GrammarError, Place};
use super::expression::{self, Scope};
use super::lexer::{self, Kind, Token};
use super::limits;
use super::rules::{Alternative, Constant, Grammar, Rule, Symbol};
use super::successor::{Body, Known};
use super::symbols::{self, Meaning};
use crate::quote;

/// What statements there are, for messages.
const STATEMENTS: &str = "there are `name = number`, `axiom: modules`, `steps: number` and `symbol(parameters) : condition -> modules`";

/// A rule of which only the head was read.
struct Head<'a, 't> {
    symbol: usize,
    parameters: Vec<&'a str>,
    rest: Cursor<'a, 't>,
    place: Place,
}

impl Grammar {
    /// Reads the text of a grammar.
    ///
    /// # Errors
    /// The first thing in the text that is wrong.
    pub fn parse(text: &str) -> Result<Self, GrammarError> {
        let tokens = lexer::tokens(text)?;
        let mut parser = Parser::default();
        for statement in lexer::statements(&tokens.all)? {
            parser.statement(statement, &tokens.comments)?;
        }
        parser.finish()
    }
}

#[derive(Default)]
struct Parser<'a, 't> {
    code: Code,
    constants: Vec<Constant>,
    known: Known<'a>,
    heads: Vec<Head<'a, 't>>,
    axiom: Option<Cursor<'a, 't>>,
    steps: Option<Span>,
}

impl<'a, 't> Parser<'a, 't> {
    /// Reads a constant or the head of something else.
    fn statement(&mut self, tokens: &'t [Token<'a>], comments: &[(u32, &str)]) -> Result<(), GrammarError> {
        let mut cursor = Cursor::new(tokens);
        let place = cursor.place();
        let Some(Kind::Name(name)) = cursor.peek() else {
            return Err(cursor.unexpected("a statement", STATEMENTS));
        };
        cursor.skip();
        match name {
            "axiom" => {
                cursor.expect(":", "the axiom begins, as in `axiom: A(0)`")?;
                self.axiom.replace(cursor).map_or(Ok(()), |_| Err(again("axiom", place)))
            }
            "steps" => {
                cursor.expect(":", "the number of steps begins, as in `steps: 5`")?;
                let steps = steps(&mut cursor, &self.known.constants, &mut self.code)?;
                self.steps.replace(steps).map_or(Ok(()), |_| Err(again("steps", place)))
            }
            _ if expression::is_taken(name) => {
                let what = format!("`{name}` means something else");
                Err(GrammarError::at(place, what, "choose another name"))
            }
            _ if cursor.takes("=") => {
                let help = comments.binary_search_by_key(&place.line, |(line, _)| *line);
                let help = help.map_or("", |at| comments[at].1);
                let before = (self.known.constants.as_slice(), self.constants.as_slice());
                let constant = constants::read((name, place, help), cursor, before, &mut self.code)?;
                self.constants.push(constant);
                self.known.constants.push(name);
                Ok(())
            }
            _ => self.head(name, place, cursor),
        }
    }

    /// Reads the parameters of a rule's symbol.
    fn head(&mut self, name: &'a str, place: Place, mut cursor: Cursor<'a, 't>) -> Result<(), GrammarError> {
        let mut parameters = Vec::new();
        if cursor.takes("(") && !cursor.takes(")") {
            loop {
                let parameter = cursor.place();
                let Some(Kind::Name(word)) = cursor.peek() else {
                    return Err(cursor.unexpected("the name of a parameter", "write a word"));
                };
                if parameters.len() == limits::PARAMETERS {
                    let what =
                        format!("`{}` has more than {} parameters", quote::name(name), limits::PARAMETERS);
                    return Err(GrammarError::at(parameter, what, "give it fewer"));
                }
                if expression::is_taken(word) || parameters.contains(&word) {
                    let what = format!("`{}` cannot be the name of this parameter", quote::name(word));
                    return Err(GrammarError::at(parameter, what, "choose a name that nothing else has"));
                }
                parameters.push(word);
                cursor.skip();
                if cursor.takes(")") {
                    break;
                }
                cursor.expect(",", "the next parameter begins")?;
            }
        }
        if !(cursor.is_at(":") || cursor.is_at("->")) {
            return Err(cursor.unexpected("`->`", STATEMENTS));
        }
        let count = parameters.len();
        let known = &mut self.known;
        match known.symbols.get(name) {
            None => {
                check_count(name, count, place)?;
                known.symbols.insert(name, known.counts.len());
                known.counts.push(count);
            }
            Some(symbol) if known.counts[*symbol] != count => {
                let what = format!("`{}` has {count} parameters here", quote::name(name));
                let remedy = format!("give it {}, as in its first rule", known.counts[*symbol]);
                return Err(GrammarError::at(place, what, remedy));
            }
            Some(_) => {}
        }
        let symbol = known.symbols[name];
        self.heads.push(Head { symbol, parameters, rest: cursor, place });
        Ok(())
    }

    /// Reads what was left out: the axiom and what rules replace modules by.
    fn finish(self) -> Result<Grammar, GrammarError> {
        let Self { code, constants, known, heads, axiom, steps } = self;
        let Some(mut axiom) = axiom else {
            let place = Place { line: 1, column: 1 };
            let remedy = "write what it begins with, as in `axiom: A(0)`";
            return Err(GrammarError::at(place, "the grammar has no axiom", remedy));
        };
        let mut list = vec![None; known.symbols.len()];
        for (name, symbol) in &known.symbols {
            let parameters = known.counts[*symbol];
            list[*symbol] = Some(Symbol { name: (*name).to_owned(), parameters, rules: Vec::new() });
        }
        let mut symbols: Vec<Symbol> = list.into_iter().flatten().collect();
        let mut body = Body { code, ..Body::default() };
        let start = body.modules(&mut axiom, &known, &[])?;
        if axiom.peek().is_some() {
            let remedy = "give a symbol of the axiom a rule with alternatives";
            return Err(axiom.unexpected("the end of the axiom", remedy));
        }
        let rules = heads.len();
        for (number, head) in heads.into_iter().enumerate() {
            let before = symbols[head.symbol].rules.len();
            let rule = rule(head, (number, before), &known, &mut body)?;
            symbols[rule.0].rules.push(rule.1);
        }
        let Body { code, templates, organs, .. } = body;
        Ok(Grammar { code, constants, symbols, templates, organs, axiom: start, steps, rules })
    }
}

/// Reads what follows a head: a condition, and what a module is replaced by. `number` is the rule's own among all rules
/// and among those of its symbol.
fn rule(
    head: Head<'_, '_>,
    number: (usize, usize),
    known: &Known<'_>,
    body: &mut Body,
) -> Result<(usize, Rule), GrammarError> {
    let Head { symbol, parameters, mut rest, place } = head;
    let constants = &known.constants;
    let mut scope = Scope { parameters: &parameters, constants, site: number.1 as u64, drawn: 0 };
    let condition = rest.takes(":").then(|| expression::read(&mut rest, &mut scope, &mut body.code));
    let condition = condition.transpose()?;
    rest.expect("->", "what the module is replaced by begins")?;
    let mut alternatives = Vec::new();
    loop {
        let weight = rest.place();
        let weight = match rest.takes("(") {
            true => {
                let weight = expression::read(&mut rest, &mut scope, &mut body.code)?;
                rest.expect(")", "the weight ends")?;
                Some(weight)
            }
            false if alternatives.is_empty() => None,
            false => return Err(GrammarError::at(weight, "an alternative has no weight", WEIGHTS)),
        };
        let modules = body.modules(&mut rest, known, &parameters)?;
        alternatives.push(Alternative { weight, modules });
        if !rest.takes("|") {
            break;
        }
    }
    if alternatives.len() > 1 && alternatives[0].weight.is_none() {
        return Err(GrammarError::at(place, "the first of the alternatives has no weight", WEIGHTS));
    }
    Ok((symbol, Rule { number: number.0, condition, alternatives, place }))
}

/// Symbols have no more parameters than the turtle takes, and no more than there may be.
fn check_count(name: &str, count: usize, place: Place) -> Result<(), GrammarError> {
    let meaning = symbols::letter(name).unwrap_or(Meaning::Nothing);
    if meaning.parameters().contains(&count) {
        return Ok(());
    }
    let what = format!("`{}` has {count} parameters", quote::name(name));
    Err(GrammarError::at(place, what, meaning.usage()))
}

const WEIGHTS: &str = "write a weight in brackets before each, as in `A -> (0.7) F(1) A | (0.3) F(1)`";

fn again(word: &str, place: Place) -> GrammarError {
    GrammarError::at(place, format!("`{word}:` stands here a second time"), "leave one of the two")
}

/// An integral number of steps that constants decide.
fn steps(cursor: &mut Cursor<'_, '_>, constants: &[&str], code: &mut Code) -> Result<Span, GrammarError> {
    let mut scope = Scope { parameters: &[], constants, site: 0, drawn: 0 };
    let steps = expression::read(cursor, &mut scope, code)?;
    if cursor.peek().is_some() {
        Err(cursor.unexpected("the end of the line", "write one number"))
    } else {
        Ok(steps)
    }
}
