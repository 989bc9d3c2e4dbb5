//! Brushes in the space of the plant (001 §4.4): what a ball sweeps is filled with wood and leaves, or emptied.
//!
//! | room | what |
//! | --- | --- |
//! | `nearby` | which wood of the plant a stroke reaches, and a lead to it where it reaches none |
//! | `own_leaves` | the leaves that the plant has already, for those that grow |
//! | `paint` | growth in what a growth brush sweeps |
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
mod prune;
#[cfg(test)]
mod tests;

pub use paint::{Memory, Paint, Painted};
pub use prune::prune;
