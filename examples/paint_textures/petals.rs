//! The petals of all species that have their own.

use super::petal::{PLAIN, Petal};

/// Texture names and what they show.
pub(crate) const ALL: &[(&str, Petal)] = &[
    (
        "petal_daisy",
        Petal {
            base: 0xdfe3a8,
            body: 0xf7f5ef,
            tip: 0xfbf6f3,
            turn: [0.0, 0.22],
            margin: (0xf3d9de, 0.28),
            vein: 0xc9c6bd,
            vein_strength: 0.35,
            veins: 7.0,
            parallel: 0.9,
            groove: 0.02,
            seed: 11,
            ..PLAIN
        },
    ),
    (
        "petal_hepatica_red",
        Petal {
            base: 0xf3d3dc,
            body: 0xc93a6c,
            tip: 0xd8507f,
            turn: [-0.08, 0.42],
            margin: (0xf0a9c0, 0.45),
            vein: 0x8c1644,
            vein_strength: 0.42,
            veins: 9.0,
            parallel: 0.45,
            seed: 23,
            ..PLAIN
        },
    ),
    (
        "petal_hepatica_blue",
        Petal {
            base: 0xd9dcf3,
            body: 0x5a62c4,
            tip: 0x7277d2,
            turn: [-0.08, 0.42],
            margin: (0xa9b0ec, 0.4),
            vein: 0x2f2f86,
            vein_strength: 0.40,
            veins: 9.0,
            parallel: 0.45,
            seed: 37,
            ..PLAIN
        },
    ),
    (
        "petal_jasmine",
        Petal {
            base: 0xeef0c8,
            body: 0xfbfaf4,
            tip: 0xfffdfb,
            turn: [0.0, 0.3],
            margin: (0xeec9d2, 0.32),
            vein: 0xd5d2c2,
            vein_strength: 0.28,
            veins: 5.0,
            parallel: 0.55,
            seed: 41,
            ..PLAIN
        },
    ),
    (
        "petal_mallow",
        Petal {
            base: 0xf0d7ea,
            body: 0xc674b8,
            tip: 0xd493c8,
            turn: [0.02, 0.34],
            margin: (0xe4b6dc, 0.45),
            vein: 0x71206f,
            vein_strength: 0.78,
            veins: 6.0,
            net: 0.12,
            seed: 53,
            ..PLAIN
        },
    ),
    (
        "petal_balloon_flower",
        Petal {
            base: 0xb9bfe8,
            body: 0x6a63bf,
            tip: 0x5b51b2,
            turn: [0.0, 0.35],
            margin: (0x8f8ad6, 0.35),
            vein: 0x352a7c,
            vein_strength: 0.62,
            veins: 6.0,
            net: 0.75,
            seed: 61,
            ..PLAIN
        },
    ),
    (
        "petal_plumeria",
        Petal {
            base: 0xf2a81d,
            body: 0xfbf5e6,
            tip: 0xfefcf6,
            turn: [0.12, 0.62],
            margin: (0xf8e6e2, 0.35),
            vein: 0xe4d5b0,
            vein_strength: 0.2,
            veins: 5.0,
            parallel: 0.4,
            groove: 0.009,
            seed: 71,
            ..PLAIN
        },
    ),
    (
        "petal_oxalis",
        Petal {
            base: 0xd9de8e,
            body: 0xd88cc0,
            tip: 0xe2a3cf,
            turn: [0.06, 0.36],
            margin: (0xefc6e0, 0.4),
            vein: 0x8c2f7c,
            vein_strength: 0.5,
            veins: 9.0,
            seed: 83,
            ..PLAIN
        },
    ),
    (
        "petal_rose",
        Petal {
            base: 0xd97f80,
            body: 0xb81f3c,
            tip: 0xcb3550,
            turn: [-0.12, 0.24],
            margin: (0xe0627a, 0.42),
            vein: 0x80102c,
            vein_strength: 0.26,
            veins: 11.0,
            net: 0.15,
            groove: 0.016,
            seed: 97,
            ..PLAIN
        },
    ),
    (
        "petal_sunflower",
        Petal {
            base: 0xd98a12,
            body: 0xf4b81c,
            tip: 0xf9cd3a,
            turn: [-0.05, 0.5],
            margin: (0xfbdc62, 0.35),
            vein: 0xb46c0c,
            vein_strength: 0.42,
            veins: 8.0,
            parallel: 0.85,
            groove: 0.022,
            seed: 101,
            ..PLAIN
        },
    ),
    (
        "petal_cherry",
        Petal {
            base: 0xe58aa8,
            body: 0xf9dfe6,
            tip: 0xfcecf0,
            turn: [-0.08, 0.4],
            margin: (0xf3bfcf, 0.4),
            vein: 0xe1a3b8,
            vein_strength: 0.35,
            veins: 7.0,
            seed: 113,
            ..PLAIN
        },
    ),
    (
        "petal_geranium",
        Petal {
            base: 0xf3c9bd,
            body: 0xd8322c,
            tip: 0xe14a3d,
            turn: [-0.06, 0.22],
            margin: (0xec7565, 0.35),
            vein: 0x94141a,
            vein_strength: 0.4,
            veins: 7.0,
            net: 0.1,
            seed: 127,
            ..PLAIN
        },
    ),
    (
        "petal_soft",
        Petal {
            base: 0xf1efc9,
            body: 0xf6f1ea,
            tip: 0xfbf8f3,
            turn: [0.0, 0.4],
            margin: (0xffffff, 0.3),
            vein: 0xcabfb4,
            vein_strength: 0.45,
            veins: 8.0,
            seed: 131,
            ..PLAIN
        },
    ),
];
