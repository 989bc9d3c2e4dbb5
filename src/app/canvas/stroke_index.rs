//! Which strokes are near a place, fast in drawings of ten thousand strokes.
//!
//! An R-tree over boxes of consecutive segments, kept in step with the drawing: strokes are shared, so a stroke that is
//! the same pointer is the same stroke, and only what changed is taken out and put in. Answers are sorted by id.

use super::view::Rect;
use crate::sketch::change::StrokeChange;
use crate::sketch::{Stroke, StrokeId};
use glam::{DVec2, Vec2};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Segments that share one box.
const RUN: usize = 16;

/// Share of the strokes above which building anew is faster than changing.
const REBUILD_SHARE: f64 = 0.25;

/// Most strokes that are added on top without comparing all others by name.
const FEW: usize = 16;

/// Boxes of a stroke's runs, by its id.
type Run = GeomWithData<Rectangle<[f32; 2]>, StrokeId>;

/// An index over the strokes of a drawing.
#[derive(Debug, Default)]
pub struct StrokeIndex {
    /// Whether `order` is what the index holds.
    in_step: bool,
    order: Vec<Arc<Stroke>>,
    strokes: BTreeMap<StrokeId, Arc<Stroke>>,
    runs: RTree<Run>,
}

impl StrokeIndex {
    /// Brings the index in step with the drawing.
    pub fn sync(&mut self, strokes: &[Arc<Stroke>]) {
        let same = self.order.iter().zip(strokes).take_while(|(a, b)| Arc::ptr_eq(a, b)).count();
        if self.in_step && same == self.order.len() && strokes.len() <= same + FEW {
            for stroke in &strokes[same..] {
                self.take_out(stroke.id);
                self.put_in(Arc::clone(stroke));
                self.order.push(Arc::clone(stroke));
            }
            return;
        }
        let now: BTreeMap<StrokeId, &Arc<Stroke>> = strokes.iter().map(|s| (s.id, s)).collect();
        let is_current = |old: &Arc<Stroke>| now.get(&old.id).is_some_and(|new| Arc::ptr_eq(old, new));
        let gone: Vec<StrokeId> = self.strokes.values().filter(|s| !is_current(s)).map(|s| s.id).collect();
        let new: Vec<Arc<Stroke>> = now
            .values()
            .filter(|s| self.strokes.get(&s.id).is_none_or(|old| !Arc::ptr_eq(old, s)))
            .map(|s| Arc::clone(s))
            .collect();
        self.order = strokes.to_vec();
        self.in_step = true;
        if (gone.len() + new.len()) as f64 > REBUILD_SHARE * strokes.len() as f64 {
            self.strokes = now.into_iter().map(|(id, stroke)| (id, Arc::clone(stroke))).collect();
            self.runs = RTree::bulk_load(self.strokes.values().flat_map(|s| runs_of(s)).collect());
            return;
        }
        gone.into_iter().for_each(|id| self.take_out(id));
        new.into_iter().for_each(|stroke| self.put_in(stroke));
    }

    /// Applies a change ahead of the drawing, as for what an eraser removed but has not handed over.
    pub fn apply(&mut self, change: &StrokeChange) {
        // The drawing is no longer what was seen: the next `sync` compares all.
        self.in_step = false;
        match change {
            StrokeChange::Put(stroke) => {
                self.take_out(stroke.id);
                self.put_in(Arc::clone(stroke));
            }
            StrokeChange::Remove(id) => self.take_out(*id),
        }
    }

    /// The stroke of this name.
    pub fn get(&self, id: StrokeId) -> Option<&Arc<Stroke>> {
        self.strokes.get(&id)
    }

    /// Every stroke, by id.
    pub fn strokes(&self) -> impl Iterator<Item = &Arc<Stroke>> {
        self.strokes.values()
    }

    /// Strokes that come within `radius` of the line from `a` to `b`, by id.
    pub fn near_line(&self, a: DVec2, b: DVec2, radius: f64) -> Vec<StrokeId> {
        let (low, high) = (a.min(b) - radius, a.max(b) + radius);
        let mut found = self.in_box(Rect { min: low, max: high });
        found.retain(|id| {
            self.strokes.get(id).is_some_and(|s| segments(s).any(|(p, q)| line_gap(p, q, a, b) <= radius))
        });
        found
    }

    /// Strokes with a box of segments that touches a rectangle, by id: all that touch it, and some that nearly do.
    pub fn in_box(&self, rect: Rect) -> Vec<StrokeId> {
        let is_sound = rect.min.is_finite() && rect.max.is_finite();
        if !is_sound {
            return Vec::new();
        }
        // A millionth more, for what rounding to `f32` takes.
        let slack = 1e-6 * rect.min.abs().max(rect.max.abs()).max_element();
        let corners = [rect.min - slack, rect.max + slack].map(|p| p.as_vec2().to_array());
        let envelope = AABB::from_corners(corners[0], corners[1]);
        let mut found: Vec<StrokeId> =
            self.runs.locate_in_envelope_intersecting(envelope).map(|run| run.data).collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// The stroke nearest to a place within `radius`; ties go to the newer one.
    pub fn nearest(&self, place: DVec2, radius: f64) -> Option<StrokeId> {
        let reach = DVec2::splat(radius);
        let near = self.in_box(Rect { min: place - reach, max: place + reach });
        let gaps = near.into_iter().filter_map(|id| Some((gap(self.strokes.get(&id)?, place), id)));
        let within = gaps.filter(|(gap, _)| *gap <= radius);
        within.min_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1))).map(|(_, id)| id)
    }

    fn take_out(&mut self, id: StrokeId) {
        if let Some(stroke) = self.strokes.remove(&id) {
            for run in runs_of(&stroke) {
                self.runs.remove(&run);
            }
        }
    }

    fn put_in(&mut self, stroke: Arc<Stroke>) {
        runs_of(&stroke).for_each(|run| self.runs.insert(run));
        self.strokes.insert(stroke.id, stroke);
    }
}

/// Boxes of consecutive segments; one for a stroke of a single point.
fn runs_of(stroke: &Stroke) -> impl Iterator<Item = Run> + '_ {
    let points = &stroke.points;
    let firsts = (0..points.len().saturating_sub(1).max(points.len().min(1))).step_by(RUN);
    firsts.map(|first| {
        let held = &points[first..(first + RUN + 1).min(points.len())];
        let low = held.iter().fold(Vec2::INFINITY, |low, p| low.min(p.position));
        let high = held.iter().fold(Vec2::NEG_INFINITY, |high, p| high.max(p.position));
        GeomWithData::new(Rectangle::from_corners(low.to_array(), high.to_array()), stroke.id)
    })
}

/// The segments of a stroke; a single point is a segment without length.
pub(super) fn segments(stroke: &Stroke) -> impl Iterator<Item = (DVec2, DVec2)> + '_ {
    let points = &stroke.points;
    let place = |i: usize| points[i.min(points.len() - 1)].position.as_dvec2();
    let count = points.len().saturating_sub(1).max(points.len().min(1));
    (0..count).map(move |i| (place(i), place(i + 1)))
}

/// Distance from a place to a stroke.
pub(super) fn gap(stroke: &Stroke, place: DVec2) -> f64 {
    segments(stroke).map(|(p, q)| point_gap(place, p, q)).fold(f64::INFINITY, f64::min)
}

/// Distance from a point to a segment.
fn point_gap(place: DVec2, a: DVec2, b: DVec2) -> f64 {
    let (along, squared) = (b - a, (b - a).length_squared());
    let share = if squared > 0.0 { ((place - a).dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
    place.distance(a + along * share)
}

/// Distance between two segments.
fn line_gap(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> f64 {
    let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
    let cross = side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
    if cross {
        return 0.0;
    }
    let gaps = [point_gap(a, c, d), point_gap(b, c, d), point_gap(c, a, b), point_gap(d, a, b)];
    gaps.into_iter().fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sketch::{StrokePoint, Tool};
    use proptest::prelude::*;

    fn stroke(id: StrokeId, places: &[(f32, f32)]) -> Arc<Stroke> {
        let points = places.iter().map(|p| StrokePoint::at(Vec2::from(*p))).collect();
        Arc::new(Stroke { id, tool: Tool::Auto, points, brush: None })
    }

    fn index(strokes: &[Arc<Stroke>]) -> StrokeIndex {
        let mut index = StrokeIndex::default();
        index.sync(strokes);
        index
    }

    #[test]
    fn the_nearest_stroke_is_found_within_reach_only() {
        let index = index(&[stroke(1, &[(0.0, 0.0), (10.0, 0.0)]), stroke(2, &[(5.0, 4.0)])]);
        assert_eq!(index.nearest(DVec2::new(5.0, 1.0), 3.0), Some(1));
        assert_eq!(index.nearest(DVec2::new(5.0, 3.0), 3.0), Some(2));
        assert_eq!(index.nearest(DVec2::new(50.0, 3.0), 3.0), None);
        assert_eq!(index.nearest(DVec2::NAN, 3.0), None);
    }

    #[test]
    fn of_two_equal_strokes_the_newer_is_hit() {
        let index = index(&[stroke(1, &[(0.0, 0.0), (9.0, 0.0)]), stroke(2, &[(0.0, 0.0), (9.0, 0.0)])]);
        assert_eq!(index.nearest(DVec2::ONE, 3.0), Some(2));
    }

    proptest! {
        #[test]
        fn changes_one_by_one_agree_with_building_anew(
            steps in prop::collection::vec((0..12u64, prop::collection::vec((0.0..100.0f32, 0.0..100.0f32), 0..40)), 1..40),
            a in (0.0..100.0f64, 0.0..100.0f64), b in (0.0..100.0f64, 0.0..100.0f64), radius in 0.0..20.0f64
        ) {
            let mut drawing: Vec<Arc<Stroke>> = (100..140).map(|id| stroke(id, &[(id as f32 / 2.0, 50.0)])).collect();
            let mut kept = index(&drawing);
            for (id, places) in steps {
                drawing.retain(|s| s.id != id);
                if !places.is_empty() {
                    drawing.push(stroke(id, &places));
                }
                kept.sync(&drawing);
            }
            let (a, b) = (DVec2::from(a), DVec2::from(b));
            let mut expected: Vec<StrokeId> = drawing.iter()
                .filter(|s| segments(s).any(|(p, q)| line_gap(p, q, a, b) <= radius)).map(|s| s.id).collect();
            expected.sort_unstable();
            prop_assert_eq!(kept.near_line(a, b, radius), expected);
            let gaps = drawing.iter().map(|s| gap(s, a));
            let least = gaps.fold(f64::INFINITY, f64::min);
            let found = kept.nearest(a, radius).map(|id| gap(kept.get(id).unwrap(), a));
            prop_assert_eq!(found, (least <= radius).then_some(least));
        }
    }
}
