//! Strokes between drawings and windows, by the clipboard.
//!
//! Selected strokes are copied as the text of a sketch file, so that pressure, tilt and tools go along. Text from elsewhere is
//! read as a sketch file or as SVG; pictures go under the drawing.

use super::Editor;
use super::updates::Copied;
use crate::app::messages::Msg;
use crate::app::panels::snapshot::Notice;
use crate::sketch::{self, Sketch, json};

impl Editor {
    /// Puts a picture on the clipboard.
    pub(in crate::app) fn copy_picture(&mut self, picture: egui::ColorImage) {
        self.updates.copy(Copied::Picture(picture));
    }

    /// Puts the selected strokes on the clipboard, in the order in which they were drawn.
    pub(super) fn copy_selected(&mut self) {
        let selected = self.canvas.selection().ids();
        let strokes = self.sketch().strokes.iter().filter(|s| selected.contains(&s.id));
        let strokes: Vec<_> = strokes.cloned().collect();
        if !strokes.is_empty() {
            let text = json::write(&Sketch { strokes, ..Sketch::empty() });
            self.updates.copy(Copied::Text(text));
        }
    }

    /// The same, and removes them.
    pub(super) fn cut_selected(&mut self) {
        self.copy_selected();
        self.perform(crate::app::Action::DeleteSelected);
    }

    /// Puts the strokes of a pasted text into the drawing; says so where it holds none.
    pub fn paste_text(&mut self, text: &str) {
        if self.dialogs.is_open() {
            return;
        }
        match sketch::editable_from_bytes(text.as_bytes(), "clipboard") {
            Ok((Sketch { strokes, .. }, _)) if !strokes.is_empty() => {
                self.on_canvas(|canvas, drawing, out| canvas.insert(&strokes, drawing, out));
                self.dialogs.close_part_menu();
            }
            _ => self.notify(Notice::info(self.prefs.messages().get(Msg::NoticeNothingToPaste))),
        }
    }
}

#[cfg(test)]
#[path = "clipboard_tests.rs"]
mod tests;
