//! Balloon flower: broad pointed bells on an upright stem with alternate toothed leaves.

use super::super::flower::Flower;
use super::super::forms::{BALLOON_LEAF, BALLOON_PETAL};
use super::super::hand::{Hand, at};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("balloon_flower", [768, 1024], 41);
    let upper = Flower { opening: 56.0, turn: 20.0, ..Flower::new(at(300.0, 244.0), 240.0, 104.0, 54.0) };
    let lower = Flower { opening: 50.0, turn: 44.0, ..Flower::new(at(574.0, 424.0), 180.0, 36.0, 44.0) };
    let stem = upper.stalk(
        &mut hand,
        &[at(420.0, 1004.0), at(428.0, 880.0), at(390.0, 700.0), at(352.0, 520.0)],
        [0.76, 0.36],
    );
    lower.stalk(&mut hand, &[stem.point(0.46), at(424.0, 600.0), at(486.0, 510.0)], [0.5, 0.34]);
    upper.draw(&mut hand, &BALLOON_PETAL);
    lower.draw(&mut hand, &BALLOON_PETAL);
    for (node, aim, length, bend, sides) in [
        (0.08, 160.0, 284.0, -12.0, [1.0, 0.82]),
        (0.16, 12.0, 292.0, 16.0, [0.8, 1.05]),
        (0.25, 158.0, 282.0, -16.0, [1.1, 0.8]),
        (0.34, 16.0, 272.0, 14.0, [0.78, 1.0]),
        (0.44, 150.0, 226.0, -18.0, [1.0, 0.75]),
        (0.57, 138.0, 160.0, -12.0, [0.8, 1.0]),
        (0.65, 44.0, 116.0, 12.0, [1.0, 0.85]),
    ] {
        Leaf::new(stem.point(node), aim, length)
            .bent(0.5 * bend, -1.3 * bend)
            .turned(sides[0], sides[1])
            .draw(&mut hand, &BALLOON_LEAF);
    }
    hand.finish()
}
