//! The window: draw on the left, the plant grows on the right.

pub mod action;
pub mod canvas;

pub use action::Action;
