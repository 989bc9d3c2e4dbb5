//! Where a shoot grows, and where the buds of its nodes point (001 §2.1, eq. 2.3).
//!
//! v = α·v_default + β·v_opt + γ·(0, 1, 0), then made a unit vector. The thesis calls (0, 1, 0) gravity; it is up, so
//! γ > 0 lifts and γ < 0 droops. Three terms are ours: a share of the level part of the direction, for branches that
//! grow in tiers, a seeded wandering, and the direction in which the wind blows, which bends a crown to one side.
//!
//! Each node carries a side vector square to its internode, where its first bud points. From node to node it is carried
//! without twist and then turned by the phyllotaxis: by the divergence angle (spiral), by half a turn (alternate), by a
//! quarter turn for pairs (opposite).

use crate::geom::frame;
use crate::growth::habit::{Arrangement, Habit};
use crate::random::Choice;
use glam::{Quat, Vec3};
use std::f32::consts::{FRAC_PI_2, PI, TAU};

/// The weights of eq. 2.3 for one order of branching at one age.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Weights {
    /// α, of the direction so far.
    pub keep: f32,
    /// β, of the best direction.
    pub seek: f32,
    /// γ, of up.
    pub lift: f32,
    /// Of the level part of the direction so far.
    pub level: f32,
    /// Of a random direction.
    pub wander: f32,
    /// Where the wind blows, times its weight.
    pub wind: Vec3,
}

impl Weights {
    /// The weights of a habit.
    pub(crate) fn of(habit: &Habit, order: u8, age: f32) -> Self {
        let lift = match order {
            0 => &habit.lift,
            1 => &habit.lift_branch,
            _ => &habit.lift_twig,
        };
        let (sin, cos) = habit.wind_toward.to_radians().sin_cos();
        // A trunk is stiffer than what it carries.
        let yields = if order == 0 { 0.5 } else { 1.0 };
        Self {
            keep: habit.straightness.at(age),
            seek: habit.seeking.at(age),
            lift: lift.at(age),
            level: if order == 0 { 0.0 } else { habit.level.at(age) },
            wander: yields * habit.wander.at(age),
            wind: Vec3::new(cos, 0.0, sin) * (yields * habit.wind.at(age)),
        }
    }

    /// The direction of the next internode.
    pub(crate) fn next(&self, so_far: Vec3, best: Vec3, key: u64) -> Vec3 {
        let level = Vec3::new(so_far.x, 0.0, so_far.z).normalize_or_zero();
        let random = Vec3::from_array(Choice::WANDER.signs(key));
        let sum = so_far * self.keep + best * self.seek + Vec3::Y * self.lift + level * self.level;
        (sum + random * self.wander + self.wind).try_normalize().unwrap_or(so_far)
    }
}

/// The side vector of the next node of an axis that grows at an age in years.
pub(crate) fn next_side(
    side: Vec3,
    (from, to): (Vec3, Vec3),
    (order, age): (u8, f32),
    habit: &Habit,
) -> Vec3 {
    // Double reflection between two places that differ by the mean direction.
    let carried = frame::transport(side, (Vec3::ZERO, from), ((from + to) * 0.5, to));
    let turn = match habit.arrangement {
        Arrangement::Spiral => habit.divergence.at(age).to_radians(),
        Arrangement::Alternate => PI,
        Arrangement::Opposite => FRAC_PI_2,
        Arrangement::Whorl if order == 0 => {
            habit.divergence.at(age).to_radians() / habit.laterals.max(1) as f32
        }
        Arrangement::Whorl => return carried,
    };
    Quat::from_axis_angle(to, turn) * carried
}

/// The side vector at the beginning of a lateral axis. Flat sprays, whose buds stand left and right, lie level.
pub(crate) fn first_side(direction: Vec3, key: u64, habit: &Habit) -> Vec3 {
    let level =
        direction.cross(Vec3::Y).try_normalize().unwrap_or_else(|| direction.any_orthonormal_vector());
    match habit.arrangement {
        Arrangement::Alternate | Arrangement::Whorl => level,
        _ => Quat::from_axis_angle(direction, TAU * Choice::FIRST_SIDE.unit(key)) * level,
    }
}

/// Directions of the lateral buds of a node: `count` around the axis, the first toward `side`.
pub(crate) fn laterals(
    direction: Vec3,
    side: Vec3,
    angle_rad: f32,
    count: u32,
) -> impl Iterator<Item = Vec3> {
    let (sin, cos) = angle_rad.sin_cos();
    (0..count).map(move |k| {
        let around = Quat::from_axis_angle(direction, TAU * k as f32 / count as f32) * side;
        (direction * cos + around * sin).normalize_or(direction)
    })
}

/// Number of lateral buds at a node; of whorls only the trunk's are whole, those of branches lie left and right.
pub(crate) fn laterals_per_node(habit: &Habit, order: u8) -> u32 {
    match habit.arrangement {
        Arrangement::Spiral | Arrangement::Alternate => 1,
        Arrangement::Whorl if order == 0 => habit.laterals,
        Arrangement::Opposite | Arrangement::Whorl => 2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STRAIGHT: Weights =
        Weights { keep: 1.0, seek: 0.0, lift: 0.0, level: 0.0, wander: 0.0, wind: Vec3::ZERO };

    #[test]
    fn lift_above_zero_lifts_and_below_droops() {
        let aslant = Vec3::new(1.0, 0.2, 0.0).normalize();
        let next = |lift| Weights { lift, ..STRAIGHT }.next(aslant, Vec3::ZERO, 1).y;
        assert!(next(0.3) > aslant.y && next(-0.3) < aslant.y && next(0.0) == aslant.y);
        let seeking = Weights { seek: 1.0, ..STRAIGHT };
        assert!(seeking.next(aslant, Vec3::Z, 1).z > 0.5);
        let level = Weights { level: 2.0, ..STRAIGHT }.next(Vec3::new(0.6, 0.8, 0.0), Vec3::ZERO, 1);
        assert!(level.y < 0.4 && level.x > 0.9);
    }

    #[test]
    fn wind_turns_branches_to_where_it_blows_and_the_trunk_half_as_much() {
        let habit = Habit { wind: 0.2.into(), wind_toward: 90.0, wander: 0.0.into(), ..Habit::default() };
        let turned = |order| Weights::of(&habit, order, 1.0).wind;
        assert!(turned(1).abs_diff_eq(Vec3::Z * 0.2, 1e-6) && turned(0).abs_diff_eq(Vec3::Z * 0.1, 1e-6));
        let against = Weights { wind: turned(1), ..STRAIGHT }.next(Vec3::NEG_Z, Vec3::ZERO, 1);
        let across = Weights { wind: turned(1), ..STRAIGHT }.next(Vec3::X, Vec3::ZERO, 1);
        assert!(against.z < 0.0 && across.z > 0.1 && across.is_normalized());
    }

    #[test]
    fn phyllotaxis_turns_buds_about_the_axis() {
        let habit = |arrangement| Habit { arrangement, divergence: 137.5.into(), ..Habit::default() };
        let turned = |arrangement| {
            let side = next_side(Vec3::X, (Vec3::Y, Vec3::Y), (0, 0.0), &habit(arrangement));
            assert!(side.dot(Vec3::Y).abs() < 1e-5 && side.is_normalized());
            side.dot(Vec3::X).clamp(-1.0, 1.0).acos().to_degrees()
        };
        assert!((turned(Arrangement::Spiral) - 137.5).abs() < 0.1);
        assert!((turned(Arrangement::Alternate) - 180.0).abs() < 0.1);
        assert!((turned(Arrangement::Opposite) - 90.0).abs() < 0.1);
        assert!(
            (turned(Arrangement::Whorl) - 137.5 / 4.0).abs() < 0.1,
            "a whorl stands in the gaps of the last"
        );
        let on_a_branch = next_side(Vec3::X, (Vec3::Y, Vec3::Y), (1, 0.0), &habit(Arrangement::Whorl));
        assert!(on_a_branch.abs_diff_eq(Vec3::X, 1e-5), "sprays of branches stay flat");
        let count = |order| laterals_per_node(&habit(Arrangement::Whorl), order);
        assert_eq!([count(0), count(1), count(2)], [4, 2, 2]);
        let ring: Vec<Vec3> = laterals(Vec3::Y, Vec3::X, 1.0, 5).collect();
        for (k, bud) in ring.iter().enumerate() {
            assert!((bud.angle_between(Vec3::Y) - 1.0).abs() < 1e-4);
            let flat = |v: Vec3| v.with_y(0.0);
            let apart = flat(*bud).angle_between(flat(ring[(k + 1) % 5]));
            assert!((apart - TAU / 5.0).abs() < 1e-4, "{apart}");
        }
        let pair: Vec<Vec3> = laterals(Vec3::Y, Vec3::X, 0.5, 2).collect();
        assert!((pair[0].x + pair[1].x).abs() < 1e-5 && pair[0].x > 0.4);
        assert!(pair.iter().all(|d| (d.angle_between(Vec3::Y) - 0.5).abs() < 1e-4));
    }
}
