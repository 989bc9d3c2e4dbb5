//! What a drawing means, still flat: parts, landmarks, flowers, branch hierarchy, filled outlines (000 chs. 2–3, 002
//! §§3–4).
//!
//! All positions are canvas pixels (x right, y down); every length threshold is a share of the drawing's diagonal or
//! of a blade's own size, so that the same drawing at another scale means the same plant.

pub mod analyse;
pub mod attach;
pub mod blade_outline;
pub mod classify;
pub mod conventions;
mod end_on;
#[cfg(test)]
mod end_on_tests;
pub mod features;
pub mod fill_leaves;
pub mod fill_twigs;
pub mod flower_centre;
pub mod flowers;
pub mod growth_points;
pub mod habit_classifier;
pub mod hierarchy;
pub mod leaf_twigs;
mod outlines;
pub mod preprocess;
pub mod reading;
pub mod recall;
pub mod svm;
mod thin_spots;
pub mod vein;

pub use analyse::{AnatomyParams, Cache, analyse, analyse_with};
pub use thin_spots::ThinSpot;

use crate::sketch::{StrokeId, StrokePoint, Warning};
use glam::Vec2;
use serde::Serialize;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Asked again and again, from any thread, whether the work is still wanted; yes to stop, and yes from then on.
pub type Stop<'a> = &'a (dyn Fn() -> bool + Sync);

/// What a stroke was understood as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Part {
    /// Blade of a flower.
    Petal,
    /// Blade on its own.
    Leaf,
    /// Skeleton of a branch.
    Branch,
    /// Region to fill with twigs.
    BranchOutline,
    /// Region to fill with leaves.
    LeafOutline,
    /// Outline of a crown.
    Crown,
    /// Too small to mean anything.
    Ignored,
}

/// A pen sample after preprocessing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Canvas position in pixels.
    pub position: Vec2,
    /// Pen pressure 0 to 1.
    pub pressure: f32,
    /// Pen tilt in degrees.
    pub tilt_deg: Vec2,
}

impl Sample {
    /// A sample that no pen made.
    pub fn neutral(position: Vec2) -> Self {
        Self { position, pressure: StrokePoint::NEUTRAL_PRESSURE, tilt_deg: Vec2::ZERO }
    }

    /// The sample between two others, `share` of the way from `a` to `b`.
    pub fn lerp(a: &Sample, b: &Sample, share: f32) -> Sample {
        Sample {
            position: a.position.lerp(b.position, share),
            pressure: a.pressure + (b.pressure - a.pressure) * share,
            tilt_deg: a.tilt_deg.lerp(b.tilt_deg, share),
        }
    }
}

/// The verdict on one stroke, in the order of the drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// The stroke.
    pub stroke: StrokeId,
    /// What it is.
    pub part: Part,
    /// How sure that is, 0 to 1; 1 where the artist chose the tool.
    pub confidence: f32,
}

/// A petal or leaf in the drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct FlatBlade {
    /// The stroke that drew it, `None` for a copy inside a leaf outline.
    pub stroke: Option<StrokeId>,
    /// Closed outline, first sample not repeated, from the root round to the root; empty for a copy, which has its
    /// template's.
    pub outline: Arc<[Sample]>,
    /// Where it is attached.
    pub root: Vec2,
    /// Its far, sharp end.
    pub tip: Vec2,
    /// Set for an affine copy of another leaf.
    pub copy_of: Option<Copy>,
    /// The place on a branch where it grows.
    pub attachment: Option<Attachment>,
}

/// How a generated leaf is made from a template.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Copy {
    /// Index into [`Anatomy::templates`].
    pub template: u32,
    /// Width relative to the template's at the same length.
    pub aspect: f32,
    /// Name of its random streams: that of the place it grew from.
    pub key: u64,
}

/// A place on a branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attachment {
    /// Index into [`Anatomy::branches`].
    pub branch: usize,
    /// Arc length from the branch's base, pixels.
    pub at: f32,
}

impl FlatBlade {
    /// Name of its random streams: the stroke's id or, for a copy, the name of the place it grew from. Another stroke
    /// elsewhere in the drawing does not change it.
    pub fn key(&self) -> u64 {
        self.copy_of.map(|copy| copy.key).or(self.stroke).unwrap_or(0)
    }

    /// Vector from root to tip in pixels.
    pub fn axis(&self) -> Vec2 {
        self.tip - self.root
    }
}

/// A branch in the drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct FlatBranch {
    /// The stroke that drew it, `None` for a generated twig.
    pub stroke: Option<StrokeId>,
    /// Name of its random streams: the stroke's id or, for a twig, the name of the place it grew from. Another stroke
    /// elsewhere in the drawing does not change it.
    pub key: u64,
    /// Skeleton from base to end, at least two samples.
    pub line: Arc<[Sample]>,
    /// The half width that a pressure of 1 stands for, pixels, where the branch was drawn by its sides.
    pub half_width: Option<f32>,
    /// Index of the branch that carries it, always smaller than its own.
    pub parent: Option<usize>,
    /// Arc length along the parent at which it is attached, pixels.
    pub attached_at: f32,
    /// 0 for a trunk, one more for each parent.
    pub level: u32,
}

/// A flower in the drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct FlatFlower {
    /// Indices into [`Anatomy::petals`].
    pub petals: Vec<usize>,
    /// Mean of the petals' roots.
    pub center: Vec2,
    /// Radius of its centre in pixels, where one was drawn.
    pub centre_radius: Option<f32>,
    /// The place on a branch where it grows.
    pub attachment: Option<Attachment>,
}

/// The outline of a crown in the drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct FlatCrown {
    /// The stroke that drew it.
    pub stroke: StrokeId,
    /// Closed outline in canvas pixels, first point not repeated.
    pub outline: Vec<Vec2>,
}

/// What a drawing means.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Anatomy {
    /// Diagonal of the drawing's bounding box in pixels.
    pub diagonal: f32,
    /// Bounding box of the strokes: smallest and largest corner in pixels.
    pub bounds: (Vec2, Vec2),
    /// A verdict for each stroke, in drawing order; for one that is several parts, that of the first of them.
    pub marks: Vec<Mark>,
    /// Of the strokes that were made of drawn ones, where they come from: names of strokes below may be theirs.
    pub pieces: BTreeMap<StrokeId, conventions::Piece>,
    /// Bodies of revolution, such as the pot that the plant stands in.
    pub solids: Vec<conventions::DrawnSolid>,
    /// Which strokes were read together, and as what.
    pub readings: Vec<conventions::ReadStrokes>,
    /// What kind of plant the drawing shows, as far as that can be seen.
    pub habit: Option<conventions::Habit>,
    /// Branches, parents before children; generated twigs among them.
    pub branches: Vec<FlatBranch>,
    /// Petals of all flowers.
    pub petals: Vec<FlatBlade>,
    /// Flowers over those petals.
    pub flowers: Vec<FlatFlower>,
    /// Leaves, drawn and generated.
    pub leaves: Vec<FlatBlade>,
    /// Outlines of crowns; one inside another is a hole.
    pub crowns: Vec<FlatCrown>,
    /// Dots in crowns, around which foliage is sparse.
    pub thin_spots: Vec<ThinSpot>,
    /// Outlines from which generated leaves were copied, root at the origin, tip at (0, 1), v toward the tip.
    pub templates: Vec<Arc<[Vec2]>>,
    /// Remarks about odd input.
    pub warnings: Vec<Warning>,
}

impl Anatomy {
    /// The drawn stroke behind the name of a stroke: its own, or the first of those that it was made of.
    pub fn drawn(&self, stroke: StrokeId) -> StrokeId {
        self.pieces.get(&stroke).map_or(stroke, conventions::Piece::first)
    }
}
