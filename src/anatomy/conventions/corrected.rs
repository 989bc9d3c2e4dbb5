//! Hypotheses as the artist corrected them: which are left out, which are taken whatever speaks against them.
//!
//! A [`Correction`] holds for the hypotheses that are about its strokes: those that have more than half of the smaller of both sets in
//! common with it, counted over strokes that are there and may be read otherwise than by themselves. What the artist says
//! strokes are is preferred by a bonus that no evidence outweighs, the more the better its strokes fit those that were meant.

use super::Hypothesis;
use super::page::Page;
use crate::sketch::corrections::shares_most;
use crate::sketch::{Correction, Stroke, StrokeId, Verdict};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::Arc;

/// What speaks for a hypothesis that the artist chose and that has the very strokes that were meant, log-odds.
const CHOSEN: f32 = 1000.0;

/// The corrections of a drawing, by lines of its page.
pub(super) struct Corrected {
    verdicts: Vec<Verdict>,
    /// How many lines each correction is about.
    sizes: Vec<usize>,
    /// Of every line, which corrections are about it, ascending.
    of_line: Vec<Vec<usize>>,
}

impl Corrected {
    /// The corrections as they concern the lines of a page of these strokes.
    pub(super) fn on(page: &Page, strokes: &[Arc<Stroke>], corrections: &[Correction]) -> Self {
        Self::on_lines(page, corrections, |stroke| vec![strokes[stroke].id])
    }

    /// The same where a stroke of the page may stand for several of the drawing, which `names` gives.
    pub(super) fn on_lines(
        page: &Page,
        corrections: &[Correction],
        names: impl Fn(usize) -> Vec<StrokeId>,
    ) -> Self {
        let verdicts = corrections.iter().map(|correction| correction.verdict).collect();
        let mut it = Self { verdicts, sizes: vec![0; corrections.len()], of_line: Vec::new() };
        if corrections.is_empty() {
            return it;
        }
        let lines = page.lines.iter().enumerate();
        let lines = lines.flat_map(|(i, line)| names(line.stroke).into_iter().map(move |name| (name, i)));
        let lines: HashMap<StrokeId, usize> = lines.collect();
        it.of_line = vec![Vec::new(); page.lines.len()];
        for (number, correction) in corrections.iter().enumerate() {
            let concerned = correction.strokes.iter().filter_map(|stroke| lines.get(stroke).copied());
            for line in concerned.collect::<BTreeSet<usize>>() {
                it.of_line[line].push(number);
                it.sizes[number] += 1;
            }
        }
        it
    }

    /// The hypotheses that the corrections leave, with the scores that they give them.
    pub(super) fn apply(&self, hypotheses: &mut Vec<Hypothesis>) {
        if self.of_line.is_empty() {
            return;
        }
        hypotheses.retain_mut(|hypothesis| match self.bonus(hypothesis) {
            Some(bonus) => {
                // What the artist chose is taken even if little spoke for it.
                hypothesis.score =
                    if bonus > 0.0 { hypothesis.score.max(0.0) + bonus } else { hypothesis.score };
                true
            }
            None => false,
        });
    }

    /// What corrections add to a hypothesis; nothing if they leave it out.
    fn bonus(&self, hypothesis: &Hypothesis) -> Option<f32> {
        let mut shared: BTreeMap<usize, usize> = BTreeMap::new();
        let concerned = hypothesis.uses.iter().flat_map(|line| &self.of_line[*line]);
        concerned.for_each(|number| *shared.entry(*number).or_default() += 1);
        let size = hypothesis.uses.len();
        let mut bonus = 0.0_f32;
        for (number, shared) in shared {
            let is_about = shares_most(shared, self.sizes[number], size);
            match self.verdicts[number] {
                Verdict::Separate => return None,
                Verdict::Not(reading) if is_about && reading == hypothesis.reading => return None,
                Verdict::As(reading) if is_about && reading != hypothesis.reading => return None,
                Verdict::As(_) if is_about => {
                    let fit = shared as f32 / (self.sizes[number] + size - shared) as f32;
                    // Squared: parts of what was meant are less, all together, than the whole.
                    bonus = bonus.max(CHOSEN * fit * fit);
                }
                Verdict::Not(_) | Verdict::As(_) => {}
            }
        }
        Some(bonus)
    }
}
