//! Mean shift with a flat kernel (000 §3.3, 002 §4.1): finds how many clusters there are by itself.
//!
//! The thesis starts from points chosen at random; here every point climbs from its own place and clusters are named
//! in the order of their first point, so the result depends on the input alone. Each point has its own bandwidth,
//! because blades of different size gather at different distances. Cost: near-linear, also where all points stand in one
//! spot (`disc_sums`).
//!
//! Where a point climbs to depends on the points in the discs that it saw on its way, and on no others. So [`Climbs`] are
//! kept from one set of points to the next, and only those are climbed again that saw a point which came or went. In the
//! same way only clusters near a mode that moved are named again (`cluster_heads`).

use super::cluster_heads::Heads;
use super::disc_sums::{self, DiscSums};
use crate::kept::Window;
use glam::Vec2;
use std::collections::{BTreeMap, HashMap};

/// Rounds that most points climb.
const USUAL_ROUNDS: usize = 4;

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
    let window = climbs.follow(points, bandwidth);
    climbs.heads.follow(
        window,
        &climbs.ways.iter().map(|way| way.mode).collect::<Vec<_>>(),
        bandwidth,
        merge,
    );
    climbs.heads.labels()
}

/// Most points that may have come or gone for climbs to be kept: each is held against all climbs.
const MOST_NEW: usize = 256;

/// Where points climbed to.
#[derive(Debug, Default)]
pub struct Climbs {
    /// All points of the last set with their bandwidths, and what their coordinates were rounded to.
    starts: Vec<(Vec2, f32)>,
    unit: f64,
    /// The way of each.
    ways: Vec<Climb>,
    heads: Heads,
}

/// The way of one point.
#[derive(Clone, Copy, Debug)]
struct Climb {
    mode: Vec2,
    /// The corners of a box around all that it saw.
    low: Vec2,
    high: Vec2,
    /// Whether that says all about it.
    is_sound: bool,
}

/// What a climb begins with: place and bandwidth.
fn key((start, bandwidth): &(Vec2, f32)) -> [u32; 3] {
    [start.x, start.y, *bandwidth].map(f32::to_bits)
}

impl Climbs {
    /// Climbs from every point of a new set, where that may end elsewhere than in the last one; gives what both sets have in
    /// common.
    fn follow(&mut self, points: &[Vec2], bandwidth: &[f32]) -> Window {
        let starts: Vec<(Vec2, f32)> = points.iter().copied().zip(bandwidth.iter().copied()).collect();
        let window = Window::between(&self.starts, &starts, |a, b| key(a) == key(b));
        let unit = disc_sums::unit(points);
        let mut known = self.known(&starts, window);
        let is_kept = unit == self.unit && self.forget_those_that_see_a_change(&starts, &mut known);
        let known = |i: usize| known[i].filter(|_| is_kept);
        let missing = (0..starts.len()).filter(|i| known(*i).is_none()).count();
        let sums = (missing > 0).then(|| DiscSums::for_questions(points.to_vec(), missing * USUAL_ROUNDS));
        let way = |(i, &(start, reach)): (usize, &(Vec2, f32))| {
            let anew =
                || sums.as_ref().map_or_else(|| Climb::nowhere(start), |sums| climb(sums, start, reach));
            known(i).unwrap_or_else(anew)
        };
        self.ways = starts.iter().enumerate().map(way).collect();
        (self.starts, self.unit) = (starts, unit);
        window
    }

    /// For every start the way that was climbed from there in the last set.
    fn known(&self, starts: &[(Vec2, f32)], Window { begin, end }: Window) -> Vec<Option<Climb>> {
        let (old_end, new_end) = (self.starts.len() - end, starts.len() - end);
        let between: HashMap<[u32; 3], Climb> =
            (begin..old_end).map(|k| (key(&self.starts[k]), self.ways[k])).collect();
        let way = |i: usize| match i {
            i if i < begin => Some(self.ways[i]),
            i if i < new_end => between.get(&key(&starts[i])).copied(),
            i => Some(self.ways[i - new_end + old_end]),
        };
        (0..starts.len()).map(way).collect()
    }

    /// Leaves out the ways that saw a point which came or went; false where too many did.
    fn forget_those_that_see_a_change(&self, starts: &[(Vec2, f32)], known: &mut [Option<Climb>]) -> bool {
        let place = |start: &(Vec2, f32)| start.0;
        let Window { begin, end } =
            Window::between(&self.starts, starts, |a, b| key(&(a.0, 0.0)) == key(&(b.0, 0.0)));
        let gone = self.starts[begin..self.starts.len() - end].iter().map(place);
        let new = starts[begin..starts.len() - end].iter().map(place);
        let changed = differing(gone, new);
        let is_seen = |way: &Climb| changed.iter().any(|p| p.cmpge(way.low).all() && p.cmple(way.high).all());
        for way in known.iter_mut() {
            *way = way.filter(|way| way.is_sound && changed.len() <= MOST_NEW && !is_seen(way));
        }
        changed.len() <= MOST_NEW
    }
}

/// The points that are more often in one of two lists than in the other.
fn differing(old: impl Iterator<Item = Vec2>, new: impl Iterator<Item = Vec2>) -> Vec<Vec2> {
    let mut surplus: BTreeMap<[u32; 2], i32> = BTreeMap::new();
    let signed = old.map(|p| (p, -1)).chain(new.map(|p| (p, 1)));
    for (p, by) in signed {
        *surplus.entry(p.to_array().map(f32::to_bits)).or_default() += by;
    }
    let differs = surplus.into_iter().filter(|(_, by)| *by != 0);
    differs.map(|(p, _)| Vec2::from_array(p.map(f32::from_bits))).collect()
}

impl Climb {
    /// That of a point that stays where it is.
    fn nowhere(start: Vec2) -> Self {
        Self { mode: start, low: start, high: start, is_sound: false }
    }
}

fn climb(sums: &DiscSums, start: Vec2, bandwidth: f32) -> Climb {
    // More than the disc by more than any rounding. The squares of the smallest bandwidths are no numbers to rely on.
    let seen = 1.001 * bandwidth;
    let is_sound = bandwidth * bandwidth >= f32::MIN_POSITIVE;
    let mut way = Climb { mode: start, low: start - seen, high: start + seen, is_sound };
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
                for ((start, reach), way) in points.iter().zip(&reach).zip(&climbs.ways) {
                    let anew = climb(&DiscSums::new(points.clone()), *start, *reach);
                    prop_assert_eq!(way.mode, anew.mode);
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
        let starts: Vec<(Vec2, f32)> = points.iter().map(|p| (*p, 2.0)).collect();
        let window = Window::between(&climbs.starts, &starts, |a, b| a == b);
        let mut known = climbs.known(&starts, window);
        assert!(climbs.forget_those_that_see_a_change(&starts, &mut known));
        assert_eq!(known.iter().flatten().count(), 99);
    }

    #[test]
    fn nothing_gives_nothing() {
        assert!(cluster(&[], &[], 0.5).is_empty());
    }
}
