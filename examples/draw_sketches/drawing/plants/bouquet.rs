//! A bouquet: a rose, a daisy and a hepatica-like anemone, their stems crossing where a hand would hold them.

use super::super::flower::Flower;
use super::super::forms::{BALLOON_LEAF, DAISY_PETAL, HEPATICA_PETAL, ROSE_LEAF, ROSE_PETAL};
use super::super::hand::{Hand, at};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;

/// The drawing.
pub fn draw() -> Sheet {
    let mut hand = Hand::new("bouquet", [768, 1024], 101);
    let rose = Flower { petals: 8, opening: 58.0, turn: 10.0, ..Flower::new(at(394.0, 420.0), 166.0, 84.0, 52.0) };
    let heart = Flower { petals: 5, opening: 34.0, turn: 32.0, length: 106.0, ..rose };
    let daisy = Flower { petals: 17, opening: 66.0, turn: 4.0, ..Flower::new(at(206.0, 214.0), 150.0, 122.0, 48.0) };
    let anemone = Flower { petals: 7, opening: 62.0, turn: 16.0, ..Flower::new(at(576.0, 214.0), 144.0, 58.0, 46.0) };
    let rose_stem = rose.stalk(&mut hand, &[at(372.0, 1002.0), at(384.0, 860.0), at(396.0, 690.0)], [0.7, 0.46]);
    let daisy_stem =
        daisy.stalk(&mut hand, &[at(486.0, 996.0), at(410.0, 838.0), at(330.0, 640.0), at(268.0, 440.0)], [0.56, 0.36]);
    let anemone_stem =
        anemone.stalk(&mut hand, &[at(276.0, 994.0), at(364.0, 842.0), at(458.0, 640.0), at(528.0, 430.0)], [0.56, 0.36]);
    rose.draw(&mut hand, &ROSE_PETAL);
    heart.draw(&mut hand, &ROSE_PETAL);
    daisy.draw(&mut hand, &DAISY_PETAL);
    anemone.draw(&mut hand, &HEPATICA_PETAL);
    let leaf = |base, aim, length, bend: f64| Leaf::new(base, aim, length).bent(bend, -bend);
    leaf(rose_stem.point(0.52), 8.0, 150.0, 16.0).turned(0.8, 1.0).draw(&mut hand, &ROSE_LEAF);
    leaf(rose_stem.point(0.44), 172.0, 140.0, -16.0).turned(1.0, 0.8).draw(&mut hand, &ROSE_LEAF);
    leaf(daisy_stem.point(0.46), 166.0, 190.0, -20.0).turned(1.0, 0.7).draw(&mut hand, &BALLOON_LEAF);
    leaf(anemone_stem.point(0.5), 12.0, 190.0, 20.0).turned(0.7, 1.0).draw(&mut hand, &BALLOON_LEAF);
    hand.finish()
}
