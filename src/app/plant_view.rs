//! The plant's side of the window: camera, light and what the pointer does to them.
//!
//! Wheel and pinch zoom, a double tap shows the front as it was drawn. A single tap picks a part of the plant, once it is
//! clear that no second tap follows. What presses do is up to the tools (`plant_tools`).
//! One can walk through the scene as well (`plant_view/walking.rs`).
//! The camera follows the plant's growth until the artist takes hold of it; camera moves that were asked for by a button
//! are shown as a short flight. Pictures are drafts while anything moves and finished ones when it rests.

mod walking;

use super::view_state::{LightChoice, Shading, ViewState};
use crate::geom::ray::Ray;
use crate::model;
use crate::pen::{PenPhase, PenSample};
use crate::render::{Background, LightParams, Look, Mode, OrbitCamera, Projection, Quality};
use egui::{Response, Sense, Ui};
use glam::{DVec2, Vec2, Vec3};
use std::time::{Duration, Instant};

/// Length of a flight of the camera.
const FLIGHT: Duration = Duration::from_millis(280);
/// How far above the horizon the ground is looked at from, degrees, and how much of it is seen around the plant, in its sizes.
const GROUND_PITCH: f32 = 45.0;
const GROUND_ROOM: f32 = 1.6;
/// Corners of what is looked at where nothing is drawn, metres.
const NOTHING_DRAWN: (Vec3, Vec3) = (Vec3::new(-0.5, 0.0, -0.5), Vec3::new(0.5, 0.5, 0.5));
/// How far the middle is lifted then, shares of the view's height: below lies the card of the tools.
const GROUND_LIFT: f32 = 0.14;
/// Turn of the turntable, degrees per second.
const TURNTABLE: f32 = 24.0;
/// How long the view must rest before it is finished.
const REST: Duration = Duration::from_millis(450);
/// How long after a click a second one makes it a double click.
const DOUBLE_CLICK: Duration = Duration::from_millis(350);
/// Share of the view's height that the plant has at the nearest of the distances that are chosen by number.
const NEAREST: f32 = 1.25;
/// Zoom of one point of scrolling.
const ZOOM_PER_POINT: f32 = 1.0025;

/// What the camera does.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Guide {
    /// Shows all of the plant from the front while it grows.
    FollowsPlant,
    /// Stays where the artist put it.
    Artist,
}

/// A way of the camera.
#[derive(Clone, Copy, Debug)]
struct Flight {
    from: OrbitCamera,
    /// Where it ends; without that at the front of the plant, as it is then.
    to: Option<OrbitCamera>,
    begun: Instant,
}

/// How far away the plant is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distance {
    /// Metres from the eye to its middle.
    pub metres: f32,
    /// Nearest and farthest that one goes, metres.
    pub range: (f32, f32),
    /// Share of the view's height that it fills there.
    pub share: f32,
}

/// A single click on the plant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Click {
    /// Where: shares of the view's height from its centre, y down.
    pub at: Vec2,
    /// Whether what is picked joins what is selected.
    pub besides: bool,
}

/// The view of the plant.
#[derive(Debug)]
pub struct PlantView {
    /// What the panels show and set.
    pub state: ViewState,
    /// The artist asked for the picture.
    pub wants_copy: bool,
    /// A picture is being painted; a frame comes with it.
    pub(super) awaits_picture: bool,
    /// A smaller plant leaves the camera where it is, as while growth is replayed.
    pub keeps_room: bool,
    camera: OrbitCamera,
    guide: Guide,
    flight: Option<Flight>,
    /// From where the plant was seen before the walk, and by whom that was decided.
    before_walk: Option<(OrbitCamera, Guide)>,
    last_step: Option<Instant>,
    /// When something last moved, and whether the finished picture of it is due.
    moved: Option<Instant>,
    /// A click that may become a double click, and when it was.
    click: Option<(Click, Instant)>,
    /// From where to where something is being carried, physical pixels of the window.
    carried: Option<(DVec2, DVec2)>,
    /// What is being drawn in space, physical pixels of the window.
    drawn: Vec<(PenPhase, PenSample)>,
    aspect: f32,
    /// Height of the view in points.
    height: f32,
    /// Its middle in the window, in points.
    middle: egui::Pos2,
    pixels_per_point: f64,
    bounds: Option<(Vec3, Vec3)>,
}

impl Default for PlantView {
    fn default() -> Self {
        Self {
            state: ViewState::default(),
            wants_copy: false,
            awaits_picture: false,
            keeps_room: false,
            camera: OrbitCamera::default(),
            guide: Guide::FollowsPlant,
            flight: None,
            before_walk: None,
            last_step: None,
            moved: None,
            click: None,
            carried: None,
            drawn: Vec::new(),
            aspect: 1.0,
            height: 1.0,
            middle: egui::Pos2::ZERO,
            pixels_per_point: 1.0,
            bounds: None,
        }
    }
}

impl PlantView {
    /// A view that is lit and shown like this.
    pub fn new(state: ViewState) -> Self {
        let mut view = Self { state, ..Self::default() };
        view.set_orthographic(state.orthographic);
        view
    }

    /// Shows the texture with the plant, filling what is left of `ui`, and handles the pointer.
    pub fn show(&mut self, ui: &mut Ui, texture: egui::TextureId) {
        let size = ui.available_size();
        // Presses come sample by sample (`plant_tools`); keys for the plant work whatever has the keyboard's focus.
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        self.aspect = (size.x / size.y.max(1.0)).max(0.01);
        self.height = size.y.max(1.0);
        self.middle = rect.center();
        self.pixels_per_point = f64::from(ui.ctx().pixels_per_point());
        egui::Image::from_texture((texture, size)).paint_at(ui, rect);
        self.handle(ui, &response);
        self.step();
        if self.wants_frame() {
            ui.ctx().request_repaint();
        } else if let Some(at) = self.wakes_at() {
            ui.ctx().request_repaint_after(at.saturating_duration_since(Instant::now()));
        }
    }

    /// Handles wheel and pinch over the view.
    fn handle(&mut self, ui: &Ui, response: &Response) {
        if !response.hovered() {
            return;
        }
        let rect = response.rect;
        let (scroll, pinch, at) =
            ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta(), i.pointer.hover_pos()));
        if scroll != 0.0 || pinch != 1.0 {
            self.take_hold();
            // Shares of the view's height from its centre, y down, as the camera has them.
            let share = |p: egui::Pos2| (p - rect.center()) / rect.height().max(1.0);
            let about = at.map(share).map_or(Vec2::ZERO, |share| Vec2::new(share.x, share.y));
            self.zoom(ZOOM_PER_POINT.powf(scroll) * pinch, about);
        }
    }

    fn zoom(&mut self, factor: f32, about: Vec2) {
        if self.state.walking {
            self.approach(factor);
        } else {
            self.camera.zoom(factor, about);
        }
    }

    /// Turns the plant by a drag of so many physical pixels anywhere in the window, or who walks looks around.
    pub fn orbit(&mut self, by: DVec2) {
        let by = self.share(by);
        self.take_hold();
        if self.state.walking {
            self.camera.look_around(by);
        } else {
            self.camera.orbit(by);
        }
    }

    /// Moves the plant by a drag of so many physical pixels; who walks pulls the ground.
    pub fn pan(&mut self, by: DVec2) {
        let by = self.share(by);
        self.take_hold();
        if self.state.walking {
            self.pull_ground(by);
        } else {
            self.camera.pan(by);
        }
    }

    /// Follows two fingers from one place to another: moves, zooms and turns the plant together. Physical pixels.
    pub fn follow_pair(&mut self, from: [DVec2; 2], to: [DVec2; 2]) {
        let middle = |pair: [DVec2; 2]| (pair[0] + pair[1]) / 2.0;
        let (before, after) = (from[1] - from[0], to[1] - to[0]);
        let factor = after.length() / before.length();
        let about = self.place(middle(to));
        self.pan(middle(to) - middle(from));
        if factor.is_finite() && factor > 0.0 {
            self.zoom(factor as f32, about);
            if !self.state.walking {
                self.camera.turn(-before.angle_to(after).to_degrees() as f32);
            }
        }
    }

    /// What is held is carried from one place in the window to another, physical pixels.
    pub fn carry(&mut self, from: DVec2, to: DVec2) {
        self.carried = Some((self.carried.map_or(from, |(first, _)| first), to));
    }

    /// From where to where something was carried since this was asked last.
    pub fn take_carried(&mut self) -> Option<(DVec2, DVec2)> {
        self.carried.take()
    }

    /// The pen draws in space: it moves, is lifted or taken away.
    pub fn draw(&mut self, phase: PenPhase, sample: &PenSample) {
        self.drawn.push((phase, *sample));
    }

    /// What was drawn since this was asked last.
    pub fn take_drawn(&mut self) -> Vec<(PenPhase, PenSample)> {
        std::mem::take(&mut self.drawn)
    }

    /// A tap at a place in the window, physical pixels: a click, or with one just before the front as it was drawn. Who walks goes there.
    pub fn tap(&mut self, at: DVec2, besides: bool) {
        if self.state.walking {
            return self.walk_to(self.place(at));
        }
        if self.click.take_if(|(_, at)| at.elapsed() < DOUBLE_CLICK).is_some() {
            return self.show_front();
        }
        self.click = Some((Click { at: self.place(at), besides }, Instant::now()));
    }

    /// A place in the window, physical pixels, as the view has it: shares of its height from its centre, y down.
    pub fn place(&self, at: DVec2) -> Vec2 {
        let middle = DVec2::new(self.middle.x.into(), self.middle.y.into()) * self.pixels_per_point;
        self.share(at - middle)
    }

    /// A place of the view in the window, physical pixels: [`PlantView::place`] the other way.
    pub fn window_place(&self, at: Vec2) -> DVec2 {
        let middle = DVec2::new(self.middle.x.into(), self.middle.y.into());
        (middle + (at * self.height).as_dvec2()) * self.pixels_per_point
    }

    /// Where a world point is seen in the window, physical pixels; `None` behind the eye.
    pub fn seen_at(&self, world: Vec3) -> Option<DVec2> {
        self.camera.project(world).map(|at| self.window_place(at))
    }

    /// What is under a place in the window, physical pixels, of the plane through a world point that is parallel to the
    /// picture.
    pub fn on_plane(&self, through: Vec3, at: DVec2) -> Option<Vec3> {
        let (forward, ray) = (self.forward()?, self.ray(self.place(at))?);
        let along = (through - ray.origin).dot(forward) / ray.direction.dot(forward);
        along.is_finite().then(|| ray.at(along))
    }

    /// The direction in which the plant is looked at; `None` without a plant.
    pub fn forward(&self) -> Option<Vec3> {
        Some(self.ray(Vec2::ZERO)?.direction)
    }

    /// Smallest and largest corner of the plant, metres; `None` without one.
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        self.bounds
    }

    /// Physical pixels as shares of the view's height.
    fn share(&self, px: DVec2) -> Vec2 {
        (px / self.pixels_per_point).as_vec2() / self.height
    }

    /// Physical pixels per point.
    pub fn pixels_per_point(&self) -> f64 {
        self.pixels_per_point
    }

    /// Whether a click waits to become a single one.
    #[cfg(test)]
    pub(super) fn has_click(&self) -> bool {
        self.click.is_some()
    }

    /// The artist takes hold: the camera stays as it is, however the plant grows.
    pub fn take_hold(&mut self) {
        self.guide = Guide::Artist;
        if let Some(Flight { to: Some(to), .. }) = self.flight.take() {
            self.camera = to;
        }
        self.stir();
    }

    /// Something moved: drafts until it rests.
    fn stir(&mut self) {
        self.moved = Some(Instant::now());
    }

    /// Takes the bounds of a new plant.
    pub fn set_bounds(&mut self, bounds: Option<(Vec3, Vec3)>) {
        self.bounds = match (self.bounds.filter(|_| self.keeps_room), bounds) {
            (Some((low, high)), Some((l, h))) => Some((low.min(l), high.max(h))),
            (held, new) => new.or(held),
        };
        if bounds.is_none() && !self.state.walking {
            // Nowhere to fly to: without this the window would never rest.
            self.flight = None;
        }
        self.stir();
        self.follow();
    }

    fn follow(&mut self) {
        if self.guide == Guide::FollowsPlant
            && self.flight.is_none()
            && let Some(bounds) = self.bounds
        {
            self.camera = self.front(bounds);
        }
    }

    fn front(&self, bounds: (Vec3, Vec3)) -> OrbitCamera {
        let mut camera =
            OrbitCamera { projection: self.projection(), ..OrbitCamera::facing(Vec2::ZERO, 1.0) };
        camera.fit(bounds, self.aspect);
        camera
    }

    fn projection(&self) -> Projection {
        if self.state.orthographic { Projection::Orthographic } else { Projection::Perspective }
    }

    /// Flies to the front, as it was drawn, and follows the plant again.
    pub fn show_front(&mut self) {
        (self.state.turntable, self.state.walking, self.before_walk) = (false, false, None);
        self.guide = Guide::FollowsPlant;
        let flight = Flight { from: self.camera, to: None, begun: Instant::now() };
        self.flight = self.bounds.is_some().then_some(flight);
        self.stir();
    }

    fn fly_to(&mut self, to: OrbitCamera) {
        self.take_hold();
        self.flight = Some(Flight { from: self.camera, to: Some(to), begun: Instant::now() });
    }

    /// Lets the plant turn by itself, or stops it.
    pub fn set_turntable(&mut self, on: bool) {
        self.stop_walking();
        self.state.turntable = on;
    }

    /// Looks from above at the ground around the plant, or at the garden between these corners, and stays there.
    pub fn show_ground(&mut self, garden: Option<(Vec3, Vec3)>) {
        self.state.turntable = false;
        self.take_hold();
        if self.camera.pitch_deg >= GROUND_PITCH || self.state.walking {
            return;
        }
        let (low, high) = *self.bounds.get_or_insert(NOTHING_DRAWN);
        let room = GROUND_ROOM * (high - low).max_element();
        let around = match garden {
            Some((l, h)) => (low.min(l), high.max(h)),
            None => (low.min(Vec3::new(-room, 0.0, -room)), high.max(Vec3::new(room, 0.0, room))),
        };
        let mut camera = OrbitCamera { pitch_deg: GROUND_PITCH, ..self.camera };
        camera.fit(around, self.aspect);
        camera.pan(Vec2::new(0.0, -GROUND_LIFT));
        self.camera = camera;
        self.stir();
    }

    /// Switches between parallel and perspective.
    pub fn set_orthographic(&mut self, on: bool) {
        self.stop_walking();
        self.state.orthographic = on;
        self.camera.projection = self.projection();
        self.stir();
    }

    /// Shows a lawn under the sky around the plant, or paper.
    pub fn set_outdoors(&mut self, on: bool) {
        self.state.outdoors = on;
        self.stir();
    }

    /// Moves what moves by itself.
    fn step(&mut self) {
        let now = Instant::now();
        let passed = self.last_step.replace(now).map_or(0.0, |last| (now - last).as_secs_f32().min(0.1));
        let to = self.flight.and_then(|flight| flight.to.or_else(|| Some(self.front(self.bounds?))));
        if let (Some(Flight { from, begun, .. }), Some(to)) = (self.flight, to) {
            let t = (begun.elapsed().as_secs_f32() / FLIGHT.as_secs_f32()).min(1.0);
            let eased = t * t * (3.0 - 2.0 * t);
            self.camera = from.lerp(&to, eased);
            if t >= 1.0 {
                self.flight = None;
            }
            self.stir();
        } else if self.state.turntable {
            self.guide = Guide::Artist;
            self.camera.turn(TURNTABLE * passed);
            self.stir();
        } else {
            self.follow();
        }
    }

    /// Whether the next frame differs by itself.
    pub fn is_moving(&self) -> bool {
        self.flight.is_some() || self.state.turntable
    }

    /// Whether a frame is to be drawn for that: the next picture of what moves comes when the one before is there.
    pub fn wants_frame(&self) -> bool {
        self.is_moving() && !self.awaits_picture
    }

    /// When the finished picture is due, or a click is a single one.
    pub fn wakes_at(&self) -> Option<Instant> {
        let finished = self.moved.map(|at| at + REST);
        let clicked = self.click.map(|(_, at)| at + DOUBLE_CLICK);
        finished.into_iter().chain(clicked).min()
    }

    /// A click that has become a single one, once.
    pub fn take_click(&mut self) -> Option<Click> {
        let (click, _) = self.click.take_if(|(_, at)| at.elapsed() >= DOUBLE_CLICK)?;
        Some(click)
    }

    /// The ray into the plant at a place of the view; `None` without a plant.
    pub fn ray(&self, at: Vec2) -> Option<Ray> {
        self.bounds.map(|bounds| self.camera.ray(at, bounds))
    }

    /// How far away the plant is, and between which distances it is seen at all in levels of detail, metres; `None` without a plant.
    pub fn distance(&self) -> Option<Distance> {
        let (low, high) = self.bounds?;
        let height = (high.y - low.y).max(1e-6);
        let metres = self.camera.distance_to(low.midpoint(high));
        let range =
            (self.camera.distance_for(height, NEAREST), self.camera.distance_for(height, model::NOTHING));
        Some(Distance { metres, range, share: self.camera.distance_for(height, 1.0) / metres.max(1e-6) })
    }

    /// Goes so many metres away from the plant; a walk ends.
    pub fn set_distance(&mut self, metres: f32) {
        let Some((low, high)) = self.bounds.filter(|_| metres.is_finite()) else { return };
        self.stop_walking();
        self.take_hold();
        self.camera.keep_away(low.midpoint(high), metres);
    }

    /// The camera as it stands.
    pub fn camera(&self) -> OrbitCamera {
        self.camera
    }

    /// The light as the artist set it.
    pub fn light(&self) -> LightParams {
        let LightChoice { azimuth_deg, elevation_deg, strength, temperature_k } = self.state.light;
        LightParams {
            sun_azimuth_deg: azimuth_deg,
            sun_elevation_deg: elevation_deg,
            sun_strength: strength,
            sun_temperature_k: temperature_k,
            ..LightParams::default()
        }
    }

    /// How the next picture looks: a draft while anything moves.
    pub fn look(&mut self, theme: egui::Theme) -> Look {
        let rests = self.moved.is_none_or(|at| at.elapsed() >= REST);
        if rests {
            self.moved = None;
        }
        Look {
            mode: match self.state.shading {
                Shading::Shaded => Mode::Shaded,
                Shading::Wireframe => Mode::Wireframe,
                Shading::Parts => Mode::PartColours,
            },
            quality: if rests { Quality::Full } else { Quality::Draft },
            background: match theme {
                _ if self.state.is_outdoors() => Background::Outdoors,
                egui::Theme::Light => Background::Paper,
                egui::Theme::Dark => Background::Dark,
            },
            light: self.light(),
        }
    }
}

#[cfg(test)]
#[path = "plant_view_tests.rs"]
mod tests;
