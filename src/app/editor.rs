//! The editor: the open drawing with everything around it, without window and without graphics card.
//!
//! It owns the document, the canvas, the worker, the journal, the settings and what the panels show. The window hands it
//! events and draws what it says; every wish of the artist, from whichever button or key, ends in
//! [`Editor::perform`]. Whatever goes wrong becomes a notice, and the drawing stays.

mod clipboard;
mod estimate;
mod files;
mod growth;
mod keys;
mod live;
mod notices;
mod opening;
mod outcomes;
mod perform;
mod picking;
mod pictures;
mod reference;
mod saving;
mod snapshot;
mod task;

use super::action::Action;
use super::canvas::{Canvas, CanvasOutcome};
use super::fonts::ChineseLookup;
use super::layout::Layout;
use super::messages::{Localize as _, Messages, Msg};
use super::panels::snapshot::{Dialog, Notice, PartMenu, PenLive, PenUsed};
use super::pen_settings::TabletDoubt;
use super::plant_view::PlantView;
use super::settings::Settings;
use super::worker::{self, Counts, Update, Worker};
use crate::pipeline::{Built, DEFAULT_SPECIES};
use crate::render::RenderError;
use crate::sketch::document::Document;
use crate::sketch::journal::{JournalState, JournalWriter, Recoverable, Recovery};
use crate::sketch::save::FileStamp;
use crate::sketch::{Change, Sketch, Step, Stroke, Tool};
use crate::species::Species;
use clipboard::Clipboard;
use notices::Notices;
use saving::Saver;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender};
use std::time::{Duration, Instant};
use task::{Task, Work};

pub(super) use clipboard::Copied;
pub use live::Revisions;
pub use opening::Places;
pub(super) use reference::Frame as ReferenceFrame;

/// How often it is looked whether the journal is on disk, while it is on its way and while it cannot be written.
const JOURNAL_LOOK: [Duration; 2] = [Duration::from_millis(250), Duration::from_secs(1)];

/// A drawing's own file.
#[derive(Clone, Debug, Default)]
struct OwnFile {
    path: Option<PathBuf>,
    /// What the file held when it was last read or written here.
    stamp: Option<FileStamp>,
}

impl OwnFile {
    fn folder(&self) -> PathBuf {
        self.path.as_deref().and_then(Path::parent).map(Path::to_owned).unwrap_or_default()
    }

    fn name(&self) -> Option<String> {
        Some(self.path.as_ref()?.file_stem()?.to_string_lossy().into_owned())
    }
}

/// Outlines that are drawn.
#[derive(Clone, Copy, Debug, Default)]
struct Outlines {
    branches: bool,
    leaves: bool,
    crowns: bool,
}

impl Outlines {
    fn among(strokes: &[Arc<Stroke>]) -> Self {
        let drawn = |tool: Tool| strokes.iter().any(|s| s.tool == tool);
        Self {
            branches: drawn(Tool::BranchOutline),
            leaves: drawn(Tool::LeafOutline),
            crowns: drawn(Tool::Crown),
        }
    }
}

/// How the plant's building stands.
#[derive(Debug, Default)]
struct Building {
    /// Revision of the newest snapshot.
    submitted: u64,
    /// Revision of the newest snapshot whose plant was collected.
    collected: u64,
    /// What the worker has of the stroke under the pen.
    handed: live::Handed,
    /// The drawing changed since.
    is_stale: bool,
    is_running: bool,
    last: Option<Duration>,
    /// Why the last one failed.
    failure: Option<String>,
    /// Growth that is being replayed.
    replay: Option<growth::Replay>,
}

/// What the graphics card must hear of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Versions {
    /// Strokes, their colours or their preview.
    pub drawing: u64,
    /// The plant.
    pub plant: u64,
    /// The picture under the drawing.
    pub reference: u64,
}

/// The editor.
pub struct Editor {
    pub(super) document: Document,
    pub(super) canvas: Canvas,
    pub(super) plant: PlantView,
    pub(super) settings: Settings,
    /// What of them is on disk, or was tried to be put there.
    kept_settings: Option<Settings>,
    /// Colours of the system, where it says them.
    system_theme: Option<egui::Theme>,
    theme_asked: Option<Work<Option<egui::Theme>>>,
    pub(super) messages: Messages,
    pub(super) layout: Layout,
    pub(super) built: Option<Arc<Built>>,
    /// What there is of it.
    counts: Counts,
    pub(super) versions: Versions,
    places: Places,
    file: OwnFile,
    /// The species of the drawing, for the panels; `None` where it cannot be read.
    species: Option<(String, Species)>,
    outlines: Outlines,
    outcomes: Vec<CanvasOutcome>,
    worker: Worker,
    building: Building,
    recovery: Recovery,
    journal: Option<JournalWriter>,
    found: Vec<Recoverable>,
    /// Pictures of them, in their order.
    found_pictures: Vec<(PathBuf, egui::TextureHandle)>,
    dialog: Option<Dialog>,
    /// What waits for the answer about unsaved changes.
    held_up: Option<Action>,
    /// Revision of the drawing that the artist does not want to keep.
    given_up: Option<u64>,
    saver: Saver,
    part_menu: Option<PartMenu>,
    /// The picture under the drawing is being moved or scaled.
    hold: Option<reference::Hold>,
    notices: Notices,
    listed_presets: Vec<super::presets::Listed>,
    answers: Sender<Action>,
    answered: Receiver<Action>,
    chinese: ChineseLookup,
    fonts_are_set: bool,
    task: Option<Task>,
    pen_used: PenUsed,
    /// Name of the pen last used; empty for one without.
    pen_device: Option<String>,
    pen_is_raw: bool,
    /// Charge of the pen in percent.
    pen_battery: Option<u8>,
    /// What is said of tablets.
    tablets: TabletNews,
    pen_live: PenLive,
    /// What goes to the clipboard and is wanted from it.
    clipboard: Clipboard,
    /// When strokes were moved by a key last.
    nudged_at: Option<Instant>,
    title: Option<String>,
    shown_title: String,
    wake: task::Wake,
    closed: bool,
}

/// What is said of tablets that are read directly.
#[derive(Default)]
struct TabletNews {
    /// Why one cannot be read, and what to do.
    trouble: Option<String>,
    /// Those of which the model is not sure.
    doubts: Vec<TabletDoubt>,
    /// How many monitors one may cover.
    monitors: usize,
    /// What that of the pen last used covers, in physical pixels, if all of it is in the window.
    target: Option<crate::pen::mapping::Rect>,
}

impl Editor {
    /// Takes what other threads have finished.
    pub fn collect(&mut self) {
        if let Some(update) = self.worker.take() {
            self.take_update(update);
        }
        self.collect_task();
        self.collect_save();
        self.collect_system_theme();
        while let Ok(action) = self.answered.try_recv() {
            self.perform(action);
        }
    }

    fn take_update(&mut self, update: Update) {
        self.building.is_running = update.revision < self.building.submitted;
        self.building.collected = update.revision;
        self.building.last = Some(update.took);
        match update.result {
            Ok(built) => {
                self.plant.set_bounds(update.bounds);
                self.building.failure = None;
                tracing::debug!(
                    "built revision={} strokes={} flowers={} vertices={} triangles={} took={:.1}ms",
                    update.revision,
                    built.anatomy.marks.len(),
                    update.counts.flowers,
                    update.counts.vertices,
                    update.counts.triangles,
                    update.took.as_secs_f64() * 1e3
                );
                self.counts = update.counts;
                if let Some(old) = self.built.replace(built) {
                    self.worker.discard(old);
                }
                self.versions.plant += 1;
                self.versions.drawing += 1;
            }
            Err(error) => {
                let reason = error.localize(&self.messages);
                if self.building.failure.as_ref() != Some(&reason) {
                    self.tell(Notice::error(reason.clone(), ""));
                }
                self.building.failure = Some(reason);
            }
        }
    }

    /// Hands the newest drawing to the worker if it changed. Called once after all events of a moment.
    pub fn submit(&mut self) {
        self.watch_journal();
        self.replay_growth();
        if !std::mem::take(&mut self.building.is_stale) {
            return;
        }
        // Not simply a clone: of many strokes even the list is only copied once.
        let Sketch { canvas, species, seed, params, textures, reference, strokes } = self.document.sketch();
        let strokes = self.canvas.previewed(strokes);
        let growing = self.building.handed.grown(self.canvas.growing());
        let sketch = Sketch {
            canvas: *canvas,
            species: Some(species.clone().unwrap_or_else(|| DEFAULT_SPECIES.to_owned())),
            seed: *seed,
            params: growth::at_age(params, self.building.replay.as_ref()),
            textures: textures.clone(),
            reference: reference.clone(),
            strokes,
        };
        self.building.submitted += 1;
        self.building.is_running = true;
        let (revision, folder) = (self.building.submitted, self.file.folder());
        let overlay = self.plant.state.overlay;
        self.worker.submit(worker::Snapshot { revision, sketch, growing, folder, overlay });
    }

    /// Applies a change as one step: to the document, the journal, the canvas and the plant.
    fn change(&mut self, change: Change) {
        match self.document.apply(change) {
            Ok(Some(step)) => self.changed(&step),
            Ok(None) => {}
            Err(error) => self.tell_error(&error),
        }
    }

    /// The same for a slider on its way: one step from press to release.
    fn change_merging(&mut self, change: Change, key: &str) {
        match self.document.apply_merging(change, key) {
            Ok(Some(step)) => self.changed(&step),
            Ok(None) => {}
            Err(error) => self.tell_error(&error),
        }
    }

    fn changed(&mut self, step: &Arc<Step>) {
        if let Some(journal) = &mut self.journal {
            journal.append(step);
        }
        self.drawing_changed();
    }

    /// After any change of the drawing, also by undo or another file.
    fn drawing_changed(&mut self) {
        self.building.replay = None;
        let mut outcomes = std::mem::take(&mut self.outcomes);
        self.canvas.drawing_changed(&self.document.sketch().strokes, &mut outcomes);
        self.outcomes = outcomes;
        self.building.is_stale = true;
        self.versions.drawing += 1;
        self.versions.reference += 1;
        self.outlines = Outlines::among(&self.document.sketch().strokes);
        self.refresh_species();
        self.refresh_title();
    }

    /// Keeps the panels' copy of the species true.
    fn refresh_species(&mut self) {
        let sketch = self.document.sketch();
        let name = sketch.species.clone().unwrap_or_else(|| DEFAULT_SPECIES.to_owned());
        if self.species.as_ref().is_none_or(|(known, _)| *known != name) {
            let read = crate::pipeline::species_or_usual(sketch, &self.file.folder());
            self.species = read.ok().map(|(species, _)| (name, species));
        }
    }

    fn refresh_title(&mut self) {
        let name = self.file.name().unwrap_or_else(|| self.messages.get(Msg::AppUntitled).to_owned());
        let mark = if self.document.is_saved() { "" } else { "• " };
        let title = format!("{mark}{name} – Penstemon");
        if title != self.shown_title {
            self.shown_title.clone_from(&title);
            self.title = Some(title);
        }
    }

    /// A new title for the window.
    pub fn take_title(&mut self) -> Option<String> {
        self.title.take()
    }

    /// Shows a message.
    pub(super) fn tell(&mut self, notice: Notice) {
        tracing::debug!("notice: {} {}", notice.what, notice.remedy);
        self.notices.tell(notice, Instant::now());
    }

    /// Tells that the graphics card could not show something.
    pub(super) fn tell_render_failure(&mut self, error: &RenderError) {
        self.tell_error(error);
    }

    /// Tells that the graphics card was lost, and that all is drawn again.
    pub(super) fn tell_graphics_are_back(&mut self) {
        self.tell(Notice::info(self.messages.get(Msg::NoticeGraphicsBack)));
    }

    /// Where things are in the window.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// A new egui context knows no fonts.
    pub(super) fn forget_textures(&mut self) {
        self.found_pictures.clear();
        self.fonts_are_set = false;
        self.layout.forget_context();
    }

    /// Keeps a snapshot now: the window lost the focus or is about to go.
    pub fn snapshot(&mut self) {
        self.canvas.release_keys();
        if let Some(journal) = &self.journal {
            journal.snapshot();
        }
    }

    /// Whether the window should close.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// Ends everything; called once when the window closes. Waits for what is being saved.
    pub fn shut_down(&mut self) {
        self.finish();
        self.end_journal();
        self.saver.closing.clear();
    }

    /// Ends everything where the artist was not asked; the drawing is offered at the next start.
    pub(super) fn break_off(&mut self) {
        // The pen may be down: what it drew so far is kept, too.
        let growing = self.canvas.growing().map(|stroke| Stroke {
            id: stroke.id(),
            tool: stroke.tool(),
            points: stroke.points().to_vec(),
        });
        if let Some(stroke) = growing {
            self.change(Change::put(stroke));
        }
        self.finish();
        self.journal = None;
    }

    fn finish(&mut self) {
        self.finish_saving();
        self.save_settings();
        self.cancel_task();
    }

    /// Whether something on the screen moves by itself.
    pub fn wants_frame(&self) -> bool {
        self.plant.wants_frame()
    }

    /// Whether another thread works on something that will be shown.
    pub fn is_working(&self) -> bool {
        self.building.is_running
            || self.building.is_stale
            || self.is_playing()
            || self.task.is_some()
            || self.saver.is_busy()
    }

    /// What waits for an answer above everything.
    pub fn dialog(&self) -> Option<&Dialog> {
        self.dialog.as_ref()
    }

    /// When something on the screen changes by itself.
    pub fn wakes_at(&self) -> Option<Instant> {
        let news = self.notices.next_goes_at();
        let look = self.journal.as_ref().and_then(|journal| match journal.state() {
            JournalState::Saved => None,
            JournalState::Saving { .. } => Some(JOURNAL_LOOK[0]),
            JournalState::Failed(_) => Some(JOURNAL_LOOK[1]),
        });
        let saving = look.map(|after| Instant::now() + after);
        [news, saving, self.plant.wakes_at(), self.next_age_at()].into_iter().flatten().min()
    }
}
