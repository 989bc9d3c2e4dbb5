//! Where the plants of a garden stand: corner-coloured tiles laid over its area, thinned by densities, kept off paths.
//!
//! Kinds of plants that keep the same distance share a lattice, and a hash decides which of them grows at a spot. Those that
//! keep more come first; a spot of a later lattice stays free that is nearer to a plant of an earlier one than the mean of
//! both distances. Everything about a plant is a hash of the seed and its spot, so it does not change with what grows elsewhere,
//! with the area or with the number of threads.
//!
//! Source: 004 §3.3; turn, size, lean and the share of the slope that plants follow are ours.
//!
//! Limits: all plants of a kind keep one distance, whatever their sizes; lattices of several distances are spread each by itself, so
//! of all plants together the spectrum is not as even.

use super::area::{Area, Path};
use super::grey_map::GreyMap;
use super::ground::Ground;
use super::tiles::{Spot, TileSet};
use crate::budget::GardenBudget;
use crate::geom::cells::{Grid, Sorted};
use crate::random::{Choice, mix};
use glam::{IVec3, Quat, Vec2, Vec3};
use rayon::prelude::*;
use std::f32::consts::TAU;
use thiserror::Error;

/// A kind of plants, as far as it matters where they stand.
#[derive(Clone, Debug)]
pub struct Kind {
    /// Its part of the ground, above 0; those of all kinds are weighed against each other.
    pub share: f32,
    /// The least distance between two of them, metres.
    pub spacing: f32,
    /// How many individuals there are of it to be copied.
    pub variants: u32,
    /// Where it grows how densely.
    pub map: Option<GreyMap>,
}

crate::parameters! {
    /// How plants of one kind differ.
    pub struct Variation {
        /// By how much a plant is larger or smaller than its model, at most.
        size: f32 = 0.12, 0.0..=0.9, "share of its size";
        /// How far a plant leans, at most.
        lean: f32 = 4.0, 0.0..=45.0, "degrees";
        /// How much of the slope a plant follows: 0 upright, 1 square to the ground.
        follows: f32 = 0.3, 0.0..=1.0, "";
        /// Ground beside paths on which nothing stands, from the path's edge.
        path_margin: f32 = 0.1, 0.0..=100.0, "metres";
    }
}

/// A garden before anything grows.
#[derive(Debug)]
pub struct Plan {
    /// Decides everything that is left to chance.
    pub seed: u64,
    /// The ground.
    pub area: Area,
    /// Plants in a square metre where nothing thins them; none for as many as keep their distances.
    pub density: Option<f32>,
    /// Where they are thinned.
    pub map: Option<GreyMap>,
    /// Heights.
    pub ground: Ground,
    /// Where nothing grows.
    pub paths: Vec<Path>,
    /// What grows.
    pub kinds: Vec<Kind>,
    /// How plants differ.
    pub variation: Variation,
}

/// A plant's place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// Its kind.
    pub kind: u32,
    /// Of which individual it is a copy.
    pub variant: u32,
    /// Where it stands, metres.
    pub at: Vec3,
    /// How it is turned.
    pub rotation: Quat,
    /// How large it is, as a share of its model.
    pub scale: f32,
}

/// Why there is no garden.
#[derive(Debug, Error, PartialEq)]
pub enum PlanError {
    /// More plants than a garden may have.
    #[error(
        "the garden would have about {plants:.0} plants, more than the {} that one may have; choose a larger spacing, a lower density or a \
         smaller area", GardenBudget::GARDEN.places
    )]
    TooMany {
        /// How many.
        plants: f64,
    },
    /// The plants cannot stand so densely.
    #[error(
        "{density} plants in a square metre do not keep a spacing of {spacing} m: there is room for {most:.3}; choose a spacing of at most \
         {fits:.3} m, or leave it out"
    )]
    TooDense {
        /// Plants in a square metre that are wanted.
        density: f32,
        /// How many there can be.
        most: f32,
        /// The distance that they keep.
        spacing: f32,
        /// The distance at which there can be as many.
        fits: f32,
    },
    /// So few plants in so many spots that most of the work would be for nothing.
    #[error(
        "the area is too wide for a spacing of {spacing} m: more than {} tiles of spots would be looked through; choose a larger spacing, or \
         leave it out", GardenBudget::GARDEN.tiles
    )]
    TooWide {
        /// The distance that the plants keep.
        spacing: f32,
    },
    /// Maps and paths leave no ground.
    #[error("nothing can grow: density maps and paths leave no ground; lighten the maps, or move the paths")]
    NoGround,
}

impl Plan {
    /// The distance at which a square metre has room for so many plants.
    pub fn spacing_of(tiles: &TileSet, density: f32) -> f32 {
        (tiles.density() / density).sqrt()
    }

    /// The places of all plants: lattice by lattice, those of the largest distance first.
    ///
    /// # Errors
    /// [`PlanError`].
    pub fn places(&self, tiles: &TileSet) -> Result<Vec<Place>, PlanError> {
        let lattices = self.lattices(tiles)?;
        let mut places: Vec<Place> = Vec::new();
        let mut has_spots = false;
        for lattice in &lattices {
            let occupied = Occupied::new(&places, self);
            let tiles_in_area: Vec<[i64; 2]> = lattice.tiles().collect();
            let of_tile = |tile: &[i64; 2]| lattice.places_of(*tile, &occupied);
            let found: Vec<(bool, Vec<Place>)> = tiles_in_area.par_iter().map(of_tile).collect();
            has_spots |= found.iter().any(|(has_spots, _)| *has_spots);
            places.reserve(found.iter().map(|(_, found)| found.len()).sum());
            found.into_iter().for_each(|(_, found)| places.extend(found));
        }
        if !has_spots {
            // The distance is larger than the area.
            let middle = self.area.middle();
            places.extend(
                lattices
                    .first()
                    .and_then(|lattice| lattice.place(middle, 0.0, Choice::SPOT.key(lattice.seed))),
            );
        }
        if places.is_empty() { Err(PlanError::NoGround) } else { Ok(places) }
    }

    /// The lattices, those of larger distances first.
    fn lattices<'a>(&'a self, tiles: &'a TileSet) -> Result<Vec<Lattice<'a>>, PlanError> {
        let mut spacings: Vec<f32> = self.kinds.iter().map(|kind| kind.spacing).collect();
        spacings.sort_by(|a, b| b.total_cmp(a));
        spacings.dedup();
        let all: f32 = self.kinds.iter().map(|kind| kind.share).sum();
        let (mut plants, mut lattices) = (0.0, Vec::new());
        for (layer, spacing) in spacings.into_iter().enumerate() {
            let kinds = self.kinds.iter().zip(0..).filter(|(kind, _)| kind.spacing == spacing);
            let kinds: Vec<(&Kind, u32)> = kinds.collect();
            let share = kinds.iter().map(|(kind, _)| kind.share).sum::<f32>() / all;
            let most = tiles.density() / (spacing * spacing);
            let kept = self.density.map_or(share, |density| density * share / most);
            if kept > 1.001 {
                let density = self.density.unwrap_or_default();
                let fits = Self::spacing_of(tiles, density * share);
                return Err(PlanError::TooDense { density: density * share, most, spacing, fits });
            }
            plants += f64::from(self.area.square_metres()) * f64::from(kept) * f64::from(most);
            let seed = mix(Choice::LAYER.key(self.seed), layer as u64);
            let lattice = Lattice { plan: self, tiles, seed, kinds, spacing, kept };
            if plants > GardenBudget::GARDEN.places as f64 {
                return Err(PlanError::TooMany { plants });
            }
            if lattice.tile_count() > GardenBudget::GARDEN.tiles as f64 {
                return Err(PlanError::TooWide { spacing });
            }
            lattices.push(lattice);
        }
        Ok(lattices)
    }
}

/// Spots for all kinds that keep one distance.
struct Lattice<'a> {
    plan: &'a Plan,
    tiles: &'a TileSet,
    seed: u64,
    /// The kinds with their numbers.
    kinds: Vec<(&'a Kind, u32)>,
    spacing: f32,
    /// Share of the spots that is used where no map thins them.
    kept: f32,
}

impl Lattice<'_> {
    fn side(&self) -> f64 {
        f64::from(self.tiles.side()) * f64::from(self.spacing)
    }

    /// First and last tile along each axis.
    fn reach(&self) -> [[i64; 2]; 2] {
        let (low, high) = self.plan.area.bounds();
        let tile = |along: f32| (f64::from(along) / self.side()).floor() as i64;
        [[tile(low.x), tile(high.x)], [tile(low.y), tile(high.y)]]
    }

    fn tile_count(&self) -> f64 {
        self.reach().map(|[first, last]| (last - first + 1) as f64).iter().product()
    }

    /// The tiles over the area, row by row.
    fn tiles(&self) -> impl Iterator<Item = [i64; 2]> + use<> {
        let [across, along] = self.reach();
        (along[0]..=along[1]).flat_map(move |j| (across[0]..=across[1]).map(move |i| [i, j]))
    }

    /// The plants of a tile, and whether it has any spot in the area.
    fn places_of(&self, tile: [i64; 2], occupied: &Occupied) -> (bool, Vec<Place>) {
        let corner = tile.map(|k| k as f64 * self.side());
        let spots = self.tiles.at(self.seed, tile);
        let key = mix(mix(Choice::SPOT.key(self.seed), tile[0] as u64), tile[1] as u64);
        let (mut has_spots, mut places) = (false, Vec::new());
        for (number, Spot { at, rank }) in spots.iter().enumerate() {
            let at = at.as_dvec2() * f64::from(self.spacing);
            let at = Vec2::new((corner[0] + at.x) as f32, (corner[1] + at.y) as f32);
            if !self.plan.area.contains(at) {
                continue;
            }
            has_spots = true;
            if *rank >= self.kept {
                break;
            }
            if occupied.has_room(at, self.spacing) {
                places.extend(self.place(at, *rank, mix(key, number as u64)));
            }
        }
        (has_spots, places)
    }

    /// The plant at a spot, if one grows there; the spot's key decides what is left to chance.
    fn place(&self, at: Vec2, rank: f32, spot: u64) -> Option<Place> {
        let Plan { area, map, ground, paths, variation, .. } = self.plan;
        if paths.iter().any(|path| path.beside(at) < variation.path_margin) {
            return None;
        }
        let (low, high) = area.bounds();
        let value = |map: &Option<GreyMap>| map.as_ref().map_or(1.0, |map| map.at((at - low) / (high - low)));
        let weight = |kind: &Kind| kind.share * value(&kind.map);
        let (all, weights): (f32, f32) = self
            .kinds
            .iter()
            .fold((0.0, 0.0), |(all, sum), (kind, _)| (all + kind.share, sum + weight(kind)));
        if rank >= self.kept * value(map) * weights / all {
            return None;
        }
        let mut left = Choice::PLANT.unit(spot) * weights;
        let is_it = |(kind, _): &&(&Kind, u32)| {
            left -= weight(kind);
            left < 0.0
        };
        let (kind, kind_number) = *self.kinds.iter().find(is_it).or(self.kinds.last())?;
        let variant = (Choice::VARIANT.key(spot) % u64::from(kind.variants.max(1))) as u32;
        Some(Place {
            kind: kind_number,
            variant,
            at: ground.point(at),
            rotation: self.rotation(spot, at),
            scale: 1.0 + variation.size * Choice::SIZE.signed(spot),
        })
    }

    /// How a plant is turned at a place.
    fn rotation(&self, spot: u64, at: Vec2) -> Quat {
        let Plan { ground, variation: Variation { lean, follows, .. }, .. } = self.plan;
        let upright = leaning(*lean, spot);
        if ground.is_level() {
            return upright.normalize();
        }
        let up = Vec3::Y.lerp(ground.normal(at, 0.5 * self.spacing), *follows).normalize_or(Vec3::Y);
        (Quat::from_rotation_arc(Vec3::Y, up) * upright).normalize()
    }
}

/// How a plant is turned at a spot of level ground, at most so many degrees from upright.
pub(super) fn leaning(most: f32, spot: u64) -> Quat {
    let (sin, cos) = (Choice::LEAN_SIDE.unit(spot) * TAU).sin_cos();
    let lean = Quat::from_axis_angle(Vec3::new(cos, 0.0, sin), (most * Choice::LEAN.unit(spot)).to_radians());
    lean * Quat::from_rotation_y(Choice::TURN.unit(spot) * TAU)
}

/// Where plants stand already, and which distances they keep.
pub(super) struct Occupied {
    plants: Vec<(Vec2, f32)>,
    widest: f32,
    index: Option<(Grid, Sorted)>,
}

impl Occupied {
    fn new(places: &[Place], plan: &Plan) -> Self {
        let plant =
            |place: &Place| (Vec2::new(place.at.x, place.at.z), plan.kinds[place.kind as usize].spacing);
        Self::of(places.iter().map(plant).collect(), plan.area.bounds())
    }

    /// Of plants and the distances that they keep, over an area of these bounds.
    pub(super) fn of(plants: Vec<(Vec2, f32)>, (low, high): (Vec2, Vec2)) -> Self {
        let widest = plants.iter().map(|(_, spacing)| *spacing).fold(0.0, f32::max);
        let index = (!plants.is_empty()).then(|| {
            let grid = Grid::new(flat(low), flat(high), widest);
            let cells: Vec<u32> =
                plants.iter().map(|(at, _)| grid.number(grid.place(flat(*at))) as u32).collect();
            let mut sorted = Sorted::default();
            sorted.sort(grid.len(), &cells);
            (grid, sorted)
        });
        Self { plants, widest, index }
    }

    /// Whether a plant that keeps this distance can stand there.
    pub(super) fn has_room(&self, at: Vec2, spacing: f32) -> bool {
        let Some((grid, sorted)) = &self.index else { return true };
        let (low, high) = grid.around(flat(at), 0.5 * (self.widest + spacing));
        (low.z..=high.z).all(|z| {
            let cell = |x: i32| grid.number(IVec3::new(x, 0, z));
            sorted.run(cell(low.x), cell(high.x)).iter().all(|&plant| {
                let (there, kept) = self.plants[plant as usize];
                there.distance(at) >= 0.5 * (kept + spacing)
            })
        })
    }
}

fn flat(p: Vec2) -> Vec3 {
    Vec3::new(p.x, 0.0, p.y)
}

#[cfg(test)]
#[path = "places_tests.rs"]
mod tests;
