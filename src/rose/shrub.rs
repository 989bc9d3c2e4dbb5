//! A rose plant: stems, leaves at the nodes that no branch takes, a flower bud or a hip at the end of each stem.
//!
//! Leaves follow each other by the golden angle; 004 eqs. 6 and 7 would turn all leaves of a stem to one side, since
//! cos α₁ / cos 60° is cos α₀. They stand off their stem by an angle that falls from its foot to its tip.

use super::habit::{RoseHabit, Season};
use super::stems::{Stem, reference_side, stems};
use crate::random::stream;
use glam::{Quat, Vec3};
use rand::RngExt;

/// Share of a main stem at its foot without leaves.
const BARE_FOOT: f32 = 0.18;
/// Least distance of a leaf from a branch, share of an internode.
const CLEAR: f32 = 0.35;
/// How far flowers look away from the direction of their stem, degrees.
const LOOKS_ASIDE_DEG: f32 = 22.0;

/// A leaf before it is divided into leaflets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leaf {
    /// The stem that it stands on.
    pub stem: usize,
    /// Its foot, metres.
    pub base: Vec3,
    /// Unit vectors across and along it.
    pub u: Vec3,
    /// The same along.
    pub v: Vec3,
    /// Its length, metres.
    pub length: f32,
    /// Whether it is young, and reddish.
    pub is_young: bool,
    /// Whether it has the colour of autumn.
    pub is_coloured: bool,
}

/// A flower that opens, or the hip that it became.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoseBud {
    /// The stem at whose end it stands.
    pub stem: usize,
    /// Its foot, metres.
    pub base: Vec3,
    /// Unit direction in which it looks.
    pub axis: Vec3,
    /// Distance from the centre to the tips in bloom, metres.
    pub reach: f32,
    /// How far it has opened, 0 to 1; none for a hip.
    pub open: Option<f32>,
    /// Radius of the hip, metres; 0 for none.
    pub hip: f32,
}

/// A rose plant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shrub {
    /// Stems, parents first.
    pub stems: Vec<Stem>,
    /// Leaves.
    pub leaves: Vec<Leaf>,
    /// Flowers, or hips.
    pub buds: Vec<RoseBud>,
}

/// The plant of a seed in a season.
pub fn shrub(habit: &RoseHabit, season: &Season, seed: u64) -> Shrub {
    leaves_and_buds((habit, season), stems(habit, seed))
}

/// Stems with their leaves, and with what stands at their ends.
pub(super) fn leaves_and_buds(of: (&RoseHabit, &Season), stems: Vec<Stem>) -> Shrub {
    let leaves = (0..stems.len()).flat_map(|index| leaves(of, &stems, index)).collect();
    let highest = stems.iter().map(end_height).fold(0.0, f32::max);
    let buds = stems.iter().enumerate().filter_map(|(index, stem)| bud(of, stem, index, highest)).collect();
    Shrub { stems, leaves, buds }
}

fn end_height(stem: &Stem) -> f32 {
    stem.points[stem.points.len() - 1].y
}

fn leaves((habit, season): (&RoseHabit, &Season), stems: &[Stem], index: usize) -> Vec<Leaf> {
    let stem = &stems[index];
    let foot = if stem.order == 0 { BARE_FOOT } else { 0.12 };
    let step = habit.internode / stem.length.max(1e-6);
    let count = ((1.0 - foot) / step).floor().min(400.0) as usize;
    let taken: Vec<f32> =
        stems.iter().filter(|other| other.parent == Some(index)).map(|other| other.place).collect();
    let first = stream(stem.key, "side of the first leaf", 0).random_range(0.0..360.0f32);
    let leaf = |k: usize| {
        let place = foot + step * (k as f32 + 0.5);
        let rng = &mut stream(stem.key, "leaf of a rose", k as u64);
        let [stays, turns, grows, is_late, colours]: [f32; 5] =
            std::array::from_fn(|_| rng.random_range(0.0..1.0));
        if place > 0.97 || taken.iter().any(|other| (other - place).abs() < CLEAR * step) {
            return None;
        }
        if season.leaves <= 0.0 || stays > 0.2 + 0.8 * (season.leaves * 2.0).min(1.0) {
            return None;
        }
        let (at, along, radius) = stem.at(place);
        let around = first + habit.divergence_deg * k as f32 + 10.0 * (turns - 0.5);
        let side = Quat::from_axis_angle(along, around.to_radians()) * reference_side(along);
        let off = habit.leaf_deg + (habit.leaf_tip_deg - habit.leaf_deg) * place;
        let (sin, cos) = off.to_radians().sin_cos();
        let v = along * cos + side * sin;
        // The face looks toward the tip of the stem.
        let face = along * sin - side * cos;
        let is_young = place > 1.0 - habit.young || is_late < season.young;
        let size = (0.85 + 0.3 * grows) * if is_young { 0.5 } else { 1.0 };
        Some(Leaf {
            stem: index,
            base: at + side * (0.8 * radius),
            u: v.cross(face),
            v,
            length: habit.leaf * size * season.leaves.clamp(0.6, 1.0),
            is_young,
            is_coloured: colours < season.coloured,
        })
    };
    (0..count).filter_map(leaf).collect()
}

fn bud((habit, season): (&RoseHabit, &Season), stem: &Stem, index: usize, highest: f32) -> Option<RoseBud> {
    let rng = &mut stream(stem.key, "flower of a rose", 0);
    let (base, along, _) = stem.at(1.0);
    let aside =
        Quat::from_axis_angle(along, rng.random_range(0.0..std::f32::consts::TAU)) * reference_side(along);
    let axis =
        Quat::from_axis_angle(aside, LOOKS_ASIDE_DEG.to_radians() * rng.random_range(0.2..1.0f32)) * along;
    let is_bud = rng.random_range(0.0..1.0f32) < habit.buds;
    let vary = rng.random_range(0.75..1.0f32);
    // Flowers at the top of the plant are younger.
    let younger = 0.25 * (end_height(stem) / highest.max(1e-3)).clamp(0.0, 1.0);
    let open =
        season.open.map(|open| if is_bud { 0.15 * open } else { open * (vary - younger + 0.25).min(1.0) });
    let hip = if season.hips > 0.0 && !is_bud { 0.28 * habit.flower * season.hips } else { 0.0 };
    (open.is_some() || hip > 0.0).then_some(RoseBud {
        stem: index,
        base,
        axis,
        reach: habit.flower,
        open,
        hip,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leaves_stand_where_no_branch_does_and_turn_by_the_golden_angle() {
        let habit = RoseHabit::default();
        for seed in 0..40 {
            let shrub = shrub(&habit, &Season::at(2.0), seed);
            assert!(shrub.leaves.len() > 20, "{} leaves", shrub.leaves.len());
            for leaf in &shrub.leaves {
                assert!((leaf.u.cross(leaf.v).length() - 1.0).abs() < 1e-3);
                assert!(leaf.length > 0.0 && leaf.base.is_finite());
            }
        }
    }

    #[test]
    fn there_is_a_flower_at_each_end_in_bloom_and_a_hip_after() {
        let in_bloom = shrub(&RoseHabit::default(), &Season::at(2.0), 5);
        assert_eq!(in_bloom.buds.len(), in_bloom.stems.len());
        assert!(in_bloom.buds.iter().any(|bud| bud.open.is_some_and(|open| open > 0.6)));
        let after = shrub(&RoseHabit::default(), &Season::at(3.4), 5);
        assert!(after.buds.iter().all(|bud| bud.open.is_none() && bud.hip > 0.0) && !after.buds.is_empty());
        let bare = shrub(&RoseHabit::default(), &Season::at(5.0), 5);
        assert!(bare.leaves.is_empty());
    }

    #[test]
    fn about_one_flower_in_five_is_a_bud() {
        let buds: Vec<RoseBud> =
            (0..300).flat_map(|seed| shrub(&RoseHabit::default(), &Season::at(2.0), seed).buds).collect();
        let shut = buds.iter().filter(|bud| bud.open.is_some_and(|open| open < 0.2)).count();
        assert!((0.15..0.25).contains(&(shut as f32 / buds.len() as f32)), "{shut} of {}", buds.len());
    }
}
