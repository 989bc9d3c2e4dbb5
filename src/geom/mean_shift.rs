//! Mean shift with a flat kernel (000 §3.3, 002 §4.1): finds how many clusters there are by itself.
//!
//! The thesis starts from points chosen at random; here every point climbs from its own place and clusters are named
//! in the order of their first point, so the result depends on the input alone. Each point has its own bandwidth,
//! because blades of different size gather at different distances. Cost: near-linear, also where all points stand in one
//! spot (`disc_sums`).

use super::disc_sums::DiscSums;
use glam::Vec2;
use rstar::{RTree, primitives::GeomWithData};

/// Rounds after which a point that still climbs is taken where it stands; flat kernels settle in a handful.
const MAX_ROUNDS: usize = 32;

/// Cluster number of every point, counted from 0 in order of first appearance.
///
/// `bandwidth[i]` is the radius, in the points' unit, within which point `i` sees others. Two points end in one
/// cluster when their modes lie closer than `merge` × the smaller of their bandwidths.
pub fn cluster(points: &[Vec2], bandwidth: &[f32], merge: f32) -> Vec<usize> {
    debug_assert_eq!(points.len(), bandwidth.len());
    let sums = DiscSums::new(points.to_vec());
    let modes: Vec<Vec2> = points.iter().zip(bandwidth).map(|(&p, &h)| climb(&sums, p, h)).collect();
    join(&modes, bandwidth, merge)
}

fn climb(sums: &DiscSums, start: Vec2, bandwidth: f32) -> Vec2 {
    let mut at = start;
    for _ in 0..MAX_ROUNDS {
        let next = sums.mean_within(at, bandwidth).unwrap_or(at);
        if next.distance(at) <= 1e-3 * bandwidth {
            return next;
        }
        at = next;
    }
    at
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

    #[test]
    fn nothing_gives_nothing() {
        assert!(cluster(&[], &[], 0.5).is_empty());
    }
}
