//! A flower, a tulip, grass, a leaf and a mushroom.

use super::super::super::hand::{Hand, at, toward};
use super::super::super::sheet::Sheet;
use super::super::super::spline;
use super::{Scallops, corners, line, paper};

/// A flower: a ring for its centre, all petals in one stroke, a stem, and leaves of two arcs with a midrib.
pub fn flower() -> Sheet {
    let mut hand = paper(211);
    let ring: Vec<_> =
        (0..=24).map(|k| at(512.0, 320.0) + toward(100.0 + 15.2 * f64::from(k)) * 62.0).collect();
    hand.outline("auto", &ring, 0.0);
    let petals =
        Scallops { centre: [512.0, 320.0], radii: [86.0, 82.0], range: [80.0, 440.0], lobes: 7, depth: 1.35 };
    let petals = petals.line(&mut hand);
    hand.outline("auto", &petals, 0.0);
    line(&mut hand, &[[512.0, 470.0], [520.0, 640.0], [500.0, 800.0], [508.0, 980.0]]);
    leaf(&mut hand, [506.0, 850.0], 148.0, 230.0);
    leaf(&mut hand, [510.0, 740.0], 36.0, 220.0);
    hand.finish()
}

/// A leaf of two arcs from its root to its tip, and its midrib.
fn leaf(hand: &mut Hand, [x, y]: [f64; 2], aim: f64, length: f64) {
    let place = |share: f64, off: f64| at(x, y) + toward(aim) * (share * length) + toward(aim + 90.0) * off;
    for side in [1.0, -1.0] {
        let half = side * 0.2 * length;
        hand.branch(
            &[place(0.04, 0.0), place(0.35, half), place(0.7, 0.75 * half), place(1.0, 0.0)],
            [0.5, 0.45],
        );
    }
    hand.branch(&[place(0.02, 0.0), place(0.45, 6.0), place(0.8, 2.0)], [0.45, 0.3]);
}

/// A tulip from the side: a cup with three tips, a stem, and two long leaves.
pub fn tulip() -> Sheet {
    let mut hand = paper(212);
    corners(
        &mut hand,
        &[
            &[
                [404.0, 200.0],
                [380.0, 320.0],
                [420.0, 420.0],
                [512.0, 460.0],
                [604.0, 420.0],
                [644.0, 320.0],
                [620.0, 200.0],
            ],
            &[[620.0, 200.0], [590.0, 240.0], [570.0, 290.0]],
            &[[570.0, 290.0], [546.0, 220.0], [512.0, 170.0]],
            &[[512.0, 170.0], [478.0, 222.0], [456.0, 290.0]],
            &[[456.0, 290.0], [434.0, 238.0], [404.0, 200.0]],
        ],
    );
    line(&mut hand, &[[512.0, 462.0], [506.0, 640.0], [516.0, 820.0], [510.0, 980.0]]);
    for (tip, bulge) in [([330.0, 560.0], -1.0), ([700.0, 600.0], 1.0)] {
        let [x, y] = tip;
        let root = [511.0, 950.0];
        corners(
            &mut hand,
            &[
                &[root, [511.0 + bulge * 120.0, 800.0], tip],
                &[tip, [x + bulge * -20.0, y + 150.0], [511.0 + bulge * 14.0, 880.0], root],
            ],
        );
    }
    hand.finish()
}

/// Grass: a zigzag along the ground, and taller blades drawn one by one.
pub fn grass() -> Sheet {
    let mut hand = paper(213);
    let mut zigzag = Vec::new();
    for k in 0..11 {
        let x = 180.0 + 62.0 * f64::from(k) + hand.vary(14.0);
        let top = 560.0 + hand.vary(110.0);
        zigzag.extend([at(x, 868.0 + hand.vary(10.0)), at(x + 26.0 + hand.vary(24.0), top)]);
    }
    zigzag.push(at(868.0, 872.0));
    hand.outline("auto", &zigzag, 0.0);
    for (foot, lean, height) in
        [(250.0, -60.0, 480.0), (420.0, -20.0, 600.0), (560.0, 50.0, 560.0), (730.0, 90.0, 470.0)]
    {
        let place = |share: f64| [foot + lean * share * share, 880.0 - height * share];
        line(&mut hand, &[place(0.0), place(0.35), place(0.7), place(1.0)]);
    }
    hand.finish()
}

/// A leaf with its midrib, which goes on as the stalk, and veins.
pub fn big_leaf() -> Sheet {
    let mut hand = paper(214);
    let outline =
        [[512.0, 800.0], [360.0, 730.0], [270.0, 560.0], [300.0, 380.0], [420.0, 220.0], [524.0, 90.0]];
    let back =
        [[524.0, 90.0], [640.0, 230.0], [740.0, 390.0], [760.0, 570.0], [670.0, 734.0], [512.0, 800.0]];
    corners(&mut hand, &[&outline, &back]);
    line(&mut hand, &[[500.0, 970.0], [510.0, 860.0], [514.0, 600.0], [520.0, 180.0]]);
    for (y, rise) in [(700.0, 90.0), (580.0, 110.0), (450.0, 100.0), (330.0, 80.0)] {
        line(&mut hand, &[[514.0, y], [440.0, y - 0.5 * rise], [360.0, y - rise]]);
        line(&mut hand, &[[516.0, y - 10.0], [590.0, y - 10.0 - 0.5 * rise], [672.0, y - 10.0 - rise]]);
    }
    hand.finish()
}

/// A mushroom: a cap, closed below, and a stalk of two lines that meet at the ground.
pub fn mushroom() -> Sheet {
    let mut hand = paper(215);
    corners(
        &mut hand,
        &[
            &[
                [180.0, 520.0],
                [230.0, 330.0],
                [370.0, 200.0],
                [520.0, 164.0],
                [680.0, 204.0],
                [810.0, 340.0],
                [856.0, 524.0],
            ],
            &[[856.0, 524.0], [680.0, 548.0], [512.0, 552.0], [340.0, 546.0], [180.0, 520.0]],
        ],
    );
    line(
        &mut hand,
        &[
            [430.0, 552.0],
            [446.0, 700.0],
            [420.0, 880.0],
            [470.0, 930.0],
            [560.0, 932.0],
            [622.0, 884.0],
            [590.0, 700.0],
            [600.0, 552.0],
        ],
    );
    spots(&mut hand);
    hand.finish()
}

/// Spots on the cap.
fn spots(hand: &mut Hand) {
    for ([x, y], radius) in [([400.0, 360.0], 34.0), ([560.0, 300.0], 42.0), ([680.0, 420.0], 30.0)] {
        let corners: Vec<_> = (0..8).map(|k| at(x, y) + toward(45.0 * f64::from(k)) * radius).collect();
        let ring = spline::around(&corners);
        hand.outline("auto", &ring, 0.0);
    }
}
