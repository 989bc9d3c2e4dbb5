//! What a ball sweeps on its way: the volume of a brush stroke, and the direction of the stroke everywhere in it.
//!
//! The way is resampled so that the ball has moved by a third of its radius from one place to the next; the union of those
//! balls is at most 1.4 % of the radius thinner than what a ball sweeps. Cells half as wide as the largest ball, at places that do not depend on
//! the stroke, cover it: markers are scattered cell by cell, so that a slow and a fast hand give the same ones and what is
//! painted twice is no denser.
//!
//! Source: 001 §4.4, eqs. 4.2 and 4.3, with both corrected: the weight of a place of the way has no unit, so that a model of another
//! size is steered alike, and directions are averaged, not summed, so that density does not steer. Where we depart: the average is taken once for
//! each bud, in the middle of what it perceives, and not over its markers one by one.

use crate::geom::cells::{Grid, Sorted};
use glam::{IVec3, Vec3};
use rayon::prelude::*;
use std::collections::HashMap;

/// Distance of balls, in radii of the smaller of two.
const STEP: f32 = 1.0 / 3.0;
/// Most balls; longer ways have them farther apart.
const MOST: f32 = 20_000.0;
/// Side of a cell of which all balls are one, in radii of the largest ball.
const MERGED: f32 = 1.0 / 6.0;
/// Side of a cell of the cover, in radii of the largest ball.
const CELL: f32 = 0.5;
/// Balls from which on the cells of the cover are larger: there would be too many.
const FEW: f32 = 4000.0;
/// Cells by which the volume is measured, at most; of more every so many-th.
const MEASURED: usize = 20_000;
/// Places along each side of a cell by which the volume is measured.
const PROBES: u32 = 3;
/// σ of eq. 4.2, in radii of the ball.
const SIGMA: f32 = 0.5;

/// A ball on its way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Middle, metres.
    pub at: Vec3,
    /// Radius, metres.
    pub radius: f32,
    /// Mean direction of the ways that go through there, at most 1 long; zero where there is none.
    pub along: Vec3,
    /// How many times a way goes through there.
    pub times: u32,
}

/// The volume that a ball sweeps.
#[derive(Debug)]
pub struct Swept {
    /// In the order of the way.
    balls: Vec<Ball>,
    grid: Grid,
    of_cell: Sorted,
    low: Vec3,
    high: Vec3,
    /// Side of a cell of the cover.
    side: f32,
    cover: Vec<IVec3>,
    volume: f32,
    /// g of eq. 4.3.
    guide: f32,
}

impl PartialEq for Swept {
    /// By what it is made from.
    fn eq(&self, other: &Self) -> bool {
        (&self.balls, self.guide) == (&other.balls, other.guide)
    }
}

impl Swept {
    /// What a ball sweeps by a way of places with radii, metres; shoots follow it by `guide`. `None` without a place, or where
    /// a radius is not above 0.
    pub fn new(way: &[(Vec3, f32)], guide: f32) -> Option<Self> {
        let is_sound = |(at, radius): &(Vec3, f32)| at.is_finite() && radius.is_finite() && *radius > 0.0;
        if way.is_empty() || !way.iter().all(is_sound) {
            return None;
        }
        let largest = way.iter().map(|(_, radius)| *radius).fold(0.0, f32::max);
        let balls = merged(balls(way), MERGED * largest);
        let low = balls.iter().map(|b| b.at - b.radius).fold(Vec3::INFINITY, Vec3::min);
        let high = balls.iter().map(|b| b.at + b.radius).fold(Vec3::NEG_INFINITY, Vec3::max);
        let grid = Grid::new(low, high, largest);
        let mut of_cell = Sorted::default();
        let cells: Vec<u32> = balls.iter().map(|ball| grid.number(grid.place(ball.at)) as u32).collect();
        of_cell.sort(grid.len(), &cells);
        let side = CELL * largest * (balls.len() as f32 / FEW).max(1.0);
        let cover = cover(&balls, side);
        let (volume, guide) = (0.0, guide);
        let mut swept = Self { balls, grid, of_cell, low, high, side, cover, volume, guide };
        swept.volume = swept.measured();
        Some(swept)
    }

    /// Whether a point lies inside.
    pub fn contains(&self, p: Vec3) -> bool {
        let holds = |ball: &Ball| ball.at.distance_squared(p) <= ball.radius * ball.radius;
        p.cmpge(self.low).all() && p.cmple(self.high).all() && self.near(p).any(holds)
    }

    /// Smallest and largest corner.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        (self.low, self.high)
    }

    /// Cubic metres, about.
    pub fn volume(&self) -> f32 {
        self.volume
    }

    /// How strongly shoots follow the way, below 0 against it.
    pub fn guide(&self) -> f32 {
        self.guide
    }

    /// The balls, in the order of the way.
    pub fn balls(&self) -> &[Ball] {
        &self.balls
    }

    /// Balls that are asked about one point, about.
    pub fn balls_beside_a_point(&self) -> u64 {
        27 * self.balls.len().div_ceil(self.cover.len().max(1)) as u64 + 9
    }

    /// The cells that cover it, by their low corners in sides of a cell, in the order of y, z and x; and that side, metres.
    pub(in crate::growth) fn cells(&self) -> (&[IVec3], f32) {
        (&self.cover, self.side)
    }

    /// The direction that the stroke gives to a bud which perceives `reach` far and would follow `best`: unit, or zero with it.
    pub(in crate::growth) fn led(&self, at: Vec3, best: Vec3, reach: f32) -> Vec3 {
        let Some(own) = best.try_normalize() else { return best };
        if self.guide == 0.0 {
            return best;
        }
        let place = at + own * (0.5 * reach);
        let (mut sum, mut weights) = (Vec3::ZERO, 0.0);
        for ball in self.near(place) {
            let away = ball.at.distance_squared(place) / (SIGMA * ball.radius).powi(2);
            let weight = (-0.5 * away).exp() * ball.times as f32;
            sum += ball.along * weight;
            weights += weight;
        }
        if weights <= f32::MIN_POSITIVE {
            return best;
        }
        (own + sum * (self.guide / weights)).try_normalize().unwrap_or(best)
    }

    /// The balls of the cells around a point: all that may hold it.
    fn near(&self, p: Vec3) -> impl Iterator<Item = &Ball> {
        let (low, high) = self.grid.around(p, self.grid.cell);
        let rows = (low.y..=high.y).flat_map(move |y| (low.z..=high.z).map(move |z| (y, z)));
        rows.flat_map(move |(y, z)| {
            let number = |x: i32| self.grid.number(IVec3::new(x, y, z));
            self.of_cell.run(number(low.x), number(high.x)).iter().map(|ball| &self.balls[*ball as usize])
        })
    }

    /// The volume, by places in the cells of the cover.
    fn measured(&self) -> f32 {
        let share = |k: u32| (k as f32 + 0.5) / PROBES as f32;
        let inside = |cell: &IVec3| {
            let low = cell.as_vec3() * self.side;
            let places = (0..PROBES.pow(3)).map(|k| {
                low + Vec3::new(share(k % PROBES), share(k / PROBES % PROBES), share(k / PROBES.pow(2)))
                    * self.side
            });
            places.filter(|p| self.contains(*p)).count() as u64
        };
        let every = self.cover.len().div_ceil(MEASURED).max(1);
        let count: u64 = self.cover.par_iter().step_by(every).with_min_len(256).map(inside).sum();
        (count * every as u64) as f32 / PROBES.pow(3) as f32 * self.side.powi(3)
    }
}

/// Balls along a way, at most [`STEP`] apart.
fn balls(way: &[(Vec3, f32)]) -> Vec<Ball> {
    let run = |w: &[(Vec3, f32)]| w[0].0.distance(w[1].0);
    let whole: f32 = way.windows(2).map(run).sum();
    let mut places = vec![way[0]];
    for w in way.windows(2) {
        let step = (STEP * w[0].1.min(w[1].1)).max(whole / MOST).max(f32::MIN_POSITIVE);
        let from = places[places.len() - 1];
        // What lies closer together than a step is passed over, so that a slow hand makes no more of them.
        if from.0.distance(w[1].0) < step {
            continue;
        }
        // A hair more than a step is one.
        let count = (from.0.distance(w[1].0) / step - 0.01).ceil().max(1.0) as usize;
        let between = |k: usize| {
            let share = k as f32 / count as f32;
            (from.0.lerp(w[1].0, share), from.1 + (w[1].1 - from.1) * share)
        };
        places.extend((1..=count).map(between));
    }
    if let Some(end) = way.last().filter(|end| places.last() != Some(end)) {
        places.push(*end);
    }
    let along = |k: usize| {
        let (from, to) = (places[k.saturating_sub(1)].0, places[(k + 1).min(places.len() - 1)].0);
        (to - from).normalize_or_zero()
    };
    let ball = |(k, &(at, radius)): (usize, &(Vec3, f32))| Ball { at, radius, along: along(k), times: 1 };
    places.iter().enumerate().map(ball).collect()
}

/// The balls with those of each cell of this side as one, where it was first passed: a way that goes to and fro has no more of them
/// than one that fills the same place once.
fn merged(balls: Vec<Ball>, side: f32) -> Vec<Ball> {
    let mut place_of: HashMap<IVec3, usize> = HashMap::new();
    let mut merged: Vec<Ball> = Vec::with_capacity(balls.len());
    for ball in balls {
        let place = *place_of.entry((ball.at / side).floor().as_ivec3()).or_insert(merged.len());
        match merged.get_mut(place) {
            None => merged.push(ball),
            Some(known) => {
                let times = known.times as f32;
                known.along = (known.along * times + ball.along) / (times + 1.0);
                known.radius = known.radius.max(ball.radius);
                known.times += 1;
            }
        }
    }
    merged
}

/// The cells of this side that balls touch, each once.
fn cover(balls: &[Ball], side: f32) -> Vec<IVec3> {
    let mut cells = Vec::new();
    for ball in balls {
        let (low, high) = ((ball.at - ball.radius) / side, (ball.at + ball.radius) / side);
        let (low, high) = (low.floor().as_ivec3(), high.floor().as_ivec3());
        for y in low.y..=high.y {
            for z in low.z..=high.z {
                cells.extend((low.x..=high.x).map(|x| IVec3::new(x, y, z)));
            }
        }
        // Balls overlap; dropped early, what they share takes no memory.
        if cells.len() > 1 << 20 {
            sort(&mut cells);
        }
    }
    sort(&mut cells);
    cells
}

fn sort(cells: &mut Vec<IVec3>) {
    cells.sort_unstable_by_key(|cell| (cell.y, cell.z, cell.x));
    cells.dedup();
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::PI;

    fn upright() -> Vec<(Vec3, f32)> {
        (0..=10).map(|k| (Vec3::Y * (1.0 + 0.2 * k as f32), 0.25)).collect()
    }

    #[test]
    fn it_is_what_the_ball_sweeps() {
        let swept = Swept::new(&upright(), 0.8).unwrap();
        for (p, inside) in [
            (Vec3::new(0.24, 2.0, 0.0), true),
            (Vec3::new(0.26, 2.0, 0.0), false),
            (Vec3::new(0.0, 3.24, 0.0), true),
            (Vec3::new(0.0, 3.26, 0.0), false),
            (Vec3::new(0.0, 0.76, 0.0), true),
            (Vec3::NAN, false),
        ] {
            assert_eq!(swept.contains(p), inside, "{p}");
        }
        let expected = PI * 0.25_f32.powi(2) * 2.0 + 4.0 / 3.0 * PI * 0.25_f32.powi(3);
        assert!((swept.volume() / expected - 1.0).abs() < 0.03, "{} of {expected}", swept.volume());
        let (low, high) = swept.bounds();
        assert!(low.abs_diff_eq(Vec3::new(-0.25, 0.75, -0.25), 1e-5) && high.y == 3.25);
    }

    #[test]
    fn slow_hands_and_ways_there_and_back_sweep_the_same() {
        let swept = Swept::new(&upright(), 0.8).unwrap();
        let slow: Vec<_> = (0..=2000).map(|k| (Vec3::Y * (1.0 + 0.001 * k as f32), 0.25)).collect();
        let back: Vec<_> = upright().into_iter().chain(upright().into_iter().rev()).collect();
        for other in [slow, back] {
            let other = Swept::new(&other, 0.8).unwrap();
            // A ball that starts a little earlier or later may touch a cell more.
            assert!(other.cells().0.len().abs_diff(swept.cells().0.len()) <= swept.cells().0.len() / 50);
            assert!((other.volume() / swept.volume() - 1.0).abs() < 0.01);
            assert!(other.balls().len() < 50, "{}", other.balls().len());
        }
    }

    #[test]
    fn a_bud_is_led_along_the_way_whatever_the_size_of_the_model() {
        for scale in [0.01, 1.0, 100.0] {
            let way: Vec<_> = upright().iter().map(|(at, radius)| (*at * scale, radius * scale)).collect();
            let led = |guide: f32, best: Vec3| {
                let swept = Swept::new(&way, guide).unwrap();
                swept.led(Vec3::new(0.1, 2.0, 0.0) * scale, best, 0.1 * scale)
            };
            assert_eq!(led(0.0, Vec3::X * 0.5), Vec3::X * 0.5);
            assert_eq!(led(0.8, Vec3::ZERO), Vec3::ZERO);
            let along = led(0.8, Vec3::X * 0.5);
            assert!((along - Vec3::new(1.0, 0.8, 0.0).normalize()).length() < 1e-3, "{along}");
            let back: Vec<_> = way.iter().chain(way.iter().rev()).copied().collect();
            let neither = Swept::new(&back, 0.8).unwrap().led(Vec3::Y * 2.0 * scale, Vec3::X, 0.1 * scale);
            assert!(neither.y.abs() < 0.1, "there and back leads nowhere: {neither}");
            assert!(led(-0.8, Vec3::X).y < -0.5);
        }
    }

    #[test]
    fn what_sweeps_nothing_is_none() {
        assert!(Swept::new(&[], 0.8).is_none());
        assert!(Swept::new(&[(Vec3::ZERO, 0.0)], 0.8).is_none());
        assert!(Swept::new(&[(Vec3::NAN, 1.0)], 0.8).is_none());
        let dot = Swept::new(&[(Vec3::Y, 0.5)], 0.8).unwrap();
        assert!(dot.contains(Vec3::Y * 1.4) && dot.led(Vec3::Y, Vec3::X, 0.1).abs_diff_eq(Vec3::X, 1e-6));
    }

    #[test]
    fn a_way_of_many_samples_stays_small() {
        let long: Vec<_> = (0..200_000).map(|k| (Vec3::X * k as f32, 0.001)).collect();
        assert!(Swept::new(&long, 0.8).unwrap().balls().len() < 21_000);
    }
}
