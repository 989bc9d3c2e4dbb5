//! Balloon flower: broad pointed bells on an upright stem with alternate toothed leaves.

use super::super::flower::Flower;
use super::super::forms::{BALLOON_LEAF, BALLOON_PETAL};
use super::super::hand::{Hand, at};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("balloon_flower", [768, 1024], 41);
    let upper = Flower { opening: 56.0, turn: 20.0, ..Flower::new(at(328.0, 226.0), 214.0, 104.0, 48.0) };
    let lower = Flower { opening: 50.0, turn: 44.0, ..Flower::new(at(560.0, 432.0), 168.0, 32.0, 40.0) };
    let stem = upper.stalk(
        &mut hand,
        &[at(452.0, 1000.0), at(430.0, 860.0), at(392.0, 690.0), at(366.0, 500.0)],
        [0.76, 0.36],
    );
    lower.stalk(&mut hand, &[stem.point(0.42), at(440.0, 560.0), at(494.0, 486.0)], [0.5, 0.34]);
    upper.draw(&mut hand, &BALLOON_PETAL);
    lower.draw(&mut hand, &BALLOON_PETAL);
    for (node, aim, length, bend, sides) in [
        (0.1, 168.0, 236.0, -18.0, [1.0, 0.75]),
        (0.19, 14.0, 244.0, 20.0, [0.75, 1.0]),
        (0.29, 158.0, 228.0, -20.0, [1.05, 0.7]),
        (0.37, 2.0, 216.0, 24.0, [0.7, 1.0]),
        (0.5, 152.0, 176.0, -22.0, [1.0, 0.7]),
        (0.64, 138.0, 122.0, -18.0, [0.8, 1.0]),
        (0.7, 42.0, 96.0, 16.0, [1.0, 0.8]),
    ] {
        Leaf::new(stem.point(node), aim, length)
            .bent(bend, -1.2 * bend)
            .turned(sides[0], sides[1])
            .draw(&mut hand, &BALLOON_LEAF);
    }
    hand.finish()
}
