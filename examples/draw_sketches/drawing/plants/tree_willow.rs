//! A weeping willow: a leaning trunk, arching boughs, branchlets that hang like curtains.

use super::super::forms::WILLOW_LEAF;
use super::super::hand::{Drawn, Hand, at, toward};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;
use glam::DVec2;

/// Where a bough leaves the trunk (share of its length), the points it passes, and the lengths in pixels of the
/// branchlets that hang from it, inner to outer.
type Bough = (f64, [[f64; 2]; 3], &'static [f64]);

const BOUGHS: [Bough; 9] = [
    (1.0, [[540.0, 150.0], [622.0, 116.0], [706.0, 172.0]], &[200.0, 250.0, 330.0, 420.0]),
    (0.93, [[462.0, 186.0], [380.0, 130.0], [292.0, 184.0]], &[190.0, 280.0, 396.0, 470.0]),
    (0.8, [[600.0, 296.0], [716.0, 226.0], [846.0, 276.0]], &[220.0, 330.0, 480.0, 560.0]),
    (0.72, [[440.0, 346.0], [296.0, 262.0], [168.0, 326.0]], &[240.0, 380.0, 452.0, 516.0]),
    (0.62, [[592.0, 420.0], [748.0, 366.0], [900.0, 440.0]], &[230.0, 330.0, 412.0]),
    (0.52, [[440.0, 496.0], [322.0, 448.0], [228.0, 506.0]], &[220.0, 330.0, 390.0]),
    (0.47, [[556.0, 526.0], [618.0, 488.0], [690.0, 528.0]], &[250.0, 340.0]),
    (0.88, [[498.0, 288.0], [466.0, 276.0], [424.0, 318.0]], &[240.0, 330.0]),
    (0.9, [[534.0, 262.0], [562.0, 246.0], [588.0, 286.0]], &[270.0]),
];

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("willow", [1024, 1024], 91);
    let trunk = hand.branch(
        &[
            at(456.0, 1004.0),
            at(474.0, 880.0),
            at(524.0, 720.0),
            at(496.0, 560.0),
            at(528.0, 400.0),
            at(510.0, 230.0),
        ],
        [1.0, 0.45],
    );
    for (number, (node, through, falls)) in BOUGHS.into_iter().enumerate() {
        let mut line = vec![trunk.point(node)];
        line.extend(through.map(|[x, y]| at(x, y)));
        let bough = hand.branch(&line, [0.62, 0.36]);
        let outward = (bough.point(1.0).x - bough.point(0.0).x).signum();
        for (i, fall) in falls.iter().enumerate() {
            let share = 1.0 - 0.2 * (falls.len() - 1 - i) as f64;
            let branchlet = hanging(&mut hand, bough.point(share), outward, *fall);
            if number % 2 == 1 && i == 1 {
                curtain(&mut hand, "branch_outline", &branchlet, 0.7);
            }
            curtain(&mut hand, "leaf_outline", &branchlet, 1.0);
        }
        if number < 4 {
            crest(&mut hand, &bough);
        }
        if number % 3 == 0 {
            let leaf = Leaf::new(bough.point(0.9), -90.0 + outward * 22.0, 72.0);
            leaf.bent(8.0, -8.0).draw_as("leaf", &mut hand, &WILLOW_LEAF);
        }
    }
    hand.finish()
}

/// Draws a branchlet that arches out of its bough and hangs; gives its points from base to end.
fn hanging(hand: &mut Hand, from: DVec2, outward: f64, fall: f64) -> [DVec2; 5] {
    let sway = outward * (30.0 + hand.vary(12.0));
    let line = [
        from,
        from + at(0.7 * sway, 0.1 * fall),
        from + at(1.1 * sway, 0.34 * fall),
        from + at(1.25 * sway, 0.7 * fall),
        from + at(0.95 * sway + hand.vary(8.0), fall),
    ];
    hand.branch(&line, [0.36, 0.18]);
    line
}

/// A loop along the outer half of a bough, so that the crown is leafy on top.
fn crest(hand: &mut Hand, bough: &Drawn) {
    let halves = [(0.3, 16.0), (0.5, 30.0), (0.75, 34.0), (0.96, 18.0)];
    let side = |sign: f64| {
        halves.map(|(share, half)| bough.point(share) + toward(bough.heading(share) + sign * 90.0) * half)
    };
    let mut corners = side(-1.0).to_vec();
    corners.extend(side(1.0).into_iter().rev());
    hand.region("leaf_outline", &corners);
}

/// A long loop around a hanging branchlet, `breadth` times as wide as a full curtain.
fn curtain(hand: &mut Hand, tool: &'static str, line: &[DVec2; 5], breadth: f64) {
    let halves: [f64; 5] =
        std::array::from_fn(|i| [10.0, 26.0, 36.0, 34.0, 15.0][i] * breadth * (1.0 + hand.vary(0.2)));
    let side = |sign: f64| line.iter().zip(halves).map(move |(&p, half)| p + at(sign * half, 0.0));
    let mut corners: Vec<DVec2> = side(-1.0).collect();
    corners.push(line[4] + at(hand.vary(6.0), 22.0 * breadth));
    corners.extend(side(1.0).collect::<Vec<_>>().into_iter().rev());
    corners.push(line[0] + at(0.0, -12.0 * breadth));
    hand.region(tool, &corners);
}
