//! From a grammar to a figure.

use super::derive::Derivation;
use super::error::GrammarError;
use super::figure::Figure;
use super::limits::Limits;
use super::rules::Grammar;
use super::turtle::Turtle;

/// What a drawing by a grammar depends on besides its text.
#[derive(Clone, Copy, Debug, Default)]
pub struct Settings<'a> {
    /// The seed of all numbers at random.
    pub seed: u64,
    /// Values of constants by their names; of two for one the later holds.
    pub constants: &'a [(&'a str, f64)],
    /// What the drawing may take.
    pub limits: Limits,
}

impl Grammar {
    /// Derives the word and lets the turtle draw it.
    ///
    /// # Errors
    /// Constants that there are not or that are out of range, rules that do not end, expressions without a value, and
    /// what the turtle cannot do.
    pub fn draw(&self, settings: &Settings<'_>) -> Result<Figure, GrammarError> {
        let constants = self.values(settings.constants, settings.seed)?;
        let organs = self.organs.iter().map(|organ| organ.name.clone()).collect();
        let mut turtle = Turtle::new(settings.limits.brackets, organs);
        let derivation = Derivation::new(self, &constants, settings.seed, settings.limits);
        derivation.run(|module| turtle.obey(module))?;
        Ok(turtle.into_figure())
    }
}
