//! The inside of a closed outline: containment and the nearest point of its boundary.
//!
//! Containment counts crossings of a horizontal ray (even–odd rule) and looks only at the edges of the point's slab: a
//! handful on a hand-drawn outline, all of them at worst. There are fewer slabs the more of them an edge spans, so
//! that the table stays linear in the edges. The nearest boundary point comes from an R-tree over the edges.
//! Self-crossing outlines are allowed.

use glam::Vec2;
use rstar::{
    AABB, RTree,
    primitives::{GeomWithData, Line, Rectangle},
};
use std::ops::ControlFlow;

/// Slabs that an edge may lie in, on average.
const SLABS_PER_EDGE: f32 = 6.0;

/// A filled outline.
pub struct Region {
    points: Vec<Vec2>,
    edges: RTree<Line<[f32; 2]>>,
    slabs: Vec<Vec<u32>>,
    low: f32,
    slab_height: f32,
}

impl Region {
    /// The region inside a closed outline; the first point is not repeated.
    pub fn new(points: Vec<Vec2>) -> Self {
        let lines = edges(&points).map(|(a, b)| Line::new(a.to_array(), b.to_array())).collect();
        let low = points.iter().map(|p| p.y).fold(f32::INFINITY, f32::min);
        let high = points.iter().map(|p| p.y).fold(f32::NEG_INFINITY, f32::max);
        let climb: f32 = edges(&points).map(|(a, b)| (a.y - b.y).abs()).sum();
        let most = SLABS_PER_EDGE * points.len() as f32 * ((high - low) / climb).min(1.0);
        let count = points.len().min(most as usize).max(1);
        let slab_height = ((high - low) / count as f32).max(f32::MIN_POSITIVE);
        let mut slabs = vec![Vec::new(); count];
        let slab = |y: f32| (((y - low) / slab_height) as usize).min(count - 1);
        for (i, (a, b)) in edges(&points).enumerate() {
            for bucket in &mut slabs[slab(a.y.min(b.y))..=slab(a.y.max(b.y))] {
                bucket.push(i as u32);
            }
        }
        Self { edges: RTree::bulk_load(lines), points, slabs, low, slab_height }
    }

    /// The outline.
    pub fn outline(&self) -> &[Vec2] {
        &self.points
    }

    /// Smallest and largest corner; `None` for an empty outline.
    pub fn bounds(&self) -> Option<(Vec2, Vec2)> {
        let first = *self.points.first()?;
        Some(self.points.iter().fold((first, first), |(lo, hi), p| (lo.min(*p), hi.max(*p))))
    }

    /// Whether a point lies inside.
    pub fn contains(&self, p: Vec2) -> bool {
        if p.y.is_nan() || p.y < self.low {
            return false;
        }
        let Some(bucket) = self.slabs.get(((p.y - self.low) / self.slab_height) as usize) else {
            return false;
        };
        let crossings = bucket.iter().filter(|&&i| {
            let a = self.points[i as usize];
            let b = self.points[(i as usize + 1) % self.points.len()];
            (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
        });
        crossings.count() % 2 == 1
    }

    /// Edges that are asked about one point, at most.
    pub fn edges_beside_a_point(&self) -> usize {
        self.slabs.iter().map(Vec::len).max().unwrap_or(0)
    }

    /// The boundary point nearest to `p` and its distance; `None` for an empty outline.
    pub fn nearest_boundary(&self, p: Vec2) -> Option<(Vec2, f32)> {
        let line = self.edges.nearest_neighbor(p.to_array())?;
        let nearest = Vec2::from_array(line.nearest_point(&p.to_array()));
        Some((nearest, p.distance(nearest)))
    }
}

fn edges(points: &[Vec2]) -> impl Iterator<Item = (Vec2, Vec2)> + '_ {
    (0..points.len()).map(|i| (points[i], points[(i + 1) % points.len()]))
}

/// Segments that share one box in a [`SegmentIndex`]: few enough that boxes of slanting lines hold little but their line,
/// so that hundreds of lines that cross leave few boxes around a point; enough to keep the tree small.
const RUN: usize = 4;

/// Most runs that one question to a [`SegmentIndex`] looks at. Where more of them lie near a point, only nearer ones are
/// looked at; and only where more of them lie in one spot, such as the feet of hundreds of branches, are some left out.
const MOST_RUNS: usize = 128;

/// An index over the segments of many polylines: which lie within a distance of a point.
pub struct SegmentIndex {
    points: Vec<Vec2>,
    runs: RTree<GeomWithData<Rectangle<[f32; 2]>, Run>>,
}

/// Consecutive segments of one polyline.
#[derive(Clone, Copy)]
struct Run {
    line: u32,
    /// Number of the first segment within its polyline, and how many there are.
    segment: u32,
    segments: u32,
    /// Index of the first point.
    point: u32,
}

/// A segment near a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// Number of the polyline.
    pub line: usize,
    /// Number of the segment within it.
    pub segment: usize,
    /// Share of the segment before the nearest point.
    pub share: f32,
    /// Distance to the nearest point.
    pub distance: f32,
}

impl SegmentIndex {
    /// Indexes polylines by their number.
    pub fn new<'a>(lines: impl Iterator<Item = &'a [Vec2]>) -> Self {
        let (mut points, mut runs) = (Vec::new(), Vec::new());
        for (number, line) in lines.enumerate() {
            for segment in (0..line.len().saturating_sub(1)).step_by(RUN) {
                let held = &line[segment..(segment + RUN + 1).min(line.len())];
                let low = held.iter().copied().fold(Vec2::INFINITY, Vec2::min);
                let high = held.iter().copied().fold(Vec2::NEG_INFINITY, Vec2::max);
                let run = Run {
                    line: number as u32,
                    segment: segment as u32,
                    segments: held.len() as u32 - 1,
                    point: (points.len() + segment) as u32,
                };
                runs.push(GeomWithData::new(Rectangle::from_corners(low.to_array(), high.to_array()), run));
            }
            points.extend_from_slice(line);
        }
        Self { points, runs: RTree::bulk_load(runs) }
    }

    /// The nearest place on every polyline with a segment within `radius` of `p`, by polyline number.
    pub fn within(&self, p: Vec2, radius: f32) -> Vec<Near> {
        let runs = self.runs_near(p, radius);
        let nearest = runs.into_iter().filter_map(|run| self.nearest_in(run, p));
        let mut found: Vec<Near> = nearest.filter(|near| near.distance <= radius).collect();
        found.sort_by(|a, b| {
            a.line.cmp(&b.line).then(a.distance.total_cmp(&b.distance)).then(a.segment.cmp(&b.segment))
        });
        found.dedup_by_key(|n| n.line);
        found
    }

    /// The nearest place over all polylines within `radius` of `p`; ties go to the lowest number.
    pub fn nearest(&self, p: Vec2, radius: f32) -> Option<Near> {
        /// The first look is at this share of the radius; every further one reaches twice as far.
        const FIRST_LOOK: f32 = 1.0 / 64.0;
        let mut reach = FIRST_LOOK * radius;
        loop {
            let runs = self.runs_near(p, reach);
            let places = runs.into_iter().filter_map(|run| self.nearest_in(run, p));
            let nearest = places.min_by(|a, b| {
                a.distance.total_cmp(&b.distance).then((a.line, a.segment).cmp(&(b.line, b.segment)))
            });
            let found = nearest.filter(|near| near.distance <= reach);
            if found.is_some() || reach.is_nan() || reach >= radius {
                return found;
            }
            reach = (2.0 * reach).min(radius);
        }
    }

    /// Runs whose boxes come within `radius` of `p`, or within less where they are too many. Not by a walk from the
    /// nearest on, which opens every box around the point before it gives the first.
    fn runs_near(&self, p: Vec2, mut radius: f32) -> Vec<Run> {
        const LOOKS: usize = 12;
        let mut found = Vec::new();
        for _ in 0..LOOKS {
            let mut nearer = Vec::with_capacity(found.len());
            let around = AABB::from_corners((p - radius).to_array(), (p + radius).to_array());
            let look = self.runs.locate_in_envelope_intersecting_int(around, |run| {
                nearer.push(run.data);
                #[cfg(test)]
                tests::LOOKED_AT.set(tests::LOOKED_AT.get() + 1);
                if nearer.len() > MOST_RUNS { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            // Where nothing is nearer, some of those that were too many are better than none.
            if found.is_empty() || !nearer.is_empty() {
                found = nearer;
            }
            if look.is_continue() {
                break;
            }
            radius *= 0.5;
        }
        found
    }

    /// The nearest place on one run; ties go to the earlier segment.
    fn nearest_in(&self, run: Run, p: Vec2) -> Option<Near> {
        let (first, line) = (run.point as usize, run.line as usize);
        let points = &self.points[first..=first + run.segments as usize];
        let places = points.windows(2).enumerate().map(|(k, w)| {
            let share = super::polyline::nearest_share(w[0], w[1], p, Vec2::dot);
            let distance = p.distance(w[0].lerp(w[1], share));
            Near { line, segment: run.segment as usize + k, share, distance }
        });
        places.min_by(|a, b| a.distance.total_cmp(&b.distance))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::stream;
    use proptest::prelude::*;
    use rand::RngExt;
    use std::cell::Cell;

    thread_local! {
        /// Runs that this thread's questions to indices have looked at.
        pub(super) static LOOKED_AT: Cell<usize> = const { Cell::new(0) };
    }

    fn square() -> Region {
        Region::new(vec![Vec2::ZERO, Vec2::new(4.0, 0.0), Vec2::new(4.0, 4.0), Vec2::new(0.0, 4.0)])
    }

    #[test]
    fn inside_and_outside_of_a_square() {
        let region = square();
        assert!(region.contains(Vec2::new(1.0, 3.9)));
        assert!(!region.contains(Vec2::new(5.0, 2.0)));
        assert!(!region.contains(Vec2::new(2.0, -0.1)));
        assert!(!region.contains(Vec2::NAN));
    }

    #[test]
    fn nearest_boundary_of_a_square() {
        assert_eq!(square().nearest_boundary(Vec2::new(1.0, 2.0)), Some((Vec2::new(0.0, 2.0), 1.0)));
    }

    #[test]
    fn nothing_is_inside_nothing() {
        let region = Region::new(Vec::new());
        assert!(!region.contains(Vec2::ZERO));
        assert_eq!(region.nearest_boundary(Vec2::ZERO), None);
    }

    #[test]
    fn a_zigzag_does_not_fill_every_slab() {
        let n = 2000;
        let tooth = |k: usize| Vec2::new(k as f32, if k.is_multiple_of(2) { 0.0 } else { 100.0 });
        let region = Region::new((0..n).map(tooth).collect());
        assert!(region.slabs.iter().map(Vec::len).sum::<usize>() <= 8 * n);
    }

    #[test]
    fn a_crowd_in_one_spot_gives_its_nearest() {
        let spoke = |k: usize| {
            let along = Vec2::from_angle(k as f32 * 2.4);
            [0.001 * k as f32, 100.0].map(|reach| along * reach)
        };
        let spokes: Vec<[Vec2; 2]> = (0..2_000).map(spoke).collect();
        let index = SegmentIndex::new(spokes.iter().map(<[Vec2; 2]>::as_slice));
        assert_eq!(index.nearest(Vec2::ZERO, 50.0).map(|near| near.line), Some(0));
        let found = index.within(Vec2::ZERO, 50.0);
        assert!(found.len() > 20 && found.iter().all(|near| near.distance < 0.5), "{} spokes", found.len());
    }

    /// Straight lines across a square of side 1000, of many segments each.
    fn crossing_lines(count: usize) -> Vec<Vec<Vec2>> {
        let mut rng = stream(3, "lines", 0);
        let mut place = || Vec2::from_array(std::array::from_fn(|_| rng.random_range(0.0..1000.0)));
        let line = |_| {
            let (from, to) = (place(), place());
            (0..=48).map(|k| from.lerp(to, k as f32 / 48.0)).collect()
        };
        (0..count).map(line).collect()
    }

    #[test]
    fn of_thousands_of_lines_that_cross_everywhere_the_nearest_is_found_in_bounded_work() {
        const QUESTIONS: usize = 100;
        let looked_at = |count: usize| {
            let lines = crossing_lines(count);
            let index = SegmentIndex::new(lines.iter().map(Vec::as_slice));
            LOOKED_AT.set(0);
            for line in &lines[..QUESTIONS] {
                let p = line[0] + Vec2::new(0.5, 0.25);
                let found = index.within(p, 20.0);
                let nearest = found.iter().map(|near| near.distance).fold(f32::INFINITY, f32::min);
                let truly = lines.iter().filter_map(|line| super::super::polyline::nearest(line, p));
                let truly = truly.map(|(distance, _)| distance).fold(f32::INFINITY, f32::min);
                assert!(nearest <= truly + 1e-3, "{nearest} is not {truly}");
            }
            LOOKED_AT.get() / QUESTIONS
        };
        let [few, many] = [1000, 4000].map(looked_at);
        eprintln!("{few} and {many} runs looked at for a question");
        assert!(few.max(many) <= 4 * MOST_RUNS, "{few} and {many} runs for a question");
    }

    proptest! {
        #[test]
        fn runs_agree_with_testing_every_segment(
            corners in prop::collection::vec((-9.0f32..9.0, -9.0f32..9.0), 2..80),
            probe in (-10.0f32..10.0, -10.0f32..10.0),
            radius in 0.5f32..10.0,
        ) {
            let points: Vec<Vec2> = corners.into_iter().map(Vec2::from).collect();
            let lines = [&points[..points.len() / 2], &points[points.len() / 2..]];
            let index = SegmentIndex::new(lines.into_iter());
            let p = Vec2::from(probe);
            let gaps = lines.map(|line| if line.len() < 2 { None } else { super::super::polyline::nearest(line, p) });
            let gap = |i: usize| gaps[i].map_or(f32::INFINITY, |(gap, _)| gap);
            let found = index.within(p, radius);
            for i in 0..2 {
                if (gap(i) - radius).abs() > 1e-3 {
                    prop_assert_eq!(found.iter().any(|near| near.line == i), gap(i) < radius);
                }
            }
            let least = gap(0).min(gap(1));
            let nearest = |radius| index.nearest(p, radius).map_or(f32::INFINITY, |near| near.distance);
            prop_assert!(nearest(40.0) == least || (nearest(40.0) - least).abs() < 1e-4);
            prop_assert!(nearest(0.99 * least).is_infinite() && nearest(1.01 * least + 1e-4).is_finite() == least.is_finite());
        }

        #[test]
        fn slabs_agree_with_testing_every_edge(
            corners in prop::collection::vec((-9.0f32..9.0, -9.0f32..9.0), 3..24),
            probe in (-10.0f32..10.0, -10.0f32..10.0),
        ) {
            let points: Vec<Vec2> = corners.into_iter().map(Vec2::from).collect();
            let p = Vec2::from(probe);
            let crossings = edges(&points)
                .filter(|(a, b)| (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
                .count();
            prop_assert_eq!(Region::new(points).contains(p), crossings % 2 == 1);
        }
    }
}
