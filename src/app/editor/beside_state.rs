//! Which plant beside the drawn one is selected, and what of it a pointer holds.

use glam::Vec2;

/// What a pointer holds of a plant's marks on the canvas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Hold {
    /// Its foot: from the pointer to it, canvas pixels.
    Foot(Vec2),
    /// Its top: from the pointer to it, canvas pixels.
    Top(f32),
}

/// Which of the plants is selected, and what of it is held.
#[derive(Debug, Default)]
pub(super) struct Beside {
    selected: Option<usize>,
    pub(super) hold: Option<Hold>,
}

impl Beside {
    /// The selected one, by its place in the list.
    pub(super) fn selected(&self) -> Option<usize> {
        self.selected
    }

    /// Selects one, or none.
    pub(super) fn select(&mut self, place: Option<usize>) {
        self.selected = place;
        self.hold = None;
    }

    /// There are so many plants now.
    pub(super) fn keep_known(&mut self, count: usize) {
        if self.selected.is_some_and(|place| place >= count) {
            self.select(None);
        }
    }
}
