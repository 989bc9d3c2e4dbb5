//! A plant in a pot, and a cactus.

use super::super::super::hand::{Hand, at, toward};
use super::super::super::sheet::Sheet;
use super::super::super::spline;
use super::{corners, line, paper};

/// A house plant: a pot with a rim, a stem, and leaves whose stalks are one stroke with them.
pub fn house_plant() -> Sheet {
    let mut hand = paper(221);
    corners(
        &mut hand,
        &[
            &[[372.0, 730.0], [410.0, 960.0]],
            &[[410.0, 960.0], [614.0, 962.0]],
            &[[614.0, 962.0], [652.0, 732.0]],
        ],
    );
    corners(
        &mut hand,
        &[
            &[[350.0, 672.0], [674.0, 674.0]],
            &[[674.0, 674.0], [668.0, 734.0]],
            &[[668.0, 734.0], [356.0, 730.0]],
            &[[356.0, 730.0], [350.0, 672.0]],
        ],
    );
    line(&mut hand, &[[512.0, 672.0], [520.0, 520.0], [506.0, 360.0], [514.0, 220.0]]);
    for ([x, y], aim, length) in [
        ([516.0, 590.0], 160.0, 210.0),
        ([517.0, 520.0], 22.0, 220.0),
        ([512.0, 430.0], 150.0, 190.0),
        ([508.0, 350.0], 34.0, 190.0),
        ([514.0, 222.0], 96.0, 150.0),
    ] {
        stalked_leaf(&mut hand, [x, y], aim, length);
    }
    hand.finish()
}

/// A stalk that goes on around a blade and ends where it began.
fn stalked_leaf(hand: &mut Hand, [x, y]: [f64; 2], aim: f64, length: f64) {
    let place = |share: f64, off: f64| at(x, y) + toward(aim) * (share * length) + toward(aim + 90.0) * off;
    let half = 0.21 * length;
    let stalk = [place(0.0, 0.0), place(0.14, 5.0), place(0.28, 0.0)];
    let out = [place(0.28, 0.0), place(0.5, half), place(0.75, 0.8 * half), place(1.0, 0.0)];
    let back = [place(1.0, 0.0), place(0.75, -0.75 * half), place(0.5, -half), place(0.29, -3.0)];
    let whole: Vec<_> = [&stalk[..], &out, &back].into_iter().flat_map(spline::through).collect();
    hand.outline("auto", &whole, 0.0);
}

/// A cactus in one outline, its arms too, with spines and the ground.
pub fn cactus() -> Sheet {
    let mut hand = paper(222);
    let outline = [
        [430.0, 950.0],
        [428.0, 760.0],
        [424.0, 700.0],
        [330.0, 690.0],
        [262.0, 640.0],
        [248.0, 500.0],
        [262.0, 420.0],
        [300.0, 404.0],
        [336.0, 430.0],
        [342.0, 520.0],
        [360.0, 590.0],
        [424.0, 600.0],
        [426.0, 420.0],
        [430.0, 200.0],
        [466.0, 130.0],
        [520.0, 112.0],
        [572.0, 134.0],
        [604.0, 200.0],
        [606.0, 400.0],
        [606.0, 500.0],
        [664.0, 494.0],
        [690.0, 420.0],
        [694.0, 330.0],
        [732.0, 296.0],
        [774.0, 322.0],
        [786.0, 430.0],
        [764.0, 550.0],
        [700.0, 598.0],
        [608.0, 604.0],
        [604.0, 780.0],
        [606.0, 952.0],
    ];
    line(&mut hand, &outline);
    for [x, y] in [
        [480.0, 260.0],
        [540.0, 330.0],
        [490.0, 430.0],
        [550.0, 520.0],
        [484.0, 620.0],
        [548.0, 720.0],
        [486.0, 820.0],
    ] {
        line(&mut hand, &[[x, y], [x + 8.0, y + 14.0], [x + 4.0, y + 30.0]]);
    }
    line(&mut hand, &[[250.0, 958.0], [500.0, 954.0], [800.0, 960.0]]);
    hand.finish()
}
