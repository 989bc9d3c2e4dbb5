//! What is wrong with a grammar: where in its text, what it is, and what mends it.

use crate::suggest::did_you_mean;

/// A place in the text of a grammar. Lines and characters of a line count from 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// Number of the line.
    pub line: u32,
    /// Number of the character in its line.
    pub column: u32,
}

/// Why a text is no grammar, or why nothing could be drawn by it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GrammarError {
    /// Something in the text, when it is read or when its rules are applied.
    #[error("line {}, column {}: {what}; {remedy}", place.line, place.column)]
    At {
        /// Where it is written.
        place: Place,
        /// What is wrong.
        what: String,
        /// What to do about it.
        remedy: String,
    },
    /// A value was given for a constant that the grammar does not have.
    #[error("the grammar has no constant `{name}`{}; it has: {known}", did_you_mean(nearest))]
    UnknownConstant {
        /// The name that was given.
        name: String,
        /// The constant that was probably meant.
        nearest: Option<String>,
        /// All constants.
        known: String,
    },
    /// There is no built-in grammar of that name.
    #[error("there is no inflorescence `{name}`{}; there are: {known}", did_you_mean(nearest))]
    UnknownInflorescence {
        /// The name that was asked for.
        name: String,
        /// The one that was probably meant.
        nearest: Option<String>,
        /// All of them.
        known: String,
    },
}

impl GrammarError {
    /// An error at a place, with what is wrong and what to do about it.
    pub(super) fn at(place: Place, what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self::At { place, what: what.into(), remedy: remedy.into() }
    }

    /// Where in the text it is; `None` for names that a caller gave.
    pub fn place(&self) -> Option<Place> {
        match self {
            Self::At { place, .. } => Some(*place),
            Self::UnknownConstant { .. } | Self::UnknownInflorescence { .. } => None,
        }
    }
}
