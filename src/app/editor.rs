//! The editor: the open drawing with everything around it, without window and without graphics card.
//!
//! It is made of parts that own what they are about, a file each; other files hold what several parts do together. The
//! window hands it events and draws what it says; every action of the artist, from whichever button or key, ends in
//! [`Editor::perform`], which gives it to its owner. Whatever goes wrong becomes a notice, and the drawing stays.
//!
//! | part | what it owns |
//! | --- | --- |
//! | `open_drawing` | the document, its own file, its journal |
//! | `disk` | other work on the disk: `saver`, `lost_drawings`, `preset_folder`, `export` |
//! | `background` | the way back from other threads |
//! | `preferences` | settings, language, fonts, colours |
//! | `live_plant` | the worker, the newest plant, growth replayed |
//! | `shown_levels` | the plant's levels of detail, and which of them is on the screen |
//! | `beside_state` | which plant beside the drawn one is selected and held |
//! | `petal_tool` | the tool that shapes petals: which petal, which of its points |
//! | `space_tool` | the tool that draws branches in space: its surface, the branch under the pen |
//! | `brush_tool` | the brushes: which is in hand, how they are set, the stroke under the pen |
//! | `pose_tool` | the tool that turns and bends branches: the branch that is held |
//! | `plant_search` | the plant on the picture under the drawing: marks, the search, what was found |
//! | `pens` | the pens and tablets in use |
//! | `dialogs` | the dialog, the menu of parts, messages |
//! | `updates` | changes that the window and the graphics card have to be notified of |

mod accessors;
mod asked_ways;
mod background;
mod beside;
mod beside_carry;
mod beside_marks;
mod beside_state;
mod brush_tool;
mod choosing;
mod clipboard;
mod dialogs;
mod dice;
mod disk;
mod drawing_surface;
mod estimate;
mod export;
mod exporting;
mod files;
mod find_plant;
mod garden;
mod garden_drawings;
mod garden_marks;
mod garden_tool;
mod grafting;
mod interface;
mod keys;
mod level_preview;
mod live_plant;
mod lost_drawings;
mod missing_species;
mod notices;
mod open_drawing;
mod opening;
mod outcomes;
mod painting;
mod parameters;
mod pens;
mod perform;
mod petal_handles;
mod petal_tool;
mod petals;
mod photographs;
mod picking;
mod pictures;
mod plant_search;
mod posable;
mod pose_marks;
mod pose_ring;
mod pose_tool;
mod posing;
mod preferences;
mod preset_folder;
mod readings;
mod reference;
mod reference_hold;
mod replacing;
mod replay;
mod saver;
mod saving;
mod shown_levels;
mod snap_trunk;
mod snapshot;
mod space;
mod space_marks;
mod space_tool;
mod stroke_frame;
#[cfg(test)]
mod test_window;
mod updates;
mod walk;
mod wood_contact;

use super::canvas::{Canvas, CanvasOutcome};
use super::layout::Layout;
use super::messages::{Localize, Msg};
use super::panels::snapshot::Notice;
use super::plant_view::PlantView;
use crate::render::RenderError;
use crate::sketch::document::ChangeError;
use crate::sketch::journal::JournalState;
use crate::sketch::{Change, Stroke};
use background::Background;
use beside_state::Beside;
use brush_tool::{BrushStroke, BrushTool};
use dialogs::Dialogs;
use disk::Disk;
use garden_tool::GardenPainting;
use live_plant::{Collected, LivePlant, UnderPen};
use open_drawing::OpenDrawing;
use pens::Pens;
use petal_tool::PetalTool;
use plant_search::PlantSearch;
use pose_tool::PoseTool;
use preferences::Preferences;
use shown_levels::ShownLevels;
use space_tool::{SpaceStroke, SpaceTool};
use std::time::{Duration, Instant};
use updates::Updates;
use winit::dpi::PhysicalSize;

pub use live_plant::Revisions;
pub use opening::Places;
pub(super) use updates::Copied;
pub use updates::Versions;

/// How often it is looked whether the journal is on disk, while it is on its way and while it cannot be written.
const JOURNAL_LOOK: [Duration; 2] = [Duration::from_millis(250), Duration::from_secs(1)];

/// The editor.
pub struct Editor {
    drawing: OpenDrawing,
    disk: Disk,
    background: Background,
    prefs: Preferences,
    pub(super) canvas: Canvas,
    /// Room for what comes of the canvas.
    outcomes: Vec<CanvasOutcome>,
    pub(super) plant: PlantView,
    live: LivePlant,
    levels: ShownLevels,
    beside: Beside,
    petals: PetalTool,
    space: SpaceTool,
    brush: BrushTool,
    garden: GardenPainting,
    posing: PoseTool,
    search: PlantSearch,
    pens: Pens,
    dialogs: Dialogs,
    layout: Layout,
    updates: Updates,
}

impl Editor {
    /// Takes what other threads have finished.
    pub fn collect(&mut self) {
        match self.live.collect(self.prefs.messages()) {
            Some(Collected::Plant(bounds)) => {
                self.plant.set_bounds(bounds);
                self.show_opened_garden();
                self.live.read_species(self.drawing.sketch(), self.drawing.folder());
                self.updates.plant_changed();
            }
            Some(Collected::Failure(Some(reason))) => self.notify(Notice::error(reason, "")),
            Some(Collected::Failure(None)) | None => {}
        }
        self.collect_export();
        self.collect_save();
        self.collect_plant_search();
        self.collect_levels();
        if self.prefs.collect_system_theme() {
            self.updates.drawing_changed();
        }
        while let Some(action) = self.background.take_action() {
            self.perform(action);
        }
    }

    /// Hands the newest drawing to the worker if it changed. Called once after all events of a moment.
    pub fn submit(&mut self) {
        self.watch_journal();
        self.plant.keeps_room = self.live.has_replay();
        self.live.replay_growth(Instant::now());
        let overlay = self.plant.state.overlay;
        let in_space = self.space.stroke.as_ref().filter(|stroke| !stroke.lifts);
        let painted = || self.brush.stroke.as_ref().and_then(BrushStroke::under_pen);
        let growing = in_space.map(SpaceStroke::under_pen).or_else(painted);
        let growing = growing.or_else(|| self.canvas.growing().map(UnderPen::of));
        let drawn = (&self.canvas, growing);
        let garden = self.garden_now();
        self.live.submit((self.drawing.sketch(), garden), self.drawing.folder(), drawn, overlay);
    }

    /// Applies a change as one step: to the document, the journal, the canvas and the plant.
    fn change(&mut self, change: Change) {
        let applied = self.drawing.apply(change);
        self.changed_or_notify(applied);
    }

    /// The same for a slider on its way: one step from press to release.
    fn change_merging(&mut self, change: Change, key: &str) {
        let applied = self.drawing.apply_merging(change, key);
        self.changed_or_notify(applied);
    }

    fn changed_or_notify(&mut self, is_other: Result<bool, ChangeError>) {
        match is_other {
            Ok(is_other) => self.changed(is_other),
            Err(error) => self.notify_error(&error),
        }
    }

    /// After a step that may have made the drawing another one.
    fn changed(&mut self, is_other: bool) {
        if is_other {
            self.drawing_changed();
        }
    }

    /// After any change of the drawing, also by undo or another file.
    fn drawing_changed(&mut self) {
        let mut outcomes = std::mem::take(&mut self.outcomes);
        self.canvas.drawing_changed(&self.drawing.sketch().strokes, &mut outcomes);
        self.outcomes = outcomes;
        self.beside.keep_known(self.drawing.sketch().plants.len());
        let hash = self.reference_hash();
        self.search.keep_only(hash);
        self.live.drawing_changed(self.drawing.sketch(), self.drawing.folder());
        self.updates.drawing_changed();
        self.updates.reference_changed();
        self.refresh_title();
    }

    fn refresh_title(&mut self) {
        let name = self.drawing.name();
        let name = name.unwrap_or_else(|| self.prefs.messages().get(Msg::AppUntitled).to_owned());
        let mark = if self.drawing.is_saved() { "" } else { "• " };
        self.updates.set_title(format!("{mark}{name} – Penstemon"));
    }

    /// Shows a message.
    pub(super) fn notify(&mut self, notice: Notice) {
        self.dialogs.notify(notice);
    }

    /// Shows a failure.
    fn notify_error(&mut self, error: &dyn Localize) {
        self.notify(Notice::error(error.localize(self.prefs.messages()), ""));
    }

    /// Shows a failure, if it is one.
    fn notify_failure<T, E: Localize>(&mut self, result: Result<T, E>) {
        if let Err(error) = result {
            self.notify_error(&error);
        }
    }

    /// Says that the graphics card could not show something.
    pub(super) fn notify_render_failure(&mut self, error: &RenderError) {
        self.notify_error(error);
    }

    /// Says that the graphics card was lost, and that all is drawn again.
    pub(super) fn notify_graphics_are_back(&mut self) {
        self.notify(Notice::info(self.prefs.messages().get(Msg::NoticeGraphicsBack)));
    }

    /// The window's system said what its colours are.
    pub fn set_system_theme(&mut self, theme: Option<egui::Theme>) {
        if self.prefs.set_system_theme(theme) {
            self.updates.drawing_changed();
        }
    }

    /// Asks the desktop for its colours, where they are followed and the window's system does not say them.
    pub fn ask_system_theme(&mut self) {
        self.prefs.ask_system_theme(self.background.wake());
    }

    /// Remembers how large the window is.
    pub(super) fn note_window(&mut self, size: PhysicalSize<u32>, scale: f64, is_maximised: bool) {
        self.prefs.follow_window(size, scale, is_maximised);
    }

    /// A new egui context knows no fonts.
    pub(super) fn forget_textures(&mut self) {
        self.disk.lost.forget_pictures();
        self.prefs.forget_fonts();
        self.layout.forget_context();
    }

    /// Keeps a snapshot now: the window lost the focus or is about to go.
    pub fn snapshot(&mut self) {
        self.canvas.release_keys();
        self.drawing.snapshot();
    }

    /// Ends everything; called once when the window closes. Waits for what is being saved.
    pub fn shut_down(&mut self) {
        self.finish();
        self.drawing.end_journal();
        self.drawing.wait_for_journals();
    }

    /// Ends everything where the artist was not asked; the drawing is offered at the next start.
    pub(super) fn break_off(&mut self) {
        // The pen may be down: what it drew so far is kept, too.
        let growing = self.canvas.growing().map(|stroke| Stroke {
            id: stroke.id(),
            tool: stroke.tool(),
            points: stroke.points().to_vec(),
            brush: None,
        });
        if let Some(stroke) = growing {
            self.change(Change::put(stroke));
        }
        self.end_in_space();
        self.end_painting();
        self.end_in_garden();
        self.finish();
        self.drawing.leave_journal();
    }

    fn finish(&mut self) {
        self.finish_saving();
        self.save_settings();
        self.disk.exports.cancel();
    }

    /// Whether something on the screen moves by itself.
    pub fn wants_frame(&self) -> bool {
        self.plant.wants_frame()
    }

    /// Whether another thread works on something that will be shown.
    pub fn is_working(&self) -> bool {
        self.live.is_working()
            || self.levels.is_busy()
            || self.disk.exports.is_busy()
            || self.disk.saver.is_busy()
    }

    /// When something on the screen changes by itself.
    pub fn wakes_at(&self) -> Option<Instant> {
        let updates = self.dialogs.notices().next_goes_at();
        let look = self.drawing.journal_state().and_then(|state| match state {
            JournalState::Saved => None,
            JournalState::Saving { .. } => Some(JOURNAL_LOOK[0]),
            JournalState::Failed(_) => Some(JOURNAL_LOOK[1]),
        });
        let saving = look.map(|after| Instant::now() + after);
        [updates, saving, self.plant.wakes_at(), self.live.next_age_at()].into_iter().flatten().min()
    }
}
