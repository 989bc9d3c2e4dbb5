//! A weeping willow: a leaning trunk, arching boughs, branchlets that hang like curtains.

use super::super::forms::WILLOW_LEAF;
use super::super::hand::{Hand, at};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;
use glam::DVec2;

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("willow", [1024, 1024], 91);
    let trunk = hand.branch(
        &[at(478.0, 992.0), at(486.0, 860.0), at(520.0, 700.0), at(508.0, 540.0), at(528.0, 400.0), at(516.0, 268.0)],
        [1.0, 0.45],
    );
    let boughs: [(f64, &[[f64; 2]]); 6] = [
        (0.95, &[[566.0, 190.0], [640.0, 168.0], [704.0, 212.0]]),
        (0.9, &[[470.0, 210.0], [392.0, 160.0], [318.0, 196.0]]),
        (0.74, &[[606.0, 330.0], [730.0, 262.0], [846.0, 316.0]]),
        (0.7, &[[440.0, 360.0], [300.0, 272.0], [182.0, 322.0]]),
        (0.52, &[[590.0, 476.0], [696.0, 430.0], [782.0, 476.0]]),
        (0.5, &[[450.0, 500.0], [350.0, 440.0], [264.0, 482.0]]),
    ];
    for (node, through) in boughs {
        let mut line = vec![trunk.point(node)];
        line.extend(through.iter().map(|&[x, y]| at(x, y)));
        let bough = hand.branch(&line, [0.6, 0.36]);
        let outward = (bough.point(1.0).x - bough.point(0.0).x).signum();
        for (share, fall) in [(0.55, 0.86), (0.78, 1.0), (1.0, 0.92)] {
            let from = bough.point(share);
            let end = at(from.x + outward * (46.0 + hand.vary(14.0)), from.y + fall * (330.0 + hand.vary(30.0)));
            let over = at(from.x + outward * 38.0, from.lerp(end, 0.3).y);
            let line = [from, over, over.lerp(end, 0.5) + at(outward * 8.0, 0.0), end];
            hand.branch(&line, [0.34, 0.18]);
            curtain(&mut hand, &line);
        }
    }
    for (x, y, aim) in [(706.0, 226.0, -70.0), (316.0, 210.0, -110.0), (848.0, 332.0, -66.0)] {
        Leaf::new(at(x, y), aim, 64.0).bent(8.0, -8.0).draw_as("leaf", &mut hand, &WILLOW_LEAF);
    }
    hand.finish()
}

/// A long loop around a hanging branchlet.
fn curtain(hand: &mut Hand, line: &[DVec2]) {
    let widths = [16.0, 34.0, 38.0, 14.0];
    let side = |sign: f64| line.iter().zip(widths).map(move |(&p, w)| p + at(sign * w, 0.0));
    let mut corners: Vec<DVec2> = side(-1.0).collect();
    let mut back: Vec<DVec2> = side(1.0).collect();
    back.reverse();
    corners.push(line[line.len() - 1] + at(0.0, 24.0));
    corners.extend(back);
    corners.push(line[0] + at(0.0, -12.0));
    hand.region("leaf_outline", &corners);
}
