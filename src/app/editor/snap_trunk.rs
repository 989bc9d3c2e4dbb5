//! A trunk that was drawn over the picture, moved onto the edges that it has there: the middle between them, and their distance as pressure.
//!
//! Edges are sought on a thread of their own. The stroke keeps its name; where it is the only wood of the drawing its thickness
//! becomes that of the picture.

use super::Editor;
use super::background::begin;
use super::find_plant::{ready, with_thickness};
use super::photographs::{on_canvas, on_picture};
use super::plant_search::{Prepared, Snapping};
use crate::app::messages::Localize as _;
use crate::app::panels::snapshot::Notice;
use crate::app::texture_cut::CutError;
use crate::photo::plant::TrunkLine;
use crate::photo::{PhotoParams, PhotoRemark};
use crate::sketch::change::StrokeChange;
use crate::sketch::settings::Settings;
use crate::sketch::{Change, Reference, Stroke, StrokeId, Tool};
use std::sync::Arc;

impl Editor {
    /// The only selected stroke, if it is a branch over a picture that is seen.
    pub(super) fn branch_over_picture(&self) -> Option<StrokeId> {
        self.sketch().reference.as_ref().filter(|reference| reference.visible)?;
        let mut selected = self.canvas.selection().ids().iter();
        let only = *selected.next().filter(|_| selected.next().is_none())?;
        self.branch(only).map(|stroke| stroke.id)
    }

    fn branch(&self, id: StrokeId) -> Option<&Arc<Stroke>> {
        self.sketch().strokes.iter().find(|stroke| stroke.id == id && stroke.tool == Tool::Branch)
    }

    /// Seeks the edges of a trunk under a branch.
    pub(super) fn snap_to_trunk(&mut self, id: StrokeId) {
        let (Some(stroke), Some(reference)) = (self.branch(id).cloned(), self.sketch().reference.clone())
        else {
            return;
        };
        let prepared = self.search.prepared_for(reference.picture.hash());
        let (params, over) = (PhotoParams::default(), Arc::clone(&reference));
        let line: Vec<_> = stroke.points.iter().map(|point| on_picture(&over, point.position)).collect();
        let seek = move || {
            let picture = ready(prepared, &over, &params.plant)?;
            let snapped = picture.snapped(&line, &params.snap);
            Ok::<_, CutError>((picture, snapped))
        };
        match begin("trunk", self.background.wake(), seek) {
            Ok(work) => self.search.snapping = Some(Snapping { stroke, reference, work }),
            Err(error) => self.notify_error(&error),
        }
    }

    /// Takes edges that were found.
    pub(super) fn collect_snapped(&mut self) {
        let Some(result) = self.search.snapping.as_ref().and_then(|snapping| snapping.work.result()) else {
            return;
        };
        let Some(Snapping { stroke, reference, .. }) = self.search.snapping.take() else { return };
        // What was changed meanwhile is not what was looked at.
        let is_same = self.branch(stroke.id).is_some_and(|now| Arc::ptr_eq(now, &stroke))
            && self.sketch().reference.as_ref().is_some_and(|now| Arc::ptr_eq(now, &reference));
        match result {
            Some(Ok((picture, snapped))) if is_same => {
                self.search.prepared = Some(Prepared { hash: reference.picture.hash(), picture });
                match snapped {
                    Some(trunk) => self.move_trunk(&stroke, &trunk, &reference),
                    None => {
                        let what = PhotoRemark::TrunkAsDrawn.localize(self.prefs.messages());
                        self.notify(Notice::warning(what, ""));
                    }
                }
            }
            Some(Err(error)) => self.notify_error(&error),
            _ => {}
        }
    }

    fn move_trunk(&mut self, drawn: &Stroke, trunk: &TrunkLine, reference: &Reference) {
        let sketch = self.sketch();
        let stroke = trunk.stroke(drawn.id, |place| on_canvas(reference, place));
        let is_wood = |stroke: &&Arc<Stroke>| matches!(stroke.tool, Tool::Branch | Tool::SpaceBranch);
        let mut settings = Settings::default();
        if sketch.strokes.iter().filter(is_wood).count() == 1 {
            settings.params = Some(with_thickness(sketch, trunk, reference, sketch.diagonal()));
        }
        self.change(Change { strokes: vec![StrokeChange::Put(Arc::new(stroke))], settings });
    }
}
