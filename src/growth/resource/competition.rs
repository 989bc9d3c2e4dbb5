//! Buds compete for the space that they perceive (001 §2.2, fig. 2.2).
//!
//! A bud perceives the free markers in a cone of radius r and opening angle θ about its direction. A marker that several
//! buds perceive belongs to the nearest. A bud's best direction is the mean of the unit vectors to its markers
//! (eq. 2.1), and what it earns grows with their number up to [`ENOUGH`] of those in a whole empty cone; the thesis
//! leaves the amount open.
//!
//! Each marker asks the buds of its own and the 26 cells around it, so a year costs the free markers near buds times
//! the buds near each. Rows of cells are worked on at once; claims are added up in the order of rows.

use super::markers::Markers;
use crate::geom::cells::Sorted;
use glam::{IVec3, Vec3};
use rayon::prelude::*;
use std::ops::Range;

/// The cone in which a bud perceives space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Perception {
    /// Radius r, metres; at most a cell of the markers' grid.
    pub radius: f32,
    /// Cosine of half the opening angle θ.
    pub cos_half: f32,
}

impl Perception {
    /// Number of markers in an empty cone.
    fn expected(&self, density: f32) -> f32 {
        let volume = std::f32::consts::TAU / 3.0 * self.radius.powi(3) * (1.0 - self.cos_half);
        (volume * density).max(1.0)
    }
}

/// What the buds found, in the order of the buds.
#[derive(Clone, Debug, Default)]
pub(crate) struct Found {
    /// Resource, 0 to 1.
    pub q: Vec<f32>,
    /// Best direction, shorter than 1 where directions differ; zero where nothing was found.
    pub best: Vec<Vec3>,
}

/// A marker and the bud that gets it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Claim {
    /// The marker.
    pub marker: u32,
    /// The bud, by its place in the list.
    pub bud: u32,
}

/// Share of an empty cone's markers that earns the full resource.
pub(crate) const ENOUGH: f32 = 0.2;

/// Rows of cells that one thread takes at a time.
const ROWS: usize = 8;

/// Shares the free markers out among the buds of a crowd.
pub(crate) fn compete(markers: &Markers, perception: Perception, crowd: &Crowd, found: &mut Found) {
    let at = crowd.given;
    found.q.clear();
    found.q.resize(at.len(), 0.0);
    found.best.clear();
    found.best.resize(at.len(), Vec3::ZERO);
    for claim in claims(markers, perception, crowd).iter().flatten() {
        let bud = claim.bud as usize;
        let toward = markers.at[claim.marker as usize] - at[bud];
        found.q[bud] += 1.0;
        found.best[bud] += toward.normalize_or_zero();
    }
    let enough = (ENOUGH * perception.expected(markers.density)).max(1.0);
    for (q, best) in found.q.iter_mut().zip(&mut found.best) {
        if *q > 0.0 {
            *best /= *q;
            *q = (*q / enough).min(1.0);
        }
    }
}

/// Buds in the order of the cells of the markers' grid.
pub(crate) struct Crowd<'a> {
    /// Where they are, in the order in which they were given.
    given: &'a [Vec3],
    sorted: Sorted,
    at: Vec<Vec3>,
    look: Vec<Vec3>,
}

impl<'a> Crowd<'a> {
    /// Buds at `at` that look along `look`.
    pub(crate) fn new(markers: &Markers, at: &'a [Vec3], look: &[Vec3]) -> Self {
        let grid = &markers.grid;
        let mut sorted = Sorted::default();
        let cell_of: Vec<u32> = at.iter().map(|p| grid.number(grid.place(*p)) as u32).collect();
        sorted.sort(grid.len(), &cell_of);
        let of = |all: &[Vec3]| sorted.items.iter().map(|&i| all[i as usize]).collect();
        Self { given: at, at: of(at), look: of(look), sorted }
    }

    /// Comparisons of markers with buds that [`compete`] makes.
    pub(crate) fn comparisons(&self, markers: &Markers) -> u64 {
        let row = |row: usize| -> u64 {
            let mut count = 0;
            self.each_cell(markers, row as i32, |free, near| {
                count += (free.len() * near.iter().map(|(first, end)| end - first).sum::<usize>()) as u64;
            });
            count
        };
        (0..rows(markers)).into_par_iter().with_min_len(ROWS).map(row).sum()
    }

    /// Gives every cell of a row that has free markers and buds near: the markers, and runs of the buds.
    fn each_cell(&self, markers: &Markers, row: i32, mut cell: impl FnMut(Range<usize>, &[(usize, usize)])) {
        let size = markers.grid.size;
        let (y, z) = (row / size.z, row % size.z);
        let mut near: Vec<(usize, usize)> = Vec::with_capacity(9);
        for x in 0..size.x {
            let free = markers.free_in(markers.grid.number(IVec3::new(x, y, z)));
            if free.is_empty() {
                continue;
            }
            near.clear();
            for ny in (y - 1).max(0)..=(y + 1).min(size.y - 1) {
                for nz in (z - 1).max(0)..=(z + 1).min(size.z - 1) {
                    let number = |x: i32| markers.grid.number(IVec3::new(x, ny, nz));
                    let first = self.sorted.starts[number((x - 1).max(0))] as usize;
                    let end = self.sorted.starts[number((x + 1).min(size.x - 1)) + 1] as usize;
                    if first < end {
                        near.push((first, end));
                    }
                }
            }
            if !near.is_empty() {
                cell(free, &near);
            }
        }
    }
}

/// Rows of the markers' cells.
fn rows(markers: &Markers) -> usize {
    (markers.grid.size.y * markers.grid.size.z) as usize
}

/// Who gets which marker, by rows of cells.
pub(crate) fn claims(markers: &Markers, perception: Perception, crowd: &Crowd<'_>) -> Vec<Vec<Claim>> {
    let row = |r: usize| row_claims(markers, perception, crowd, r as i32);
    (0..rows(markers)).into_par_iter().with_min_len(ROWS).map(row).collect()
}

fn row_claims(markers: &Markers, perception: Perception, crowd: &Crowd<'_>, row: i32) -> Vec<Claim> {
    let mut out = Vec::new();
    crowd.each_cell(markers, row, |free, near| {
        for marker in free {
            if let Some(bud) = nearest(markers.at[marker], perception, crowd, near) {
                out.push(Claim { marker: marker as u32, bud: crowd.sorted.items[bud] });
            }
        }
    });
    out
}

/// The nearest bud that perceives a marker; of equally near ones the earliest.
fn nearest(
    marker: Vec3,
    perception: Perception,
    crowd: &Crowd<'_>,
    near: &[(usize, usize)],
) -> Option<usize> {
    let mut best = (perception.radius * perception.radius, None);
    for &(first, end) in near {
        for (k, at) in crowd.at[first..end].iter().enumerate() {
            let away = marker - *at;
            let squared = away.length_squared();
            if squared > best.0 {
                continue;
            }
            let k = first + k;
            let ahead = away.dot(crowd.look[k]);
            let limit = perception.cos_half * perception.cos_half * squared;
            let perceives = if perception.cos_half >= 0.0 {
                ahead >= 0.0 && ahead * ahead >= limit
            } else {
                ahead >= 0.0 || ahead * ahead <= limit
            };
            let wins = squared < best.0
                || best.1.is_none_or(|b: usize| crowd.sorted.items[k] < crowd.sorted.items[b]);
            if perceives && wins {
                best = (squared, Some(k));
            }
        }
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::growth::volume::Envelope;
    use crate::random::stream;
    use rand::RngExt;

    fn scene() -> (Markers, Vec<Vec3>, Vec<Vec3>) {
        let envelope = Envelope::Sphere { centre: Vec3::ZERO, radius: 2.0 };
        let markers = Markers::scatter(&envelope, 300.0, 100_000, 0.6, 1);
        let mut rng = stream(2, "buds", 0);
        let mut point = || Vec3::from_array(std::array::from_fn(|_| rng.random_range(-2.2..2.2_f32)));
        let at: Vec<Vec3> = (0..200).map(|_| point()).collect();
        let look = (0..200).map(|_| point().normalize()).collect();
        (markers, at, look)
    }

    #[test]
    fn every_marker_goes_to_the_nearest_bud_whose_cone_holds_it() {
        let (markers, at, look) = scene();
        let perception = Perception { radius: 0.6, cos_half: 0.5 };
        let crowd = Crowd::new(&markers, &at, &look);
        let claims: Vec<Claim> = claims(&markers, perception, &crowd).concat();
        let near =
            |p: &Vec3, b: &Vec3| (markers.grid.place(*p) - markers.grid.place(*b)).abs().max_element() <= 1;
        let compared: usize = markers.at.iter().map(|p| at.iter().filter(|b| near(p, b)).count()).sum();
        assert_eq!(crowd.comparisons(&markers), compared as u64);
        let mut got = vec![None; markers.len()];
        for claim in &claims {
            assert!(got[claim.marker as usize].replace(claim.bud).is_none(), "claimed twice");
        }
        for (m, place) in markers.at.iter().enumerate() {
            let sees = |b: &usize| {
                let away = *place - at[*b];
                away.length() <= 0.6 && away.dot(look[*b]) >= 0.5 * away.length()
            };
            let nearest = (0..at.len())
                .filter(sees)
                .min_by(|a, b| place.distance_squared(at[*a]).total_cmp(&place.distance_squared(at[*b])));
            assert_eq!(got[m], nearest.map(|b| b as u32), "marker {m}");
        }
        assert!(claims.len() > 500);
    }

    #[test]
    fn the_best_direction_points_to_free_space() {
        let (mut markers, ..) = scene();
        let perception = Perception { radius: 0.6, cos_half: -1.0 };
        for k in 0..40 {
            markers.occupy(Vec3::new(-0.5, 0.0, k as f32 * 0.02 - 0.4), 0.5, k, 1);
        }
        let mut found = Found::default();
        let crowd = Crowd::new(&markers, &[Vec3::ZERO], &[Vec3::Y]);
        compete(&markers, perception, &crowd, &mut found);
        assert!(found.best[0].normalize().x > 0.9, "{:?}", found.best);
        assert!(found.q[0] > 0.2, "{:?}", found.q);
    }
}
