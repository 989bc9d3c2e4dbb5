//! In which other ways some strokes could be read: what is offered to an artist who says that they are something else.
//!
//! Every reading that is proposed for the strokes, the likeliest first, whatever was said of them before; once as the drawing
//! stands and once without the pot, ground, sun or fence that hides them. Last comes that each stroke is a part by itself. Nothing of it
//! is computed while a drawing grows, only when somebody asks.

use super::{ConventionParams, Hypothesis, Memory, proposals};
use crate::sketch::corrections::{corrected, shares_most};
use crate::sketch::{Correction, Reading, Sketch, StrokeId, Verdict};

/// Most readings that are offered beside that each stroke is a part by itself.
const MOST: usize = 3;

/// What could be said of some strokes of a drawing, each another reading of them, the likeliest first.
pub fn alternatives(sketch: &Sketch, params: &ConventionParams, about: &[StrokeId]) -> Vec<Correction> {
    let separate = Correction::new(about.iter().copied(), Verdict::Separate);
    if !params.enabled {
        return vec![separate];
    }
    // As if nothing had been said of these strokes.
    let ids = || sketch.strokes.iter().map(|stroke| stroke.id);
    let mut corrections = corrected(&sketch.corrections, separate.clone(), ids()).to_vec();
    corrections.pop();
    // What is read of other plants stays the same.
    let mut known = Memory::default();
    let mut found = readings_of(&mut known, sketch, &corrections, about);
    let hidden_by =
        [Reading::Pot, Reading::Ground, Reading::Sun, Reading::Frame, Reading::Sky, Reading::Writing]
            .map(Verdict::Not);
    corrections.extend(hidden_by.map(|verdict| Correction::new(about.iter().copied(), verdict)));
    found.extend(readings_of(&mut known, sketch, &corrections, about));
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut offered: Vec<Correction> = Vec::new();
    for (_, correction) in found {
        if offered.iter().all(|other| other.verdict != correction.verdict) {
            offered.push(correction);
        }
    }
    offered.truncate(MOST);
    offered.push(separate);
    offered
}

/// The readings of these strokes that are proposed, with their scores.
fn readings_of(
    known: &mut Memory,
    sketch: &Sketch,
    corrections: &[Correction],
    about: &[StrokeId],
) -> Vec<(f32, Correction)> {
    let proposals = proposals(known, &sketch.strokes, corrections);
    let correction = |h: Hypothesis| {
        let strokes: Vec<StrokeId> = h.uses.iter().map(|stroke| sketch.strokes[*stroke].id).collect();
        let shared = strokes.iter().filter(|stroke| about.contains(stroke)).count();
        let is_about = h.score > 0.0 && shares_most(shared, strokes.len(), about.len());
        is_about.then(|| (h.score, Correction::new(strokes, Verdict::As(h.reading))))
    };
    proposals.into_iter().filter_map(correction).collect()
}
