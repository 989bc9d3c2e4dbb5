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
        ..Flower::new(at(438.0, 268.0), 205.0, 66.0, 50.0)
    };
    let young =
        Flower { petals: 15, opening: 58.0, turn: 3.0, ..Flower::new(at(192.0, 470.0), 128.0, 118.0, 34.0) };
    open.stalk(&mut hand, &[at(368.0, 892.0), at(362.0, 760.0), at(372.0, 600.0), at(398.0, 430.0)], [0.68, 0.4]);
    young.stalk(&mut hand, &[at(350.0, 894.0), at(318.0, 790.0), at(268.0, 670.0)], [0.56, 0.32]);
    open.draw(&mut hand, &DAISY_PETAL);
    young.draw(&mut hand, &DAISY_PETAL);
    let base = at(360.0, 893.0);
    for leaf in [
        Leaf::new(base + at(-8.0, -2.0), 171.0, 252.0).bent(-32.0, 30.0).turned(0.95, 0.72),
        Leaf::new(base + at(-5.0, -4.0), 136.0, 190.0).bent(-18.0, 30.0).turned(0.7, 1.0),
        Leaf::new(base + at(7.0, -6.0), 58.0, 206.0).bent(14.0, -26.0).turned(1.0, 0.75),
        Leaf::new(base + at(11.0, -2.0), 20.0, 262.0).bent(30.0, -32.0).turned(0.72, 1.0),
        Leaf::new(base + at(3.0, 3.0), -21.0, 196.0).bent(24.0, -24.0).turned(1.0, 0.8),
        Leaf::new(base + at(-3.0, 4.0), 204.0, 170.0).bent(-20.0, 22.0).turned(0.8, 1.05),
    ] {
        leaf.draw_as("leaf", &mut hand, &DAISY_LEAF);
    }
    hand.finish()
}
