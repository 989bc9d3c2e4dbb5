//! A garden as the artist paints it on the ground: from strokes to places, and the ground under them.
//!
//! Strokes lie over each other in their order. At a point the plants of a kind are as dense as the densest of its strokes there, until a
//! stroke clears them; paths keep everything off. Each kind has two lattices of tiles of its own, one in which every plant has room and one
//! for what stands more densely, and takes the spots whose rank is below the density there: more pressure adds plants and moves none.
//! Kinds come from the widest to the narrowest, and a spot stays free where plants that are there need the room. A tap is one plant in that
//! very place.
//!
//! Plants are known by their kind's name and their spot, so they stay when other strokes come and go.
//!
//! Source: places after 004 §3.3; painting is ours. Limits: the ground is level; plants keep from each other by their mean width, whatever
//! size each has.

use super::ground::Ground;
use super::occupied::Occupied;
use super::plan::{Place, leaning, spot};
use super::spec::Cover;
use super::surface::{Layer, Terrain};
use super::tiles::{Spot, TileSet};
use crate::budget::GardenBudget;
use crate::checksum::fnv1a;
use crate::geom::convex_hull::convex_hull;
use crate::geom::polyline;
use crate::geom::region::Region;
use crate::model::Mesh;
use crate::plant::Material;
use crate::random::{Choice, mix};
use crate::sketch::{GardenPlant, GardenPoint, GardenStroke, GardenTool, StrokePoint};
use glam::{Vec2, Vec3};
use rayon::prelude::*;
use std::f32::consts::TAU;
use std::sync::{Arc, LazyLock};

crate::parameters! {
    /// The garden that is painted around a plant.
    pub struct GardenParams {
        /// Most triangles of a plant, about; fewer where all of them would be too many.
        triangles: u32 = 16_000, 100..=1_000_000, "";
        /// Individuals of each species, of which its plants are copies.
        variants: u32 = 3, 1..=16, "";
        /// By how much a plant is larger or smaller than its model, at most.
        size: f32 = 0.15, 0.0..=0.9, "of its size";
        /// How far a plant leans, at most.
        lean: f32 = 4.0, 0.0..=45.0, "degrees";
        /// Ground beside paths on which nothing stands, from the path's edge.
        path_margin: f32 = 0.1, 0.0..=10.0, "metres";
        /// Ground around all that is painted.
        margin: f32 = 0.8, 0.05..=100.0, "metres";
        choices:
        /// What the ground is covered with.
        cover: Cover = Cover::Lawn;
    }
}

/// The densest that plants stand: density and pressure together make no more of them, in shares of what has room for each.
const DENSEST: f32 = 5.0;
/// Share of their width that neighbours are apart where each just has room: leaves of neighbours meet.
const APART: f32 = 0.8;
/// Of the distance that plants of different kinds would keep among their own, the share that they keep from each other.
const MIXED: f32 = 0.6;
/// Densities of the lattices of a kind: one in which each plant has room, and one for what stands more densely.
const LAYERS: [(f32, f32); 2] = [(0.0, 1.0), (1.0, DENSEST)];
/// Of the distance that plants would keep at a density, twice the share that those of the denser lattice keep from the others.
const CROWDED: f32 = 1.1;
/// Plants of beds that are sparser keep no more room free around them.
const SPARSEST: f32 = 0.1;
/// Strokes shorter than this share of their radius are taps.
const TAP: f32 = 0.3;
/// Least width of a plant, metres: of what is narrower more stand in a bed than anybody looks at.
const NARROWEST: f32 = 0.04;
/// Sides of a disc in the hull of the ground.
const HULL_SIDES: u8 = 12;

/// The tiles of all painted gardens.
static TILES: LazyLock<TileSet> = LazyLock::new(|| TileSet::new(3, 1));

/// What grows in a bed.
#[derive(Clone, Debug, PartialEq)]
pub struct PaintedKind {
    /// What grows there.
    pub plant: GardenPlant,
    /// How wide a plant is, metres.
    pub width: f32,
    /// How many individuals there are; where there are none, nothing grows.
    pub variants: u32,
}

/// What stands there before the garden is laid out: where, and the room that it needs, metres.
pub type Placed = (Vec2, f32);

/// The kinds that strokes plant, in the order in which they came.
pub fn kinds(strokes: &[Arc<GardenStroke>]) -> Vec<&GardenPlant> {
    let mut kinds = Vec::new();
    for stroke in strokes {
        if let GardenTool::Plants(plant) = &stroke.tool
            && !kinds.contains(&plant)
        {
            kinds.push(plant);
        }
    }
    kinds
}

/// The stroke that is seen at a point of the ground: the last one there, unless a later one cleared it.
pub fn stroke_at(strokes: &[Arc<GardenStroke>], p: Vec2) -> Option<usize> {
    let last = strokes.iter().rposition(|stroke| Bed::new(stroke).outside(p) <= 0.0)?;
    (strokes[last].tool != GardenTool::Clear).then_some(last)
}

/// The places of all plants, and whether there are as many as were painted: a garden has no more than it may.
pub fn places(
    strokes: &[Arc<GardenStroke>],
    kinds: &[PaintedKind],
    (placed, params): (&[Placed], &GardenParams),
    seed: u64,
) -> (Vec<Place>, bool) {
    let beds = Beds::new(strokes);
    let Some(bounds) = beds.bounds() else { return (Vec::new(), true) };
    let mut plants: Vec<Placed> = placed.to_vec();
    let mut places = Vec::new();
    let layout = Layout { beds: &beds, params, seed };
    let growing = || kinds.iter().enumerate().filter(|(_, kind)| kind.variants > 0);
    for (number, kind) in growing() {
        let found = layout.single_plants(number as u32, kind);
        plants.extend(found.iter().map(|place| (flat(place), MIXED * kind.apart())));
        places.extend(found);
    }
    let mut by_width: Vec<usize> = growing().map(|(number, _)| number).collect();
    by_width.sort_by(|a, b| kinds[*b].width.total_cmp(&kinds[*a].width));
    let mut are_all = true;
    for number in by_width {
        let kind = &kinds[number];
        let occupied = Occupied::of(plants.clone(), bounds);
        let (mut found, is_whole) = layout.bed_plants(number as u32, kind, &occupied);
        let room = GardenBudget::PAINTED_PLACES.saturating_sub(places.len());
        are_all &= is_whole && found.len() <= room;
        found.truncate(room);
        plants.extend(found.iter().map(|(place, apart)| (flat(place), MIXED * apart)));
        places.extend(found.into_iter().map(|(place, _)| place));
    }
    (places, are_all)
}

fn flat(place: &Place) -> Vec2 {
    Vec2::new(place.at.x, place.at.z)
}

impl PaintedKind {
    /// The distance of neighbours where each just has room.
    fn apart(&self) -> f32 {
        APART * self.width.max(NARROWEST)
    }

    /// What this kind leaves to chance.
    fn key(&self, seed: u64) -> u64 {
        let name = match &self.plant {
            GardenPlant::Drawn => String::new(),
            GardenPlant::Species { name, age: None } => name.clone(),
            GardenPlant::Species { name, age: Some(age) } => format!("{name} {age}"),
            GardenPlant::Drawing(drawing) => format!("drawing {}", drawing.name()),
        };
        mix(Choice::LAYER.key(seed), u64::from(fnv1a(&name)))
    }
}

/// Strokes with their lines and boxes at hand.
struct Beds<'a> {
    strokes: Vec<Bed<'a>>,
}

struct Bed<'a> {
    stroke: &'a GardenStroke,
    line: Vec<Vec2>,
    /// Length of the line up to each of its points.
    arcs: Vec<f32>,
    /// Its box with all that it reaches.
    low: Vec2,
    high: Vec2,
}

impl<'a> Bed<'a> {
    fn new(stroke: &'a GardenStroke) -> Self {
        let line: Vec<Vec2> = stroke.points.iter().map(|point| point.at).collect();
        let (low, high) = polyline::bounds(line.iter().copied());
        let arcs = polyline::arc_lengths(line.iter().copied());
        Self { stroke, line, arcs, low: low - stroke.radius, high: high + stroke.radius }
    }

    fn meets(&self, low: Vec2, high: Vec2) -> bool {
        self.low.cmple(high).all() && self.high.cmpge(low).all()
    }

    /// How far a point is outside of it, metres; negative inside.
    fn outside(&self, p: Vec2) -> f32 {
        polyline::nearest(&self.line, p).map_or(f32::INFINITY, |(away, _)| away) - self.stroke.radius
    }

    /// How densely it plants around a point, where 1 has room for each; 0 outside of it.
    fn density(&self, p: Vec2) -> f32 {
        let inside = polyline::nearest(&self.line, p).filter(|(away, _)| *away < self.stroke.radius);
        let Some((_, arc)) = inside else { return 0.0 };
        let pressure = |at: usize| self.stroke.points[at].pressure;
        let pressed = match self.line.len() {
            1 => pressure(0),
            _ => {
                let (at, share) = polyline::locate(&self.arcs, arc);
                pressure(at) + (pressure(at + 1) - pressure(at)) * share
            }
        };
        (self.stroke.density * pressed / StrokePoint::NEUTRAL_PRESSURE).min(DENSEST)
    }

    /// Whether it is a tap, which plants one.
    fn is_tap(&self) -> bool {
        self.arcs.last().is_none_or(|length| *length <= TAP * self.stroke.radius)
    }

    fn plants(&self, plant: &GardenPlant) -> bool {
        matches!(&self.stroke.tool, GardenTool::Plants(known) if known == plant)
    }
}

impl<'a> Beds<'a> {
    fn new(strokes: &'a [Arc<GardenStroke>]) -> Self {
        Self { strokes: strokes.iter().map(|stroke| Bed::new(stroke)).collect() }
    }

    /// The box of all of them.
    fn bounds(&self) -> Option<(Vec2, Vec2)> {
        let mut boxes = self.strokes.iter().map(|bed| (bed.low, bed.high));
        let first = boxes.next()?;
        Some(boxes.fold(first, |(low, high), (l, h)| (low.min(l), high.max(h))))
    }

    /// How many tiles may be looked through for a kind: every spot is held against the pieces of all strokes near it.
    fn most_tiles(&self) -> usize {
        let spots = (TILES.density() * TILES.side() * TILES.side()) as usize;
        GardenBudget::PAINTED_TILES.min(GardenBudget::PAINTED_EFFORT / (spots * self.pieces()).max(1))
    }

    /// How many tiles of the box around its beds may be looked at for a kind.
    fn widest_box(&self) -> usize {
        GardenBudget::PAINTED_BOX.min(GardenBudget::PAINTED_EFFORT / self.pieces().max(1))
    }

    fn pieces(&self) -> usize {
        self.strokes.iter().map(|bed| bed.line.len()).sum()
    }

    /// How far a point is from the nearest path, as far as that was not cleared, metres; negative on it.
    fn beside_paths(&self, p: Vec2) -> f32 {
        self.strokes.iter().fold(f32::INFINITY, |beside, bed| match bed.stroke.tool {
            GardenTool::Path => beside.min(bed.outside(p)),
            GardenTool::Clear => beside.max(-bed.outside(p)),
            GardenTool::Plants(_) => beside,
        })
    }

    /// The same of beds.
    fn outside_beds(&self, p: Vec2) -> f32 {
        self.strokes.iter().fold(f32::INFINITY, |outside, bed| match bed.stroke.tool {
            GardenTool::Plants(_) if !bed.is_tap() => outside.min(bed.outside(p)),
            GardenTool::Clear => outside.max(-bed.outside(p)),
            GardenTool::Plants(_) | GardenTool::Path => outside,
        })
    }

    /// The convex hull of all that is painted, even if it was cleared, and of what stands there.
    fn hull(&self, placed: &[Placed]) -> Vec<Vec2> {
        let painted = self.strokes.iter().filter(|bed| bed.stroke.tool != GardenTool::Clear);
        let discs = painted.flat_map(|bed| bed.line.iter().map(|at| (*at, bed.stroke.radius)));
        let side = |k: u8| Vec2::from_angle(TAU * f32::from(k) / f32::from(HULL_SIDES));
        let around = |(at, radius): Placed| (0..HULL_SIDES).map(move |k| at + radius * side(k));
        let points: Vec<Vec2> = discs.chain(placed.iter().copied()).flat_map(around).collect();
        convex_hull(&points, |point| *point)
    }
}

/// What all kinds have in common.
struct Layout<'a> {
    beds: &'a Beds<'a>,
    params: &'a GardenParams,
    seed: u64,
}

impl Layout<'_> {
    /// The plants that were tapped, as far as they were not cleared.
    fn single_plants(&self, number: u32, kind: &PaintedKind) -> Vec<Place> {
        let strokes = self.beds.strokes.iter().enumerate();
        let taps = strokes.filter(|(_, bed)| bed.plants(&kind.plant) && bed.is_tap());
        let place = |(order, bed): (usize, &Bed<'_>)| {
            let at = bed.line[0];
            let clears = |bed: &Bed<'_>| bed.stroke.tool == GardenTool::Clear && bed.outside(at) < 0.0;
            let is_cleared = self.beds.strokes[order + 1..].iter().any(clears);
            (!is_cleared).then(|| self.place(number, kind, at, spot(kind.key(self.seed), at)))
        };
        taps.filter_map(place).collect()
    }

    /// The plants of a kind's beds, each with the distance that it keeps; and whether all of the beds were looked through.
    fn bed_plants(&self, number: u32, kind: &PaintedKind, occupied: &Occupied) -> (Vec<(Place, f32)>, bool) {
        let mut own = self.beds.strokes.iter().filter(|bed| bed.plants(&kind.plant) && !bed.is_tap());
        let Some(first) = own.next().map(|bed| (bed.low, bed.high)) else { return (Vec::new(), true) };
        let bounds = own.fold(first, |(low, high), bed| (low.min(bed.low), high.max(bed.high)));
        let (mut plants, mut are_all) = (Vec::<(Place, f32)>::new(), true);
        for (layer, densities) in (0..).zip(LAYERS) {
            let own = Occupied::of(plants.iter().map(|(place, _)| (flat(place), 0.0)).collect(), bounds);
            let seed = mix(kind.key(self.seed), layer);
            let lattice = Lattice { layout: self, number, kind, densities, seed };
            let (tiles, is_whole) = lattice.tiles(bounds, self.beds.most_tiles());
            let of_tile = |tile: &[i64; 2]| lattice.plants_of(*tile, (occupied, &own));
            let found: Vec<(Place, f32)> = tiles.par_iter().flat_map_iter(of_tile).collect();
            plants.extend(found);
            are_all &= is_whole;
        }
        (plants, are_all)
    }

    fn place(&self, number: u32, kind: &PaintedKind, at: Vec2, spot: u64) -> Place {
        Place {
            kind: number,
            variant: (Choice::VARIANT.key(spot) % u64::from(kind.variants)) as u32,
            at: Vec3::new(at.x, 0.0, at.y),
            rotation: leaning(self.params.lean, spot).normalize(),
            scale: 1.0 + self.params.size * Choice::SIZE.signed(spot),
        }
    }
}

/// Spots for one kind.
struct Lattice<'a> {
    layout: &'a Layout<'a>,
    number: u32,
    kind: &'a PaintedKind,
    /// Where beds are as dense as the first or less it is empty, where they are as dense as the second it is full.
    densities: (f32, f32),
    seed: u64,
}

impl Lattice<'_> {
    /// Least distance of its spots, metres.
    fn spacing(&self) -> f32 {
        let (from, to) = self.densities;
        self.kind.apart() * (TILES.density() / (to - from)).sqrt()
    }

    fn side(&self) -> f32 {
        TILES.side() * self.spacing()
    }

    /// The tiles over a box in which a stroke plants, row by row, of so many at most; and whether these are all.
    fn tiles(&self, (low, high): (Vec2, Vec2), most: usize) -> (Vec<[i64; 2]>, bool) {
        let tile = |along: f32| (along / self.side()).floor() as i64;
        let ([west, north], [east, south]) = (low.to_array().map(tile), high.to_array().map(tile));
        let all = (north..=south).flat_map(|j| (west..=east).map(move |i| [i, j]));
        let count = (south - north + 1).saturating_mul(east - west + 1);
        let strokes = &self.layout.beds.strokes;
        let has_bed = |tile: &[i64; 2]| {
            let (low, high) = self.bounds(*tile);
            let is_near = |bed: &Bed<'_>| bed.outside(low.midpoint(high)) <= low.distance(high) / 2.0;
            strokes.iter().any(|bed| bed.plants(&self.kind.plant) && bed.meets(low, high) && is_near(bed))
        };
        let widest = self.layout.beds.widest_box();
        let mut found: Vec<[i64; 2]> = all.take(widest).filter(has_bed).take(most + 1).collect();
        let are_all = found.len() <= most && count <= widest as i64;
        found.truncate(most);
        (found, are_all)
    }

    fn bounds(&self, tile: [i64; 2]) -> (Vec2, Vec2) {
        let low = Vec2::from(tile.map(|k| (k as f64 * f64::from(self.side())) as f32));
        (low, low + self.side())
    }

    /// The plants of a tile with the distances that they keep, where neither other kinds nor its own need the room.
    fn plants_of(&self, tile: [i64; 2], (others, own): (&Occupied, &Occupied)) -> Vec<(Place, f32)> {
        let Layout { beds, params, .. } = self.layout;
        let (low, high) = self.bounds(tile);
        let near: Vec<&Bed<'_>> = beds.strokes.iter().filter(|bed| bed.meets(low, high)).collect();
        let key = mix(mix(Choice::SPOT.key(self.seed), tile[0] as u64), tile[1] as u64);
        let (from, to) = self.densities;
        let plant = |(number, Spot { at, rank }): (usize, &Spot)| {
            let at = low + *at * self.spacing();
            let density = self.density(&near, at);
            if *rank >= (density - from) / (to - from) || beds.beside_paths(at) < params.path_margin {
                return None;
            }
            let apart = self.kind.apart() / density.max(SPARSEST).sqrt();
            let has_room = others.has_room(at, MIXED * apart) && own.has_room(at, CROWDED * apart);
            has_room.then(|| (self.layout.place(self.number, self.kind, at, mix(key, number as u64)), apart))
        };
        TILES.at(self.seed, tile).iter().enumerate().filter_map(plant).collect()
    }

    /// How densely this kind stands at a point among these strokes.
    fn density(&self, strokes: &[&Bed<'_>], p: Vec2) -> f32 {
        strokes.iter().fold(0.0, |density: f32, bed| match bed.stroke.tool {
            GardenTool::Clear if bed.outside(p) < 0.0 => 0.0,
            GardenTool::Plants(_) if bed.plants(&self.kind.plant) && !bed.is_tap() => {
                density.max(bed.density(p))
            }
            _ => density,
        })
    }
}

/// The ground of a painted garden and its materials: the convex hull of all that is painted or stands there, with a margin. None without
/// cover, or without strokes.
pub fn ground(
    strokes: &[Arc<GardenStroke>],
    (placed, params): (&[Placed], &GardenParams),
) -> Option<(Mesh, Vec<Material>)> {
    let beds = Beds::new(strokes);
    let hull = Region::new(beds.hull(placed));
    let (low, high) = hull.bounds()?;
    let depth = |p: Vec2| {
        let away = hull.nearest_boundary(p).map_or(f32::INFINITY, |(_, away)| away);
        params.margin + if hull.contains(p) { away } else { -away }
    };
    let (outside_beds, beside_paths) = (|p: Vec2| beds.outside_beds(p), |p: Vec2| beds.beside_paths(p));
    let soil = (params.cover == Cover::Lawn).then(|| Layer::soil(&outside_beds));
    let layers = soil.into_iter().chain([Layer::gravel(&beside_paths)]).collect();
    let bounds = (low - params.margin, high + params.margin);
    let (heights, cells) = (&Ground::default(), GardenBudget::PAINTED_CELLS);
    Terrain { bounds, depth: Some(&depth), heights, cells, layers }.slab(params.cover)
}

/// The samples of a stroke that matter: what is left out lies nearer to the line than a share of the stroke's radius, and is
/// pressed about as hard.
pub fn simplified(points: &[GardenPoint], radius: f32) -> Vec<GardenPoint> {
    let (mut kept, step) = (Vec::<GardenPoint>::new(), 0.15 * radius);
    for (n, point) in points.iter().enumerate() {
        let is_last = n + 1 == points.len();
        let is_far = kept.last().is_none_or(|last| {
            last.at.distance(point.at) >= step || (last.pressure - point.pressure).abs() > 0.1
        });
        if is_far || (is_last && kept.last().is_some_and(|last| last.at != point.at)) {
            kept.push(*point);
        }
    }
    kept
}

#[cfg(test)]
#[path = "painted_tests.rs"]
mod tests;
