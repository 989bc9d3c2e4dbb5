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
    let flower = |x, y, size, faces, lift, turn| Flower {
        turn,
        opening: 64.0,
        swing: 22.0,
        width: 1.12,
        ..Flower::new(at(x, y), size, faces, lift)
    };
    let terminal = flower(436.0, 206.0, 184.0, 78.0, 60.0, 10.0);
    let climb = [
        at(214.0, 1004.0),
        at(258.0, 910.0),
        at(380.0, 790.0),
        at(424.0, 640.0),
        at(376.0, 500.0),
        at(388.0, 390.0),
    ];
    let vine = terminal.stalk(&mut hand, &climb, [0.72, 0.3]);
    terminal.draw(&mut hand, &JASMINE_PETAL);
    for (flower, node) in [
        (flower(172.0, 308.0, 148.0, 142.0, 50.0, 30.0), 0.735),
        (flower(618.0, 424.0, 142.0, 26.0, 48.0, 50.0), 0.66),
        (Flower { opening: 42.0, ..flower(224.0, 514.0, 92.0, 150.0, 36.0, 0.0) }, 0.59),
    ] {
        let from = vine.point(node);
        flower.stalk(&mut hand, &[from, from.lerp(flower.heart, 0.45) + at(0.0, 10.0)], [0.42, 0.28]);
        flower.draw(&mut hand, &JASMINE_PETAL);
    }
    for leaf in [
        Pinnate { node: vine.point(0.44), aim: -4.0, length: 258.0, sag: 14.0, pairs: 2 },
        Pinnate { node: vine.point(0.345), aim: 168.0, length: 296.0, sag: -14.0, pairs: 2 },
        Pinnate { node: vine.point(0.22), aim: -16.0, length: 300.0, sag: 16.0, pairs: 2 },
        Pinnate { node: vine.point(0.11), aim: 156.0, length: 190.0, sag: -12.0, pairs: 1 },
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
    let blade = leaf.length * 0.37;
    for pair in 0..leaf.pairs {
        let along = 0.4 + 0.36 * f64::from(pair);
        for side in [1.0, -1.0] {
            let base = rachis.point(along + side * 0.02);
            let aim = rachis.heading(along) + side * (60.0 + hand.vary(6.0));
            Leaf::new(base, aim, blade * (1.0 - 0.06 * f64::from(pair)) * (1.0 + hand.vary(0.06)))
                .bent(side * 12.0, -side * 16.0)
                .turned(1.0 - 0.12 * side, 1.0 + 0.12 * side)
                .draw_as("leaf", hand, &JASMINE_LEAF);
        }
    }
    Leaf::new(end, rachis.heading(0.97), blade * 1.22).bent(8.0, -12.0).draw_as("leaf", hand, &JASMINE_LEAF);
}
