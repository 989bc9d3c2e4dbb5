//! A tree of two trunk lines, one in a single stroke, a fir, a palm and a bush.

use super::super::super::hand::{Hand, at, toward};
use super::super::super::sheet::Sheet;
use super::super::super::spline;
use super::{Scallops, corners, line, paper};

/// A crown like a cloud on a trunk of two lines that flare into roots, with a limb in the crown and the ground.
pub fn broadleaf() -> Sheet {
    let mut hand = paper(201);
    let crown = Scallops {
        centre: [512.0, 360.0],
        radii: [300.0, 235.0],
        range: [-100.0, 258.0],
        lobes: 11,
        depth: 0.13,
    };
    let crown = crown.line(&mut hand);
    hand.outline("auto", &crown, 0.0);
    line(&mut hand, &[[462.0, 604.0], [470.0, 700.0], [462.0, 800.0], [440.0, 880.0], [396.0, 930.0]]);
    line(&mut hand, &[[560.0, 604.0], [556.0, 700.0], [566.0, 800.0], [588.0, 880.0], [640.0, 926.0]]);
    line(&mut hand, &[[512.0, 590.0], [500.0, 520.0], [440.0, 440.0]]);
    line(&mut hand, &[[512.0, 560.0], [560.0, 480.0], [600.0, 400.0]]);
    line(&mut hand, &[[200.0, 940.0], [400.0, 934.0], [640.0, 940.0], [850.0, 932.0]]);
    hand.finish()
}

/// Trunk and crown in one stroke, with apples.
pub fn one_stroke() -> Sheet {
    let mut hand = paper(202);
    let crown = Scallops {
        centre: [500.0, 340.0],
        radii: [270.0, 220.0],
        range: [-105.0, -435.0],
        lobes: 9,
        depth: 0.12,
    };
    let mut whole =
        spline::through(&[at(440.0, 950.0), at(452.0, 800.0), at(446.0, 690.0), at(430.0, 560.0)]);
    whole.extend(crown.line(&mut hand));
    whole.extend(spline::through(&[at(548.0, 560.0), at(540.0, 690.0), at(538.0, 800.0), at(556.0, 952.0)]));
    hand.outline("auto", &whole, 0.0);
    for [x, y] in [[390.0, 300.0], [520.0, 240.0], [620.0, 360.0], [480.0, 420.0]] {
        apple(&mut hand, [x, y]);
    }
    hand.finish()
}

fn apple(hand: &mut Hand, [x, y]: [f64; 2]) {
    let ring: Vec<_> = (0..=20).map(|k| at(x, y) + toward(90.0 + 18.5 * f64::from(k)) * 26.0).collect();
    hand.outline("auto", &ring, 0.0);
}

/// A fir by its zigzag sides, on a short trunk.
pub fn fir() -> Sheet {
    let mut hand = paper(203);
    let tiers = [[92.0, 250.0], [150.0, 400.0], [214.0, 560.0], [280.0, 740.0]];
    let side = |sign: f64| {
        let mut places = vec![at(512.0, 90.0)];
        for (number, [reach, y]) in tiers.into_iter().enumerate() {
            places.push(at(512.0 + sign * reach, y));
            if number + 1 < tiers.len() {
                places.push(at(512.0 + sign * 0.5 * reach, y - 12.0));
            }
        }
        places
    };
    let outline: Vec<_> = side(-1.0).into_iter().rev().chain(side(1.0)).collect();
    let closed: Vec<_> = outline.iter().copied().chain([at(512.0, 752.0), outline[0]]).collect();
    hand.outline("auto", &closed, 0.0);
    corners(
        &mut hand,
        &[
            &[[474.0, 756.0], [472.0, 890.0]],
            &[[472.0, 890.0], [552.0, 892.0]],
            &[[552.0, 892.0], [550.0, 756.0]],
        ],
    );
    hand.finish()
}

/// A palm: a bent trunk of two lines, and fronds as lobes drawn one by one.
pub fn palm() -> Sheet {
    let mut hand = paper(204);
    line(&mut hand, &[[430.0, 960.0], [470.0, 800.0], [486.0, 600.0], [500.0, 400.0]]);
    line(&mut hand, &[[520.0, 962.0], [540.0, 800.0], [542.0, 600.0], [540.0, 404.0]]);
    for (aim, length, fall) in [
        (172.0, 300.0, 150.0),
        (140.0, 290.0, 70.0),
        (100.0, 250.0, 10.0),
        (62.0, 270.0, 40.0),
        (30.0, 300.0, 110.0),
        (2.0, 290.0, 170.0),
    ] {
        frond(&mut hand, aim, length, fall);
    }
    hand.finish()
}

/// A frond out from the trunk's top and back to it, its tip hanging down.
fn frond(hand: &mut Hand, aim: f64, length: f64, fall: f64) {
    let root = at(520.0, 396.0);
    let along = |share: f64, off: f64| {
        root + toward(aim) * (share * length) + toward(aim + 90.0) * off + at(0.0, fall * share * share)
    };
    let out = [along(0.0, 6.0), along(0.3, 40.0), along(0.65, 44.0), along(1.0, 0.0)];
    let back = [along(1.0, 0.0), along(0.65, -14.0), along(0.3, -24.0), along(0.0, -6.0)];
    let lobe: Vec<_> = spline::through(&out).into_iter().chain(spline::through(&back)).collect();
    hand.outline("auto", &lobe, 0.0);
}

/// A bush as an open arch of lobes on the ground, with a few leaves scribbled in.
pub fn bush() -> Sheet {
    let mut hand = paper(205);
    let arch = Scallops {
        centre: [512.0, 800.0],
        radii: [330.0, 330.0],
        range: [186.0, -6.0],
        lobes: 8,
        depth: 0.12,
    };
    let arch = arch.line(&mut hand);
    hand.outline("auto", &arch, 0.0);
    for [x, y] in [[380.0, 680.0], [520.0, 600.0], [640.0, 700.0], [500.0, 740.0]] {
        line(&mut hand, &[[x - 24.0, y + 8.0], [x, y - 14.0], [x + 24.0, y + 6.0]]);
    }
    line(&mut hand, &[[110.0, 838.0], [360.0, 832.0], [640.0, 838.0], [920.0, 832.0]]);
    hand.finish()
}
