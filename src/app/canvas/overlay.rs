//! What is shown over the drawing: lasso, selection box, handles, the eraser's circle, the cursor, and the drawing as it
//! will be while a change is still being made. Positions are physical pixels of the window.

use super::controller::Canvas;
use super::doing::{Activity, Doing};
use super::tools::{Shown, ViewDrag};
use super::transform::{HANDLE_REACH, Handle, frame, transformed};
use crate::app::canvas_tool::CanvasTool;
use crate::pen::PenTool;
use crate::sketch::change::StrokeChange;
use crate::sketch::{Stroke, StrokeId};
use glam::{DAffine2, DVec2};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// The cursor's form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CursorShape {
    /// A stroke will begin here.
    Draw,
    /// The eraser: see [`CanvasCursor::circle`].
    Erase,
    /// A lasso will begin here.
    Select,
    /// The selection will be moved.
    Move,
    /// The selection will be stretched along this direction on the screen, in radians, clockwise from right.
    Stretch(f64),
    /// Selection or canvas will be turned.
    Turn,
    /// The canvas can be taken hold of.
    Grab,
    /// The canvas is held.
    Grabbing,
    /// A drag zooms.
    Zoom,
}

/// The cursor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CanvasCursor {
    /// Its form.
    pub shape: CursorShape,
    /// Middle and radius of the eraser, where one is in hand and near.
    pub circle: Option<(DVec2, f64)>,
}

/// What to paint over the drawing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Overlay {
    /// The lasso, open; empty without one.
    pub lasso: Vec<DVec2>,
    /// Corners of the selection box, around.
    pub frame: Option<[DVec2; 4]>,
    /// Middles of the handles.
    pub handles: Vec<(Handle, DVec2)>,
}

/// How the drawing will differ from what it is, while a change is still being made.
#[derive(Clone, Debug, PartialEq)]
pub enum Preview<'a> {
    /// Not at all.
    Same,
    /// The eraser changed these strokes so far.
    Changes(Vec<StrokeChange>),
    /// These strokes are moved on the canvas.
    Moved {
        /// Which.
        ids: &'a BTreeSet<StrokeId>,
        /// How.
        transform: DAffine2,
    },
}

impl Canvas {
    /// The cursor over the canvas.
    pub fn cursor(&self) -> CanvasCursor {
        let shape = self.shape();
        let radius = self.eraser_radius() * self.view.zoom();
        let is_eraser = shape == CursorShape::Erase;
        let busy = self.activity.as_ref().map(|a| a.touch.last);
        let place = busy.or(self.hover.map(|sample| sample.position)).filter(|_| is_eraser);
        let circle = place.map(|place| (place, radius));
        CanvasCursor { shape, circle }
    }

    fn shape(&self) -> CursorShape {
        let of_view = |kind| match kind {
            ViewDrag::Pan | ViewDrag::Orbit => CursorShape::Grab,
            ViewDrag::Turn => CursorShape::Turn,
            ViewDrag::Zoom => CursorShape::Zoom,
        };
        match self.activity.as_ref().map(|a| &a.doing) {
            Some(Doing::View(tool)) if tool.by == ViewDrag::Pan => return CursorShape::Grabbing,
            Some(Doing::View(tool)) => return of_view(tool.by),
            Some(Doing::Drag(tool)) => return self.shape_of(tool.handle()),
            Some(Doing::Draw(_)) => return CursorShape::Draw,
            Some(Doing::Erase(_)) => return CursorShape::Erase,
            Some(Doing::Lasso(_)) => return CursorShape::Select,
            None if self.keys.space => return of_view(self.view_drag()),
            None => {}
        }
        let tool = self.hover.map_or(PenTool::Mouse, |sample| sample.tool);
        match self.tool_for(tool) {
            CanvasTool::Draw(_) => CursorShape::Draw,
            CanvasTool::Erase { .. } => CursorShape::Erase,
            CanvasTool::Pan => CursorShape::Grab,
            CanvasTool::Select => {
                let handle = self.hover.zip(self.bounds).and_then(|(sample, bounds)| {
                    Handle::at(sample.position, bounds, &self.view, (self.scale_factor, HANDLE_REACH))
                });
                handle.map_or(CursorShape::Select, |handle| self.shape_of(handle))
            }
        }
    }

    fn shape_of(&self, handle: Handle) -> CursorShape {
        match handle {
            Handle::Inside => CursorShape::Move,
            Handle::Turn => CursorShape::Turn,
            Handle::Scale { x, y } => {
                let along = f64::from(y).atan2(f64::from(x));
                CursorShape::Stretch(along + self.view.rotation_rad())
            }
        }
    }

    /// Whether cursor or overlay change where the pointer only hovers.
    pub(super) fn follows_hover(&self) -> bool {
        let erases = self.hover.is_some_and(|s| s.tool == PenTool::Eraser);
        erases || matches!(self.tool, CanvasTool::Erase { .. } | CanvasTool::Select)
    }

    /// What to paint over the drawing.
    pub fn overlay(&self) -> Overlay {
        let mut overlay = Overlay::default();
        if let Some(Shown::Lasso(lasso)) = self.activity.as_ref().map(Activity::shown) {
            overlay.lasso = lasso.iter().map(|p| self.view.to_window(*p)).collect();
        }
        if let Some(bounds) = self.bounds {
            let drag = self.activity.as_ref().and_then(|a| a.drag());
            let moved = drag.map_or(DAffine2::IDENTITY, |drag| drag.transform(self.keys.shift));
            let window = |place: DVec2| self.view.to_window(moved.transform_point2(place));
            let per_logical_px = self.scale_factor / self.view.zoom();
            overlay.frame = Some(frame(bounds, per_logical_px).corners().map(window));
            // While one is dragged, the others are in the way.
            if drag.is_none() {
                overlay.handles =
                    Handle::ALL.iter().map(|h| (*h, window(h.place(bounds, per_logical_px)))).collect();
            }
        }
        overlay
    }

    /// How the drawing will differ from what it is.
    pub fn preview(&self) -> Preview<'_> {
        match self.activity.as_ref().map(Activity::shown) {
            Some(Shown::Changes(changes)) => Preview::Changes(changes),
            Some(Shown::Drag(drag)) => {
                Preview::Moved { ids: self.selection.ids(), transform: drag.transform(self.keys.shift) }
            }
            Some(Shown::Nothing | Shown::Lasso(_)) | None => Preview::Same,
        }
    }

    /// The strokes as the preview has them, as for the plant that grows along; strokes that do not change are shared. The
    /// growing stroke is not among them.
    pub fn previewed(&self, strokes: &[Arc<Stroke>]) -> Vec<Arc<Stroke>> {
        match self.preview() {
            Preview::Same => strokes.to_vec(),
            Preview::Moved { ids, transform } => {
                strokes
                    .iter()
                    .map(|s| {
                        if ids.contains(&s.id) { Arc::new(transformed(s, &transform)) } else { Arc::clone(s) }
                    })
                    .collect()
            }
            Preview::Changes(changes) => changed(strokes, &changes),
        }
    }
}

/// The strokes after changes: what is put takes the place of its name, new ones lie on top.
fn changed(strokes: &[Arc<Stroke>], changes: &[StrokeChange]) -> Vec<Arc<Stroke>> {
    let mut by_id: BTreeMap<StrokeId, Option<&Arc<Stroke>>> = changes
        .iter()
        .map(|change| match change {
            StrokeChange::Put(stroke) => (stroke.id, Some(stroke)),
            StrokeChange::Remove(id) => (*id, None),
        })
        .collect();
    let mut left: Vec<Arc<Stroke>> = Vec::with_capacity(strokes.len());
    for stroke in strokes {
        match by_id.remove(&stroke.id) {
            None => left.push(Arc::clone(stroke)),
            Some(put) => left.extend(put.map(Arc::clone)),
        }
    }
    left.extend(by_id.into_values().flatten().map(Arc::clone));
    left
}
