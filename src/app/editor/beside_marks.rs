//! The plants beside the drawn one as marks on the canvas: a line from foot to top where each of them stands.
//!
//! With the selection tool in hand they are taken hold of: the dot at the foot moves a plant, the square at its top makes
//! it taller. Near the height at which the drawn plant stands the foot stays there. One drag is one step to undo.

use super::Editor;
use super::beside::to_points;
use super::beside_state::Hold;
use crate::app::canvas_tool::CanvasTool;
use crate::app::theme::Palette;
use crate::pen::{PenEvent, PenPhase};
use crate::sketch::{PlacedPlant, Sketch};
use egui::{Painter, Rect, Stroke, StrokeKind, vec2};
use glam::{DVec2, Vec2};

/// Distance within which a mark is taken hold of, points.
const GRIP: f64 = 14.0;
/// Distance from the ground within which a foot stays on it, points.
const TO_GROUND: f64 = 8.0;
/// Half the length of the line on which a plant stands, points.
const TICK: f32 = 9.0;

/// Where a plant's marks are, physical pixels of the window.
struct Marks {
    foot: DVec2,
    top: Option<DVec2>,
}

impl Editor {
    fn marks(&self, place: usize) -> Option<Marks> {
        let plant = self.sketch().plants.get(place)?;
        let window = |p: Vec2| self.canvas.view().to_window(p.as_dvec2());
        let top = self.height_of_plant(place).map(|height| window(plant.foot - Vec2::Y * height));
        Some(Marks { foot: window(plant.foot), top })
    }

    /// Paints them: the selected one in the colour of what is selected, with what can be taken hold of.
    pub(super) fn paint_plants(&self, painter: &Painter, palette: &Palette) {
        let point = |at: DVec2| to_points(at, self.layout.pixels_per_point());
        for place in 0..self.sketch().plants.len() {
            let Some(Marks { foot, top }) = self.marks(place) else { continue };
            let is_selected = self.beside.selected() == Some(place);
            let colour = if is_selected { palette.accent } else { palette.ignored };
            let line = Stroke::new(1.5, colour);
            let foot = point(foot);
            painter.line_segment([foot - vec2(TICK, 0.0), foot + vec2(TICK, 0.0)], line);
            if let Some(top) = top.map(point) {
                painter.extend(egui::Shape::dashed_line(&[foot, top], line, 6.0, 5.0));
                if is_selected && self.canvas.tool() == CanvasTool::Select {
                    let square = Rect::from_center_size(top, vec2(12.0, 12.0));
                    painter.rect(square, 2.0, palette.panel, line, StrokeKind::Middle);
                }
            }
            let radius = if self.canvas.tool() == CanvasTool::Select { 7.0 } else { 3.0 };
            painter.circle(foot, radius, palette.panel, line);
        }
    }

    /// Shows the whole drawing with the plants beside it, where nothing is drawn the picture under it.
    pub(super) fn fit_all(&mut self) {
        let Sketch { plants, reference, .. } = self.sketch();
        let drawn = self.sketch().bounds();
        let picture = reference.as_ref().filter(|reference| reference.visible && drawn.is_none());
        if plants.is_empty() && picture.is_none() {
            return;
        }
        let places = plants.iter().enumerate().flat_map(|(place, plant)| {
            let top = self.height_of_plant(place).map(|height| plant.foot - Vec2::Y * height);
            [Some(plant.foot), top]
        });
        let drawn = drawn.or(picture.map(|picture| picture.bounds())).map(|(low, high)| [low, high]);
        let mut all = places.flatten().chain(drawn.into_iter().flatten());
        let Some(first) = all.next() else { return };
        let (low, high) = all.fold((first, first), |(low, high), p| (low.min(p), high.max(p)));
        let bounds = crate::app::canvas::Rect::new(low.as_dvec2(), high.as_dvec2());
        self.on_canvas(|canvas, _, out| canvas.fit(bounds, out));
    }

    /// Handles a pointer before the canvas does; whether it is at work on a plant.
    pub(super) fn hold_plant(&mut self, event: &PenEvent) -> bool {
        let at = event.sample.position;
        match (event.phase, self.beside.hold, self.beside.selected()) {
            (PenPhase::Down, None, _) => {
                let Some((place, hold)) = self.gripped(at) else { return false };
                self.beside.select(Some(place));
                self.beside.hold = Some(hold);
                true
            }
            (PenPhase::Move, Some(hold), Some(place)) => {
                if let Some(plant) = self.dragged(place, hold, at) {
                    self.set_plant(place, plant);
                }
                true
            }
            (PenPhase::Up | PenPhase::Cancel, Some(_), _) => {
                self.beside.hold = None;
                self.drawing.end_merging();
                true
            }
            (_, hold, _) => hold.is_some(),
        }
    }

    /// What of which plant is under the pointer, the selected one first.
    fn gripped(&self, at: DVec2) -> Option<(usize, Hold)> {
        if self.canvas.tool() != CanvasTool::Select {
            return None;
        }
        let reach = GRIP * self.layout.pixels_per_point();
        let pointer = self.canvas.view().to_canvas(at).as_vec2();
        let selected = self.beside.selected();
        let others = (0..self.sketch().plants.len()).filter(|place| Some(*place) != selected);
        selected.into_iter().chain(others).find_map(|place| {
            let (marks, plant) = (self.marks(place)?, self.sketch().plants.get(place)?);
            if marks.foot.distance(at) <= reach {
                return Some((place, Hold::Foot(plant.foot - pointer)));
            }
            let is_top = marks.top.is_some_and(|top| top.distance(at) <= reach) && selected == Some(place);
            let top = plant.foot.y - self.height_of_plant(place)?;
            is_top.then_some((place, Hold::Top(top - pointer.y)))
        })
    }

    /// What a plant becomes that is held and dragged there.
    fn dragged(&self, place: usize, hold: Hold, at: DVec2) -> Option<PlacedPlant> {
        let pointer = self.canvas.view().to_canvas(at).as_vec2();
        let mut plant = self.sketch().plants.get(place)?.clone();
        match hold {
            Hold::Foot(to_foot) => {
                plant.foot = pointer + to_foot;
                let near = TO_GROUND * self.layout.pixels_per_point() / self.canvas.view().zoom();
                if let Some(ground) = self.live.ground()
                    && f64::from((plant.foot.y - ground).abs()) <= near
                {
                    plant.foot.y = ground;
                }
            }
            Hold::Top(to_top) => plant.height = Some((plant.foot.y - pointer.y - to_top).max(1.0)),
        }
        Some(plant)
    }
}
