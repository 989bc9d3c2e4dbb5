//! Markers of free space, uniformly distributed in a volume (001 §2.2).
//!
//! They are scattered in blocks, each with a random stream of its own, on all cores, and sorted into the cells of a grid as
//! wide as a bud sees. Within a cell the free ones stand first, in the order in which they were scattered; what a node
//! occupies moves behind them with the year and the node that took it, so that going back to an age frees it again.

use crate::geom::cells::{Grid, Sorted};
use crate::growth::tree::NEVER;
use crate::growth::volume::{Envelope, Swept};
use crate::random::{mix, stream};
use glam::{IVec3, Vec3};
use rand::RngExt;
use rayon::prelude::*;

/// Points that one random stream scatters.
const BLOCK: usize = 4096;
/// Most points that are tried; an envelope that fills less of its box has fewer markers.
const MOST_TRIED: usize = 1 << 24;

/// Markers of free space.
#[derive(Clone, Debug)]
pub struct Markers {
    /// The cells.
    pub grid: Grid,
    /// Places, by cell.
    pub at: Vec<Vec3>,
    /// Where each cell begins.
    starts: Vec<u32>,
    /// Where the free markers of each cell end.
    free_end: Vec<u32>,
    /// In which order they were scattered.
    rank: Vec<u32>,
    /// The year in which each was occupied, or [`NEVER`].
    taken: Vec<u16>,
    /// The node that occupies it, where it is occupied.
    owner: Vec<u32>,
    /// Markers per cubic metre.
    pub density: f32,
}

impl Markers {
    /// Scatters markers in an envelope that has bounds: `density` of them per cubic metre, fewer if they would be more
    /// than `most`; cells are `cell` wide.
    pub fn scatter(envelope: &Envelope, density: f32, most: usize, cell: f32, seed: u64) -> Self {
        let (low, high) = envelope.bounds().unwrap_or((Vec3::ZERO, Vec3::ONE));
        let extent = (high - low).max(Vec3::ZERO);
        let volume = extent.x * extent.y * extent.z;
        let share = filled_share(envelope, low, extent, seed);
        let wanted = (volume * density).min(most as f32 / share.max(1e-3)).min(MOST_TRIED as f32);
        let density = wanted / volume.max(f32::MIN_POSITIVE);
        let tried = wanted.ceil() as usize;
        let block = |b: usize| {
            let mut rng = stream(seed, "markers", b as u64);
            let count = BLOCK.min(tried - b * BLOCK);
            let points = (0..count).map(|_| low + extent * Vec3::from_array(rng.random::<[f32; 3]>()));
            let inside: Vec<Vec3> = points.filter(|p| envelope.contains(*p)).collect();
            // Drawn by lot only where it is sparse: elsewhere markers are as they would be without.
            let stays = |p: &Vec3| {
                let share = envelope.density(*p);
                share >= 1.0 || rng.random::<f32>() < share
            };
            inside.into_iter().filter(stays).collect::<Vec<_>>()
        };
        let blocks: Vec<Vec<Vec3>> = (0..tried.div_ceil(BLOCK)).into_par_iter().map(block).collect();
        let mut points = blocks.concat();
        points.truncate(most);
        Self::new(points, low, high, cell, density)
    }

    /// Scatters markers in what a brush sweeps, in each cell of its cover by a random stream of its own: `density` of them per cubic
    /// metre, fewer if they would be more than `most`. Any other stroke that sweeps the same gets the same ones.
    pub fn scatter_in_swept(swept: &Swept, density: f32, most: usize, cell: f32, seed: u64) -> Self {
        let (cells, side) = swept.cells();
        let density = density.min(most as f32 / swept.volume().max(f32::MIN_POSITIVE));
        let mean = (density * side.powi(3)).min(MOST_TRIED as f32 / cells.len().max(1) as f32);
        let fill = |cell: &IVec3| {
            let name = cell.to_array().iter().fold(0, |name, x| mix(name, u64::from(x.cast_unsigned())));
            let mut rng = stream(seed, "markers", name);
            let count = mean as usize + usize::from(rng.random::<f32>() < mean.fract());
            let low = cell.as_vec3() * side;
            let points = (0..count).map(|_| low + Vec3::from_array(rng.random::<[f32; 3]>()) * side);
            points.filter(|p| swept.contains(*p)).collect::<Vec<_>>()
        };
        let blocks: Vec<Vec<Vec3>> = cells.par_iter().with_min_len(64).map(fill).collect();
        let mut points = blocks.concat();
        points.truncate(most);
        let (low, high) = swept.bounds();
        Self::new(points, low, high, cell, mean / side.powi(3))
    }

    /// Markers at given places.
    pub fn new(points: Vec<Vec3>, low: Vec3, high: Vec3, cell: f32, density: f32) -> Self {
        let grid = Grid::new(low, high, cell);
        let cell_of: Vec<u32> = points.iter().map(|p| grid.number(grid.place(*p)) as u32).collect();
        let mut sorted = Sorted::default();
        sorted.sort(grid.len(), &cell_of);
        let Sorted { starts, items } = sorted;
        Self {
            at: items.iter().map(|&i| points[i as usize]).collect(),
            free_end: starts[1..].to_vec(),
            starts,
            taken: vec![NEVER; items.len()],
            owner: vec![u32::MAX; items.len()],
            rank: items,
            grid,
            density,
        }
    }

    /// Takes away all that `stays` does not want; none may be occupied.
    pub fn keep(&mut self, stays: impl Fn(&Vec3) -> bool + Sync) {
        let kept: Vec<bool> = self.at.par_iter().with_min_len(256).map(&stays).collect();
        let mut before = 0;
        for cell in 0..self.grid.len() {
            let range = self.starts[cell] as usize..self.starts[cell + 1] as usize;
            self.starts[cell] = before;
            before += kept[range].iter().filter(|kept| **kept).count() as u32;
            self.free_end[cell] = before;
        }
        self.starts[self.grid.len()] = before;
        let mut each = kept.iter();
        self.at.retain(|_| each.next() == Some(&true));
        let mut each = kept.iter();
        self.rank.retain(|_| each.next() == Some(&true));
        self.taken.truncate(before as usize);
        self.owner.truncate(before as usize);
    }

    /// Number of markers, occupied ones counted.
    pub fn len(&self) -> usize {
        self.at.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.at.is_empty()
    }

    /// The free markers of a cell.
    pub fn free_in(&self, cell: usize) -> std::ops::Range<usize> {
        self.starts[cell] as usize..self.free_end[cell] as usize
    }

    /// Places of all free markers.
    pub fn free(&self) -> impl Iterator<Item = Vec3> + '_ {
        (0..self.grid.len()).flat_map(|cell| self.at[self.free_in(cell)].iter().copied())
    }

    /// Places of all occupied markers with the nodes that occupy them.
    pub fn occupied(&self) -> impl Iterator<Item = (Vec3, u32)> + '_ {
        let all = self.at.iter().zip(&self.taken).zip(&self.owner);
        all.filter(|((_, taken), _)| **taken != NEVER).map(|((at, _), owner)| (*at, *owner))
    }

    /// Every so many-th marker, the same ones at all ages, and whether it was occupied at the end of a year.
    pub fn at_age(&self, year: u16, every: usize) -> impl Iterator<Item = (Vec3, bool)> + '_ {
        let all = self.at.iter().zip(&self.taken).zip(&self.rank);
        let chosen = all.filter(move |(_, rank)| (**rank as usize).is_multiple_of(every.max(1)));
        chosen.map(move |((at, taken), _)| (*at, *taken <= year))
    }

    /// Occupies the free markers within `radius` of a node; gives the number of markers and cells that were looked at.
    pub fn occupy(&mut self, at: Vec3, radius: f32, node: u32, year: u16) -> u64 {
        if !self.grid.is_near(at, radius / self.grid.cell) {
            return 0;
        }
        let (low, high) = self.grid.around(at, radius);
        let mut seen = 0;
        for y in low.y..=high.y {
            for z in low.z..=high.z {
                for x in low.x..=high.x {
                    let cell = self.grid.number(IVec3::new(x, y, z));
                    seen += 1 + self.free_in(cell).len() as u64;
                    self.occupy_in(cell, at, radius, (node, year));
                }
            }
        }
        seen
    }

    fn occupy_in(&mut self, cell: usize, at: Vec3, radius: f32, (node, year): (u32, u16)) {
        let (first, last) = (self.starts[cell] as usize, self.free_end[cell] as usize);
        let (mut end, mut found) = (first, Vec::new());
        // In one pass, for a cell may hold all markers; the others keep their order.
        for k in first..last {
            let marker = (self.at[k], self.rank[k]);
            if marker.0.distance_squared(at) > radius * radius {
                (self.at[end], self.rank[end]) = marker;
                end += 1;
            } else {
                found.push(marker);
            }
        }
        for (k, marker) in (end..last).rev().zip(found) {
            (self.at[k], self.rank[k]) = marker;
            (self.taken[k], self.owner[k]) = (year, node);
        }
        self.free_end[cell] = end as u32;
    }

    /// Frees what was occupied after a year.
    pub fn rewind(&mut self, year: u16) {
        for cell in 0..self.grid.len() {
            let range = self.starts[cell] as usize..self.starts[cell + 1] as usize;
            if !self.taken[range.clone()].iter().any(|taken| *taken > year && *taken != NEVER) {
                continue;
            }
            let mut held: Vec<(bool, u32, Vec3, u16, u32)> = range
                .clone()
                .map(|k| {
                    let free = self.taken[k] > year;
                    let (taken, owner) =
                        if free { (NEVER, u32::MAX) } else { (self.taken[k], self.owner[k]) };
                    (!free, self.rank[k], self.at[k], taken, owner)
                })
                .collect();
            held.sort_unstable_by_key(|h| (h.0, h.1));
            let free = held.iter().filter(|h| !h.0).count();
            for (k, (_, rank, at, taken, owner)) in range.clone().zip(held) {
                (self.rank[k], self.at[k], self.taken[k], self.owner[k]) = (rank, at, taken, owner);
            }
            self.free_end[cell] = (range.start + free) as u32;
        }
    }
}

/// Which share of its box an envelope fills, roughly.
fn filled_share(envelope: &Envelope, low: Vec3, extent: Vec3, seed: u64) -> f32 {
    let mut rng = stream(seed, "filled share", 0);
    let probes = 512;
    let mut inside = 0;
    for _ in 0..probes {
        inside += i32::from(envelope.contains(low + extent * Vec3::from_array(rng.random::<[f32; 3]>())));
    }
    inside as f32 / probes as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ball(most: usize) -> Markers {
        let envelope = Envelope::Sphere { centre: Vec3::Y * 3.0, radius: 2.0 };
        Markers::scatter(&envelope, 500.0, most, 0.5, 7)
    }

    #[test]
    fn markers_fill_the_volume_evenly() {
        let markers = ball(1_000_000);
        let expected = 500.0 * 4.0 / 3.0 * std::f32::consts::PI * 8.0;
        assert!((markers.len() as f32 - expected).abs() < 0.05 * expected, "{} of {expected}", markers.len());
        let above = markers.free().filter(|p| p.y > 3.0).count() as f32;
        assert!((above / markers.len() as f32 - 0.5).abs() < 0.02);
        let fewer = ball(1000).len();
        assert!(fewer <= 1000 && fewer > 700, "{fewer}");
    }

    #[test]
    fn what_is_swept_twice_is_no_denser() {
        let way: Vec<_> = (0..9).map(|k| (Vec3::X * 0.3 * k as f32, 0.4)).collect();
        let back: Vec<_> = way.iter().rev().chain(&way).copied().collect();
        let scatter = |way: &[(Vec3, f32)], most: usize| {
            let swept = Swept::new(way, 0.8).unwrap();
            let markers = Markers::scatter_in_swept(&swept, 500.0, most, 0.2, 7);
            assert!(markers.free().all(|p| swept.contains(p)));
            (markers, 500.0 * swept.volume())
        };
        let (once, expected) = scatter(&way, 1_000_000);
        assert!((once.len() as f32 / expected - 1.0).abs() < 0.06, "{} of {expected}", once.len());
        assert!(once.free().eq(scatter(&back, 1_000_000).0.free()));
        let fewer = scatter(&way, 100).0.len();
        assert!((60..=100).contains(&fewer), "{fewer}");
    }

    #[test]
    fn what_is_occupied_is_occupied_once_and_freed_by_going_back() {
        let mut markers = ball(1_000_000);
        let before = markers.clone();
        markers.occupy(Vec3::Y * 3.0, 0.7, 1, 1);
        let first = markers.clone();
        markers.occupy(Vec3::Y * 3.4, 0.7, 2, 2);
        assert!(markers.free().all(|p| p.distance(Vec3::Y * 3.0) > 0.7 && p.distance(Vec3::Y * 3.4) > 0.7));
        for (at, owner) in markers.occupied() {
            assert!(at.distance(Vec3::Y * if owner == 1 { 3.0 } else { 3.4 }) <= 0.7);
        }
        assert_eq!(markers.free().count() + markers.occupied().count(), before.len());
        markers.rewind(1);
        assert!(markers.free().eq(first.free()) && markers.occupied().count() == first.occupied().count());
        markers.rewind(0);
        assert!(markers.free().eq(before.free()));
    }
}
