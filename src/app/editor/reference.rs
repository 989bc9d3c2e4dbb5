//! The picture under the drawing that artists trace.

use super::Editor;
use crate::app::panels::snapshot::Notice;
use crate::sketch::reference::{Picture, Reference};
use crate::sketch::{Change, limits};
use std::io::Read;
use std::path::Path;
use std::sync::Arc;

/// Share of the visible canvas that a new picture fills.
const FILL: f64 = 0.8;

impl Editor {
    /// Puts a picture file under the drawing.
    pub(super) fn put_reference(&mut self, path: &Path) {
        match read(path) {
            Ok(bytes) => self.lay(bytes, &path.display().to_string()),
            Err(error) => self.tell(Notice::error(format!("{} cannot be read: {error}", path.display()), "")),
        }
    }

    /// Puts a pasted picture under the drawing.
    pub fn paste_picture(&mut self, bytes: Vec<u8>) {
        self.lay(bytes, "the pasted picture");
    }

    fn lay(&mut self, bytes: Vec<u8>, name: &str) {
        match Picture::new(bytes) {
            Ok(picture) => {
                let (center, width) = self.place_for(&picture);
                self.change(Change::reference(Some(Reference::new(picture, center, width))));
            }
            Err(error) => self.tell(Notice::error(format!("{name}: {error}"), "")),
        }
    }

    /// The middle of what is seen of the canvas, and a width that fits.
    fn place_for(&self, picture: &Picture) -> (glam::Vec2, f32) {
        let view = self.canvas.view();
        let area = self.layout.canvas_px();
        let size = picture.size_px().as_dvec2();
        let room = area.size() * FILL / view.zoom();
        let width = (room.x).min(room.y * size.x / size.y).max(1.0);
        (view.to_canvas(area.center()).as_vec2(), width as f32)
    }

    /// Changes how the picture lies; one slider is one step.
    pub(super) fn edit_reference(&mut self, edit: impl FnOnce(&mut Reference)) {
        if let Some(reference) = &self.document.sketch().reference {
            let mut reference = Reference::clone(reference);
            edit(&mut reference);
            let change = Change { reference: Some(Some(Arc::new(reference))), ..Change::default() };
            self.change_merging(change, "reference");
        }
    }
}

/// A file's bytes, no more than a picture may have.
fn read(path: &Path) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let most = limits::MAX_REFERENCE_BYTES as u64 + 1;
    std::fs::File::open(path)?.take(most).read_to_end(&mut bytes)?;
    Ok(bytes)
}
