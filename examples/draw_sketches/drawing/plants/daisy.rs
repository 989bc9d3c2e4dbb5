//! Daisy: two leafless scapes over a rosette of spoon-shaped leaves.

use super::super::flower::Flower;
use super::super::forms::{DAISY_LEAF, DAISY_PETAL};
use super::super::hand::{Hand, at};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("daisy", [768, 1024], 7);
    let open = Flower {
        petals: 19,
        opening: 68.0,
        recurve: 6.0,
        turn: 8.0,
        ..Flower::new(at(452.0, 262.0), 222.0, 64.0, 54.0)
    };
    let young =
        Flower { petals: 15, opening: 56.0, turn: 3.0, ..Flower::new(at(170.0, 494.0), 140.0, 118.0, 38.0) };
    let tall = [at(368.0, 878.0), at(352.0, 760.0), at(358.0, 600.0), at(398.0, 430.0)];
    open.stalk(&mut hand, &tall, [0.68, 0.42]);
    young.stalk(&mut hand, &[at(350.0, 880.0), at(322.0, 790.0), at(252.0, 672.0)], [0.56, 0.34]);
    open.draw(&mut hand, &DAISY_PETAL);
    young.draw(&mut hand, &DAISY_PETAL);
    let base = at(360.0, 880.0);
    for leaf in [
        Leaf::new(base + at(-8.0, -2.0), 167.0, 306.0).bent(-30.0, 26.0).turned(0.95, 0.74),
        Leaf::new(base + at(-5.0, -4.0), 141.0, 222.0).bent(-12.0, 34.0).turned(0.72, 1.0),
        Leaf::new(base + at(7.0, -6.0), 52.0, 250.0).bent(16.0, -30.0).turned(1.0, 0.7),
        Leaf::new(base + at(11.0, -2.0), 13.0, 330.0).bent(30.0, -26.0).turned(0.74, 1.0),
        Leaf::new(base + at(4.0, 3.0), -18.0, 226.0).bent(26.0, -30.0).turned(1.1, 0.8),
        Leaf::new(base + at(-3.0, 4.0), 207.0, 190.0).bent(-24.0, 16.0).turned(0.85, 1.1),
    ] {
        leaf.draw_as("leaf", &mut hand, &DAISY_LEAF);
    }
    hand.finish()
}
