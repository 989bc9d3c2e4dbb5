//! Drawings that are hard to understand: several plants, crossing branches, flowers of very different size.

use super::super::flower::Flower;
use super::super::forms::{
    BALLOON_LEAF, DAISY_PETAL, HEPATICA_PETAL, MALLOW_PETAL, PLUMERIA_LEAF, ROSE_LEAF,
};
use super::super::hand::{Hand, at};
use super::super::leaf::Leaf;
use super::super::sheet::Sheet;

/// Two plants side by side whose leaves reach toward each other.
pub fn two_plants() -> Sheet {
    let mut hand = Hand::new("daisy", [1024, 768], 121);
    let daisy = Flower { petals: 15, opening: 66.0, ..Flower::new(at(290.0, 210.0), 140.0, 108.0, 50.0) };
    let left = daisy.stalk(&mut hand, &[at(302.0, 740.0), at(318.0, 600.0), at(300.0, 440.0)], [0.6, 0.38]);
    daisy.draw(&mut hand, &DAISY_PETAL);
    let mallow = Flower { opening: 60.0, turn: 20.0, ..Flower::new(at(716.0, 228.0), 150.0, 66.0, 52.0) };
    let right = mallow.stalk(&mut hand, &[at(708.0, 744.0), at(688.0, 600.0), at(700.0, 440.0)], [0.7, 0.4]);
    mallow.draw(&mut hand, &MALLOW_PETAL);
    for (stem, node, aim, length) in [
        (&left, 0.18, 160.0, 210.0),
        (&left, 0.36, 24.0, 178.0),
        (&right, 0.2, 22.0, 220.0),
        (&right, 0.34, 158.0, 182.0),
        (&right, 0.5, 30.0, 160.0),
    ] {
        Leaf::new(stem.point(node), aim, length).bent(10.0, -12.0).draw(&mut hand, &PLUMERIA_LEAF);
    }
    hand.finish()
}

/// One trunk with branches that cross each other, run side by side and almost touch; some drawn from the end.
pub fn crossing_branches() -> Sheet {
    let mut hand = Hand::new("maple", [1024, 768], 122);
    let trunk = hand.branch(
        &[at(512.0, 748.0), at(500.0, 600.0), at(520.0, 420.0), at(506.0, 250.0), at(516.0, 90.0)],
        [1.0, 0.4],
    );
    let low =
        hand.branch(&[trunk.point(0.25), at(640.0, 470.0), at(800.0, 300.0), at(880.0, 140.0)], [0.7, 0.32]);
    hand.branch_reversed(
        &[trunk.point(0.55), at(640.0, 330.0), at(790.0, 420.0), at(930.0, 440.0)],
        [0.6, 0.3],
    );
    hand.branch(&[low.point(0.35), at(720.0, 470.0), at(850.0, 520.0)], [0.46, 0.26]);
    let first =
        hand.branch(&[trunk.point(0.3), at(400.0, 460.0), at(260.0, 380.0), at(120.0, 350.0)], [0.66, 0.3]);
    hand.branch_reversed(
        &[trunk.point(0.36), at(400.0, 430.0), at(268.0, 352.0), at(140.0, 300.0)],
        [0.6, 0.3],
    );
    hand.branch(&[first.point(0.5), at(270.0, 330.0), at(300.0, 210.0), at(250.0, 110.0)], [0.44, 0.24]);
    hand.branch(&[trunk.point(0.66), at(430.0, 250.0), at(330.0, 190.0), at(180.0, 180.0)], [0.5, 0.26]);
    for (branch, node, aim) in [(&low, 0.8, 10.0), (&first, 0.8, 230.0), (&first, 0.98, 170.0)] {
        Leaf::new(branch.point(node), aim, 96.0).bent(10.0, -12.0).draw(&mut hand, &ROSE_LEAF);
    }
    hand.finish()
}

/// A flower, one half as large, one a quarter and one an eighth, on one branching stem.
pub fn many_scales() -> Sheet {
    let mut hand = Hand::new("hepatica_blue", [1024, 768], 123);
    let flower = |x, y, size, faces, lift, petals| Flower {
        petals,
        opening: 62.0,
        turn: 12.0,
        ..Flower::new(at(x, y), size, faces, lift)
    };
    let large = flower(330.0, 240.0, 220.0, 100.0, 56.0, 8);
    let stem = large.stalk(&mut hand, &[at(520.0, 752.0), at(500.0, 640.0), at(400.0, 450.0)], [0.8, 0.42]);
    large.draw(&mut hand, &HEPATICA_PETAL);
    for (small, node) in [
        (flower(690.0, 270.0, 110.0, 50.0, 50.0, 7), 0.4),
        (flower(820.0, 480.0, 56.0, 30.0, 46.0, 6), 0.25),
        (flower(700.0, 600.0, 28.0, 20.0, 48.0, 6), 0.1),
    ] {
        let from = stem.point(node);
        small.stalk(&mut hand, &[from, from.lerp(small.heart, 0.5) + at(0.0, 20.0)], [0.46, 0.28]);
        small.draw(&mut hand, &HEPATICA_PETAL);
    }
    Leaf::new(stem.point(0.2), 166.0, 230.0).bent(-8.0, 10.0).draw(&mut hand, &BALLOON_LEAF);
    Leaf::new(stem.point(0.34), 152.0, 120.0).bent(-8.0, 10.0).draw(&mut hand, &BALLOON_LEAF);
    hand.finish()
}
