//! The open drawing: a [`Sketch`] that changes step by step and can go back and forth without limit.
//!
//! [`Document::apply`] takes a [`Change`] and makes a [`Step`] of it, which undo carries out backwards. Steps are what
//! the journal writes. Whatever a document accepts can be saved and read back: changes that could not are refused with
//! a reason, samples of a stroke that are no numbers are left out. An empty sheet is a document as well.

use super::change::{Change, StrokeChange};
use super::sound;
use super::step::{Step, Swap};
use super::{PartName, PartPose, Sketch, Stroke, StrokeId, limits};
use std::collections::BTreeSet;
use std::sync::Arc;

pub use super::sound::ChangeError;

/// Which settings a merging change belongs to, so that one drag of one slider is one step.
pub type MergeKey = String;

/// A state that a document was in, to be marked later as the one saved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SavePoint(u64);

/// An open drawing with its history.
#[derive(Debug)]
pub struct Document {
    sketch: Sketch,
    undo: Vec<Entry>,
    redo: Vec<Entry>,
    /// Samples in all strokes.
    samples: usize,
    /// Largest id ever seen; ids are not used twice, so that nobody takes a new stroke for an old one.
    last_id: StrokeId,
    revision: u64,
    /// The state now, and the one that was saved. Undo comes back to the number a state had.
    state: u64,
    saved_state: Option<u64>,
    newest_state: u64,
}

#[derive(Debug)]
struct Entry {
    step: Arc<Step>,
    /// Set while the next change with this key may still join.
    key: Option<MergeKey>,
    state_before: u64,
    state_after: u64,
}

impl Document {
    /// Opens a drawing that is as it is on disk.
    pub fn new(sketch: Sketch) -> Self {
        let samples = sketch.strokes.iter().map(|s| s.points.len()).sum();
        // Corrections, shapes and poses may name strokes that were removed; no new stroke is taken for one of them.
        let corrected = sketch.corrections.iter().filter_map(|correction| correction.strokes.last());
        let shaped = sketch.petal_shapes.iter().filter_map(|shape| shape.strokes.last());
        let ids = sketch.strokes.iter().map(|s| &s.id).chain(corrected).chain(shaped);
        let drawn = |pose: &PartPose| match pose.part {
            PartName::Stroke(stroke) => Some(stroke),
            PartName::Grown(_) => None,
        };
        let ids = ids.copied().chain(sketch.part_poses.iter().filter_map(drawn));
        let last_id = ids.max().unwrap_or(0);
        Self {
            sketch,
            undo: Vec::new(),
            redo: Vec::new(),
            samples,
            last_id,
            revision: 0,
            state: 0,
            saved_state: Some(0),
            newest_state: 0,
        }
    }

    /// An empty sheet.
    pub fn empty() -> Self {
        Self::new(Sketch::empty())
    }

    /// A drawing that differs from what is on disk, such as a recovered one.
    pub fn unsaved(sketch: Sketch) -> Self {
        Self { saved_state: None, ..Self::new(sketch) }
    }

    /// The drawing as it is now. A clone of it is cheap and stays as it is.
    pub fn sketch(&self) -> &Sketch {
        &self.sketch
    }

    /// Carries out a change as one undoable step; `None` if it changes nothing.
    ///
    /// # Errors
    /// A change after which the drawing could not be saved and read again; nothing has changed then.
    pub fn apply(&mut self, change: Change) -> Result<Option<Arc<Step>>, ChangeError> {
        self.change(change, None)
    }

    /// As [`Document::apply`], but joins the step before if that was merging under the same key: a slider being
    /// dragged, a selection being moved. What it returns is this change alone.
    ///
    /// # Errors
    /// As [`Document::apply`].
    pub fn apply_merging(&mut self, change: Change, key: &str) -> Result<Option<Arc<Step>>, ChangeError> {
        self.change(change, Some(key))
    }

    /// Ends merging: the next change is a step of its own. Call it when a slider is let go.
    pub fn end_merging(&mut self) {
        if let Some(last) = self.undo.last_mut() {
            last.key = None;
        }
    }

    fn change(&mut self, change: Change, key: Option<&str>) -> Result<Option<Arc<Step>>, ChangeError> {
        let change = sound::made_sound(change)?;
        let step = self.tried(change)?;
        if step.is_empty() {
            return Ok(None);
        }
        let step = Arc::new(step);
        self.newest_state += 1;
        let (state_before, state_after) = (self.state, self.newest_state);
        let joins = key.is_some()
            && self.redo.is_empty()
            && self.undo.last().is_some_and(|e| e.key.as_deref() == key);
        self.redo.clear();
        self.count(&step, state_after);
        match self.undo.last_mut().filter(|_| joins) {
            Some(last) => {
                let first = std::mem::take(&mut last.step);
                last.step = Arc::new(Arc::unwrap_or_clone(first).then((*step).clone()));
                last.state_after = state_after;
            }
            None => {
                self.end_merging();
                let key = key.map(str::to_owned);
                self.undo.push(Entry { step: step.clone(), key, state_before, state_after });
            }
        }
        Ok(Some(step))
    }

    /// Takes back the last step; returns what that did to the drawing, `None` at the beginning.
    pub fn undo(&mut self) -> Option<Arc<Step>> {
        let mut entry = self.undo.pop()?;
        entry.key = None;
        let back = Arc::new(entry.step.reversed());
        back.carry_out(&mut self.sketch);
        self.count(&back, entry.state_before);
        self.end_merging();
        self.redo.push(entry);
        Some(back)
    }

    /// Does again what was taken back last; returns what that did to the drawing, `None` at the end.
    pub fn redo(&mut self) -> Option<Arc<Step>> {
        let entry = self.redo.pop()?;
        let step = entry.step.clone();
        step.carry_out(&mut self.sketch);
        self.count(&step, entry.state_after);
        self.undo.push(entry);
        Some(step)
    }

    /// Whether there is a step to take back.
    pub fn can_undo(&self) -> bool {
        !self.undo.is_empty()
    }

    /// Whether there is a step to do again.
    pub fn can_redo(&self) -> bool {
        !self.redo.is_empty()
    }

    /// Counts up with every change, undo and redo: two equal numbers mean the same drawing.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// An id for the next new stroke; never that of a stroke that was ever in this document.
    pub fn next_id(&self) -> StrokeId {
        match self.last_id.checked_add(1) {
            Some(id) => id,
            // A file may have used up the largest number; then holes are filled.
            None => {
                let used: BTreeSet<StrokeId> = self.ids_in_history().collect();
                (1..).find(|id| !used.contains(id)).unwrap_or(0)
            }
        }
    }

    /// Whether the drawing is as it was saved, also if undo came back to that.
    pub fn is_saved(&self) -> bool {
        self.saved_state == Some(self.state)
    }

    /// Says that the drawing is on disk as it is now.
    pub fn mark_saved(&mut self) {
        self.mark_saved_at(self.save_point());
    }

    /// The state as it is now, for saving beside the drawing.
    pub fn save_point(&self) -> SavePoint {
        SavePoint(self.state)
    }

    /// Says that the drawing is on disk as it was then.
    pub fn mark_saved_at(&mut self, point: SavePoint) {
        self.saved_state = Some(point.0);
        self.end_merging();
    }

    /// Takes note of a step that was carried out and led to `state`.
    fn count(&mut self, step: &Step, state: u64) {
        self.samples = samples_after(self.samples, &step.strokes);
        let ids = step.strokes.iter().filter_map(|swap| swap.after.as_ref()).map(|stroke| stroke.id);
        self.last_id = ids.fold(self.last_id, StrokeId::max);
        self.state = state;
        self.revision += 1;
    }

    /// Carries out `change` and says what it did, or leaves everything as it was.
    fn tried(&mut self, change: Change) -> Result<Step, ChangeError> {
        let Change { strokes: changes, settings } = change;
        let (before, after) = settings.against(&self.sketch);
        let strokes_before = self.sketch.strokes.len();
        let step = Step { strokes: self.swapped(changes), before, after };
        if let Err(full) = self.check_room(strokes_before, &step.strokes) {
            Step { strokes: step.strokes, ..Step::default() }.reversed().carry_out(&mut self.sketch);
            return Err(full);
        }
        step.after.carry_out(&mut self.sketch);
        Ok(step)
    }

    /// Whether the drawing can still be read after `swaps`; what only shrinks is welcome in one that is too large.
    fn check_room(&self, strokes_before: usize, swaps: &[Swap]) -> Result<(), ChangeError> {
        let (samples, strokes) = (samples_after(self.samples, swaps), self.sketch.strokes.len());
        if samples > limits::MAX_POINTS && samples > self.samples {
            return Err(ChangeError::Full { what: "points", limit: limits::MAX_POINTS });
        }
        if strokes > limits::MAX_STROKES && strokes > strokes_before {
            return Err(ChangeError::Full { what: "strokes", limit: limits::MAX_STROKES });
        }
        Ok(())
    }

    /// Changes the strokes, and returns what lay where before and after.
    fn swapped(&mut self, changes: Vec<StrokeChange>) -> Vec<Swap> {
        let strokes = &mut self.sketch.strokes;
        let (mut hint, mut newest) = (0, self.last_id);
        let mut swaps = Vec::with_capacity(changes.len());
        for change in changes {
            let (id, after) = match change {
                StrokeChange::Put(stroke) => (stroke.id, Some(stroke)),
                StrokeChange::Remove(id) => (id, None),
            };
            let found = if id > newest { None } else { place_of(id, strokes, hint) };
            newest = newest.max(id);
            let at = found.unwrap_or(strokes.len());
            let before = found.map(|at| strokes[at].clone());
            let swap = Swap { at, before, after };
            if swap.before != swap.after && swap.carry_out(strokes) {
                swaps.push(swap);
            }
            hint = at;
        }
        swaps
    }

    fn ids_in_history(&self) -> impl Iterator<Item = StrokeId> {
        let steps = self.undo.iter().chain(&self.redo).flat_map(|entry| &entry.step.strokes);
        let past = steps.flat_map(|swap| [&swap.before, &swap.after]).flatten();
        self.sketch.strokes.iter().chain(past).map(|stroke| stroke.id)
    }
}

/// Samples in a drawing that had `samples`, after `swaps`.
fn samples_after(samples: usize, swaps: &[Swap]) -> usize {
    let count = |stroke: &Option<Arc<Stroke>>| stroke.as_ref().map_or(0, |s| s.points.len());
    swaps.iter().fold(samples, |sum, swap| (sum + count(&swap.after)).saturating_sub(count(&swap.before)))
}

/// Where the stroke with this id lies; looks around `hint` first, for changes mostly come in order.
fn place_of(id: StrokeId, strokes: &[Arc<Stroke>], hint: usize) -> Option<usize> {
    let hint = hint.min(strokes.len());
    let is_it = |stroke: &Arc<Stroke>| stroke.id == id;
    let behind = strokes[hint..].iter().position(is_it).map(|at| hint + at);
    behind.or_else(|| strokes[..hint].iter().rposition(is_it))
}

#[cfg(test)]
#[path = "document_tests.rs"]
mod tests;
