//! Jasmine: a twining shoot with opposite pinnate leaves and a cyme of pinwheel flowers at its end.

use super::super::flower::Flower;
use super::super::forms::{JASMINE_LEAF, JASMINE_PETAL};
use super::super::hand::{Hand, at, toward};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;
use glam::DVec2;

/// A pinnate leaf: where its rachis starts, where it aims, how long it is and how it sags (degrees, counter-clockwise).
struct Pinnate {
    node: DVec2,
    aim: f64,
    length: f64,
    sag: f64,
    pairs: u32,
}

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("jasmine", [768, 1024], 31);
    let vine = hand.branch(
        &[at(196.0, 996.0), at(250.0, 880.0), at(368.0, 760.0), at(420.0, 610.0), at(384.0, 470.0), at(392.0, 372.0)],
        [0.72, 0.36],
    );
    let flower = |x, y, size, faces, lift, turn| Flower {
        turn,
        opening: 66.0,
        swing: 12.0,
        ..Flower::new(at(x, y), size, faces, lift)
    };
    let flowers = [
        (flower(430.0, 196.0, 146.0, 80.0, 56.0, 10.0), 0.97),
        (flower(206.0, 280.0, 124.0, 140.0, 46.0, 30.0), 0.92),
        (flower(612.0, 352.0, 122.0, 30.0, 44.0, 50.0), 0.87),
        (Flower { opening: 46.0, ..flower(206.0, 508.0, 88.0, 156.0, 34.0, 0.0) }, 0.72),
    ];
    for (flower, node) in &flowers {
        let from = vine.point(*node);
        flower.stalk(&mut hand, &[from, from.lerp(flower.heart, 0.45) + at(0.0, 10.0)], [0.42, 0.28]);
        flower.draw(&mut hand, &JASMINE_PETAL);
    }
    for leaf in [
        Pinnate { node: vine.point(0.56), aim: 4.0, length: 236.0, sag: 24.0, pairs: 2 },
        Pinnate { node: vine.point(0.36), aim: 152.0, length: 250.0, sag: -22.0, pairs: 2 },
        Pinnate { node: vine.point(0.33), aim: -26.0, length: 250.0, sag: 26.0, pairs: 2 },
        Pinnate { node: vine.point(0.1), aim: 128.0, length: 140.0, sag: -22.0, pairs: 1 },
    ] {
        pinnate(&mut hand, &leaf);
    }
    hand.finish()
}

fn pinnate(hand: &mut Hand, leaf: &Pinnate) {
    let half = leaf.length * 0.5;
    let middle = leaf.node + toward(leaf.aim + leaf.sag * 0.7) * half;
    let end = leaf.node + toward(leaf.aim) * leaf.length * 0.78;
    let rachis = hand.branch(&[leaf.node, middle, end], [0.4, 0.24]);
    let blade = leaf.length * 0.46;
    for pair in 0..leaf.pairs {
        let along = 0.42 + 0.34 * f64::from(pair);
        for side in [1.0, -1.0] {
            let base = rachis.point(along + side * 0.02);
            let aim = rachis.heading(along) + side * (54.0 + hand.vary(6.0));
            Leaf::new(base, aim, blade * (1.0 - 0.06 * f64::from(pair)) * (1.0 + hand.vary(0.06)))
                .bent(side * 12.0, -side * 16.0)
                .turned(1.0 - 0.12 * side, 1.0 + 0.12 * side)
                .draw_as("leaf", hand, &JASMINE_LEAF);
        }
    }
    Leaf::new(end, rachis.heading(0.97), blade * 1.22).bent(8.0, -12.0).draw_as("leaf", hand, &JASMINE_LEAF);
}
