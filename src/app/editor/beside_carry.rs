//! A plant beside the drawn one that is carried along the ground in the 3D view.
//!
//! All plants of a drawing stand as far from the viewer, so it moves to the left and right of the drawing only, whichever
//! side it is seen from: to the place on the line through its foot that is nearest to the ray under the pointer.

use super::Editor;
use super::picking::place_of;
use crate::geom::ray::Ray;
use crate::model::pick::pick;
use glam::{DVec2, Vec3};

/// Least sine of the angle between that line and a ray: along the line it would run away.
const LEAST_SINE: f32 = 0.2;

impl Editor {
    /// Whether the selected plant is under a place in the window, physical pixels.
    pub(super) fn is_over_selected_plant(&self, at: DVec2) -> bool {
        let Some((selected, built)) = self.beside.selected().zip(self.built()) else { return false };
        let ray = self.plant.ray(self.plant.place(at));
        let picked = ray.and_then(|ray| pick(&built.model, &built.plant, &ray));
        picked.and_then(|picked| place_of(picked.element, &built.beside)) == Some(selected)
    }

    /// Moves what is held in the view of the plant by what it was carried: a control point, a part, its ring, or the selected plant.
    pub(super) fn carry(&mut self) {
        let Some((from, to)) = self.plant.take_carried() else { return };
        if self.petals.hold.is_some() {
            return self.drag_control_point(to);
        }
        if self.draw_loop(to) {
            return;
        }
        if self.posing.ring.is_some() {
            return self.drag_ring(to);
        }
        if self.posing.hold.is_some() {
            return self.drag_part(to);
        }
        let Some((place, by)) = self.carried_by(from, to) else { return };
        if let Some(mut plant) = self.sketch().plants.get(place).cloned() {
            plant.foot.x += by;
            self.set_plant(place, plant);
        }
    }

    /// The selected plant, and how far to the right it is carried between two places of the window, canvas pixels.
    fn carried_by(&self, from: DVec2, to: DVec2) -> Option<(usize, f32)> {
        let (place, built) = (self.beside.selected()?, self.built()?);
        let foot = built.beside.get(place)?.as_ref()?.foot;
        let along = |at: DVec2| nearest_along_x(foot, &self.plant.ray(self.plant.place(at))?);
        Some((place, (along(to)? - along(from)?) / built.provenance.world_from_canvas.scale))
    }
}

/// How far to the right of a point the line through it comes nearest to a ray; `None` where they run side by side.
fn nearest_along_x(point: Vec3, ray: &Ray) -> Option<f32> {
    let from_ray = point - ray.origin;
    let cosine = ray.direction.x;
    let sine_squared = 1.0 - cosine * cosine;
    let along = (cosine * ray.direction.dot(from_ray) - from_ray.x) / sine_squared;
    (sine_squared >= LEAST_SINE * LEAST_SINE).then_some(along)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_place_under_the_pointer_is_found_from_every_side() {
        let point = Vec3::new(0.5, 0.1, 0.0);
        for toward in [Vec3::NEG_Z, Vec3::new(0.5, -0.3, -1.0), Vec3::new(-0.6, 0.2, 1.0)] {
            let direction = toward.normalize();
            let origin = point + Vec3::X * 0.7 - direction * 5.0;
            let along = nearest_along_x(point, &Ray { origin, direction }).unwrap();
            assert!((along - 0.7).abs() < 1e-4, "{toward}: {along}");
        }
        let along_the_line = Ray { origin: Vec3::ZERO, direction: Vec3::X };
        assert_eq!(nearest_along_x(point, &along_the_line), None);
    }
}
