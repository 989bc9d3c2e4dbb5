//! What kind of plant a drawing looks like as a whole, as learned from drawings by people.
//!
//! A small neural network judges the [`features`] of a drawing: standardised numbers, a hidden layer of rectified sums, one
//! sum for each [`Class`] and the softmax of these. It knows nothing of single strokes; ways of drawing are read by rules
//! (`conventions`), and the network says which of the readings are likely. Trained by `examples/train_habits`; figures in
//! `docs/classifier.md`.

mod features;
mod network;

pub use features::{FEATURES, features};
pub use network::{CLASSES, Class, HIDDEN, Likeness, Network, NetworkError};

use glam::Vec2;
use std::sync::LazyLock;

/// The network that ships with the program, part of it like its code: a test reads it.
static BUILT_IN: LazyLock<Option<Network>> =
    LazyLock::new(|| Network::read(include_bytes!("../../../assets/classifier/habits.bin")).ok());

/// What a drawing of these lines looks like, by the network that ships with the program; nothing if it has no extent.
pub fn likeness<L: AsRef<[Vec2]>>(lines: &[L]) -> Option<Likeness> {
    BUILT_IN.as_ref()?.likeness(lines)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_network_that_ships_can_be_read() {
        assert!(BUILT_IN.is_some());
    }
}
