//! The garden around the plant (004 §3.3), painted with the pen on the ground in the view of the plant: beds, paths, single plants.
//!
//! The view from above is the plan; any other works as well, as long as the ground is seen. A stroke paints, a tap plants one. What is
//! painted grows under the pen. Each stroke is one step to undo.
//!
//! Limits: the ground is level, and near the horizon nothing is painted.

use super::Editor;
use super::beside::age_of;
use super::drawing_surface::DrawingSurface;
use crate::app::action::Action;
use crate::app::garden_brush::GardenBrush;
use crate::app::panels::snapshot::GardenState;
use crate::garden::painted::{self, simplified};
use crate::pen::{PenPhase, PenSample, PenTool};
use crate::sketch::{Change, GardenPlant, GardenPoint, GardenStroke, GardenStrokes};
use crate::species::Species;
use glam::{DVec2, Vec2, Vec3, Vec3Swizzles as _};
use std::sync::Arc;

/// Farthest from the eye that is painted, in distances of what is looked at.
const FARTHEST: f32 = 6.0;
/// What is planted first where nothing is drawn.
const AT_FIRST: &str = "rose";

impl Editor {
    /// Actions about the garden.
    pub(super) fn perform_on_garden(&mut self, action: Action) {
        match action {
            Action::PaintGarden(on) => {
                self.lay_down_plant_tools();
                self.garden.is_on = on;
                if on {
                    self.show_garden();
                }
            }
            Action::SetGardenBrush(brush) => {
                if brush.radius != self.garden.brush.radius {
                    self.garden.is_set = brush.radius != self.usual_garden_radius();
                }
                self.garden.brush = brush;
            }
            other => self.perform_on_brushes(other),
        }
    }

    /// Looks at the garden from above, with a brush as usual where the artist has not set it.
    fn show_garden(&mut self) {
        if !self.garden.is_set {
            self.garden.brush.radius = self.usual_garden_radius();
        }
        // Where nothing is drawn there is nothing to be copied.
        if self.built().is_none_or(|built| built.model.parts.is_empty()) {
            let plant = &mut self.garden.brush.plant;
            if *plant == GardenPlant::Drawn {
                *plant = GardenPlant::species(AT_FIRST);
            }
        }
        self.garden.is_shown = true;
        let around = self.built().and_then(|built| built.garden.as_ref()?.bounds());
        self.plant.show_ground(around);
    }

    /// A drawing that was opened with a garden is seen from above at first.
    pub(super) fn show_opened_garden(&mut self) {
        if !self.garden.is_shown && self.built().is_some_and(|built| built.garden.is_some()) {
            self.show_garden();
        }
    }

    /// The radius of a brush that is as wide as two of the drawn plants.
    fn usual_garden_radius(&self) -> f32 {
        let (least, most) = GardenBrush::RADII;
        let is_drawn = self.built().is_some_and(|built| !built.model.parts.is_empty());
        let bounds = self.plant.bounds().filter(|_| is_drawn);
        let width = bounds.map(|(low, high)| (high - low).xz().max_element());
        // Two digits are enough, and read well.
        width.map_or(GardenBrush::default().radius, |width| (width * 20.0).round() / 20.0).clamp(least, most)
    }

    /// What the bar below the plant shows.
    pub(super) fn garden_state(&self) -> GardenState {
        let plants = self.built().and_then(|built| Some(built.garden.as_ref()?.places.len()));
        let (usual_radius, brush) = (self.usual_garden_radius(), self.garden.brush.clone());
        let age = match &brush.plant {
            GardenPlant::Species { name, age } if Species::growing().contains(&name.as_str()) => {
                Some(age_of(name, *age))
            }
            _ => None,
        };
        let (any, on, drawings) = (self.built().is_some(), self.garden.is_on, self.garden_drawings());
        GardenState { any, on, brush, usual_radius, age, drawings, plants }
    }

    /// The garden as it is drawn now, with what is under the pen.
    pub(super) fn garden_now(&self) -> GardenStrokes {
        let drawn = &self.sketch().garden;
        match &self.garden.stroke {
            None => drawn.clone(),
            Some(stroke) => drawn.iter().cloned().chain([finished(stroke)]).collect(),
        }
    }

    /// Begins a stroke at a place in the window, physical pixels; whether the ground is seen there.
    pub(super) fn begin_in_garden(&mut self, sample: &PenSample) -> bool {
        let buttons = sample.buttons;
        let moves_camera = buttons.secondary || buttons.middle || self.canvas.is_shift_held();
        if !self.garden.is_on || moves_camera {
            return false;
        }
        let Some(point) = self.garden_point(sample, self.pressed(sample)) else { return false };
        self.plant.take_hold();
        let GardenBrush { radius, density, .. } = self.garden.brush;
        let Some(tool) = self.garden.brush.tool().filter(|_| sample.tool != PenTool::Eraser) else {
            self.garden.erases = Some(point.at);
            return true;
        };
        self.garden.stroke = Some(GardenStroke { tool, radius, density, points: vec![point] });
        self.live.set_stale();
        true
    }

    /// Follows what the pen paints on the ground.
    pub(super) fn paint_garden(&mut self, phase: PenPhase, sample: &PenSample) {
        match phase {
            PenPhase::Move => {
                let Some(point) = self.garden_point(sample, self.pressed(sample)) else { return };
                if let Some(stroke) = &mut self.garden.stroke {
                    stroke.points.push(point);
                    self.live.set_stale();
                }
            }
            PenPhase::Up => {
                self.end_in_garden();
                // Fingers hover nowhere.
                let hovers = !matches!(sample.tool, PenTool::Finger(_));
                self.hover_garden(hovers.then_some(sample.position));
            }
            PenPhase::Cancel => {
                self.garden.drop_stroke();
                self.live.set_stale();
            }
            _ => {}
        }
    }

    /// The pen is lifted: the stroke counts.
    pub(super) fn end_in_garden(&mut self) {
        if let Some(at) = self.garden.erases.take() {
            self.erase_in_garden(at);
        }
        let Some(stroke) = self.garden.stroke.take() else { return };
        let garden = self.sketch().garden.iter().cloned().chain([finished(&stroke)]).collect();
        self.change(Change::garden(garden));
        self.live.set_stale();
    }

    /// Takes away the stroke that is seen at a place on the ground.
    fn erase_in_garden(&mut self, at: Vec2) {
        let garden = &self.sketch().garden;
        let Some(seen) = painted::stroke_at(garden, at) else { return };
        let rest = garden.iter().enumerate().filter(|(place, _)| *place != seen);
        let garden = rest.map(|(_, stroke)| Arc::clone(stroke)).collect();
        self.change(Change::garden(garden));
        self.live.set_stale();
    }

    /// The place on the ground under a place in the window, pressed so much.
    fn garden_point(&self, sample: &PenSample, pressure: f32) -> Option<GardenPoint> {
        let at = self.ground_under(sample.position)?;
        Some(GardenPoint { at: at.xz(), pressure: pressure.clamp(0.0, 1.0) })
    }

    /// Where the ground is seen at a place in the window, physical pixels; none near the horizon.
    pub(super) fn ground_under(&self, at: DVec2) -> Option<Vec3> {
        let ray = self.plant.ray(self.plant.place(at))?;
        let met = DrawingSurface::Plane { through: Vec3::ZERO, normal: Vec3::Y }.met_by(&ray)?;
        let camera = self.plant.camera();
        let is_near = met.distance(camera.target) <= FARTHEST * camera.height().max(camera.distance);
        (ray.direction.y < 0.0 && is_near).then_some(met)
    }

    /// Notes where the pointer hovers over the plant, physical pixels of the window; none elsewhere.
    pub(super) fn hover_garden(&mut self, at: Option<DVec2>) {
        self.garden.hovered = at.filter(|_| self.garden.is_on && !self.garden.is_busy());
    }
}

/// A stroke as the drawing keeps it; under the pen it is the same, so that nothing moves when the pen is lifted.
fn finished(stroke: &GardenStroke) -> Arc<GardenStroke> {
    let points = simplified(&stroke.points, stroke.radius);
    Arc::new(GardenStroke { points, tool: stroke.tool.clone(), ..*stroke })
}

#[cfg(test)]
#[path = "garden_tests.rs"]
mod tests;
