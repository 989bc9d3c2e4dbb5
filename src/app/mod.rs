//! The window: draw on the left, the plant grows on the right.

pub mod action;
pub mod egui_input;
pub mod surface;

pub use action::Action;
