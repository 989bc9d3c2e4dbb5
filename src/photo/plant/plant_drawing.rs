//! A plant from a photograph as a drawing: crowns and trunk as strokes over the photograph.
//!
//! Every outline of the crown is a stroke of the crown tool, holes too, for one crown inside another is a hole in it. The trunk is a branch,
//! drawn from the foot up; its width is its pressure, and the width at half pressure is the parameter of trunks, so that the
//! model's trunk is as thick as the photograph's.
//!
//! Limits: pressure ends at 1, so no place of a trunk is more than twice as thick as its middle.

use super::super::error::PhotoError;
use super::parts::TrunkLine;
use super::plant_photo::PlantPhoto;
use super::tint::tinted_textures;
use crate::picture::Picture;
use crate::sketch::{Canvas, Reference, Sketch, Stroke, StrokeId, StrokePoint, Tool};
use crate::species::Species;
use glam::Vec2;
use serde_json::Value;
use std::sync::Arc;

/// The longer side of the sheet, canvas pixels.
const SIDE: f32 = 1024.0;
/// Least pressure of a trunk.
const LIGHTEST: f32 = 0.05;
/// The parameter that says how thick a trunk of half pressure is.
pub const TRUNK_RADIUS: &str = "depth.radii.trunk";
/// What that parameter may be.
const TRUNK_RADII: (f32, f32) = (0.0002, 0.2);

/// What [`TRUNK_RADIUS`] is for a trunk so wide in a drawing with such a diagonal, canvas pixels.
pub fn trunk_radius(width: f32, diagonal: f32) -> Value {
    let radius = (0.5 * width / diagonal.max(f32::MIN_POSITIVE)).clamp(TRUNK_RADII.0, TRUNK_RADII.1);
    // Five decimals are as exact as the photograph.
    ((f64::from(radius) * 1e5).round() / 1e5).into()
}

impl TrunkLine {
    /// A stroke along the trunk, with its width as pressure; half pressure is its mean width.
    pub fn stroke(&self, id: StrokeId, on_canvas: impl Fn(Vec2) -> Vec2) -> Stroke {
        let usual = self.usual_width();
        let point = |(place, width): (&Vec2, &f32)| {
            let pressure = (StrokePoint::NEUTRAL_PRESSURE * width / usual).clamp(LIGHTEST, 1.0);
            StrokePoint { pressure, ..StrokePoint::at(on_canvas(*place)) }
        };
        Stroke {
            id,
            tool: Tool::Branch,
            points: self.points.iter().zip(&self.widths).map(point).collect(),
            brush: None,
        }
    }

    /// Its mean width, pixels.
    pub fn usual_width(&self) -> f32 {
        let sum: f32 = self.widths.iter().sum();
        (sum / self.widths.len().max(1) as f32).max(f32::MIN_POSITIVE)
    }
}

impl PlantPhoto {
    /// Its crowns and its trunk as strokes, named from `first` on.
    pub fn strokes(&self, first: StrokeId, on_canvas: impl Fn(Vec2) -> Vec2) -> Vec<Stroke> {
        let crowns = self.crown.iter().zip(first..).map(|(line, id)| {
            let around = line.points.iter().chain(line.points.first());
            let points = around.map(|place| StrokePoint::at(on_canvas(*place))).collect();
            Stroke { id, tool: Tool::Crown, points, brush: None }
        });
        let mut strokes: Vec<Stroke> = crowns.collect();
        if let Some(trunk) = &self.trunk {
            strokes.push(trunk.stroke(first + strokes.len() as u64, &on_canvas));
        }
        strokes
    }

    /// The species of a plant like this where the artist names none.
    pub fn usual_species(&self) -> &'static str {
        if self.trunk.is_some() { "oak" } else { "hazel" }
    }

    /// A drawing of it in a species: the strokes, the photograph under them, and leaves and bark in its colours.
    ///
    /// # Errors
    /// A texture that cannot be encoded.
    pub fn drawing(&self, photograph: Picture, species: &Species) -> Result<Sketch, PhotoError> {
        let size = self.size.as_vec2();
        let scale = SIDE / size.max_element();
        let canvas = Canvas { width: size.x * scale, height: size.y * scale };
        let reference = Reference::new(photograph, 0.5 * size * scale, canvas.width);
        let strokes = self.strokes(1, |place| place * scale).into_iter().map(Arc::new).collect();
        let strokes = Sketch { strokes, ..Sketch::empty() };
        let radius = |trunk: &TrunkLine| trunk_radius(trunk.usual_width() * scale, strokes.diagonal());
        Ok(Sketch {
            canvas,
            species: Some(species.name.clone()),
            params: self.trunk.iter().map(|trunk| (TRUNK_RADIUS.to_owned(), radius(trunk))).collect(),
            textures: tinted_textures(species, &self.colours)?,
            reference: Some(Arc::new(Reference { locked: true, ..reference })),
            ..strokes
        })
    }
}
