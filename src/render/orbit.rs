//! The camera of the live view: it circles a target, and is moved by drags, the wheel and by pinching.
//!
//! Drags are given in shares of the view's height, y down, so that the same gesture does the same in a small and in a
//! large window; positions likewise, counted from the view's centre. `distance` is how far the eye stands from the
//! target; a parallel camera shows what a perspective one of the same distance shows at the target, so that switching the
//! projection keeps the plant's size. Limits: the horizon stays level; the eye never looks from below the feet beyond
//! straight up.

use super::camera::{Axes, Camera, Framing};
use super::{Projection, View, studio};
use crate::geom::ray::Ray;
use glam::{BVec3, Vec2, Vec3};

/// Degrees of turn for a drag over the whole height of the view.
const DEGREES_PER_HEIGHT: f32 = 200.0;
/// Nearest and farthest distance, metres: from a stamen to a park.
const DISTANCES: std::ops::RangeInclusive<f32> = 1e-4..=1e5;

/// A camera that circles a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrbitCamera {
    /// What stays in the middle of the view, world metres.
    pub target: Vec3,
    /// Turn of the viewer around the plant in degrees, counter-clockwise from above; 0 is the front.
    pub yaw_deg: f32,
    /// Height of the viewer above the target in degrees; 0 is level, 90 straight above.
    pub pitch_deg: f32,
    /// Metres from the eye to the target.
    pub distance: f32,
    /// How depth shows.
    pub projection: Projection,
    /// Vertical opening of a perspective view, degrees.
    pub field_of_view_deg: f32,
    /// Turn of the lamps, as that of the viewer; `None` where they turn with the viewer, as around a plant in a studio.
    pub lamps_yaw_deg: Option<f32>,
}

impl Default for OrbitCamera {
    /// A plant of one metre from the front.
    fn default() -> Self {
        Self::facing(Vec2::new(0.0, 0.5), 1.2)
    }
}

impl OrbitCamera {
    /// The parallel front view that shows a world rectangle around `centre`, `height` metres high: given the rectangle of
    /// the canvas in the world, the plant covers the drawing.
    pub fn facing(centre: Vec2, height: f32) -> Self {
        Self {
            target: centre.extend(0.0),
            yaw_deg: 0.0,
            pitch_deg: 0.0,
            distance: (height / 2.0 / slope(studio::FIELD_OF_VIEW_DEG))
                .clamp(*DISTANCES.start(), *DISTANCES.end()),
            projection: Projection::Orthographic,
            field_of_view_deg: studio::FIELD_OF_VIEW_DEG,
            lamps_yaw_deg: None,
        }
    }

    /// The parallel front view of everything inside `bounds`, as it was drawn.
    pub fn front(bounds: (Vec3, Vec3), aspect: f32) -> Self {
        let mut camera = Self::facing(Vec2::ZERO, 1.0);
        camera.fit(bounds, aspect);
        camera
    }

    /// A named view, looking at the origin from one metre; fit it before use.
    pub fn of_view(view: &View) -> Self {
        Self {
            target: Vec3::ZERO,
            yaw_deg: view.azimuth_deg(),
            pitch_deg: view.elevation_deg(),
            distance: 1.0,
            projection: view.projection,
            ..Self::default()
        }
    }

    /// Moves to where everything inside `bounds` is just seen, looking in the same direction. `aspect` is the view's width
    /// over its height.
    pub fn fit(&mut self, bounds: (Vec3, Vec3), aspect: f32) {
        let corners = corners(bounds);
        self.fit_points(&corners, bounds, aspect);
    }

    /// The same, closer, for points inside `bounds`: the framing of [`Renderer::picture`](super::Renderer::picture).
    pub fn fit_points(&mut self, points: &[Vec3], bounds: (Vec3, Vec3), aspect: f32) {
        let axes = self.axes();
        let aspect = sane(aspect);
        let framing = Framing::of(points, bounds, std::slice::from_ref(&axes), self.projection, aspect);
        self.target = framing.pivot + axes.world_from_view(framing.centre.extend(0.0));
        self.set_distance(match self.projection {
            Projection::Perspective => framing.distance,
            Projection::Orthographic => framing.half.y / self.slope(),
        });
    }

    /// Turns with a drag: the plant's near side follows the pointer.
    pub fn orbit(&mut self, drag: Vec2) {
        self.turn(-drag.x * DEGREES_PER_HEIGHT);
        self.pitch_deg = (self.pitch_deg + drag.y * DEGREES_PER_HEIGHT).clamp(-90.0, 90.0);
    }

    /// Turns the viewer around the plant: a step of a turntable.
    pub fn turn(&mut self, degrees: f32) {
        self.yaw_deg = wrapped(self.yaw_deg + degrees);
    }

    /// Turns the viewer in place: a step of a panorama.
    pub fn turn_in_place(&mut self, degrees: f32) {
        let eye = self.eye();
        self.turn(degrees);
        self.target = eye - self.axes().back * self.distance;
    }

    /// Moves sideways with a drag: the target's plane follows the pointer.
    pub fn pan(&mut self, drag: Vec2) {
        let axes = self.axes();
        self.target += (axes.up * drag.y - axes.right * drag.x) * self.height();
    }

    /// Comes closer by `factor` (2 shows everything twice as large) and keeps the place at `about` where it is.
    pub fn zoom(&mut self, factor: f32, about: Vec2) {
        let before = self.height();
        self.set_distance(self.distance / factor.clamp(1e-3, 1e3));
        let axes = self.axes();
        self.target += (axes.right * about.x - axes.up * about.y) * (before - self.height());
    }

    /// Height of what is seen at the target, metres.
    pub fn height(&self) -> f32 {
        2.0 * self.distance * self.slope()
    }

    /// Metres from the eye to a place; without perspective to the target, because everything is as large as it is there.
    pub fn distance_to(&self, place: Vec3) -> f32 {
        match self.projection {
            Projection::Perspective => self.eye().distance(place),
            Projection::Orthographic => self.distance,
        }
    }

    /// Comes closer, or goes back, until a place is so many metres away; what is looked at stays in the middle.
    pub fn keep_away(&mut self, place: Vec3, distance: f32) {
        let aside = self.target - place;
        let along = aside.dot(self.axes().back);
        let room = distance * distance - aside.length_squared() + along * along;
        self.set_distance(match self.projection {
            Projection::Perspective => room.max(0.0).sqrt() - along,
            Projection::Orthographic => distance,
        });
    }

    /// Distance from which something so many metres high fills a share of the view's height, metres.
    pub fn distance_for(&self, height: f32, share: f32) -> f32 {
        height / (2.0 * self.slope() * share)
    }

    /// The way from this camera to another, `t` from 0 to 1: the shorter way round, and zooming evenly to the eye.
    /// On the way between two projections depth shows in perspective.
    pub fn lerp(&self, to: &Self, t: f32) -> Self {
        if t >= 1.0 {
            return *to;
        }
        let t = t.max(0.0);
        let turn = wrapped(to.yaw_deg - self.yaw_deg);
        Self {
            target: self.target.lerp(to.target, t),
            yaw_deg: wrapped(self.yaw_deg + turn * t),
            pitch_deg: self.pitch_deg + (to.pitch_deg - self.pitch_deg) * t,
            distance: self.distance * (to.distance / self.distance).powf(t),
            projection: if self.projection == to.projection || t == 0.0 {
                self.projection
            } else {
                Projection::Perspective
            },
            field_of_view_deg: self.field_of_view_deg + (to.field_of_view_deg - self.field_of_view_deg) * t,
            lamps_yaw_deg: self.lamps_on_the_way(to, t),
        }
    }

    /// Where the lamps are on the way to another camera: they turn with neither viewer, so that shadows do not rush.
    fn lamps_on_the_way(&self, to: &Self, t: f32) -> Option<f32> {
        if self.lamps_yaw_deg.is_none() && to.lamps_yaw_deg.is_none() {
            return None;
        }
        let turn = wrapped(to.lamps_yaw() - self.lamps_yaw());
        Some(wrapped(self.lamps_yaw() + turn * t))
    }

    fn lamps_yaw(&self) -> f32 {
        self.lamps_yaw_deg.unwrap_or(self.yaw_deg)
    }

    /// Where the eye is.
    pub fn eye(&self) -> Vec3 {
        self.target + self.axes().back * self.distance
    }

    /// Where a world point is seen: shares of the view's height from its centre, y down. `None` behind the eye.
    pub fn project(&self, world: Vec3) -> Option<Vec2> {
        let seen = self.axes().view_from_world(world - self.target);
        let height = match self.projection {
            Projection::Orthographic => self.height(),
            Projection::Perspective => 2.0 * self.slope() * (self.distance - seen.z),
        };
        (height > 0.0).then(|| Vec2::new(seen.x, -seen.y) / height)
    }

    /// The ray into a scene within `bounds` at a place of the view: shares of its height from its centre, y down. It meets
    /// what [`OrbitCamera::project`] puts there, nearest first.
    pub fn ray(&self, at: Vec2, bounds: (Vec3, Vec3)) -> Ray {
        let axes = self.axes();
        let aside = axes.right * at.x - axes.up * at.y;
        match self.projection {
            Projection::Orthographic => {
                // A parallel camera shows what is behind its eye too.
                let back = bounds.0.distance(self.target).max(bounds.1.distance(self.target));
                let back = back + (bounds.1 - bounds.0).length();
                let origin = self.target + aside * self.height() + axes.back * back;
                Ray { origin, direction: -axes.back }
            }
            Projection::Perspective => {
                Ray { origin: self.eye(), direction: (aside * 2.0 * self.slope() - axes.back).normalize() }
            }
        }
    }

    /// Axes of a level viewer who is turned like the lamps: they stand in them.
    pub(super) fn level_axes(&self) -> Axes {
        Axes::at(self.lamps_yaw(), 0.0)
    }

    /// The camera for a view of this aspect, with depth enough for everything inside `bounds`.
    pub(super) fn camera(&self, bounds: (Vec3, Vec3), aspect: f32) -> Camera {
        let axes = self.axes();
        let eye = self.eye();
        let size = (bounds.1 - bounds.0).length().max(1e-6);
        let reach = corners(bounds).map(|p| -axes.view_from_world(p - eye).z);
        let (near, far) =
            reach.iter().fold((f32::INFINITY, f32::NEG_INFINITY), |(lo, hi), d| (lo.min(*d), hi.max(*d)));
        let (half, depth) = match self.projection {
            Projection::Perspective => {
                let far = (2.0 * far).max(1e-2 * size);
                (self.slope(), Vec2::new((0.5 * near).max(1e-4 * far), far))
            }
            Projection::Orthographic => (self.slope() * self.distance, Vec2::new(near - size, far + size)),
        };
        Camera::placed(&axes, eye, Vec2::new(half * sane(aspect), half), depth, self.projection)
    }

    pub(super) fn axes(&self) -> Axes {
        Axes::at(self.yaw_deg, self.pitch_deg)
    }

    /// Tangent of half the vertical opening.
    fn slope(&self) -> f32 {
        slope(self.field_of_view_deg)
    }

    fn set_distance(&mut self, distance: f32) {
        self.distance = distance.clamp(*DISTANCES.start(), *DISTANCES.end());
    }
}

/// Tangent of half an opening.
fn slope(degrees: f32) -> f32 {
    (degrees / 2.0).to_radians().tan()
}

/// An aspect that can be divided by.
fn sane(aspect: f32) -> f32 {
    if aspect.is_finite() { aspect.clamp(1e-3, 1e3) } else { 1.0 }
}

/// An angle between −180 and 180 degrees.
fn wrapped(degrees: f32) -> f32 {
    (degrees + 180.0).rem_euclid(360.0) - 180.0
}

fn corners((lo, hi): (Vec3, Vec3)) -> [Vec3; 8] {
    std::array::from_fn(|i| Vec3::select(BVec3::new(i & 1 > 0, i & 2 > 0, i & 4 > 0), hi, lo))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::Direction;

    const BOX: (Vec3, Vec3) = (Vec3::new(-0.2, 0.0, -0.3), Vec3::new(0.6, 1.4, 0.2));

    fn sides() -> [OrbitCamera; 4] {
        let view = |direction, projection| View { direction, projection, turn_deg: 20.0 };
        [
            view(Direction::Front, Projection::Perspective),
            view(Direction::ThreeQuarter, Projection::Orthographic),
            view(Direction::Top, Projection::Perspective),
            view(Direction::Side, Projection::Orthographic),
        ]
        .map(|view| OrbitCamera::of_view(&view))
    }

    #[test]
    fn a_place_is_as_far_away_as_was_asked_for_and_fills_that_share() {
        for mut camera in sides() {
            camera.fit(BOX, 1.5);
            camera.pan(Vec2::new(0.1, -0.2));
            let (place, target) = ((BOX.0 + BOX.1) / 2.0, camera.target);
            for distance in [3.0, 40.0] {
                camera.keep_away(place, distance);
                assert!((camera.distance_to(place) / distance - 1.0).abs() < 1e-3, "{camera:?} {distance}");
                assert_eq!(camera.target, target);
            }
            let far = camera.distance_for(1.4, 0.1);
            camera.keep_away(camera.target, far);
            let share = 1.4 / camera.height();
            assert!((share - 0.1).abs() < 1e-4, "{camera:?}: {share}");
        }
    }

    #[test]
    fn fitting_fills_the_view_up_to_its_margin() {
        for mut camera in sides() {
            for aspect in [0.5, 1.0, 2.2] {
                camera.fit(BOX, aspect);
                let seen = corners(BOX).map(|p| camera.camera(BOX, aspect).clip_from_world.project_point3(p));
                assert!(seen.iter().all(|c| (0.0..=1.0).contains(&c.z)), "{seen:?}");
                let most = seen.iter().map(|c| c.truncate().abs().max_element()).fold(0.0, f32::max);
                assert!((most - 0.9).abs() < 2e-3, "{camera:?} {aspect}: {most}");
            }
        }
    }

    #[test]
    fn projecting_agrees_with_the_matrix() {
        for mut camera in sides() {
            camera.fit(BOX, 1.5);
            for p in corners(BOX) {
                let clip = camera.camera(BOX, 1.5).clip_from_world.project_point3(p);
                let expected = Vec2::new(clip.x * 1.5, -clip.y) / 2.0;
                assert!((camera.project(p).unwrap() - expected).length() < 1e-4);
            }
        }
        let near = OrbitCamera { projection: Projection::Perspective, ..Default::default() };
        assert_eq!(near.project(near.target + Vec3::Z * (near.distance + 1.0)), None);
    }

    #[test]
    fn a_ray_passes_through_what_is_seen_at_its_place() {
        for mut camera in sides() {
            camera.fit(BOX, 1.5);
            for p in corners(BOX) {
                let ray = camera.ray(camera.project(p).unwrap(), BOX);
                let along = (p - ray.origin).dot(ray.direction);
                assert!(along > 0.0 && ray.at(along).distance(p) < 1e-4, "{camera:?} {p}");
            }
        }
    }

    #[test]
    fn dragging_takes_the_target_along() {
        for mut camera in sides() {
            camera.fit(BOX, 1.0);
            let held = camera.target;
            camera.pan(Vec2::new(0.2, -0.1));
            assert!((camera.project(held).unwrap() - Vec2::new(0.2, -0.1)).length() < 1e-4);
        }
    }

    #[test]
    fn zooming_keeps_the_place_under_the_pointer() {
        for mut camera in sides() {
            camera.fit(BOX, 1.0);
            let about = Vec2::new(-0.3, 0.25);
            let axes = camera.axes();
            let held = camera.target + (axes.right * about.x - axes.up * about.y) * camera.height();
            let height = camera.height();
            camera.zoom(2.5, about);
            assert!((camera.project(held).unwrap() - about).length() < 1e-4, "{camera:?}");
            assert!((camera.height() * 2.5 - height).abs() < 1e-4 * height);
        }
    }

    #[test]
    fn orbiting_follows_the_near_side_and_stops_at_the_poles() {
        let mut camera = OrbitCamera::front(BOX, 1.0);
        let near = camera.target + Vec3::Z * 0.1;
        camera.orbit(Vec2::new(0.05, 0.05));
        let seen = camera.project(near).unwrap();
        assert!(seen.x > 0.0 && seen.y > 0.0, "{seen}");
        camera.orbit(Vec2::new(0.0, 9.0));
        assert_eq!(camera.pitch_deg, 90.0);
        assert!(camera.camera(BOX, 1.0).clip_from_world.is_finite());
    }

    #[test]
    fn facing_shows_exactly_its_rectangle() {
        let camera = OrbitCamera::facing(Vec2::new(1.0, 2.0), 3.0);
        for z in [-0.5, 0.0, 0.7] {
            let top = camera.project(Vec3::new(1.0, 3.5, z)).unwrap();
            assert!((top - Vec2::new(0.0, -0.5)).length() < 1e-5, "{top}");
        }
    }

    #[test]
    fn a_transition_begins_and_ends_at_its_ends_and_goes_the_short_way() {
        let from = OrbitCamera { yaw_deg: 170.0, ..OrbitCamera::default() };
        let to = OrbitCamera { yaw_deg: -170.0, distance: 4.0 * from.distance, ..from };
        assert_eq!((from.lerp(&to, 0.0), from.lerp(&to, 1.0)), (from, to));
        let half = from.lerp(&to, 0.5);
        assert!(half.yaw_deg.abs() > 179.9, "{half:?}");
        assert!((half.distance / from.distance - 2.0).abs() < 1e-4);
    }

    #[test]
    fn the_eye_may_stand_inside_the_plant() {
        for mut camera in sides() {
            camera.fit(BOX, 1.0);
            camera.zoom(1000.0, Vec2::ZERO);
            assert!(camera.camera(BOX, f32::NAN).clip_from_world.is_finite());
        }
    }
}
