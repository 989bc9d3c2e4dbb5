//! Brushes in the space of the plant (001 §4.4): what a ball sweeps is filled with wood, leaves or flowers, or emptied.
//!
//! | room | what |
//! | --- | --- |
//! | `nearby` | which wood of the plant a stroke reaches, and a lead to it where it reaches none |
//! | `own_leaves` | the leaves that the plant has already, for those that grow |
//! | `paint` | growth in what a growth brush sweeps |
//! | `places` | places along the wood that a stroke sweeps |
//! | `paint_leaves`, `paint_flowers` | leaves and flowers on that wood |
//! | `prune` | what a pruning brush cuts off |
//!
//! Strokes work one after the other, each on the plant that those before it left. The plant's own wood stays as it is: what
//! grows stands on it. Growth ends when hardly anything grows any more, or after as many years as the stroke's
//! length takes.
//!
//! Source: 001 §4.4. Where we depart: the thesis scatters markers about the brush while it moves, so that a slow hand has more of them and
//! painting twice makes wood twice as dense; here what is swept is one volume.

mod nearby;
mod own_leaves;
mod paint;
mod paint_flowers;
mod paint_leaves;
mod places;
mod prune;
#[cfg(test)]
mod tests;

pub use paint::{Memory, Paint, Painted};
pub use prune::prune;

use super::habit::Habit;
use super::volume::Swept;

/// Age of a plant whose leaves painted leaves are like, years.
pub const PAINTED_AGE: f32 = 10.0;

/// A stroke of a brush that paints leaves or flowers on wood.
pub struct Furnish<'a> {
    /// What it sweeps.
    pub swept: &'a Swept,
    /// How densely: 1 is as usual.
    pub density: f32,
    /// How the plant grows.
    pub habit: &'a Habit,
    /// Most leaves or flowers.
    pub most: usize,
    /// Seed of everything random, and of names.
    pub seed: u64,
}
