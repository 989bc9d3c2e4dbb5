//! Fit of the cones of several whorls with one apex and one axis to the tips of their petals.
//!
//! As for one cone (`cone_fit`): Levenberg–Marquardt on the distances of the tips from their rims with Huber weights, with the
//! same weak priors for each whorl. The axis is two unknowns for all, opening and radius are two for each.

use super::cone_fit::{ConeFit, Moments, Trust, huber, priors};
use super::least_squares::{Normal, Problem};
use super::whorls::MOST;
use glam::DVec2;

/// Two of the axis and two of each whorl.
const UNKNOWNS: usize = 2 + 2 * MOST;
/// Step of the differences that slopes are taken from.
const H: f64 = 1e-6;

/// The tips of one whorl.
pub(super) struct WhorlTips {
    tips: Vec<DVec2>,
    moments: Moments,
}

impl WhorlTips {
    pub(super) fn new(tips: Vec<DVec2>) -> Self {
        Self { moments: Moments::of(&tips), tips }
    }
}

/// Improves cones of one axis by at most `steps` steps. At most [`MOST`] of them.
pub(super) fn improve_together(
    cones: Vec<ConeFit>,
    whorls: &[WhorlTips],
    trust: &Trust,
    steps: u32,
) -> Vec<ConeFit> {
    let problem = Problem {
        normal: |cones: &Vec<ConeFit>| normal(cones, whorls, trust),
        cost: |cones: &Vec<ConeFit>| cost(&residuals(cones, whorls, trust)),
        stepped: |cones: &Vec<ConeFit>, step| stepped(cones, step),
    };
    problem.improve(cones, steps).0
}

/// A residual in standard deviations, and whether a wild one counts less.
type Residual = (f64, bool);

fn cost(residuals: &[Residual]) -> f64 {
    residuals.iter().map(|&(r, is_robust)| if is_robust { huber(r).0 } else { r * r }).sum()
}

fn residuals(cones: &[ConeFit], whorls: &[WhorlTips], trust: &Trust) -> Vec<Residual> {
    let mut out = Vec::new();
    for (k, (cone, whorl)) in cones.iter().zip(whorls).enumerate() {
        let rim = cone.rim();
        out.extend(whorl.tips.iter().map(|&q| (rim.distance(q) / trust.tip, true)));
        // The stem speaks once for the axis that all have.
        let trust = Trust { stem: trust.stem.filter(|_| k == 0), ..*trust };
        out.extend(priors(cone, &rim, &whorl.moments, &trust).map(|r| (r, false)));
    }
    out
}

fn stepped(cones: &[ConeFit], step: [f64; UNKNOWNS]) -> Vec<ConeFit> {
    let own =
        |(k, cone): (usize, &ConeFit)| cone.stepped([step[0], step[1], step[2 + 2 * k], step[3 + 2 * k]]);
    cones.iter().enumerate().map(own).collect()
}

/// Cost, gradient and Gauss–Newton matrix by differences; unknowns of whorls that are not there stay where they are.
fn normal(cones: &[ConeFit], whorls: &[WhorlTips], trust: &Trust) -> Normal<UNKNOWNS> {
    let (unknowns, here) = (2 + 2 * cones.len(), residuals(cones, whorls, trust));
    let slope = |k: usize| -> Vec<f64> {
        let (whorl, own) = if k < 2 { (0, k) } else { (k / 2 - 1, 2 + k % 2) };
        let mut step = [0.0; UNKNOWNS];
        step[k] = cones[whorl].inward(H)[own];
        let there = residuals(&stepped(cones, step), whorls, trust);
        there.iter().zip(&here).map(|(there, here)| (there.0 - here.0) / step[k]).collect()
    };
    let slopes: Vec<Vec<f64>> = (0..unknowns).map(slope).collect();
    let weights: Vec<f64> =
        here.iter().map(|&(r, is_robust)| if is_robust { huber(r).1 } else { 1.0 }).collect();
    let (mut matrix, mut gradient) = ([[0.0; UNKNOWNS]; UNKNOWNS], [0.0; UNKNOWNS]);
    (unknowns..UNKNOWNS).for_each(|i| matrix[i][i] = 1.0);
    for i in 0..unknowns {
        gradient[i] = (0..here.len()).map(|r| weights[r] * slopes[i][r] * here[r].0).sum();
        for j in 0..unknowns {
            matrix[i][j] = (0..here.len()).map(|r| weights[r] * slopes[i][r] * slopes[j][r]).sum();
        }
    }
    Normal { cost: cost(&here), matrix, gradient }
}
