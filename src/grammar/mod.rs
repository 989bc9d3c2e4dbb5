//! Parametric, stochastic, bracketed L-systems as data: text in, stems and organs out.
//!
//! [`Grammar::parse`] reads the text, [`Grammar::draw`] derives the word and lets the turtle draw it as a [`Figure`]. What
//! may be written, what the turtle does and what the limits are says `docs/grammars.md`. [`library`] holds
//! inflorescences.
//!
//! Any text ends in a result or in an error that names line and column, in bounded memory and time. The same text,
//! constants and seed give the same figure; numbers at random belong to the paths by which rules come to modules, so what
//! one changed number does not reach stays as it was.
//!
//! Limits: rules do not look at neighbours, and the turtle knows no polygons.
//! Source: Prusinkiewicz and Lindenmayer, *The Algorithmic Beauty of Plants*, 1990, chapters 1 and 3.

mod code;
mod constants;
mod cursor;
mod derive;
mod draw;
mod error;
mod expression;
mod figure;
mod lexer;
pub mod library;
mod limits;
mod parse;
mod rules;
mod successor;
mod symbols;
#[cfg(test)]
mod tests;
mod turtle;

pub use draw::Settings;
pub use error::{GrammarError, Place};
pub use figure::{Figure, Item, Stem};
pub use limits::Limits;
pub use rules::{Constant, Grammar, OrganUse};
