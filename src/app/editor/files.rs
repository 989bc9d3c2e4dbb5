//! Drawings on disk: new, open, save, recover, import; and the questions that come before.

use super::Editor;
use super::beside_state::Beside;
use super::open_drawing::OwnFile;
use super::saver::Target;
use crate::app::action::Action;
use crate::app::canvas::Canvas;
use crate::app::file_dialog;
use crate::app::messages::{Localize as _, Msg};
use crate::app::panels::snapshot::{Dialog, Notice, PathPurpose, PathRequest};
use crate::pipeline;
use crate::sketch::document::Document;
use crate::sketch::journal::JournalWriter;
use crate::sketch::save::{self, Opened};
use crate::sketch::{self, Change};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The drawing that a first start shows.
const SAMPLE: &str = include_str!("../../../assets/sketches/sample.penstemon");
/// Extensions of drawings, of pictures, and of species files.
const DRAWINGS: [&str; 2] = ["penstemon", "svg"];
const PICTURES: [&str; 3] = ["png", "jpg", "jpeg"];
const SPECIES: [&str; 1] = ["toml"];

impl Editor {
    /// The window's close button, or the key for it.
    pub fn ask_to_quit(&mut self) {
        self.perform_if_saved(Action::Quit);
    }

    /// Carries out what replaces the drawing: after what is being saved, and after asking about unsaved changes.
    pub(super) fn perform_if_saved(&mut self, action: Action) {
        if self.disk.saver.is_busy() {
            self.disk.saver.set_then(Some(action));
        } else if self.drawing.may_go() {
            self.replace(action);
        } else {
            self.dialogs.hold_up(action);
        }
    }

    /// Saves, and goes on where that works.
    pub(super) fn save_and_continue(&mut self) {
        self.dialogs.set_dialog(None);
        if self.drawing.path().is_none() {
            // Goes on once a name is chosen.
            self.choose(PathPurpose::SaveDrawing);
        } else {
            self.save(Target::Own);
            self.disk.saver.set_then(self.dialogs.take_held_up());
        }
    }

    /// Goes on without saving.
    pub(super) fn discard_and_continue(&mut self) {
        self.drawing.give_up();
        self.dialogs.set_dialog(None);
        if let Some(action) = self.dialogs.take_held_up() {
            self.replace(action);
        }
    }

    fn replace(&mut self, action: Action) {
        match action {
            Action::New => self.start_empty(),
            Action::Open => self.choose(PathPurpose::OpenDrawing),
            Action::OpenPath(path) => self.open_file(&path),
            Action::Recover(path) => self.recover(&path),
            Action::Quit => self.updates.close(),
            _ => {}
        }
    }

    /// An empty sheet.
    pub(super) fn start_empty(&mut self) {
        self.take_over(Document::empty(), OwnFile::default());
    }

    /// The drawing of a first start: the artist's own from the first stroke on.
    pub(super) fn open_sample(&mut self) {
        match sketch::from_bytes(SAMPLE.as_bytes(), "the sample") {
            Ok((sample, _)) => self.take_over(Document::new(sample), OwnFile::default()),
            Err(error) => {
                self.notify_error(&error);
                self.start_empty();
            }
        }
    }

    /// Opens a drawing; where that fails the one that is open stays.
    pub(super) fn open_file(&mut self, path: &Path) {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        match save::open(&path) {
            Ok(Opened { mut sketch, warnings, stamp }) => {
                for warning in &warnings {
                    self.notify(Notice::warning(warning.localize(self.prefs.messages()), ""));
                }
                let folder = path.parent().unwrap_or(Path::new(""));
                self.take_in(&mut sketch.textures, folder);
                // By its whole path, so that it is found wherever the drawing is saved next.
                if let Some(species) = pipeline::species_file(&sketch, folder).filter(|file| file.exists()) {
                    sketch.species = Some(species.to_string_lossy().into_owned());
                }
                // An imported SVG has no file of its own yet.
                let own = stamp.is_some();
                let document = if own { Document::new(sketch) } else { Document::unsaved(sketch) };
                self.take_over(document, OwnFile { path: own.then(|| path.clone()), stamp });
                self.notify_missing_species();
                self.prefs.remember_drawing(&path);
                self.save_settings();
            }
            Err(error) => {
                self.notify_error(&error);
                if self.drawing.journal_state().is_none() {
                    self.start_empty();
                }
            }
        }
    }

    /// Begins to work on another drawing.
    fn take_over(&mut self, document: Document, file: OwnFile) {
        let begun = self.disk.lost.begin(document.sketch(), file.meta(), document.is_saved());
        let journal = begun.map_err(|error| self.notify_error(&error)).ok();
        self.take_over_with(document, file, journal);
    }

    fn take_over_with(&mut self, document: Document, file: OwnFile, journal: Option<JournalWriter>) {
        self.drawing.replace(document, file, journal);
        self.live.forget_species();
        self.dialogs.close_part_menu();
        self.pens.hold = None;
        self.beside = Beside::default();
        self.petals.let_go();
        self.space.let_go();
        self.garden.forget();
        self.brush.let_go();
        self.posing.let_go();
        // Tool, selection and view belong to the drawing; what the artist chose for pens stays.
        self.canvas = Canvas::new(self.canvas.settings);
        self.layout.forget();
        self.plant.show_front();
        self.drawing_changed();
    }

    /// Asks for a file: the system's dialog, or ours where it has none.
    pub(super) fn choose(&mut self, purpose: PathPurpose) {
        let request = self.path_request(purpose);
        let wake = Arc::clone(self.background.wake());
        if let Err(request) = file_dialog::ask(request, self.background.sender(), wake) {
            self.dialogs.set_dialog(Some(Dialog::Path(request)));
        }
    }

    /// What is asked for, beginning where such a file was chosen last.
    pub(super) fn path_request(&self, purpose: PathPurpose) -> PathRequest {
        let name = self.drawing.name();
        let own = self.drawing.path().and_then(Path::parent);
        let settings = self.prefs.settings();
        let last = settings.folder(purpose);
        // Drawings stay together; pictures, species and exports may have places of their own.
        let folder = match purpose {
            PathPurpose::OpenDrawing | PathPurpose::SaveDrawing | PathPurpose::GardenDrawing => own.or(last),
            _ => last.or(own),
        };
        let folder = folder.map(Path::to_owned);
        let export = settings.export.format.extension();
        let extensions: Vec<&'static str> = match purpose {
            PathPurpose::OpenDrawing | PathPurpose::GardenDrawing => DRAWINGS.to_vec(),
            PathPurpose::SaveDrawing => vec!["penstemon"],
            PathPurpose::Export => vec![export],
            PathPurpose::Texture(_) | PathPurpose::Photograph(_) | PathPurpose::Reference => {
                PICTURES.to_vec()
            }
            PathPurpose::Species => SPECIES.to_vec(),
        };
        let name = match purpose {
            PathPurpose::SaveDrawing => format!("{}.penstemon", name.as_deref().unwrap_or("plant")),
            PathPurpose::Export => format!("{}.{export}", name.as_deref().unwrap_or("plant")),
            _ => String::new(),
        };
        file_dialog::request(purpose, folder, name, extensions)
    }

    /// Uses a file that was asked for.
    pub(super) fn chosen(&mut self, purpose: PathPurpose, path: PathBuf) {
        self.dialogs.set_dialog(None);
        self.prefs.remember_folder(purpose, &path);
        let wanted = match purpose {
            PathPurpose::SaveDrawing => Some("penstemon"),
            PathPurpose::Export => Some(self.prefs.settings().export.format.extension()),
            _ => None,
        };
        let full = wanted.map_or_else(|| path.clone(), |extension| with_extension(path.clone(), extension));
        if full != path && full.exists() {
            // The dialog asked about another name.
            self.dialogs.set_dialog(Some(Dialog::Replace { purpose, path: full }));
            return;
        }
        let path = full;
        match purpose {
            // The system's dialog does not keep anybody from drawing on.
            PathPurpose::OpenDrawing => self.perform_if_saved(Action::OpenPath(path)),
            PathPurpose::SaveDrawing => {
                // The dialog asked whether to replace what is there.
                self.save(Target::Chosen(path));
                let then = self.dialogs.take_held_up().or_else(|| self.disk.saver.take_then());
                self.disk.saver.set_then(then);
            }
            PathPurpose::Export => self.begin_export(path),
            PathPurpose::Species => self.change(Change::species(Some(path.to_string_lossy().into_owned()))),
            PathPurpose::GardenDrawing => self.plant_drawing(&path),
            PathPurpose::Photograph(organ) => self.read_photograph(organ, path),
            PathPurpose::Texture(_) | PathPurpose::Reference => self.read_picture(purpose, path),
        }
    }

    /// Files dropped on the window: a drawing is opened, a picture lies under the drawing, a species is used.
    pub fn drop_files(&mut self, files: Vec<PathBuf>) {
        let Some(file) = files.into_iter().next() else { return };
        let extension = file.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
        let is_one_of = |known: &[&str]| known.contains(&extension.as_str());
        if is_one_of(&PICTURES) {
            self.read_picture(PathPurpose::Reference, file);
        } else if is_one_of(&SPECIES) {
            self.chosen(PathPurpose::Species, file);
        } else {
            self.perform(Action::OpenPath(file));
        }
    }

    /// Offers what windows left that are gone.
    pub(super) fn look_for_lost_drawings(&mut self) {
        if let Err(error) = self.disk.lost.look() {
            self.notify(Notice::warning(error.localize(self.prefs.messages()), ""));
        }
        if let Some(dialog) = self.disk.lost.dialog(self.prefs.messages()) {
            self.dialogs.set_dialog(Some(dialog));
        }
    }

    /// Shows the list of them, if there are any; no dialog otherwise.
    pub(super) fn show_lost_drawings(&mut self) {
        let dialog = self.disk.lost.dialog(self.prefs.messages());
        self.dialogs.set_dialog(dialog);
    }

    fn recover(&mut self, path: &Path) {
        let Some(resumed) = self.disk.lost.resume(path) else { return };
        match resumed {
            Ok((mut restored, meta, journal)) => {
                let folder = meta.path.as_deref().and_then(Path::parent).unwrap_or(Path::new(""));
                self.take_in(&mut restored.sketch.textures, folder);
                let damaged = self.disk.lost.damaged_files();
                let kept =
                    self.prefs.messages().fill(Msg::NoticeDamagedKept, &[("folder", &damaged.display())]);
                for gap in restored.gaps {
                    self.notify(Notice::warning(gap.localize(self.prefs.messages()), &kept));
                }
                let file = OwnFile { path: meta.path, stamp: meta.stamp };
                self.take_over_with(Document::unsaved(restored.sketch), file, Some(journal));
                self.notify_missing_species();
                self.show_lost_drawings();
            }
            Err(error) => self.notify_error(&error),
        }
    }

    pub(super) fn discard_recovery(&mut self, path: &Path) {
        let discarded = self.disk.lost.discard(path);
        self.notify_failure(discarded);
        self.show_lost_drawings();
    }
}

/// The path with an extension, where it has none of its own.
fn with_extension(path: PathBuf, extension: &str) -> PathBuf {
    let has = path.extension().is_some_and(|e| e.eq_ignore_ascii_case(extension));
    if has {
        return path;
    }
    let mut name = path.into_os_string();
    name.push(".");
    name.push(extension);
    name.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_get_their_extension() {
        assert_eq!(with_extension("a/rose".into(), "glb"), PathBuf::from("a/rose.glb"));
        assert_eq!(with_extension("a/rose.v2".into(), "glb"), PathBuf::from("a/rose.v2.glb"));
        assert_eq!(with_extension("a/rose.GLB".into(), "glb"), PathBuf::from("a/rose.GLB"));
    }
}
