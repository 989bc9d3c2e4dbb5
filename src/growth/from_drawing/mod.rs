//! Growth in a drawing: drawn wood grows on, drawn crowns are filled, and the rest of the drawing stays as it is.

pub mod drawing;
mod extend_into_crown;
pub mod merge;

pub use drawing::{DrawnCrowns, GrowthParams, Memory, Start};
