//! The canvas: what pens, fingers and keys do to the drawing.
//!
//! Pure logic over plain data: events in, outcomes out; no window, no graphics, no clock. [`controller::Canvas`] ties the
//! parts together: where the canvas lies ([`view`]), what fingers mean ([`gesture`]), the growing stroke
//! ([`stroke_builder`]), which strokes are near ([`stroke_index`]), the erasers ([`erase`]) and the selection
//! ([`select`], [`transform`]). Positions in the window are physical pixels; slops and handles are logical pixels.

mod activity;
mod commands;
pub mod controller;
mod doing;
pub mod erase;
pub mod gesture;
pub mod outcome;
pub mod overlay;
pub mod select;
pub mod settings;
pub mod stroke_builder;
pub mod stroke_index;
pub mod tool_context;
mod tools;
pub mod transform;
pub mod view;

pub use controller::Canvas;
pub use outcome::{CanvasKey, CanvasOutcome, Drawing, Scroll};
pub use overlay::{CanvasCursor, CursorShape, Overlay, Preview};
pub use settings::CanvasSettings;
pub use view::{CanvasView, Rect};
