//! An index over the segments of many polylines: which of them lie near a point.
//!
//! For many questions there is an R-tree over short runs of segments. For a few its making would cost more than it saves:
//! then the boxes of all lines are looked at in turn, and the tree is made only if a question finds a crowd, or after all there
//! are many. Both give the same answers.

use super::polyline;
use glam::Vec2;
use rstar::{
    AABB, RTree,
    primitives::{GeomWithData, Rectangle},
};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};

/// Segments that share one box: few enough that boxes of slanting lines hold little but their line,
/// so that hundreds of lines that cross leave few boxes around a point; enough to keep the tree small.
const RUN: usize = 4;

/// Most runs that one question looks at. Where more of them lie near a point, only nearer ones are
/// looked at; and only where more of them lie in one spot, such as the feet of hundreds of branches, are some left out.
const MOST_RUNS: usize = 128;

/// Boxes of lines that are looked at in the time that a run takes on its way into the tree.
const LOOKS_PER_RUN: usize = 16;

/// Smallest and largest corner.
type Bounds = (Vec2, Vec2);

/// A polyline with what is asked of it again and again.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Its points.
    pub points: Vec<Vec2>,
    /// Arc length from the first point to every point.
    pub arcs: Vec<f32>,
    /// Smallest and largest corner; those of nothing for less than two points.
    pub bounds: Bounds,
    /// Boxes of its runs.
    runs: Vec<Bounds>,
}

/// An index over the segments of many polylines: which lie within a distance of a point.
pub struct SegmentIndex {
    lines: Vec<Arc<Line>>,
    bounds: Vec<Bounds>,
    tree: OnceLock<RTree<GeomWithData<Rectangle<[f32; 2]>, Run>>>,
    /// Boxes that may be looked at before a tree is worth its making, and those that were.
    patience: usize,
    looks: AtomicUsize,
}

/// Consecutive segments of one polyline.
#[derive(Clone, Copy)]
struct Run {
    line: u32,
    /// Number of the first segment within its polyline.
    segment: u32,
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

/// Whether two boxes have a point in common.
fn touch(a: &Bounds, b: &Bounds) -> bool {
    a.0.cmple(b.1).all() && a.1.cmpge(b.0).all()
}

/// The box around a disc.
fn around(p: Vec2, radius: f32) -> Bounds {
    (p - radius, p + radius)
}

impl Line {
    /// Measures a polyline.
    pub fn new(points: impl Iterator<Item = Vec2>) -> Self {
        let points: Vec<Vec2> = points.collect();
        let bounds_of = |points: &[Vec2]| {
            let nothing = (Vec2::INFINITY, Vec2::NEG_INFINITY);
            points.iter().fold(nothing, |(low, high), p| (low.min(*p), high.max(*p)))
        };
        let first_of_runs = (0..points.len().saturating_sub(1)).step_by(RUN);
        let runs: Vec<Bounds> =
            first_of_runs.map(|first| bounds_of(&points[first..points.len().min(first + RUN + 1)])).collect();
        let all = if runs.is_empty() { &[] } else { &points[..] };
        Self { arcs: polyline::arc_lengths(points.iter().copied()), bounds: bounds_of(all), runs, points }
    }

    /// Length of the whole line.
    pub fn length(&self) -> f32 {
        self.arcs.last().copied().unwrap_or(0.0)
    }

    /// Whether some of the line may lie within `radius` of `p`: all that could change an answer about them.
    pub fn may_be_within(&self, p: Vec2, radius: f32) -> bool {
        touch(&self.bounds, &around(p, radius))
    }
}

impl SegmentIndex {
    /// Indexes polylines by their number, for at least so many questions.
    pub fn new(lines: Vec<Arc<Line>>, questions: usize) -> Self {
        let bounds: Vec<Bounds> = lines.iter().map(|line| line.bounds).collect();
        let patience = LOOKS_PER_RUN * lines.iter().map(|line| line.runs.len()).sum::<usize>();
        let index = Self { lines, bounds, tree: OnceLock::new(), patience, looks: AtomicUsize::new(0) };
        if questions.saturating_mul(index.lines.len()) > patience {
            index.tree();
        }
        index
    }

    fn tree(&self) -> &RTree<GeomWithData<Rectangle<[f32; 2]>, Run>> {
        let of_line = |(number, line): (usize, &Arc<Line>)| {
            let run = move |(k, (low, high)): (usize, &Bounds)| {
                let run = Run { line: number as u32, segment: (k * RUN) as u32 };
                GeomWithData::new(Rectangle::from_corners(low.to_array(), high.to_array()), run)
            };
            line.runs.iter().enumerate().map(run).collect::<Vec<_>>()
        };
        self.tree.get_or_init(|| RTree::bulk_load(self.lines.iter().enumerate().flat_map(of_line).collect()))
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

    /// Runs whose boxes come within `radius` of `p`, or within less where they are too many.
    fn runs_near(&self, p: Vec2, radius: f32) -> Vec<Run> {
        let is_early = || self.looks.fetch_add(self.lines.len(), Ordering::Relaxed) < self.patience;
        let few = if self.tree.get().is_none() && is_early() { self.few_runs_near(p, radius) } else { None };
        few.unwrap_or_else(|| self.runs_in_tree(p, radius))
    }

    /// The same without the tree; `None` where they are too many.
    fn few_runs_near(&self, p: Vec2, radius: f32) -> Option<Vec<Run>> {
        let around = around(p, radius);
        let mut found = Vec::new();
        for (number, bounds) in self.bounds.iter().enumerate() {
            if !touch(bounds, &around) {
                continue;
            }
            for (k, bounds) in self.lines[number].runs.iter().enumerate() {
                if touch(bounds, &around) {
                    found.push(Run { line: number as u32, segment: (k * RUN) as u32 });
                }
            }
            if found.len() > MOST_RUNS {
                return None;
            }
        }
        Some(found)
    }

    /// Not by a walk from the nearest on, which opens every box around the point before it gives the first.
    fn runs_in_tree(&self, p: Vec2, mut radius: f32) -> Vec<Run> {
        const LOOKS: usize = 12;
        let tree = self.tree();
        let mut found = Vec::new();
        for _ in 0..LOOKS {
            let mut nearer = Vec::with_capacity(found.len());
            let (low, high) = around(p, radius);
            let around = AABB::from_corners(low.to_array(), high.to_array());
            let look = tree.locate_in_envelope_intersecting_int(around, |run| {
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
        let (line, first) = (run.line as usize, run.segment as usize);
        let points = &self.lines[line].points;
        let points = &points[first..points.len().min(first + RUN + 1)];
        let places = points.windows(2).enumerate().map(|(k, w)| {
            let share = polyline::nearest_share(w[0], w[1], p, Vec2::dot);
            let distance = p.distance(w[0].lerp(w[1], share));
            Near { line, segment: first + k, share, distance }
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

    fn index(lines: impl Iterator<Item = Vec<Vec2>>) -> SegmentIndex {
        SegmentIndex::new(lines.map(|line| Arc::new(Line::new(line.into_iter()))).collect(), 1)
    }

    #[test]
    fn a_crowd_in_one_spot_gives_its_nearest() {
        let spoke = |k: usize| {
            let along = Vec2::from_angle(k as f32 * 2.4);
            [0.001 * k as f32, 100.0].map(|reach| along * reach)
        };
        let index = index((0..2_000).map(|k| spoke(k).to_vec()));
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
            let index = index(lines.iter().cloned());
            LOOKED_AT.set(0);
            for line in &lines[..QUESTIONS] {
                let p = line[0] + Vec2::new(0.5, 0.25);
                let found = index.within(p, 20.0);
                let nearest = found.iter().map(|near| near.distance).fold(f32::INFINITY, f32::min);
                let truly = lines.iter().filter_map(|line| polyline::nearest(line, p));
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
            let index = index(lines.into_iter().map(<[Vec2]>::to_vec));
            let p = Vec2::from(probe);
            let gaps = lines.map(|line| if line.len() < 2 { None } else { polyline::nearest(line, p) });
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
        fn few_questions_are_answered_like_many(
            corners in prop::collection::vec((-9i8..9, -9i8..9), 2..400),
            probes in prop::collection::vec((-10i8..10, -10i8..10), 1..8),
            radius in 0.5f32..10.0,
        ) {
            let place = |(x, y): &(i8, i8)| Vec2::new((*x).into(), (*y).into());
            let points: Vec<Vec2> = corners.iter().map(place).collect();
            let lines: Vec<Arc<Line>> =
                points.chunks(7).map(|line| Arc::new(Line::new(line.iter().copied()))).collect();
            let [few, many] = [1, usize::MAX].map(|questions| SegmentIndex::new(lines.clone(), questions));
            prop_assert!(few.tree.get().is_none() && many.tree.get().is_some());
            for p in probes.iter().map(place) {
                prop_assert_eq!(few.within(p, radius), many.within(p, radius));
                prop_assert_eq!(few.nearest(p, radius), many.nearest(p, radius));
            }
        }
    }
}
