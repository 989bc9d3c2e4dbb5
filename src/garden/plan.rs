//! A garden before anything grows: its ground, its beds and paths, what grows there, and what a plant at a place is like.
//!
//! Everything about a plant is a hash of the seed and its spot, so it does not change with what grows elsewhere, with the area or with the
//! number of threads.
//!
//! Source: 004 §3.3; turn, size, lean, the share of the slope that plants follow, beds and rows are ours.
//!
//! Limits: all plants of a kind keep one distance, whatever their sizes.

use super::area::{Area, Path};
use super::grey_map::GreyMap;
use super::ground::Ground;
use super::tiles::TileSet;
use super::walls::{BeforeWall, Wall};
use crate::budget::GardenBudget;
use crate::random::{Choice, mix};
use glam::{Quat, Vec2, Vec3};
use std::f32::consts::TAU;
use thiserror::Error;

/// Where the plants of a kind stand.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Stands {
    /// Spread by the tiles.
    #[default]
    Spread,
    /// In straight rows.
    Rows {
        /// From row to row, metres.
        apart: f32,
        /// How the rows are turned against the x axis, toward z, degrees.
        angle: f32,
    },
    /// Along lines: hedges, avenues.
    Along(Vec<Vec<Vec2>>),
    /// One by one.
    At(Vec<Vec2>),
    /// One by one before a wall, each an individual of its own that has grown there.
    Before(Vec<Vec2>),
}

/// A kind of plants, as far as it matters where they stand.
#[derive(Clone, Debug)]
pub struct Kind {
    /// Its part of the ground that it is spread over, above 0; those of all kinds there are weighed against each other.
    pub share: f32,
    /// The least distance between two of them, metres; in rows and along lines how far they are apart.
    pub spacing: f32,
    /// How many individuals there are of it to be copied.
    pub variants: u32,
    /// Where it grows how densely.
    pub map: Option<GreyMap>,
    /// The bed it grows in, an index into [`Plan::beds`]; none for the ground outside of all beds.
    pub bed: Option<usize>,
    /// Where they stand there.
    pub stands: Stands,
    /// What they climb on, an index into [`Plan::walls`].
    pub wall: Option<usize>,
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
    /// Where nothing grows but what is put there one by one.
    pub paths: Vec<Path>,
    /// What stands on the ground; nothing grows there but what is put there one by one.
    pub walls: Vec<Wall>,
    /// Ground that only the kinds of a bed are spread over.
    pub beds: Vec<Area>,
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

impl Place {
    /// Where a point of its model is, metres.
    pub fn point(&self, of_model: Vec3) -> Vec3 {
        self.at + self.rotation * of_model * self.scale
    }
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

    /// Whether what grows in a bed, or outside of all, can grow at a place; paths apart.
    pub(super) fn is_in_bed(&self, bed: Option<usize>, at: Vec2) -> bool {
        let is_in = |bed: &Area| bed.contains(at);
        self.area.contains(at)
            && bed.map_or_else(|| !self.beds.iter().any(is_in), |bed| self.beds.get(bed).is_some_and(is_in))
    }

    /// Smallest and largest corner of a bed, or of the garden.
    pub(super) fn bounds_of(&self, bed: Option<usize>) -> (Vec2, Vec2) {
        let (low, high) = self.area.bounds();
        let bed = bed.and_then(|bed| self.beds.get(bed)).map_or((low, high), Area::bounds);
        (bed.0.max(low), bed.1.min(high))
    }

    /// How large a bed is, or the ground outside of all.
    pub(super) fn square_metres_of(&self, bed: Option<usize>) -> f32 {
        let all: f32 = self.beds.iter().map(Area::square_metres).sum();
        let open = (self.area.square_metres() - all).max(0.0);
        bed.map_or(open, |bed| self.beds.get(bed).map_or(0.0, Area::square_metres))
    }

    /// Whether nothing grows at a place because of a path or a wall.
    pub(super) fn is_on_path(&self, at: Vec2) -> bool {
        let walls = self.walls.iter().filter_map(|wall| wall.line.as_ref());
        self.paths.iter().chain(walls).any(|path| path.beside(at) < self.variation.path_margin)
    }

    /// What a map over the garden says of a place, 1 without one.
    pub(super) fn value(&self, map: Option<&GreyMap>, at: Vec2) -> f32 {
        let (low, high) = self.area.bounds();
        map.map_or(1.0, |map| map.at((at - low) / (high - low)))
    }

    /// A plant of a kind at a place; the spot's key decides what is left to chance.
    pub(super) fn plant(&self, kind: u32, at: Vec2, spot: u64) -> Place {
        let Kind { variants, spacing, .. } = self.kinds[kind as usize];
        Place {
            kind,
            variant: (Choice::VARIANT.key(spot) % u64::from(variants.max(1))) as u32,
            at: self.ground.point(at),
            rotation: self.rotation(spot, at, spacing),
            scale: 1.0 + self.variation.size * Choice::SIZE.signed(spot),
        }
    }

    /// What the plants of a kind have beside them that climb on a wall.
    pub fn before_wall_of(&self, kind: usize) -> Option<BeforeWall> {
        let Kind { wall, stands: Stands::Before(feet), .. } = self.kinds.get(kind)? else { return None };
        let obstacles = self.walls.get((*wall)?)?.obstacles.clone();
        Some(BeforeWall { obstacles, feet: feet.iter().map(|at| self.ground.point(*at)).collect() })
    }

    /// A plant before a wall: as it grew there.
    pub(super) fn before_wall(&self, kind: u32, at: Vec2, variant: u32) -> Place {
        Place { kind, variant, at: self.ground.point(at), rotation: Quat::IDENTITY, scale: 1.0 }
    }

    /// The key of the spot of a plant that is put somewhere.
    pub(super) fn spot(&self, at: Vec2) -> u64 {
        spot(Choice::SPOT.key(self.seed), at)
    }

    /// How a plant is turned at a place.
    fn rotation(&self, spot: u64, at: Vec2, spacing: f32) -> Quat {
        let Variation { lean, follows, .. } = self.variation;
        let upright = leaning(lean, spot);
        if self.ground.is_level() {
            return upright.normalize();
        }
        let up = Vec3::Y.lerp(self.ground.normal(at, 0.5 * spacing), follows).normalize_or(Vec3::Y);
        (Quat::from_rotation_arc(Vec3::Y, up) * upright).normalize()
    }
}

/// The key of a spot by its place, not by its number among others.
pub(super) fn spot(key: u64, at: Vec2) -> u64 {
    let [x, z] = at.to_array().map(|metres| u64::from(metres.to_bits()));
    mix(mix(key, x), z)
}

/// How a plant is turned at a spot of level ground, at most so many degrees from upright.
pub(super) fn leaning(most: f32, spot: u64) -> Quat {
    let (sin, cos) = (Choice::LEAN_SIDE.unit(spot) * TAU).sin_cos();
    let lean = Quat::from_axis_angle(Vec3::new(cos, 0.0, sin), (most * Choice::LEAN.unit(spot)).to_radians());
    lean * Quat::from_rotation_y(Choice::TURN.unit(spot) * TAU)
}
