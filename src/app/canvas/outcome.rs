//! What goes into the canvas besides pens, and what comes out.

use crate::app::action::Action;
use crate::sketch::change::StrokeChange;
use crate::sketch::{Stroke, StrokeId};
use glam::DVec2;
use std::sync::Arc;

/// The drawing as the canvas needs it.
pub struct Drawing<'a> {
    /// The strokes, oldest first.
    pub strokes: &'a [Arc<Stroke>],
    /// Gives a name that no stroke has or had.
    pub new_id: &'a mut dyn FnMut() -> StrokeId,
}

/// What the window has to do.
#[derive(Clone, Debug, PartialEq)]
pub enum CanvasOutcome {
    /// A stroke of this name has its first point: [`super::Canvas::growing`].
    StrokeBegan(StrokeId),
    /// The growing stroke has new points.
    StrokeGrew {
        /// First point that is new or has moved.
        from: usize,
    },
    /// A stroke is done and belongs to the drawing now, as one change. Its last points may differ from those last seen
    /// growing.
    StrokeFinished(Arc<Stroke>),
    /// The stroke of this name does not count.
    StrokeCancelled(StrokeId),
    /// What [`super::Canvas::preview`] says is new.
    PreviewChanged,
    /// Change the drawing, as one step to undo; a preview ends with it.
    Changed(Vec<StrokeChange>),
    /// The same for strokes moved by a small step: many in a row are one step to undo.
    Nudged(Vec<StrokeChange>),
    /// The canvas lies elsewhere.
    ViewChanged,
    /// Other strokes are selected.
    SelectionChanged,
    /// Paint overlay and cursor again.
    OverlayChanged,
    /// An action for the application.
    Action(Action),
    /// The plant is to be turned by a drag of so many physical pixels.
    Orbit(DVec2),
    /// Ask what to draw next.
    AskWhatToDraw {
        /// Where, in the window.
        at: DVec2,
    },
    /// A stroke was tapped: ask what it is.
    TapOnStroke {
        /// Which.
        id: StrokeId,
        /// Where, in the window.
        at: DVec2,
    },
}

/// Keys that change what the pen does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CanvasKey {
    /// Moves the canvas while held; with Shift turns it, with Ctrl zooms.
    Space,
    /// Adds to the selection; see also [`super::transform`].
    Shift,
    /// With Space: zoom.
    Ctrl,
    /// Gives up what is being done, else the selection.
    Escape,
}

/// How far something scrolled, as winit has it: positive moves what is seen right and down, and a wheel zooms in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scroll {
    /// Notches of a wheel.
    Lines(DVec2),
    /// Physical pixels of a touchpad.
    Pixels(DVec2),
}
