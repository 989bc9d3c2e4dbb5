//! Bamboo: slender culms side by side, straight and without branches below, with short twigs at the nodes above and
//! long pointed leaves that hang from them.

use super::super::forms::WILLOW_LEAF;
use super::super::hand::{Drawn, Hand, at, toward};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;

/// A culm: where it stands, where it passes at half its height, where it ends, and the share of it without twigs.
type Culm = (f64, [f64; 2], [f64; 2], f64);

const CULMS: [Culm; 6] = [
    (356.0, [346.0, 560.0], [300.0, 120.0], 0.4),
    (408.0, [408.0, 540.0], [424.0, 84.0], 0.38),
    (304.0, [284.0, 600.0], [190.0, 190.0], 0.42),
    (460.0, [478.0, 590.0], [566.0, 152.0], 0.42),
    (252.0, [222.0, 690.0], [140.0, 404.0], 0.45),
    (512.0, [544.0, 690.0], [628.0, 388.0], 0.45),
];

/// Distance between two nodes with twigs, as a share of the culm.
const NODE: f64 = 0.115;

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("bamboo", [768, 1024], 113);
    for (foot, middle, end, bare) in CULMS {
        let line = [at(foot, 1004.0), at(middle[0], middle[1]), at(end[0], end[1])];
        let culm = hand.branch(&line, [0.5, 0.3]);
        let mut side = if foot < 380.0 { -1.0 } else { 1.0 };
        let mut node = bare;
        while node < 0.97 {
            twig(&mut hand, &culm, node, side);
            side = -side;
            node += NODE;
        }
        leaves(&mut hand, &culm, 0.99, [-34.0, 2.0, 36.0]);
    }
    hand.finish()
}

/// A twig that rises from a node of the culm, with the leaves at its end.
fn twig(hand: &mut Hand, culm: &Drawn, node: f64, side: f64) {
    let length = 92.0 * (1.25 - 0.6 * node) * (1.0 + hand.vary(0.15));
    let aim = culm.heading(node) + side * (-48.0 + hand.vary(8.0));
    let from = culm.point(node);
    let direction = toward(aim);
    let bow = at(0.0, 0.1 * length);
    let line = [from, from + direction * (0.55 * length) - bow * 0.4, from + direction * length + bow];
    let twig = hand.branch_as("branch", &line, [0.2, 0.12]);
    leaves(hand, &twig, 0.98, [-40.0, -6.0, 30.0]);
    leaves(hand, &twig, 0.62, [-52.0, 48.0, 180.0]);
}

/// Leaves at a place of a stem, at these angles to it; 180 leaves one out.
fn leaves(hand: &mut Hand, stem: &Drawn, place: f64, angles: [f64; 3]) {
    for away in angles.into_iter().filter(|away| *away < 180.0) {
        let aim = stem.heading(place) + away + hand.vary(9.0);
        // They hang: the more they point to a side, the lower.
        let side = aim.to_radians().cos();
        let length = 78.0 * (1.0 + hand.vary(0.18));
        Leaf::new(stem.point(place), aim - side * 24.0, length).bent(side * 16.0, -side * 20.0).draw_as(
            "leaf",
            hand,
            &WILLOW_LEAF,
        );
    }
}
