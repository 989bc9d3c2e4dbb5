//! Keeps out of a document what a file could not hold: the gate through which every change goes.

use super::change::{Change, StrokeChange};
use super::invariants::{check_stroke, is_in_range};
use super::plants::PlantsError;
use super::{
    Brush, Canvas, ReferenceError, Stroke, StrokePoint, brush, corrections, garden, limits, part_poses,
    petal_shapes, plants, textures,
};
use glam::Vec2;
use serde_json::{Map, Value};
use std::sync::Arc;
use thiserror::Error;

/// A change that a document does not accept; it stays as it was.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum ChangeError {
    /// More than a limit of [`limits`].
    #[error("a drawing holds at most {limit} {what}; save this one and go on in a new one")]
    Full {
        /// What there is too much of.
        what: &'static str,
        /// The limit.
        limit: usize,
    },
    /// The sheet has no area, or too much.
    #[error("the canvas cannot be {width} by {height} pixels; each side must lie between 0 and 2e7")]
    Canvas {
        /// Width as asked for.
        width: String,
        /// Height as asked for.
        height: String,
    },
    /// A parameter that no file can hold.
    #[error(
        "parameter `{path}` cannot be kept in a drawing; a parameter is a number, true or false, or a name"
    )]
    Param {
        /// Which.
        path: String,
    },
    /// Unknown part, or no texture.
    #[error("{0}")]
    Texture(String),
    /// A plant beside the drawn one, or too many of them.
    #[error(transparent)]
    Plants(#[from] PlantsError),
    /// Too many corrections.
    #[error("{0}; undo some of them")]
    Corrections(String),
    /// Too many shapes of petals, or one that cannot be kept.
    #[error("{0}")]
    PetalShapes(String),
    /// Too many poses of branches, or one that is no turn.
    #[error("{0}")]
    PartPoses(String),
    /// A garden that cannot be.
    #[error("{0}")]
    Garden(String),
    /// The picture under the drawing.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
}

/// The change without what cannot be kept of its strokes.
///
/// # Errors
/// Settings that cannot be kept.
pub(super) fn made_sound(mut change: Change) -> Result<Change, ChangeError> {
    let sound = |change| match change {
        StrokeChange::Put(stroke) => sound_stroke(stroke).map(StrokeChange::Put),
        remove @ StrokeChange::Remove(_) => Some(remove),
    };
    change.strokes = change.strokes.into_iter().filter_map(sound).collect();
    let settings = &change.settings;
    settings.canvas.map_or(Ok(()), check_canvas)?;
    if let Some(params) = &settings.params {
        let mut count = 0;
        check_params(params, 1, "", &mut count)?;
    }
    settings.textures.as_ref().map_or(Ok(()), textures::check).map_err(ChangeError::Texture)?;
    settings.plants.as_deref().map_or(Ok(()), plants::check)?;
    settings.corrections.as_deref().map_or(Ok(()), corrections::check).map_err(ChangeError::Corrections)?;
    settings.petal_shapes.as_deref().map_or(Ok(()), petal_shapes::check).map_err(ChangeError::PetalShapes)?;
    settings.part_poses.as_deref().map_or(Ok(()), part_poses::check).map_err(ChangeError::PartPoses)?;
    settings.garden.as_deref().map_or(Ok(()), garden::check).map_err(ChangeError::Garden)?;
    settings.reference.iter().flatten().try_for_each(|reference| reference.check())?;
    Ok(change)
}

/// The stroke as a file can hold it: every sample in range. `None` if nothing is left of it.
fn sound_stroke(stroke: Arc<Stroke>) -> Option<Arc<Stroke>> {
    if check_stroke(&stroke).is_ok() {
        return Some(stroke);
    }
    let points: Vec<StrokePoint> = stroke.points.iter().filter_map(sound_point).collect();
    let Stroke { id, tool, brush, .. } = *stroke;
    let sound = brush.filter(|brush| brush::check(tool, Some(brush)).is_ok());
    let brush = sound.or_else(|| tool.is_brush().then(Brush::default));
    (!points.is_empty()).then(|| Arc::new(Stroke { id, tool, points, brush }))
}

fn sound_point(point: &StrokePoint) -> Option<StrokePoint> {
    let tilt = limits::MAX_TILT_DEG;
    let number = |value: f32, otherwise: f32| if value.is_nan() { otherwise } else { value };
    let tilt_deg = Vec2::new(number(point.tilt_deg.x, 0.0), number(point.tilt_deg.y, 0.0));
    let point = StrokePoint {
        position: point.position,
        pressure: number(point.pressure, StrokePoint::NEUTRAL_PRESSURE).clamp(0.0, 1.0),
        tilt_deg: tilt_deg.clamp(Vec2::splat(-tilt), Vec2::splat(tilt)),
        time_ms: number(point.time_ms, 0.0).clamp(0.0, limits::MAX_TIME_MS),
        depth: number(point.depth, 0.0),
    };
    is_in_range(&point).then_some(point)
}

fn check_canvas(canvas: Canvas) -> Result<(), ChangeError> {
    let Canvas { width, height } = canvas;
    let fits = |side: f32| side > 0.0 && side <= limits::MAX_CANVAS_SIDE;
    if fits(width) && fits(height) {
        return Ok(());
    }
    Err(ChangeError::Canvas { width: width.to_string(), height: height.to_string() })
}

/// Holds parameters to what the reader of sketch files takes.
fn check_params(
    group: &Map<String, Value>,
    depth: usize,
    prefix: &str,
    count: &mut usize,
) -> Result<(), ChangeError> {
    for (name, value) in group {
        *count += 1;
        if *count > limits::MAX_PARAMS {
            return Err(ChangeError::Full { what: "parameters", limit: limits::MAX_PARAMS });
        }
        let path = crate::params::join(prefix, name);
        match value {
            Value::Object(inner) if depth < limits::MAX_PARAM_DEPTH => {
                check_params(inner, depth + 1, &path, count)?;
            }
            Value::Bool(_) | Value::Number(_) | Value::String(_) => {}
            Value::Object(_) | Value::Array(_) | Value::Null => return Err(ChangeError::Param { path }),
        }
    }
    Ok(())
}
