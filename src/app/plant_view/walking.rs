//! Walking through the scene: the camera is an eye on the ground (`render/walk.rs`).
//!
//! Drags look around, a tap on the ground goes there, wheel, pinch and keys walk, and where a drag would move the plant it pulls the ground. All
//! lengths are in heights of the eye, so that one walks among crocuses as under trees. The walk ends where the plant was seen from before.

use super::{Guide, PlantView};
use crate::app::view_state::Stride;
use crate::render::{OrbitCamera, walk};
use glam::{Vec2, Vec3, Vec3Swizzles as _};

/// Steps of a walk, in heights of the eye: for a key, for a wheel that makes things e times as large, and for a drag over the whole height
/// of the view; and the turn of a key in shares of that height.
const STEP: f32 = 0.12;
const PER_ZOOM: f32 = 2.0;
const PULL: f32 = 3.0;
const STEP_TURN: f32 = 0.06;
/// Heights of a plant from which one sees it whole at first.
const SEEN_WHOLE: f32 = 1.6;
/// How many times as high the eye is after a key.
const STEP_UP: f32 = 1.1;

impl PlantView {
    /// Walks through the scene between these corners from where it is looked at now, among plants up to so many metres high, or goes back
    /// to where it was seen from before.
    pub fn walk(&mut self, on: bool, (low, high): (Vec3, Vec3)) {
        if on == self.state.walking {
            return;
        }
        let before = (self.camera, self.guide);
        self.take_hold();
        (self.state.walking, self.state.turntable) = (on, false);
        if !on {
            match self.before_walk.take() {
                Some((camera, Guide::Artist)) => self.fly_to(camera),
                Some((_, Guide::FollowsPlant)) | None => self.show_front(),
            }
            return;
        }
        self.before_walk = Some(before);
        let (middle, half) = (low.midpoint(high).xz(), (high - low).xz() / 2.0);
        let toward = Vec2::from_angle((90.0 - self.camera.yaw_deg).to_radians());
        // At the border of the ellipse in the ground, or where the plant is seen whole.
        let edge = (half * toward).length().max(SEEN_WHOLE * high.y);
        let at = middle + toward * edge;
        let camera = OrbitCamera::at_eye(at, walk::eye_height(high.y), middle, self.camera.yaw_deg);
        self.fly_to(camera);
    }

    /// Goes to what is seen of the ground at a place of the view, or to the plant before it; at the sky nothing happens.
    pub(super) fn walk_to(&mut self, place: Vec2) {
        self.take_hold();
        let plant = self.ray(place).zip(self.bounds);
        let at_plant = plant.and_then(|(ray, bounds)| Some(ray.at(ray.enters(bounds)?).xz()));
        if let Some(place) = at_plant.or_else(|| self.camera.ground_at(place)) {
            self.fly_to(self.camera.near(place));
        }
    }

    /// Takes a step while walking.
    pub fn stride(&mut self, step: Stride) {
        if !self.state.walking {
            return;
        }
        self.take_hold();
        let sign = |positive| if positive { 1.0 } else { -1.0 };
        match step {
            Stride::Ahead(ahead) => self.go(STEP * sign(ahead), 0.0),
            Stride::Aside(right) => self.go(0.0, STEP * sign(right)),
            Stride::Turn(right) => self.camera.look_around(Vec2::new(-STEP_TURN * sign(right), 0.0)),
            Stride::Rise(up) => self.camera.rise(STEP_UP.powf(sign(up))),
        }
    }

    /// Goes ahead where a wheel or a pinch would make things so many times as large.
    pub(super) fn approach(&mut self, factor: f32) {
        self.go(PER_ZOOM * factor.max(f32::MIN_POSITIVE).ln(), 0.0);
    }

    /// Pulls the ground by a drag, shares of the view's height.
    pub(super) fn pull_ground(&mut self, by: Vec2) {
        self.go(PULL * by.y, -PULL * by.x);
    }

    /// Goes so many heights of the eye ahead and to the right.
    fn go(&mut self, ahead: f32, aside: f32) {
        let height = self.camera.eye().y;
        self.camera.go(ahead * height, aside * height);
    }

    /// Ends a walk at once.
    pub(super) fn stop_walking(&mut self) {
        if let Some((camera, guide)) = self.before_walk.take() {
            (self.camera, self.guide, self.flight, self.state.walking) = (camera, guide, None, false);
        }
    }
}
