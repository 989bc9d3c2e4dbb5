//! What the artist chose for the program, as opposed to for one drawing: a small TOML file.
//!
//! Reading never fails. A file that cannot be read as settings is put aside as `settings.toml.broken` and reported by
//! a [`Notice`]; unknown keys and values out of range fall back one by one, so a file of a newer version keeps what this
//! one understands. Writing is atomic.
//!
//! Limits: two windows that change settings at once: the last one wins.

use super::dialog::PathPurpose;
use super::export_choice::ExportChoice;
use super::messages::{Language, Messages, Msg};
use super::notice::Notice;
use super::pen_settings::PenSettings;
use super::stabiliser::Stabiliser;
use super::view_state::ViewState;
use super::window_size::WindowSize;
use crate::atomic::{WriteError, write_atomically};
use crate::pen::PenSource;
use crate::pen::hid::Models;
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use toml::{Table, Value};

/// Name of the file in the configuration folder.
pub const FILE_NAME: &str = "settings.toml";
/// Most recent files that are remembered.
pub const MAX_RECENT: usize = 12;
/// Most pens that are remembered.
const MAX_PENS: usize = 64;
/// Largest settings file that is read, bytes.
const MAX_BYTES: u64 = 1 << 20;
/// Width of the side panel in logical pixels: least, at first, most.
pub const SIDE_WIDTH: (f32, f32, f32) = (300.0, 320.0, 520.0);
/// Share of the room between the panels that the canvas has: least, at first, most.
pub const CANVAS_SHARE: (f32, f32, f32) = (0.2, 0.5, 0.8);

/// Which hand holds the pen; tools stand on the other side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Handedness {
    /// Tools on the left, panels on the right.
    #[default]
    Right,
    /// The mirror image.
    Left,
}

/// Colours of the interface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ThemeChoice {
    /// As the system has them.
    #[default]
    System,
    /// Light paper colours.
    Light,
    /// Dark greens.
    Dark,
}

impl ThemeChoice {
    /// The theme to show; light where the system has no opinion.
    pub fn resolve(self, system: Option<egui::Theme>) -> egui::Theme {
        match self {
            Self::System => system.unwrap_or(egui::Theme::Light),
            Self::Light => egui::Theme::Light,
            Self::Dark => egui::Theme::Dark,
        }
    }
}

/// What the artist chose for the program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Settings {
    /// Language; `None` follows the system.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub language: Option<Language>,
    /// Colours.
    pub theme: ThemeChoice,
    /// The hand that holds the pen.
    pub handedness: Handedness,
    /// Smoothing of strokes.
    pub stabiliser: Stabiliser,
    /// Whether the side panel is shown.
    pub side_shown: bool,
    /// Width of the side panel, logical pixels.
    pub side_width: f32,
    /// Share of the room between the panels that the canvas has; the plant has the rest.
    pub canvas_share: f32,
    /// How large the window was.
    pub window: WindowSize,
    /// Drawings opened or saved last, the newest first.
    pub recent: Vec<PathBuf>,
    /// Folders in which files were chosen last, by [`PathPurpose::shelf`].
    pub folders: BTreeMap<String, PathBuf>,
    /// What was chosen for the last export.
    pub export: ExportChoice,
    /// How pens are read.
    pub pen_source: PenSource,
    /// How the plant was lit and shown last.
    pub view: ViewState,
    /// What was chosen for each pen, by its name; pens without a name share the empty one.
    pub pens: BTreeMap<String, PenSettings>,
    /// The models that were chosen for tablets in doubt, by what the tablets are known by.
    pub tablet_models: Models,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            language: None,
            theme: ThemeChoice::default(),
            handedness: Handedness::default(),
            stabiliser: Stabiliser::Light,
            side_shown: true,
            side_width: SIDE_WIDTH.1,
            canvas_share: CANVAS_SHARE.1,
            window: WindowSize::default(),
            recent: Vec::new(),
            folders: BTreeMap::new(),
            export: ExportChoice::default(),
            pen_source: PenSource::default(),
            view: ViewState::default(),
            pens: BTreeMap::new(),
            tablet_models: Models::new(),
        }
    }
}

impl Settings {
    /// The settings kept in a folder, and what went wrong: then they are the defaults and the old file is kept aside.
    pub fn load(folder: &Path, messages: &Messages) -> (Self, Option<Notice>) {
        let path = folder.join(FILE_NAME);
        match read(&path) {
            Ok(None) => (Self::default(), None),
            Ok(Some(table)) => (Self::from_table(&table), None),
            Err(reason) => {
                let aside = put_aside(&path);
                let what = messages.fill(Msg::NoticeSettingsBroken, &[("file", &aside.display())]);
                (Self::default(), Some(Notice::warning(format!("{what} ({reason})"), "")))
            }
        }
    }

    /// Keeps the settings in a folder, which is created if it is missing.
    ///
    /// # Errors
    /// A folder that cannot be written; settings on disk stay as they were.
    pub fn save(&self, folder: &Path) -> Result<(), WriteError> {
        let path = folder.join(FILE_NAME);
        let failed = |source| WriteError::Io { path: path.clone(), source };
        fs::create_dir_all(folder).map_err(failed)?;
        let text = toml::to_string_pretty(self).map_err(|e| failed(std::io::Error::other(e)))?;
        write_atomically(&path, text.as_bytes())
    }

    /// Puts a drawing first among the recent ones.
    pub fn remember(&mut self, path: &Path) {
        self.recent.retain(|known| known != path);
        self.recent.insert(0, path.to_owned());
        self.recent.truncate(MAX_RECENT);
    }

    /// Keeps the folder in which a file was chosen.
    pub fn remember_folder(&mut self, purpose: PathPurpose, file: &Path) {
        // A name that is no text cannot stand in the settings.
        let folder = file.parent().filter(|folder| folder.to_str().is_some_and(|name| !name.is_empty()));
        if let Some(folder) = folder {
            self.folders.insert(purpose.shelf().to_owned(), folder.to_owned());
        }
    }

    /// The folder in which such a file was chosen last.
    pub fn folder(&self, purpose: PathPurpose) -> Option<&Path> {
        self.folders.get(purpose.shelf()).map(PathBuf::as_path)
    }

    /// What was chosen for a pen.
    pub fn pen(&self, name: &str) -> PenSettings {
        self.pens.get(name).copied().unwrap_or_default()
    }

    /// Keeps what was chosen for a pen.
    pub fn set_pen(&mut self, name: &str, pen: PenSettings) {
        if pen == PenSettings::default() {
            self.pens.remove(name);
        } else if self.pens.len() < MAX_PENS || self.pens.contains_key(name) {
            self.pens.insert(name.to_owned(), pen);
        }
    }

    /// Keeps which model a tablet is.
    pub fn set_tablet_model(&mut self, device: &str, model: &str) {
        if self.tablet_models.len() < MAX_PENS || self.tablet_models.contains_key(device) {
            self.tablet_models.insert(device.to_owned(), model.to_owned());
        }
    }

    /// The language to start with.
    pub fn language(&self) -> Language {
        self.language.unwrap_or_else(Language::of_system)
    }

    fn from_table(table: &Table) -> Self {
        let default = Self::default();
        let number = |key| field(table, key).filter(|x: &f32| x.is_finite());
        let (width, share) = (number("side_width"), number("canvas_share"));
        let mut recent: Vec<PathBuf> = field(table, "recent").unwrap_or_default();
        recent.truncate(MAX_RECENT);
        Self {
            language: field(table, "language"),
            theme: field(table, "theme").unwrap_or(default.theme),
            handedness: field(table, "handedness").unwrap_or(default.handedness),
            stabiliser: field(table, "stabiliser").unwrap_or(default.stabiliser),
            side_shown: field(table, "side_shown").unwrap_or(default.side_shown),
            side_width: width.map_or(default.side_width, |w| w.clamp(SIDE_WIDTH.0, SIDE_WIDTH.2)),
            canvas_share: share.map_or(default.canvas_share, |s| s.clamp(CANVAS_SHARE.0, CANVAS_SHARE.2)),
            window: field(table, "window").map_or(default.window, WindowSize::sane),
            recent,
            folders: table.get("folders").and_then(Value::as_table).map(by_name).unwrap_or_default(),
            export: field(table, "export").map_or(default.export, ExportChoice::sane),
            pen_source: field(table, "pen_source").unwrap_or(default.pen_source),
            view: field(table, "view").map_or(default.view, ViewState::sane),
            pens: table.get("pens").and_then(Value::as_table).map(by_name).unwrap_or_default(),
            tablet_models: table
                .get("tablet_models")
                .and_then(Value::as_table)
                .map(by_name)
                .unwrap_or_default(),
        }
    }
}

/// What was kept for pens or tablets, as far as this version understands it.
fn by_name<T: DeserializeOwned>(table: &Table) -> BTreeMap<String, T> {
    let known = table.keys().take(MAX_PENS).filter_map(|name| Some((name.clone(), field(table, name)?)));
    known.collect()
}

fn field<T: DeserializeOwned>(table: &Table, key: &str) -> Option<T> {
    table.get(key).cloned().and_then(|value: Value| value.try_into().ok())
}

/// The file as a table, `None` where there is no file yet.
fn read(path: &Path) -> Result<Option<Table>, String> {
    match fs::metadata(path) {
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        Err(e) => return Err(e.to_string()),
        Ok(data) if data.len() > MAX_BYTES => return Err(format!("larger than {MAX_BYTES} bytes")),
        Ok(_) => {}
    }
    let text = fs::read_to_string(path).map_err(|e| e.to_string())?;
    text.parse().map(Some).map_err(|e: toml::de::Error| e.message().to_owned())
}

/// Moves a broken file out of the way, never over another one, and says where it is now.
fn put_aside(path: &Path) -> PathBuf {
    let names = std::iter::once(String::from("broken")).chain((2..100).map(|n| format!("broken-{n}")));
    let free = names.map(|end| path.with_extension(format!("toml.{end}"))).find(|aside| !aside.exists());
    match free {
        Some(aside) if fs::rename(path, &aside).is_ok() => aside,
        _ => path.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::view_state::{LightChoice, Shading};
    use crate::pen::mapping::Turn;

    fn load(folder: &Path) -> (Settings, Option<Notice>) {
        Settings::load(folder, &Messages::new(Language::English))
    }

    #[test]
    fn what_was_saved_is_loaded() {
        let folder = tempfile::tempdir().unwrap();
        let below = folder.path().join("new/folder");
        let mut settings = Settings {
            language: Some(Language::Chinese),
            theme: ThemeChoice::Dark,
            handedness: Handedness::Left,
            stabiliser: Stabiliser::Strong,
            side_shown: false,
            side_width: 400.0,
            canvas_share: 0.7,
            window: WindowSize { width: 1000.0, height: 700.5, maximised: true },
            ..Settings::default()
        };
        settings.view.light.azimuth_deg = 20.0;
        settings.view.shading = Shading::Parts;
        settings.view.orthographic = false;
        settings.export.transparent = true;
        settings.pen_source = PenSource::Raw;
        let mut pen = PenSettings { turn: Turn::Half, ..PenSettings::default() };
        pen.pressure = crate::pen::PressureCurve::soft();
        settings.set_pen("Pen of \"somebody\"", pen);
        settings.set_tablet_model("256c:006d HUION Tablet 7", "Huion H640P");
        settings.remember(Path::new("/drawings/daisy.penstemon"));
        settings.save(&below).unwrap();
        assert_eq!(load(&below), (settings, None));
    }

    #[test]
    fn no_file_gives_the_defaults_without_a_word() {
        assert_eq!(load(tempfile::tempdir().unwrap().path()), (Settings::default(), None));
    }

    #[test]
    fn a_broken_file_is_kept_aside_and_reported() {
        let folder = tempfile::tempdir().unwrap();
        for (round, aside) in ["settings.toml.broken", "settings.toml.broken-2"].into_iter().enumerate() {
            let text = format!("theme = [[[ {round}");
            fs::write(folder.path().join(FILE_NAME), &text).unwrap();
            let (settings, notice) = load(folder.path());
            assert_eq!(settings, Settings::default());
            assert!(notice.unwrap().what.contains(aside));
            assert_eq!(fs::read_to_string(folder.path().join(aside)).unwrap(), text);
            assert!(!folder.path().join(FILE_NAME).exists());
        }
    }

    #[test]
    fn bytes_that_are_no_text_are_no_settings() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(FILE_NAME), [0xff, 0xfe, 0, 1]).unwrap();
        assert!(load(folder.path()).1.is_some());
    }

    #[test]
    fn what_one_version_does_not_understand_costs_only_itself() {
        let folder = tempfile::tempdir().unwrap();
        let text = "theme = \"dark\"\nlanguage = \"klingon\"\nside_width = 1e9\nhologram = true\n\
                    stabiliser = 7\n[window]\nwidth = -inf\nmaximised = true\n[export]\nwidth = 0\n[view]\nshading = \"parts\"\n[view.light]\n\
                    strength = inf\nazimuth_deg = 30\n";
        fs::write(folder.path().join(FILE_NAME), text).unwrap();
        let (settings, notice) = load(folder.path());
        assert_eq!(notice, None);
        assert_eq!(settings.theme, ThemeChoice::Dark);
        assert_eq!(settings.language, None);
        assert_eq!(settings.stabiliser, Stabiliser::Light);
        assert!((settings.side_width - SIDE_WIDTH.2).abs() < 1e-6);
        assert_eq!(settings.window, WindowSize { maximised: true, ..WindowSize::default() });
        assert!(settings.export.width >= 16);
        let ViewState { light, shading, orthographic, outdoors: _, turntable, walking: _, overlay } =
            settings.view;
        assert_eq!((shading, orthographic, turntable), (Shading::Parts, true, false));
        assert!(!overlay.any());
        assert_eq!((light.strength, light.azimuth_deg), (LightChoice::default().strength, 30.0));
    }

    #[test]
    fn recent_files_are_few_and_each_once() {
        let mut settings = Settings::default();
        for n in 0..40 {
            settings.remember(Path::new(&format!("{}.penstemon", n % 15)));
        }
        assert_eq!(settings.recent.len(), MAX_RECENT);
        assert_eq!(settings.recent[0], Path::new("9.penstemon"));
        let mut sorted = settings.recent.clone();
        sorted.sort();
        sorted.dedup();
        assert_eq!(sorted.len(), MAX_RECENT);
    }

    #[test]
    fn a_place_that_cannot_be_written_is_an_error_and_no_panic() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "").unwrap();
        assert!(Settings::default().save(&file.join("below")).is_err());
    }
}
