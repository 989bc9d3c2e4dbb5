//! The canvas: what pens, fingers and keys do to the drawing.
//!
//! Pure logic over plain data: events in, outcomes out; no window, no graphics, no clock. The controller ties the
//! parts together: where the canvas lies ([`view`]), what fingers mean ([`gesture`]), the growing stroke
//! ([`stroke_builder`]), which strokes are near ([`stroke_index`]), the erasers ([`erase`]) and the selection
//! ([`select`], [`transform`]). Positions in the window are physical pixels; slops and handles are logical pixels.

pub mod erase;
pub mod gesture;
pub mod select;
pub mod stroke_builder;
pub mod stroke_index;
pub mod transform;
pub mod view;

pub use stroke_builder::Stabiliser;
pub use view::{CanvasView, Rect};
