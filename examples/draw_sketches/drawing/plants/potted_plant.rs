//! A leafy house plant: arching shoots with two ranks of glossy leaves. The pot comes from the program.

use super::super::forms::POTTED_LEAF;
use super::super::hand::{Hand, at};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;
use glam::DVec2;

/// A shoot: three points to rise through, number of leaves, length of the longest one.
struct Shoot {
    through: [DVec2; 3],
    leaves: u32,
    longest: f64,
}

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("potted", [768, 1024], 71);
    let shoot = |base: f64, mid: [f64; 2], end: [f64; 2], leaves, longest| Shoot {
        through: [at(base, 984.0), at(mid[0], mid[1]), at(end[0], end[1])],
        leaves,
        longest,
    };
    for shoot in [
        shoot(384.0, [372.0, 560.0], [398.0, 150.0], 12, 138.0),
        shoot(368.0, [292.0, 580.0], [196.0, 262.0], 11, 132.0),
        shoot(402.0, [474.0, 590.0], [586.0, 276.0], 11, 132.0),
        shoot(352.0, [232.0, 690.0], [98.0, 560.0], 8, 124.0),
        shoot(418.0, [536.0, 700.0], [676.0, 574.0], 8, 124.0),
        shoot(340.0, [220.0, 832.0], [96.0, 812.0], 5, 112.0),
        shoot(430.0, [548.0, 838.0], [668.0, 816.0], 5, 112.0),
    ] {
        grow(&mut hand, &shoot);
    }
    hand.finish()
}

fn grow(hand: &mut Hand, shoot: &Shoot) {
    let stem = hand.branch(&shoot.through, [0.72, 0.3]);
    for i in 0..shoot.leaves {
        let share = f64::from(i) / f64::from(shoot.leaves - 1);
        let node = 0.34 + 0.64 * share;
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
