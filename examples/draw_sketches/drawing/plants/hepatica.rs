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

/// A leaf with the base and the middle of its stalk, which is drawn from the leaf down.
struct Stalked {
    leaf: Leaf,
    from: DVec2,
    over: DVec2,
}

/// The red one: four flowers over four leaves.
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
            flower: flower(468.0, 190.0, 164.0, 84.0, 58.0, 8, 10.0),
            through: &[at(508.0, 694.0), at(526.0, 560.0), at(494.0, 400.0)],
        },
        Scape {
            flower: Flower { opening: 58.0, ..flower(206.0, 320.0, 134.0, 134.0, 44.0, 7, 20.0) },
            through: &[at(494.0, 696.0), at(438.0, 580.0), at(316.0, 452.0)],
        },
        Scape {
            flower: flower(762.0, 228.0, 146.0, 46.0, 50.0, 7, 0.0),
            through: &[at(526.0, 696.0), at(622.0, 576.0), at(704.0, 400.0)],
        },
        Scape {
            flower: Flower { opening: 48.0, ..flower(598.0, 442.0, 92.0, 82.0, 36.0, 6, 12.0) },
            through: &[at(517.0, 694.0), at(556.0, 628.0), at(590.0, 540.0)],
        },
    ];
    let leaf = |x, y, aim, length, bend: f64| Leaf::new(at(x, y), aim, length).bent(bend, -bend);
    let leaves = [
        Stalked {
            leaf: leaf(252.0, 576.0, 150.0, 190.0, -10.0).turned(1.0, 0.74),
            from: at(487.0, 701.0),
            over: at(370.0, 600.0),
        },
        Stalked {
            leaf: leaf(800.0, 530.0, 34.0, 196.0, 10.0).turned(0.76, 1.0),
            from: at(532.0, 700.0),
            over: at(668.0, 582.0),
        },
        Stalked {
            leaf: leaf(368.0, 688.0, 190.0, 142.0, -8.0).turned(0.7, 0.92),
            from: at(490.0, 706.0),
            over: at(430.0, 684.0),
        },
        Stalked {
            leaf: leaf(688.0, 678.0, -4.0, 156.0, 8.0).turned(0.9, 0.68),
            from: at(528.0, 706.0),
            over: at(610.0, 678.0),
        },
    ];
    draw(&mut hand, &scapes, &leaves);
    hand.finish()
}

/// The blue one, simpler: three flowers over two leaves.
pub fn blue() -> Sheet {
    let mut hand = Hand::new("hepatica_blue", [768, 1024], 12);
    let flower = |x, y, size, faces, lift, petals, turn| Flower {
        petals,
        turn,
        opening: 65.0,
        ..Flower::new(at(x, y), size, faces, lift)
    };
    let scapes = [
        Scape {
            flower: flower(432.0, 240.0, 212.0, 70.0, 58.0, 6, 24.0),
            through: &[at(388.0, 908.0), at(420.0, 740.0), at(384.0, 500.0)],
        },
        Scape {
            flower: Flower { opening: 60.0, ..flower(166.0, 456.0, 156.0, 130.0, 46.0, 7, 0.0) },
            through: &[at(372.0, 910.0), at(346.0, 760.0), at(240.0, 600.0)],
        },
        Scape {
            flower: Flower { opening: 44.0, ..flower(602.0, 520.0, 112.0, 64.0, 40.0, 6, 8.0) },
            through: &[at(398.0, 908.0), at(446.0, 800.0), at(556.0, 650.0)],
        },
    ];
    let leaf = |x, y, aim, length, bend: f64| Leaf::new(at(x, y), aim, length).bent(bend, -bend);
    let leaves = [
        Stalked {
            leaf: leaf(230.0, 786.0, 150.0, 212.0, -8.0).turned(1.0, 0.8),
            from: at(366.0, 916.0),
            over: at(310.0, 826.0),
        },
        Stalked {
            leaf: leaf(530.0, 864.0, 24.0, 206.0, 8.0).turned(0.78, 1.0),
            from: at(402.0, 916.0),
            over: at(462.0, 876.0),
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
        hand.branch_reversed(&[*from, *over, leaf.base], [0.48, 0.3]);
        leaf.draw(hand, &HEPATICA_LEAF);
    }
}
