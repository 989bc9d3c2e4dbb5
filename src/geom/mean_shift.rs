//! Mean shift with a flat kernel (000 §3.3, 002 §4.1): finds how many clusters there are by itself.
//!
//! The thesis starts from points chosen at random; here every point climbs from its own place and clusters are named
//! in the order of their first point, so the result depends on the input alone. Each point has its own bandwidth,
//! because blades of different size gather at different distances. Cost: near-linear, also where all points stand in one
//! spot (`disc_sums`).
//!
//! Where a point climbs to depends on the points in the discs that it saw on its way, and on no others. So [`Climbs`] are
//! kept from one set of points to the next, and only those are climbed again that saw a point which came or went.

use super::disc_sums::{self, DiscSums};
use glam::Vec2;
use rstar::{RTree, primitives::GeomWithData};
use std::collections::HashMap;

/// Rounds after which a point that still climbs is taken where it stands; flat kernels settle in a handful.
const MAX_ROUNDS: usize = 32;

/// Cluster number of every point, counted from 0 in order of first appearance.
///
/// `bandwidth[i]` is the radius, in the points' unit, within which point `i` sees others. Two points end in one
/// cluster when their modes lie closer than `merge` × the smaller of their bandwidths.
pub fn cluster(points: &[Vec2], bandwidth: &[f32], merge: f32) -> Vec<usize> {
    cluster_with(&mut Climbs::default(), points, bandwidth, merge)
}

/// The very clusters that [`cluster`] gives, again and again while a few points come and go.
pub fn cluster_with(climbs: &mut Climbs, points: &[Vec2], bandwidth: &[f32], merge: f32) -> Vec<usize> {
    debug_assert_eq!(points.len(), bandwidth.len());
    climbs.follow(points);
    let mut sums = None;
    let modes: Vec<Vec2> = points
        .iter()
        .zip(bandwidth)
        .map(|(&start, &reach)| {
            let known = climbs.held.get_mut(&key(start, reach));
            if let Some(climb) = known.filter(|climb| climb.is_sound) {
                climb.round = climbs.round;
                return climb.mode;
            }
            let sums = sums.get_or_insert_with(|| DiscSums::new(points.to_vec()));
            let climb = Climb { round: climbs.round, ..climb(sums, start, reach) };
            climbs.held.insert(key(start, reach), climb);
            climb.mode
        })
        .collect();
    let round = climbs.round;
    climbs.held.retain(|_, climb| climb.round == round);
    join(&modes, bandwidth, merge)
}

/// Most points that may have come or gone for climbs to be kept: each is held against all climbs.
const MOST_NEW: usize = 256;

/// Where points climbed to.
#[derive(Debug, Default)]
pub struct Climbs {
    /// All points of the last set, and what their coordinates were rounded to.
    points: Vec<Vec2>,
    unit: f64,
    held: HashMap<[u32; 3], Climb>,
    round: u64,
}

/// The way of one point.
#[derive(Clone, Copy, Debug)]
struct Climb {
    mode: Vec2,
    /// The corners of a box around all that it saw.
    low: Vec2,
    high: Vec2,
    /// Whether all of that is as it was.
    is_sound: bool,
    /// The last set of points in which it was climbed or taken.
    round: u64,
}

/// What a climb begins with: place and bandwidth.
fn key(start: Vec2, bandwidth: f32) -> [u32; 3] {
    [start.x, start.y, bandwidth].map(f32::to_bits)
}

impl Climbs {
    /// Finds out which climbs a new set of points leaves as they were.
    fn follow(&mut self, points: &[Vec2]) {
        self.round += 1;
        let unit = disc_sums::unit(points);
        // What stands between the common beginning and the common end of both sets came or went.
        let same = |(a, b): &(&Vec2, &Vec2)| a == b;
        let begin = self.points.iter().zip(points).take_while(same).count();
        let ends = self.points[begin..].iter().rev().zip(points[begin..].iter().rev());
        let end = ends.take_while(same).count();
        let (gone, new) = (&self.points[begin..self.points.len() - end], &points[begin..points.len() - end]);
        if unit != self.unit || gone.len() + new.len() > MOST_NEW {
            self.held.clear();
        }
        let is_seen = |climb: &Climb| {
            let inside = |p: &Vec2| p.cmpge(climb.low).all() && p.cmple(climb.high).all();
            gone.iter().chain(new).any(inside)
        };
        self.held.retain(|_, climb| climb.is_sound && !is_seen(climb));
        (self.points, self.unit) = (points.to_vec(), unit);
    }
}

fn climb(sums: &DiscSums, start: Vec2, bandwidth: f32) -> Climb {
    // More than the disc by more than any rounding. The squares of the smallest bandwidths are no numbers to rely on.
    let seen = 1.001 * bandwidth;
    let is_sound = bandwidth * bandwidth >= f32::MIN_POSITIVE;
    let mut way = Climb { mode: start, low: start - seen, high: start + seen, is_sound, round: 0 };
    for _ in 0..MAX_ROUNDS {
        let at = way.mode;
        (way.low, way.high) = (way.low.min(at - seen), way.high.max(at + seen));
        way.mode = sums.mean_within(at, bandwidth).unwrap_or(at);
        if way.mode.distance(at) <= 1e-3 * bandwidth {
            break;
        }
    }
    way
}

/// Names modes: each joins the first earlier cluster whose first mode is near enough.
fn join(modes: &[Vec2], bandwidth: &[f32], merge: f32) -> Vec<usize> {
    let mut heads: RTree<GeomWithData<[f32; 2], (usize, usize)>> = RTree::new();
    let mut labels = Vec::with_capacity(modes.len());
    let mut clusters = 0;
    for (i, (mode, &h)) in modes.iter().zip(bandwidth).enumerate() {
        let near = heads
            .locate_within_distance(mode.to_array(), (merge * h).powi(2))
            .filter(|head| {
                let reach = merge * h.min(bandwidth[head.data.0]);
                mode.distance_squared(Vec2::from_array(*head.geom())) <= reach * reach
            })
            .map(|head| head.data.1)
            .min();
        labels.push(near.unwrap_or_else(|| {
            heads.insert(GeomWithData::new(mode.to_array(), (i, clusters)));
            clusters += 1;
            clusters - 1
        }));
    }
    labels
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn two_rings_and_a_loner() {
        let ring = |c: Vec2, r: f32| (0..6).map(move |k| c + r * Vec2::from_angle(k as f32));
        let mut points: Vec<Vec2> = ring(Vec2::ZERO, 1.0).chain(ring(Vec2::new(50.0, 0.0), 1.5)).collect();
        points.push(Vec2::new(20.0, 20.0));
        let labels = cluster(&points, &vec![4.0; points.len()], 0.5);
        assert_eq!(labels, [0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 2]);
    }

    #[test]
    fn small_blades_beside_large_ones_stay_apart() {
        let points = [Vec2::ZERO, Vec2::new(0.5, 0.0), Vec2::new(6.0, 0.0), Vec2::new(6.2, 0.0)];
        let labels = cluster(&points, &[2.0, 2.0, 1.0, 1.0], 0.5);
        assert_eq!(labels, [0, 0, 1, 1]);
    }

    proptest! {
        #[test]
        fn climbs_that_are_kept_end_where_new_ones_do(
            places in prop::collection::vec((-30i16..30, -30i16..30, 1u8..40), 1..80),
            changes in prop::collection::vec((0usize..80, 0usize..80, any::<bool>()), 1..12),
        ) {
            let point = |&(x, y, h): &(i16, i16, u8)| (Vec2::new(x.into(), y.into()), 0.13 * f32::from(h));
            let mut climbs = Climbs::default();
            let mut held = places.clone();
            for (at, other, adds) in changes {
                let at = at % (held.len() + 1);
                if adds || at == held.len() {
                    held.insert(at, places[other % places.len()]);
                } else {
                    held.remove(at);
                }
                let (points, reach): (Vec<Vec2>, Vec<f32>) = held.iter().map(point).unzip();
                let kept = cluster_with(&mut climbs, &points, &reach, 0.7);
                prop_assert_eq!(kept, cluster(&points, &reach, 0.7));
                for (start, reach) in points.iter().zip(&reach) {
                    let anew = climb(&DiscSums::new(points.clone()), *start, *reach);
                    prop_assert_eq!(climbs.held[&key(*start, *reach)].mode, anew.mode);
                }
            }
        }
    }

    #[test]
    fn only_what_saw_a_change_climbs_again() {
        let mut points: Vec<Vec2> = (0..100).map(|k| Vec2::new(10.0 * k as f32, 1000.0)).collect();
        let reach = vec![2.0; 101];
        let mut climbs = Climbs::default();
        cluster_with(&mut climbs, &points, &reach[..100], 0.5);
        points.push(Vec2::new(501.0, 1000.0));
        climbs.follow(&points);
        assert_eq!(climbs.held.len(), 99);
    }

    #[test]
    fn nothing_gives_nothing() {
        assert!(cluster(&[], &[], 0.5).is_empty());
    }
}
