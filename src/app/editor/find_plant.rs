//! The plant on the picture under the drawing is found, marked by the pen, and becomes crowns, trunk and colours.
//!
//! While the search is on, pen and mouse draw marks in place of strokes; fingers, the pen's other end and all other buttons do what they
//! always do. After every mark the plant is sought again on a thread of its own, and its outline shown over the picture. What was
//! found becomes strokes in one step to undo. While there are marks, undo takes the last of them back.
//!
//! Limits: marks are no part of the drawing; they go with the search.

use super::background::begin;
use super::parameters::without;
use super::photographs::{on_canvas, on_picture};
use super::plant_search::{Prepared, Searched};
use super::{Editor, background::Work};
use crate::app::action::Action;
use crate::app::messages::Localize as _;
use crate::app::panels::snapshot::Notice;
use crate::app::plant_search::PlantMark;
use crate::app::texture_cut::CutError;
use crate::app::theme::Palette;
use crate::pen::{PenEvent, PenPhase, PenTool};
use crate::photo::PhotoParams;
use crate::photo::plant::{
    PlantParams, PlantPicture, TRUNK_RADIUS, TrunkLine, tinted_textures, trunk_radius,
};
use crate::sketch::change::StrokeChange;
use crate::sketch::settings::Settings;
use crate::sketch::{Change, Reference, Sketch, Tool};
use egui::{Color32, Painter, Pos2, Shape, Stroke as Line};
use glam::{DVec2, Vec2};
use serde_json::{Map, Value};
use std::sync::Arc;

/// Least distance of the points of a mark, pixels of the screen.
const STEP: f64 = 3.0;

impl Editor {
    /// Actions about the plant on the picture under the drawing.
    pub(super) fn perform_on_plant_search(&mut self, action: Action) {
        match action {
            Action::FindPlant(true) => {
                if self.sketch().reference.as_ref().is_some_and(|reference| reference.visible) {
                    self.search.is_on = true;
                    self.seek_plant();
                }
            }
            Action::FindPlant(false) => self.search.stop(),
            Action::MarkPlant(mark) => self.search.mark = mark,
            Action::ClearPlantMarks => {
                self.search.clear();
                self.seek_plant();
            }
            Action::UseAsCrown => self.use_as_crown(),
            Action::ColoursFromPicture => self.take_colours(),
            Action::SnapToTrunk(stroke) => self.snap_to_trunk(stroke),
            other => return self.perform_on_plants(other),
        }
        self.updates.drawing_changed();
    }

    /// Handles a pointer before the canvas does; whether it marks the picture.
    pub(super) fn mark_plant(&mut self, event: &PenEvent) -> bool {
        let is_drawn = matches!(event.sample.tool, PenTool::Pen | PenTool::Mouse);
        let held = event.sample.buttons;
        let is_plain = is_drawn && !(held.secondary || held.middle || held.third);
        if !self.search.is_on || (self.search.line.is_none() && !is_plain) {
            return false;
        }
        let Some(reference) = self.sketch().reference.clone() else { return false };
        let at = self.canvas.view().to_canvas(event.sample.position).as_vec2();
        let place = on_picture(&reference, at);
        match (event.phase, &mut self.search.line) {
            (PenPhase::Down, None) => self.search.line = Some(vec![place]),
            (PenPhase::Move, Some(line)) => {
                let far = STEP / self.canvas.view().zoom() * f64::from(per_canvas(&reference));
                if line.last().is_none_or(|last| f64::from(last.distance(place)) >= far) {
                    line.push(place);
                }
            }
            (PenPhase::Up, Some(_)) => {
                if self.search.finish_line() {
                    self.seek_plant();
                }
            }
            (PenPhase::Cancel | PenPhase::Leave, Some(_)) => self.search.line = None,
            // Hovering shows the cursor of the canvas.
            (_, line) => return line.is_some(),
        }
        self.updates.drawing_changed();
        true
    }

    /// Seeks the plant with the marks as they are, as soon as the search before has ended.
    pub(super) fn seek_plant(&mut self) {
        let Some(reference) = self.sketch().reference.clone() else { return };
        if self.search.work.is_some() {
            self.search.is_stale = true;
            return;
        }
        self.search.is_stale = false;
        let hash = reference.picture.hash();
        let prepared = self.search.prepared_for(hash);
        let (marks, params) = (self.search.marks.clone(), PhotoParams::default().plant);
        let seek = move || -> Searched {
            let picture = ready(prepared, &reference, &params)?;
            let found = picture.find(&marks, &params);
            Ok((picture, found))
        };
        match begin("plant search", self.background.wake(), seek) {
            Ok(work) => self.search.work = Some((hash, work)),
            Err(error) => self.notify_error(&error),
        }
    }

    /// Takes what a search has found, and textures that have been painted.
    pub(super) fn collect_plant_search(&mut self) {
        self.collect_colours();
        self.collect_snapped();
        let Some(result) = self.search.work.as_ref().and_then(|(_, work)| work.result()) else { return };
        let Some((hash, _)) = self.search.work.take() else { return };
        self.updates.drawing_changed();
        if self.reference_hash() != Some(hash) {
            // Another picture came meanwhile.
            if self.search.is_on {
                self.seek_plant();
            }
            return;
        }
        match result {
            Some(Ok((picture, found))) => {
                self.search.prepared = Some(Prepared { hash, picture });
                if self.search.is_stale {
                    return self.seek_plant();
                }
                match found {
                    Ok(found) => {
                        let words =
                            |remark: &crate::photo::PhotoRemark| remark.localize(self.prefs.messages());
                        let remarks: Vec<String> = found.remarks.iter().map(words).collect();
                        self.search.found = Some((hash, Arc::new(found)));
                        remarks.into_iter().for_each(|remark| self.notify(Notice::warning(remark, "")));
                    }
                    Err(error) => {
                        self.search.found = None;
                        self.notify_error(&error);
                    }
                }
            }
            Some(Err(error)) => {
                self.search.stop();
                self.notify_error(&error);
            }
            None => self.search.stop(),
        }
    }

    /// The name of the content of the picture under the drawing.
    pub(super) fn reference_hash(&self) -> Option<u64> {
        self.sketch().reference.as_ref().map(|reference| reference.picture.hash())
    }

    /// Draws what was found: crowns and trunk, in one step.
    fn use_as_crown(&mut self) {
        let (Some((_, found)), Some(reference)) =
            (self.search.found.clone(), self.sketch().reference.clone())
        else {
            return;
        };
        let sketch = self.sketch();
        let strokes = found.strokes(self.drawing.next_id(), |place| on_canvas(&reference, place));
        let mut settings = Settings::default();
        if sketch.species.is_none() {
            settings.species = Some(Some(found.usual_species().to_owned()));
        }
        let has_wood =
            sketch.strokes.iter().any(|stroke| matches!(stroke.tool, Tool::Branch | Tool::SpaceBranch));
        if let Some(trunk) = found.trunk.as_ref().filter(|_| !has_wood) {
            // The same for all wood of a drawing, so only where this is the first.
            let all = sketch.strokes.iter().map(|stroke| &**stroke).chain(&strokes);
            let places = all.flat_map(|stroke| &stroke.points).map(|point| point.position);
            let (low, high) = crate::geom::polyline::bounds(places);
            settings.params = Some(with_thickness(sketch, trunk, &reference, (high - low).length()));
        }
        let strokes = strokes.into_iter().map(|stroke| StrokeChange::Put(Arc::new(stroke))).collect();
        self.search.stop();
        self.change(Change { strokes, settings });
    }

    /// Gives leaves and bark the colours of the plant that was found.
    fn take_colours(&mut self) {
        let (Some((_, found)), Some(species)) = (self.search.found.clone(), self.live.species().cloned())
        else {
            return;
        };
        let paint = move || tinted_textures(&species, &found.colours);
        match begin("plant colours", self.background.wake(), paint) {
            Ok(work) => self.search.painting = Some(work),
            Err(error) => self.notify_error(&error),
        }
    }

    fn collect_colours(&mut self) {
        let Some(painted) = self.search.painting.as_ref().and_then(Work::result) else { return };
        self.search.painting = None;
        match painted {
            Some(Ok(painted)) => {
                let mut textures = self.sketch().textures.clone();
                textures.extend(painted);
                self.change(Change::textures(textures));
            }
            Some(Err(error)) => self.notify_error(&error),
            None => {}
        }
    }

    /// Paints the outline that was found and the marks.
    pub(super) fn paint_plant_search(&self, painter: &Painter, palette: &Palette) {
        let Some(reference) = self.sketch().reference.as_ref().filter(|_| self.search.is_on) else { return };
        let scale = self.layout.pixels_per_point;
        let on_screen = |place: &Vec2| {
            let at: DVec2 = self.canvas.view().to_window(on_canvas(reference, *place).as_dvec2()) / scale;
            egui::pos2(at.x as f32, at.y as f32)
        };
        let points = |line: &[Vec2]| line.iter().map(on_screen).collect::<Vec<Pos2>>();
        // A light line in a dark one is seen on any picture.
        let double = |line: Vec<Pos2>, colour: Color32, is_closed: bool| {
            for (width, colour) in [(4.0, Color32::from_black_alpha(120)), (2.0, colour)] {
                let line = line.clone();
                let pen = Line::new(width, colour);
                painter.add(if is_closed { Shape::closed_line(line, pen) } else { Shape::line(line, pen) });
            }
        };
        if let Some((_, found)) = &self.search.found {
            for line in &found.crown {
                double(points(&line.points), palette.accent, true);
            }
            if let Some(trunk) = &found.trunk {
                double(points(&trunk.points), palette.branch[0], false);
            }
        }
        let marks = &self.search.marks;
        let mark = |line: &[Vec2], kind: PlantMark| {
            let (colour, is_closed) = match kind {
                PlantMark::Plant => (palette.good, false),
                PlantMark::Around => (palette.error, false),
                PlantMark::Outline => (palette.warning, true),
            };
            double(points(line), colour, is_closed);
        };
        marks.plant.iter().for_each(|line| mark(line, PlantMark::Plant));
        marks.around.iter().for_each(|line| mark(line, PlantMark::Around));
        marks.outline.iter().for_each(|line| mark(line, PlantMark::Outline));
        if let Some(line) = &self.search.line {
            double(points(line), palette.selection, false);
        }
    }
}

/// A picture made ready to find plants on it, anew where it is not yet.
pub(super) fn ready(
    prepared: Option<Arc<PlantPicture>>,
    reference: &Reference,
    params: &PlantParams,
) -> Result<Arc<PlantPicture>, CutError> {
    match prepared {
        Some(picture) => Ok(picture),
        None => Ok(Arc::new(PlantPicture::new(&reference.picture.pixels()?, params)?)),
    }
}

/// A drawing's parameters with wood as thick as a trunk on the picture, for strokes of this diagonal.
pub(super) fn with_thickness(
    sketch: &Sketch,
    trunk: &TrunkLine,
    reference: &Reference,
    diagonal: f32,
) -> Map<String, Value> {
    let mut params = without(&sketch.params, TRUNK_RADIUS);
    let width = trunk.usual_width() / per_canvas(reference);
    params.insert(TRUNK_RADIUS.to_owned(), trunk_radius(width, diagonal));
    params
}

/// How many pixels of the picture are one of the canvas.
pub(super) fn per_canvas(reference: &Reference) -> f32 {
    reference.picture.size_px().x as f32 / reference.width
}

#[cfg(test)]
#[path = "find_plant_tests.rs"]
mod tests;
