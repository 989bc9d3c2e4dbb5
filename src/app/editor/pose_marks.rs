//! What is painted over the plant of the part that is chosen to be posed: the line of a branch with all that goes along with it, the
//! outlines of leaves and petals, and where the part stands.

use super::Editor;
use super::beside::to_points;
use super::posable::{Part, Posable};
use crate::app::theme::Palette;
use crate::modelling::OrganGroup;
use crate::plant::{FinishedPlant, Organ, Shape};
use egui::Painter;
use glam::{Vec2, Vec3};
use std::f32::consts::TAU;

/// Most lines that are painted.
const MOST_LINES: usize = 500;
/// Pieces of a circle.
const PIECES: usize = 32;

impl Editor {
    /// Paints the part that is chosen, and where it turns.
    pub(super) fn paint_chosen_part(&self, painter: &Painter, palette: &Palette) {
        let chosen = self.posing.last.filter(|_| self.posing.is_on);
        let Some((built, Posable { base, part, .. })) =
            self.built().zip(chosen.and_then(|name| self.posable(name)))
        else {
            return;
        };
        let paint = |points: &[Vec3], width: f32| {
            let seen = points.iter().filter_map(|point| self.plant.seen_at(*point));
            let line = seen.map(|at| to_points(at, self.plant.pixels_per_point())).collect();
            painter.line(line, (width, palette.accent));
        };
        match part {
            Part::Organs(group) => outlines(&built.plant, &group).iter().for_each(|line| paint(line, 1.5)),
            Part::Branch(_) => self.paint_chosen_branch(paint),
        }
        if let Some(at) = self.plant.seen_at(base) {
            let at = to_points(at, self.plant.pixels_per_point());
            painter.circle(at, 5.0, palette.accent, (1.5, palette.panel));
        }
    }

    /// Paints the line of the branch that is chosen, and thinner ones of what goes along with it.
    fn paint_chosen_branch(&self, paint: impl Fn(&[Vec3], f32)) {
        let Some((built, chosen)) = self.built().zip(self.chosen_branch()) else { return };
        let branches = &built.plant.branches;
        let mut goes_along = vec![false; branches.len()];
        goes_along[chosen] = true;
        let mut painted = 0;
        for (index, branch) in branches.iter().enumerate().skip(chosen) {
            goes_along[index] |= branch.parent.is_some_and(|parent| goes_along[parent]);
            if !goes_along[index] || painted == MOST_LINES {
                continue;
            }
            painted += 1;
            paint(&branch.points, if index == chosen { 3.0 } else { 1.0 });
        }
    }
}

/// The lines around the organs of a group, in space.
fn outlines(plant: &FinishedPlant, group: &OrganGroup) -> Vec<Vec<Vec3>> {
    let is_blade = |organ: &&usize| matches!(plant.organs[**organ].shape, Shape::Blade(_));
    let has_blades = group.organs.iter().any(|organ| is_blade(&organ));
    // The stamens of a flower would hide it.
    let organs = group.organs.iter().filter(|organ| !has_blades || is_blade(organ)).take(MOST_LINES);
    let mut lines: Vec<Vec<Vec3>> =
        organs.filter_map(|organ| outline(plant, &plant.organs[*organ])).collect();
    lines.extend(group.stalk.map(|stalk| plant.branches[stalk].points.clone()));
    lines
}

/// The line around an organ: that of a blade, or the widest circle of a body.
fn outline(plant: &FinishedPlant, organ: &Organ) -> Option<Vec<Vec3>> {
    let circle = |middle: Vec3, axis: Vec3, radius: f32| {
        let (u, v) = axis.any_orthonormal_pair();
        let at = |k: usize| {
            let (sin, cos) = (TAU * k as f32 / PIECES as f32).sin_cos();
            middle + (u * cos + v * sin) * radius
        };
        (0..=PIECES).map(at).collect()
    };
    match &organ.shape {
        Shape::Blade(blade) => {
            let blade = plant.templates.resolve(blade);
            let outline = blade.template.outline();
            Some(outline.iter().chain(outline.first()).map(|uv: &Vec2| blade.at_rest(*uv)).collect())
        }
        Shape::Dome { base, axis, radius, .. } => Some(circle(*base, *axis, *radius)),
        Shape::Lathe { base, axis, profile } => {
            let widest = profile.iter().max_by(|a, b| a.x.total_cmp(&b.x))?;
            Some(circle(*base + *axis * widest.y, *axis, widest.x))
        }
        Shape::Filament { points, .. } => Some(points.clone()),
        Shape::Card { base, u, v, .. } => {
            let corners = [-0.5, 0.5].map(|share| *base + *u * share);
            Some(vec![corners[0], corners[1], corners[1] + *v, corners[0] + *v, corners[0]])
        }
        Shape::Spike { base, tip, .. } => Some(vec![*base, *tip]),
    }
}
