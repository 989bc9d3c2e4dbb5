//! From what a parser found to a [`Sketch`]: the checks and repairs that every format shares.
//!
//! Strokes get ids, pressure, tilt and time are brought into range (with a remark), strokes without samples are left
//! out (with a remark), coordinates are checked against [`limits`], and a missing canvas becomes the bounding box.

use super::error::{Fault, Place};
use super::reference::Reference;
use super::textures::Textures;
use super::warnings::Warnings;
use super::{
    Brush, Canvas, Corrections, GardenStrokes, PartPoses, PetalShapes, PlacedPlant, Remark, Sketch, Stroke,
    StrokeId, StrokePoint, Tool, limits,
};
use glam::{Vec2, Vec3};
use serde_json::{Map, Value};
use std::collections::HashMap;
use std::sync::Arc;

/// A drawing as its file has it.
#[derive(Debug, Default)]
pub(super) struct Draft {
    pub(super) canvas: Option<Canvas>,
    pub(super) species: Option<String>,
    pub(super) seed: u64,
    pub(super) params: Map<String, Value>,
    pub(super) textures: Textures,
    pub(super) reference: Option<Arc<Reference>>,
    pub(super) plants: Vec<PlacedPlant>,
    pub(super) corrections: Corrections,
    pub(super) petal_shapes: PetalShapes,
    pub(super) part_poses: PartPoses,
    pub(super) garden: GardenStrokes,
    pub(super) strokes: Vec<DraftStroke>,
}

/// What a drawing is read for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Purpose {
    /// To make a plant of it: there must be a line, a plant beside it, or a garden.
    Build,
    /// To draw on in it: an empty sheet is as good as any.
    Edit,
}

/// A stroke as its file has it.
#[derive(Debug)]
pub(super) struct DraftStroke {
    pub(super) id: Option<StrokeId>,
    pub(super) tool: Tool,
    pub(super) points: Vec<StrokePoint>,
    pub(super) brush: Option<Brush>,
}

/// A fault and its place, before the file's name is added.
pub(super) type Flaw = (Place, Fault);

impl Draft {
    /// The finished sketch.
    ///
    /// # Errors
    /// The first duplicate id or coordinate out of range; to build from, a drawing in which no stroke moves.
    pub(super) fn finish(mut self, purpose: Purpose, warnings: &mut Warnings) -> Result<Sketch, Flaw> {
        let mut ids = Ids::of(&self.strokes)?;
        let mut strokes = Vec::with_capacity(self.strokes.len());
        for (index, DraftStroke { id, tool, mut points, brush }) in
            std::mem::take(&mut self.strokes).into_iter().enumerate()
        {
            check_coordinates(&points).map_err(|(point, fault)| {
                let id = id.map(|id| id.to_string());
                (Place { stroke: Some(index + 1), id, point: Some(point + 1), ..Place::default() }, fault)
            })?;
            if points.is_empty() {
                warnings.add(id, || Remark::NoPoints { place: index + 1 });
                continue;
            }
            let id = id.unwrap_or_else(|| ids.next_unused());
            bring_into_range(id, &mut points, warnings);
            strokes.push(Stroke { id, tool, points, brush });
        }
        let needs_lines = purpose == Purpose::Build && self.plants.is_empty() && self.garden.is_empty();
        if strokes.is_empty() && needs_lines {
            return Err((Place::default(), Fault::NoStrokes));
        }
        if strokes.iter().all(is_dot) && needs_lines {
            return Err((Place::default(), Fault::OnlyDots));
        }
        let Self {
            canvas,
            species,
            seed,
            params,
            textures,
            reference,
            plants,
            corrections,
            petal_shapes,
            part_poses,
            garden,
            strokes: _,
        } = self;
        let strokes = strokes.into_iter().map(Arc::new).collect();
        let sheet = canvas.unwrap_or(Canvas::DEFAULT);
        let mut sketch = Sketch {
            canvas: sheet,
            species,
            seed,
            params,
            textures,
            reference,
            plants,
            corrections,
            petal_shapes,
            part_poses,
            garden,
            strokes,
        };
        if canvas.is_none() {
            sketch.canvas = bounding_canvas(&sketch);
        }
        Ok(sketch)
    }
}

/// The ids in use, and a source of unused ones.
struct Ids {
    first_use: HashMap<StrokeId, usize>,
    last_assigned: StrokeId,
}

impl Ids {
    fn of(strokes: &[DraftStroke]) -> Result<Self, Flaw> {
        let mut first_use = HashMap::new();
        for (index, id) in strokes.iter().enumerate().filter_map(|(i, s)| Some((i, s.id?))) {
            if let Some(first) = first_use.insert(id, index) {
                let place = Place { stroke: Some(index + 1), id: Some(id.to_string()), ..Place::default() };
                return Err((place, Fault::DuplicateId { id, first: first + 1 }));
            }
        }
        Ok(Self { first_use, last_assigned: 0 })
    }

    /// Counts up from 1, so that a drawing without ids numbers its strokes.
    fn next_unused(&mut self) -> StrokeId {
        loop {
            self.last_assigned += 1;
            if !self.first_use.contains_key(&self.last_assigned) {
                return self.last_assigned;
            }
        }
    }
}

fn check_coordinates(points: &[StrokePoint]) -> Result<(), (usize, Fault)> {
    let place = |p: &StrokePoint| p.position.extend(p.depth);
    let inside = |p: &StrokePoint| place(p).abs().cmple(Vec3::splat(limits::MAX_COORDINATE)).all();
    match points.iter().position(|p| !inside(p)) {
        None => Ok(()),
        Some(at) => Err((at, coordinate_fault(place(&points[at]).to_array()))),
    }
}

/// The fault of coordinates that are not all in range: that of the worst.
pub(super) fn coordinate_fault<T: Copy + Into<f64> + std::fmt::LowerExp, const N: usize>(
    place: [T; N],
) -> Fault {
    let size = |x: &T| {
        let size = (*x).into().abs();
        if size.is_nan() { f64::INFINITY } else { size }
    };
    let worst = place.into_iter().max_by(|a, b| size(a).total_cmp(&size(b)));
    let (is_number, found) =
        worst.map_or((true, String::new()), |worst| (!worst.into().is_nan(), format!("{worst:e}")));
    if is_number { Fault::CoordinateTooLarge { found } } else { Fault::NotFinite { found } }
}

fn bring_into_range(id: StrokeId, points: &mut [StrokePoint], warnings: &mut Warnings) {
    let (mut pressures, mut tilts, mut times) = (0_usize, 0_usize, 0_usize);
    let max_tilt = Vec2::splat(limits::MAX_TILT_DEG);
    for point in points {
        let pressure = point.pressure.clamp(0.0, 1.0);
        let tilt_deg = point.tilt_deg.clamp(-max_tilt, max_tilt);
        let time_ms = point.time_ms.clamp(0.0, limits::MAX_TIME_MS);
        pressures += usize::from(pressure != point.pressure);
        tilts += usize::from(tilt_deg != point.tilt_deg);
        times += usize::from(time_ms != point.time_ms);
        *point = StrokePoint { pressure, tilt_deg, time_ms, ..*point };
    }
    for (points, remark) in [
        (pressures, Remark::PressureOutside { points: pressures }),
        (tilts, Remark::TiltOutside { points: tilts }),
        (times, Remark::TimeOutside { points: times }),
    ] {
        if points > 0 {
            warnings.add(Some(id), || remark);
        }
    }
}

/// Whether the pen never left its first position.
fn is_dot(stroke: &Stroke) -> bool {
    let place = |p: &StrokePoint| p.position.extend(p.depth);
    stroke.points.iter().all(|p| place(p) == place(&stroke.points[0]))
}

/// Bounding box; a side without extent takes the other's, so that the canvas has an area. The default without extent.
fn bounding_canvas(sketch: &Sketch) -> Canvas {
    let size = sketch.bounds().map_or(Vec2::ZERO, |(lo, hi)| hi - lo);
    if size == Vec2::ZERO {
        return Canvas::DEFAULT;
    }
    let side = |own: f32, other: f32| if own > 0.0 { own } else { other };
    Canvas { width: side(size.x, size.y), height: side(size.y, size.x) }
}
