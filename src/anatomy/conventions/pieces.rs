//! What hypotheses make: strokes again, each with the tool that its part asks for, and where they come from.
//!
//! A piece stands in the drawing where the first of its strokes stood. Its stroke has a name of its own, made from that stroke's
//! and its number, so that it has random streams of its own and a new stroke elsewhere changes nothing.

use super::{Habit, Hypothesis, Made, Solid};
use crate::checksum;
use crate::sketch::{Reading, Remark, Stroke, StrokeId, Warning};
use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync::Arc;

/// The strokes of a drawing as they were understood.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Interpretation {
    /// What the stages after this one read, in the order of the drawing.
    pub strokes: Vec<Arc<Stroke>>,
    /// Of every stroke that was made, which drawn ones it comes from.
    pub pieces: BTreeMap<StrokeId, Piece>,
    /// Which strokes were read together, and as what; no stroke twice.
    pub readings: Vec<ReadStrokes>,
    /// Bodies of revolution.
    pub solids: Vec<DrawnSolid>,
    /// What the artist is told.
    pub remarks: Vec<Warning>,
    /// What kind of plant the whole is; none where nothing spoke for one.
    pub habit: Option<Habit>,
}

/// Strokes that are one thing or one plant together.
#[derive(Clone, Debug, PartialEq)]
pub struct ReadStrokes {
    /// The drawn strokes, in the order of the drawing, at least one.
    pub strokes: Vec<StrokeId>,
    /// What they were read as.
    pub reading: Reading,
}

/// Where a stroke that was made comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// The drawn strokes, in the order of the drawing, at least one.
    pub strokes: Vec<StrokeId>,
    /// The half width that a pressure of 1 stands for, pixels, where the thickness was drawn.
    pub half_width: Option<f32>,
}

/// A body of revolution, and the first of the strokes that it comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnSolid {
    /// That stroke.
    pub stroke: StrokeId,
    /// The body.
    pub solid: Solid,
}

impl Interpretation {
    /// All strokes as they were drawn.
    pub fn untouched(strokes: &[Arc<Stroke>]) -> Self {
        Self { strokes: strokes.to_vec(), ..Self::default() }
    }

    /// The strokes of a drawing, some of them replaced by what hypotheses make of them.
    /// Those use strokes by their places.
    pub(super) fn of(strokes: &[Arc<Stroke>], chosen: Vec<Hypothesis>) -> Self {
        if chosen.is_empty() {
            return Self::untouched(strokes);
        }
        let mut it = Self { habit: habit(&chosen, strokes.len()), ..Self::default() };
        let mut names: HashSet<StrokeId> = strokes.iter().map(|stroke| stroke.id).collect();
        let mut made_at: BTreeMap<usize, Vec<Arc<Stroke>>> = BTreeMap::new();
        let mut is_used = vec![false; strokes.len()];
        for Hypothesis { uses, parts, solids, reading, .. } in chosen {
            uses.iter().for_each(|stroke| is_used[*stroke] = true);
            let drawn: Vec<StrokeId> = uses.iter().map(|stroke| strokes[*stroke].id).collect();
            let Some((&place, &first)) = uses.first().zip(drawn.first()) else { continue };
            it.remarks.push(Warning { stroke: Some(first), remark: Remark::ReadAs(reading) });
            it.solids.extend(solids.into_iter().map(|solid| DrawnSolid { stroke: first, solid }));
            for (number, Made { tool, points, half_width }) in parts.into_iter().enumerate() {
                let id = name(first, number, &mut names);
                it.pieces.insert(id, Piece { strokes: drawn.clone(), half_width });
                made_at.entry(place).or_default().push(Arc::new(Stroke { id, tool, points, brush: None }));
            }
            it.readings.push(ReadStrokes { strokes: drawn, reading });
        }
        for (i, stroke) in strokes.iter().enumerate() {
            it.strokes.extend(made_at.remove(&i).unwrap_or_default());
            if !is_used[i] {
                it.strokes.push(Arc::clone(stroke));
            }
        }
        it
    }
}

impl Interpretation {
    /// Takes strokes that were made before, just as they are now, from there: what stages behind this one keep is known by its
    /// address.
    pub(super) fn share_with(&mut self, before: &Self) {
        let made = before.strokes.iter().filter(|stroke| before.pieces.contains_key(&stroke.id));
        let known: HashMap<StrokeId, &Arc<Stroke>> = made.map(|stroke| (stroke.id, stroke)).collect();
        for stroke in self.strokes.iter_mut().filter(|stroke| self.pieces.contains_key(&stroke.id)) {
            if let Some(same) = known.get(&stroke.id).filter(|known| ***known == *stroke) {
                *stroke = Arc::clone(same);
            }
        }
    }
}

impl Piece {
    /// The first of the drawn strokes.
    pub fn first(&self) -> StrokeId {
        self.strokes.first().copied().unwrap_or_default()
    }
}

/// A bit that hardly any stroke's name has: programs and artists count from 0.
const MADE: StrokeId = 1 << 62;

/// A name that no other stroke has, from that of a drawn stroke and a number.
fn name(drawn: StrokeId, number: usize, names: &mut HashSet<StrokeId>) -> StrokeId {
    let mut name = MADE | u64::from(checksum::fnv1a(&format!("{drawn}/{number}")));
    while !names.insert(name) {
        name = name.wrapping_add(1);
    }
    name
}

/// Least share of a drawing's strokes that plants of a kind use, where the drawing is of that kind: one palm in a meadow does
/// not make it a grove.
const SHOWN: f32 = 0.005;

/// The kind of plant that most hypotheses speak for; of several the first in the order of the kinds. None if those use hardly
/// any of the strokes.
fn habit(chosen: &[Hypothesis], strokes: usize) -> Option<Habit> {
    let mut votes: BTreeMap<Habit, (usize, usize)> = BTreeMap::new();
    for (habit, hypothesis) in chosen.iter().filter_map(|h| h.habit.map(|habit| (habit, h))) {
        let (count, used) = votes.entry(habit).or_default();
        (*count, *used) = (*count + 1, *used + hypothesis.uses.len());
    }
    // Grass grows under all others, however many tufts there are.
    if votes.len() > 1 {
        votes.remove(&Habit::Grass);
    }
    let most = votes.values().map(|(count, _)| *count).max()?;
    let (habit, (_, used)) = votes.into_iter().find(|(_, (count, _))| *count == most)?;
    (used as f32 >= SHOWN * strokes as f32).then_some(habit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sketch::Reading;

    #[test]
    fn grass_says_what_a_drawing_shows_only_where_nothing_else_does() {
        let shown = |habits: &[Habit]| {
            let one = |(line, kind): (usize, &Habit)| Hypothesis {
                uses: vec![line],
                score: 1.0,
                parts: Vec::new(),
                solids: Vec::new(),
                reading: Reading::Grass,
                habit: Some(*kind),
            };
            habit(&habits.iter().enumerate().map(one).collect::<Vec<_>>(), habits.len())
        };
        assert_eq!(shown(&[Habit::Grass, Habit::Grass]), Some(Habit::Grass));
        assert_eq!(shown(&[Habit::Grass, Habit::Mushroom, Habit::Grass]), Some(Habit::Mushroom));
        assert_eq!(shown(&[Habit::Tree, Habit::Grass, Habit::Grass]), Some(Habit::Tree));
        assert_eq!(shown(&[]), None);
    }
}
