//! What pens do in the view of the plant: a tool a file, each a [`Tool`](super::tool::Tool) of the [`PlantView`](super::plant_view::PlantView).
//!
//! [`PlantHand`] says which of them is at work: a touch picks until it moves further than a tap does, then it turns the
//! camera or, with Shift or a button held, moves it. A tool that was taken up works in their place.
//!
//! Limits: mice and fingers reach the view through egui, which knows double clicks and gestures of several fingers.

mod hand;
mod orbit;
mod pan;
mod pick;

pub use hand::{PlantHand, PlantTool};
