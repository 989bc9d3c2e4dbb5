//! What can be seen of the editor from outside: for those who show it, and for those who measure it.

use super::Editor;
use super::live_plant::Revisions;
use super::updates::{Copied, Versions};
use crate::app::canvas::Canvas;
use crate::app::layout::Layout;
use crate::app::panels::snapshot::Dialog;
use crate::app::plant_painter::Subject;
use crate::app::settings::Settings;
use crate::app::stroke_colours::Pieces;
use crate::pipeline::Built;
use crate::render::Look;
use crate::sketch::Sketch;
use std::sync::Arc;

impl Editor {
    /// The drawing without what is still being drawn.
    pub fn sketch(&self) -> &Sketch {
        self.drawing.sketch()
    }

    /// What pens do to the drawing: the growing stroke, the selection, the view.
    pub fn canvas(&self) -> &Canvas {
        &self.canvas
    }

    /// The newest plant.
    pub fn built(&self) -> Option<&Arc<Built>> {
        self.live.built()
    }

    /// What the plant's picture shows; `None` before the first plant.
    pub(in crate::app) fn subject(&self) -> Option<Subject> {
        let built = self.built()?;
        Some(Subject { built: Arc::clone(built), level: self.levels.shown().cloned() })
    }

    /// What the pieces of strokes are that were read together, by the names of the strokes.
    pub(in crate::app) fn pieces(&self) -> &[Pieces] {
        self.live.pieces()
    }

    /// Changes that the graphics card has to be notified of.
    pub fn versions(&self) -> Versions {
        self.updates.versions()
    }

    /// How the next picture of the plant looks; tells the view that it is being drawn.
    pub fn plant_look(&mut self) -> Look {
        self.plant.look(self.theme())
    }

    /// Factor on the width of lines on the canvas, which are `width` wide at full pressure.
    pub(in crate::app) fn line_scale(&self, width: f32) -> f32 {
        self.canvas.view().line_scale(width.into(), self.layout.pixels_per_point()) as f32
    }

    /// How far the plant is behind the drawing.
    pub fn revisions(&self) -> Revisions {
        self.live.revisions()
    }

    /// What the artist chose for the program.
    pub(in crate::app) fn settings(&self) -> &Settings {
        self.prefs.settings()
    }

    /// The theme to show.
    pub(in crate::app) fn theme(&self) -> egui::Theme {
        self.prefs.theme()
    }

    /// Where things are in the window.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// What waits for an answer above everything.
    pub fn dialog(&self) -> Option<&Dialog> {
        self.dialogs.dialog()
    }

    /// Whether the tablet of the pen last used is read directly.
    pub fn pen_is_raw(&self) -> bool {
        self.pens.is_raw()
    }

    /// Whether the window should close.
    pub fn is_closed(&self) -> bool {
        self.updates.is_closed()
    }

    /// A new title for the window.
    pub fn take_title(&mut self) -> Option<String> {
        self.updates.take_title()
    }

    /// Something for the clipboard.
    pub(in crate::app) fn take_copied(&mut self) -> Option<Copied> {
        self.updates.take_copied()
    }

    /// Whether the clipboard's content was asked for since the last call.
    pub(in crate::app) fn take_paste_request(&mut self) -> bool {
        self.updates.take_paste_request()
    }
}
