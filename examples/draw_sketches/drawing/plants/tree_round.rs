//! A round-crowned maple: trunk and limbs, outlines to fill with twigs and with leaves, three leaves as samples.

use super::super::forms::MAPLE_LEAF;
use super::super::hand::{Drawn, Hand, at, toward};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;
use glam::DVec2;
use std::f64::consts::PI;

/// A limb: where it leaves the trunk (share of its length), the points it passes, and the end of its side branch.
const LIMBS: [(f64, [[f64; 2]; 3], [f64; 2]); 6] = [
    (0.27, [[424.0, 700.0], [296.0, 650.0], [150.0, 632.0]], [240.0, 742.0]),
    (0.35, [[606.0, 652.0], [740.0, 618.0], [884.0, 560.0]], [806.0, 700.0]),
    (0.43, [[436.0, 566.0], [318.0, 478.0], [190.0, 420.0]], [212.0, 520.0]),
    (0.53, [[582.0, 520.0], [690.0, 410.0], [822.0, 356.0]], [826.0, 462.0]),
    (0.62, [[466.0, 410.0], [400.0, 300.0], [316.0, 224.0]], [262.0, 306.0]),
    (0.72, [[556.0, 342.0], [610.0, 252.0], [684.0, 184.0]], [742.0, 270.0]),
];

/// Masses of foliage: centre and half axes in pixels.
const MASSES: [([f64; 2], [f64; 2]); 9] = [
    ([204.0, 660.0], [140.0, 96.0]),
    ([828.0, 612.0], [142.0, 104.0]),
    ([210.0, 448.0], [140.0, 116.0]),
    ([822.0, 402.0], [138.0, 116.0]),
    ([308.0, 258.0], [136.0, 108.0]),
    ([700.0, 228.0], [130.0, 104.0]),
    ([508.0, 170.0], [126.0, 104.0]),
    ([420.0, 430.0], [112.0, 88.0]),
    ([622.0, 470.0], [108.0, 90.0]),
];

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("maple", [1024, 1024], 81);
    let trunk = hand.branch(
        &[
            at(500.0, 1004.0),
            at(494.0, 900.0),
            at(520.0, 760.0),
            at(506.0, 600.0),
            at(526.0, 420.0),
            at(506.0, 190.0),
        ],
        [1.0, 0.4],
    );
    let limbs: Vec<Drawn> = LIMBS.iter().map(|limb| fork(&mut hand, &trunk, limb)).collect();
    for (limb, share, aim) in [(0, 0.97, 150.0), (3, 0.98, 40.0), (5, 0.97, 80.0)] {
        Leaf::new(limbs[limb].point(share), aim, 56.0).draw_as("leaf", &mut hand, &MAPLE_LEAF);
    }
    for limb in &limbs {
        spindle(&mut hand, limb);
    }
    for (center, radii) in MASSES {
        cloud(&mut hand, at(center[0], center[1]), radii);
    }
    hand.finish()
}

fn fork(hand: &mut Hand, trunk: &Drawn, (node, through, twig): &(f64, [[f64; 2]; 3], [f64; 2])) -> Drawn {
    let mut line = vec![trunk.point(*node)];
    line.extend(through.map(|[x, y]| at(x, y)));
    let limb = hand.branch(&line, [0.66, 0.32]);
    let (from, end) = (limb.point(0.5), at(twig[0], twig[1]));
    let side = [from, from.lerp(end, 0.5) + at(0.0, -9.0), end];
    if through[2][0] < through[0][0] {
        hand.branch(&side, [0.42, 0.26])
    } else {
        hand.branch_reversed(&side, [0.42, 0.26])
    };
    limb
}

/// A loop around the outer part of a limb, to be filled with twigs.
fn spindle(hand: &mut Hand, limb: &Drawn) {
    let shape = [(0.42, 10.0), (0.62, 58.0), (0.82, 74.0), (0.98, 50.0)];
    let side = |sign: f64| {
        shape.map(|(share, half)| limb.point(share) + toward(limb.heading(share) + sign * 90.0) * half)
    };
    let mut corners = side(-1.0).to_vec();
    corners.push(limb.point(1.0) + toward(limb.heading(1.0)) * 34.0);
    corners.extend(side(1.0).into_iter().rev());
    hand.region("branch_outline", &corners);
}

/// A loop with the uneven bulges of a mass of foliage, to be filled with leaves.
fn cloud(hand: &mut Hand, center: DVec2, radii: [f64; 2]) {
    let bulges = 9;
    let pitch = 360.0 / f64::from(bulges);
    let seams: Vec<f64> = (0..bulges).map(|i| f64::from(i) * pitch + hand.vary(0.42 * pitch)).collect();
    let start = 360.0 + seams[0];
    let ends = seams.iter().skip(1).copied().chain([start]);
    let mut corners = Vec::new();
    for (from, to) in seams.iter().zip(ends) {
        let height = 0.16 * (to - from) / pitch + hand.vary(0.04);
        for step in 0..8 {
            let u = f64::from(step) / 8.0;
            let out = toward(from + (to - from) * u) * (0.9 + height * (PI * u).sin().powf(0.8));
            corners.push(center + DVec2::new(out.x * radii[0], out.y * radii[1]));
        }
    }
    hand.region("leaf_outline", &corners);
}
