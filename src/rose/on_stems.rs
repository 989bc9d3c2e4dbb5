//! Roses on stems that were drawn: leaves by the golden angle, a flower at the end of each, and on long ones side shoots with
//! flowers of their own, as climbing roses have along an arch.
//!
//! Limits: side shoots know nothing of what the stem climbs on.

use super::habit::{RoseHabit, Season};
use super::shrub::{Shrub, leaves_and_buds};
use super::stems::{Stem, reference_side, shoot};
use crate::geom::polyline;
use crate::random::{mix, stream};
use glam::{Quat, Vec3};
use rand::RngExt;

/// Points of a drawn stem.
const POINTS: usize = 24;
/// From this length on, in heights of the habit, a stem climbs.
const CLIMBS: f32 = 1.3;
/// Distance of side shoots along a stem that climbs, and their length, in heights of the habit.
const APART: f32 = 0.14;
const LONG: f32 = 0.28;
/// Share of a climbing stem at its foot without side shoots.
const BARE: f32 = 0.15;
/// Steepness of the end of a drawn stem, as a sine, below which it has no flower.
const HANGS: f32 = -0.6;
/// Most side shoots of one stem.
const MOST: usize = 60;

/// A stem as it was drawn.
#[derive(Clone, Copy, Debug)]
pub struct DrawnStem<'a> {
    /// Index of the one that it grows on, always smaller than its own.
    pub parent: Option<usize>,
    /// 0 for those from the ground.
    pub order: u32,
    /// Points of its axis, metres; two at least.
    pub points: &'a [Vec3],
    /// Radius at each of them, metres.
    pub radii: &'a [f32],
}

/// The rose on drawn stems: these first, in their order, side shoots behind them.
pub fn on_stems((habit, season): (&RoseHabit, &Season), drawn: &[DrawnStem<'_>], seed: u64) -> Shrub {
    let mut stems: Vec<Stem> =
        drawn.iter().enumerate().map(|(k, stem)| even(stem, drawn, mix(seed, k as u64))).collect();
    for index in 0..drawn.len() {
        let shoots = side_shoots(habit, &stems[index], index);
        stems.extend(shoots);
    }
    let mut shrub = leaves_and_buds((habit, season), stems);
    // What hangs down to the ground on the far side of an arch ends there without a flower.
    let hangs = |index: usize| index < drawn.len() && shrub.stems[index].at(1.0).1.y < HANGS;
    shrub.buds.retain(|bud| !hangs(bud.stem));
    shrub
}

/// A drawn stem with its points at even distances.
fn even(stem: &DrawnStem<'_>, all: &[DrawnStem<'_>], key: u64) -> Stem {
    let arcs = polyline::arc_lengths(stem.points.iter().copied());
    let length = arcs.last().copied().unwrap_or(0.0);
    let at = |k: usize| {
        let (i, share) = polyline::locate(&arcs, length * k as f32 / (POINTS - 1) as f32);
        let radius = stem.radii[i] + (stem.radii[i + 1] - stem.radii[i]) * share;
        (polyline::interpolate(stem.points, (i, share)), radius)
    };
    let (points, radii) = (0..POINTS).map(at).unzip();
    let place = stem.parent.map_or(0.0, |parent| place_on(all[parent].points, stem.points[0]));
    Stem { parent: stem.parent, order: stem.order, place, turn_deg: None, length, points, radii, key }
}

/// The share of a line's length at its point nearest to this one.
fn place_on(line: &[Vec3], point: Vec3) -> f32 {
    let arcs = polyline::arc_lengths(line.iter().copied());
    let nearest =
        (0..line.len()).min_by(|a, b| line[*a].distance(point).total_cmp(&line[*b].distance(point)));
    nearest.map_or(0.0, |k| arcs[k] / arcs[line.len() - 1].max(1e-9))
}

/// The side shoots of a stem that climbs; none of one that stands.
fn side_shoots(habit: &RoseHabit, stem: &Stem, index: usize) -> Vec<Stem> {
    if stem.length < CLIMBS * habit.height {
        return Vec::new();
    }
    let count = ((1.0 - BARE) * stem.length / (APART * habit.height)) as usize;
    let first = stream(stem.key, "side of the first branch", 0).random_range(0.0..360.0f32);
    let side_shoot = |k: usize| {
        let key = mix(stem.key, k as u64 + 1);
        let rng = &mut stream(key, "side shoot of a rose", 0);
        let place = BARE + (1.0 - BARE) * (k as f32 + rng.random_range(0.3..0.7f32)) / count as f32;
        let (from, along, radius) = stem.at(place);
        let radius = radius.min(habit.radius);
        let around = first + habit.divergence_deg * k as f32;
        let side = Quat::from_axis_angle(along, around.to_radians()) * reference_side(along);
        let tilt = (habit.tilt_deg + habit.tilt_vary_deg * rng.random_range(-1.0..=1.0f32)).to_radians();
        // Shoots turn away from the ground from their beginning on.
        let direction = along * tilt.cos() + side * tilt.sin() + Vec3::Y * 0.4;
        let length = LONG * habit.height * rng.random_range(0.6..1.2f32);
        shoot(
            habit,
            (index, stem.order + 1, place),
            (from, direction.normalize_or(Vec3::Y)),
            length,
            radius,
            key,
        )
    };
    (0..count.min(MOST)).map(side_shoot).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arch() -> (Vec<Vec3>, Vec<f32>) {
        let at = |k: usize| {
            let (sin, cos) = (std::f32::consts::PI * k as f32 / 40.0).sin_cos();
            Vec3::new(-cos, 2.2 * sin, 0.0)
        };
        ((0..=40).map(at).collect(), (0..=40).map(|k| 0.012 - 0.0002 * k as f32).collect())
    }

    #[test]
    fn a_rose_climbs_along_an_arch_with_flowers_all_over_it() {
        let (points, radii) = arch();
        let stem = DrawnStem { parent: None, order: 0, points: &points, radii: &radii };
        let shrub = on_stems((&RoseHabit::default(), &Season::at(2.0)), &[stem], 3);
        assert!(shrub.stems.len() > 12 && shrub.buds.len() == shrub.stems.len() - 1, "{}", shrub.buds.len());
        assert!(shrub.leaves.len() > 60, "{}", shrub.leaves.len());
        let on = |p: Vec3| points.iter().map(|q| q.distance(p)).fold(f32::MAX, f32::min);
        assert!(shrub.stems[1..].iter().all(|stem| on(stem.points[0]) < 0.1 && stem.parent == Some(0)));
        let right = shrub.buds.iter().filter(|bud| bud.base.x > 0.0).count();
        assert!(right > shrub.buds.len() / 4 && right < 3 * shrub.buds.len() / 4);
    }

    #[test]
    fn a_short_stem_has_one_flower_and_its_leaves() {
        let points = [Vec3::ZERO, Vec3::new(0.01, 0.2, 0.0), Vec3::new(0.0, 0.5, 0.05)];
        let stem = DrawnStem { parent: None, order: 0, points: &points, radii: &[0.005, 0.004, 0.003] };
        let shrub = on_stems((&RoseHabit::default(), &Season::at(2.0)), &[stem], 3);
        assert_eq!((shrub.stems.len(), shrub.buds.len()), (1, 1));
        assert!((shrub.buds[0].base - points[2]).length() < 1e-5 && shrub.leaves.len() > 3);
    }

    #[test]
    fn stems_without_length_have_no_leaves_and_do_no_harm() {
        let points = [Vec3::ONE; 2];
        let stem = DrawnStem { parent: None, order: 0, points: &points, radii: &[0.001; 2] };
        let shrub = on_stems((&RoseHabit::default(), &Season::at(2.0)), &[stem], 3);
        assert!(shrub.leaves.is_empty() && shrub.buds.iter().all(|bud| bud.base.is_finite()));
    }
}
