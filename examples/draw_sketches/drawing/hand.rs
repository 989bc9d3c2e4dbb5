//! The hand that holds the pen: turns ideal lines into strokes a person could have drawn.
//!
//! A line gets slow drift and a little tremor, pressure that sets in and lets go, and samples that lie closer together
//! where the pen slows down in a bend, as a tablet reporting at a fixed rate gives them. Everything random comes from
//! the seed of the drawing.

use super::sheet::{Sheet, Stroke};
use super::spline;
use glam::DVec2;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::f64::consts::TAU;

/// Point on the sheet, pixels, x right, y down.
pub fn at(x: f64, y: f64) -> DVec2 {
    DVec2::new(x, y)
}

/// Direction on the sheet: 0° to the right, 90° up.
pub fn toward(deg: f64) -> DVec2 {
    let (sin, cos) = deg.to_radians().sin_cos();
    DVec2::new(cos, -sin)
}

/// Wavelength in pixels and amplitude in pixels of the hand's drift, slowest first.
const DRIFT: [(f64, f64); 3] = [(230.0, 1.2), (83.0, 0.42), (27.0, 0.13)];

/// Distance between samples in pixels: in a sharp bend and on a straight run.
const SPACING: [f64; 2] = [2.4, 6.0];

/// A drawing in progress.
pub struct Hand {
    rng: Pcg64Mcg,
    sheet: Sheet,
}

/// An ideal line that was drawn as a branch, so that more can be attached to it.
pub struct Drawn {
    line: Vec<DVec2>,
    knots: Vec<f64>,
}

impl Drawn {
    /// Point at `fraction` of the length, 0 at the base.
    pub fn point(&self, fraction: f64) -> DVec2 {
        let total = self.knots[self.knots.len() - 1];
        spline::interpolate(&self.knots, &self.line, total * fraction)
    }

    /// Direction of growth at `fraction` of the length, degrees as in [`toward`].
    pub fn heading(&self, fraction: f64) -> f64 {
        let step = self.point((fraction + 0.01).min(1.0)) - self.point((fraction - 0.01).max(0.0));
        (-step.y).atan2(step.x).to_degrees()
    }
}

impl Hand {
    /// Takes up the pen over an empty sheet.
    pub fn new(species: &'static str, size: [u32; 2], seed: u64) -> Self {
        Self {
            rng: Pcg64Mcg::seed_from_u64(seed),
            sheet: Sheet { species, size, plants: &[], strokes: Vec::new() },
        }
    }

    /// Puts the pen down for good.
    pub fn finish(self) -> Sheet {
        self.sheet
    }

    /// A number around zero, at most `amount` away, mostly nearer.
    pub fn vary(&mut self, amount: f64) -> f64 {
        let (a, b): (f64, f64) = (self.rng.random(), self.rng.random());
        amount * (a + b - 1.0)
    }

    /// True with the given probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.rng.random::<f64>() < probability
    }

    /// Draws a branch from its base through `points`, thick to thin as `pressure` says (base, end).
    pub fn branch(&mut self, points: &[DVec2], pressure: [f64; 2]) -> Drawn {
        self.branch_as("auto", points, pressure)
    }

    /// [`Hand::branch`] with the pen moving from the end to the base.
    pub fn branch_reversed(&mut self, points: &[DVec2], pressure: [f64; 2]) -> Drawn {
        let drawn = self.branch(points, pressure);
        if let Some(stroke) = self.sheet.strokes.last_mut() {
            stroke.points.reverse();
        }
        drawn
    }

    /// [`Hand::branch`] with an explicit tool, for stubs that are hard to tell from blades.
    pub fn branch_as(&mut self, tool: &'static str, points: &[DVec2], pressure: [f64; 2]) -> Drawn {
        let line = spline::through(points);
        self.stroke(tool, &line, |t| pressure[0] + (pressure[1] - pressure[0]) * t.powf(0.7));
        let knots = spline::lengths(&line);
        Drawn { line, knots }
    }

    /// Draws the outline of a blade; `curl` is how much harder the pen presses where the margin turns up.
    pub fn outline(&mut self, tool: &'static str, outline: &[DVec2], curl: f64) {
        let bump = |t: f64, center: f64| (-((t - center) / 0.09).powi(2)).exp();
        let onset = |t: f64| 1.0 - 0.45 * bump(t, -0.03) - 0.5 * bump(t, 1.04);
        self.stroke(tool, outline, |t| (0.5 + curl * (bump(t, 0.36) + 0.8 * bump(t, 0.66))) * onset(t));
    }

    /// Draws a loop around part of a crown through `corners`, running a little past where it began.
    pub fn region(&mut self, tool: &'static str, corners: &[DVec2]) {
        let mut line = spline::even(&spline::around(corners), 2.0);
        let overlap = (line.len() / 60).max(2);
        line.extend_from_within(1..overlap);
        self.stroke(tool, &line, |_| 0.45);
    }

    fn stroke(&mut self, tool: &'static str, line: &[DVec2], pressure: impl Fn(f64) -> f64) {
        let line = self.drift(&spline::even(line, 0.8));
        let picked = sampled(&line);
        let (phase, waves) = (self.rng.random::<f64>() * TAU, 1.5 + self.rng.random::<f64>());
        let last = (line.len() - 1) as f64;
        let points = picked.into_iter().map(|i| {
            let t = i as f64 / last;
            let breath = 0.025 * (TAU * waves * t + phase).sin();
            [line[i].x, line[i].y, (pressure(t) + breath).clamp(0.05, 1.0)]
        });
        let points = points.collect();
        self.sheet.strokes.push(Stroke { tool, points });
    }

    /// Adds what a hand adds; short strokes are drawn with the fingers and stay steadier.
    fn drift(&mut self, line: &[DVec2]) -> Vec<DVec2> {
        let knots = spline::lengths(line);
        let total = knots[knots.len() - 1];
        let steadiness = (total / 350.0).clamp(0.3, 1.0);
        let waves: Vec<(f64, f64, DVec2)> = DRIFT
            .iter()
            .flat_map(|&(wavelength, amplitude)| {
                [(wavelength, amplitude, DVec2::X), (wavelength, amplitude, DVec2::Y)]
            })
            .map(|(wavelength, amplitude, axis)| {
                let stretched = wavelength * (0.8 + 0.4 * self.rng.random::<f64>());
                (TAU / stretched, self.rng.random::<f64>() * TAU, axis * amplitude * steadiness)
            })
            .collect();
        let offset = |s: f64| waves.iter().map(|&(k, phase, by)| by * (k * s + phase).sin()).sum::<DVec2>();
        line.iter().zip(&knots).map(|(&p, &s)| p + offset(s)).collect()
    }
}

/// Indices of the samples that a tablet would report: dense in bends, sparse on straight runs, both ends kept.
fn sampled(line: &[DVec2]) -> Vec<usize> {
    let last = line.len() - 1;
    let reach = 5;
    let turn = |i: usize| {
        let (a, b) = (line[i] - line[i.saturating_sub(reach)], line[(i + reach).min(last)] - line[i]);
        if a.length() * b.length() > 1e-9 { a.angle_to(b).abs() } else { 0.0 }
    };
    let mut picked = vec![0];
    let mut gathered = 0.0;
    for i in 1..last {
        let slow = (turn(i) / 0.7).min(1.0);
        let spacing = SPACING[1] + (SPACING[0] - SPACING[1]) * slow;
        gathered += line[i].distance(line[i - 1]) / spacing;
        if gathered >= 1.0 {
            picked.push(i);
            gathered -= 1.0;
        }
    }
    picked.push(last);
    picked
}
