//! Drawings as people make them who have never heard of the program: trunks of two lines, crowns and corollas in one stroke,
//! leaves of two arcs, pots, ground lines. They name no species: the program guesses it.

pub mod herbs;
pub mod pots;
pub mod trees;

use super::super::hand::{Hand, at, toward};
use super::super::spline;
use glam::DVec2;

/// Pressure of a pen that only marks where lines go.
const EVEN: [f64; 2] = [0.5, 0.45];

/// Takes up the pen over a sheet that names no species.
fn paper(seed: u64) -> Hand {
    Hand::new("", [1024, 1024], seed)
}

/// Draws a smooth line through some places.
fn line(hand: &mut Hand, places: &[[f64; 2]]) {
    hand.branch(&places.map_to_points(), EVEN);
}

/// Draws a line with corners where its stretches meet, each of them smooth.
fn corners(hand: &mut Hand, stretches: &[&[[f64; 2]]]) {
    let line: Vec<DVec2> =
        stretches.iter().flat_map(|places| spline::through(&places.map_to_points())).collect();
    hand.outline("auto", &line, 0.0);
}

/// Places as points.
trait Places {
    fn map_to_points(&self) -> Vec<DVec2>;
}

impl Places for [[f64; 2]] {
    fn map_to_points(&self) -> Vec<DVec2> {
        self.iter().map(|[x, y]| at(*x, *y)).collect()
    }
}

/// An arc of an ellipse that bulges in lobes, from one direction to another in degrees.
struct Scallops {
    centre: [f64; 2],
    radii: [f64; 2],
    range: [f64; 2],
    lobes: u32,
    /// How far a lobe stands out of the ellipse, as a share of its radii.
    depth: f64,
}

impl Scallops {
    /// The line, every lobe a little wider or narrower than the next.
    fn line(&self, hand: &mut Hand) -> Vec<DVec2> {
        let mut ends: Vec<f64> = (0..=self.lobes).map(f64::from).collect();
        let last = ends.len() - 1;
        ends[1..last].iter_mut().for_each(|end| *end += hand.vary(0.3));
        let place = |lobe: f64, out: f64| {
            let angle = self.range[0] + (self.range[1] - self.range[0]) * lobe / f64::from(self.lobes);
            at(self.centre[0], self.centre[1]) + toward(angle) * DVec2::from(self.radii) * (1.0 + out)
        };
        let mut line = Vec::new();
        for pair in ends.windows(2) {
            let depth = self.depth * (1.0 + hand.vary(0.25));
            let along = |k: u32| {
                let share = f64::from(k) / 24.0;
                place(
                    pair[0] + (pair[1] - pair[0]) * share,
                    depth * (std::f64::consts::PI * share).sin().sqrt(),
                )
            };
            line.extend((0..24).map(along));
        }
        line.push(place(ends[last], 0.0));
        line
    }
}
