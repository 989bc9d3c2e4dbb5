//! Exports as the artist asks for them.

use super::Editor;
use super::export::{Exported, Order};
use crate::app::messages::Msg;
use crate::app::panels::snapshot::Notice;
use crate::formats::textures;
use crate::input::Sources;
use crate::pipeline::{self, Built};
use std::path::PathBuf;

impl Editor {
    /// Starts an export.
    pub(super) fn begin_export(&mut self, path: PathBuf) {
        let Some(built) = self.built().cloned() else { return };
        let order = Order {
            path,
            choice: self.prefs.settings().export.clone().sane(),
            sketch: self.sketch().clone(),
            camera: self.plant.camera(),
            light: self.plant.light(),
            view: self.plant.state,
            sources: self.sources(&built),
            built,
        };
        let begun = self.disk.exports.begin(order, self.background.wake());
        self.notify_failure(begun);
    }

    /// The files that the plant is made from.
    fn sources(&self, built: &Built) -> Sources {
        let mut sources = Sources::default();
        let species = pipeline::species_file(self.sketch(), self.drawing.folder());
        self.drawing.path().into_iter().chain(species.as_deref()).for_each(|file| sources.add(file));
        textures::files(built.plant.materials()).for_each(|picture| sources.add(picture));
        sources
    }

    /// Shows what came of an export that has ended.
    pub(super) fn collect_export(&mut self) {
        let Some(Exported { name, result }) = self.disk.exports.take() else { return };
        match result {
            Some(Ok(bytes)) => {
                tracing::debug!("exported {name} bytes={bytes}");
                let what = self.prefs.messages().fill(Msg::NoticeExported, &[("file", &name)]);
                self.notify(Notice::info(what));
            }
            Some(Err(failure)) => self.notify_error(&*failure),
            None => self.notify(Notice::error(self.prefs.messages().get(Msg::NoticeExportFailed), "")),
        }
    }
}
