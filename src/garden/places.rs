//! Where the plants of a garden stand: what is put one by one, in rows and along lines, then corner-coloured tiles laid over its beds
//! and its open ground.
//!
//! Kinds of plants of one bed that keep the same distance share a lattice, and a hash decides which of them grows at a spot. Those that
//! keep more come first; a spot of a later lattice stays free that is nearer to a plant that is there than the mean of both
//! distances.
//!
//! The places are in the order of squares of the plan (`share`). A share of them is found by itself, from its own squares and as much
//! around them as distances reach ([`Plan::places_of`]).
//!
//! Source: 004 §3.3; beds, rows and shares are ours.
//!
//! Limits: lattices of several distances are spread each by itself, so of all plants together the spectrum is not as even.

use super::lattice::Lattice;
use super::occupied::Occupied;
use super::plan::{Kind, Place, Plan, PlanError, Stands};
use super::rows;
use super::share::{Share, Squares};
use super::tiles::TileSet;
use crate::budget::GardenBudget;
use crate::random::{Choice, mix};
use glam::Vec2;
use rayon::prelude::*;
use std::ops::Range;

impl Plan {
    /// The places of all plants.
    ///
    /// # Errors
    /// [`PlanError`].
    pub fn places(&self, tiles: &TileSet) -> Result<Vec<Place>, PlanError> {
        let places = self.places_of(tiles, Share::WHOLE)?;
        if places.is_empty() { Err(PlanError::NoGround) } else { Ok(places) }
    }

    /// The places of a share of the plants: those of all shares one after the other are those of all plants. A share may have none.
    ///
    /// # Errors
    /// [`PlanError`], as far as it can be known of a share.
    pub fn places_of(&self, tiles: &TileSet, share: Share) -> Result<Vec<Place>, PlanError> {
        let lattices = self.lattices(tiles)?;
        let squares = Squares::over(self.area.bounds(), self.widest() * tiles.side());
        let own = squares.of(share);
        let within = squares.bounds(&own);
        self.check_size(&lattices, (share, within))?;
        let reaches = self.reaches(&lattices);
        let mut places = rows::placed(self, grown(within, reaches[0]));
        let mut have_spots = Vec::with_capacity(lattices.len());
        for (lattice, reach) in lattices.iter().zip(&reaches[1..]) {
            let within = grown(within, *reach);
            let occupied = self.occupied(&places, within);
            let tiles: Vec<[i64; 2]> = lattice.tiles(within).collect();
            let of_tile = |tile: &[i64; 2]| lattice.places_of(*tile, &occupied);
            let found: Vec<(bool, Vec<Place>)> = tiles.par_iter().map(of_tile).collect();
            have_spots.push(found.iter().any(|(has_spots, _)| *has_spots));
            places.reserve(found.iter().map(|(_, found)| found.len()).sum());
            found.into_iter().for_each(|(_, found)| places.extend(found));
        }
        self.plant_small_beds(&lattices, &have_spots, &mut places);
        Ok(in_order(places, |place| squares.number(flat(place)), &own))
    }

    /// How many plants there will be, about: maps thin evenly, nothing is in the way.
    ///
    /// # Errors
    /// [`PlanError::TooDense`].
    pub fn plants(&self, tiles: &TileSet) -> Result<f64, PlanError> {
        let spread: f64 = self.lattices(tiles)?.iter().map(Lattice::plants).sum();
        Ok(spread + rows::plants(self))
    }

    /// The largest distance that a kind keeps.
    fn widest(&self) -> f32 {
        self.kinds.iter().map(|kind| kind.spacing).fold(0.0, f32::max)
    }

    /// How far around a share the plants decide what grows in it: those that are put, then those of each lattice.
    fn reaches(&self, lattices: &[Lattice<'_>]) -> Vec<f32> {
        let widest = self.widest();
        // The plant of a small bed looks at all others, as far as half of what they keep.
        let mut reaches = vec![EDGE + 0.5 * widest];
        for lattice in lattices.iter().rev() {
            let next = reaches[reaches.len() - 1];
            reaches.push(next + 0.5 * (widest + lattice.spacing));
        }
        reaches.reverse();
        reaches
    }

    /// The lattices, those of larger distances first.
    fn lattices<'a>(&'a self, tiles: &'a TileSet) -> Result<Vec<Lattice<'a>>, PlanError> {
        let spread = || self.kinds.iter().zip(0..).filter(|(kind, _)| kind.stands == Stands::Spread);
        let mut grounds: Vec<(f32, Option<usize>)> =
            spread().map(|(kind, _)| (kind.spacing, kind.bed)).collect();
        grounds.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        grounds.dedup();
        let lattice = |(layer, (spacing, bed)): (usize, (f32, Option<usize>))| {
            let of_bed = || spread().filter(|(kind, _)| kind.bed == bed);
            let kinds: Vec<(&Kind, u32)> = of_bed().filter(|(kind, _)| kind.spacing == spacing).collect();
            let all: f32 = of_bed().map(|(kind, _)| kind.share).sum();
            let share = kinds.iter().map(|(kind, _)| kind.share).sum::<f32>() / all;
            let most = tiles.density() / (spacing * spacing);
            let kept = self.density.map_or(share, |density| density * share / most);
            if kept > 1.001 {
                let density = self.density.unwrap_or_default();
                let fits = Self::spacing_of(tiles, density * share);
                return Err(PlanError::TooDense { density: density * share, most, spacing, fits });
            }
            let seed = mix(Choice::LAYER.key(self.seed), layer as u64);
            Ok(Lattice { plan: self, tiles, seed, bed, kinds, spacing, kept })
        };
        grounds.into_iter().enumerate().map(lattice).collect()
    }

    /// Refuses what would have too many plants, or look for them in too many places.
    fn check_size(
        &self,
        lattices: &[Lattice<'_>],
        (share, within): (Share, (Vec2, Vec2)),
    ) -> Result<(), PlanError> {
        let most = f64::from(share.of()) * GardenBudget::GARDEN.places as f64;
        let mut plants = rows::spots(self);
        for lattice in lattices {
            plants += lattice.most_plants();
            if plants > most {
                break;
            }
            if lattice.tile_count(within) > GardenBudget::GARDEN.tiles as f64 {
                return Err(PlanError::TooWide { spacing: lattice.spacing });
            }
        }
        if plants > most { Err(PlanError::TooMany { plants }) } else { Ok(()) }
    }

    /// Plants a bed, or the open ground, whose distances are larger than itself: with one plant in its middle.
    fn plant_small_beds(&self, lattices: &[Lattice<'_>], have_spots: &[bool], places: &mut Vec<Place>) {
        let mut done = Vec::new();
        for lattice in lattices {
            if done.contains(&lattice.bed) {
                continue;
            }
            done.push(lattice.bed);
            let of_bed = || lattices.iter().zip(have_spots).filter(|(other, _)| other.bed == lattice.bed);
            let everywhere = self.bounds_of(lattice.bed);
            let has_any = |other: &Lattice<'_>| other.tiles(everywhere).any(|tile| other.has_spots(tile));
            if of_bed().any(|(_, has_spots)| *has_spots) || of_bed().any(|(other, _)| has_any(other)) {
                continue;
            }
            let middle = lattice.bed.and_then(|bed| self.beds.get(bed)).unwrap_or(&self.area).middle();
            // Its own distance is larger than its bed, so it cannot keep it.
            let is_free = self.occupied(places, everywhere).has_room(middle, 0.0);
            if is_free && self.is_in_bed(lattice.bed, middle) {
                places.extend(lattice.place(middle, 0.0, Choice::SPOT.key(lattice.seed)));
            }
        }
    }

    /// An index of plants over a part of the garden.
    fn occupied(&self, places: &[Place], within: (Vec2, Vec2)) -> Occupied {
        let plant = |place: &Place| (flat(place), self.kinds[place.kind as usize].spacing);
        let (low, high) = self.area.bounds();
        Occupied::of(places.iter().map(plant).collect(), (low.max(within.0), high.min(within.1)))
    }
}

/// Room for what rounding moves over the edge of a square, metres.
const EDGE: f32 = 0.01;

fn grown((low, high): (Vec2, Vec2), by: f32) -> (Vec2, Vec2) {
    (low - by, high + by)
}

/// The plants of some squares in the order of these, those of one square as they come.
fn in_order(
    places: Vec<Place>,
    square: impl Fn(&Place) -> u64 + Send + Sync,
    own: &Range<u64>,
) -> Vec<Place> {
    let squares: Vec<u64> = places.par_iter().map(square).collect();
    // One lattice over all of a garden comes square by square.
    if squares.is_sorted() && squares.iter().all(|square| own.contains(square)) {
        return places;
    }
    let mut order: Vec<(u64, u32)> =
        squares.into_iter().zip(0..).filter(|(square, _)| own.contains(square)).collect();
    order.par_sort_unstable();
    order.into_iter().map(|(_, place)| places[place as usize]).collect()
}

/// Where a plant stands on the plan.
fn flat(place: &Place) -> Vec2 {
    Vec2::new(place.at.x, place.at.z)
}

#[cfg(test)]
#[path = "places_tests.rs"]
mod tests;
