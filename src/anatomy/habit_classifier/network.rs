//! The trained network: its classes, its file and its evaluation.
//!
//! The file holds whole numbers from −127 to 127, a byte for each weight, row by row: the hidden layer's weights, then the last
//! one's. Before each row come its scale and its constant as little-endian numbers of four bytes; at the beginning the mean
//! and the reciprocal deviation of each feature.

use super::features::{FEATURES, features};
use glam::Vec2;
use thiserror::Error;

/// Rectified sums between features and classes.
pub const HIDDEN: usize = 64;

/// A kind of drawing that the network tells from others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Class {
    /// Foliage that stands on the ground.
    Bush,
    /// A cactus.
    Cactus,
    /// A flower.
    Flower,
    /// Several plants.
    Garden,
    /// Blades of grass.
    Grass,
    /// A plant in a pot.
    Potted,
    /// A single leaf.
    Leaf,
    /// A mushroom.
    Mushroom,
    /// A trunk with fronds.
    Palm,
    /// A trunk with a crown.
    Tree,
}

/// All of them, in the order of the network's last layer.
pub const CLASSES: [Class; 10] = [
    Class::Bush,
    Class::Cactus,
    Class::Flower,
    Class::Garden,
    Class::Grass,
    Class::Potted,
    Class::Leaf,
    Class::Mushroom,
    Class::Palm,
    Class::Tree,
];

/// A network file that cannot be used.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error(
    "the file of the classifier of drawings has {found} bytes and not {expected}; train it again with the example `train_habits`"
)]
pub struct NetworkError {
    /// Bytes that it should have.
    pub expected: usize,
    /// Bytes that it has.
    pub found: usize,
}

/// How likely a drawing is of each class; the sum is 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Likeness([f32; CLASSES.len()]);

impl Likeness {
    /// How likely it is of a class.
    pub fn of(&self, class: Class) -> f32 {
        self.0[class as usize]
    }

    /// The likeliest class, of equals the first.
    pub fn best(&self) -> Class {
        let order = |a: &&Class, b: &&Class| self.of(**a).total_cmp(&self.of(**b)).then(b.cmp(a));
        CLASSES.iter().max_by(order).copied().unwrap_or(Class::Tree)
    }
}

#[cfg(test)]
impl Likeness {
    /// So likely of one class, and equally of all others.
    pub(crate) fn of_one(class: Class, likely: f32) -> Self {
        let others = (1.0 - likely) / (CLASSES.len() - 1) as f32;
        Self(CLASSES.map(|other| if other == class { likely } else { others }))
    }
}

/// A layer of sums of its inputs.
#[derive(Clone, Debug, Default, PartialEq)]
struct Layer {
    /// A row of weights for each sum.
    weights: Vec<f32>,
    /// A constant for each.
    constants: Vec<f32>,
}

impl Layer {
    fn sums(&self, inputs: &[f32]) -> Vec<f32> {
        let rows = self.weights.chunks_exact(inputs.len()).zip(&self.constants);
        rows.map(|(row, constant)| row.iter().zip(inputs).map(|(w, x)| w * x).sum::<f32>() + constant)
            .collect()
    }

    /// That of so many sums of so many inputs, from the beginning of a file, which is cut off.
    fn read(bytes: &mut &[u8], inputs: usize, sums: usize) -> Self {
        let mut it = Self::default();
        for _ in 0..sums {
            let scale = number(bytes);
            it.constants.push(number(bytes));
            let (row, rest) = bytes.split_at(inputs);
            it.weights.extend(row.iter().map(|byte| f32::from(*byte as i8) * scale));
            *bytes = rest;
        }
        it
    }

    fn write(&self, out: &mut Vec<u8>) {
        let inputs = self.weights.len() / self.constants.len().max(1);
        for (row, constant) in self.weights.chunks_exact(inputs).zip(&self.constants) {
            let scale = row.iter().fold(f32::MIN_POSITIVE, |most, weight| most.max(weight.abs())) / 127.0;
            out.extend(scale.to_le_bytes());
            out.extend(constant.to_le_bytes());
            out.extend(row.iter().map(|weight| (weight / scale).round() as i8 as u8));
        }
    }
}

fn number(bytes: &mut &[u8]) -> f32 {
    let (number, rest) = bytes.split_at(4);
    *bytes = rest;
    f32::from_le_bytes([number[0], number[1], number[2], number[3]])
}

/// A trained network.
#[derive(Clone, Debug, PartialEq)]
pub struct Network {
    mean: Vec<f32>,
    /// One over the deviation of each feature.
    scale: Vec<f32>,
    hidden: Layer,
    last: Layer,
}

impl Network {
    /// Bytes of a file.
    const BYTES: usize = 8 * FEATURES + HIDDEN * (8 + FEATURES) + CLASSES.len() * (8 + HIDDEN);

    /// One of these weights, row by row; those of the hidden layer have a row of features for each hidden sum.
    pub fn new(
        (mean, scale): (Vec<f32>, Vec<f32>),
        (hidden, hidden_constants): (Vec<f32>, Vec<f32>),
        (last, last_constants): (Vec<f32>, Vec<f32>),
    ) -> Self {
        let hidden = Layer { weights: hidden, constants: hidden_constants };
        Self { mean, scale, hidden, last: Layer { weights: last, constants: last_constants } }
    }

    /// Reads a file.
    ///
    /// # Errors
    /// A file of another length.
    pub fn read(mut bytes: &[u8]) -> Result<Self, NetworkError> {
        if bytes.len() != Self::BYTES {
            return Err(NetworkError { expected: Self::BYTES, found: bytes.len() });
        }
        let bytes = &mut bytes;
        let mean = (0..FEATURES).map(|_| number(bytes)).collect();
        let scale = (0..FEATURES).map(|_| number(bytes)).collect();
        let hidden = Layer::read(bytes, FEATURES, HIDDEN);
        Ok(Self { mean, scale, hidden, last: Layer::read(bytes, HIDDEN, CLASSES.len()) })
    }

    /// The bytes of its file, in which weights are rounded.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut out = Vec::with_capacity(Self::BYTES);
        self.mean.iter().chain(&self.scale).for_each(|number| out.extend(number.to_le_bytes()));
        self.hidden.write(&mut out);
        self.last.write(&mut out);
        out
    }

    /// What a drawing of these lines looks like; nothing if it has no extent.
    pub fn likeness<L: AsRef<[Vec2]>>(&self, lines: &[L]) -> Option<Likeness> {
        Some(self.of_features(&features(lines)?))
    }

    /// The same from features.
    pub fn of_features(&self, features: &[f32]) -> Likeness {
        let standard = features.iter().zip(&self.mean).zip(&self.scale);
        let inputs: Vec<f32> = standard.map(|((x, mean), scale)| (x - mean) * scale).collect();
        let mut hidden = self.hidden.sums(&inputs);
        hidden.iter_mut().for_each(|sum| *sum = sum.max(0.0));
        let sums = self.last.sums(&hidden);
        let most = sums.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        let mut likely = [0.0; CLASSES.len()];
        likely.iter_mut().zip(sums).for_each(|(likely, sum)| *likely = (sum - most).exp());
        let whole: f32 = likely.iter().sum();
        Likeness(likely.map(|likely| likely / whole))
    }
}
