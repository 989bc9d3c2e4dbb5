//! What is painted over the plant of the parts that are chosen to be posed: the lines of branches with all that goes along with them, the
//! outlines of leaves and petals, and where the last part stands; and the loop that chooses some.

use super::Editor;
use super::beside::to_points;
use crate::app::theme::Palette;
use crate::modelling::OrganGroup;
use crate::plant::{FinishedPlant, Organ, Shape};
use crate::sketch::PartName;
use egui::Painter;
use glam::{Vec2, Vec3};
use std::collections::HashSet;
use std::f32::consts::TAU;

/// Most lines that are painted.
const MOST_LINES: usize = 500;
/// Pieces of a circle.
const PIECES: usize = 32;

impl Editor {
    /// Paints the parts that are chosen, where the last of them turns, and the loop that is drawn around some.
    pub(super) fn paint_chosen_parts(&self, painter: &Painter, palette: &Palette) {
        if !self.posing.is_on {
            return;
        }
        let scale = self.plant.pixels_per_point();
        let paint = |points: &[Vec3], width: f32| {
            let seen = points.iter().filter_map(|point| self.plant.seen_at(*point));
            let line = seen.map(|at| to_points(at, scale)).collect();
            painter.line(line, (width, palette.accent));
        };
        self.paint_chosen_branches(paint);
        for group in self.chosen_organs() {
            let Some(built) = self.built() else { return };
            outlines(&built.plant, &group).iter().for_each(|line| paint(line, 1.5));
        }
        let last = self.posing.last.and_then(|name| self.plant.seen_at(self.posable(name)?.base));
        if let Some(at) = last {
            painter.circle(to_points(at, scale), 5.0, palette.accent, (1.5, palette.panel));
        }
        if let Some(places) = &self.posing.choosing {
            let places = places.iter().map(|at| to_points(*at, scale)).collect();
            painter.line(places, (1.5, palette.accent));
        }
    }

    /// The leaves, flowers and other organs that are chosen, as many as are painted.
    fn chosen_organs(&self) -> Vec<OrganGroup> {
        let Some(built) = self.built() else { return Vec::new() };
        let chosen: HashSet<PartName> = self.chosen_parts().take(MOST_LINES).collect();
        if chosen.is_empty() {
            return Vec::new();
        }
        OrganGroup::all(&built.plant, &built.names, |name| chosen.contains(&name))
    }

    /// Paints the lines of the branches that are chosen, and thinner ones of what goes along with them.
    fn paint_chosen_branches(&self, paint: impl Fn(&[Vec3], f32)) {
        let Some(built) = self.built() else { return };
        let chosen: HashSet<PartName> = self.chosen_parts().collect();
        if chosen.is_empty() {
            return;
        }
        let branches = &built.plant.branches;
        let mut goes_along = vec![false; branches.len()];
        let mut painted = 0;
        for (index, branch) in branches.iter().enumerate() {
            let is_chosen = built.names.of(branch.origin).is_some_and(|name| chosen.contains(&name));
            goes_along[index] = is_chosen || branch.parent.is_some_and(|parent| goes_along[parent]);
            if !goes_along[index] || painted == MOST_LINES {
                continue;
            }
            painted += 1;
            paint(&branch.points, if is_chosen { 3.0 } else { 1.0 });
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
