//! Spots for all kinds of one bed that keep one distance: corner-coloured tiles laid over it, thinned by densities and maps.
//!
//! A hash decides which of the kinds grows at a spot.
//!
//! Source: 004 §3.3.

use super::grey_map::GreyMap;
use super::occupied::Occupied;
use super::plan::{Kind, Place, Plan};
use super::tiles::{Spot, TileSet};
use crate::random::{Choice, mix};
use glam::Vec2;

/// Spots over a bed, or over the ground outside of all.
pub(super) struct Lattice<'a> {
    pub(super) plan: &'a Plan,
    pub(super) tiles: &'a TileSet,
    pub(super) seed: u64,
    /// Where, an index into [`Plan::beds`].
    pub(super) bed: Option<usize>,
    /// The kinds with their numbers.
    pub(super) kinds: Vec<(&'a Kind, u32)>,
    pub(super) spacing: f32,
    /// Share of the spots that is used where no map thins them.
    pub(super) kept: f32,
}

impl Lattice<'_> {
    fn side(&self) -> f64 {
        f64::from(self.tiles.side()) * f64::from(self.spacing)
    }

    /// How many plants it has where no map thins them, about.
    pub(super) fn most_plants(&self) -> f64 {
        let density =
            f64::from(self.kept) * f64::from(self.tiles.density()) / f64::from(self.spacing).powi(2);
        f64::from(self.plan.square_metres_of(self.bed)) * density
    }

    /// How many plants it has, about: maps thin evenly, paths do not count.
    pub(super) fn plants(&self) -> f64 {
        let mean = |map: &Option<GreyMap>| map.as_ref().map_or(1.0, GreyMap::mean);
        let share = |kind: &Kind| kind.share * mean(&kind.map);
        let (all, left) = self
            .kinds
            .iter()
            .fold((0.0, 0.0), |(all, left), (kind, _)| (all + kind.share, left + share(kind)));
        self.most_plants() * f64::from(mean(&self.plan.map) * left / all)
    }

    /// First and last tile along each axis, of those that reach into a box.
    fn reach(&self, (from, to): (Vec2, Vec2)) -> [[i64; 2]; 2] {
        let (low, high) = self.plan.bounds_of(self.bed);
        let (low, high) = (low.max(from), high.min(to));
        let tile = |along: f32| (f64::from(along) / self.side()).floor() as i64;
        [[tile(low.x), tile(high.x)], [tile(low.y), tile(high.y)]]
    }

    /// How many tiles reach into a box.
    pub(super) fn tile_count(&self, within: (Vec2, Vec2)) -> f64 {
        self.reach(within).map(|[first, last]| (last - first + 1).max(0) as f64).iter().product()
    }

    /// The tiles that reach into a box, row by row.
    pub(super) fn tiles(&self, within: (Vec2, Vec2)) -> impl Iterator<Item = [i64; 2]> + use<> {
        let [across, along] = self.reach(within);
        (along[0]..=along[1]).flat_map(move |j| (across[0]..=across[1]).map(move |i| [i, j]))
    }

    /// The spots of a tile where something can grow, with their numbers.
    fn spots(&self, tile: [i64; 2]) -> impl Iterator<Item = (Vec2, f32, usize)> {
        let corner = tile.map(|k| k as f64 * self.side());
        let spots = self.tiles.at(self.seed, tile).iter().enumerate();
        spots.filter_map(move |(number, Spot { at, rank })| {
            let at = at.as_dvec2() * f64::from(self.spacing);
            let at = Vec2::new((corner[0] + at.x) as f32, (corner[1] + at.y) as f32);
            self.plan.is_in_bed(self.bed, at).then_some((at, *rank, number))
        })
    }

    /// Whether a tile has any spot where something can grow.
    pub(super) fn has_spots(&self, tile: [i64; 2]) -> bool {
        self.spots(tile).next().is_some()
    }

    /// The plants of a tile, and whether it has any spot where something can grow.
    pub(super) fn places_of(&self, tile: [i64; 2], occupied: &Occupied) -> (bool, Vec<Place>) {
        let key = mix(mix(Choice::SPOT.key(self.seed), tile[0] as u64), tile[1] as u64);
        let (mut has_spots, mut places) = (false, Vec::new());
        for (at, rank, number) in self.spots(tile) {
            has_spots = true;
            if rank >= self.kept {
                break;
            }
            if occupied.has_room(at, self.spacing) {
                places.extend(self.place(at, rank, mix(key, number as u64)));
            }
        }
        (has_spots, places)
    }

    /// The plant at a spot, if one grows there; the spot's key decides what is left to chance.
    pub(super) fn place(&self, at: Vec2, rank: f32, spot: u64) -> Option<Place> {
        if self.plan.is_on_path(at) {
            return None;
        }
        let weight = |kind: &Kind| kind.share * self.plan.value(kind.map.as_ref(), at);
        let (all, weights): (f32, f32) = self
            .kinds
            .iter()
            .fold((0.0, 0.0), |(all, sum), (kind, _)| (all + kind.share, sum + weight(kind)));
        if rank >= self.kept * self.plan.value(self.plan.map.as_ref(), at) * weights / all {
            return None;
        }
        let mut left = Choice::PLANT.unit(spot) * weights;
        let is_it = |(kind, _): &&(&Kind, u32)| {
            left -= weight(kind);
            left < 0.0
        };
        let (_, number) = self.kinds.iter().find(is_it).or(self.kinds.last())?;
        Some(self.plan.plant(*number, at, spot))
    }
}
