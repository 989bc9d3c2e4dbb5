//! What panels read: the state of the application as plain data, copied together once per frame.
//!
//! [`Snapshot`] is the whole; its parts stand in a file each.

mod beside;
mod brush;
mod garden;
mod levels;
mod params;
mod pen;
mod petals;
mod pose;
mod readings;
mod space;
mod status;

pub use beside::{AgeState, BesideState, PlantState};
pub use brush::BrushState;
pub use garden::GardenState;
pub use levels::{LevelState, LevelsState};
pub use params::ParamValues;
pub use pen::{PenLive, PenState};
pub use petals::{PetalPoint, PetalState};
pub use pose::PoseState;
pub use readings::{ReadTogether, Ways};
pub use space::SpaceState;
pub use status::{Autosave, Found, PenUsed, Status, Task};

pub use crate::app::dialog::{Dialog, PathPurpose, PathRequest, Recovered};
pub use crate::app::export_choice::{ExportChoice, ExportFormat};
pub use crate::app::notice::{Notice, Severity};
pub use crate::app::plant_search::PlantSearchState;
pub use crate::app::view_state::{LightChoice, ReferenceState, Shading, ViewState};

use crate::app::canvas_tool::CanvasTool;
use crate::app::presets::Listed;
use crate::app::settings::{Handedness, Settings, ThemeChoice};
use crate::app::stabiliser::Stabiliser;
use crate::growth::habit::Resource;
use crate::sketch::{StrokeId, Textures, Tool};
use std::path::PathBuf;

/// Everything that panels show.
#[derive(Clone, Debug, Default)]
pub struct Snapshot {
    /// The drawing's name, without folder and extension; `None` before it was saved.
    pub name: Option<String>,
    /// Whether there are changes that its file does not have.
    pub unsaved: bool,
    /// Drawings opened or saved last, the newest first.
    pub recent: Vec<PathBuf>,
    /// The tool in use.
    pub tool: CanvasTool,
    /// Whether there is something to undo.
    pub can_undo: bool,
    /// Whether there is something to redo.
    pub can_redo: bool,
    /// Number of selected strokes.
    pub selected: usize,
    /// Colours.
    pub theme: ThemeChoice,
    /// The hand that holds the pen.
    pub handedness: Handedness,
    /// Smoothing of strokes.
    pub stabiliser: Stabiliser,
    /// Whether a font for Chinese is at hand.
    pub chinese_font: bool,
    /// Whether the system was found to have no such font.
    pub lacks_chinese_font: bool,
    /// Whether the side panel is shown.
    pub side_shown: bool,
    /// Width of the side panel, logical pixels.
    pub side_width: f32,
    /// Species of the drawing: a built-in name or a file.
    pub species: String,
    /// Whether the species is a guess from what is drawn.
    pub species_is_guess: bool,
    /// Whether nothing is drawn.
    pub blank: bool,
    /// The name of the species file that the drawing names, if it is missing.
    pub missing_species: Option<String>,
    /// Textures that the artist chose, by kind of part (`branch`, `leaf`, …).
    pub textures: Textures,
    /// Seed of everything random.
    pub seed: u64,
    /// Parameters.
    pub params: ParamValues,
    /// How the plant grows; `None` where it does not.
    pub growth: Option<GrowthState>,
    /// How far its flowers have opened; `None` where none opens from a bud.
    pub opening: Option<OpeningState>,
    /// The plants beside the drawn one.
    pub beside: BesideState,
    /// Petals that are being shaped.
    pub petals: PetalState,
    /// Branches that are being drawn in space.
    pub space: SpaceState,
    /// The brushes.
    pub brush: BrushState,
    /// The garden around the plant.
    pub garden: GardenState,
    /// Branches that are being turned and bent.
    pub pose: PoseState,
    /// Presets in the artist's folder.
    pub presets: Vec<Listed>,
    /// The reference picture under the drawing.
    pub reference: Option<ReferenceState>,
    /// The search for the plant on it.
    pub plant_search: PlantSearchState,
    /// How the plant is shown.
    pub view: ViewState,
    /// The plant's levels of detail.
    pub levels: LevelsState,
    /// The pen last used.
    pub pen: PenState,
    /// What the status line says.
    pub status: Status,
    /// Parts that the analysis found, for the legend.
    pub found: Found,
    /// Strokes that were read together, in the order of the drawing.
    pub readings: Vec<ReadTogether>,
    /// How the strokes can be read that the menu of parts is about.
    pub ways: Option<Ways>,
    /// The menu that asks what a stroke is, at this place in logical pixels.
    pub part_menu: Option<PartMenu>,
    /// The stroke that is asked about or selected, if its part can have the picture under it as its texture.
    pub over_picture: Option<StrokeId>,
    /// What is odd about the stroke that the menu is about.
    pub remarks: Vec<String>,
    /// The dialog that is open.
    pub dialog: Option<Dialog>,
    /// What the export dialog says.
    pub export: ExportChoice,
    /// Expected size of the exported files in bytes, once it is known.
    pub export_bytes: Option<u64>,
    /// A task that takes long.
    pub task: Option<Task>,
    /// Messages that wait to be read, the oldest first.
    pub notices: Vec<Notice>,
}

impl Snapshot {
    /// Takes over what the settings say.
    pub fn with_settings(mut self, settings: &Settings) -> Self {
        self.theme = settings.theme;
        self.handedness = settings.handedness;
        self.stabiliser = settings.stabiliser;
        self.side_shown = settings.side_shown;
        self.side_width = settings.side_width;
        self.recent.clone_from(&settings.recent);
        self.export = settings.export.clone();
        self
    }
}

/// How the plant grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GrowthState {
    /// Age that is shown, years.
    pub age: f32,
    /// Oldest age that can be chosen, years.
    pub most: f32,
    /// Whether the artist chose the age.
    pub chosen: bool,
    /// Whether a crown is drawn.
    pub crown: bool,
    /// Whether growth is being replayed.
    pub playing: bool,
    /// What its buds compete for, once it has grown.
    pub resource: Option<Resource>,
}

/// How far flowers have opened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpeningState {
    /// 0 bud, 1 as far as the species opens them.
    pub open: f32,
    /// Whether the artist chose it.
    pub chosen: bool,
    /// Whether the opening is being replayed.
    pub playing: bool,
}

/// The menu that asks what a stroke is, or what to draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartMenu {
    /// What is asked about.
    pub of: MenuOf,
    /// What it is now.
    pub tool: Tool,
    /// Where the artist tapped, logical pixels of the window.
    pub at: [f32; 2],
}

/// What the menu of parts asks about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MenuOf {
    /// What this stroke is.
    Stroke(StrokeId),
    /// What the strokes are that this one was read with.
    Reading(StrokeId),
    /// What the pen draws next.
    Pen,
}
