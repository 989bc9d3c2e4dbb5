//! How the editor begins: with its folders, its settings, and a drawing, a sample or an empty sheet.

use super::Editor;
use super::background::{Background, Wake};
use super::beside_state::Beside;
use super::brush_tool::BrushTool;
use super::dialogs::Dialogs;
use super::disk::Disk;
use super::export::Exports;
use super::garden_tool::GardenPainting;
use super::live_plant::LivePlant;
use super::lost_drawings::LostDrawings;
use super::open_drawing::OpenDrawing;
use super::pens::Pens;
use super::petal_tool::PetalTool;
use super::plant_search::PlantSearch;
use super::pose_tool::PoseTool;
use super::preferences::Preferences;
use super::preset_folder::PresetFolder;
use super::saver::Saver;
use super::shown_levels::ShownLevels;
use super::space_tool::SpaceTool;
use super::updates::Updates;
use crate::app::canvas::Canvas;
use crate::app::fonts;
use crate::app::layout::Layout;
use crate::app::panels::snapshot::Notice;
use crate::app::plant_view::PlantView;
use anyhow::Context as _;
use std::path::PathBuf;
use std::sync::Arc;

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
        let (prefs, broken) = Preferences::load(places.config.clone());
        let is_first_start = prefs.are_new();
        let wake: Wake = Arc::new(wake);
        let theirs = Arc::clone(&wake);
        let live = LivePlant::start(move || theirs()).context("no thread for the live plant")?;
        let disk = Disk {
            lost: LostDrawings::at(&places.state),
            saver: Saver::default(),
            presets: PresetFolder::at(places.config.join("presets")),
            exports: Exports::default(),
        };
        let mut editor = Self {
            drawing: OpenDrawing::empty(),
            disk,
            background: Background::new(wake),
            canvas: Canvas::default(),
            outcomes: Vec::new(),
            plant: PlantView::new(prefs.settings().view),
            live,
            levels: ShownLevels::default(),
            beside: Beside::default(),
            petals: PetalTool::default(),
            search: PlantSearch::default(),
            space: SpaceTool::default(),
            brush: BrushTool::default(),
            garden: GardenPainting::default(),
            posing: PoseTool::default(),
            pens: Pens::default(),
            dialogs: Dialogs::default(),
            layout: Layout::default(),
            updates: Updates::default(),
            prefs,
        };
        editor.begin(file, is_first_start, broken);
        Ok(editor)
    }

    /// Begins the session: with this drawing, with the sample, or with nothing.
    fn begin(&mut self, file: Option<PathBuf>, is_first_start: bool, broken: Option<Notice>) {
        self.apply_settings();
        broken.into_iter().for_each(|notice| self.notify(notice));
        if self.prefs.lack_language() {
            self.notify(fonts::missing_notice());
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
