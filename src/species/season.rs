//! Seasons: what a time of the year does to a plant's leaves and blossom.
//!
//! Times are 0 when buds break, 1 in spring, 2 in early summer, 3 when summer ends, 4 in autumn, 5 in winter. In early summer
//! a plant is as its species describes it, to the byte, in blossom where it is described so; later in summer that is over.
//!
//! Each leaf has a course of its own, drawn from its place and the seed: when it unfolds (until time 1), when it turns and to
//! which of the species' colours (from 3 to 4.2), when it falls (from 4 to 5), whether it stays on the plant withered, as on
//! young oaks and beeches. So a tree turns leaf by leaf, and the same leaves go first in every picture of it. A colour is laid
//! into the leaf's own picture ([`crate::picture::recoloured`]), whatever that shows.
//!
//! Limits: flowers that somebody drew stay; leaves that have fallen are gone; a picture that a drawing lays over its
//! leaves keeps its colours. Roses are made for their season from the beginning (`rose/habit.rs`). The papers have no seasons.

use super::looks::{SeasonLook, Species};
use crate::plant::{Organ, OrganKind, Plant, Provenance, Shape};
use crate::random::{mix, unit};

/// Early summer: plants are as their species describes them.
const SUMMER: f32 = 2.0;
/// When the first leaf has unfolded, and the last.
const UNFOLDED: (f32, f32) = (0.4, 1.0);
/// When the first leaf turns, and the last.
const TURNING: (f32, f32) = (3.0, 4.2);
/// When the first leaf falls, and the last.
const FALLING: (f32, f32) = (4.0, 5.0);
/// When the first leaf has the green of summer, and the last.
const GREEN: (f32, f32) = (0.7, 1.6);
/// Length of a leaf that begins to unfold, against its full one.
const BUDDING: f32 = 0.25;
/// When trees come into blossom.
const BLOSSOM: f32 = 0.3;

crate::parameters! {
    /// The time of the year.
    pub struct SeasonParams {
        /// Time of the year: 0 buds break, 1 spring, 2 early summer, 3 end of summer, 4 autumn, 5 winter.
        time: f32 = 2.0, 0.0..=5.0, "";
        /// How many fruits trees and shrubs bear when their season comes, against what is usual for their species.
        fruits: f32 = 1.0, 0.0..=8.0, "";
    }
}

/// The colour that the season lays into a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tint {
    /// That of leaves that have just unfolded.
    Spring,
    /// That of withered ones.
    Withered,
    /// One of those of autumn.
    Autumn(u32),
}

impl Tint {
    /// Its number among the tints of a species.
    fn number(self) -> u32 {
        match self {
            Self::Spring => 0,
            Self::Withered => 1,
            Self::Autumn(k) => 2 + k,
        }
    }

    fn of_number(number: u32) -> Self {
        match number {
            0 => Self::Spring,
            1 => Self::Withered,
            k => Self::Autumn(k - 2),
        }
    }

    /// What the name of a material ends in that has it.
    pub(super) fn suffix(self) -> String {
        match self {
            Self::Spring => "spring".to_owned(),
            Self::Withered => "withered".to_owned(),
            Self::Autumn(k) => format!("autumn{}", k + 1),
        }
    }

    /// The colour, linear RGB.
    pub(super) fn colour(self, look: &SeasonLook) -> [f32; 3] {
        match self {
            Self::Spring => look.spring,
            Self::Withered => look.withered,
            Self::Autumn(k) => look.autumn.get(k as usize).copied().unwrap_or(look.withered),
        }
    }
}

/// A variant of a species' leaves apart from the season, and its tint.
pub(super) fn untinted(species: &Species, variant: u32) -> (u32, Option<Tint>) {
    let usual = species.leaf.usual_variants();
    (variant % usual, (variant / usual).checked_sub(1).map(Tint::of_number))
}

impl Species {
    /// Whether trees of it are in blossom at its time of the year.
    pub fn is_in_blossom(&self) -> bool {
        self.blossom.as_ref().is_some_and(|blossom| (BLOSSOM..=blossom.until).contains(&self.season.time))
    }

    /// Whether its leaves are at that time as it describes them.
    fn is_as_described(&self) -> bool {
        self.season.evergreen || (GREEN.1..=TURNING.0).contains(&self.season.time)
    }
}

/// What becomes of a leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Course {
    /// Length, against the full one.
    size: f32,
    tint: Option<Tint>,
}

/// What has become of the leaf of that key; none for one that has fallen.
fn course(look: &SeasonLook, key: u64) -> Option<Course> {
    let [early, stays, colour] = [1, 2, 3].map(|k| unit(mix(key, k)));
    let within = |(from, to): (f32, f32)| from + (to - from) * early;
    let time = look.time;
    let size = BUDDING + (1.0 - BUDDING) * (time / within(UNFOLDED)).clamp(0.0, 1.0);
    if time < SUMMER {
        return Some(Course { size, tint: (time < within(GREEN)).then_some(Tint::Spring) });
    }
    let has_fallen = time >= within(FALLING);
    let count = look.autumn.len();
    let tint = match has_fallen || time >= FALLING.1 {
        true => (stays < look.keeps).then_some(Some(Tint::Withered))?,
        false if time < within(TURNING) || count == 0 => None,
        false => Some(Tint::Autumn(((colour * count as f32) as u32).min(count as u32 - 1))),
    };
    Some(Course { size: 1.0, tint })
}

/// Whether the leaf of that key is on its plant.
pub(super) fn has_leaf(look: &SeasonLook, key: u64) -> bool {
    look.evergreen || course(look, key).is_some()
}

/// Brings a plant's leaves to the time of the year of its species.
pub(super) fn turn(plant: &mut Plant, provenance: &Provenance, species: &Species, seed: u64) {
    if species.is_as_described() {
        return;
    }
    let usual = species.leaf.usual_variants();
    plant.organs.retain_mut(|organ| {
        if organ.kind() != OrganKind::Leaf {
            return true;
        }
        let Some(course) = course(&species.season, key(organ, provenance, seed)) else { return false };
        if let Shape::Blade(blade) = &mut organ.shape {
            blade.u *= course.size;
            blade.v *= course.size;
        }
        organ.role.variant += course.tint.map_or(0, |tint| usual * (1 + tint.number()));
        true
    });
    plant.drop_unused_templates();
}

/// What tells a leaf from the others: its stroke or its place to a tenth of a millimetre.
pub(super) fn key(organ: &Organ, provenance: &Provenance, seed: u64) -> u64 {
    let place = || match &organ.shape {
        Shape::Blade(blade) => (blade.base * 1e4).to_array().map(|x| u64::from(x.round() as i32 as u32)),
        _ => [0; 3],
    };
    let of_leaf = provenance.stroke(organ.origin).unwrap_or_else(|| place().into_iter().fold(1, mix));
    mix(seed, of_leaf)
}

#[cfg(test)]
#[path = "season_tests.rs"]
mod tests;
