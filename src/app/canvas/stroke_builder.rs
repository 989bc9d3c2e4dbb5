//! The growing stroke: every raw sample of the pen becomes a point, the moment it comes.
//!
//! The stabiliser smooths without lag. Every point is the weighted mean of the samples around it, as many after it as
//! before it, with weights that fall off evenly (a triangle); near either end of the stroke the window shrinks to what is
//! there. So the first and the last point are the samples themselves: the line is always under the pen and ends where it
//! was lifted, while what lies further back grows calm. A straight line stays on its line, since means of its points lie
//! on it. Only the last [`Stabiliser::reach`] points still change; all before are final. Means run over samples, not
//! over time: events of one batch carry one time.
//!
//! White jitter across the line shrinks to about `sqrt(2 / (3 (reach + 1)))` of itself: 0.4 light, 0.2 strong. Corners are
//! rounded over as many samples; pressure is left as it is, since it is meaning.

use super::view::CanvasView;
use crate::app::stabiliser::Stabiliser;
use crate::pen::{PenSample, PenTool, PressureCurve};
use crate::sketch::{Stroke, StrokeId, StrokePoint, Tool, limits};
use glam::{DVec2, Vec2};
use std::sync::Arc;

/// A stroke under the pen.
#[derive(Clone, Debug)]
pub struct StrokeBuilder {
    id: StrokeId,
    tool: Tool,
    stabiliser: Stabiliser,
    curve: PressureCurve,
    began_ms: f64,
    raw: Vec<DVec2>,
    points: Vec<StrokePoint>,
}

impl StrokeBuilder {
    /// Begins a stroke with the sample that touched; `None` where that lies off the largest canvas.
    pub fn begin(
        id: StrokeId,
        tool: Tool,
        sample: &PenSample,
        view: &CanvasView,
        (stabiliser, curve): (Stabiliser, PressureCurve),
    ) -> Option<Self> {
        let began_ms = sample.time_ms;
        let mut stroke = Self { id, tool, stabiliser, curve, began_ms, raw: Vec::new(), points: Vec::new() };
        stroke.push(sample, view)?;
        Some(stroke)
    }

    /// Adds a sample and gives the first point that is new or has moved; `None` where the sample lies off the largest
    /// canvas and was dropped.
    pub fn push(&mut self, sample: &PenSample, view: &CanvasView) -> Option<usize> {
        let pressure = match sample.tool {
            PenTool::Pen | PenTool::Eraser => self.curve.apply(sample.pressure),
            PenTool::Finger(_) | PenTool::Mouse => sample.pressure,
        };
        self.add(sample, view, pressure)
    }

    /// Takes where the pen was lifted: a point of its own where that differs from the last, with the last pressure, since
    /// a lifted pen has none. Gives the first point that is new or has moved.
    pub fn lift(&mut self, sample: &PenSample, view: &CanvasView) -> Option<usize> {
        let last = self.points.last()?;
        if view.to_canvas(sample.position).as_vec2() == last.position {
            return None;
        }
        self.add(sample, view, last.pressure)
    }

    fn add(&mut self, sample: &PenSample, view: &CanvasView, pressure: f32) -> Option<usize> {
        let place = view.to_canvas(sample.position);
        // Written so that a place that is no number fails too.
        let is_on_canvas = place.abs().max_element() <= f64::from(limits::MAX_COORDINATE);
        if !place.is_finite() || !is_on_canvas || pressure.is_nan() {
            return None;
        }
        let last_ms = self.points.last().map_or(0.0, |p| p.time_ms);
        let time_ms = ((sample.time_ms - self.began_ms) as f32).clamp(0.0, limits::MAX_TIME_MS).max(last_ms);
        self.raw.push(place);
        self.points.push(StrokePoint {
            position: place.as_vec2(),
            pressure: pressure.clamp(0.0, 1.0),
            tilt_deg: tilt_on_canvas(sample.tilt_deg, view.rotation_rad()),
            time_ms: if time_ms.is_nan() { last_ms } else { time_ms },
            depth: 0.0,
        });
        let first = (self.raw.len() - 1).saturating_sub(self.stabiliser.reach());
        for i in first..self.raw.len() {
            self.points[i].position = self.smoothed(i);
        }
        Some(first)
    }

    /// The mean of the samples around the one at `i`.
    fn smoothed(&self, i: usize) -> Vec2 {
        let reach = self.stabiliser.reach().min(i).min(self.raw.len() - 1 - i);
        let mut sum = self.raw[i] * (reach + 1) as f64;
        for k in 1..=reach {
            sum += (self.raw[i - k] + self.raw[i + k]) * (reach + 1 - k) as f64;
        }
        (sum / ((reach + 1) * (reach + 1)) as f64).as_vec2()
    }

    /// Name of the stroke.
    pub fn id(&self) -> StrokeId {
        self.id
    }

    /// What it is drawn as.
    pub fn tool(&self) -> Tool {
        self.tool
    }

    /// The points so far; never empty. The last is the last sample.
    pub fn points(&self) -> &[StrokePoint] {
        &self.points
    }

    /// Points that will not change any more, from the first.
    pub fn settled(&self) -> usize {
        self.points.len().saturating_sub(self.stabiliser.reach())
    }

    /// The finished stroke.
    pub fn finish(self) -> Arc<Stroke> {
        Arc::new(Stroke { id: self.id, tool: self.tool, points: self.points, brush: None })
    }
}

/// The tilt as it is to the drawing, where the canvas is turned under the pen: the pen leans the same way in the room.
fn tilt_on_canvas(tilt_deg: Vec2, rotation_rad: f64) -> Vec2 {
    const STEEPEST_DEG: f32 = 89.9;
    let steepest = Vec2::splat(STEEPEST_DEG);
    let sound = if tilt_deg.is_nan() { Vec2::ZERO } else { tilt_deg };
    if rotation_rad == 0.0 {
        let most = Vec2::splat(limits::MAX_TILT_DEG);
        return sound.clamp(-most, most);
    }
    let slope = sound.clamp(-steepest, steepest).map(|d| d.to_radians().tan());
    Vec2::from_angle(-rotation_rad as f32).rotate(slope).map(|s| s.atan().to_degrees())
}

#[cfg(test)]
#[path = "stroke_builder_tests.rs"]
mod tests;
