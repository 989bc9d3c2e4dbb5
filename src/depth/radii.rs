//! How thick branches are: pipe model, taper and pen pressure (000 §5.3, 002 §6.3 and §6.4).
//!
//! Every branch's own end is one pipe; a branch's base carries the pipes of all that grows on it, and `r^p` adds up
//! over forks (000 eq. 5.4). Along a branch the radius falls by 000 eq. 5.5. Pressure, which no paper uses, multiplies
//! the result: half pressure, which is what a mouse gives, leaves the papers' thickness alone.

use crate::anatomy::{FlatBranch, Sample};
use crate::geom::polyline;
use crate::kept::{Kept, Same};
use crate::sketch::StrokePoint;
use glam::Vec3;
use std::sync::Arc;

crate::parameters! {
    /// Thickness of branches.
    pub struct RadiusParams {
        /// Radius of the thickest trunk at its base.
        trunk: f32 = 0.009, 0.0002..=0.2, "of the drawing's diagonal";
        /// Pipe exponent p: r^p adds up over forks; 2 is Leonardo's rule, herbs have more.
        pipe_exponent: f32 = 2.5, 1.0..=6.0, "";
        /// Base s of the taper, eq. 5.5.
        taper_base: f32 = 12.0, 1.01..=1000.0, "";
        /// Speed α of the taper, eq. 5.5.
        taper_speed: f32 = 0.4, 0.0..=4.0, "";
        /// Radius m that the taper leaves at the end, eq. 5.5; 1 hardly tapers.
        taper_end: f32 = 0.4, 0.0..=1.0, "";
        /// Thinnest radius.
        thinnest: f32 = 0.0006, 0.00001..=0.05, "of the drawing's diagonal";
        /// How much pen pressure changes thickness; 0 switches it off.
        pressure_gain: f32 = 1.0, 0.0..=3.0, "";
    }
}

/// Largest share of its parent's radius that a branch has at its base.
const LARGEST_CHILD: f32 = 0.92;

/// What is kept of one drawing's branches for the next, all with the same parameters: how each tapers.
#[derive(Debug, Default)]
pub struct Tapers(Kept<Same<[Sample]>, Arc<Tapered>>);

impl Tapers {
    /// For a single drawing, of which nothing is kept.
    pub fn for_one_build() -> Self {
        Self(Kept::for_one_call())
    }
}

/// A branch whose thickness at its base is not known yet.
#[derive(Debug)]
struct Tapered {
    /// Arc length at every sample, pixels.
    arcs: Vec<f32>,
    /// What the taper and what pressure make of the radius at every sample.
    factors: Vec<(f32, f32)>,
}

impl Tapered {
    fn new(line: &[Sample], params: &RadiusParams) -> Self {
        let arcs = polyline::arc_lengths(line.iter().map(|s| s.position));
        let length = arcs.last().copied().unwrap_or(0.0).max(f32::MIN_POSITIVE);
        let factors = line.iter().zip(&arcs);
        let factors = factors
            .map(|(s, arc)| (taper(arc / length, params), pressure_factor(s.pressure, params)))
            .collect();
        Self { arcs, factors }
    }
}

/// Radius in pixels at every sample of every branch.
pub fn radii(branches: &[FlatBranch], diagonal: f32, params: &RadiusParams) -> Vec<Vec<f32>> {
    radii_with(&mut Tapers::for_one_build(), branches, diagonal, params)
}

/// The very radii that [`radii`] gives, again and again while a drawing changes.
pub fn radii_with(
    known: &mut Tapers,
    branches: &[FlatBranch],
    diagonal: f32,
    params: &RadiusParams,
) -> Vec<Vec<f32>> {
    let pipes = pipes(branches.iter().map(|branch| branch.parent));
    let most = pipes.iter().copied().max().unwrap_or(1);
    let thinnest = params.thinnest * diagonal;
    let tapered = known.0.made(
        branches,
        |branch, used| Same::of(&branch.line, used),
        |branch| Arc::new(Tapered::new(&branch.line, params)),
    );
    let mut out: Vec<Vec<f32>> = Vec::with_capacity(branches.len());
    for (branch, (&pipes, of_branch)) in branches.iter().zip(pipes.iter().zip(tapered)) {
        if let Some(widest) = branch.half_width {
            out.push(branch.line.iter().map(|s| (widest * s.pressure).max(thinnest)).collect());
            continue;
        }
        let mut base = width_of_pipes((pipes, most), diagonal, params);
        if let Some(parent) = branch.parent {
            base = base.min(LARGEST_CHILD * at(&tapered[parent].arcs, &out[parent], branch.attached_at));
        }
        out.push(
            of_branch.factors.iter().map(|(taper, press)| (base * taper * press).max(thinnest)).collect(),
        );
    }
    out
}

/// Radius at the base of a branch of so many pipes, where the trunk has the most, in the unit of `diagonal`.
pub fn width_of_pipes((pipes, most): (u32, u32), diagonal: f32, params: &RadiusParams) -> f32 {
    params.trunk * diagonal * (pipes as f32 / most as f32).powf(1.0 / params.pipe_exponent)
}

/// Radius at every point of a branch that is not on the sheet: `width` is that of its pipes and
/// `parent_radius` that of what it grows on, both in the unit of `diagonal`.
pub fn along(
    points: &[Vec3],
    pressures: &[f32],
    (width, parent_radius): (f32, Option<f32>),
    diagonal: f32,
    params: &RadiusParams,
) -> Vec<f32> {
    let arcs = polyline::arc_lengths(points.iter().copied());
    let length = arcs.last().copied().unwrap_or(0.0).max(f32::MIN_POSITIVE);
    let base = parent_radius.map_or(width, |parent_radius| width.min(LARGEST_CHILD * parent_radius));
    let thinnest = params.thinnest * diagonal;
    let radius = |(arc, pressure): (&f32, &f32)| {
        (base * taper(arc / length, params) * pressure_factor(*pressure, params)).max(thinnest)
    };
    let most = parent_radius.map_or(f32::INFINITY, |parent_radius| LARGEST_CHILD * parent_radius);
    arcs.iter().zip(pressures).map(radius).map(|radius| radius.min(most)).collect()
}

/// Number of branch ends that each branch carries, its own included, by the parents of the branches, which stand before them.
pub fn pipes(parents: impl DoubleEndedIterator<Item = Option<usize>> + ExactSizeIterator) -> Vec<u32> {
    let mut pipes = vec![1; parents.len()];
    for (i, parent) in parents.enumerate().rev() {
        if let Some(parent) = parent {
            pipes[parent] += pipes[i];
        }
    }
    pipes
}

/// 000 eq. 5.5 at the share `x` of a branch's length.
fn taper(x: f32, params: &RadiusParams) -> f32 {
    (params.taper_base.powf(-params.taper_speed * x) + params.taper_end) / (1.0 + params.taper_end)
}

/// Factor of pen pressure: 1 at neutral pressure, double at full pressure with gain 1.
fn pressure_factor(pressure: f32, params: &RadiusParams) -> f32 {
    (pressure.max(0.02) / StrokePoint::NEUTRAL_PRESSURE).powf(params.pressure_gain)
}

/// A quantity known at arc lengths, read off at one of them.
pub fn at(arcs: &[f32], values: &[f32], arc: f32) -> f32 {
    let (i, share) = polyline::locate(arcs, arc);
    let next = values.get(i + 1).copied().unwrap_or(values[i]);
    values[i] + (next - values[i]) * share
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    fn branch(parent: Option<usize>, attached_at: f32) -> FlatBranch {
        let line = (0..=20).map(|k| Sample::neutral(Vec2::new(0.0, -10.0 * k as f32))).collect();
        FlatBranch {
            stroke: None,
            key: 0,
            line,
            half_width: None,
            parent,
            attached_at,
            level: parent.is_some().into(),
        }
    }

    #[test]
    fn powers_add_up_over_a_fork() {
        let params = RadiusParams { taper_end: 1.0, taper_speed: 0.0, ..Default::default() };
        let tree = [branch(None, 0.0), branch(Some(0), 100.0), branch(Some(0), 150.0)];
        let radii = radii(&tree, 1000.0, &params);
        let power = |r: f32| r.powf(params.pipe_exponent);
        // The trunk's own end is the third pipe and as thick as a child.
        assert!((power(radii[0][0]) - 3.0 * power(radii[1][0])).abs() < 1e-3 * power(radii[0][0]));
    }

    #[test]
    fn radius_falls_along_a_branch_to_the_known_share() {
        let params = RadiusParams::default();
        let radii = &radii(&[branch(None, 0.0)], 1000.0, &params)[0];
        assert!(radii.windows(2).all(|w| w[1] < w[0]));
        let end = (12f32.powf(-0.4) + 0.4) / 1.4;
        assert!((radii[20] / radii[0] - end).abs() < 1e-4);
    }

    #[test]
    fn pressure_thickens_and_can_be_switched_off() {
        let mut pressed = branch(None, 0.0);
        std::sync::Arc::make_mut(&mut pressed.line)[10].pressure = 1.0;
        let neutral = &radii(&[branch(None, 0.0)], 1000.0, &RadiusParams::default())[0];
        let with = &radii(&[pressed.clone()], 1000.0, &RadiusParams::default())[0];
        assert!((with[10] / neutral[10] - 2.0).abs() < 1e-3);
        let off = RadiusParams { pressure_gain: 0.0, ..Default::default() };
        assert_eq!(&radii(&[pressed], 1000.0, &off)[0], neutral);
    }
}
