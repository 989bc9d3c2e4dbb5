//! Pieces of strokes as strokes of their own, which the canvas draws over them in other colours.
//!
//! A piece has the samples of its stroke, so it covers it exactly. It is made once for as long as its stroke and its place on it stay,
//! so that the canvas is not given again what it has.

use super::stroke_colours::Pieces;
use super::ways_to_read::Shown;
use crate::sketch::{Stroke, StrokeId};
use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

/// A bit that hardly any stroke's name has: those of pieces have it.
const PIECE: StrokeId = 1 << 63;
/// Most pieces of one stroke.
const MOST: usize = 64;

/// The pieces that were made last, by the names of their strokes.
#[derive(Debug, Default)]
pub(super) struct CutStrokes(BTreeMap<StrokeId, Cut>);

/// A stroke and the pieces that were made of it.
#[derive(Debug)]
struct Cut {
    stroke: Arc<Stroke>,
    others: Vec<(Shown, usize, usize)>,
    pieces: Vec<Arc<Stroke>>,
}

/// Of every piece, of which stroke it is one and what it is.
pub(super) type PieceNames = HashMap<StrokeId, (StrokeId, Shown)>;

impl CutStrokes {
    /// The strokes, those that are several parts with their pieces over them.
    pub(super) fn with_pieces<'a>(
        &mut self,
        strokes: Cow<'a, [Arc<Stroke>]>,
        pieces: &[Pieces],
    ) -> (Cow<'a, [Arc<Stroke>]>, PieceNames) {
        let of: HashMap<StrokeId, &Pieces> =
            pieces.iter().filter(|p| !p.others.is_empty()).map(|p| (p.stroke, p)).collect();
        let mut names = PieceNames::new();
        if of.is_empty() {
            self.0.clear();
            return (strokes, names);
        }
        let mut before = std::mem::take(&mut self.0);
        let mut all = Vec::with_capacity(strokes.len());
        for stroke in strokes.iter() {
            all.push(Arc::clone(stroke));
            let Some(pieces) = of.get(&stroke.id) else { continue };
            let known = before.remove(&stroke.id);
            let known = known.filter(|cut| Arc::ptr_eq(&cut.stroke, stroke) && cut.others == pieces.others);
            let cut = known.unwrap_or_else(|| Cut::of(stroke, &pieces.others));
            for (piece, (shown, ..)) in cut.pieces.iter().zip(&cut.others) {
                all.push(Arc::clone(piece));
                names.insert(piece.id, (stroke.id, *shown));
            }
            self.0.insert(stroke.id, cut);
        }
        (Cow::Owned(all), names)
    }
}

impl Cut {
    /// The pieces of a stroke; one that was cut short meanwhile has fewer.
    fn of(stroke: &Arc<Stroke>, others: &[(Shown, usize, usize)]) -> Self {
        let samples = |&(_, from, to): &(Shown, usize, usize)| stroke.points.get(from..=to);
        let numbered = others.iter().map_while(samples).take(MOST).zip(0_u64..);
        let piece = |(points, number): (&[_], u64)| {
            let id = PIECE | (stroke.id.wrapping_mul(MOST as u64) | number) & (PIECE - 1);
            Arc::new(Stroke { id, tool: stroke.tool, points: points.to_vec(), brush: stroke.brush })
        };
        Self { stroke: Arc::clone(stroke), others: others.to_vec(), pieces: numbered.map(piece).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::Part;
    use crate::sketch::{StrokePoint, Tool};
    use glam::vec2;

    fn stroke(id: StrokeId) -> Arc<Stroke> {
        let points = (0..50).map(|k| StrokePoint::at(vec2(k as f32, 0.0))).collect();
        Arc::new(Stroke { id, tool: Tool::Auto, points, brush: None })
    }

    #[test]
    fn pieces_lie_over_their_stroke_and_are_made_once() {
        let [leaf, stem] = [Part::Leaf, Part::Branch].map(|part| Shown::Part(part, 0));
        let strokes = [stroke(3), stroke(4)];
        let pieces = [
            Pieces { stroke: 3, most: leaf, others: vec![(stem, 0, 9), (stem, 40, 49)] },
            Pieces { stroke: 4, most: leaf, others: Vec::new() },
        ];
        let mut cut = CutStrokes::default();
        let (all, names) = cut.with_pieces(Cow::Borrowed(&strokes[..]), &pieces);
        assert_eq!(all.len(), 4);
        assert_eq!((all[0].id, all[3].id), (3, 4));
        assert_eq!(all[1].points[..], strokes[0].points[0..=9]);
        assert_eq!((names[&all[1].id], names[&all[2].id]), ((3, stem), (3, stem)));
        let (again, _) = cut.with_pieces(Cow::Borrowed(&strokes[..]), &pieces);
        assert!(all.iter().zip(again.iter()).all(|(a, b)| Arc::ptr_eq(a, b)));
        // A stroke of which a part was erased has no piece beyond its end.
        let short = Stroke { points: strokes[0].points[..20].to_vec(), ..Stroke::clone(&strokes[0]) };
        let erased = [Arc::new(short), stroke(4)];
        assert_eq!(cut.with_pieces(Cow::Borrowed(&erased[..]), &pieces).0.len(), 3);
        assert_eq!(cut.with_pieces(Cow::Borrowed(&erased[..]), &[]).0.len(), 2);
    }
}
