//! The window: draw on the left, the plant grows on the right.

pub mod action;
pub mod egui_input;
mod frame;
pub mod surface;
pub mod transfer;
pub mod worker;
pub mod canvas;
pub mod fonts;
pub mod messages;
pub mod panels;
pub mod presets;
pub mod settings;
pub mod theme;

pub use action::Action;
