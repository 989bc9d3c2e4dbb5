//! The panels around the canvas, used as an artist uses them: by pressing and dragging, in both languages and themes.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test or bench that cannot go on has failed")]

mod beside;
mod desktop;
mod dialogs;
mod growth;
mod keyboard;
mod looks;
mod measures;
mod opening;
mod parameters;
mod petals;
mod pictures;
mod readings;
mod season;
mod side;
mod stage;
mod tools;
