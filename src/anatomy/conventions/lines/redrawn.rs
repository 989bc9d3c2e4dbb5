//! A drawing with some of its strokes put together: its lines, and which strokes each consists of.

use crate::anatomy::conventions::hypothesis::{Hypothesis, Made};
use crate::anatomy::conventions::page::Page;
use crate::sketch::{Reading, Stroke, Tool};
use std::sync::Arc;

/// A drawing with some of its strokes put together.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Redrawn {
    /// Its lines, as strokes, in the order of the first stroke of each and with its name.
    pub strokes: Vec<Arc<Stroke>>,
    /// Which strokes of the drawing each consists of, ascending.
    pub members: Vec<Vec<usize>>,
    /// Which of them are not as drawn, ascending.
    pub changed: Vec<usize>,
}

impl Redrawn {
    /// A drawing as it is.
    pub(crate) fn untouched(strokes: &[Arc<Stroke>]) -> Self {
        let members = (0..strokes.len()).map(|stroke| vec![stroke]).collect();
        Self { strokes: strokes.to_vec(), members, changed: Vec::new() }
    }

    /// A drawing in which these lines stand for the strokes they consist of, each ascending.
    pub(super) fn of(strokes: &[Arc<Stroke>], mut lines: Vec<(Vec<usize>, Arc<Stroke>)>) -> Self {
        lines.sort_by_key(|(members, _)| members[0]);
        let mut is_member = vec![false; strokes.len()];
        lines.iter().flat_map(|(members, _)| members).for_each(|stroke| is_member[*stroke] = true);
        let mut lines = lines.into_iter().peekable();
        let mut it = Self::default();
        for (i, stroke) in strokes.iter().enumerate() {
            if let Some((members, line)) = lines.next_if(|(members, _)| members[0] == i) {
                it.changed.push(it.strokes.len());
                it.strokes.push(line);
                it.members.push(members);
            } else if !is_member[i] {
                it.strokes.push(Arc::clone(stroke));
                it.members.push(vec![i]);
            }
        }
        it
    }
}

/// What speaks for a line that was drawn again, log-odds: what it is a part of counts first.
const LINE: f32 = 0.01;

impl Redrawn {
    /// That lines of a page of this drawing that are not as drawn are at least lines.
    pub(crate) fn as_lines(&self, page: &Page) -> Vec<Hypothesis> {
        let is_changed = |line: &&(usize, usize)| self.changed.binary_search(&line.1).is_ok();
        let lines: Vec<(usize, usize)> =
            page.lines.iter().enumerate().map(|(i, line)| (i, line.stroke)).collect();
        let line = |&(line, stroke): &(usize, usize)| Hypothesis {
            uses: vec![line],
            score: LINE,
            parts: vec![Made {
                tool: Tool::Auto,
                points: self.strokes[stroke].points.clone(),
                half_width: None,
            }],
            solids: Vec::new(),
            reading: Reading::Line,
            habit: None,
        };
        lines.iter().filter(is_changed).map(line).collect()
    }

    /// What is proposed for these lines, by the strokes they consist of.
    pub(crate) fn by_members(&self, mut proposed: Vec<Hypothesis>) -> Vec<Hypothesis> {
        for hypothesis in &mut proposed {
            hypothesis.uses = hypothesis.uses.iter().flat_map(|line| &self.members[*line]).copied().collect();
            hypothesis.uses.sort_unstable();
        }
        proposed
    }
}
