//! The window without a display: panels, canvas, live view, and pictures of models.
//!
//! One program of tests out of many files: each would be linked by itself, with all libraries, otherwise.

mod cards;
mod crowds;
mod live_canvas;
mod live_copies;
mod live_view;
#[path = "common/not_run.rs"]
mod not_run;
mod panels;
mod render;
mod thumbnails;
