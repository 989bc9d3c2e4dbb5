//! Where the petals of a flower stand about its axis, and which of their neighbours they cover (003 §3.1, §3.2).
//!
//! Petals stand on rings: a ring for each layer, or in spiral flowers one for each petal. A layer is turned against the one
//! outside of it by half a sector where both have as many petals, otherwise so that the least angle between their petals
//! is as large as possible.
//!
//! The petals of a ring lie on levels, 0 outermost. Contorted petals have half a level and rise to one side instead, so that
//! each lies over one neighbour and under the other. Imbricate ones of few have a level each in the order in which they were
//! formed, of five the quincunx 1 3 5 2 4; of many the levels of neighbours that overlap differ.

use super::layers::{Aestivation, Layers};
use crate::plant::Level;
use crate::random::stream;
use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use std::f32::consts::{PI, TAU};

/// The golden section, φ of the divergence `360° / (t + 1/φ)`.
const GOLDEN: f32 = 1.618_034;
/// Petals of a ring up to which each has a level of its own.
pub const FEW: usize = 5;
/// Turns of a layer against another that are tried.
const TURNS_TRIED: usize = 48;

/// Where one petal stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Angle about the axis, radians.
    pub azimuth_rad: f32,
    /// Size against that of its ring.
    pub size: f32,
    /// How far it leans from its ring, −1 to 1 of what the ring's neighbours leave room for.
    pub tilt: f32,
}

/// Petals on one surface of revolution.
#[derive(Clone, Debug, PartialEq)]
pub struct Ring {
    /// Layers from the outermost; in spiral flowers between two of them.
    pub layer: f32,
    /// Share of the way from the outermost to the innermost layer.
    pub inward: f32,
    /// Its petals in the order of their azimuth.
    pub places: Vec<Place>,
}

impl Ring {
    /// Angle between neighbours, radians; a whole turn for a single petal.
    pub fn sector_rad(&self) -> f32 {
        TAU / self.places.len().max(1) as f32
    }
}

/// The rings of a flower, outermost first.
pub fn rings(layers: &Layers, seed: u64) -> Vec<Ring> {
    match layers.aestivation {
        Aestivation::Spiral => spiral(layers, seed),
        _ => whorls(layers, seed),
    }
}

/// Divergence of a spiral, radians.
pub fn divergence_rad(t: u32) -> f32 {
    TAU / (t as f32 + 1.0 / GOLDEN)
}

fn spiral(layers: &Layers, seed: u64) -> Vec<Ring> {
    let (count, turn) = (layers.all_petals(), divergence_rad(layers.spiral_t));
    let ring = |k: u32| {
        let inward = k as f32 / (count.max(2) - 1) as f32;
        let place = varied(layers, turn * k as f32, &mut stream(seed, "petal", u64::from(k)));
        Ring { layer: inward * (layers.count - 1) as f32, inward, places: vec![place] }
    };
    (0..count).map(ring).collect()
}

fn whorls(layers: &Layers, seed: u64) -> Vec<Ring> {
    let mut rings: Vec<Ring> = Vec::new();
    let mut first_rad = 0.0;
    for layer in 0..layers.count {
        let count = layers.petals_of(layer);
        if let Some(outside) = rings.last() {
            first_rad += turn_against(outside.places.len() as u32, count);
        }
        let sector = TAU / count as f32;
        let place = |j: u32| {
            let rng = &mut stream(seed, "petal", u64::from(layer) << 32 | u64::from(j));
            varied(layers, first_rad + sector * j as f32, rng)
        };
        let inward = layer as f32 / (layers.count.max(2) - 1) as f32;
        rings.push(Ring { layer: layer as f32, inward, places: (0..count).map(place).collect() });
    }
    rings
}

/// By how much a layer of `count` petals is turned against the one outside of it with `outside` petals, whose first one
/// stands at 0.
fn turn_against(outside: u32, count: u32) -> f32 {
    let sector = TAU / count as f32;
    if outside == count {
        return 0.5 * sector;
    }
    let least = |turn: f32| {
        let off = |j: u32| {
            let other = TAU / outside as f32;
            let share = ((turn + sector * j as f32) / other).rem_euclid(1.0);
            share.min(1.0 - share) * other
        };
        (0..count).map(off).fold(f32::INFINITY, f32::min)
    };
    let turns = (0..TURNS_TRIED).map(|k| sector * (k as f32 + 0.5) / TURNS_TRIED as f32);
    turns.fold((0.0, -1.0), |best, turn| if least(turn) > best.1 { (turn, least(turn)) } else { best }).0
}

fn varied(layers: &Layers, azimuth_rad: f32, rng: &mut Pcg64Mcg) -> Place {
    let mut about = |most: f32| most * rng.random_range(-1.0..=1.0_f32);
    let azimuth_rad = azimuth_rad + about(layers.turn_vary_deg.to_radians());
    let size = 1.0 + about(layers.shrink_vary);
    Place { azimuth_rad, size, tilt: about(layers.tilt_vary_deg / 30.0) }
}

/// The levels of the petals of a ring.
#[derive(Clone, Debug, PartialEq)]
pub struct Levels {
    /// One for each petal.
    pub of: Vec<Level>,
    /// Petals that lie over each other at one place, at most.
    pub stacked: u32,
    /// Least difference in height between petals that overlap.
    pub apart: f32,
}

/// The levels of `count` petals, of which each spans `half_span_rad` to both sides.
pub fn levels(aestivation: Aestivation, count: usize, half_span_rad: f32, seed: u64) -> Levels {
    let sector = TAU / count.max(1) as f32;
    // A petal overlaps so many neighbours on each side.
    let overlapping = ((2.0 * half_span_rad / sector).ceil() as usize).saturating_sub(1).min(count / 2);
    let flat = |stacked| Levels { of: vec![Level { height: 0.0, slope: 0.0 }; count], stacked, apart: 1.0 };
    match aestivation {
        _ if count < 2 || overlapping == 0 => flat(1),
        Aestivation::Valvate | Aestivation::Spiral => flat(1),
        Aestivation::Contorted => {
            let slope = 0.5;
            // Two whose middles are a sector apart differ by as much everywhere.
            let apart = (slope * sector / half_span_rad.min(PI)).min(1.0);
            let of = vec![Level { height: 0.5, slope }; count];
            Levels { of, stacked: overlapping as u32 + 1, apart }
        }
        Aestivation::Imbricate => imbricate(count, overlapping, seed),
    }
}

fn imbricate(count: usize, overlapping: usize, seed: u64) -> Levels {
    let ages = if count <= FEW.max(2 * overlapping + 1) {
        formed_one_by_one(count)
    } else {
        greedy(count, overlapping, &mut stream(seed, "aestivation", count as u64))
    };
    let most = ages.iter().copied().max().unwrap_or(0).max(1);
    let near = |i: usize| (1..=overlapping).map(move |d| (i, (i + d) % count));
    let pairs = (0..count).flat_map(near).filter(|(a, b)| a != b);
    let apart = pairs.map(|(a, b)| ages[a].abs_diff(ages[b])).min().unwrap_or(most);
    let height = |age: &usize| Level { height: *age as f32 / most as f32, slope: 0.0 };
    Levels {
        of: ages.iter().map(height).collect(),
        stacked: most as u32 + 1,
        apart: apart as f32 / most as f32,
    }
}

/// The order in which petals of a ring were formed, each as near to 2/5 of a turn behind the one before as their number allows.
fn formed_one_by_one(count: usize) -> Vec<usize> {
    let coprime = |step: usize| {
        let (mut a, mut b) = (count, step);
        while b > 0 {
            (a, b) = (b, a % b);
        }
        a == 1
    };
    let wanted = 0.4 * count as f32;
    let steps = (1..count).filter(|step| coprime(*step));
    let nearest = steps.min_by(|a, b| (*a as f32 - wanted).abs().total_cmp(&(*b as f32 - wanted).abs()));
    let step = nearest.unwrap_or(1);
    let mut ages = vec![0; count];
    (0..count).for_each(|age| ages[age * step % count] = age);
    ages
}

/// Levels of which no two within reach of each other are the same, few and in no order.
fn greedy(count: usize, overlapping: usize, rng: &mut Pcg64Mcg) -> Vec<usize> {
    let mut ages = vec![usize::MAX; count];
    for i in 0..count {
        let near = (1..=overlapping).flat_map(|d| [(i + d) % count, (i + count - d) % count]);
        let taken: Vec<usize> = near.map(|j| ages[j]).collect();
        let mut free: Vec<usize> = (0..=2 * overlapping).filter(|age| !taken.contains(age)).collect();
        // Among the lowest that are free, so that there are few in all.
        free.truncate(2);
        ages[i] = free[rng.random_range(0..free.len())];
    }
    ages
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layers(text: &str) -> Layers {
        toml::from_str(text).unwrap()
    }

    #[test]
    fn equal_layers_alternate() {
        let still = "count = 3\npetals = [[0, 5]]\nturn_vary_deg = 0";
        let rings = rings(&layers(still), 1);
        let firsts: Vec<f32> = rings.iter().map(|ring| ring.places[0].azimuth_rad.to_degrees()).collect();
        assert!((firsts[1] - 36.0).abs() < 1e-3 && (firsts[2] - 72.0).abs() < 1e-3, "{firsts:?}");
    }

    #[test]
    fn unequal_layers_stand_as_far_apart_as_they_can() {
        let rings = rings(&layers("count = 2\npetals = [[0, 5], [1, 10]]\nturn_vary_deg = 0"), 1);
        let off = |a: f32, b: f32| {
            let d = (a - b).rem_euclid(TAU);
            d.min(TAU - d)
        };
        let pairs = rings[0].places.iter().flat_map(|a| rings[1].places.iter().map(move |b| (a, b)));
        let least = pairs.map(|(a, b)| off(a.azimuth_rad, b.azimuth_rad)).fold(9.0, f32::min);
        assert!((least.to_degrees() - 18.0).abs() < 1.0, "{}", least.to_degrees());
    }

    #[test]
    fn five_imbricate_petals_are_a_quincunx() {
        let levels = levels(Aestivation::Imbricate, 5, 1.2, 1);
        let ages: Vec<f32> = levels.of.iter().map(|level| (level.height * 4.0).round()).collect();
        assert_eq!(ages, [0.0, 3.0, 1.0, 4.0, 2.0]);
        // Two wholly outside, two wholly inside, one with a margin over and one under.
        let kind = |i: usize| {
            [ages[(i + 1) % 5], ages[(i + 4) % 5]].iter().filter(|other| **other > ages[i]).count()
        };
        let kinds: Vec<usize> = (0..5).map(kind).collect();
        assert_eq!([2, 1, 0].map(|k| kinds.iter().filter(|kind| **kind == k).count()), [2, 1, 2]);
    }

    #[test]
    fn overlapping_petals_are_never_on_one_level() {
        for count in 2..60 {
            for half_span in [0.1, 0.3, 0.7, 1.3] {
                let levels = levels(Aestivation::Imbricate, count, half_span, 7);
                assert!(levels.apart > 0.0, "{count} petals of {half_span}");
                assert!(levels.of.iter().all(|level| (0.0..=1.0).contains(&level.height)));
            }
        }
    }

    #[test]
    fn contact_parastichies_are_neighbours_of_the_sequence_of_t() {
        // The nearest petals in angle among those formed shortly before are 1, t, t + 1, 2t + 1, … back.
        for t in 2..6u32 {
            let turn = divergence_rad(t);
            let off = |k: u32| {
                let d = (turn * k as f32).rem_euclid(TAU);
                d.min(TAU - d)
            };
            let mut records = Vec::new();
            for k in 1..60 {
                if records.iter().all(|r| off(*r) > off(k)) {
                    records.push(k);
                }
            }
            let mut expected = vec![1, t, t + 1];
            while expected.len() < records.len() {
                expected.push(expected[expected.len() - 1] + expected[expected.len() - 2]);
            }
            assert_eq!(records, expected, "t = {t}");
        }
    }
}
