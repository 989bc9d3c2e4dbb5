//! Corner-coloured Poisson-disk tiles: squares of points that fit each other wherever their corners have the same colours.
//!
//! Every corner of a square lattice has one of C colours; a tile is chosen by the colours of its four corners, so there are
//! C⁴ tiles, and a tile of the infinite lattice is found without looking at its neighbours. A tile has three zones, filled in
//! this order by dart throwing, each with everything before it in the way:
//!
//! 1. discs around the corners, one set of points per colour, shared by all tiles with such a corner;
//! 2. bands along the edges, one set per pair of colours and direction, shared by both tiles at the edge;
//! 3. the inside, one set per tile.
//!
//! With r the distance that darts begin with, a disc reaches 2 r and a band r. So points of the bands at one corner are at
//! least √2 (√3 − 1) r > r apart, and points inside are more than r from every edge: points of two tiles can be near each
//! other only in what the tiles share, and the least distance holds across every seam by construction.
//!
//! Darts are thrown until so many in a row find no room, then the distance shrinks and they are thrown again (relaxation, McCool
//! and Fiume 1992). The last distance is what holds for all; tiles are given in units of it.
//!
//! Points have ranks from 0 to 1, by which every density below the full one keeps some: the points of a zone get them one by one,
//! always the one farthest from those that have lower ranks in it and in the zones before it. So every prefix is well
//! spread, across seams too.
//!
//! Source: 004 §3.3, which names Lagae and Dutré's method and gives no numbers. Limits: the mean density differs from tile to tile by some
//! parts of a hundred; with one colour all tiles are the same.

use crate::random::{Choice, mix, stream};
use glam::Vec2;
use rand::{Rng, RngExt};
use rayon::prelude::*;

/// Side of a tile; this and the next two in units of the distance that darts begin with.
const SIDE: f32 = 12.0;
/// Radius of the discs around corners.
const DISC: f32 = 2.0;
/// Reach of the bands to either side of edges.
const BAND: f32 = 1.0;
/// Darts without room in a row after which the distance shrinks, and after which a zone is full at the least distance.
const TRIES: [usize; 2] = [400, 10_000];
/// What the distance becomes then, as a share of what it was.
const SHRINK: f32 = 0.99;
/// The least distance, in units of the one that darts begin with.
const LEAST: f32 = 0.75;
/// The unit of finished tiles: a little less, so that rounding brings no two plants of a large garden nearer than it.
const UNIT: f32 = LEAST * 0.9999;
/// Colours of corners that tiles usually have.
pub const COLOURS: u32 = 3;
/// Most colours: their tiles are made within seconds.
pub const MOST_COLOURS: u32 = 5;

/// A point of a tile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// Its place from the tile's lower left corner, in units of the least distance.
    pub at: Vec2,
    /// Where it stands among all, from 0 to 1: densities above this, as shares of the full one, keep it.
    pub rank: f32,
}

/// All tiles of some colours.
#[derive(Clone, Debug)]
pub struct TileSet {
    colours: u32,
    /// Spots of each tile, by rising rank. Tiles are numbered by the colours of their corners as digits.
    tiles: Vec<Vec<Spot>>,
}

impl TileSet {
    /// Makes the tiles of 1 to [`MOST_COLOURS`] colours; other numbers count as the nearest of these. The same number gives the
    /// same tiles on any number of threads.
    pub fn new(colours: u32, number: u64) -> Self {
        let colours = colours.clamp(1, MOST_COLOURS);
        let discs: Vec<Zone> = (0..colours).map(|colour| disc(number, colour)).collect();
        let pairs: Vec<[u32; 2]> = (0..colours * colours).map(|k| [k / colours, k % colours]).collect();
        let bands = |across: bool| -> Vec<Zone> {
            pairs.par_iter().map(|pair| band(number, *pair, across, &discs)).collect()
        };
        let zones = Zones { colours, discs: &discs, across: &bands(true), along: &bands(false) };
        let tiles = (0..colours.pow(4)).into_par_iter().map(|tile| zones.tile(number, tile)).collect();
        Self { colours, tiles }
    }

    /// Side of a tile, in units of the least distance.
    pub fn side(&self) -> f32 {
        SIDE / UNIT
    }

    /// The least distance as a share of the one that darts began with.
    pub fn relaxed_to(&self) -> f32 {
        LEAST
    }

    /// How many tiles there are.
    pub fn len(&self) -> usize {
        self.tiles.len()
    }

    /// Whether there is no tile; there always is.
    pub fn is_empty(&self) -> bool {
        self.tiles.is_empty()
    }

    /// Spots in a square of the least distance, of all tiles on average.
    pub fn density(&self) -> f32 {
        let spots: usize = self.tiles.iter().map(Vec::len).sum();
        spots as f32 / (self.tiles.len() as f32 * self.side() * self.side())
    }

    /// The least distance as a share of the one that the densest packing of as many points has (Lagae and Dutré 2008): for
    /// a hexagonal lattice 1.
    pub fn relative_radius(&self) -> f32 {
        (self.density() * 3f32.sqrt() / 2.0).sqrt()
    }

    /// The number of the tile at a place of the lattice that a seed decides.
    pub fn number_at(&self, seed: u64, [i, j]: [i64; 2]) -> usize {
        let colour = |i: i64, j: i64| {
            let corner = mix(mix(Choice::CORNER_COLOUR.key(seed), i as u64), j as u64);
            (corner % u64::from(self.colours)) as usize
        };
        let digits = [colour(i, j), colour(i + 1, j), colour(i, j + 1), colour(i + 1, j + 1)];
        digits.into_iter().fold(0, |number, digit| number * self.colours as usize + digit)
    }

    /// The spots of the tile at a place of the lattice, by rising rank.
    pub fn at(&self, seed: u64, place: [i64; 2]) -> &[Spot] {
        &self.tiles[self.number_at(seed, place)]
    }
}

/// Points of a zone with their ranks, in units of the distance that darts begin with.
type Zone = Vec<Spot>;

/// What several tiles share.
struct Zones<'a> {
    colours: u32,
    /// By colour, around the origin.
    discs: &'a [Zone],
    /// By pair of colours, from the origin to the right.
    across: &'a [Zone],
    /// The same upward.
    along: &'a [Zone],
}

impl Zones<'_> {
    /// A tile by its number: its inside and what it has of the zones around.
    fn tile(&self, number: u64, tile: u32) -> Vec<Spot> {
        let c = self.colours;
        let [a, b, d, e] = [tile / (c * c * c), tile / (c * c) % c, tile / c % c, tile % c];
        let band = |bands: &[Zone], from: u32, to: u32, x: f32, y: f32| {
            moved(&bands[(from * c + to) as usize], x, y)
        };
        let around = [
            moved(&self.discs[a as usize], 0.0, 0.0),
            moved(&self.discs[b as usize], SIDE, 0.0),
            moved(&self.discs[d as usize], 0.0, SIDE),
            moved(&self.discs[e as usize], SIDE, SIDE),
            band(self.across, a, b, 0.0, 0.0),
            band(self.across, d, e, 0.0, SIDE),
            band(self.along, a, d, 0.0, 0.0),
            band(self.along, b, e, SIDE, 0.0),
        ];
        let around: Vec<Spot> = around.concat();
        let corners = [Vec2::ZERO, Vec2::new(SIDE, 0.0), Vec2::new(0.0, SIDE), Vec2::splat(SIDE)];
        let (low, high) = (Vec2::splat(BAND), Vec2::splat(SIDE - BAND));
        let is_inside = |p: Vec2| corners.iter().all(|corner| corner.distance_squared(p) > DISC * DISC);
        let mut rng = stream(number, "garden tile", u64::from(tile));
        let inside = filled((low, high), is_inside, &around, &mut rng);
        let is_own = |spot: &Spot| (0.0..SIDE).contains(&spot.at.x) && (0.0..SIDE).contains(&spot.at.y);
        let mut own: Vec<Spot> = around.into_iter().chain(inside).filter(is_own).collect();
        own.iter_mut().for_each(|spot| spot.at /= UNIT);
        own.sort_by(|a, b| a.rank.total_cmp(&b.rank));
        own
    }
}

fn moved(zone: &[Spot], x: f32, y: f32) -> Zone {
    zone.iter().map(|spot| Spot { at: spot.at + Vec2::new(x, y), ..*spot }).collect()
}

/// The disc around a corner of a colour.
fn disc(number: u64, colour: u32) -> Zone {
    let mut rng = stream(number, "garden corner", u64::from(colour));
    let reach = Vec2::splat(DISC);
    filled((-reach, reach), |p| p.length_squared() <= DISC * DISC, &[], &mut rng)
}

/// The band along an edge between corners of these colours, from the origin to the right (`across`) or upward.
fn band(number: u64, [from, to]: [u32; 2], across: bool, discs: &[Zone]) -> Zone {
    let purpose = if across { "garden edge across" } else { "garden edge along" };
    let mut rng = stream(number, purpose, mix(u64::from(from), u64::from(to)));
    let (end, reach) = if across {
        (Vec2::new(SIDE, 0.0), Vec2::new(0.0, BAND))
    } else {
        (Vec2::new(0.0, SIDE), Vec2::new(BAND, 0.0))
    };
    let ends = [discs[from as usize].clone(), moved(&discs[to as usize], end.x, end.y)].concat();
    let is_inside = |p: Vec2| p.length_squared() > DISC * DISC && p.distance_squared(end) > DISC * DISC;
    filled((-reach, end + reach), is_inside, &ends, &mut rng)
}

/// Points of a zone within a box, not too near to those that are there, with ranks among them.
fn filled(
    (low, high): (Vec2, Vec2),
    is_inside: impl Fn(Vec2) -> bool,
    there: &[Spot],
    rng: &mut impl Rng,
) -> Zone {
    let mut points: Vec<Vec2> = Vec::new();
    let mut radius = 1.0;
    loop {
        let tries = if radius > LEAST { TRIES[0] } else { TRIES[1] };
        let mut misses = 0;
        while misses < tries {
            let dart = low + (high - low) * Vec2::new(rng.random(), rng.random());
            if !is_inside(dart) {
                continue;
            }
            let is_free = |p: &Vec2| p.distance_squared(dart) >= radius * radius;
            if points.iter().all(is_free) && there.iter().all(|spot| is_free(&spot.at)) {
                points.push(dart);
                misses = 0;
            } else {
                misses += 1;
            }
        }
        if radius <= LEAST {
            break;
        }
        radius = (radius * SHRINK).max(LEAST);
    }
    ranked(&points, there, rng.random())
}

/// Gives points their ranks, evenly from `first` steps on: each time to the one that is farthest from all that have lower ones.
fn ranked(points: &[Vec2], there: &[Spot], first: f32) -> Zone {
    let mut before: Vec<Spot> = there.to_vec();
    before.sort_by(|a, b| b.rank.total_cmp(&a.rank));
    let mut left: Vec<(Vec2, f32)> = points.iter().map(|p| (*p, f32::INFINITY)).collect();
    let mut zone = Vec::with_capacity(points.len());
    let near = |left: &mut Vec<(Vec2, f32)>, to: Vec2| {
        left.iter_mut().for_each(|(p, gap)| *gap = gap.min(p.distance_squared(to)));
    };
    for step in 0..points.len() {
        let rank = (step as f32 + first) / points.len() as f32;
        while let Some(spot) = before.pop_if(|spot| spot.rank < rank) {
            near(&mut left, spot.at);
        }
        let farthest = (0..left.len()).max_by(|a, b| left[*a].1.total_cmp(&left[*b].1).then(b.cmp(a)));
        let Some(farthest) = farthest else { break };
        let (at, _) = left.swap_remove(farthest);
        near(&mut left, at);
        zone.push(Spot { at, rank });
    }
    zone
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;
    use std::sync::LazyLock;

    static TILES: LazyLock<TileSet> = LazyLock::new(|| TileSet::new(3, 1));

    /// All spots of a square of tiles whose ranks are below a density.
    fn spots(tiles: &TileSet, seed: u64, count: i64, density: f32) -> Vec<Vec2> {
        let places = (0..count).flat_map(|j| (0..count).map(move |i| [i, j]));
        let of = |[i, j]: [i64; 2]| {
            let corner = Vec2::new(i as f32, j as f32) * tiles.side();
            let kept = tiles.at(seed, [i, j]).iter().filter(move |spot| spot.rank < density);
            kept.map(move |spot| spot.at + corner)
        };
        places.flat_map(of).collect()
    }

    /// Power by rings of equal width up to twice the square root of the density, and its anisotropy in decibels (Lagae and
    /// Dutré 2008): means over periodograms of ten squares of three by three tiles.
    fn spectrum(tiles: &TileSet, rings: usize) -> Vec<(f64, f64)> {
        const SQUARES: u64 = 10;
        const TILES: i64 = 3;
        let side = tiles.side() * TILES as f32;
        let most = 2.0 * tiles.density().sqrt() * side;
        let reach = most.ceil() as i32;
        let all = (-reach..=reach).flat_map(|x| (0..=reach).map(move |y| (x, y)));
        let waves: Vec<(i32, i32)> =
            all.filter(|&(x, y)| (y > 0 || x > 0) && ((x * x + y * y) as f32) < most * most).collect();
        let squares: Vec<Vec<Vec2>> = (0..SQUARES).map(|seed| spots(tiles, 100 + seed, TILES, 1.0)).collect();
        let power = |&(x, y): &(i32, i32)| {
            let wave = Vec2::new(x as f32, y as f32) * (std::f32::consts::TAU / side);
            let of = |spots: &Vec<Vec2>| {
                let sum = spots.iter().map(|spot| Vec2::from_angle(wave.dot(*spot))).sum::<Vec2>();
                f64::from(sum.length_squared()) / spots.len() as f64
            };
            squares.iter().map(of).sum::<f64>() / SQUARES as f64
        };
        let powers: Vec<f64> = waves.par_iter().map(power).collect();
        let mut by_ring = vec![Vec::new(); rings];
        for (&(x, y), power) in waves.iter().zip(powers) {
            by_ring[(((x * x + y * y) as f32).sqrt() / most * rings as f32) as usize].push(power);
        }
        let of_ring = |powers: &Vec<f64>| {
            let mean = powers.iter().sum::<f64>() / powers.len() as f64;
            let variance =
                powers.iter().map(|power| (power - mean).powi(2)).sum::<f64>() / (powers.len() - 1) as f64;
            (mean, 10.0 * (variance / (mean * mean)).log10())
        };
        by_ring.iter().map(of_ring).collect()
    }

    #[test]
    fn there_is_a_tile_for_all_colours_of_four_corners() {
        let tiles = &*TILES;
        assert_eq!((tiles.len(), TileSet::new(1, 1).len(), TileSet::new(0, 1).len()), (81, 1, 1));
        assert!(!tiles.is_empty() && (tiles.relaxed_to() - 0.75).abs() < 1e-6);
        assert!((0.70..1.0).contains(&tiles.relative_radius()), "{}", tiles.relative_radius());
    }

    #[test]
    fn spots_keep_their_distance_across_every_seam() {
        for colours in 1..=3 {
            let tiles = TileSet::new(colours, 7);
            let mut spots = spots(&tiles, 2, 12, 1.0);
            spots.sort_by(|a, b| a.x.total_cmp(&b.x));
            let mut least = f32::INFINITY;
            for (i, spot) in spots.iter().enumerate() {
                let near = spots[i + 1..].iter().take_while(|other| other.x - spot.x < 1.1);
                least = near.map(|other| other.distance(*spot)).fold(least, f32::min);
            }
            assert!((1.0..1.01).contains(&least), "{colours}: {least}");
        }
    }

    #[test]
    fn tiles_are_the_same_on_any_number_of_threads() {
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| TileSet::new(2, 5)).tiles
        };
        assert_eq!(on(1), on(2));
        assert_ne!(on(1), TileSet::new(2, 6).tiles);
    }

    #[test]
    fn low_frequencies_are_weak_and_no_direction_stands_out() {
        let tiles = &*TILES;
        let rings = spectrum(tiles, 30);
        let mean = rings.iter().skip(20).map(|ring| ring.0).sum::<f64>() / 10.0;
        let peak = (0..rings.len()).max_by(|a, b| rings[*a].0.total_cmp(&rings[*b].0)).unwrap();
        let low = &rings[1..peak / 2];
        let power = low.iter().map(|ring| ring.0).sum::<f64>() / low.len() as f64;
        assert!(power < 0.10 * mean, "{power} of {mean}, peak in ring {peak}");
        let strongest = rings[1..].iter().map(|ring| ring.1).fold(f64::NEG_INFINITY, f64::max);
        assert!(strongest <= 2.0, "anisotropy of {strongest} dB: {rings:?}");
    }

    /// Squares of three by three tiles are decided by sixteen corners.
    #[test]
    fn squares_of_tiles_repeat_no_more_often_than_by_chance() {
        let tiles = &*TILES;
        let mut seen: BTreeMap<Vec<usize>, usize> = BTreeMap::new();
        let numbers: Vec<Vec<usize>> =
            (0..100).map(|j| (0..100).map(|i| tiles.number_at(9, [i, j])).collect()).collect();
        for j in 0..98 {
            for i in 0..98 {
                let square = (0..9).map(|k| numbers[j + k / 3][i + k % 3]).collect();
                *seen.entry(square).or_default() += 1;
            }
        }
        let pairs: usize = seen.values().map(|count| count * (count - 1) / 2).sum();
        let squares = 98.0f64 * 98.0;
        let chance = squares * (squares - 1.0) / 2.0 / 3f64.powi(16);
        assert!(pairs as f64 <= chance + 3.0 * chance.sqrt(), "{pairs} pairs, {chance} by chance");
    }

    #[test]
    fn every_prefix_is_well_spread() {
        let tiles = &*TILES;
        for density in [0.1, 0.3, 0.6] {
            let spots = spots(tiles, 4, 6, density);
            let area = (tiles.side() * 6.0).powi(2);
            let kept = spots.len() as f32 / (tiles.density() * area);
            assert!((kept - density).abs() < 0.03, "{density}: {kept}");
            let nearest = |spot: &Vec2| {
                let others = spots.iter().filter(|other| *other != spot);
                others.map(|other| other.distance(*spot)).fold(f32::INFINITY, f32::min)
            };
            let mean = spots.iter().map(nearest).sum::<f32>() / spots.len() as f32;
            // Of random points it would be half of this unit (Clark and Evans 1954).
            let unit = (area / spots.len() as f32).sqrt();
            assert!(mean > 0.6 * unit, "{density}: {}", mean / unit);
        }
    }
}
