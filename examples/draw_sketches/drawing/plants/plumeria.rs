//! Plumeria: a stout forked branch, long leaves crowded at its end, and a cluster of waxy overlapping flowers.

use super::super::flower::Flower;
use super::super::forms::{PLUMERIA_LEAF, PLUMERIA_PETAL};
use super::super::hand::{Hand, at};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("plumeria", [768, 1024], 51);
    let branch = hand.branch(
        &[at(330.0, 1000.0), at(346.0, 900.0), at(388.0, 790.0), at(394.0, 690.0), at(388.0, 600.0)],
        [1.0, 0.72],
    );
    hand.branch(&[branch.point(0.3), at(300.0, 850.0), at(262.0, 806.0)], [0.8, 0.62]);
    let peduncle = hand.branch(&[branch.point(0.96), at(398.0, 540.0), at(392.0, 470.0), at(402.0, 410.0)], [0.55, 0.42]);
    let flower = |x, y, size, faces, lift, turn| Flower {
        turn,
        opening: 56.0,
        swing: 16.0,
        ..Flower::new(at(x, y), size, faces, lift)
    };
    let flowers = [
        (flower(430.0, 196.0, 156.0, 78.0, 54.0, 12.0), 0.98),
        (flower(212.0, 300.0, 142.0, 138.0, 46.0, 36.0), 0.72),
        (flower(604.0, 372.0, 138.0, 34.0, 48.0, 60.0), 0.5),
        (Flower { opening: 50.0, ..flower(318.0, 452.0, 112.0, 168.0, 62.0, 24.0) }, 0.34),
    ];
    for (flower, node) in &flowers {
        let from = peduncle.point(*node);
        flower.stalk(&mut hand, &[from, from.lerp(flower.heart, 0.4) + at(0.0, 8.0)], [0.42, 0.34]);
        flower.draw(&mut hand, &PLUMERIA_PETAL);
    }
    for (node, aim, length, bend, sides) in [
        (0.9, 168.0, 330.0, -20.0, [1.0, 0.7]),
        (0.84, 196.0, 348.0, -26.0, [1.05, 0.8]),
        (0.72, 226.0, 300.0, -22.0, [0.8, 1.0]),
        (0.9, 8.0, 336.0, 22.0, [0.72, 1.0]),
        (0.82, -22.0, 356.0, 24.0, [0.85, 1.05]),
        (0.7, -52.0, 290.0, 20.0, [1.0, 0.8]),
    ] {
        Leaf::new(branch.point(node), aim, length)
            .bent(bend, -bend)
            .turned(sides[0], sides[1])
            .draw_as("leaf", &mut hand, &PLUMERIA_LEAF);
    }
    hand.finish()
}
