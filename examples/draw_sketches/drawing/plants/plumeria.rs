//! Plumeria: a stout branch, long leaves crowded at its end, and a cluster of waxy overlapping flowers.

use super::super::flower::Flower;
use super::super::forms::{PLUMERIA_LEAF, PLUMERIA_PETAL};
use super::super::hand::{Hand, at};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("plumeria", [768, 1024], 51);
    let branch = hand.branch(
        &[at(338.0, 1006.0), at(366.0, 930.0), at(380.0, 830.0), at(370.0, 730.0), at(384.0, 640.0)],
        [1.0, 0.72],
    );
    let flower = |x, y, size, faces, lift, turn| Flower {
        turn,
        opening: 56.0,
        swing: 16.0,
        ..Flower::new(at(x, y), size, faces, lift)
    };
    let terminal = flower(416.0, 196.0, 182.0, 80.0, 58.0, 12.0);
    let rise = [branch.point(0.97), at(396.0, 570.0), at(388.0, 490.0), at(400.0, 400.0)];
    let peduncle = terminal.stalk(&mut hand, &rise, [0.56, 0.36]);
    terminal.draw(&mut hand, &PLUMERIA_PETAL);
    for (flower, node) in [
        (flower(160.0, 334.0, 152.0, 140.0, 50.0, 36.0), 0.36),
        (flower(606.0, 386.0, 160.0, 34.0, 54.0, 60.0), 0.27),
        (Flower { opening: 50.0, ..flower(290.0, 494.0, 104.0, 128.0, 56.0, 24.0) }, 0.17),
    ] {
        let from = peduncle.point(node);
        flower.stalk(&mut hand, &[from, from.lerp(flower.heart, 0.4) + at(0.0, 8.0)], [0.44, 0.34]);
        flower.draw(&mut hand, &PLUMERIA_PETAL);
    }
    for (node, aim, length, bend, sides) in [
        (0.93, 171.0, 344.0, -18.0, [1.0, 0.75]),
        (0.84, 194.0, 356.0, -22.0, [1.1, 0.85]),
        (0.73, 222.0, 330.0, -20.0, [0.8, 1.0]),
        (0.9, 12.0, 352.0, 20.0, [0.75, 1.0]),
        (0.8, -12.0, 376.0, 22.0, [0.85, 1.1]),
        (0.7, -40.0, 334.0, 18.0, [1.05, 0.8]),
    ] {
        Leaf::new(branch.point(node), aim, length).bent(bend, -bend).turned(sides[0], sides[1]).draw_as(
            "leaf",
            &mut hand,
            &PLUMERIA_LEAF,
        );
    }
    hand.finish()
}
