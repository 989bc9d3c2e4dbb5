//! Oxalis: clover-like leaves of three hearts and small umbels, all from a bulb.

use super::super::flower::Flower;
use super::super::forms::{OXALIS_LEAF, OXALIS_PETAL};
use super::super::hand::{Hand, at, toward};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;
use glam::DVec2;

/// A leaf of three hearts: the end of its stalk, the size of a leaflet, the direction in which the middle one points
/// and how much of its depth is seen.
struct Trifoliate {
    from: DVec2,
    over: DVec2,
    end: DVec2,
    size: f64,
    aim: f64,
    depth: f64,
}

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("oxalis", [768, 1024], 61);
    let umbel =
        hand.branch(&[at(394.0, 960.0), at(412.0, 800.0), at(398.0, 600.0), at(408.0, 420.0)], [0.5, 0.36]);
    let flower =
        |x, y, size, faces, lift, turn| Flower { turn, opening: 58.0, ..Flower::new(at(x, y), size, faces, lift) };
    for flower in [
        flower(430.0, 210.0, 146.0, 78.0, 52.0, 14.0),
        flower(214.0, 306.0, 128.0, 136.0, 44.0, 40.0),
        flower(606.0, 352.0, 126.0, 36.0, 42.0, 62.0),
    ] {
        let from = umbel.point(0.99);
        flower.stalk(&mut hand, &[from, from.lerp(flower.heart, 0.4) + at(0.0, 6.0)], [0.38, 0.28]);
        flower.draw(&mut hand, &OXALIS_PETAL);
    }
    for leaf in [
        Trifoliate { from: at(386.0, 962.0), over: at(330.0, 800.0), end: at(196.0, 612.0), size: 132.0, aim: 116.0, depth: 0.72 },
        Trifoliate { from: at(400.0, 962.0), over: at(466.0, 800.0), end: at(590.0, 634.0), size: 138.0, aim: 62.0, depth: 0.72 },
        Trifoliate { from: at(382.0, 964.0), over: at(300.0, 880.0), end: at(168.0, 832.0), size: 112.0, aim: 152.0, depth: 0.66 },
        Trifoliate { from: at(404.0, 964.0), over: at(490.0, 890.0), end: at(612.0, 856.0), size: 116.0, aim: 24.0, depth: 0.66 },
    ] {
        trifoliate(&mut hand, &leaf);
    }
    hand.finish()
}

fn trifoliate(hand: &mut Hand, leaf: &Trifoliate) {
    hand.branch(&[leaf.from, leaf.over, leaf.end], [0.4, 0.26]);
    for third in [0.0, 120.0, 240.0] {
        let flat = toward(leaf.aim + third + hand.vary(5.0));
        let seen = DVec2::new(flat.x, flat.y * leaf.depth);
        let aim = (-seen.y).atan2(seen.x).to_degrees();
        let breadth = (leaf.depth / seen.length()).clamp(0.7, 1.15);
        let droop = 10.0 * seen.x;
        Leaf::new(leaf.end + seen * leaf.size * 0.05, aim, leaf.size * seen.length())
            .bent(droop, -droop)
            .turned(breadth * (1.0 + hand.vary(0.08)), breadth * (1.0 + hand.vary(0.08)))
            .draw_as("leaf", hand, &OXALIS_LEAF);
    }
}
