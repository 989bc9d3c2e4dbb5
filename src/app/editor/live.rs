//! What can be seen of the live drawing from outside: for those who show it, and for those who measure it.

use super::{Editor, Versions};
use crate::app::canvas::Canvas;
use crate::pipeline::Built;
use crate::render::Look;
use crate::sketch::Sketch;
use std::sync::Arc;

/// How far the plant is behind the drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Revisions {
    /// Number of the newest drawing that the worker was given; it grows by one with every drawing.
    pub submitted: u64,
    /// Number of the drawing whose plant was collected last, also where that could not be built.
    pub collected: u64,
}

impl Editor {
    /// The drawing without what is still being drawn.
    pub fn sketch(&self) -> &Sketch {
        self.document.sketch()
    }

    /// What pens do to the drawing: the growing stroke, the selection, the view.
    pub fn canvas(&self) -> &Canvas {
        &self.canvas
    }

    /// The newest plant.
    pub fn built(&self) -> Option<&Arc<Built>> {
        self.built.as_ref()
    }

    /// What the graphics card must hear of.
    pub fn versions(&self) -> Versions {
        self.versions
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
        Revisions { submitted: self.building.submitted, collected: self.building.collected }
    }
}
