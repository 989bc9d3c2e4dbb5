//! Which side of the window an event of a pointer belongs to: the canvas, the plant, or neither, which is egui's.
//!
//! A press decides: what went down on a side stays that side's until it is lifted. Both sides get pens; mice and
//! fingers over the plant go to egui. What hovers over the canvas is the canvas's while nothing is held down.

use crate::pen::{PenEvent, PenPhase, PenTool};
use std::collections::BTreeMap;

/// A side of the window that gets pointers sample by sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Canvas,
    Plant,
}

/// Tells pointers apart: fingers by their number, everything else is one pointer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum PointerName {
    Pointer,
    Finger(u64),
}

impl PointerName {
    fn of(tool: PenTool) -> Self {
        match tool {
            PenTool::Finger(number) => Self::Finger(number),
            PenTool::Pen | PenTool::Eraser | PenTool::Mouse => Self::Pointer,
        }
    }
}

/// Pointers that went down on a side and were not lifted yet, and whether one hovers over the canvas.
#[derive(Debug, Default)]
pub(super) struct Sides {
    held: BTreeMap<PointerName, Side>,
    /// Whether the pointer was over the canvas when last seen, so that egui is notified once that it left.
    over_canvas: bool,
}

impl Sides {
    /// Whose event it is, if this side is under the pointer.
    pub(super) fn owner(&mut self, event: &PenEvent, over: Option<Side>) -> Option<Side> {
        let tool = event.sample.tool;
        let name = PointerName::of(tool);
        match event.phase {
            PenPhase::Down => {
                let side = over.filter(|side| *side == Side::Canvas || is_pen(tool))?;
                if self.held.contains_key(&name) {
                    return None;
                }
                self.held.insert(name, side);
                Some(side)
            }
            PenPhase::Move => self.held.get(&name).copied(),
            PenPhase::Up | PenPhase::Cancel => self.held.remove(&name),
            PenPhase::Enter | PenPhase::Hover => {
                over.filter(|side| *side == Side::Canvas && self.held.is_empty())
            }
            PenPhase::Leave if self.held.get(&name) == Some(&Side::Plant) => self.held.remove(&name),
            PenPhase::Leave => self.leave_canvas().then_some(Side::Canvas),
        }
    }

    /// Whether the pointer is over the canvas.
    pub(super) fn is_over_canvas(&self) -> bool {
        self.over_canvas
    }

    /// The pointer is over the canvas; whether it was there.
    pub(super) fn enter_canvas(&mut self) -> bool {
        std::mem::replace(&mut self.over_canvas, true)
    }

    /// The pointer is no longer over the canvas; whether it was.
    pub(super) fn leave_canvas(&mut self) -> bool {
        std::mem::take(&mut self.over_canvas)
    }
}

/// Whether it is a pen, by either end.
pub(super) fn is_pen(tool: PenTool) -> bool {
    matches!(tool, PenTool::Pen | PenTool::Eraser)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pen::tests::Hand;

    #[test]
    fn a_press_decides_for_the_side_until_it_is_lifted() {
        let mut sides = Sides::default();
        let mut hand = Hand::default();
        let mut owner = |phase, tool, over| sides.owner(&hand.event(phase, tool, 0.0), over);
        let (canvas, plant) = (Some(Side::Canvas), Some(Side::Plant));
        assert_eq!(owner(PenPhase::Down, PenTool::Pen, plant), plant);
        assert_eq!(owner(PenPhase::Move, PenTool::Pen, canvas), plant, "it began on the plant");
        assert_eq!(owner(PenPhase::Down, PenTool::Finger(1), canvas), canvas, "a finger beside it");
        assert_eq!(owner(PenPhase::Up, PenTool::Pen, canvas), plant);
        assert_eq!(owner(PenPhase::Move, PenTool::Pen, plant), None);
        assert_eq!(owner(PenPhase::Cancel, PenTool::Finger(1), None), canvas);
        assert_eq!(owner(PenPhase::Hover, PenTool::Pen, canvas), canvas);
        assert_eq!(owner(PenPhase::Hover, PenTool::Pen, plant), None, "egui shows what is under it");
        for tool in [PenTool::Mouse, PenTool::Finger(2)] {
            assert_eq!(owner(PenPhase::Down, tool, plant), None, "egui's");
        }
        assert_eq!(owner(PenPhase::Down, PenTool::Eraser, plant), plant);
        assert_eq!(owner(PenPhase::Leave, PenTool::Eraser, plant), plant);
        assert_eq!(owner(PenPhase::Up, PenTool::Eraser, plant), None, "it has left");
    }
}
