//! Training: standardise, choose kernel and penalty by cross-validation, fit, calibrate, write.
//!
//! Among the settings whose machine is small enough to ship, the smoothest wins whose cross-validated accuracy is within
//! one standard error of the best: a rough machine gains a stroke or two in training and is unsure of plain straight
//! lines. The sigmoid (Platt 1999) is fitted to the decisions of machines that had not seen the stroke, because a machine is too
//! sure of the strokes it was trained on.

use crate::synthetic::{self, TRAINING_SEED};
use anyhow::Context;
use linfa::composing::platt_scaling::platt_newton_method;
use linfa::prelude::*;
use linfa::{ParamGuard, Platt};
use linfa_svm::Svm as Fitted;
use ndarray::{Array1, Array2};
use penstemon::anatomy::features::stroke_features;
use penstemon::anatomy::svm::{FEATURES, MAX_VECTORS, Svm};
use std::fmt::Write;
use std::io;

const PER_CLASS: usize = 715;
const FOLDS: usize = 4;
const GAMMAS: [f64; 4] = [0.05, 0.1, 0.2, 0.4];
const PENALTIES: [f64; 5] = [10.0, 30.0, 100.0, 300.0, 1000.0];
/// The solver stops when the optimality conditions hold this closely.
const PRECISION: f64 = 1e-3;
/// A weight smaller than this share of the penalty is none.
const NEGLIGIBLE: f64 = 1e-7;

type Point = [f64; FEATURES];

struct Samples {
    points: Vec<Point>,
    blades: Vec<bool>,
}

#[derive(Clone, Copy)]
struct Setting {
    gamma: f64,
    penalty: f64,
}

/// Weights and positions of the support vectors, and the offset.
struct Machine {
    setting: Setting,
    vectors: Vec<(f64, Point)>,
    offset: f64,
}

/// A setting's machine with what cross-validation says of it.
struct Candidate {
    machine: Machine,
    unseen: Vec<f64>,
    right: usize,
}

/// The text of a newly trained model.
pub(crate) fn train() -> anyhow::Result<String> {
    let strokes = synthetic::strokes(PER_CLASS, TRAINING_SEED);
    let raw: Vec<Point> =
        strokes.iter().map(|s| stroke_features(&s.points).as_array().map(f64::from)).collect();
    let scaling = Scaling::of(&raw);
    let samples = Samples {
        points: raw.into_iter().map(|p| scaling.standardise(p)).collect(),
        blades: strokes.iter().map(|s| s.blade).collect(),
    };
    let best = best_candidate(&samples)?;
    let sigmoid = calibrated(&best.unseen, &samples.blades)?;
    let text = model_text(&scaling, &best.machine, sigmoid)?;
    Svm::parse(&text).context("the program refuses the new model")?;
    Ok(text)
}

fn best_candidate(samples: &Samples) -> anyhow::Result<Candidate> {
    let mut small = Vec::new();
    for (gamma, penalty) in GAMMAS.into_iter().flat_map(|g| PENALTIES.map(|p| (g, p))) {
        let candidate = cross_validated(samples, Setting { gamma, penalty })?;
        let vectors = candidate.machine.vectors.len();
        report(&format!(
            "gamma {gamma:<4} penalty {penalty:<4} right {} vectors {vectors}",
            candidate.right
        ))?;
        small.extend((vectors <= MAX_VECTORS).then_some(candidate));
    }
    let most =
        small.iter().map(|c| c.right).max().context("no setting gives a machine small enough to ship")?;
    let share = most as f64 / samples.points.len() as f64;
    let standard_error = (most as f64 * (1.0 - share)).sqrt();
    // Settings come smoothest first.
    let chosen = small.into_iter().find(|c| c.right as f64 >= most as f64 - standard_error);
    chosen.context("no setting is as good as the best")
}

fn report(line: &str) -> io::Result<()> {
    io::Write::write_all(&mut io::stderr(), format!("{line}\n").as_bytes())
}

fn cross_validated(samples: &Samples, setting: Setting) -> anyhow::Result<Candidate> {
    let mut unseen = vec![0.0; samples.points.len()];
    // The families take turns, so that a run of strokes has its share of each.
    let fold_of = |i: usize| i * FOLDS / samples.points.len();
    for fold in 0..FOLDS {
        let machine = fit(samples, setting, |i| fold_of(i) != fold)?;
        for (i, point) in samples.points.iter().enumerate().filter(|(i, _)| fold_of(*i) == fold) {
            unseen[i] = machine.decision(point);
        }
    }
    let right = unseen.iter().zip(&samples.blades).filter(|&(d, &blade)| (*d >= 0.0) == blade).count();
    Ok(Candidate { machine: fit(samples, setting, |_| true)?, unseen, right })
}

fn fit(samples: &Samples, setting: Setting, takes: impl Fn(usize) -> bool) -> anyhow::Result<Machine> {
    let taken: Vec<usize> = (0..samples.points.len()).filter(|&i| takes(i)).collect();
    let points = Array2::from_shape_fn((taken.len(), FEATURES), |(i, k)| samples.points[taken[i]][k]);
    let blades = Array1::from_iter(taken.iter().map(|&i| samples.blades[i]));
    let fitted = Fitted::<f64, bool>::params()
        .pos_neg_weights(setting.penalty, setting.penalty)
        .gaussian_kernel(1.0 / setting.gamma)
        .eps(PRECISION)
        .fit(&Dataset::new(points, blades))?;
    let weights = taken.iter().zip(&fitted.alpha).filter(|(_, w)| w.abs() > NEGLIGIBLE * setting.penalty);
    let vectors = weights.map(|(&i, &weight)| (weight, samples.points[i])).collect();
    Ok(Machine { setting, vectors, offset: fitted.rho })
}

impl Machine {
    fn decision(&self, point: &Point) -> f64 {
        let squared = |v: &Point| v.iter().zip(point).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
        self.vectors.iter().map(|(w, v)| w * (-self.setting.gamma * squared(v)).exp()).sum::<f64>()
            - self.offset
    }
}

fn calibrated(decisions: &[f64], blades: &[bool]) -> anyhow::Result<(f64, f64)> {
    let parameters = Platt::<f64, ()>::params().check()?;
    let decisions = Array1::from_iter(decisions.iter().copied());
    let blades = Array1::from_iter(blades.iter().copied());
    Ok(platt_newton_method(decisions.view(), blades.view(), &parameters)?)
}

/// Mean and standard deviation of each feature.
struct Scaling {
    mean: Point,
    deviation: Point,
}

impl Scaling {
    fn of(points: &[Point]) -> Self {
        let n = points.len() as f64;
        let mean: Point = std::array::from_fn(|k| points.iter().map(|p| p[k]).sum::<f64>() / n);
        let deviation = std::array::from_fn(|k| {
            (points.iter().map(|p| (p[k] - mean[k]).powi(2)).sum::<f64>() / n).sqrt()
        });
        Self { mean, deviation }
    }

    fn standardise(&self, point: Point) -> Point {
        std::array::from_fn(|k| (point[k] - self.mean[k]) / self.deviation[k])
    }
}

fn model_text(scaling: &Scaling, machine: &Machine, sigmoid: (f64, f64)) -> Result<String, std::fmt::Error> {
    let mut text = String::from("penstemon-svm 1\n");
    let row = |numbers: &[f64]| numbers.iter().map(|x| format!("{x:.5}")).collect::<Vec<_>>().join(" ");
    writeln!(text, "mean {}", row(&scaling.mean))?;
    writeln!(text, "deviation {}", row(&scaling.deviation))?;
    writeln!(text, "gamma {}", row(&[machine.setting.gamma]))?;
    writeln!(text, "offset {}", row(&[machine.offset]))?;
    writeln!(text, "sigmoid {}", row(&[sigmoid.0, sigmoid.1]))?;
    writeln!(text, "vectors {}", machine.vectors.len())?;
    for (weight, position) in &machine.vectors {
        writeln!(text, "{} {}", row(&[*weight]), row(position))?;
    }
    Ok(text)
}
