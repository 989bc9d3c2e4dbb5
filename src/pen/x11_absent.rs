//! Pens under X11, on systems without X11: there are none, and nothing of this is ever made.
//!
//! The same names as in `x11/connection.rs`, so that who listens to pens need not know the system.

use super::PenEvent;
use std::convert::Infallible;
use thiserror::Error;

/// Why pens are not read.
#[derive(Debug, Error)]
#[error("this system has no X11")]
pub struct X11PenError;

/// The pens over a window; none.
#[derive(Debug)]
pub struct X11Pens(Infallible);

impl X11Pens {
    /// Refuses.
    ///
    /// # Errors
    /// Always.
    pub fn open(
        _window: u32,
        _clock: impl Fn() -> f64 + Send + 'static,
        _wake: impl Fn() + Send + 'static,
    ) -> Result<Self, X11PenError> {
        Err(X11PenError)
    }

    /// Cannot be called.
    pub fn take(&mut self, _: &mut Vec<PenEvent>) {
        match self.0 {}
    }

    /// Cannot be called.
    pub fn mouse_moved(&mut self, _: f64, _: &mut Vec<PenEvent>) {
        match self.0 {}
    }

    /// Cannot be called.
    pub fn idle(&mut self, _: f64, _: &mut Vec<PenEvent>) {
        match self.0 {}
    }

    /// Cannot be called.
    pub fn leaves_at(&self) -> Option<f64> {
        match self.0 {}
    }
}
