//! The sketch file: UTF-8 JSON, extension `.penstemon`, readable and diffable.
//!
//! ```json
//! {
//!   "format": "penstemon-sketch",
//!   "version": 1,
//!   "canvas": {"width": 1024, "height": 768},
//!   "species": "daisy",
//!   "seed": 1,
//!   "params": {},
//!   "strokes": [
//!     {"id": 1, "tool": "petal", "points": [[10, 20], [11, 22]]}
//!   ]
//! }
//! ```
//!
//! A point is `[x, y]`, `[x, y, pressure]`, `[x, y, pressure, tilt_x, tilt_y]`, all these and the time, or these and the depth. Only `format`,
//! `version`, `strokes` and each stroke's `points` are required. Beside what is shown there may be `textures` (an object:
//! part to texture), `plants` (those that stand beside the drawn one), `corrections` (of how strokes are read together), `petal_shapes` (how the artist moved control points of petals), `wood_poses` (how branches and organs are turned and moved), `garden` (what is painted on the ground around the plant) and, behind the strokes, `garden_drawings` (plants in it that are drawn elsewhere), a `reference` (the picture under the drawing, in base64) and `pictures` (those
//! that textures name, in base64); all of it is described in `docs/sketches.md`. Unknown fields are errors, so that a typing mistake does not pass unseen. Reading what [`write()`]
//! wrote gives the same sketch, bit by bit.

mod corrections;
mod fault;
mod garden;
mod names;
mod number;
mod params;
mod parse;
mod part_poses;
mod petal_shapes;
mod picture;
mod plants;
mod point;
mod progress;
mod reference;
pub(super) mod step;
mod write;

pub use fault::newer_version;
pub(super) use number::push_number;
pub(super) use parse::{garden_drawings, parse};

pub(super) use write::push_garden_drawings;
pub use write::write;

use super::{Correction, GardenPlant, GardenStroke, GardenTool, PartPose, Reading, Sketch, Stroke};
use super::{TextureChoice, Tool, Verdict};
use glam::Vec3;
use std::sync::Arc;

/// What the `format` field says.
pub const FORMAT: &str = "penstemon-sketch";

/// The newest version that the `version` field may say.
///
/// 1: all but pictures of the artist's own for textures, of which only the path was kept. 2: these pictures themselves. 3: plants
/// beside the drawn one. 4: corrections of how strokes are read together. 5: shapes of
/// petals. 6: branches drawn, and turned, in the view of the plant. 7: strokes of brushes there. 8: strokes of the
/// light brush. 9: poses of branches that grew, and their thickness. 10: parts that are moved along what they grow on, and strokes of the leaf and the flower brush.
/// 11: a garden around the plant. 12: ages and other drawings in it. 13: parts that are straightened or grafted.
/// 14: branches that are younger than their plant, and parts that are copies of others; corrections about bare trees.
pub const VERSION: u32 = 14;

/// The oldest version that can hold a sketch, so that older programs open what they understand.
fn version_of(sketch: &Sketch) -> u32 {
    let is_bare_tree = |correction: &Correction| {
        matches!(correction.verdict, Verdict::Not(Reading::BareTree) | Verdict::As(Reading::BareTree))
    };
    let is_new = sketch.corrections.iter().any(is_bare_tree);
    if is_new || !sketch.part_poses.iter().all(PartPose::is_of_version_13) {
        return 14;
    }
    if !sketch.part_poses.iter().all(PartPose::is_of_old_kinds) {
        return 13;
    }
    let has_age_or_drawing = |stroke: &Arc<GardenStroke>| match &stroke.tool {
        GardenTool::Plants(GardenPlant::Species { age, .. }) => age.is_some(),
        GardenTool::Plants(GardenPlant::Drawing(_)) => true,
        GardenTool::Plants(GardenPlant::Drawn) | GardenTool::Path | GardenTool::Clear => false,
    };
    if sketch.garden.iter().any(has_age_or_drawing) {
        return 12;
    }
    if !sketch.garden.is_empty() {
        return 11;
    }
    let has_depth = |stroke: &Stroke| stroke.points.iter().any(|point| point.depth != 0.0);
    let is_in_space = |stroke: &Stroke| stroke.tool == Tool::SpaceBranch || has_depth(stroke);
    let paints_organs = |stroke: &Arc<Stroke>| matches!(stroke.tool, Tool::LeafBrush | Tool::FlowerBrush);
    let is_shifted = sketch.part_poses.iter().any(|pose| pose.shift != Vec3::ZERO);
    if is_shifted || sketch.brush_strokes().any(paints_organs) {
        return 10;
    }
    if sketch.part_poses.iter().any(|pose| !pose.is_of_first_kind()) {
        return 9;
    }
    if sketch.brush_strokes().any(|stroke| stroke.tool == Tool::LightBrush) {
        return 8;
    }
    if sketch.brush_strokes().next().is_some() {
        return 7;
    }
    if !sketch.part_poses.is_empty() || sketch.strokes.iter().any(|stroke| is_in_space(stroke)) {
        return 6;
    }
    if !sketch.petal_shapes.is_empty() {
        return 5;
    }
    if !sketch.corrections.is_empty() {
        return 4;
    }
    if !sketch.plants.is_empty() {
        return 3;
    }
    let has_own = sketch.textures.values().any(|choice| matches!(choice, TextureChoice::Own(_)));
    if has_own { 2 } else { 1 }
}
