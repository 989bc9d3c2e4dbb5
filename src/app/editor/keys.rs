//! What keys mean when no text is being written.

use super::Editor;
use crate::app::action::Action;
use crate::app::canvas::CanvasKey;
use crate::app::canvas_tool::Mirror;
use crate::app::panels::snapshot::Dialog;
use crate::app::panels::toolbar;
use crate::sketch::Tool;
use egui::{Key, Modifiers};

impl Editor {
    /// Handles a key; whether it meant something here.
    pub fn key(&mut self, key: Key, modifiers: Modifiers, pressed: bool, repeat: bool) -> bool {
        let walks = self.walking_key(key, modifiers.shift).filter(|_| pressed && !self.dialogs.is_open());
        if let Some(action) = walks {
            self.perform(action);
            return true;
        }
        if key == Key::Escape && pressed && self.escape_from_plant_tools() {
            return true;
        }
        if let Some(canvas_key) = canvas_key(key) {
            // A held key repeats its press; the canvas gets it once.
            if !repeat {
                self.on_canvas(|canvas, _, out| canvas.key(canvas_key, pressed, out));
            }
            return key == Key::Space && !self.dialogs.is_open();
        }
        if !pressed || self.dialogs.is_open() {
            return false;
        }
        if repeat && !matches!(key, Key::Z | Key::Y) && steps(key).is_none() {
            return false;
        }
        let action =
            if modifiers.command { command(key, modifiers.shift) } else { self.plain(key, modifiers) };
        let known = action.is_some();
        if let Some(action) = action {
            self.perform(action);
        }
        known
    }

    /// Lays the tool of the plant's view down unless something on the canvas, or a dialog, is to be left first; whether there was one.
    fn escape_from_plant_tools(&mut self) -> bool {
        let leaves = self.has_plant_tool()
            && !self.dialogs.is_open()
            && self.canvas.selection().is_empty()
            && self.canvas.growing().is_none();
        if leaves {
            self.lay_down_plant_tools();
        }
        leaves
    }

    /// Carries out what a key or a wheel of a tablet is set to; in a dialog they do nothing, like other keys.
    pub fn tablet_action(&mut self, action: Action) {
        if !self.dialogs.is_open() {
            self.perform(action);
        }
    }

    /// Modifier keys, which the canvas gets too.
    pub fn modifiers(&mut self, before: Modifiers, now: Modifiers) {
        (self.petals.alt, self.posing.is_fine) = (now.alt, now.alt);
        for (key, was, is) in
            [(CanvasKey::Shift, before.shift, now.shift), (CanvasKey::Ctrl, before.ctrl, now.ctrl)]
        {
            if was != is {
                self.on_canvas(|canvas, _, out| canvas.key(key, is, out));
            }
        }
    }

    /// Strokes that are selected go before a plant that is, and the branch that is held in the view of the plant before both.
    fn delete(&self) -> Action {
        if self.can_take_part_away() {
            return Action::TakeAwayPart;
        }
        let plant = self.beside.selected().filter(|_| self.canvas.selection().is_empty());
        plant.map_or(Action::DeleteSelected, Action::RemovePlant)
    }

    fn plain(&self, key: Key, modifiers: Modifiers) -> Option<Action> {
        if modifiers.alt {
            return None;
        }
        if let Some((right, down)) = steps(key) {
            let is_any = !self.canvas.selection().is_empty();
            return is_any.then_some(Action::NudgeSelected { right, down, far: modifiers.shift });
        }
        match key {
            Key::Delete | Key::Backspace => Some(self.delete()),
            Key::K => Some(Action::ShapePetals(!self.petals.is_on)),
            Key::W => Some(Action::DrawInSpace(!self.space.is_on)),
            Key::U => Some(self.toggled(Tool::GrowthBrush)),
            Key::X => Some(self.toggled(Tool::PruningBrush)),
            Key::I => Some(self.toggled(Tool::LightBrush)),
            Key::Y => Some(self.toggled(Tool::LeafBrush)),
            Key::M => Some(self.toggled(Tool::FlowerBrush)),
            Key::N => Some(Action::PaintGarden(!self.garden.is_on)),
            Key::Q => Some(Action::Walk(!self.plant.state.walking)),
            Key::J => Some(Action::PoseParts(!self.posing.is_on)),
            Key::G => Some(Action::ShowDialog(Dialog::PlantSpecies(None))),
            Key::Home | Key::Num0 => Some(Action::FitCanvas),
            Key::Num1 => Some(Action::FrontView),
            Key::H if modifiers.shift => Some(Action::MirrorSelected(Mirror::LeftRight)),
            Key::V if modifiers.shift => Some(Action::MirrorSelected(Mirror::TopBottom)),
            Key::F1 => Some(Action::ShowDialog(Dialog::About)),
            _ => {
                toolbar::TOOLS.iter().find(|entry| entry.key == key).map(|entry| Action::SetTool(entry.tool))
            }
        }
    }
}

fn canvas_key(key: Key) -> Option<CanvasKey> {
    match key {
        Key::Space => Some(CanvasKey::Space),
        Key::Escape => Some(CanvasKey::Escape),
        _ => None,
    }
}

/// Steps to the right and down of an arrow key.
fn steps(key: Key) -> Option<(i8, i8)> {
    match key {
        Key::ArrowLeft => Some((-1, 0)),
        Key::ArrowRight => Some((1, 0)),
        Key::ArrowUp => Some((0, -1)),
        Key::ArrowDown => Some((0, 1)),
        _ => None,
    }
}

/// Keys with Ctrl, or Cmd on a Mac.
fn command(key: Key, shift: bool) -> Option<Action> {
    Some(match (key, shift) {
        (Key::Z, false) => Action::Undo,
        (Key::Z, true) | (Key::Y, false) => Action::Redo,
        (Key::N, false) => Action::New,
        (Key::O, false) => Action::Open,
        (Key::S, false) => Action::Save,
        (Key::S, true) => Action::SaveAs,
        (Key::E, false) => Action::ShowExport,
        (Key::A, false) => Action::SelectAll,
        (Key::D, false) => Action::DuplicateSelected,
        (Key::C, false) => Action::CopySelected,
        (Key::X, false) => Action::CutSelected,
        (Key::V, false) => Action::Paste,
        (Key::Q, false) => Action::Quit,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn undo_and_redo_have_their_usual_keys() {
        assert_eq!(command(Key::Z, false), Some(Action::Undo));
        assert_eq!(command(Key::Z, true), Some(Action::Redo));
        assert_eq!(command(Key::Y, false), Some(Action::Redo));
        assert_eq!(command(Key::B, false), None);
    }
}
