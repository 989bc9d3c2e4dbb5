//! Trains the network: cross-entropy with a decay of weights, by the method of Kingma and Ba (“Adam”, 2015).
//!
//! The aim for an example is not its class alone but a little of all classes (C. Szegedy et al., “Rethinking the Inception
//! architecture for computer vision”, 2016, section 7): the network is then seldom sure of what is wrong.

use super::Known;
use penstemon::anatomy::habit_classifier::{CLASSES, FEATURES, HIDDEN, Network};
use penstemon::random::stream;
use rand::RngExt;
use rand::seq::SliceRandom;

const ROUNDS: usize = 60;
const BATCH: usize = 200;
const RATE: f32 = 1e-3;
/// How fast weights decay that nothing asks for.
const DECAY: f32 = 5e-3;
/// What the aim for an example gives to all classes together.
const SMOOTH: f32 = 0.1;
/// How slowly Adam forgets mean and square of the slopes.
const FORGET: (f32, f32) = (0.9, 0.999);

/// Weights with what Adam keeps of their slopes.
struct Weights {
    of: Vec<f32>,
    slope: Vec<f32>,
    mean: Vec<f32>,
    square: Vec<f32>,
    decay: f32,
}

impl Weights {
    fn new(of: Vec<f32>, decay: f32) -> Self {
        let none = vec![0.0; of.len()];
        Self { slope: none.clone(), mean: none.clone(), square: none, of, decay }
    }

    /// One step against the slopes that were added up over so many examples.
    fn step(&mut self, examples: f32, time: i32) {
        let (keep_mean, keep_square) = FORGET;
        let corrected = RATE * (1.0 - keep_square.powi(time)).sqrt() / (1.0 - keep_mean.powi(time));
        for k in 0..self.of.len() {
            let slope = self.slope[k] / examples + self.decay * self.of[k];
            self.mean[k] = keep_mean * self.mean[k] + (1.0 - keep_mean) * slope;
            self.square[k] = keep_square * self.square[k] + (1.0 - keep_square) * slope * slope;
            self.of[k] -= corrected * self.mean[k] / (self.square[k].sqrt() + 1e-8);
            self.slope[k] = 0.0;
        }
    }
}

/// A network that knows these drawings in all hands.
pub(super) fn train<'a>(known: impl IntoIterator<Item = &'a Known>) -> Network {
    let examples: Vec<(usize, &Vec<f32>)> = known
        .into_iter()
        .flat_map(|known| known.features.iter().map(|f| (known.class as usize, f)))
        .collect();
    let (mean, scale) = standard(&examples);
    let examples: Vec<(usize, Vec<f32>)> = examples
        .into_iter()
        .map(|(class, f)| (class, (0..FEATURES).map(|k| (f[k] - mean[k]) * scale[k]).collect()))
        .collect();
    let mut rng = stream(0, "train habits", 0);
    let mut random = |count: usize, ends: usize| {
        let reach = (6.0 / ends as f32).sqrt();
        (0..count).map(|_| rng.random_range(-reach..reach)).collect::<Vec<f32>>()
    };
    let mut hidden = Weights::new(random(HIDDEN * FEATURES, HIDDEN + FEATURES), DECAY);
    let mut last = Weights::new(random(CLASSES.len() * HIDDEN, HIDDEN + CLASSES.len()), DECAY);
    let mut hidden_constants = Weights::new(vec![0.0; HIDDEN], 0.0);
    let mut last_constants = Weights::new(vec![0.0; CLASSES.len()], 0.0);
    let mut order: Vec<usize> = (0..examples.len()).collect();
    let mut time = 0;
    for _ in 0..ROUNDS {
        order.shuffle(&mut rng);
        for batch in order.chunks(BATCH) {
            for &place in batch {
                let (class, inputs) = &examples[place];
                learn(*class, inputs, (&mut hidden, &mut hidden_constants), (&mut last, &mut last_constants));
            }
            time += 1;
            for weights in [&mut hidden, &mut hidden_constants, &mut last, &mut last_constants] {
                weights.step(batch.len() as f32, time);
            }
        }
    }
    Network::new((mean, scale), (hidden.of, hidden_constants.of), (last.of, last_constants.of))
}

/// Mean and reciprocal deviation of each feature.
fn standard(examples: &[(usize, &Vec<f32>)]) -> (Vec<f32>, Vec<f32>) {
    let count = examples.len() as f32;
    let of = |k: usize| {
        let mean = examples.iter().map(|(_, f)| f[k]).sum::<f32>() / count;
        let variance = examples.iter().map(|(_, f)| (f[k] - mean).powi(2)).sum::<f32>() / count;
        (mean, if variance > 1e-10 { 1.0 / variance.sqrt() } else { 0.0 })
    };
    (0..FEATURES).map(of).unzip()
}

/// Adds what one example asks for to the slopes.
fn learn(
    class: usize,
    inputs: &[f32],
    (hidden, hidden_constants): (&mut Weights, &mut Weights),
    (last, last_constants): (&mut Weights, &mut Weights),
) {
    let sum = |row: &[f32], of: &[f32]| row.iter().zip(of).map(|(w, x)| w * x).sum::<f32>();
    let rows = hidden.of.chunks_exact(FEATURES).zip(&hidden_constants.of);
    let rectified: Vec<f32> = rows.map(|(row, constant)| (sum(row, inputs) + constant).max(0.0)).collect();
    let rows = last.of.chunks_exact(HIDDEN).zip(&last_constants.of);
    let sums: Vec<f32> = rows.map(|(row, constant)| sum(row, &rectified) + constant).collect();
    let most = sums.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let exps: Vec<f32> = sums.iter().map(|sum| (sum - most).exp()).collect();
    let whole: f32 = exps.iter().sum();
    let mut back = vec![0.0; HIDDEN];
    for (k, exp) in exps.into_iter().enumerate() {
        let own = if k == class { 1.0 - SMOOTH } else { 0.0 };
        let error = exp / whole - own - SMOOTH / CLASSES.len() as f32;
        last_constants.slope[k] += error;
        let row = k * HIDDEN..(k + 1) * HIDDEN;
        last.slope[row.clone()].iter_mut().zip(&rectified).for_each(|(slope, x)| *slope += error * x);
        back.iter_mut().zip(&last.of[row]).for_each(|(back, weight)| *back += error * weight);
    }
    for (k, error) in back.into_iter().enumerate().filter(|(k, _)| rectified[*k] > 0.0) {
        hidden_constants.slope[k] += error;
        let row = k * FEATURES..(k + 1) * FEATURES;
        hidden.slope[row].iter_mut().zip(inputs).for_each(|(slope, x)| *slope += error * x);
    }
}
