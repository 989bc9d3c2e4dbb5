//! A leafy house plant: arching shoots with two ranks of glossy leaves. The pot comes from the program.

use super::super::forms::POTTED_LEAF;
use super::super::hand::{Hand, at};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;
use glam::DVec2;

/// A shoot: three points to rise through, number of leaves, length of the longest one,
/// share of the stem without leaves.
struct Shoot {
    through: [DVec2; 3],
    leaves: u32,
    longest: f64,
    bare: f64,
}

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("potted", [768, 1024], 71);
    let shoot = |base: f64, mid: [f64; 2], end: [f64; 2], leaves, bare| Shoot {
        through: [at(base, 984.0), at(mid[0], mid[1]), at(end[0], end[1])],
        leaves,
        longest: 128.0,
        bare,
    };
    for shoot in [
        shoot(386.0, [366.0, 560.0], [418.0, 150.0], 11, 0.36),
        shoot(368.0, [270.0, 600.0], [172.0, 290.0], 10, 0.36),
        shoot(404.0, [520.0, 620.0], [628.0, 330.0], 10, 0.34),
        shoot(350.0, [206.0, 770.0], [80.0, 668.0], 9, 0.2),
        shoot(420.0, [566.0, 800.0], [684.0, 712.0], 9, 0.2),
    ] {
        grow(&mut hand, &shoot);
    }
    hand.finish()
}

fn grow(hand: &mut Hand, shoot: &Shoot) {
    let stem = hand.branch(&shoot.through, [0.72, 0.3]);
    for i in 0..shoot.leaves {
        let share = f64::from(i) / f64::from(shoot.leaves - 1);
        let node = shoot.bare + (0.98 - shoot.bare) * share;
        let side = if i % 2 == 0 { 1.0 } else { -1.0 };
        let last = i + 1 == shoot.leaves;
        let away = if last { 6.0 } else { side * (56.0 - 18.0 * share + hand.vary(8.0)) };
        let length = shoot.longest * (1.0 - 0.5 * (share - 0.35).abs()) * (1.0 + hand.vary(0.08));
        Leaf::new(stem.point(node), stem.heading(node) + away, length)
            .bent(side * 14.0, -side * (18.0 + hand.vary(8.0)))
            .turned(0.86 - 0.14 * side + hand.vary(0.08), 0.86 + 0.14 * side + hand.vary(0.08))
            .draw_as("leaf", hand, &POTTED_LEAF);
    }
}
