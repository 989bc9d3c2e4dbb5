//! What pointers do in the view of the plant: a tool a file, each a [`Tool`](super::tool::Tool) of the [`PlantView`](super::plant_view::PlantView).
//!
//! [`PlantHand`] says which of them is at work: a touch picks until it moves further than a tap does, then it turns the
//! camera or, with Shift or a button held, moves it; a plant that is selected, or a control point of a petal, is carried instead, and where a branch can begin while
//! that tool is in hand, the pen draws. A tool that was taken up
//! works in the place of them all. Pens, mice and fingers go the same way; several fingers move the camera together.
//!
//! Limits: wheels and pinches on a touchpad reach the view through egui.

mod camera;
mod carry;
mod draw;
mod hand;
mod pick;

pub use hand::{Keys, PlantHand, PlantTool};
