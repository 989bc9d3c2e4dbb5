//! What must change on the canvas so that it shows the drawing: which strokes are new, gone, or of another colour.
//!
//! Knows no graphics card. Most often nothing changed but some colours, or one stroke was added at the end; both cost
//! little however many strokes there are.

use super::canvas::Preview;
use super::cut_strokes::CutStrokes;
use super::editor::Editor;
use super::theme::Palette;
use crate::anatomy::Part;
use crate::sketch::{Stroke, StrokeId};
use egui::Color32;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

/// One change, in the order in which they are to be made.
#[derive(Clone, Debug, PartialEq)]
pub enum PaperChange {
    /// Draw a stroke, in its place where there is one of this name, else on top.
    Set(Arc<Stroke>, Color32),
    /// Another colour.
    Recolour(StrokeId, Color32),
    /// No longer there.
    Remove(StrokeId),
    /// The order of all strokes, the last on top.
    Order(Vec<StrokeId>),
}

/// What is shown.
#[derive(Debug, Default)]
pub struct Paper {
    shown: Vec<(Arc<Stroke>, Color32)>,
    cut: CutStrokes,
}

impl Paper {
    /// Says what must change to show the drawing of the editor as it is previewed.
    pub fn follow(&mut self, editor: &Editor) -> Vec<PaperChange> {
        let strokes = match editor.canvas.preview() {
            Preview::Same => Cow::Borrowed(&editor.sketch().strokes[..]),
            _ => Cow::Owned(editor.canvas.previewed(&editor.sketch().strokes)),
        };
        let palette = Palette::of(editor.theme());
        let selected = editor.canvas.selection().ids();
        let mut understood = Understood::of(editor, palette);
        let (strokes, pieces) = self.cut.with_pieces(strokes, editor.pieces());
        self.show(&strokes, |stroke| {
            let piece = pieces.get(&stroke.id);
            let drawn = piece.map_or(stroke.id, |(drawn, _)| *drawn);
            if !selected.is_empty() && selected.contains(&drawn) {
                return palette.selection;
            }
            let shown = piece.map(|(_, shown)| palette.shown(*shown));
            shown.or_else(|| understood.colour(stroke.id)).unwrap_or_else(|| palette.tool(stroke.tool))
        })
    }

    /// Whether a stroke of this name is shown.
    pub fn shows(&self, id: StrokeId) -> bool {
        // The newest stroke is asked for most.
        self.shown.iter().rev().any(|(stroke, _)| stroke.id == id)
    }

    fn show(
        &mut self,
        strokes: &[Arc<Stroke>],
        mut colour: impl FnMut(&Stroke) -> Color32,
    ) -> Vec<PaperChange> {
        let mut changes = Vec::new();
        let same = self.shown.iter().zip(strokes).take_while(|((known, _), now)| Arc::ptr_eq(known, now));
        let same = same.count();
        for (stroke, shown) in &mut self.shown[..same] {
            let now = colour(stroke);
            if std::mem::replace(shown, now) != now {
                changes.push(PaperChange::Recolour(stroke.id, now));
            }
        }
        let mut before: BTreeMap<_, _> = self.shown.drain(same..).map(|(s, c)| (s.id, (s, c))).collect();
        let is_added_only = before.is_empty();
        for stroke in &strokes[same..] {
            let now = colour(stroke);
            match before.remove(&stroke.id) {
                Some((known, shown)) if Arc::ptr_eq(&known, stroke) => {
                    if shown != now {
                        changes.push(PaperChange::Recolour(stroke.id, now));
                    }
                }
                _ => changes.push(PaperChange::Set(Arc::clone(stroke), now)),
            }
            self.shown.push((Arc::clone(stroke), now));
        }
        changes.extend(before.into_keys().map(PaperChange::Remove));
        if !is_added_only || strokes.len() > same + 1 {
            changes.push(PaperChange::Order(strokes.iter().map(|s| s.id).collect()));
        }
        changes
    }
}

/// The colours of strokes that the analysis has understood.
struct Understood {
    /// By name.
    colours: Vec<(StrokeId, Color32)>,
    /// Where the next one most likely is.
    next: usize,
}

impl Understood {
    fn of(editor: &Editor, palette: &Palette) -> Self {
        let Some(built) = editor.built() else { return Self { colours: Vec::new(), next: 0 } };
        let branches = built.anatomy.branches.iter();
        let levels: BTreeMap<StrokeId, u32> = branches.filter_map(|b| Some((b.stroke?, b.level))).collect();
        let pieces = editor.pieces();
        let colour = |stroke: StrokeId, part: Part| match pieces
            .binary_search_by_key(&stroke, |pieces| pieces.stroke)
        {
            Ok(at) => palette.shown(pieces[at].most),
            Err(_) => palette.part(part, levels.get(&stroke).copied().unwrap_or(0)),
        };
        let marks = built.anatomy.marks.iter();
        let mut colours: Vec<_> = marks.map(|mark| (mark.stroke, colour(mark.stroke, mark.part))).collect();
        colours.sort_by_key(|(stroke, _)| *stroke);
        Self { colours, next: 0 }
    }

    fn colour(&mut self, stroke: StrokeId) -> Option<Color32> {
        let is_next = self.colours.get(self.next).is_some_and(|(id, _)| *id == stroke);
        let at = if is_next {
            self.next
        } else {
            self.colours.binary_search_by_key(&stroke, |(id, _)| *id).ok()?
        };
        self.next = at + 1;
        Some(self.colours.get(at)?.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sketch::Tool;

    /// A canvas that carries out every change: strokes by name and colour, the last on top.
    #[derive(Default)]
    struct FakeCanvas(Vec<(Arc<Stroke>, Color32)>);

    impl FakeCanvas {
        fn make(&mut self, changes: Vec<PaperChange>) {
            for change in changes {
                let names: Vec<StrokeId> = self.0.iter().map(|(s, _)| s.id).collect();
                let place = |id: StrokeId| names.iter().position(|name| *name == id);
                match change {
                    PaperChange::Set(stroke, colour) => match place(stroke.id) {
                        Some(at) => self.0[at] = (stroke, colour),
                        None => self.0.push((stroke, colour)),
                    },
                    PaperChange::Recolour(id, colour) => self.0[place(id).unwrap()].1 = colour,
                    PaperChange::Remove(id) => drop(self.0.remove(place(id).unwrap())),
                    PaperChange::Order(order) => {
                        self.0.sort_by_key(|(s, _)| order.iter().position(|id| *id == s.id).unwrap());
                    }
                }
            }
        }
    }

    fn stroke(id: StrokeId) -> Arc<Stroke> {
        Arc::new(Stroke { id, tool: Tool::Auto, points: Vec::new(), brush: None })
    }

    #[test]
    fn whatever_happens_to_the_drawing_the_canvas_shows_it() {
        let (mut paper, mut canvas) = (Paper::default(), FakeCanvas::default());
        let mut strokes: Vec<Arc<Stroke>> = Vec::new();
        let mut random = 7_u64;
        for step in 0..2000_u64 {
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let at = (random >> 40) as usize % strokes.len().max(1);
            match (random >> 33) % 6 {
                0 | 1 => strokes.push(stroke(step + 1)),
                2 if !strokes.is_empty() => drop(strokes.remove(at)),
                3 if !strokes.is_empty() => strokes[at] = stroke(strokes[at].id),
                4 if !strokes.is_empty() => strokes.swap(at, 0),
                5 => strokes.extend([stroke(10_000 + 2 * step), stroke(10_001 + 2 * step)]),
                _ => {}
            }
            strokes.truncate(40);
            let shade = |s: &Stroke| Color32::from_gray(((s.id + step / 3) % 5) as u8);
            canvas.make(paper.show(&strokes, shade));
            let expected: Vec<_> = strokes.iter().map(|s| (Arc::clone(s), shade(s))).collect();
            assert_eq!(canvas.0, expected, "step {step}");
            assert!(strokes.iter().all(|s| paper.shows(s.id)) && !paper.shows(9_999));
        }
    }

    #[test]
    fn one_more_stroke_is_one_change() {
        let mut paper = Paper::default();
        let mut strokes: Vec<_> = (1..500).map(stroke).collect();
        paper.show(&strokes, |_| Color32::RED);
        strokes.push(stroke(500));
        assert_eq!(paper.show(&strokes, |_| Color32::RED), [PaperChange::Set(stroke(500), Color32::RED)]);
        assert_eq!(paper.show(&strokes, |_| Color32::RED), []);
    }
}
