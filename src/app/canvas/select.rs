//! The selection: which strokes, and what is done to all of them at once.
//!
//! A lasso takes strokes with most of their points inside (even–odd rule, closed from its end to its beginning); a tap
//! takes the nearest. Every change of the selection is one change of the drawing.

use super::stroke_index::StrokeIndex;
use super::transform::{mirrored, transformed};
use super::view::Rect;
use crate::app::canvas_tool::Mirror;
use crate::geom::region::Region;
use crate::sketch::change::StrokeChange;
use crate::sketch::{Stroke, StrokeId, Tool, limits};
use glam::{DAffine2, DVec2, Vec2};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Share of a stroke's points that must lie inside the lasso.
const MOST_INSIDE: f64 = 0.5;

/// The selected strokes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    ids: BTreeSet<StrokeId>,
}

impl Selection {
    /// Names of the selected strokes.
    pub fn ids(&self) -> &BTreeSet<StrokeId> {
        &self.ids
    }

    /// Whether nothing is selected.
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// Takes these strokes: besides those selected, or instead. Gives whether anything changed.
    pub fn take(&mut self, ids: impl IntoIterator<Item = StrokeId>, besides: bool) -> bool {
        let mut new = if besides { self.ids.clone() } else { BTreeSet::new() };
        new.extend(ids);
        let changed = new != self.ids;
        self.ids = new;
        changed
    }

    /// Selects a stroke that is not selected, and the other way round.
    pub fn toggle(&mut self, id: StrokeId) {
        if !self.ids.remove(&id) {
            self.ids.insert(id);
        }
    }

    /// Drops what is no longer in the drawing. Gives whether anything changed.
    pub fn keep_known(&mut self, index: &StrokeIndex) -> bool {
        let before = self.ids.len();
        self.ids.retain(|id| index.get(*id).is_some());
        self.ids.len() != before
    }

    /// The selected strokes, by id.
    pub fn strokes<'a>(&'a self, index: &'a StrokeIndex) -> impl Iterator<Item = &'a Arc<Stroke>> {
        self.ids.iter().filter_map(|id| index.get(*id))
    }

    /// The box around the selected strokes on the canvas; `None` without any.
    pub fn bounds(&self, index: &StrokeIndex) -> Option<Rect> {
        let mut places = self.strokes(index).flat_map(|s| &s.points).map(|p| p.position);
        let first = places.next()?;
        let (low, high) = places.fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
        Some(Rect { min: low.as_dvec2(), max: high.as_dvec2() })
    }

    /// Moves, scales or turns.
    pub fn transform(&self, index: &StrokeIndex, transform: &DAffine2) -> Vec<StrokeChange> {
        self.strokes(index).map(|s| put(transformed(s, transform))).collect()
    }

    /// Removes.
    pub fn delete(&self, index: &StrokeIndex) -> Vec<StrokeChange> {
        self.strokes(index).map(|s| StrokeChange::Remove(s.id)).collect()
    }

    /// Makes the strokes something else; those that are it already stay out.
    pub fn set_part(&self, index: &StrokeIndex, tool: Tool) -> Vec<StrokeChange> {
        let others = self.strokes(index).filter(|s| s.tool != tool);
        others.map(|s| put(Stroke { id: s.id, tool, points: s.points.clone(), brush: None })).collect()
    }

    /// Mirrors about the middle of the selection.
    pub fn mirror(&self, index: &StrokeIndex, mirror: Mirror) -> Vec<StrokeChange> {
        let Some(bounds) = self.bounds(index) else { return Vec::new() };
        self.strokes(index).map(|s| put(mirrored(s, bounds.center(), mirror))).collect()
    }

    /// Copies the strokes beside themselves and selects the copies.
    pub fn duplicate(
        &mut self,
        index: &StrokeIndex,
        beside: DVec2,
        new_id: &mut dyn FnMut() -> StrokeId,
    ) -> Vec<StrokeChange> {
        let strokes: Vec<Arc<Stroke>> = self.strokes(index).cloned().collect();
        self.put_copies(&strokes, beside, new_id)
    }

    /// Copies of any strokes, moved and under new names, which become the selection.
    pub fn put_copies(
        &mut self,
        strokes: &[Arc<Stroke>],
        shift: DVec2,
        new_id: &mut dyn FnMut() -> StrokeId,
    ) -> Vec<StrokeChange> {
        let shift = DAffine2::from_translation(shift);
        let copy = |s: &Arc<Stroke>| Stroke { id: new_id(), ..transformed(s, &shift) };
        let copies: Vec<Stroke> = strokes.iter().map(copy).collect();
        if !copies.is_empty() {
            self.ids = copies.iter().map(|s| s.id).collect();
        }
        copies.into_iter().map(put).collect()
    }
}

/// Makes one stroke something else, as when a wrong guess is corrected with a tap; `None` where it is that already, or is
/// no more.
pub fn corrected(strokes: &[Arc<Stroke>], id: StrokeId, tool: Tool) -> Option<StrokeChange> {
    let stroke = strokes.iter().find(|s| s.id == id && s.tool != tool)?;
    Some(put(Stroke { id, tool, points: stroke.points.clone(), brush: None }))
}

fn put(stroke: Stroke) -> StrokeChange {
    StrokeChange::Put(Arc::new(stroke))
}

/// Strokes that a lasso takes, by id.
pub fn lassoed(lasso: &[DVec2], index: &StrokeIndex) -> Vec<StrokeId> {
    let most = Vec2::splat(limits::MAX_COORDINATE);
    let outline: Vec<Vec2> = lasso.iter().map(|p| p.as_vec2().clamp(-most, most)).collect();
    if outline.len() < 3 || outline.iter().any(|p| p.is_nan()) {
        return Vec::new();
    }
    let region = Region::new(outline);
    let Some((low, high)) = region.bounds() else { return Vec::new() };
    let near = index.in_box(Rect { min: low.as_dvec2(), max: high.as_dvec2() });
    let is_inside = |stroke: &Arc<Stroke>| {
        let inside = stroke.points.iter().filter(|p| region.contains(p.position)).count();
        inside as f64 > MOST_INSIDE * stroke.points.len() as f64
    };
    near.into_iter().filter(|id| index.get(*id).is_some_and(is_inside)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sketch::StrokePoint;
    use proptest::prelude::*;

    fn index() -> StrokeIndex {
        let line = |id: StrokeId, x: f32| {
            let points = (0..10).map(|i| StrokePoint::at(Vec2::new(x, i as f32 * 10.0))).collect();
            Arc::new(Stroke { id, tool: Tool::Auto, points, brush: None })
        };
        let mut index = StrokeIndex::default();
        index.sync(&[line(1, 0.0), line(2, 50.0), line(3, 100.0)]);
        index
    }

    fn lasso(low: (f64, f64), high: (f64, f64)) -> Vec<DVec2> {
        Rect::new(DVec2::from(low), DVec2::from(high)).corners().to_vec()
    }

    #[test]
    fn a_lasso_takes_strokes_with_most_points_inside() {
        assert_eq!(lassoed(&lasso((-10.0, -5.0), (60.0, 55.0)), &index()), [1, 2]);
        assert!(lassoed(&lasso((-10.0, -5.0), (60.0, 44.0)), &index()).is_empty());
        assert!(lassoed(&[DVec2::ZERO, DVec2::ONE], &index()).is_empty());
    }

    #[test]
    fn copies_are_selected_and_lie_beside() {
        let (index, mut selection) = (index(), Selection::default());
        selection.take([1, 3], false);
        let mut next = 9;
        let changes = selection.duplicate(&index, DVec2::new(5.0, 0.0), &mut || {
            next += 1;
            next
        });
        assert_eq!(selection.ids().iter().copied().collect::<Vec<_>>(), [10, 11]);
        let StrokeChange::Put(copy) = &changes[1] else { panic!("{changes:?}") };
        assert_eq!((copy.id, copy.points[0].position), (11, Vec2::new(105.0, 0.0)));
    }

    #[test]
    fn changes_name_selected_strokes_only() {
        let (index, mut selection) = (index(), Selection::default());
        assert!(selection.take([2, 77], false));
        assert!(selection.keep_known(&index));
        assert_eq!(selection.delete(&index), [StrokeChange::Remove(2)]);
        assert!(selection.set_part(&index, Tool::Auto).is_empty());
        let StrokeChange::Put(leaf) = &selection.set_part(&index, Tool::Leaf)[0] else { panic!() };
        assert_eq!((leaf.id, leaf.tool), (2, Tool::Leaf));
        selection.toggle(2);
        assert!(selection.is_empty() && selection.bounds(&index).is_none());
    }

    #[test]
    fn one_stroke_is_corrected_by_its_name() {
        let strokes: Vec<_> = index().strokes().cloned().collect();
        let Some(StrokeChange::Put(petal)) = corrected(&strokes, 2, Tool::Petal) else { panic!() };
        assert_eq!((petal.id, petal.tool, &petal.points), (2, Tool::Petal, &strokes[1].points));
        assert_eq!(corrected(&strokes, 2, Tool::Auto), None);
        assert_eq!(corrected(&strokes, 77, Tool::Petal), None);
    }

    proptest! {
        #[test]
        fn hostile_lassos_do_no_harm(places in prop::collection::vec((any::<f64>(), any::<f64>()), 0..20)) {
            let lasso: Vec<DVec2> = places.into_iter().map(DVec2::from).collect();
            prop_assert!(lassoed(&lasso, &index()).len() <= 3);
        }
    }
}
