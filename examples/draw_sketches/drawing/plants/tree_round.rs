//! A round-crowned maple: trunk and limbs, outlines to fill with twigs and with leaves, three leaves as samples.

use super::super::forms::MAPLE_LEAF;
use super::super::hand::{Hand, at, toward};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;
use glam::DVec2;

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("maple", [1024, 1024], 81);
    let trunk = hand.branch(
        &[at(508.0, 990.0), at(500.0, 880.0), at(512.0, 740.0), at(504.0, 560.0), at(516.0, 380.0), at(508.0, 210.0)],
        [1.0, 0.4],
    );
    let limbs = [
        (0.30, [[420.0, 690.0], [300.0, 620.0], [160.0, 590.0]]),
        (0.33, [[600.0, 676.0], [720.0, 616.0], [868.0, 596.0]]),
        (0.44, [[430.0, 570.0], [330.0, 460.0], [226.0, 386.0]]),
        (0.48, [[590.0, 540.0], [694.0, 440.0], [806.0, 372.0]]),
        (0.62, [[452.0, 420.0], [394.0, 310.0], [346.0, 216.0]]),
        (0.66, [[574.0, 392.0], [630.0, 300.0], [680.0, 214.0]]),
    ];
    let mut drawn = Vec::new();
    for (node, through) in limbs {
        let mut line = vec![trunk.point(node)];
        line.extend(through.map(|[x, y]| at(x, y)));
        drawn.push(hand.branch(&line, [0.62, 0.32]));
    }
    for (limb, node, end) in [
        (0, 0.55, at(232.0, 706.0)),
        (1, 0.55, at(800.0, 704.0)),
        (2, 0.5, at(228.0, 500.0)),
        (3, 0.5, at(806.0, 490.0)),
        (4, 0.5, at(296.0, 300.0)),
        (5, 0.5, at(742.0, 296.0)),
    ] {
        let from = drawn[limb].point(node);
        hand.branch(&[from, from.lerp(end, 0.5) + at(0.0, -8.0), end], [0.42, 0.26]);
    }
    for (limb, share, aim) in [(0, 0.97, 160.0), (3, 0.98, 40.0), (5, 0.97, 75.0)] {
        Leaf::new(drawn[limb].point(share), aim, 52.0).draw_as("leaf", &mut hand, &MAPLE_LEAF);
    }
    for (center, radii) in CROWN {
        cloud(&mut hand, "branch_outline", at(center[0], center[1]), [radii[0] * 0.86, radii[1] * 0.86]);
        cloud(&mut hand, "leaf_outline", at(center[0], center[1]), radii);
    }
    hand.finish()
}

/// Centre and half axes of the masses of foliage, pixels.
const CROWN: [([f64; 2], [f64; 2]); 7] = [
    ([206.0, 640.0], [150.0, 112.0]),
    ([818.0, 642.0], [150.0, 112.0]),
    ([236.0, 424.0], [142.0, 126.0]),
    ([796.0, 418.0], [142.0, 126.0]),
    ([338.0, 232.0], [132.0, 116.0]),
    ([690.0, 232.0], [132.0, 116.0]),
    ([512.0, 190.0], [126.0, 120.0]),
];

/// A loop with the bulges of a mass of foliage.
fn cloud(hand: &mut Hand, tool: &'static str, center: DVec2, radii: [f64; 2]) {
    let corners: Vec<DVec2> = (0..22)
        .map(|i| {
            let bulge = if i % 2 == 0 { 1.05 } else { 0.93 };
            let out = toward(f64::from(i) * 360.0 / 22.0 + hand.vary(5.0)) * (bulge + hand.vary(0.05));
            center + DVec2::new(out.x * radii[0], out.y * radii[1])
        })
        .collect();
    hand.region(tool, &corners);
}
