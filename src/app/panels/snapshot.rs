//! What panels read: the state of the application as plain data, copied together once per frame.

use crate::app::action::CanvasTool;
use crate::app::pen_settings::{PenSettings, TabletDoubt};
use crate::app::presets::Listed;
use crate::app::settings::{Handedness, Settings, Stabiliser, ThemeChoice};
use crate::params::join;
use crate::pen::PenSource;
use crate::plant::OrganKind;
use crate::sketch::{StrokeId, Tool};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::collections::BTreeMap;
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
    /// Whether the system has a font for Chinese.
    pub chinese_font: bool,
    /// Whether the side panel is shown.
    pub side_shown: bool,
    /// Width of the side panel, logical pixels.
    pub side_width: f32,
    /// Species of the drawing: a built-in name or a file.
    pub species: String,
    /// Textures that the artist chose, by kind of part (`branch`, `leaf`, …).
    pub textures: BTreeMap<String, String>,
    /// Seed of everything random.
    pub seed: u64,
    /// Parameters.
    pub params: ParamValues,
    /// How the plant grows; `None` where it does not.
    pub growth: Option<GrowthState>,
    /// Presets in the artist's folder.
    pub presets: Vec<Listed>,
    /// The reference picture under the drawing.
    pub reference: Option<ReferenceState>,
    /// How the plant is shown.
    pub view: ViewState,
    /// The pen last used.
    pub pen: PenState,
    /// What the status line says.
    pub status: Status,
    /// Parts that the analysis found, for the legend.
    pub found: Found,
    /// The menu that asks what a stroke is, at this place in logical pixels.
    pub part_menu: Option<PartMenu>,
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
}

/// Values of parameters by path, where they are not the program's defaults.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ParamValues {
    /// What the species says.
    pub species: BTreeMap<String, f64>,
    /// What the artist changed; switches are 0 or 1.
    pub own: BTreeMap<String, f64>,
}

impl ParamValues {
    /// Flattens the overrides of a species and of a drawing, as [`crate::pipeline::params_of`] lays them over the defaults.
    pub fn of(species: &Map<String, Value>, own: &Map<String, Value>) -> Self {
        let mut out = Self::default();
        flatten("", species, &mut out.species);
        flatten("", own, &mut out.own);
        out
    }
}

fn flatten(prefix: &str, tree: &Map<String, Value>, out: &mut BTreeMap<String, f64>) {
    for (key, value) in tree {
        let path = join(prefix, key);
        let number = match value {
            Value::Object(inner) => {
                flatten(&path, inner, out);
                None
            }
            Value::Bool(on) => Some(f64::from(u8::from(*on))),
            other => other.as_f64(),
        };
        if let Some(number) = number {
            out.insert(path, number);
        }
    }
}

/// The reference picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceState {
    /// 0 to 1.
    pub opacity: f32,
    /// Whether it stays where it is.
    pub locked: bool,
}

/// How the plant is shown.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ViewState {
    /// The sun.
    pub light: LightChoice,
    /// Finished, as a mesh, or by parts.
    pub shading: Shading,
    /// Without perspective.
    pub orthographic: bool,
    /// Turning by itself; a new session begins at rest.
    #[serde(skip)]
    pub turntable: bool,
}

impl Default for ViewState {
    fn default() -> Self {
        let (light, shading) = (LightChoice::default(), Shading::default());
        Self { light, shading, orthographic: true, turntable: false }
    }
}

impl ViewState {
    /// The same with numbers that a light can have.
    pub fn sane(self) -> Self {
        Self { light: self.light.sane(), ..self }
    }
}

/// The sun.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct LightChoice {
    /// Direction it comes from, seen from above: degrees, 0 from the viewer, positive to the right, −180 to 180.
    pub azimuth_deg: f32,
    /// Height above the horizon in degrees, 5 to 90.
    pub elevation_deg: f32,
    /// Strength, 1 as designed, 0 to 2.
    pub strength: f32,
    /// Colour, as the temperature of a black body in kelvin; 5500 as designed, 2000 to 12000.
    pub temperature_k: f32,
}

impl Default for LightChoice {
    fn default() -> Self {
        Self { azimuth_deg: -48.0, elevation_deg: 45.0, strength: 1.0, temperature_k: 5500.0 }
    }
}

impl LightChoice {
    /// The same with every number in its range.
    fn sane(self) -> Self {
        let start = Self::default();
        let within = |x: f32, start: f32, (min, max): (f32, f32)| {
            if x.is_finite() { x.clamp(min, max) } else { start }
        };
        Self {
            azimuth_deg: within(self.azimuth_deg, start.azimuth_deg, Self::AZIMUTHS_DEG),
            elevation_deg: within(self.elevation_deg, start.elevation_deg, Self::ELEVATIONS_DEG),
            strength: within(self.strength, start.strength, Self::STRENGTHS),
            temperature_k: within(self.temperature_k, start.temperature_k, (2000.0, 12000.0)),
        }
    }

    /// Least and largest direction.
    pub const AZIMUTHS_DEG: (f32, f32) = (-180.0, 180.0);
    /// Least and largest height.
    pub const ELEVATIONS_DEG: (f32, f32) = (5.0, 90.0);
    /// Least and largest strength.
    pub const STRENGTHS: (f32, f32) = (0.0, 2.0);
}

/// What the plant is shown as.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shading {
    /// With materials and light.
    #[default]
    Shaded,
    /// Triangles.
    Wireframe,
    /// Every part in its colour.
    Parts,
}

/// What the status line says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Status {
    /// Strokes of the drawing.
    pub strokes: usize,
    /// Flowers of the plant.
    pub flowers: usize,
    /// Vertices of the model.
    pub vertices: usize,
    /// Triangles of the model.
    pub triangles: usize,
    /// How long the last build took; `None` before the first.
    pub build_ms: Option<f32>,
    /// Whether a build is on its way.
    pub building: bool,
    /// What the plant lacks of what was drawn for it last, and why.
    pub shortfall: Option<String>,
    /// What was used last to draw.
    pub pen: PenUsed,
    /// Whether the drawing is safe.
    pub autosave: Autosave,
}

/// What was used last to draw.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum PenUsed {
    /// A mouse.
    #[default]
    Mouse,
    /// A finger.
    Touch,
    /// A pen, by its name where it is known.
    Pen(Option<String>),
}

/// Whether the drawing is safe.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Autosave {
    /// All in its file.
    #[default]
    Saved,
    /// Changes since the last saving are in the journal.
    Journaled,
    /// The drawing is being written into its file.
    Saving,
    /// The journal is being written.
    Writing,
    /// The journal cannot be written.
    Failed,
}

/// Parts that the analysis found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Found {
    /// Petals.
    pub petals: bool,
    /// Leaves.
    pub leaves: bool,
    /// Number of levels of branches.
    pub branch_levels: u32,
    /// Branch outlines.
    pub branch_outlines: bool,
    /// Leaf outlines.
    pub leaf_outlines: bool,
    /// Crowns.
    pub crowns: bool,
    /// Strokes that were not used.
    pub ignored: bool,
}

/// The pen last used, and how pens are read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PenState {
    /// Its name, where it is known, and how it is read; `None` before there was one.
    pub device: Option<String>,
    /// Whether its tablet is read directly.
    pub is_raw: bool,
    /// Its charge in percent, where it says so.
    pub battery: Option<u8>,
    /// Why a tablet cannot be read, and what to do.
    pub trouble: Option<String>,
    /// Tablets of which it is not sure which model they are.
    pub doubts: Vec<TabletDoubt>,
    /// How pens are read.
    pub source: PenSource,
    /// What the artist chose for it.
    pub settings: PenSettings,
    /// How it is held now.
    pub live: PenLive,
}

/// How a pen is held.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PenLive {
    /// Pressure as the pen reports it, 0 to 1.
    pub pressure: f32,
    /// Lean to the right and toward the artist, degrees.
    pub tilt_deg: [f32; 2],
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
    /// What the pen draws next.
    Pen,
}

/// A dialog above everything.
#[derive(Clone, Debug, PartialEq)]
pub enum Dialog {
    /// Save before going on?
    Unsaved,
    /// Drawings found again.
    Recovery(Vec<Recovered>),
    /// Format, parts and textures of an export.
    Export,
    /// A file, where the system has no dialog of its own.
    Path(PathRequest),
    /// Pen and tablet.
    Pen,
    /// What the program is, first steps and keys.
    About,
}

impl Dialog {
    /// Its name in what the program tells of itself.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Unsaved => "unsaved",
            Self::Recovery(_) => "recovery",
            Self::Export => "export",
            Self::Path(_) => "path",
            Self::Pen => "pen",
            Self::About => "about",
        }
    }
}

/// A drawing found again.
#[derive(Clone, Debug, PartialEq)]
pub struct Recovered {
    /// The recovery file.
    pub path: PathBuf,
    /// The drawing's name.
    pub name: String,
    /// Number of strokes.
    pub strokes: usize,
    /// When it was drawn, as the artist's locale says it.
    pub when: String,
    /// A picture of it.
    pub thumbnail: Option<egui::TextureId>,
}

/// What a path is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PathPurpose {
    /// Open a drawing.
    OpenDrawing,
    /// Save the drawing.
    SaveDrawing,
    /// Export the plant or the drawing.
    Export,
    /// A texture; `None` means branches.
    Texture(Option<OrganKind>),
    /// A species file.
    Species,
    /// A reference picture.
    Reference,
}

/// A question for a path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PathRequest {
    /// What for.
    pub purpose: PathPurpose,
    /// Folder to begin in.
    pub folder: PathBuf,
    /// Name to begin with, for files that are written.
    pub name: String,
    /// Extensions without dot that are shown, in lower case; empty shows all.
    pub extensions: Vec<&'static str>,
}

/// What is exported.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ExportFormat {
    /// Wavefront OBJ with MTL and textures.
    Obj,
    /// Binary glTF.
    #[default]
    Glb,
    /// The drawing as SVG.
    Svg,
    /// A picture of the plant.
    Png,
}

impl ExportFormat {
    /// Every format, in the order in which the dialog lists them.
    pub const ALL: [ExportFormat; 4] = [Self::Obj, Self::Glb, Self::Svg, Self::Png];

    /// The files' extension.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Glb => "glb",
            Self::Svg => "svg",
            Self::Png => "png",
        }
    }

    /// Whether it holds the plant's surfaces.
    pub fn is_model(self) -> bool {
        matches!(self, Self::Obj | Self::Glb)
    }
}

/// What the export dialog says.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct ExportChoice {
    /// File format.
    pub format: ExportFormat,
    /// With branches.
    pub branches: bool,
    /// With leaves.
    pub leaves: bool,
    /// With petals, sepals and hearts.
    pub flowers: bool,
    /// With pot, thorns and fruits.
    pub extras: bool,
    /// With textures.
    pub textures: bool,
    /// Picture without ground.
    pub transparent: bool,
    /// Width of the picture in pixels.
    pub width: u32,
    /// Height of the picture in pixels.
    pub height: u32,
    /// Number of pictures all around; 1 is the view as it stands.
    pub frames: u32,
}

impl Default for ExportChoice {
    fn default() -> Self {
        Self {
            format: ExportFormat::default(),
            branches: true,
            leaves: true,
            flowers: true,
            extras: true,
            textures: true,
            transparent: false,
            width: 1600,
            height: 1200,
            frames: 1,
        }
    }
}

impl ExportChoice {
    /// Whether nothing would be exported.
    pub fn is_empty(&self) -> bool {
        self.format.is_model() && !(self.branches || self.leaves || self.flowers || self.extras)
    }

    /// The same with sizes that a picture can have.
    pub fn sane(self) -> Self {
        let side = |s: u32| s.clamp(16, 8192);
        Self { width: side(self.width), height: side(self.height), frames: self.frames.clamp(1, 360), ..self }
    }

    /// Whether an organ belongs to the export.
    pub fn has(&self, organ: OrganKind) -> bool {
        match organ {
            OrganKind::Leaf => self.leaves,
            OrganKind::Petal
            | OrganKind::Sepal
            | OrganKind::Receptacle
            | OrganKind::Stamen
            | OrganKind::Pistil => self.flowers,
            OrganKind::Fruit | OrganKind::Thorn | OrganKind::Pot => self.extras,
        }
    }
}

/// A task that takes long.
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// What is being written.
    pub name: String,
    /// 0 to 1.
    pub progress: f32,
}

/// How serious a notice is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Severity {
    /// Something went well.
    #[default]
    Info,
    /// Something is odd.
    Warning,
    /// Something failed.
    Error,
}

/// A message: what happened and what the artist can do.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Notice {
    /// Names it when it is dismissed; the application counts.
    pub id: u64,
    /// How serious it is.
    pub severity: Severity,
    /// What happened.
    pub what: String,
    /// What the artist can do, empty where nothing is needed.
    pub remedy: String,
}

impl Notice {
    /// Good news.
    pub fn info(what: impl Into<String>) -> Self {
        Self { what: what.into(), ..Self::default() }
    }

    /// Something odd.
    pub fn warning(what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { id: 0, severity: Severity::Warning, what: what.into(), remedy: remedy.into() }
    }

    /// Something failed.
    pub fn error(what: impl Into<String>, remedy: impl Into<String>) -> Self {
        Self { severity: Severity::Error, ..Self::warning(what, remedy) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn overrides_are_flattened_in_any_spelling() {
        let species = serde_json::json!({"depth": {"world": {"height": 2.0}, "cone.flip": true}});
        let own = serde_json::json!({"depth.world": {"height": 3}});
        let values = ParamValues::of(species.as_object().unwrap(), own.as_object().unwrap());
        assert_eq!(
            values.species,
            [("depth.world.height".into(), 2.0), ("depth.cone.flip".into(), 1.0)].into()
        );
        assert_eq!(values.own, [("depth.world.height".into(), 3.0)].into());
    }

    #[test]
    fn an_export_of_nothing_is_seen() {
        let nothing = ExportChoice {
            branches: false,
            leaves: false,
            flowers: false,
            extras: false,
            ..Default::default()
        };
        assert!(nothing.is_empty());
        assert!(!ExportChoice { format: ExportFormat::Png, ..nothing }.is_empty());
        assert!(!ExportChoice::default().is_empty());
    }
}
