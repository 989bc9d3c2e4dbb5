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
            folder: self.drawing.folder().to_owned(),
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

#[cfg(test)]
mod tests {
    use crate::app::action::Action;
    use crate::app::editor::test_window::{PATIENCE, with_sketch};
    use crate::app::panels::snapshot::ExportChoice;
    use crate::pipeline::LevelSet;
    use std::time::{Duration, Instant};

    #[test]
    fn a_glb_holds_the_levels_and_capsules_that_were_chosen() {
        let home = tempfile::tempdir().unwrap();
        let (mut editor, _) = with_sketch(&home, "freehand_tree");
        let choice =
            ExportChoice { levels: Some(LevelSet::Mobile), capsules: true, ..ExportChoice::default() };
        editor.perform(Action::SetExport(choice));
        let path = home.path().join("tree.glb");
        editor.begin_export(path.clone());
        let begun = Instant::now();
        while editor.disk.exports.is_busy() {
            assert!(begun.elapsed() < PATIENCE, "it is written for ever");
            std::thread::sleep(Duration::from_millis(5));
            editor.collect_export();
        }
        let bytes = std::fs::read(path).unwrap();
        let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
        let json: serde_json::Value = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
        let names: Vec<&str> =
            json["nodes"].as_array().unwrap().iter().filter_map(|node| node["name"].as_str()).collect();
        for name in ["tree_LOD0", "tree_LOD3", "UCP_wood_LOD0_01"] {
            assert!(names.contains(&name), "{name} of {names:?}");
        }
        assert!(json["extensionsUsed"].as_array().unwrap().iter().any(|used| used == "MSFT_lod"));
    }
}
