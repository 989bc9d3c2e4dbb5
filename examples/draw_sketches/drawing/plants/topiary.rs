//! A box hedge cut to a rabbit: a trunk with limbs, and crowns for the body, the eye, which is a hole, and the tail.

use super::super::hand::{Hand, at, toward};
use super::super::sheet::Sheet;
use glam::DVec2;

/// The rabbit from its fore foot round nose, ears and back.
const RABBIT: [[f64; 2]; 31] = [
    [430.0, 806.0],
    [352.0, 802.0],
    [322.0, 760.0],
    [366.0, 700.0],
    [350.0, 600.0],
    [326.0, 530.0],
    [262.0, 500.0],
    [212.0, 446.0],
    [226.0, 384.0],
    [286.0, 328.0],
    [312.0, 286.0],
    [264.0, 200.0],
    [254.0, 112.0],
    [296.0, 80.0],
    [346.0, 150.0],
    [374.0, 256.0],
    [394.0, 250.0],
    [402.0, 150.0],
    [434.0, 72.0],
    [478.0, 90.0],
    [484.0, 176.0],
    [456.0, 290.0],
    [486.0, 366.0],
    [512.0, 430.0],
    [590.0, 456.0],
    [694.0, 522.0],
    [762.0, 632.0],
    [768.0, 732.0],
    [716.0, 804.0],
    [606.0, 816.0],
    [512.0, 810.0],
];

/// Limbs: where they leave the trunk (share of its length) and the points that they pass.
const LIMBS: [(f64, [[f64; 2]; 3]); 4] = [
    (0.48, [[446.0, 650.0], [392.0, 540.0], [322.0, 470.0]]),
    (0.4, [[586.0, 700.0], [660.0, 640.0], [708.0, 590.0]]),
    (0.31, [[620.0, 778.0], [742.0, 752.0], [862.0, 706.0]]),
    (0.7, [[452.0, 470.0], [436.0, 350.0], [440.0, 230.0]]),
];

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("box", [1024, 1024], 87);
    let stem = [at(516.0, 996.0), at(510.0, 900.0), at(520.0, 760.0), at(500.0, 620.0), at(430.0, 470.0)];
    let trunk = hand.branch(&stem, [0.9, 0.4]);
    for (node, through) in LIMBS {
        let mut line = vec![trunk.point(node)];
        line.extend(through.map(|[x, y]| at(x, y)));
        hand.branch(&line, [0.5, 0.25]);
    }
    hand.region("crown", &RABBIT.map(|[x, y]| at(x, y)));
    ring(&mut hand, at(304.0, 416.0), 33.0);
    ring(&mut hand, at(858.0, 700.0), 66.0);
    hand.finish()
}

fn ring(hand: &mut Hand, center: DVec2, radius: f64) {
    let corners: Vec<DVec2> = (0..9).map(|k| center + toward(40.0 * f64::from(k)) * radius).collect();
    hand.region("crown", &corners);
}
