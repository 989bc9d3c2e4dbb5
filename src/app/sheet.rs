//! The drawing as ink: the strokes in an [`InkBuffer`], kept in step with the editor.
//!
//! The growing stroke is followed sample by sample. What of it is settled stays as it is; only the last points, which the
//! stabiliser still moves, are drawn again, so that a sample costs the same however long the stroke is. Everything else
//! follows what [`Paper`] says has changed. Knows no graphics card.

use super::editor::Editor;
use super::paper::{Paper, PaperChange};
use super::theme::Palette;
use crate::render::canvas::InkBuffer;
use crate::sketch::StrokeId;

/// Width of a line at full pressure, canvas units per unit of the drawing's height on a usual sheet.
pub(super) const LINE_WIDTH: f32 = 4.0;

/// What of the drawing is in the buffer.
#[derive(Debug, Default)]
pub struct Sheet {
    paper: Paper,
    /// Version of the drawing that is shown.
    shown: u64,
    /// The growing stroke, and how many of its points are in the buffer for good.
    growing: Option<(StrokeId, usize)>,
}

impl Sheet {
    /// Adds the newest samples of the growing stroke: with the sample that made them.
    pub fn grow(&mut self, ink: &mut InkBuffer, editor: &Editor) {
        let Some(stroke) = editor.canvas().growing() else { return };
        let seen = match self.growing {
            Some((id, seen)) if id == stroke.id() => seen,
            _ => {
                let colour = Palette::of(editor.theme()).tool(stroke.tool());
                ink.set(stroke.id(), &[], colour.to_array(), LINE_WIDTH);
                0
            }
        };
        let settled = stroke.settled();
        ink.grow(stroke.id(), &stroke.points()[seen..settled], &stroke.points()[settled..]);
        self.growing = Some((stroke.id(), settled));
    }

    /// Brings all other strokes in step with the drawing as it is previewed.
    pub fn follow(&mut self, ink: &mut InkBuffer, editor: &Editor) {
        if std::mem::replace(&mut self.shown, editor.versions().drawing) == editor.versions().drawing {
            return;
        }
        for change in self.paper.follow(editor) {
            match change {
                PaperChange::Set(stroke, colour) => {
                    ink.set(stroke.id, &stroke.points, colour.to_array(), LINE_WIDTH);
                }
                PaperChange::Recolour(id, colour) => ink.recolour(id, colour.to_array()),
                PaperChange::Remove(id) => ink.remove(id),
                PaperChange::Order(ids) => ink.set_order(&ids),
            }
        }
        let growing = editor.canvas().growing().map(|stroke| stroke.id());
        if let Some((id, _)) = self.growing.filter(|(id, _)| growing != Some(*id)) {
            self.growing = None;
            if !self.paper.shows(id) {
                ink.remove(id);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::action::Action;
    use crate::app::canvas::Rect;
    use crate::app::editor::Places;
    use crate::app::stabiliser::Stabiliser;
    use crate::pen::tests::Hand;
    use crate::pen::{PenPhase, PenTool};
    use glam::DVec2;
    use std::f64::consts::TAU;

    /// Draws one stroke of so many samples and gives the most points that a sample touched in the ink.
    fn most_touched(stabiliser: Stabiliser, samples: u32) -> usize {
        let home = tempfile::tempdir().unwrap();
        let places = Places { config: home.path().join("config"), state: home.path().join("state") };
        let mut editor = Editor::open_in(places, None, || ()).unwrap();
        editor.perform(Action::New);
        editor.canvas.settings.stabiliser = stabiliser;
        editor.canvas.set_viewport(Rect::new(DVec2::ZERO, DVec2::new(640.0, 700.0)), 1.0);
        let (mut sheet, mut ink) = (Sheet::default(), InkBuffer::default());
        let mut most = 0;
        for i in 0..samples {
            // Round and round, so that a long stroke differs from a short one in nothing but its length.
            let position =
                DVec2::new(320.0, 350.0) + 200.0 * DVec2::from_angle(f64::from(i % 100) * TAU / 100.0);
            let phase = if i == 0 { PenPhase::Down } else { PenPhase::Move };
            let event = Hand { position, ..Hand::default() }.event(phase, PenTool::Pen, f64::from(i));
            editor.pen(event);
            sheet.grow(&mut ink, &editor);
            most = most.max(ink.take_dirty().iter().map(ExactSizeIterator::len).sum());
        }
        assert_eq!(editor.canvas.growing().map(|stroke| stroke.points().len()), Some(samples as usize));
        most
    }

    #[test]
    fn a_sample_costs_the_same_however_long_the_stroke_is() {
        for stabiliser in Stabiliser::ALL {
            let (short, long) = (most_touched(stabiliser, 200), most_touched(stabiliser, 20_000));
            assert!(
                long <= short,
                "{stabiliser:?}: {long} points after a long stroke, {short} after a short one"
            );
        }
    }
}
