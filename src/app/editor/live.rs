//! What can be seen of the live drawing from outside: for those who show it, and for those who measure it.

use super::{Editor, Versions};
use crate::app::canvas::Canvas;
use crate::app::canvas::stroke_builder::StrokeBuilder;
use crate::app::worker::Growing;
use crate::pipeline::Built;
use crate::render::Look;
use crate::sketch::{Sketch, StrokeId};
use std::sync::Arc;

/// How far the plant is behind the drawing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Revisions {
    /// Number of the newest drawing that the worker was given; it grows by one with every drawing.
    pub submitted: u64,
    /// Number of the drawing whose plant was collected last, also where that could not be built.
    pub collected: u64,
}

/// How much of the stroke under the pen was handed to the worker for good.
#[derive(Debug, Default)]
pub(super) struct Handed(Option<(StrokeId, usize)>);

impl Handed {
    /// What of the stroke is new since the last call, or may have moved.
    pub(super) fn grown(&mut self, stroke: Option<&StrokeBuilder>) -> Option<Growing> {
        let Some(stroke) = stroke else {
            self.0 = None;
            return None;
        };
        let (id, tool) = (stroke.id(), stroke.tool());
        let kept = self.0.filter(|(known, _)| *known == id).map_or(0, |(_, kept)| kept);
        self.0 = Some((id, stroke.settled()));
        Some(Growing { id, tool, kept, points: stroke.points()[kept..].to_vec() })
    }
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

    /// How far the plant is behind the drawing.
    pub fn revisions(&self) -> Revisions {
        Revisions { submitted: self.building.submitted, collected: self.building.collected }
    }
}
