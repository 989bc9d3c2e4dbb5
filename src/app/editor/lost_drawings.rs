//! Drawings that windows left which are gone: what recovery found of them, and their pictures.

use crate::app::messages::{Messages, Msg};
use crate::app::panels::snapshot::{Dialog, Recovered};
use crate::app::theme::Palette;
use crate::app::thumbnail;
use crate::sketch::Sketch;
use crate::sketch::journal::{JournalError, JournalWriter, Meta, Recoverable, Recovery, Restored};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// Width and height of a found drawing's picture in pixels.
const THUMBNAIL: [usize; 2] = [192, 144];

/// The folder of journals, and what was found in it.
pub(super) struct LostDrawings {
    recovery: Recovery,
    found: Vec<Recoverable>,
    /// Pictures of them by their folders.
    pictures: Vec<(PathBuf, egui::TextureHandle)>,
}

impl LostDrawings {
    /// Those in the program's folder of state.
    pub(super) fn at(state: &Path) -> Self {
        Self { recovery: Recovery::at(state), found: Vec::new(), pictures: Vec::new() }
    }

    /// Looks for them.
    pub(super) fn look(&mut self) -> Result<(), JournalError> {
        self.found = self.recovery.list()?;
        if let Some(first) = self.found.first() {
            tracing::debug!("recoverable count={} strokes={}", self.found.len(), first.strokes());
        }
        Ok(())
    }

    /// Where what is damaged is kept.
    pub(super) fn damaged_files(&self) -> PathBuf {
        self.recovery.damaged_files()
    }

    /// Begins the journal of a drawing.
    pub(super) fn begin(
        &self,
        sketch: &Sketch,
        meta: Meta,
        is_saved: bool,
    ) -> Result<JournalWriter, JournalError> {
        self.recovery.start(sketch, meta, is_saved)
    }

    /// Opens one again, whose journal goes on; `None` if it is not among them.
    pub(super) fn resume(
        &mut self,
        folder: &Path,
    ) -> Option<Result<(Restored, Meta, JournalWriter), JournalError>> {
        let found = self.take(folder)?;
        Some(self.recovery.resume(found))
    }

    /// Deletes one.
    pub(super) fn discard(&mut self, folder: &Path) -> Result<(), JournalError> {
        self.take(folder).map_or(Ok(()), |found| self.recovery.discard(found))
    }

    fn take(&mut self, folder: &Path) -> Option<Recoverable> {
        let at = self.found.iter().position(|found| found.folder() == folder)?;
        Some(self.found.remove(at))
    }

    /// The list of them; `None` where there are none.
    pub(super) fn dialog(&self, messages: &Messages) -> Option<Dialog> {
        let untitled = messages.get(Msg::AppUntitled);
        let name = |title: &str| if title.is_empty() { untitled } else { title }.to_owned();
        let recovered = self.found.iter().map(|found| Recovered {
            path: found.folder().to_owned(),
            name: name(&found.meta.title),
            strokes: found.strokes(),
            when: ago(found.modified, messages),
            thumbnail: self.picture_of(found.folder()),
        });
        (!self.found.is_empty()).then(|| Dialog::Recovery(recovered.collect()))
    }

    fn picture_of(&self, folder: &Path) -> Option<egui::TextureId> {
        self.pictures.iter().find(|(of, _)| of == folder).map(|(_, picture)| picture.id())
    }

    /// Draws those that have no picture yet; whether there were any.
    pub(super) fn draw_pictures(&mut self, ctx: &egui::Context, palette: &Palette) -> bool {
        if self.found.len() <= self.pictures.len() {
            return false;
        }
        for found in &self.found {
            let known = self.picture_of(found.folder()).is_some();
            if let Some(restored) = found.content.as_ref().ok().filter(|_| !known) {
                let picture = thumbnail::of_drawing(&restored.sketch, THUMBNAIL, palette.paper, palette.ink);
                let handle = ctx.load_texture("found drawing", picture, egui::TextureOptions::LINEAR);
                self.pictures.push((found.folder().to_owned(), handle));
            }
        }
        true
    }

    /// A new egui context has no pictures.
    pub(super) fn forget_pictures(&mut self) {
        self.pictures.clear();
    }
}

/// How long ago something was, in minutes, hours or days.
fn ago(then: SystemTime, messages: &Messages) -> String {
    let minutes = then.elapsed().unwrap_or_default().as_secs() / 60;
    let (msg, count) = match minutes {
        0 => return messages.get(Msg::RecoveryNow).to_owned(),
        1..=59 => (Msg::RecoveryMinutes, minutes),
        60..=2879 => (Msg::RecoveryHours, minutes / 60),
        _ => (Msg::RecoveryDays, minutes / 1440),
    };
    messages.fill(msg, &[("count", &count)])
}
