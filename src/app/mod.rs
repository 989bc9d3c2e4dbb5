//! The window: draw on the left, the plant grows on the right.

pub mod action;
pub mod egui_input;
mod frame;
pub mod surface;
pub mod transfer;
pub mod worker;
pub mod canvas;

pub use action::Action;
