//! The shoots that leaves of trees wear: which leaves they have, and how these stand. In a picture leaves hardly overlap, else a shoot
//! looks like one serrated leaf.

use super::leaf::{Leaf, palmate, pinnate};
use super::leafy_shoot::{LeafyShoot, Order, Outline};
use super::needles::Shoot;

/// Shoots of broad-leaved trees, with their names.
pub(crate) fn leafy() -> Vec<(&'static str, LeafyShoot)> {
    [of_forests(), of_rivers(), of_hedges(), of_orchards(), lobed()].into_iter().flatten().collect()
}

/// Large trees.
fn of_forests() -> Vec<(&'static str, LeafyShoot)> {
    let linden = LeafyShoot {
        width: 0.8,
        leaves: 6,
        length: 0.27,
        angle: 62.0,
        order: Order::Alternate,
        stalk: 0.3,
        outline: Outline::Entire,
        half_width: 0.42,
        taper: (0.32, 0.95),
        leaf: pinnate(0x6c9a48, 0x486f34, 0xaec888, 5.0, 0.42, 601),
        bark: 0x8a7a50,
        seed: 603,
    };
    let beech = LeafyShoot {
        width: 0.64,
        leaves: 8,
        length: 0.25,
        angle: 58.0,
        order: Order::Alternate,
        stalk: 0.08,
        outline: Outline::Entire,
        half_width: 0.3,
        taper: (0.6, 0.8),
        leaf: pinnate(0x5c9344, 0x3e6e30, 0xa2c480, 8.0, 0.3, 607),
        bark: 0x7a6448,
        seed: 611,
    };
    let poplar = LeafyShoot {
        width: 0.8,
        leaves: 8,
        length: 0.22,
        angle: 56.0,
        order: Order::Alternate,
        stalk: 0.5,
        outline: Outline::Entire,
        half_width: 0.44,
        taper: (0.42, 0.9),
        leaf: pinnate(0x6a9c46, 0x4a7434, 0xb8cc80, 5.0, 0.5, 641),
        bark: 0x9a8a58,
        seed: 643,
    };
    vec![("shoot_linden", linden), ("shoot_beech", beech), ("shoot_poplar", poplar)]
}

/// A willow's whip with narrow leaves, and the leaf of a rowan, which is one of many leaflets in pairs.
fn of_rivers() -> Vec<(&'static str, LeafyShoot)> {
    let willow = LeafyShoot {
        width: 0.44,
        leaves: 10,
        length: 0.34,
        angle: 32.0,
        order: Order::Alternate,
        stalk: 0.06,
        outline: Outline::Entire,
        half_width: 0.07,
        taper: (0.8, 1.15),
        leaf: pinnate(0x86ac4c, 0x648c3c, 0xc0d48c, 9.0, 0.6, 733),
        bark: 0xa89c4c,
        seed: 739,
    };
    let rowan = LeafyShoot {
        width: 0.56,
        leaves: 14,
        length: 0.25,
        angle: 64.0,
        order: Order::Pinnate,
        stalk: 0.02,
        outline: Outline::Entire,
        half_width: 0.13,
        taper: (0.5, 0.7),
        leaf: pinnate(0x5a8a40, 0x3e6c32, 0xa0c07c, 9.0, 0.35, 743),
        bark: 0x7c9850,
        seed: 751,
    };
    vec![("shoot_willow", willow), ("shoot_rowan", rowan)]
}

/// Small trees and shrubs.
fn of_hedges() -> Vec<(&'static str, LeafyShoot)> {
    let birch = LeafyShoot {
        width: 0.72,
        leaves: 8,
        length: 0.2,
        angle: 60.0,
        order: Order::Alternate,
        stalk: 0.4,
        outline: Outline::Entire,
        half_width: 0.38,
        taper: (0.4, 1.0),
        leaf: pinnate(0x7aa84a, 0x55803a, 0xb4cc84, 6.0, 0.4, 619),
        bark: 0x6c4c40,
        seed: 631,
    };
    let hazel = LeafyShoot {
        width: 0.84,
        leaves: 4,
        length: 0.3,
        angle: 60.0,
        order: Order::Alternate,
        stalk: 0.14,
        outline: Outline::Entire,
        half_width: 0.38,
        taper: (0.45, 0.75),
        leaf: pinnate(0x78a048, 0x547a38, 0xb2c884, 6.0, 0.4, 673),
        bark: 0x9a8460,
        seed: 677,
    };
    let box_tree = LeafyShoot {
        width: 0.6,
        leaves: 8,
        length: 0.26,
        angle: 58.0,
        order: Order::Crosswise,
        stalk: 0.06,
        outline: Outline::Entire,
        half_width: 0.27,
        taper: (0.5, 0.5),
        leaf: pinnate(0x4c7a38, 0x335a2a, 0x88a868, 8.0, 0.3, 701),
        bark: 0x8a8a50,
        seed: 709,
    };
    vec![("shoot_birch", birch), ("shoot_hazel", hazel), ("shoot_box", box_tree)]
}

/// Trees that bear fruit.
fn of_orchards() -> Vec<(&'static str, LeafyShoot)> {
    let apple = LeafyShoot {
        width: 0.76,
        leaves: 5,
        length: 0.26,
        angle: 58.0,
        order: Order::Alternate,
        stalk: 0.28,
        outline: Outline::Entire,
        half_width: 0.33,
        taper: (0.5, 0.75),
        leaf: pinnate(0x648f40, 0x42692f, 0xa9c080, 6.0, 0.34, 659),
        bark: 0x80644c,
        seed: 661,
    };
    let olive = LeafyShoot {
        width: 0.5,
        leaves: 10,
        length: 0.27,
        angle: 48.0,
        order: Order::Crosswise,
        stalk: 0.06,
        outline: Outline::Entire,
        half_width: 0.095,
        taper: (0.6, 0.75),
        leaf: pinnate(0x74885c, 0x566a46, 0xb4c0a0, 5.0, 0.6, 683),
        bark: 0x9c9480,
        seed: 691,
    };
    vec![("shoot_apple", apple), ("shoot_olive", olive)]
}

/// Leaves with lobes.
fn lobed() -> Vec<(&'static str, LeafyShoot)> {
    const MAPLE: &[f32] = &[0.0, -38.0, 38.0, -78.0, 78.0, -122.0, 122.0];
    let oak = LeafyShoot {
        width: 0.8,
        leaves: 7,
        length: 0.3,
        angle: 56.0,
        order: Order::Alternate,
        stalk: 0.04,
        outline: Outline::Lobed { lobes: 4.5, depth: 0.42 },
        half_width: 0.3,
        taper: (0.95, 0.5),
        leaf: pinnate(0x55803c, 0x36592a, 0x98b070, 4.5, 0.3, 613),
        bark: 0x7c6a54,
        seed: 617,
    };
    let maple = LeafyShoot {
        width: 1.1,
        leaves: 2,
        length: 0.35,
        angle: 50.0,
        order: Order::Crosswise,
        stalk: 0.45,
        outline: Outline::Palmate { angles: MAPLE, half_width: 0.15 },
        half_width: 0.75,
        taper: (0.7, 1.0),
        leaf: Leaf {
            tip: (0xa82a1c, 0.75),
            margin: (0x8f2418, 0.5),
            ..palmate(0xd9842c, 0xc0502a, 0xecc276, MAPLE, 719)
        },
        bark: 0x8a4a3c,
        seed: 727,
    };
    vec![("shoot_oak", oak), ("shoot_maple", maple)]
}

/// Shoots of conifers, with their names.
pub(crate) fn needles() -> Vec<(&'static str, Shoot)> {
    let spruce = Shoot {
        width: 0.4,
        twigs: 9,
        angle: 40.0,
        middle: (0.0, 0.96),
        needle: 0.056,
        thin: 0.0038,
        apart: 0.0085,
        spread: (38.0, 66.0),
        tufts: None,
        colours: [0x2c5230, 0x54824a, 0x98bb74, 0x6d5238],
        seed: 511,
    };
    let pine = Shoot {
        width: 0.8,
        twigs: 0,
        middle: (0.14, 0.56),
        needle: 0.44,
        thin: 0.0075,
        apart: 0.034,
        spread: (4.0, 78.0),
        colours: [0x35593f, 0x66906a, 0x86a872, 0x8a6a48],
        seed: 521,
        ..spruce
    };
    let larch = Shoot {
        width: 0.4,
        twigs: 5,
        angle: 40.0,
        needle: 0.055,
        thin: 0.0042,
        apart: 0.0055,
        spread: (0.0, 150.0),
        tufts: Some(0.09),
        colours: [0x5d8a3e, 0x8db45a, 0xb4cf7c, 0x9a7a52],
        seed: 541,
        ..spruce
    };
    let cypress = Shoot {
        width: 0.5,
        twigs: 13,
        angle: 30.0,
        needle: 0.04,
        thin: 0.0065,
        apart: 0.013,
        spread: (14.0, 26.0),
        colours: [0x2d5232, 0x5a8450, 0x7fa468, 0x6d5238],
        seed: 557,
        ..spruce
    };
    vec![("shoot_spruce", spruce), ("shoot_pine", pine), ("shoot_larch", larch), ("shoot_cypress", cypress)]
}
