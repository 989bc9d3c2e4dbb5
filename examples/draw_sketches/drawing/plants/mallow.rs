//! Common mallow: an upright stem, long-stalked round leaves, flowers from the leaf axils.

use super::super::flower::Flower;
use super::super::forms::{MALLOW_LEAF, MALLOW_PETAL};
use super::super::hand::{Hand, at};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("mallow", [768, 1024], 21);
    let flower = |x, y, size, faces, lift, turn| Flower {
        turn,
        opening: 62.0,
        ..Flower::new(at(x, y), size, faces, lift)
    };
    let terminal = flower(422.0, 206.0, 186.0, 76.0, 58.0, 18.0);
    let rise = [at(424.0, 1000.0), at(414.0, 870.0), at(370.0, 700.0), at(364.0, 540.0), at(388.0, 400.0)];
    let stem = terminal.stalk(&mut hand, &rise, [0.9, 0.38]);
    terminal.draw(&mut hand, &MALLOW_PETAL);
    for (flower, node) in [
        (flower(170.0, 352.0, 148.0, 142.0, 50.0, 40.0), 0.69),
        (Flower { opening: 52.0, ..flower(606.0, 436.0, 142.0, 36.0, 46.0, 5.0) }, 0.56),
    ] {
        let from = stem.point(node);
        flower.stalk(&mut hand, &[from, from.lerp(flower.heart, 0.4) + at(0.0, -6.0)], [0.48, 0.32]);
        flower.draw(&mut hand, &MALLOW_PETAL);
    }
    let leaves = [
        (Leaf::new(at(208.0, 590.0), 152.0, 180.0).bent(-8.0, 8.0).turned(1.0, 0.76), 0.46),
        (Leaf::new(at(532.0, 686.0), 26.0, 214.0).bent(10.0, -6.0).turned(0.8, 1.0), 0.32),
        (Leaf::new(at(246.0, 806.0), 186.0, 216.0).bent(-8.0, 8.0).turned(0.82, 1.0), 0.21),
        (Leaf::new(at(556.0, 910.0), -4.0, 176.0).bent(8.0, -8.0).turned(1.0, 0.78), 0.09),
    ];
    for (leaf, node) in &leaves {
        let from = stem.point(*node);
        hand.branch(&[from, from.lerp(leaf.base, 0.5) + at(0.0, -16.0), leaf.base], [0.5, 0.32]);
        leaf.draw(&mut hand, &MALLOW_LEAF);
    }
    hand.finish()
}
