//! How the editor begins: with its folders, its settings, and a drawing, a sample or an empty sheet.

use super::clipboard::Clipboard;
use super::notices::Notices;
use super::saving::Saver;
use super::{Building, Editor, Outlines, OwnFile, TabletNews, Versions, task};
use crate::app::canvas::Canvas;
use crate::app::fonts::{self, ChineseLookup};
use crate::app::layout::Layout;
use crate::app::messages::{Language, Messages};
use crate::app::panels::snapshot::{Notice, PenLive, PenUsed};
use crate::app::plant_view::PlantView;
use crate::app::settings::{self, Settings};
use crate::app::worker::{Counts, Worker};
use crate::sketch::document::Document;
use crate::sketch::journal::Recovery;
use anyhow::Context as _;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::channel;

/// Folders of the program.
#[derive(Clone, Debug)]
pub struct Places {
    /// Settings and presets.
    pub config: PathBuf,
    /// Journals of open drawings.
    pub state: PathBuf,
}

impl Places {
    /// Where the system wants them.
    ///
    /// # Errors
    /// A user without a home.
    pub fn of_system() -> anyhow::Result<Self> {
        use etcetera::BaseStrategy;
        let base = etcetera::choose_base_strategy()
            .context("the home folder is not known; set HOME and start again")?;
        let state = base.state_dir().unwrap_or_else(|| base.data_dir());
        Ok(Self { config: base.config_dir().join("penstemon"), state: state.join("penstemon") })
    }

    pub(super) fn presets(&self) -> PathBuf {
        self.config.join("presets")
    }
}

impl Editor {
    /// Opens the editor on a drawing, on what was left from before, or on the sample. `wake` is called from other threads when there is
    /// something to [`Editor::collect`].
    ///
    /// # Errors
    /// A user without a home, or a system without threads. A drawing that cannot be opened becomes a notice.
    pub fn open(file: Option<PathBuf>, wake: impl Fn() + Send + Sync + 'static) -> anyhow::Result<Self> {
        Self::open_in(Places::of_system()?, file, wake)
    }

    /// The same with folders of the caller's choice.
    ///
    /// # Errors
    /// As [`Editor::open`].
    pub fn open_in(
        places: Places,
        file: Option<PathBuf>,
        wake: impl Fn() + Send + Sync + 'static,
    ) -> anyhow::Result<Self> {
        let mut chinese = ChineseLookup::default();
        let messages = Messages::new(chinese.drawable(Language::of_system()));
        let (settings, broken) = Settings::load(&places.config, &messages);
        let is_first_start = !places.config.join(settings::FILE_NAME).exists();
        let wake: task::Wake = Arc::new(wake);
        let theirs = Arc::clone(&wake);
        let worker = Worker::start(move || theirs()).context("no thread for the live plant")?;
        let recovery = Recovery::at(&places.state);
        let (answers, answered) = channel();
        let mut editor = Self {
            document: Document::empty(),
            canvas: Canvas::default(),
            plant: PlantView::new(settings.view),
            messages: Messages::new(chinese.drawable(settings.language())),
            layout: Layout::default(),
            kept_settings: None,
            system_theme: None,
            theme_asked: None,
            built: None,
            counts: Counts::default(),
            versions: Versions::default(),
            file: OwnFile::default(),
            species: None,
            outlines: Outlines::default(),
            outcomes: Vec::new(),
            worker,
            building: Building::default(),
            journal: None,
            found: Vec::new(),
            found_pictures: Vec::new(),
            dialog: None,
            held_up: None,
            given_up: None,
            saver: Saver::default(),
            part_menu: None,
            hold: None,
            notices: Notices::default(),
            listed_presets: Vec::new(),
            answers,
            answered,
            chinese,
            fonts_are_set: false,
            task: None,
            pen_used: PenUsed::default(),
            pen_device: None,
            pen_is_raw: false,
            pen_battery: None,
            tablets: TabletNews::default(),
            pen_live: PenLive::default(),
            clipboard: Clipboard::default(),
            nudged_at: None,
            title: None,
            shown_title: String::new(),
            wake,
            closed: false,
            places,
            recovery,
            settings,
        };
        editor.begin(file, is_first_start, broken);
        Ok(editor)
    }

    /// Begins the session: with this drawing, with the sample, or with nothing.
    fn begin(&mut self, file: Option<PathBuf>, is_first_start: bool, broken: Option<Notice>) {
        self.apply_settings();
        self.list_presets();
        broken.into_iter().for_each(|notice| self.tell(notice));
        if self.settings.language() != self.messages.language() {
            self.tell(fonts::missing_notice());
        }
        match file {
            Some(file) => self.open_file(&file),
            None if is_first_start => self.open_sample(),
            None => self.start_empty(),
        }
        self.look_for_lost_drawings();
        self.save_settings();
        self.ask_system_theme();
    }
}
