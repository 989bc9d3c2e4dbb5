//! One tool at work on the canvas: which it is, which pointer it belongs to, and what keeps it going.

use super::stroke_builder::StrokeBuilder;
use super::tool_context::{ToolContext, Touch};
use super::tools::{DragHandle, Erase, Lasso, MoveView, Pen, Shown};
use super::transform::Drag;
use crate::app::tool::Tool;
use crate::pen::{PenButtons, PenSample, PenTool};

/// Farthest that a pen or mouse moves in a tap, in logical pixels.
const TAP_SLOP: f64 = 4.0;

/// Farthest that a finger moves in a tap, in logical pixels.
const FINGER_TAP_SLOP: f64 = 10.0;

/// What keeps an activity going.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Trigger {
    Tip,
    /// The middle button of a mouse or the upper one of a pen.
    Middle,
    /// The right button of a mouse or the lower one of a pen.
    Secondary,
    /// The third button of a pen.
    Third,
}

/// The tool that is at work.
#[derive(Debug)]
pub(super) enum Doing {
    Draw(Pen),
    Erase(Erase),
    Lasso(Lasso),
    Drag(DragHandle),
    View(MoveView),
}

impl Doing {
    pub(super) fn tool(&mut self) -> &mut dyn for<'d> Tool<ToolContext<'d>, Shown> {
        match self {
            Self::Draw(tool) => tool,
            Self::Erase(tool) => tool,
            Self::Lasso(tool) => tool,
            Self::Drag(tool) => tool,
            Self::View(tool) => tool,
        }
    }

    fn shown(&self) -> Shown {
        match self {
            Self::Draw(tool) => preview(tool),
            Self::Erase(tool) => preview(tool),
            Self::Lasso(tool) => preview(tool),
            Self::Drag(tool) => preview(tool),
            Self::View(tool) => preview(tool),
        }
    }
}

fn preview(tool: &dyn for<'d> Tool<ToolContext<'d>, Shown>) -> Shown {
    tool.preview()
}

/// One tool at work.
#[derive(Debug)]
pub(super) struct Activity {
    pub(super) owner: PenTool,
    pub(super) doing: Doing,
    pub(super) trigger: Trigger,
    pub(super) touch: Touch,
}

impl Activity {
    pub(super) fn new(sample: &PenSample, trigger: Trigger, doing: Doing) -> Self {
        let touch = Touch { start: *sample, last: sample.position, is_still: true };
        Self { owner: sample.tool, doing, trigger, touch }
    }

    /// Whether it works on strokes of the drawing, which must not change under it.
    pub(super) fn holds_strokes(&self) -> bool {
        matches!(self.doing, Doing::Erase(_) | Doing::Drag(_))
    }

    pub(super) fn is_drag(&self) -> bool {
        matches!(self.doing, Doing::Drag(_))
    }

    /// Whether the button that keeps it going is released.
    pub(super) fn is_let_go(&self, now: PenButtons) -> bool {
        match self.trigger {
            Trigger::Tip => false,
            Trigger::Middle => !now.middle,
            Trigger::Secondary => !now.secondary,
            Trigger::Third => !now.third,
        }
    }

    /// The stroke that is being drawn.
    pub(super) fn stroke(&self) -> Option<&StrokeBuilder> {
        match &self.doing {
            Doing::Draw(pen) => pen.stroke(),
            _ => None,
        }
    }

    /// Sees whether a sample goes further than a tap does.
    pub(super) fn note(&mut self, sample: &PenSample, scale_factor: f64) {
        let is_finger = matches!(sample.tool, PenTool::Finger(_));
        let slop = if is_finger { FINGER_TAP_SLOP } else { TAP_SLOP };
        self.touch.is_still &= sample.position.distance(self.touch.start.position) <= slop * scale_factor;
    }

    /// What is seen of its work before that counts; a handle is dragged once it moved further than a tap.
    pub(super) fn shown(&self) -> Shown {
        match self.doing.shown() {
            Shown::Drag(_) if self.touch.is_still => Shown::Nothing,
            shown => shown,
        }
    }

    /// The drag of a handle, once it moved further than a tap.
    pub(super) fn drag(&self) -> Option<Drag> {
        match self.shown() {
            Shown::Drag(drag) => Some(drag),
            _ => None,
        }
    }
}
