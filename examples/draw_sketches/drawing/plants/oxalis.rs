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
        hand.branch(&[at(384.0, 972.0), at(420.0, 800.0), at(386.0, 600.0), at(404.0, 440.0)], [0.5, 0.36]);
    let flower = |x, y, size, faces, lift, turn| Flower {
        turn,
        opening: 58.0,
        ..Flower::new(at(x, y), size, faces, lift)
    };
    for flower in [
        flower(440.0, 200.0, 178.0, 74.0, 58.0, 14.0),
        flower(180.0, 328.0, 152.0, 140.0, 48.0, 40.0),
        Flower { opening: 48.0, ..flower(606.0, 414.0, 140.0, 34.0, 46.0, 62.0) },
    ] {
        let from = umbel.point(0.99);
        flower.stalk(&mut hand, &[from, from.lerp(flower.heart, 0.4) + at(0.0, 6.0)], [0.38, 0.28]);
        flower.draw(&mut hand, &OXALIS_PETAL);
    }
    for leaf in [
        Trifoliate {
            from: at(378.0, 974.0),
            over: at(340.0, 800.0),
            end: at(190.0, 612.0),
            size: 164.0,
            aim: 114.0,
            depth: 0.74,
        },
        Trifoliate {
            from: at(394.0, 974.0),
            over: at(486.0, 840.0),
            end: at(582.0, 694.0),
            size: 172.0,
            aim: 46.0,
            depth: 0.7,
        },
        Trifoliate {
            from: at(372.0, 978.0),
            over: at(300.0, 900.0),
            end: at(184.0, 838.0),
            size: 150.0,
            aim: 152.0,
            depth: 0.62,
        },
        Trifoliate {
            from: at(400.0, 978.0),
            over: at(480.0, 930.0),
            end: at(566.0, 916.0),
            size: 118.0,
            aim: 12.0,
            depth: 0.6,
        },
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
        let breadth = 1.1 * (leaf.depth / seen.length()).clamp(0.78, 1.15);
        let droop = 10.0 * seen.x;
        Leaf::new(leaf.end + seen * leaf.size * 0.05, aim, leaf.size * seen.length())
            .bent(droop, -droop)
            .turned(breadth * (1.0 + hand.vary(0.08)), breadth * (1.0 + hand.vary(0.08)))
            .draw_as("leaf", hand, &OXALIS_LEAF);
    }
}
