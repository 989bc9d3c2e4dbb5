//! One step of a drawing's history: what was before and what came after, for exactly what changed.
//!
//! A step can be carried out, and turned round to take it back; strokes are shared, so both sides together cost as
//! much memory as the change itself. Strokes are named by their place, which brings a removed stroke back to where it
//! lay. A step fits the state it was made for and, reversed, the state it led to.

use super::settings::Settings;
use super::{Sketch, Stroke};
use std::sync::Arc;

/// One stroke before and after; a new one was nothing before, a removed one is nothing after.
#[derive(Clone, Debug, PartialEq)]
pub struct Swap {
    /// Place in the order of strokes, from 0.
    pub at: usize,
    /// What lay there.
    pub before: Option<Arc<Stroke>>,
    /// What lies there now.
    pub after: Option<Arc<Stroke>>,
}

impl Swap {
    fn reversed(&self) -> Self {
        Self { at: self.at, before: self.after.clone(), after: self.before.clone() }
    }

    fn replaces(&self) -> bool {
        self.before.is_some() && self.after.is_some()
    }

    /// Does it to a list of strokes; `false`, and nothing done, where the list has no such place.
    pub(super) fn carry_out(&self, strokes: &mut Vec<Arc<Stroke>>) -> bool {
        match (&self.before, &self.after) {
            (Some(_), Some(after)) => {
                let Some(place) = strokes.get_mut(self.at) else { return false };
                *place = after.clone();
            }
            (None, Some(_)) if self.at > strokes.len() => return false,
            (None, Some(after)) => strokes.insert(self.at, after.clone()),
            (Some(_), None) if self.at >= strokes.len() => return false,
            (Some(_), None) => drop(strokes.remove(self.at)),
            (None, None) => {}
        }
        true
    }
}

/// A change that was carried out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Step {
    /// Strokes, in the order in which they changed.
    pub strokes: Vec<Swap>,
    /// Settings before.
    pub before: Settings,
    /// The same settings after.
    pub after: Settings,
}

impl Step {
    /// Whether nothing is different after it.
    pub fn is_empty(&self) -> bool {
        self.strokes.is_empty() && self.after == Settings::default()
    }

    /// The step that takes this one back.
    pub fn reversed(&self) -> Self {
        Self {
            strokes: self.strokes.iter().rev().map(Swap::reversed).collect(),
            before: self.after.clone(),
            after: self.before.clone(),
        }
    }

    /// Does it to a sketch in the state that the step was made for.
    pub fn carry_out(&self, sketch: &mut Sketch) {
        for swap in &self.strokes {
            let fits = swap.carry_out(&mut sketch.strokes);
            debug_assert!(fits, "a step was carried out on a drawing that it was not made for");
        }
        self.after.carry_out(sketch);
    }

    /// Samples that the step brings; a measure of what it costs to write down.
    pub fn samples(&self) -> usize {
        self.strokes.iter().filter_map(|swap| swap.after.as_ref()).map(|stroke| stroke.points.len()).sum()
    }

    /// This step and the one after it as one.
    pub(super) fn then(self, next: Step) -> Self {
        let mut strokes = self.strokes;
        let same_places = strokes.len() == next.strokes.len()
            && strokes.iter().zip(&next.strokes).all(|(a, b)| a.at == b.at && a.replaces() && b.replaces());
        if same_places {
            // Moved again: what lay between is not kept, so that a long drag costs no more than a short one.
            strokes.iter_mut().zip(next.strokes).for_each(|(first, second)| first.after = second.after);
        } else {
            strokes.extend(next.strokes);
        }
        Self { strokes, before: self.before.or(next.before), after: next.after.or(self.after) }
    }
}
