//! Petals seen end-on, in flowers and beside them.

use crate::anatomy::flowers::{FlowerParams, gather};
use crate::anatomy::{FlatBlade, Sample};
use crate::sketch::Tool;
use glam::Vec2;
use std::f32::consts::TAU;

fn blade(id: u64, root: Vec2, axis: Vec2) -> (FlatBlade, Tool) {
    let side = axis.perp() * 0.3;
    let outline = [root, root + axis * 0.5 + side, root + axis, root + axis * 0.5 - side];
    let outline = outline.map(Sample::neutral).into();
    let (stroke, tip) = (Some(id), root + axis);
    (FlatBlade { stroke, outline, root, tip, copy_of: None, attachment: None }, Tool::Petal)
}

/// Petals around the origin from a foot, of these lengths.
fn ring(lengths: &[f32], foot: f32) -> Vec<(FlatBlade, Tool)> {
    let petal = |(k, length): (usize, &f32)| {
        let out = Vec2::from_angle(TAU * k as f32 / lengths.len() as f32);
        blade(k as u64, out * foot, out * *length)
    };
    lengths.iter().enumerate().map(petal).collect()
}

fn petals_of_flowers(blades: Vec<(FlatBlade, Tool)>) -> Vec<usize> {
    let gathering = gather(blades, &[], &FlowerParams::default());
    gathering.flowers.iter().map(|flower| flower.petals.len()).collect()
}

#[test]
fn one_and_several_end_on_petals_stay_in_their_flower() {
    assert_eq!(petals_of_flowers(ring(&[100.0, 90.0, 5.0, 90.0, 100.0], 12.0)), [5]);
    let several = [100.0, 100.0, 90.0, 60.0, 9.0, 8.0, 9.0, 60.0, 90.0, 100.0, 100.0, 100.0, 100.0];
    assert_eq!(petals_of_flowers(ring(&several, 12.0)), [13]);
}

#[test]
fn a_small_flower_before_a_large_one_stays_a_flower() {
    let mut blades = ring(&[100.0; 8], 10.0);
    let small = ring(&[8.0; 6], 0.5).into_iter();
    blades.extend(small.map(|(petal, tool)| {
        let off = Vec2::new(18.0, 0.0);
        (blade(20 + petal.stroke.unwrap(), petal.root + off, petal.axis()).0, tool)
    }));
    assert_eq!(petals_of_flowers(blades), [8, 6]);
}

#[test]
fn blades_beside_a_flower_stay_what_they_are() {
    let mut blades = ring(&[100.0; 8], 10.0);
    blades.push(blade(20, Vec2::new(0.0, 45.0), Vec2::new(4.0, 8.0)));
    assert_eq!(petals_of_flowers(blades), [8, 1]);
}
