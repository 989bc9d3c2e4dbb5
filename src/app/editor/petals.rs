//! Petals shaped in the view of the plant: a tap chooses a petal, its control points are dragged, and all petals of its flower
//! are shaped alike.
//!
//! A point follows the pointer in the plane through it that is parallel to the picture; its partner on the other side of the
//! petal goes the mirrored way, unless left and right are to differ or Alt is held. One drag is one step to undo. Of petals that
//! hide behind others, and of those that only copy them, the flower's first drawn one is chosen.
//!
//! Limits: petals in layers that a species makes have no control points, and say so when they are tapped.

use super::Editor;
use super::petal_tool::{ChosenPetal, PointHold, PointPlace};
use crate::app::action::Action;
use crate::app::messages::Msg;
use crate::app::panels::snapshot::{Notice, PetalPoint, PetalState};
use crate::depth::petal_shapes::PetalNet;
use crate::model::pick::Element;
use crate::pipeline::Built;
use crate::plant::{Blade, Organ, RestSurface, Shape};
use crate::sketch::petal_shapes::{Offsets, of_flowers, shaped};
use crate::sketch::{Change, PetalShape, StrokeId, limits};
use glam::{DVec2, Vec3};

impl Editor {
    /// Actions about the shape of petals.
    pub(super) fn perform_on_petals(&mut self, action: Action) {
        match action {
            Action::ShapePetals(on) => {
                self.lay_down_plant_tools();
                self.petals.is_on = on;
            }
            Action::MirrorPetals(on) => self.petals.is_lopsided = !on,
            Action::SetPetalPoint(offset) => {
                let Some((place, strokes)) = self.petals.point.zip(self.chosen_flower()) else { return };
                let before = self.offsets_of(&strokes);
                let by = offset - before[place.row][place.column];
                self.shape(strokes, with_point(before, place, by, !self.petals.is_lopsided));
            }
            Action::ResetPetals => {
                if let Some(strokes) = self.chosen_flower() {
                    self.drawing.end_merging();
                    self.shape(strokes, Offsets::default());
                    self.drawing.end_merging();
                }
            }
            other => self.perform_in_space(other),
        }
    }

    /// What the panel over the plant shows.
    pub(super) fn petal_state(&self) -> PetalState {
        let offsets = self.chosen_flower().map(|strokes| self.offsets_of(&strokes));
        let point = offsets.zip(self.petals.point).map(|(offsets, PointPlace { row, column })| PetalPoint {
            row,
            column,
            offset: offsets[row][column],
        });
        PetalState {
            any: self.built().is_some_and(|built| has_petals(built)),
            on: self.petals.is_on,
            mirrored: !self.petals.is_lopsided,
            chosen: offsets.is_some(),
            shaped: offsets.is_some_and(|offsets| offsets != Offsets::default()),
            point,
        }
    }

    /// Chooses the petal that was tapped, or none; says so where it cannot be shaped.
    pub(super) fn choose_petal(&mut self, tapped: Option<Element>) {
        self.petals.let_go();
        let Some((built, Element::Organ(organ))) = self.built().zip(tapped) else { return };
        let chosen = petal_of(built, organ);
        let is_of_flower = built.plant.organs[organ].flower.is_some();
        self.petals.chosen = chosen;
        if chosen.is_none() && is_of_flower {
            let what = self.prefs.messages().get(Msg::PetalsNone).to_owned();
            self.notify(Notice::info(what));
        }
    }

    /// The control points of the petal that is chosen, as it was built last.
    pub(super) fn petal_net(&self) -> Option<PetalNet> {
        let built = self.built().filter(|_| self.petals.is_on)?;
        let (_, organ) = organ_of(built, self.petals.chosen?)?;
        let Shape::Blade(blade) = &organ.shape else { return None };
        PetalNet::of(&built.plant.templates.resolve(blade))
    }

    /// Takes hold of the control point under a place in the window, physical pixels; whether there is one.
    pub(super) fn hold_control_point(&mut self, at: DVec2) -> bool {
        let held = self.petal_net().zip(self.control_point_at(at));
        let Some((net, place)) = held else { return false };
        let point = net.points[place.row][place.column];
        let Some((strokes, grip)) = self.chosen_flower().zip(self.plant.on_plane(point, at)) else {
            return false;
        };
        let (before, frame) = (self.offsets_of(&strokes), net.frame);
        // A plant that becomes larger under the pointer does not move away from it.
        self.plant.take_hold();
        self.petals.point = Some(place);
        self.petals.hold = Some(PointHold { place, strokes, before, frame, point, grip });
        true
    }

    /// Moves the control point that is held to a place in the window.
    pub(super) fn drag_control_point(&mut self, to: DVec2) {
        let Some(hold) = self.petals.hold.clone() else { return };
        let Some(now) = self.plant.on_plane(hold.point, to) else { return };
        let by = hold.frame.offset(now - hold.grip);
        let mirrored = !self.petals.is_lopsided && !self.petals.alt;
        self.shape(hold.strokes, with_point(hold.before, hold.place, by, mirrored));
    }

    /// The strokes of the flower whose petal is chosen.
    fn chosen_flower(&self) -> Option<Vec<StrokeId>> {
        let built = self.built().filter(|_| self.petals.is_on)?;
        let (_, organ) = organ_of(built, self.petals.chosen?)?;
        let members = built.plant.organs.iter().filter(|other| other.flower == organ.flower);
        Some(members.filter_map(|member| built.provenance.stroke(member.origin)).collect())
    }

    /// How far the control points of the flower are moved that these strokes drew.
    fn offsets_of(&self, strokes: &[StrokeId]) -> Offsets {
        let shape = of_flowers(&self.sketch().petal_shapes, &[strokes.to_vec()]);
        shape.first().copied().flatten().map_or(Offsets::default(), |shape| shape.offsets)
    }

    /// Shapes the flower of these strokes; one drag is one step.
    fn shape(&mut self, strokes: Vec<StrokeId>, offsets: Offsets) {
        let sketch = self.sketch();
        let there = sketch.strokes.iter().map(|stroke| stroke.id);
        let shapes = shaped(&sketch.petal_shapes, PetalShape::new(strokes, offsets), there);
        self.change_merging(Change::petal_shapes(shapes), "petal shapes");
    }
}

/// The offsets with one point moved on, and if `mirrored` its partner on the other side the mirrored way.
fn with_point(mut offsets: Offsets, place: PointPlace, by: Vec3, mirrored: bool) -> Offsets {
    let most = Vec3::splat(limits::MAX_PETAL_OFFSET);
    let PointPlace { row, column } = place;
    let mut move_on = |column: usize, by: Vec3| {
        let offset = &mut offsets[row][column];
        *offset = (*offset + by).clamp(-most, most);
    };
    move_on(column, by);
    if mirrored {
        move_on(3 - column, by * Vec3::new(-1.0, 1.0, 1.0));
    }
    offsets
}

/// Whether a plant has petals that somebody drew and that can be shaped.
fn has_petals(built: &Built) -> bool {
    !built.anatomy.flowers.is_empty() && (0..built.plant.organs.len()).any(|i| is_shapable(built, i))
}

/// Whether an organ is a petal with control points that somebody drew.
fn is_shapable(built: &Built, organ: usize) -> bool {
    let organ = &built.plant.organs[organ];
    let is_curved = matches!(
        &organ.shape,
        Shape::Blade(Blade { rest: RestSurface::Cone { .. } | RestSurface::Shaped { .. }, .. })
    );
    is_curved && organ.flower.is_some() && organ.origin.is_drawn()
}

/// The petal to choose for an organ: itself, or the first drawn one of its flower.
fn petal_of(built: &Built, organ: usize) -> Option<ChosenPetal> {
    let organs = &built.plant.organs;
    let flower = organs[organ].flower?;
    let of_flower = |i: &usize| organs[*i].flower == Some(flower) && is_shapable(built, *i);
    let chosen = if is_shapable(built, organ) { organ } else { (0..organs.len()).find(of_flower)? };
    let stroke = built.provenance.stroke(organs[chosen].origin)?;
    let before = (0..chosen)
        .filter(|i| is_shapable(built, *i) && built.provenance.stroke(organs[*i].origin) == Some(stroke));
    Some(ChosenPetal { stroke, number: before.count() })
}

/// The organ that a chosen petal is now, with its place.
fn organ_of(built: &Built, chosen: ChosenPetal) -> Option<(usize, &Organ)> {
    let drawn = built.plant.organs.iter().enumerate().filter(|(i, organ)| {
        is_shapable(built, *i) && built.provenance.stroke(organ.origin) == Some(chosen.stroke)
    });
    drawn.into_iter().nth(chosen.number)
}

#[cfg(test)]
#[path = "petals_tests.rs"]
mod tests;
