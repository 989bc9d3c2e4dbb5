//! A grammar as data: constants, symbols with their rules, modules with the code of their parameters.

use super::code::{Code, Span};
use super::error::Place;
use super::symbols::Meaning;
use std::ops::Range;
use std::sync::Arc;

/// A number of a grammar that a caller may set by its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Constant {
    /// Its name.
    pub name: String,
    /// Its value where no caller sets it, with seed 0 if it has numbers at random, and with all others as they are.
    pub value: f64,
    /// The least and the greatest value that it may have, if the grammar says so.
    pub range: Option<(f64, f64)>,
    /// Whether it is a whole number: values are rounded.
    pub is_whole: bool,
    /// What it is: the comment behind it.
    pub help: String,
    /// Where it is declared.
    pub place: Place,
    pub(super) code: Span,
}

/// An organ that the rules of a grammar place somewhere.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct OrganUse {
    /// Its name.
    pub name: Arc<str>,
    /// How many arguments it has.
    pub arguments: usize,
    /// Where it is placed.
    pub place: Place,
}

/// A parametric, stochastic, bracketed L-system. `Grammar::parse` reads one, `Grammar::draw` lets the turtle draw it.
#[derive(Clone, Debug, PartialEq)]
pub struct Grammar {
    pub(super) code: Code,
    pub(super) constants: Vec<Constant>,
    pub(super) symbols: Vec<Symbol>,
    pub(super) templates: Vec<Template>,
    pub(super) organs: Vec<OrganUse>,
    /// The axiom's templates.
    pub(super) axiom: Range<u32>,
    /// After how many steps the derivation ends, if the grammar says so.
    pub(super) steps: Option<Span>,
    /// Number of rules.
    pub(super) rules: usize,
}

/// A symbol that has rules.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Symbol {
    pub(super) name: String,
    pub(super) parameters: usize,
    /// In the order in which they are tried.
    pub(super) rules: Vec<Rule>,
}

/// What a module of a symbol is replaced by.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rule {
    /// Its number among all rules.
    pub(super) number: usize,
    pub(super) condition: Option<Span>,
    pub(super) alternatives: Vec<Alternative>,
    pub(super) place: Place,
}

/// One of the ways in which a rule replaces a module.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Alternative {
    pub(super) weight: Option<Span>,
    /// Its templates.
    pub(super) modules: Range<u32>,
}

/// A module before its parameters are known.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Template {
    /// Its place among the symbols, if it has rules.
    pub(super) symbol: Option<u32>,
    /// What the turtle does.
    pub(super) meaning: Meaning,
    /// Its parameters, all in one piece.
    pub(super) parameters: Span,
    /// Its name among the modules that replace one module: changes to others leave it as it is.
    pub(super) name: u64,
    pub(super) place: Place,
}

impl Grammar {
    /// The numbers that a caller may set, in the order of the text.
    pub fn constants(&self) -> &[Constant] {
        &self.constants
    }

    /// The organs that the rules place, in the order of the text.
    pub fn organs(&self) -> &[OrganUse] {
        &self.organs
    }

    /// The rule of a number, and its symbol.
    pub(super) fn rule(&self, number: usize) -> Option<(&Symbol, &Rule)> {
        let rules =
            self.symbols.iter().flat_map(|symbol| symbol.rules.iter().map(move |rule| (symbol, rule)));
        rules.into_iter().find(|(_, rule)| rule.number == number)
    }
}
