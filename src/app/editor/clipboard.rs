//! Strokes between drawings and windows, by the clipboard.
//!
//! Selected strokes are copied as the text of a sketch file, so that pressure, tilt and tools go along. Text from elsewhere is
//! read as a sketch file or as SVG; pictures go under the drawing.

use super::Editor;
use crate::app::messages::Msg;
use crate::app::panels::snapshot::Notice;
use crate::sketch::{self, Change, Sketch, StrokeChange, json};
use std::time::{Duration, Instant};

/// Moves by keys that follow each other within this time are one step to undo.
const BURST: Duration = Duration::from_secs(1);

/// What the editor and the system's clipboard want of each other; the window carries it out.
#[derive(Default)]
pub(super) struct Clipboard {
    copied: Option<Copied>,
    /// What the clipboard holds is to be fetched.
    pub(super) wants_paste: bool,
}

/// Something for the clipboard.
pub(in crate::app) enum Copied {
    /// The plant's picture.
    Picture(egui::ColorImage),
    /// Strokes as the text of a sketch file.
    Text(String),
}

impl Editor {
    /// Something for the clipboard.
    pub(in crate::app) fn take_copied(&mut self) -> Option<Copied> {
        self.clipboard.copied.take()
    }

    /// Whether the clipboard's content was asked for since the last call.
    pub(in crate::app) fn take_paste_request(&mut self) -> bool {
        std::mem::take(&mut self.clipboard.wants_paste)
    }

    /// Puts a picture on the clipboard.
    pub(in crate::app) fn copy_picture(&mut self, picture: egui::ColorImage) {
        self.clipboard.copied = Some(Copied::Picture(picture));
    }

    /// Puts the selected strokes on the clipboard, in the order in which they were drawn.
    pub(super) fn copy_selected(&mut self) {
        let selected = self.canvas.selection().ids();
        let strokes = self.document.sketch().strokes.iter().filter(|s| selected.contains(&s.id));
        let strokes: Vec<_> = strokes.cloned().collect();
        if !strokes.is_empty() {
            let text = json::write(&Sketch { strokes, ..Sketch::empty() });
            self.clipboard.copied = Some(Copied::Text(text));
        }
    }

    /// The same, and removes them.
    pub(super) fn cut_selected(&mut self) {
        self.copy_selected();
        self.perform(crate::app::Action::DeleteSelected);
    }

    /// Puts the strokes of a pasted text into the drawing; says so where it holds none.
    pub fn paste_text(&mut self, text: &str) {
        if self.dialog.is_some() {
            return;
        }
        match sketch::editable_from_bytes(text.as_bytes(), "clipboard") {
            Ok((Sketch { strokes, .. }, _)) if !strokes.is_empty() => {
                self.on_canvas(|canvas, drawing, out| canvas.insert(&strokes, drawing, out));
                self.part_menu = None;
            }
            _ => self.tell(Notice::info(self.messages.get(Msg::NoticeNothingToPaste))),
        }
    }

    /// Strokes were moved by a key: one step with those moved just before.
    pub(super) fn nudged(&mut self, changes: Vec<StrokeChange>) {
        let now = Instant::now();
        if self.nudged_at.replace(now).is_none_or(|last| now - last > BURST) {
            self.document.end_merging();
        }
        self.change_merging(Change::strokes(changes), "nudge");
    }
}

#[cfg(test)]
#[path = "clipboard_tests.rs"]
mod tests;
