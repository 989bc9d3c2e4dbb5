//! Hepaticas: single flowers on hairy scapes, three-lobed leaves on stalks of their own, all from one rootstock.

use super::super::flower::Flower;
use super::super::forms::{HEPATICA_LEAF, HEPATICA_PETAL};
use super::super::hand::{Hand, at};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;
use glam::DVec2;

/// A flower with the points through which its scape rises.
struct Scape<'a> {
    flower: Flower,
    through: &'a [DVec2],
}

/// A leaf with the base and the middle of its stalk.
struct Stalked {
    leaf: Leaf,
    from: DVec2,
    over: DVec2,
}

/// The red one: four flowers over five leaves.
pub fn red() -> Sheet {
    let mut hand = Hand::new("hepatica_red", [1024, 768], 11);
    let flower = |x, y, size, faces, lift, petals, turn| Flower {
        petals,
        turn,
        opening: 64.0,
        ..Flower::new(at(x, y), size, faces, lift)
    };
    let scapes = [
        Scape {
            flower: flower(498.0, 196.0, 138.0, 78.0, 54.0, 8, 10.0),
            through: &[at(512.0, 690.0), at(524.0, 560.0), at(508.0, 400.0)],
        },
        Scape {
            flower: Flower { opening: 60.0, ..flower(262.0, 262.0, 118.0, 132.0, 42.0, 7, 20.0) },
            through: &[at(500.0, 692.0), at(452.0, 570.0), at(360.0, 420.0)],
        },
        Scape {
            flower: flower(748.0, 246.0, 122.0, 48.0, 46.0, 7, 0.0),
            through: &[at(526.0, 692.0), at(590.0, 560.0), at(668.0, 400.0)],
        },
        Scape {
            flower: Flower { opening: 50.0, ..flower(636.0, 398.0, 84.0, 62.0, 36.0, 6, 12.0) },
            through: &[at(519.0, 690.0), at(556.0, 590.0), at(600.0, 500.0)],
        },
    ];
    let leaves = [
        Stalked {
            leaf: Leaf::new(at(238.0, 556.0), 158.0, 172.0).bent(-10.0, 8.0).turned(1.0, 0.8),
            from: at(494.0, 696.0),
            over: at(370.0, 588.0),
        },
        Stalked {
            leaf: Leaf::new(at(806.0, 548.0), 24.0, 176.0).bent(10.0, -8.0).turned(0.8, 1.0),
            from: at(532.0, 696.0),
            over: at(668.0, 584.0),
        },
        Stalked {
            leaf: Leaf::new(at(352.0, 660.0), 196.0, 138.0).bent(-8.0, 10.0).turned(0.85, 1.0),
            from: at(498.0, 700.0),
            over: at(424.0, 664.0),
        },
        Stalked {
            leaf: Leaf::new(at(676.0, 664.0), -12.0, 132.0).bent(8.0, -8.0).turned(1.0, 0.85),
            from: at(530.0, 700.0),
            over: at(602.0, 668.0),
        },
    ];
    draw(&mut hand, &scapes, &leaves);
    hand.finish()
}

/// The blue one, simpler: three flowers over three leaves.
pub fn blue() -> Sheet {
    let mut hand = Hand::new("hepatica_blue", [768, 1024], 12);
    let flower = |x, y, size, faces, lift, petals, turn| Flower {
        petals,
        turn,
        opening: 66.0,
        ..Flower::new(at(x, y), size, faces, lift)
    };
    let scapes = [
        Scape {
            flower: flower(430.0, 236.0, 172.0, 70.0, 52.0, 6, 24.0),
            through: &[at(392.0, 900.0), at(416.0, 720.0), at(404.0, 470.0)],
        },
        Scape {
            flower: flower(186.0, 430.0, 134.0, 128.0, 40.0, 6, 0.0),
            through: &[at(378.0, 902.0), at(342.0, 740.0), at(262.0, 590.0)],
        },
    ];
    let leaves = [
        Stalked {
            leaf: Leaf::new(at(240.0, 760.0), 150.0, 196.0).bent(-8.0, 8.0).turned(1.0, 0.82),
            from: at(374.0, 906.0),
            over: at(322.0, 806.0),
        },
        Stalked {
            leaf: Leaf::new(at(532.0, 690.0), 36.0, 226.0).bent(8.0, -10.0).turned(0.8, 1.0),
            from: at(402.0, 906.0),
            over: at(462.0, 770.0),
        },
    ];
    draw(&mut hand, &scapes, &leaves);
    hand.finish()
}

fn draw(hand: &mut Hand, scapes: &[Scape], leaves: &[Stalked]) {
    for Scape { flower, through } in scapes {
        flower.stalk(hand, through, [0.55, 0.34]);
        flower.draw(hand, &HEPATICA_PETAL);
    }
    for Stalked { leaf, from, over } in leaves {
        hand.branch(&[*from, *over, leaf.base], [0.48, 0.3]);
        leaf.draw(hand, &HEPATICA_LEAF);
    }
}
