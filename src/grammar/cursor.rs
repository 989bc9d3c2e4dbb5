//! A place in the tokens of one statement.

use super::error::{GrammarError, Place};
use super::lexer::{Kind, Token};

/// Reads the tokens of a statement in their order.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cursor<'a, 't> {
    tokens: &'t [Token<'a>],
    next: usize,
}

impl<'a, 't> Cursor<'a, 't> {
    pub(super) fn new(tokens: &'t [Token<'a>]) -> Self {
        Self { tokens, next: 0 }
    }

    /// What the next token is.
    pub(super) fn peek(&self) -> Option<Kind<'a>> {
        self.tokens.get(self.next).map(|token| token.kind)
    }

    /// What the token after the next is.
    pub(super) fn peek_second(&self) -> Option<Kind<'a>> {
        self.tokens.get(self.next + 1).map(|token| token.kind)
    }

    /// Whether the next token is a mark.
    pub(super) fn is_at(&self, mark: &str) -> bool {
        self.peek() == Some(Kind::Mark(mark))
    }

    /// Where the next token stands; behind the last one, where that stands.
    pub(super) fn place(&self) -> Place {
        self.tokens.get(self.next).or(self.tokens.last()).map(|token| token.place).unwrap_or_default()
    }

    /// Goes over the next token.
    pub(super) fn skip(&mut self) {
        self.next += 1;
    }

    /// Goes over the next token if it is a mark.
    pub(super) fn takes(&mut self, mark: &str) -> bool {
        let is_there = self.is_at(mark);
        self.next += usize::from(is_there);
        is_there
    }

    /// Goes over the next token, which has to be a mark.
    ///
    /// # Errors
    /// Any other token, or none.
    pub(super) fn expect(&mut self, mark: &str, here: &str) -> Result<(), GrammarError> {
        if self.takes(mark) {
            Ok(())
        } else {
            Err(self.unexpected(&format!("`{mark}`"), &format!("write it where {here}")))
        }
    }

    /// The error that something else stands here than expected.
    pub(super) fn unexpected(&self, expected: &str, remedy: &str) -> GrammarError {
        let found = self.tokens.get(self.next).map(Token::quoted);
        let what = match found {
            Some(found) => format!("{found} stands where {expected} is expected"),
            None => format!("the statement ends where {expected} is expected"),
        };
        GrammarError::at(self.place(), what, remedy)
    }
}
