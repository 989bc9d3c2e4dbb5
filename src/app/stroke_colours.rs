//! Which part of a plant each piece of a drawn stroke is, for strokes that were read together or are several parts.
//!
//! Several strokes may be one part, and one stroke several: a crown and its trunk in one line. Every sample of such a stroke goes to the
//! part that lies nearest among those that were made of the stroke; pieces shorter than [`SHORTEST`] of the
//! stroke go with the piece before them. Strokes and parts are looked at in so many steps at most that a live build does not notice.
//! Limits: where two parts run side by side, the nearer one wins, whichever the stroke was meant for.

use super::ways_to_read::Shown;
use crate::anatomy::conventions::ReadStrokes;
use crate::anatomy::{Anatomy, Part, Sample};
use crate::sketch::{Reading, Sketch, Stroke, StrokeId};
use glam::Vec2;
use std::collections::HashMap;

/// Most places of a stroke that are looked at, and most places of a part.
const PLACES: (usize, usize) = (96, 48);
/// Fewest places of a stroke that are looked at, and how often a part is looked at for all strokes that it was made of.
const LEAST: usize = 8;
const LOOKS: usize = 400_000;
/// Shortest piece that has a colour of its own, as a share of the places of its stroke.
const SHORTEST: f32 = 0.06;

/// What the pieces of a stroke are, from its beginning.
#[derive(Clone, Debug, PartialEq)]
pub struct Pieces {
    /// The stroke.
    pub stroke: StrokeId,
    /// What most of it is.
    pub most: Shown,
    /// The pieces that are something else: what, and from which sample to which, both included.
    pub others: Vec<(Shown, usize, usize)>,
}

impl Pieces {
    /// Whether some of the stroke is such a part.
    pub(super) fn have(&self, part: Part) -> bool {
        let is_it = |shown: Shown| matches!(shown, Shown::Part(of, _) if of == part);
        is_it(self.most) || self.others.iter().any(|(shown, ..)| is_it(*shown))
    }
}

/// A part, and some places on it.
struct Made {
    shown: Shown,
    places: Vec<Vec2>,
    bounds: (Vec2, Vec2),
}

impl Made {
    fn new(shown: Shown, places: &[Vec2]) -> Self {
        let places: Vec<Vec2> =
            places.iter().step_by(places.len().div_ceil(PLACES.1).max(1)).copied().collect();
        let empty = (Vec2::INFINITY, Vec2::NEG_INFINITY);
        let bounds = places.iter().fold(empty, |(low, high), p| (low.min(*p), high.max(*p)));
        Self { shown, places, bounds }
    }

    /// The squared distance of its nearest place if that is less than `most`.
    fn nearer(&self, place: Vec2, most: f32) -> Option<f32> {
        let (low, high) = self.bounds;
        if place.distance_squared(place.clamp(low, high)) >= most {
            return None;
        }
        let nearest = self.places.iter().map(|p| p.distance_squared(place)).fold(f32::INFINITY, f32::min);
        (nearest < most).then_some(nearest)
    }
}

/// The pieces of all strokes that were read together, by the names of the strokes.
pub(super) fn pieces_of(sketch: &Sketch, anatomy: &Anatomy) -> Vec<Pieces> {
    if anatomy.readings.is_empty() {
        return Vec::new();
    }
    let (parts, mut read) = (parts(anatomy), HashMap::new());
    for together in &anatomy.readings {
        read.extend(together.strokes.iter().map(|stroke| (*stroke, together)));
    }
    let of = |stroke: &Stroke| {
        let together: &ReadStrokes = read.get(&stroke.id)?;
        match parts.get(together.strokes.first()?) {
            Some(made) => Some(pieces(stroke, made, together.strokes.len())),
            None => is_beside(together.reading).then(|| Pieces {
                stroke: stroke.id,
                most: Shown::Beside(together.reading),
                others: Vec::new(),
            }),
        }
    };
    let mut pieces: Vec<Pieces> = sketch.strokes.iter().filter_map(|stroke| of(stroke)).collect();
    pieces.sort_by_key(|pieces| pieces.stroke);
    pieces
}

/// Whether strokes of such a reading are no part of the plant itself, where nothing was made of them.
fn is_beside(reading: Reading) -> bool {
    matches!(reading, Reading::Pot | Reading::Ground)
}

/// The parts that were made of strokes together, by the first of these strokes.
fn parts(anatomy: &Anatomy) -> HashMap<StrokeId, Vec<Made>> {
    let mut parts: HashMap<StrokeId, Vec<Made>> = HashMap::new();
    let mut add = |stroke: StrokeId, shown: Shown, places: &[Vec2]| {
        if let Some(piece) = anatomy.pieces.get(&stroke) {
            parts.entry(piece.first()).or_default().push(Made::new(shown, places));
        }
    };
    let positions = |samples: &[Sample]| samples.iter().map(|s| s.position).collect::<Vec<_>>();
    for branch in &anatomy.branches {
        let Some(stroke) = branch.stroke else { continue };
        add(stroke, Shown::Part(Part::Branch, branch.level), &positions(&branch.line));
    }
    for (blades, part) in [(&anatomy.leaves, Part::Leaf), (&anatomy.petals, Part::Petal)] {
        for blade in blades.iter().filter(|blade| blade.copy_of.is_none()) {
            let Some(stroke) = blade.stroke else { continue };
            add(stroke, Shown::Part(part, 0), &positions(&blade.outline));
        }
    }
    for crown in &anatomy.crowns {
        add(crown.stroke, Shown::Part(Part::Crown, 0), &crown.outline);
    }
    parts
}

/// The pieces of one of so many strokes of which these parts were made, at least one.
fn pieces(stroke: &Stroke, made: &[Made], together: usize) -> Pieces {
    let first = made[0].shown;
    if made.iter().all(|part| part.shown == first) {
        return Pieces { stroke: stroke.id, most: first, others: Vec::new() };
    }
    let places = (LOOKS / (made.len() * together).max(1)).clamp(LEAST, PLACES.0);
    let step = stroke.points.len().div_ceil(places).max(1);
    let nearest = |place: Vec2| {
        let mut best = (f32::INFINITY, first);
        for part in made {
            best = part.nearer(place, best.0).map_or(best, |distance| (distance, part.shown));
        }
        best.1
    };
    let shown: Vec<Shown> = stroke.points.iter().step_by(step).map(|point| nearest(point.position)).collect();
    let runs = runs(&shown);
    let mut counts: Vec<(Shown, usize)> = Vec::new();
    for &(shown, from, to) in &runs {
        match counts.iter_mut().find(|(known, _)| *known == shown) {
            Some((_, count)) => *count += to - from,
            None => counts.push((shown, to - from)),
        }
    }
    let first_of_most = |a: &(Shown, usize), b: &(Shown, usize)| b.1.cmp(&a.1);
    counts.sort_by(first_of_most);
    let most = counts.first().map_or(first, |(shown, _)| *shown);
    let last = stroke.points.len() - 1;
    let others = runs.into_iter().filter(|(shown, ..)| *shown != most);
    let others = others.map(|(shown, from, to)| (shown, from * step, (to * step).min(last))).collect();
    Pieces { stroke: stroke.id, most, others }
}

/// Runs of the same: what, from where, and where the next begins; short ones go with the one before.
fn runs(all: &[Shown]) -> Vec<(Shown, usize, usize)> {
    let least = ((SHORTEST * all.len() as f32) as usize).max(1);
    let mut runs: Vec<(Shown, usize, usize)> = Vec::new();
    let mut begin = 0;
    for end in 1..=all.len() {
        if end < all.len() && all[end] == all[begin] {
            continue;
        }
        match runs.last_mut() {
            Some(last) if last.0 == all[begin] || end - begin < least => last.2 = end,
            _ => runs.push((all[begin], begin, end)),
        }
        begin = end;
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::{AnatomyParams, analyse};
    use crate::sketch::{StrokePoint, Tool};
    use glam::vec2;

    #[test]
    fn runs_leave_out_what_is_short() {
        let [leaf, stem] = [Part::Leaf, Part::Branch].map(|part| Shown::Part(part, 0));
        let all: Vec<Shown> =
            [vec![stem; 40], vec![leaf; 2], vec![stem; 10], vec![leaf; 40]].into_iter().flatten().collect();
        assert_eq!(runs(&all), [(stem, 0, 52), (leaf, 52, 92)]);
        assert_eq!(runs(&[]), []);
    }

    /// A leaf on its stalk in one stroke: up the stalk, round the blade, and back to its foot.
    #[test]
    fn a_stroke_that_is_a_stalk_and_a_blade_has_two_pieces() {
        let stalk = (0..40).map(|k| vec2(0.0, 400.0 - 5.0 * k as f32));
        let blade = (0..=90).map(|k| {
            let angle = std::f32::consts::TAU * k as f32 / 90.0;
            vec2(60.0 * angle.sin(), 200.0 - 110.0 * (1.0 - angle.cos()))
        });
        let points = stalk.chain(blade).map(StrokePoint::at).collect();
        let stroke = Stroke { id: 7, tool: Tool::Auto, points, brush: None };
        let sketch = Sketch { strokes: vec![stroke.into()], ..Sketch::empty() };
        let anatomy = analyse(&sketch, &AnatomyParams::default());
        let pieces = pieces_of(&sketch, &anatomy);
        let [only] = &pieces[..] else { panic!("{pieces:?} of {:?}", anatomy.readings) };
        assert_eq!(only.most, Shown::Part(Part::Leaf, 0));
        let [(stem, from, to)] = only.others[..] else { panic!("{only:?}") };
        assert!(
            matches!(stem, Shown::Part(Part::Branch, _)) && from == 0 && (30..60).contains(&to),
            "{only:?}"
        );
    }
}
