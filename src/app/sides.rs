//! Which side of the window an event of a pointer belongs to: the canvas, the plant, or neither, which is egui's.
//!
//! A press decides: what went down on a side stays that side's until it is lifted. Over the plant any button of a mouse is a
//! press. What hovers over the canvas is the canvas's while nothing is held down; what hovers over the plant is egui's.

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
    /// Whether the mouse is held on the plant by a button that is not the first.
    by_button: bool,
    /// Whether such a button was held when the mouse was seen last.
    had_button: bool,
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
                if self.held.contains_key(&name) {
                    // A second button of a mouse that is at work on the plant.
                    return self.by_button.then_some(Side::Plant);
                }
                let side = over?;
                self.held.insert(name, side);
                Some(side)
            }
            PenPhase::Move => self.held.get(&name).copied(),
            PenPhase::Up if self.by_button && tool == PenTool::Mouse => Some(Side::Plant),
            PenPhase::Up | PenPhase::Cancel => self.release(name),
            PenPhase::Hover if tool == PenTool::Mouse && self.hovers_with_button(event, over) => {
                Some(Side::Plant)
            }
            PenPhase::Enter | PenPhase::Hover => {
                over.filter(|side| *side == Side::Canvas && self.held.is_empty())
            }
            PenPhase::Leave if self.held.get(&name) == Some(&Side::Plant) => self.release(name),
            PenPhase::Leave => self.leave_canvas().then_some(Side::Canvas),
        }
    }

    fn release(&mut self, name: PointerName) -> Option<Side> {
        if name == PointerName::Pointer {
            self.by_button = false;
        }
        self.held.remove(&name)
    }

    /// Whether a mouse is at work on the plant with a button that is not the first, or just was.
    fn hovers_with_button(&mut self, event: &PenEvent, over: Option<Side>) -> bool {
        let buttons = event.sample.buttons;
        let is_pressed = buttons.secondary || buttons.middle;
        let was_pressed = std::mem::replace(&mut self.had_button, is_pressed);
        if self.by_button {
            if !is_pressed {
                self.release(PointerName::Pointer);
            }
            return true;
        }
        let is_new = is_pressed && !was_pressed && !self.held.contains_key(&PointerName::Pointer);
        let begins = is_new && over == Some(Side::Plant);
        if begins {
            self.held.insert(PointerName::Pointer, Side::Plant);
            self.by_button = true;
        }
        begins
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
    use crate::pen::PenButtons;
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
            assert_eq!(owner(PenPhase::Down, tool, plant), plant);
            assert_eq!(owner(PenPhase::Up, tool, canvas), plant);
        }
        assert_eq!(owner(PenPhase::Down, PenTool::Mouse, None), None, "egui's");
        assert_eq!(owner(PenPhase::Down, PenTool::Eraser, plant), plant);
        assert_eq!(owner(PenPhase::Leave, PenTool::Eraser, plant), plant);
        assert_eq!(owner(PenPhase::Up, PenTool::Eraser, plant), None, "it has left");
    }

    #[test]
    fn any_button_of_a_mouse_holds_the_plant() {
        let mut sides = Sides::default();
        let mut owner = |phase, secondary: bool, over| {
            let buttons = PenButtons { secondary, ..PenButtons::default() };
            sides.owner(&Hand { buttons, ..Hand::default() }.event(phase, PenTool::Mouse, 0.0), over)
        };
        let (canvas, plant) = (Some(Side::Canvas), Some(Side::Plant));
        assert_eq!(owner(PenPhase::Hover, true, plant), plant);
        assert_eq!(owner(PenPhase::Hover, true, canvas), plant, "until it is let go");
        assert_eq!(owner(PenPhase::Down, true, canvas), plant, "another button changes nothing");
        assert_eq!(owner(PenPhase::Move, true, canvas), plant);
        assert_eq!(owner(PenPhase::Up, true, canvas), plant);
        assert_eq!(owner(PenPhase::Hover, false, canvas), plant, "its end is the plant's, too");
        assert_eq!(owner(PenPhase::Hover, false, canvas), canvas);
        assert_eq!(owner(PenPhase::Hover, false, plant), None, "egui shows what is under it");
        assert_eq!(owner(PenPhase::Hover, true, None), None, "it was pressed on a panel");
        assert_eq!(owner(PenPhase::Hover, true, plant), None);
    }
}
