//! The live camera of somebody who stands on the ground: it looks around from where it is, goes ahead and aside, and follows a line.
//!
//! It is an [`OrbitCamera`] whose target is a metre in front of the eye, with a wider view than that of a plant in a studio, and with lamps
//! that stand still while it turns. The ground is the plane y = 0; places on it are x and z, metres. Drags are given in shares of the view's
//! height, y down, and what is seen follows the pointer.
//!
//! Limits: the ground is level, and nothing stands in the way.

use super::{OrbitCamera, Projection};
use crate::geom::polyline;
use glam::{Vec2, Vec3, Vec3Swizzles as _};

/// Vertical opening of the view, degrees.
const FIELD_OF_VIEW_DEG: f32 = 58.0;
/// Height of the eye of a person, metres; among lower plants it is lower, down to the second number.
const EYE_HEIGHTS: (f32, f32) = (1.6, 0.12);
/// How much higher than the highest plant the eye is there.
const OVER_PLANTS: f32 = 1.25;
/// Farthest that one looks up or down, degrees.
const STEEPEST: f32 = 85.0;
/// Heights that the eye may be given, metres.
const HEIGHTS: std::ops::RangeInclusive<f32> = 0.02..=100.0;
/// Farthest from the plant, metres.
const FARTHEST: f32 = 1000.0;
/// How far ahead on a line one looks, in heights of the eye; and how far down at first, degrees.
const LOOKS_AHEAD: f32 = 2.0;
const LOOKS_DOWN: f32 = 12.0;

/// How high the eye is among plants of which the highest reaches up to so many metres.
pub fn eye_height(highest: f32) -> f32 {
    (OVER_PLANTS * highest).min(EYE_HEIGHTS.0).max(EYE_HEIGHTS.1)
}

impl OrbitCamera {
    /// The camera of somebody who stands at a place of the ground and looks to another; the lamps stand as for a viewer who is turned
    /// by `lamps_yaw_deg`.
    pub fn at_eye(at: Vec2, eye_height: f32, looks_to: Vec2, lamps_yaw_deg: f32) -> Self {
        let back = (at - looks_to).try_normalize().unwrap_or(Vec2::Y);
        let camera = Self {
            target: Vec3::ZERO,
            yaw_deg: back.x.atan2(back.y).to_degrees(),
            pitch_deg: LOOKS_DOWN,
            distance: 1.0,
            projection: Projection::Perspective,
            field_of_view_deg: FIELD_OF_VIEW_DEG,
            lamps_yaw_deg: Some(lamps_yaw_deg),
        };
        camera.with_eye(Vec3::new(at.x, eye_height, at.y))
    }

    /// Turns the eye where it is.
    pub fn look_around(&mut self, drag: Vec2) {
        let (eye, opening) = (self.eye(), self.field_of_view_deg);
        self.turn_in_place(drag.x * opening);
        self.pitch_deg = (self.pitch_deg - drag.y * opening).clamp(-STEEPEST, STEEPEST);
        *self = self.with_eye(eye);
    }

    /// Goes so many metres ahead and to the right, at the same height.
    pub fn go(&mut self, ahead: f32, aside: f32) {
        let axes = self.axes();
        let (right, ahead_of) = (axes.right, Vec3::Y.cross(axes.right));
        let eye = self.eye() + right * aside + ahead_of * ahead;
        let limit = Vec3::new(FARTHEST, f32::MAX, FARTHEST);
        *self = self.with_eye(eye.clamp(-limit, limit));
    }

    /// Makes the eye stand so many times as high.
    pub fn rise(&mut self, factor: f32) {
        let eye = self.eye();
        *self = self.with_eye(eye.with_y((eye.y * factor).clamp(*HEIGHTS.start(), *HEIGHTS.end())));
    }

    /// The same, standing near a place on the ground: a height of the eye before it, or half of the way where it is nearer than that.
    pub fn near(&self, place: Vec2) -> Self {
        let eye = self.eye();
        let way = place - eye.xz();
        let rest = eye.y.min(way.length() / 2.0);
        let to = place - way.normalize_or_zero() * rest;
        self.with_eye(Vec3::new(to.x, eye.y, to.y))
    }

    /// Where the ground is at a place of the view: shares of its height from its centre, y down; `None` at the sky.
    pub fn ground_at(&self, at: Vec2) -> Option<Vec2> {
        let ray = self.ray(at, (Vec3::ZERO, Vec3::ZERO));
        let along = -ray.origin.y / ray.direction.y;
        (along.is_finite() && along > 0.0 && along < FARTHEST).then(|| ray.at(along).xz())
    }

    fn with_eye(mut self, eye: Vec3) -> Self {
        self.target = eye - self.axes().back * self.distance;
        self
    }
}

/// The cameras of a walk along a line over ground of these heights, evenly from its one end to the other; none for a line without
/// length.
pub fn along(line: &[Vec2], count: usize, eye_height: f32, ground: impl Fn(Vec2) -> f32) -> Vec<OrbitCamera> {
    let length = polyline::length(line);
    let Some([before, end]) = line.last_chunk().filter(|_| length > 0.0 && length.is_finite()) else {
        return Vec::new();
    };
    let ahead = LOOKS_AHEAD * eye_height;
    // At the end of the line one looks straight on.
    let on = *end + (*end - *before).normalize_or(Vec2::NEG_Y) * ahead;
    let line: Vec<Vec2> = line.iter().copied().chain([on]).collect();
    let arcs = polyline::arc_lengths(line.iter().copied());
    let place = |arc: f32| polyline::interpolate(&line, polyline::locate(&arcs, arc));
    let way = length / count.max(2).saturating_sub(1) as f32;
    let camera = |i: usize| {
        let gone = i as f32 * way;
        let at = place(gone);
        OrbitCamera::at_eye(at, ground(at) + eye_height, place(gone + ahead), 0.0)
    };
    (0..count).map(camera).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: Vec3, b: Vec3) -> bool {
        a.distance(b) < 1e-4
    }

    fn camera() -> OrbitCamera {
        OrbitCamera::at_eye(Vec2::new(1.0, 2.0), 1.5, Vec2::new(1.0, -3.0), 30.0)
    }

    #[test]
    fn looking_around_leaves_the_eye_where_it_is() {
        let mut camera = camera();
        let eye = Vec3::new(1.0, 1.5, 2.0);
        assert!(near(camera.eye(), eye) && camera.yaw_deg.abs() < 1e-3);
        let lamps = camera.level_axes().back;
        camera.look_around(Vec2::new(0.4, 0.3));
        assert!(near(camera.eye(), eye) && camera.yaw_deg > 0.0);
        assert_eq!(camera.level_axes().back, lamps, "shadows stay");
        camera.look_around(Vec2::new(0.0, 50.0));
        assert!(near(camera.eye(), eye) && camera.pitch_deg >= -90.0);
    }

    #[test]
    fn what_is_dragged_follows_the_pointer() {
        let (mut camera, seen) = (camera(), Vec3::new(1.2, 1.0, -4.0));
        let before = camera.project(seen).unwrap();
        camera.look_around(Vec2::new(0.1, 0.05));
        let after = camera.project(seen).unwrap() - before;
        assert!((after.x - 0.1).abs() < 0.02 && (after.y - 0.05).abs() < 0.02, "{after}");
    }

    #[test]
    fn one_goes_ahead_and_aside_over_level_ground() {
        let mut camera = camera();
        camera.go(2.0, 0.5);
        assert!(near(camera.eye(), Vec3::new(1.5, 1.5, 0.0)));
        camera.look_around(Vec2::new(90.0 / FIELD_OF_VIEW_DEG, 0.9));
        camera.go(1.0, 0.0);
        assert!(near(camera.eye(), Vec3::new(0.5, 1.5, 0.0)), "{}", camera.eye());
        camera.rise(1e9);
        assert!(near(camera.eye(), Vec3::new(0.5, *HEIGHTS.end(), 0.0)));
    }

    #[test]
    fn a_place_that_is_pointed_at_is_gone_to() {
        let camera = camera();
        let place = camera.ground_at(Vec2::new(0.1, 0.3)).unwrap();
        let seen = camera.project(Vec3::new(place.x, 0.0, place.y)).unwrap();
        assert!(seen.distance(Vec2::new(0.1, 0.3)) < 1e-4);
        let there = camera.near(place);
        assert!(there.eye().xz().distance(place) < 1.5 + 1e-4 && there.yaw_deg == camera.yaw_deg);
        assert_eq!(camera.ground_at(Vec2::new(0.0, -0.4)), None, "the sky");
        assert!(near(camera.near(camera.eye().xz()).eye(), camera.eye()));
    }

    #[test]
    fn a_walk_goes_from_one_end_of_its_line_to_the_other() {
        let line = [Vec2::new(0.0, 4.0), Vec2::ZERO, Vec2::new(6.0, 0.0)];
        let walk = along(&line, 11, 0.5, |_| 0.0);
        assert_eq!(walk.len(), 11);
        let eyes: Vec<Vec3> = walk.iter().map(OrbitCamera::eye).collect();
        assert!(near(eyes[0], Vec3::new(0.0, 0.5, 4.0)) && near(eyes[10], Vec3::new(6.0, 0.5, 0.0)));
        assert!(eyes.windows(2).all(|w| w[0].distance(w[1]) < 1.001));
        assert!((walk[10].yaw_deg + 90.0).abs() < 1e-3, "it looks along the line at its end");
        for nowhere in [&line[..0], &line[..1], &[Vec2::ONE; 3][..]] {
            assert!(along(nowhere, 4, 1.0, |_| 0.0).is_empty());
        }
        assert_eq!(along(&line, 1, 1.0, |at| at.y).len(), 1);
    }

    #[test]
    fn the_eye_is_a_persons_or_lower_among_low_plants() {
        assert_eq!([0.0, 0.4, 9.0].map(eye_height), [0.12, 0.5, 1.6]);
    }
}
