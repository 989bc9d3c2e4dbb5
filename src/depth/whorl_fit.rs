//! Fit of the cones of several whorls with one apex and one axis to the tips of their petals.
//!
//! As for one cone (`cone_fit`): Levenberg–Marquardt on the distances of the tips from their rims with Huber weights, with the
//! same weak priors for each whorl. The axis is two unknowns for all, opening and radius are two for each.

use super::cone_fit::{ConeFit, Moments, Trust, huber, priors, solve};
use super::whorls::MOST;
use glam::DVec2;

/// Two of the axis and two of each whorl.
const UNKNOWNS: usize = 2 + 2 * MOST;
/// Step of the differences that slopes are taken from.
const H: f64 = 1e-6;

/// Opening, radians, from which on steps make cones narrower.
const MIDDLE: f64 = 0.8;

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
    mut cones: Vec<ConeFit>,
    whorls: &[WhorlTips],
    trust: &Trust,
    steps: u32,
) -> Vec<ConeFit> {
    let mut damping = 1e-3;
    let mut now = residuals(&cones, whorls, trust);
    for _ in 0..steps {
        let (matrix, gradient) = normal(&cones, whorls, trust, &now);
        let mut damped = matrix;
        for (i, row) in damped.iter_mut().enumerate() {
            row[i] += damping * row[i].max(1e-9);
        }
        let Some(step) = solve(damped, gradient.map(|g| -g)) else { break };
        let next = stepped(&cones, &step);
        let there = residuals(&next, whorls, trust);
        let gain = cost(&now) - cost(&there);
        if gain > 0.0 {
            let is_done = gain < 1e-6 * cost(&now);
            (cones, now) = (next, there);
            damping = (damping * 0.1).max(1e-9);
            if is_done {
                break;
            }
        } else {
            damping *= 10.0;
            if damping > 1e6 {
                break;
            }
        }
    }
    cones
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

fn stepped(cones: &[ConeFit], step: &[f64; UNKNOWNS]) -> Vec<ConeFit> {
    let own =
        |(k, cone): (usize, &ConeFit)| cone.stepped([step[0], step[1], step[2 + 2 * k], step[3 + 2 * k]]);
    cones.iter().enumerate().map(own).collect()
}

/// Gauss–Newton matrix and gradient by differences; unknowns of whorls that are not there stay where they are.
fn normal(
    cones: &[ConeFit],
    whorls: &[WhorlTips],
    trust: &Trust,
    here: &[Residual],
) -> ([[f64; UNKNOWNS]; UNKNOWNS], [f64; UNKNOWNS]) {
    let unknowns = 2 + 2 * cones.len();
    let slope = |k: usize| -> Vec<f64> {
        let mut step = [0.0; UNKNOWNS];
        // Away from the bounds of openings, at which a step outward would change nothing.
        let is_wide = k >= 2 && k.is_multiple_of(2) && cones[k / 2 - 1].opening > MIDDLE;
        step[k] = if is_wide { -H } else { H };
        let there = residuals(&stepped(cones, &step), whorls, trust);
        there.iter().zip(here).map(|(there, here)| (there.0 - here.0) / step[k]).collect()
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
    (matrix, gradient)
}
