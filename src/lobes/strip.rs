//! Strips of faces between two strokes.
//!
//! The stroke with fewer samples gets as many as the other by splitting, again and again, its longest gap with a point of
//! a cubic Hermite curve; samples are then joined in order from the [start pair](super::pairing) on. Inserted samples are merged
//! into the originals beside them, so that a stroke that two strips share has one set of vertices.
//!
//! Source: 001 §5.2.1, case 1 of fig. 5.4. Departure: merging an inserted sample "into the nearest original" can fold a strip where
//! samples are sparse. Here an inserted sample only gives the originals their places along the strip, and faces follow those
//! places on both sides, always forward: what is merged can change the shape of a face, not the order in which faces join.

use super::pairing::start_pair;
use glam::Vec3;

/// A loop of vertices of a surface.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Loop {
    /// Indices of its vertices.
    pub(super) ids: Vec<u32>,
    /// Where they are.
    pub(super) points: Vec<Vec3>,
}

impl Loop {
    /// The same loop the other way round.
    pub(super) fn reversed(&self) -> Self {
        let (ids, points) = (self.ids.iter().rev(), self.points.iter().rev());
        Self { ids: ids.copied().collect(), points: points.copied().collect() }
    }
}

/// A sample of a stroke that has been given more of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sample {
    /// Where it is.
    pub(super) at: Vec3,
    /// Its number in the stroke; none for one that was inserted.
    pub(super) original: Option<usize>,
}

/// A stroke with at least `count` samples, inserted where its gaps are longest. The first stays the first.
pub(super) fn densified(points: &[Vec3], closed: bool, count: usize) -> Vec<Sample> {
    let whole = points.iter().enumerate().map(|(k, at)| Sample { at: *at, original: Some(k) });
    let mut samples: Vec<Sample> = whole.collect();
    while samples.len() < count && samples.len() > 1 {
        let edges = samples.len() - usize::from(!closed);
        let gap = |k: usize| samples[k].at.distance_squared(samples[(k + 1) % samples.len()].at);
        let longest = (0..edges).fold(0, |best, k| if gap(k) > gap(best) { k } else { best });
        let at = hermite_middle(&samples, closed, longest);
        samples.insert(longest + 1, Sample { at, original: None });
    }
    samples
}

/// The middle of a cubic Hermite curve over the gap after a sample; tangents lead from neighbour to neighbour, as long as the gap.
fn hermite_middle(samples: &[Sample], closed: bool, k: usize) -> Vec3 {
    let count = samples.len();
    let at = |k: isize| {
        let k = if closed { k.rem_euclid(count as isize) } else { k.clamp(0, count as isize - 1) };
        samples[k as usize].at
    };
    let k = k as isize;
    let (before, from, to, after) = (at(k - 1), at(k), at(k + 1), at(k + 2));
    let gap = from.distance(to);
    let tangent =
        |a: Vec3, b: Vec3, c: Vec3| (c - a) * (gap / (a.distance(b) + b.distance(c)).max(f32::MIN_POSITIVE));
    (from + to) * 0.5 + (tangent(before, from, to) - tangent(from, to, after)) * 0.125
}

/// Vertices in their order along one side of a strip.
#[derive(Clone, Debug, Default)]
pub(super) struct Side {
    /// The vertices.
    pub(super) ids: Vec<u32>,
    /// How far along the strip each is, rising.
    pub(super) along: Vec<f32>,
}

/// Joins two sides from their first vertices to their last, going on where the next vertex comes first. Faces lie to the left of
/// `a`. Where `held`, `a` makes the first step and the last one, so that a second strip on the other side of `b` shares no more
/// than the ends with this one.
pub(super) fn join(a: &Side, b: &Side, held: bool, triangles: &mut Vec<[u32; 3]>) {
    let (mut i, mut j) = (0, 0);
    let (last_i, last_j) = (a.ids.len() - 1, b.ids.len() - 1);
    while i < last_i || j < last_j {
        let by_place = j == last_j || (i < last_i && a.along[i + 1] <= b.along[j + 1]);
        let first = held && i == 0;
        let last = held && i + 1 == last_i && j < last_j;
        if i < last_i && (first || (by_place && !last)) {
            triangles.push([a.ids[i], a.ids[i + 1], b.ids[j]]);
            i += 1;
        } else {
            triangles.push([a.ids[i], b.ids[j + 1], b.ids[j]]);
            j += 1;
        }
    }
}

/// Joins two loops; gives the second in the sense of the first. Faces lie to the left of `a`.
pub(super) fn strip(a: &Loop, b: &Loop, triangles: &mut Vec<[u32; 3]>) -> Loop {
    let count = a.ids.len().max(b.ids.len());
    let dense_a = densified(&a.points, true, count);
    let mut dense_b = densified(&b.points, true, count);
    let places = |samples: &[Sample]| samples.iter().map(|s| s.at).collect::<Vec<_>>();
    let start = start_pair(&places(&dense_a), &places(&dense_b));
    if start.reversed {
        dense_b.reverse();
    }
    let side = |dense: &[Sample], of: &Loop, shift: usize| {
        let mut side = Side::default();
        for k in 0..count {
            if let Some(original) = dense[(k + shift) % count].original {
                side.ids.push(of.ids[original]);
                side.along.push(k as f32);
            }
        }
        side.ids.push(side.ids[0]);
        side.along.push(side.along[0] + count as f32);
        side
    };
    join(&side(&dense_a, a, 0), &side(&dense_b, b, start.shift), false, triangles);
    if start.reversed { b.reversed() } else { b.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::TAU;

    fn ring(count: usize, radius: f32, height: f32, first_id: u32, turned: f32) -> Loop {
        let at = |k: usize| {
            let (sin, cos) = (turned + k as f32 / count as f32 * TAU).sin_cos();
            Vec3::new(radius * cos, height, radius * sin)
        };
        Loop { ids: (first_id..first_id + count as u32).collect(), points: (0..count).map(at).collect() }
    }

    #[test]
    fn inserted_samples_lie_on_the_circle() {
        let samples = densified(&ring(12, 1.0, 0.0, 0, 0.0).points, true, 31);
        assert_eq!(samples.len(), 31);
        assert_eq!(
            samples.iter().filter_map(|s| s.original).collect::<Vec<_>>(),
            (0..12).collect::<Vec<_>>()
        );
        assert!(samples.iter().all(|s| (s.at.length() - 1.0).abs() < 0.02));
        let open = densified(&[Vec3::ZERO, Vec3::X, Vec3::X * 4.0], false, 7);
        assert!(open.windows(2).all(|w| w[1].at.x > w[0].at.x) && open.last().unwrap().original == Some(2));
    }

    #[test]
    fn every_vertex_of_both_loops_is_joined_once_around() {
        for (n, m) in [(24, 24), (24, 9), (5, 30), (3, 3), (96, 12)] {
            let (a, b) = (ring(n, 1.0, 0.0, 0, 0.0), ring(m, 0.7, 1.0, n as u32, 2.0));
            for b in [b.clone(), b.reversed()] {
                let mut triangles = Vec::new();
                let along = strip(&a, &b, &mut triangles);
                assert_eq!(triangles.len(), n + m, "one face for every edge of both");
                let sides = |t: &[u32; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
                let mut edges: Vec<[u32; 2]> = triangles.iter().flat_map(sides).collect();
                edges.sort_unstable();
                assert!(edges.windows(2).all(|w| w[0] != w[1]));
                let has = |x: u32, y: u32| edges.binary_search(&[x, y]).is_ok();
                for k in 0..n {
                    assert!(has(a.ids[k], a.ids[(k + 1) % n]));
                }
                for k in 0..m {
                    assert!(has(along.ids[(k + 1) % m], along.ids[k]), "the second runs as the first");
                }
            }
        }
    }
}
