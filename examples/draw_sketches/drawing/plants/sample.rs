//! The first drawing a new user sees: one graceful flower, a younger one, and long leaves.

use super::super::flower::Flower;
use super::super::forms::{HEPATICA_PETAL, PLUMERIA_LEAF};
use super::super::hand::{Hand, at};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("hepatica_red", [768, 1024], 111);
    let open = Flower {
        petals: 9,
        opening: 63.0,
        turn: 14.0,
        width: 0.95,
        ..Flower::new(at(452.0, 286.0), 232.0, 60.0, 54.0)
    };
    let young = Flower { petals: 6, opening: 46.0, ..Flower::new(at(182.0, 392.0), 134.0, 122.0, 40.0) };
    let rise = [at(334.0, 1000.0), at(368.0, 880.0), at(352.0, 720.0), at(346.0, 580.0), at(392.0, 440.0)];
    let stem = open.stalk(&mut hand, &rise, [0.76, 0.4]);
    young.stalk(&mut hand, &[stem.point(0.4), at(304.0, 620.0), at(226.0, 524.0)], [0.5, 0.34]);
    open.draw(&mut hand, &HEPATICA_PETAL);
    young.draw(&mut hand, &HEPATICA_PETAL);
    for (node, aim, length, bend, sides) in [
        (0.09, 156.0, 280.0, -22.0, [1.0, 0.8]),
        (0.16, 26.0, 340.0, 26.0, [0.75, 1.0]),
        (0.26, 152.0, 256.0, -24.0, [1.05, 0.75]),
        (0.37, 36.0, 264.0, 24.0, [0.8, 1.05]),
    ] {
        Leaf::new(stem.point(node), aim, length)
            .bent(bend, -1.6 * bend)
            .turned(sides[0], sides[1])
            .draw(&mut hand, &PLUMERIA_LEAF);
    }
    hand.finish()
}
