//! A bouquet: a rose, a daisy and a hepatica-like anemone, their stems crossing where a hand would hold them.

use super::super::flower::Flower;
use super::super::forms::{BALLOON_LEAF, DAISY_PETAL, HEPATICA_PETAL, ROSE_LEAF, ROSE_PETAL};
use super::super::hand::{Hand, at};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("bouquet", [768, 1024], 101);
    let rose =
        Flower { petals: 8, opening: 58.0, turn: 10.0, ..Flower::new(at(352.0, 478.0), 196.0, 96.0, 56.0) };
    let heart = Flower { petals: 5, opening: 34.0, turn: 32.0, length: 124.0, ..rose };
    let daisy =
        Flower { petals: 17, opening: 66.0, turn: 4.0, ..Flower::new(at(246.0, 176.0), 164.0, 112.0, 56.0) };
    let anemone =
        Flower { petals: 7, opening: 61.0, turn: 16.0, ..Flower::new(at(574.0, 300.0), 170.0, 52.0, 48.0) };
    let rose_stem =
        rose.stalk(&mut hand, &[at(352.0, 1008.0), at(384.0, 880.0), at(378.0, 720.0)], [0.74, 0.5]);
    let daisy_line = [at(500.0, 1000.0), at(402.0, 850.0), at(268.0, 660.0), at(222.0, 430.0)];
    let daisy_stem = daisy.stalk(&mut hand, &daisy_line, [0.58, 0.38]);
    let anemone_line = [at(250.0, 992.0), at(366.0, 866.0), at(478.0, 690.0), at(536.0, 500.0)];
    let anemone_stem = anemone.stalk(&mut hand, &anemone_line, [0.58, 0.38]);
    rose.draw(&mut hand, &ROSE_PETAL);
    heart.draw(&mut hand, &ROSE_PETAL);
    daisy.draw(&mut hand, &DAISY_PETAL);
    anemone.draw(&mut hand, &HEPATICA_PETAL);
    let leaf = |base, aim, length, bend: f64| Leaf::new(base, aim, length).bent(bend, -bend);
    leaf(rose_stem.point(0.6), 52.0, 116.0, 10.0).turned(0.8, 1.0).draw(&mut hand, &ROSE_LEAF);
    leaf(daisy_stem.point(0.27), 190.0, 150.0, -14.0).turned(1.0, 0.85).draw(&mut hand, &ROSE_LEAF);
    leaf(daisy_stem.point(0.44), 164.0, 206.0, -16.0).turned(1.0, 0.75).draw(&mut hand, &BALLOON_LEAF);
    leaf(anemone_stem.point(0.46), 14.0, 208.0, 16.0).turned(0.75, 1.0).draw(&mut hand, &BALLOON_LEAF);
    leaf(anemone_stem.point(0.3), -12.0, 172.0, 14.0).turned(0.85, 1.0).draw(&mut hand, &ROSE_LEAF);
    hand.finish()
}
