//! Common mallow: an upright stem, long-stalked round leaves, flowers from the leaf axils.

use super::super::flower::Flower;
use super::super::forms::{MALLOW_LEAF, MALLOW_PETAL};
use super::super::hand::{Hand, at};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("mallow", [768, 1024], 21);
    let stem = hand.branch(
        &[at(352.0, 990.0), at(372.0, 830.0), at(356.0, 650.0), at(384.0, 470.0), at(372.0, 330.0), at(392.0, 230.0)],
        [0.85, 0.36],
    );
    let flower =
        |x, y, size, faces, lift, turn| Flower { turn, opening: 62.0, ..Flower::new(at(x, y), size, faces, lift) };
    let flowers = [
        (flower(412.0, 172.0, 148.0, 74.0, 52.0, 18.0), 0.95),
        (flower(196.0, 372.0, 130.0, 140.0, 46.0, 40.0), 0.62),
        (flower(588.0, 452.0, 126.0, 34.0, 44.0, 5.0), 0.5),
    ];
    for (flower, node) in &flowers {
        let from = stem.point(*node);
        flower.stalk(&mut hand, &[from, from.lerp(flower.heart, 0.4) + at(0.0, -6.0)], [0.48, 0.32]);
        flower.draw(&mut hand, &MALLOW_PETAL);
    }
    let leaves = [
        (Leaf::new(at(192.0, 700.0), 166.0, 178.0).bent(-8.0, 8.0).turned(1.0, 0.82), 0.3),
        (Leaf::new(at(560.0, 724.0), 12.0, 182.0).bent(10.0, -6.0).turned(0.84, 1.0), 0.2),
        (Leaf::new(at(240.0, 872.0), 192.0, 140.0).bent(-8.0, 8.0).turned(0.8, 1.0), 0.1),
    ];
    for (leaf, node) in &leaves {
        let from = stem.point(*node);
        hand.branch(&[from, from.lerp(leaf.base, 0.5) + at(0.0, -16.0), leaf.base], [0.5, 0.32]);
        leaf.draw(&mut hand, &MALLOW_LEAF);
    }
    hand.finish()
}
