//! The document: what the artist drew, before anybody understands it.
//!
//! A [`Sketch`] is plain data: strokes of raw pen samples in canvas pixels (x right, y down), the tool each was drawn
//! with, and the choices that belong to the drawing (species, seed, parameters). [`read()`] opens `.penstemon` JSON and
//! SVG; [`json`] also writes. Reading is total: any bytes end in a sketch or in a [`SketchError`] that says what is
//! wrong and where. Limits are constants in [`limits`].

mod brush;
pub mod change;
pub mod corrections;
pub mod document;
mod draft;
pub mod error;
pub mod garden;
pub mod garden_drawing;
mod invariants;
pub mod journal;
pub mod json;
pub mod limits;
pub mod part_poses;
pub mod petal_shapes;
pub mod plants;
pub mod read;
pub mod reference;
pub mod remark;
pub mod save;
pub mod settings;
mod sound;
pub mod species_file;
pub mod step;
pub mod stroke_reading;
pub mod svg;
pub mod textures;
pub(crate) mod warnings;

pub use brush::{Brush, DENSITIES as BRUSH_DENSITIES, GUIDES as BRUSH_GUIDES};
pub use change::{Change, StrokeChange};
pub use corrections::{Correction, Corrections, Verdict};
pub use document::{ChangeError, Document};
pub use error::SketchError;
pub use garden::{GardenPlant, GardenPoint, GardenStroke, GardenStrokes, GardenTool};
pub use garden_drawing::GardenDrawing;
pub use petal_shapes::{PetalShape, PetalShapes};
pub use plants::{Maker, PlacedPlant, PlantFault, PlantsError, SeedOf};
pub use read::{editable_from_bytes, from_bytes, read};
pub use reference::{Reference, ReferenceError};
pub use remark::{Remark, Warning};
pub use step::Step;
pub use stroke_reading::Reading;
pub use textures::{TextureChoice, Textures};

pub use part_poses::{Graft, PartName, PartPose, PartPoses};

pub use crate::picture::Picture;

use glam::Vec2;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::borrow::Cow;
use std::sync::Arc;

/// Name of a stroke within its drawing; unique, kept over saving and loading.
pub type StrokeId = u64;

/// What a stroke was drawn as.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Tool {
    /// Petal, leaf or branch: the classifier decides.
    #[default]
    Auto,
    /// Outline of a petal.
    Petal,
    /// Outline of a leaf.
    Leaf,
    /// Skeleton of a branch.
    Branch,
    /// Region to fill with twigs.
    BranchOutline,
    /// Region to fill with leaves.
    LeafOutline,
    /// Outline of a crown that the plant grows into; one inside another is a hole.
    Crown,
    /// Skeleton of a branch drawn in the view of the plant: its samples have depths, and no rule reads it as anything else.
    SpaceBranch,
    /// Way of a ball through the space of the plant in which wood and leaves grow.
    GrowthBrush,
    /// Way of a ball through the space of the plant that cuts off what is in it.
    PruningBrush,
    /// Way of a ball through the space of the plant that shines: what grows there grows toward it.
    LightBrush,
    /// Way of a ball through the space of the plant: leaves stand on the wood in it.
    LeafBrush,
    /// Way of a ball through the space of the plant: flowers stand on the wood in it.
    FlowerBrush,
}

impl Tool {
    /// Every tool, in the order in which help and panels list them.
    pub const ALL: [Tool; 13] = [
        Tool::Auto,
        Tool::Petal,
        Tool::Leaf,
        Tool::Branch,
        Tool::BranchOutline,
        Tool::LeafOutline,
        Tool::Crown,
        Tool::SpaceBranch,
        Tool::GrowthBrush,
        Tool::PruningBrush,
        Tool::LightBrush,
        Tool::LeafBrush,
        Tool::FlowerBrush,
    ];

    /// Whether its strokes are the way of a ball, and have a [`Brush`].
    pub fn is_brush(self) -> bool {
        match self {
            Self::GrowthBrush
            | Self::PruningBrush
            | Self::LightBrush
            | Self::LeafBrush
            | Self::FlowerBrush => true,
            Self::Auto
            | Self::Petal
            | Self::Leaf
            | Self::Branch
            | Self::BranchOutline
            | Self::LeafOutline
            | Self::Crown
            | Self::SpaceBranch => false,
        }
    }

    /// Whether its strokes lie in the space of the plant and not on the sheet.
    pub fn is_in_space(self) -> bool {
        self == Self::SpaceBranch || self.is_brush()
    }

    /// The name used in files.
    pub fn name(self) -> &'static str {
        match self {
            Tool::Auto => "auto",
            Tool::Petal => "petal",
            Tool::Leaf => "leaf",
            Tool::Branch => "branch",
            Tool::BranchOutline => "branch_outline",
            Tool::LeafOutline => "leaf_outline",
            Tool::Crown => "crown",
            Tool::SpaceBranch => "space_branch",
            Tool::GrowthBrush => "growth_brush",
            Tool::PruningBrush => "pruning_brush",
            Tool::LightBrush => "light_brush",
            Tool::LeafBrush => "leaf_brush",
            Tool::FlowerBrush => "flower_brush",
        }
    }
}

/// One raw sample of the pen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrokePoint {
    /// Canvas position in pixels, x right, y down.
    pub position: Vec2,
    /// Pen pressure 0 to 1; a mouse or a finger has [`StrokePoint::NEUTRAL_PRESSURE`].
    pub pressure: f32,
    /// Pen tilt in degrees, −90 to 90: x toward the right, y toward the artist.
    pub tilt_deg: Vec2,
    /// Milliseconds since the stroke began.
    pub time_ms: f32,
    /// How far in front of the sheet it lies, canvas pixels toward the viewer; 0 for what is drawn on the sheet.
    pub depth: f32,
}

impl StrokePoint {
    /// Pressure of a device that has none; gives the behaviour of the papers.
    pub const NEUTRAL_PRESSURE: f32 = 0.5;

    /// A sample from a device that knows nothing but its position.
    pub fn at(position: Vec2) -> Self {
        Self { position, pressure: Self::NEUTRAL_PRESSURE, tilt_deg: Vec2::ZERO, time_ms: 0.0, depth: 0.0 }
    }
}

/// One pen-down to pen-up.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// Name within the drawing.
    pub id: StrokeId,
    /// What it was drawn as.
    pub tool: Tool,
    /// Raw samples in the order drawn; never empty in a sketch that was read.
    pub points: Vec<StrokePoint>,
    /// The ball that a brush moves; strokes of other tools have none.
    pub brush: Option<Brush>,
}

/// Size of the drawing surface in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Canvas {
    /// Width in pixels, positive.
    pub width: f32,
    /// Height in pixels, positive.
    pub height: f32,
}

impl Canvas {
    /// The sheet of a new drawing.
    pub const DEFAULT: Self = Self { width: 1024.0, height: 768.0 };
}

/// A drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Sketch {
    /// Drawing surface; the strokes' bounding box when the file said nothing.
    pub canvas: Canvas,
    /// Built-in species name or path of a species file; `None` is any plant (`pipeline::DEFAULT_SPECIES`).
    pub species: Option<String>,
    /// Seed of everything random in the plant.
    pub seed: u64,
    /// Parameter overrides by dotted path or nested object.
    pub params: Map<String, Value>,
    /// Textures that the artist chose.
    pub textures: Textures,
    /// The picture under the drawing.
    pub reference: Option<Arc<Reference>>,
    /// The plants beside the drawn one.
    pub plants: Vec<PlacedPlant>,
    /// What the artist says of how strokes are read together.
    pub corrections: Corrections,
    /// What the artist makes of petals.
    pub petal_shapes: PetalShapes,
    /// How the artist turned and bent branches.
    pub part_poses: PartPoses,
    /// The garden that is painted around the plant.
    pub garden: GardenStrokes,
    /// The strokes, oldest first.
    pub strokes: Vec<Arc<Stroke>>,
}

impl Sketch {
    /// A sheet without strokes.
    pub fn empty() -> Self {
        Self {
            canvas: Canvas::DEFAULT,
            species: None,
            seed: 1,
            params: Map::new(),
            textures: Textures::new(),
            reference: None,
            plants: Vec::new(),
            corrections: Corrections::default(),
            petal_shapes: PetalShapes::default(),
            part_poses: PartPoses::default(),
            garden: GardenStrokes::default(),
            strokes: Vec::new(),
        }
    }

    /// Every picture that belongs to the drawing: its own textures, and the one under it. A picture may come again.
    pub fn pictures(&self) -> impl Iterator<Item = &Picture> {
        let reference = self.reference.as_ref().map(|reference| &reference.picture);
        textures::pictures(&self.textures).chain(reference)
    }

    /// The strokes that are drawn on the sheet, in their order: what the drawing is read from.
    pub fn on_sheet(&self) -> Cow<'_, [Arc<Stroke>]> {
        if !self.strokes.iter().any(|stroke| stroke.tool.is_in_space()) {
            return Cow::Borrowed(&self.strokes);
        }
        Cow::Owned(self.strokes.iter().filter(|stroke| !stroke.tool.is_in_space()).cloned().collect())
    }

    /// The branches that are drawn in the view of the plant, in their order.
    pub fn in_space(&self) -> impl Iterator<Item = &Arc<Stroke>> {
        self.strokes.iter().filter(|stroke| stroke.tool == Tool::SpaceBranch)
    }

    /// The strokes of brushes, in their order.
    pub fn brush_strokes(&self) -> impl Iterator<Item = &Arc<Stroke>> {
        self.strokes.iter().filter(|stroke| stroke.tool.is_brush())
    }

    /// Smallest and largest corner over all samples, `None` without samples.
    pub fn bounds(&self) -> Option<(Vec2, Vec2)> {
        let mut positions = self.strokes.iter().flat_map(|s| &s.points).map(|p| p.position);
        let first = positions.next()?;
        Some(positions.fold((first, first), |(lo, hi), p| (lo.min(p), hi.max(p))))
    }

    /// Diagonal of [`Sketch::bounds`] in pixels: the yardstick of every scale-free length. Zero without samples.
    pub fn diagonal(&self) -> f32 {
        self.bounds().map_or(0.0, |(lo, hi)| (hi - lo).length())
    }
}
