//! The stems of a rose: five units each, whose joints a spline follows, and the places at which branches leave them.
//!
//! The direction of a unit is (sin α cos β, cos α, sin α sin β) about the direction in which its stem begins; α and β of a unit
//! are those of the one below it and a little more or less, so that stems bow (004 §3.2.2; its eq. 4 prints cos β for the
//! height). Radii fall evenly from foot to end: 004 eq. 2 makes them negative after one unit.
//!
//! The unit from which a branch grows is drawn by weights, the place within it by the rest of the draw (004 §3.2.1, whose
//! loop and eq. 3 are misprinted), until it lies in the allowed part of the stem. Around the stem branches follow each other
//! by the golden section, now and then one does not (004 eq. 1, fig. 4).

use super::habit::RoseHabit;
use crate::random::{mix, stream};
use glam::{Quat, Vec3};
use rand::RngExt;
use rand_pcg::Pcg64Mcg;

/// Units of a stem (004 §3.1.1).
pub const UNITS: usize = 5;
/// Points of the spline for each unit.
const POINTS_A_UNIT: usize = 3;
/// Draws for a place before the nearest allowed one is taken.
const DRAWS: usize = 8;
/// Least distance of branches, in radii of what carries them.
const APART: f32 = 3.0;
/// Thinnest that a stem ends, metres.
const THINNEST: f32 = 0.001;

/// A stem.
#[derive(Clone, Debug, PartialEq)]
pub struct Stem {
    /// Index of the one that it grows on, always smaller than its own.
    pub parent: Option<usize>,
    /// 0 for main stems.
    pub order: u32,
    /// Share of the parent's length at which it leaves it; 0 for main stems.
    pub place: f32,
    /// Turn about the parent from the branch before it, degrees; none for the first.
    pub turn_deg: Option<f32>,
    /// Length, metres.
    pub length: f32,
    /// Points of its axis, metres.
    pub points: Vec<Vec3>,
    /// Radius at each of them, metres.
    pub radii: Vec<f32>,
    /// Its name for random choices.
    pub key: u64,
}

impl Stem {
    /// Place, direction and radius at a share of the length.
    pub fn at(&self, share: f32) -> (Vec3, Vec3, f32) {
        let place = share.clamp(0.0, 1.0) * (self.points.len() - 1) as f32;
        let (k, part) = ((place as usize).min(self.points.len() - 2), place);
        let part = part - k as f32;
        let (a, b) = (self.points[k], self.points[k + 1]);
        (
            a.lerp(b, part),
            (b - a).normalize_or(Vec3::Y),
            self.radii[k] + (self.radii[k + 1] - self.radii[k]) * part,
        )
    }
}

/// What a stem begins as.
struct Begin {
    parent: Option<usize>,
    order: u32,
    place: f32,
    turn_deg: Option<f32>,
    from: Vec3,
    direction: Vec3,
    length: f32,
    radius: f32,
    key: u64,
}

/// All stems of a plant, parents before those that grow on them.
pub fn stems(habit: &RoseHabit, seed: u64) -> Vec<Stem> {
    let mut all: Vec<Stem> = (0..habit.stems).map(|k| main_stem(habit, seed, k)).collect();
    let mut parents = 0..all.len();
    for order in 1..=habit.orders {
        let wanted = if order == 1 { habit.branches * habit.stems } else { habit.twigs * habit.stems };
        let begun = all.len();
        let mut on: Vec<Vec<Stem>> = vec![Vec::new(); parents.len()];
        for k in 0..if parents.is_empty() { 0 } else { wanted } {
            let on_parent = k as usize % parents.len();
            let index = parents.start + on_parent;
            let more = branch(habit, seed, &all, index, &on[on_parent], order);
            on[on_parent].extend(more);
        }
        all.extend(on.into_iter().flatten());
        parents = begun..all.len();
    }
    all
}

fn main_stem(habit: &RoseHabit, seed: u64, number: u32) -> Stem {
    let key = mix(seed, u64::from(number));
    let rng = &mut stream(key, "main stem of a rose", 0);
    let around = rng.random_range(0.0..360.0f32) + 360.0 * number as f32 / habit.stems as f32;
    let lean = habit.lean_deg * rng.random_range(0.5..1.5f32) + if habit.stems > 1 { 8.0 } else { 0.0 };
    let aside = Quat::from_rotation_y(around.to_radians()) * Vec3::X;
    let direction = Quat::from_axis_angle(aside.cross(Vec3::Y), -lean.to_radians()) * Vec3::Y;
    let length = habit.height * (1.0 + habit.height_vary * rng.random_range(-1.0..=1.0f32));
    let apart = if habit.stems > 1 { 2.5 * habit.radius } else { 0.0 };
    grow(
        habit,
        Begin {
            parent: None,
            order: 0,
            place: 0.0,
            turn_deg: None,
            from: aside * apart,
            direction,
            length,
            radius: habit.radius,
            key,
        },
    )
}

/// One more branch on a stem that has these; none where it finds no room.
fn branch(
    habit: &RoseHabit,
    seed: u64,
    all: &[Stem],
    parent: usize,
    there: &[Stem],
    order: u32,
) -> Option<Stem> {
    let carrying = &all[parent];
    let key = mix(mix(carrying.key, u64::from(order)), there.len() as u64 + 1);
    let rng = &mut stream(mix(seed, key), "branch of a rose", 0);
    let place = place(habit, carrying, there, rng)?;
    let (from, along, radius) = carrying.at(place);
    let golden = habit.divergence_deg + habit.divergence_vary_deg * rng.random_range(-1.0..=1.0f32);
    let any = rng.random_range(60.0..=180.0f32);
    let turn = if rng.random_range(0.0..1.0f32) < habit.outliers { any } else { golden };
    let first = stream(carrying.key, "side of the first branch", 0).random_range(0.0..360.0f32);
    let around = first + there.iter().filter_map(|stem| stem.turn_deg).sum::<f32>();
    let around = if there.is_empty() { around } else { around + turn };
    let tilt = habit.tilt_deg + habit.tilt_vary_deg * rng.random_range(-1.0..=1.0f32);
    let side = Quat::from_axis_angle(along, around.to_radians()) * reference_side(along);
    let direction = along * tilt.to_radians().cos() + side * tilt.to_radians().sin();
    let length = carrying.length * habit.shorter * rng.random_range(0.8..1.2f32);
    let turn_deg = (!there.is_empty()).then_some(turn);
    Some(grow(
        habit,
        Begin {
            parent: Some(parent),
            order,
            place,
            turn_deg,
            from,
            direction,
            length,
            radius: habit.thinner * radius,
            key,
        },
    ))
}

/// A unit vector across a direction, the same for directions that hardly differ.
pub(super) fn reference_side(along: Vec3) -> Vec3 {
    Vec3::Z.reject_from_normalized(along).try_normalize().unwrap_or(Vec3::X)
}

/// The share of a stem's length at which another branch leaves it.
fn place(habit: &RoseHabit, carrying: &Stem, there: &[Stem], rng: &mut Pcg64Mcg) -> Option<f32> {
    let (from, to) = (habit.place_from.min(habit.place_to), habit.place_to.max(habit.place_from));
    let apart = APART * carrying.radii[0] / carrying.length;
    let is_free = |place: f32| there.iter().all(|other| (other.place - place).abs() >= apart);
    let mut last = None;
    for _ in 0..4 * DRAWS {
        let drawn = (0..DRAWS).map(|_| roulette(habit, rng)).find(|place| (from..=to).contains(place));
        let place = drawn.unwrap_or_else(|| rng.random_range(from..=to));
        if is_free(place) {
            return Some(place);
        }
        last = Some(place);
    }
    // A crowded stem carries two at one place rather than none, while there is some room.
    last.filter(|_| there.len() < 6)
}

/// A share of a stem's length, its unit drawn by the weights.
fn roulette(habit: &RoseHabit, rng: &mut Pcg64Mcg) -> f32 {
    let weights = habit.weights();
    let mut left = rng.random_range(0.0..1.0f32) * weights.iter().sum::<f32>();
    for (unit, weight) in weights.iter().enumerate() {
        if left < *weight {
            return (unit as f32 + left / weight) / UNITS as f32;
        }
        left -= weight;
    }
    1.0
}

/// The stem that begins so: its units, and the spline through their joints.
fn grow(habit: &RoseHabit, begin: Begin) -> Stem {
    let rng = &mut stream(begin.key, "units of a stem", 0);
    let mut bow = || habit.bow_deg.to_radians() * rng.random_range(-1.0..=1.0f32);
    let side = reference_side(begin.direction);
    let third = begin.direction.cross(side);
    let (mut alpha, mut beta) = (0.0f32, bow());
    let mut joints = vec![begin.from];
    for unit in 0..UNITS {
        alpha += bow();
        beta += bow() * 4.0;
        let (sin, cos) = alpha.sin_cos();
        let direction = begin.direction * cos + (side * beta.cos() + third * beta.sin()) * sin;
        // Branches turn up toward the light.
        let up = if begin.order > 0 { 0.10 * (unit + 1) as f32 } else { habit.climb * 0.2 };
        let direction = (direction + Vec3::Y * up).normalize_or(Vec3::Y);
        joints.push(joints[unit] + direction * (begin.length / UNITS as f32));
    }
    let points = spline(&joints);
    let last = (points.len() - 1) as f32;
    let radius = |k: usize| {
        (begin.radius * (1.0 - (1.0 - habit.taper) * k as f32 / last)).max(THINNEST.min(begin.radius))
    };
    Stem {
        parent: begin.parent,
        order: begin.order,
        place: begin.place,
        turn_deg: begin.turn_deg,
        length: begin.length,
        radii: (0..points.len()).map(radius).collect(),
        points,
        key: begin.key,
    }
}

/// A Catmull–Rom spline through the joints.
fn spline(joints: &[Vec3]) -> Vec<Vec3> {
    let at = |k: isize| {
        let last = joints.len() as isize - 1;
        match k {
            k if k < 0 => 2.0 * joints[0] - joints[1],
            k if k > last => 2.0 * joints[last as usize] - joints[last as usize - 1],
            k => joints[k as usize],
        }
    };
    let mut points = vec![joints[0]];
    for k in 0..joints.len() as isize - 1 {
        let (a, b, c, d) = (at(k - 1), at(k), at(k + 1), at(k + 2));
        for step in 1..=POINTS_A_UNIT {
            let t = step as f32 / POINTS_A_UNIT as f32;
            let point = 2.0 * b
                + (c - a) * t
                + (2.0 * a - 5.0 * b + 4.0 * c - d) * (t * t)
                + (3.0 * b - a - 3.0 * c + d) * (t * t * t);
            points.push(0.5 * point);
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thousand_roses_follow_the_measured_form() {
        let habit = RoseHabit::default();
        let (mut ratios, mut places, mut heights) = (Vec::new(), Vec::new(), Vec::new());
        for seed in 0..1000 {
            let stems = stems(&habit, seed);
            heights.push(stems[0].length);
            places.extend(stems.iter().filter(|stem| stem.parent.is_some()).map(|stem| stem.place));
            ratios.extend(stems.iter().filter_map(|stem| stem.turn_deg).map(|turn| turn / (360.0 - turn)));
        }
        let near: Vec<f32> = ratios.iter().copied().filter(|k| (k - 0.618).abs() <= 0.05).collect();
        let mean = near.iter().sum::<f32>() / near.len() as f32;
        assert!((mean - 0.618).abs() <= 0.01, "mean of k is {mean}");
        assert!(near.len() as f32 >= 0.9 * ratios.len() as f32, "{} of {}", near.len(), ratios.len());
        let inside = places.iter().filter(|place| (0.2..=0.6).contains(*place)).count();
        assert!(inside as f32 >= 0.95 * places.len() as f32);
        assert!(heights.iter().all(|height| (0.54..=0.81).contains(height)));
    }

    #[test]
    fn places_follow_the_weights() {
        let habit = RoseHabit { place_from: 0.0, place_to: 1.0, ..RoseHabit::default() };
        let rng = &mut stream(1, "test", 0);
        let mut counts = [0usize; UNITS];
        for _ in 0..20_000 {
            counts[(roulette(&habit, rng) * UNITS as f32).min(4.999) as usize] += 1;
        }
        for (count, weight) in counts.iter().zip(habit.weights()) {
            assert!((*count as f32 / 200.0 - weight).abs() < 1.5, "{counts:?}");
        }
    }

    #[test]
    fn radii_stay_positive_and_branches_are_thinner_than_what_carries_them() {
        for seed in 0..50 {
            let stems = stems(&RoseHabit { orders: 4, ..RoseHabit::default() }, seed);
            for stem in &stems {
                assert!(
                    stem.radii.iter().all(|radius| *radius > 0.0) && stem.radii.is_sorted_by(|a, b| a >= b)
                );
                assert!(stem.points.windows(2).all(|pair| pair[0] != pair[1]));
                if let Some(parent) = stem.parent {
                    assert!(stem.radii[0] <= stems[parent].at(stem.place).2);
                }
            }
        }
    }

    #[test]
    fn more_branches_leave_those_before_as_they_are() {
        let few = stems(&RoseHabit { orders: 1, ..RoseHabit::default() }, 7);
        let more = stems(&RoseHabit { orders: 1, branches: 5, ..RoseHabit::default() }, 7);
        assert_eq!(few[..], more[..few.len()]);
    }

    #[test]
    fn numbers_at_their_ends_give_a_plant() {
        for (branches, twigs, orders) in [(0, 0, 4), (12, 40, 4), (1, 40, 2)] {
            let habit =
                RoseHabit { branches, twigs, orders, stems: 12, height: 0.05, ..RoseHabit::default() };
            let stems = stems(&habit, 3);
            assert!(stems.len() >= 12);
            assert!(stems.iter().flat_map(|stem| &stem.points).all(|point| point.is_finite()));
        }
    }
}
