//! Labelled synthetic strokes: what the classifier is trained on, and tested on with another seed.
//!
//! A family of shapes ([`blade`], [`branch`]) gives an ideal line of unit size; [`hand`] draws it as a person would.
//! Every random choice comes from the seed. Families take turns, so that each has the same share of its class.

pub(crate) mod blade;
pub(crate) mod branch;
pub(crate) mod hand;

use glam::Vec2;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

/// Seed of the strokes that the shipped model was trained on.
pub(crate) const TRAINING_SEED: u64 = 1;
/// Seed of strokes that no model was trained on.
pub(crate) const HELD_OUT_SEED: u64 = 2;

/// One way to draw a part: its name and its ideal line.
pub(crate) type Family = (&'static str, fn(&mut Pcg64Mcg) -> Vec<Vec2>);

/// A stroke and what it is.
pub(crate) struct LabelledStroke {
    /// The shape it was made from.
    pub(crate) family: &'static str,
    /// Petal or leaf; otherwise branch.
    pub(crate) blade: bool,
    /// Positions in pixels, as a pen would report them.
    pub(crate) points: Vec<Vec2>,
}

/// `per_class` blades and as many branches, taking turns.
pub(crate) fn strokes(per_class: usize, seed: u64) -> Vec<LabelledStroke> {
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let mut draw = |families: &[Family], turn: usize, blade| {
        let (family, ideal) = families[turn % families.len()];
        let line = ideal(&mut rng);
        LabelledStroke { family, blade, points: hand::draw(&line, &mut rng) }
    };
    (0..per_class)
        .flat_map(|turn| [draw(blade::FAMILIES, turn, true), draw(branch::FAMILIES, turn, false)])
        .collect()
}
