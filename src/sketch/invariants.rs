//! What must hold for every [`Sketch`] that was read; called by tests, property tests and fuzz targets.

use super::{
    Sketch, Stroke, StrokePoint, brush, corrections, garden, limits, part_poses, petal_shapes, plants,
    textures,
};
use glam::Vec2;
use std::collections::HashSet;

impl Sketch {
    /// Checks that ids are unique, strokes are not empty, textures belong to parts, plants, corrections, shapes of petals and poses of branches are not too many, and every number is finite and in
    /// range.
    ///
    /// # Errors
    /// The first violation, in words.
    pub fn check_invariants(&self) -> Result<(), String> {
        let fits = |side: f32| side > 0.0 && side <= limits::MAX_CANVAS_SIDE;
        if !fits(self.canvas.width) || !fits(self.canvas.height) {
            return Err(format!("canvas {:?}", self.canvas));
        }
        let mut ids = HashSet::new();
        for stroke in &self.strokes {
            if !ids.insert(stroke.id) {
                return Err(format!("stroke {}: id used twice", stroke.id));
            }
            check_stroke(stroke).map_err(|what| format!("stroke {}: {what}", stroke.id))?;
        }
        textures::check(&self.textures)?;
        plants::check(&self.plants).map_err(|error| error.to_string())?;
        corrections::check(&self.corrections)?;
        petal_shapes::check(&self.petal_shapes)?;
        part_poses::check(&self.part_poses)?;
        garden::check(&self.garden)?;
        self.reference.as_ref().map_or(Ok(()), |reference| reference.check().map_err(|e| e.to_string()))
    }
}

/// What is wrong with a stroke, in words.
pub(super) fn check_stroke(stroke: &Stroke) -> Result<(), String> {
    if stroke.points.is_empty() {
        return Err("no points".into());
    }
    brush::check(stroke.tool, stroke.brush.as_ref())?;
    match stroke.points.iter().position(|p| !is_in_range(p)) {
        Some(at) => Err(format!("point {at} out of range: {:?}", stroke.points[at])),
        None => Ok(()),
    }
}

/// Whether every number of a sample is finite and within [`limits`].
pub(super) fn is_in_range(point: &StrokePoint) -> bool {
    let within = |v: Vec2, most: f32| v.abs().cmple(Vec2::splat(most)).all();
    within(point.position, limits::MAX_COORDINATE)
        && (0.0..=1.0).contains(&point.pressure)
        && within(point.tilt_deg, limits::MAX_TILT_DEG)
        && (0.0..=limits::MAX_TIME_MS).contains(&point.time_ms)
        && point.depth.abs() <= limits::MAX_COORDINATE
}
