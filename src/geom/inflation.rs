//! How deep a flat shape becomes when it is made round: Poisson's equation on a raster.
//!
//! The half depth over the shape is √u with u the solution of ∇²u = −4, u = 0 outside: a circle becomes a sphere, a long
//! strip a somewhat deeper bolster, a thin neck stays thin. Solved by successive over-relaxation.
//!
//! Source: inflating a silhouette by a harmonic height is common in sketch modelling; see `growth/volume/inflated.rs`.
//! Limits: a fixed number of rounds, right for rasters of about [`USUAL_CELLS`] cells along the longer side.

/// Cells along the longer side of a raster for which rounds and factor are chosen.
pub const USUAL_CELLS: usize = 96;
/// Rounds of over-relaxation; the error falls below a percent on a filled square in this many.
const ROUNDS: usize = 160;
/// Over-relaxation factor, near the best for [`USUAL_CELLS`].
const OVER: f32 = 1.93;

/// Squared half depth in each cell of a raster, rows along x, whose inside cells are `inside`; those on its rim count as outside.
pub fn squared_half_depth([w, h]: [usize; 2], cell: f32, inside: impl Iterator<Item = usize>) -> Vec<f32> {
    let is_rim = |i: usize| i.is_multiple_of(w) || i % w == w - 1 || i / w == 0 || i / w == h - 1;
    let inside: Vec<u32> = inside.filter(|i| !is_rim(*i)).map(|i| i as u32).collect();
    let mut u = vec![0.0f32; w * h];
    let load = 4.0 * cell * cell;
    for _ in 0..ROUNDS {
        for &i in &inside {
            let i = i as usize;
            let around = u[i - 1] + u[i + 1] + u[i - w] + u[i + w];
            u[i] += OVER * (0.25 * (around + load) - u[i]);
        }
    }
    u.iter_mut().for_each(|u| *u = u.max(0.0));
    u
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_disc_becomes_a_ball() {
        let (side, cell) = (96, 2.2 / 96.0);
        let from_middle = |i: usize| {
            let at = |k: usize| (k as f32 + 0.5) * cell - 1.1;
            (at(i % side).powi(2) + at(i / side).powi(2)).sqrt()
        };
        let u = squared_half_depth([side, side], cell, (0..side * side).filter(|i| from_middle(*i) < 1.0));
        for i in (0..side * side).filter(|i| from_middle(*i) < 0.8) {
            assert!((u[i] - (1.0 - from_middle(i).powi(2))).abs() < 0.05, "{} at {}", u[i], from_middle(i));
        }
    }
}
