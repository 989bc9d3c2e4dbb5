//! The plant's side of the window: camera, light and what the pointer does to them.
//!
//! Drag turns, right or middle drag (or Shift) moves, wheel and pinch zoom, a double tap shows the front as it was drawn. A
//! single tap picks a part of the plant, once it is clear that no second tap follows.
//! The camera follows the plant's growth until the artist takes hold of it; camera moves that were asked for by a button
//! are shown as a short flight. Pictures are drafts while anything moves and finished ones when it rests.

use super::messages::{Messages, Msg};
use super::panels::snapshot::{LightChoice, Shading, ViewState};
use super::theme::Palette;
use crate::geom::ray::Ray;
use crate::plant::Texture;
use crate::render::{Background, LightParams, Look, Mode, OrbitCamera, Projection, Quality};
use egui::{PointerButton, Response, Sense, Ui};
use glam::{DVec2, Vec2, Vec3};
use std::borrow::Cow;
use std::error::Error;
use std::time::{Duration, Instant};

/// Length of a flight of the camera.
const FLIGHT: Duration = Duration::from_millis(280);
/// Turn of the turntable, degrees per second.
const TURNTABLE: f32 = 24.0;
/// How long the view must rest before it is finished.
const REST: Duration = Duration::from_millis(450);
/// How long after a click a second one makes it a double click; a little longer than egui's own delay.
const DOUBLE_CLICK: Duration = Duration::from_millis(350);
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
    flight: Option<(OrbitCamera, Instant)>,
    last_step: Option<Instant>,
    /// When something last moved, and whether the finished picture of it is due.
    moved: Option<Instant>,
    /// A click that may become a double click, and when it was.
    click: Option<(Click, Instant)>,
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
            last_step: None,
            moved: None,
            click: None,
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
        // Only for pointers: keys for the plant work whatever has the keyboard's focus.
        let (rect, response) = ui.allocate_exact_size(size, Sense::CLICK | Sense::DRAG);
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

    fn handle(&mut self, ui: &Ui, response: &Response) {
        let rect = response.rect;
        // Shares of the view's height from its centre, y down, as the camera has them.
        let share = |p: egui::Vec2| Vec2::new(p.x, p.y) / rect.height().max(1.0);
        let from_centre = |p: egui::Pos2| share(p - rect.center());
        if response.double_clicked() {
            self.click = None;
            self.show_front();
            return;
        }
        if response.clicked()
            && let Some(at) = response.interact_pointer_pos()
        {
            let click = Click { at: from_centre(at), besides: ui.input(|i| i.modifiers.shift) };
            self.click = Some((click, Instant::now()));
        }
        let drag = share(response.drag_delta());
        if drag != Vec2::ZERO {
            let (shift, touches) = ui.input(|i| (i.modifiers.shift, i.multi_touch().is_some()));
            let moves = shift
                || response.dragged_by(PointerButton::Secondary)
                || response.dragged_by(PointerButton::Middle);
            if !touches {
                self.take_hold();
                if moves { self.camera.pan(drag) } else { self.camera.orbit(drag) }
            }
        }
        if !response.hovered() && !response.dragged() {
            return;
        }
        let (scroll, pinch, at, touch) =
            ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta(), i.pointer.hover_pos(), i.multi_touch()));
        if let Some(touch) = touch {
            self.take_hold();
            self.camera.pan(share(touch.translation_delta));
            self.camera.zoom(touch.zoom_delta, from_centre(touch.center_pos));
            self.camera.turn(-touch.rotation_delta.to_degrees());
        } else if scroll != 0.0 || pinch != 1.0 {
            self.take_hold();
            let about = at.map_or(Vec2::ZERO, from_centre);
            self.camera.zoom(ZOOM_PER_POINT.powf(scroll) * pinch, about);
        }
    }

    /// Turns the plant by a drag of so many physical pixels anywhere in the window.
    pub fn orbit(&mut self, by: DVec2) {
        let by = self.share(by);
        self.take_hold();
        self.camera.orbit(by);
    }

    /// Moves the plant by a drag of so many physical pixels.
    pub fn pan(&mut self, by: DVec2) {
        let by = self.share(by);
        self.take_hold();
        self.camera.pan(by);
    }

    /// A tap at a place in the window, physical pixels: a click, or with one just before the front as it was drawn.
    pub fn tap(&mut self, at: DVec2, besides: bool) {
        if self.click.take_if(|(_, at)| at.elapsed() < DOUBLE_CLICK).is_some() {
            return self.show_front();
        }
        let middle = DVec2::new(self.middle.x.into(), self.middle.y.into()) * self.pixels_per_point;
        self.click = Some((Click { at: self.share(at - middle), besides }, Instant::now()));
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

    fn take_hold(&mut self) {
        self.guide = Guide::Artist;
        self.flight = None;
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
        if bounds.is_none() {
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
        self.state.turntable = false;
        self.guide = Guide::FollowsPlant;
        self.flight = self.bounds.is_some().then(|| (self.camera, Instant::now()));
        self.stir();
    }

    /// Switches between parallel and perspective.
    pub fn set_orthographic(&mut self, on: bool) {
        self.state.orthographic = on;
        self.camera.projection = self.projection();
        self.stir();
    }

    /// Moves what moves by itself.
    fn step(&mut self) {
        let now = Instant::now();
        let passed = self.last_step.replace(now).map_or(0.0, |last| (now - last).as_secs_f32().min(0.1));
        if let (Some((from, begun)), Some(bounds)) = (self.flight, self.bounds) {
            let t = (begun.elapsed().as_secs_f32() / FLIGHT.as_secs_f32()).min(1.0);
            let eased = t * t * (3.0 - 2.0 * t);
            self.camera = from.lerp(&self.front(bounds), eased);
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
                egui::Theme::Light => Background::Paper,
                egui::Theme::Dark => Background::Dark,
            },
            light: self.light(),
        }
    }
}

/// Says on an empty canvas what to do first.
pub(super) fn invite(painter: &egui::Painter, canvas: egui::Rect, messages: &Messages, palette: &Palette) {
    let font = egui::FontId::proportional(19.0);
    let (first, then) = (messages.get(Msg::CanvasInvite), messages.get(Msg::CanvasInviteHint));
    let middle = canvas.center();
    painter.text(middle, egui::Align2::CENTER_BOTTOM, first, font, palette.weak);
    let small = egui::FontId::proportional(14.0);
    painter.text(middle + egui::vec2(0.0, 8.0), egui::Align2::CENTER_TOP, then, small, palette.weak);
}

/// The bytes of a texture's file: the program's own or the artist's.
pub fn texture(texture: &Texture) -> Result<Cow<'static, [u8]>, Box<dyn Error + Send + Sync>> {
    Ok(crate::formats::textures::fetch(texture, &built_in_texture)?)
}

/// The program's own textures, for the exporters.
pub(super) fn built_in_texture(name: &str) -> Option<Cow<'static, [u8]>> {
    crate::species::builtin_texture(name).map(Cow::Borrowed)
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: (Vec3, Vec3) = (Vec3::new(-0.2, 0.0, -0.2), Vec3::new(0.2, 1.0, 0.2));

    #[test]
    fn the_camera_follows_the_plant_until_the_artist_takes_hold() {
        let mut view = PlantView::default();
        view.set_bounds(Some(BOX));
        let small = view.camera();
        view.set_bounds(Some((BOX.0, BOX.1 * 3.0)));
        assert!(view.camera().distance > small.distance);
        view.take_hold();
        let held = view.camera();
        view.set_bounds(Some(BOX));
        assert_eq!(view.camera(), held);
    }

    /// One frame of a view of 200 by 200 points with these events of the pointer.
    fn frame(view: &mut PlantView, ctx: &egui::Context, time: f64, events: Vec<egui::Event>) {
        let screen_rect = Some(egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(200.0, 200.0)));
        let input = egui::RawInput { time: Some(time), events, screen_rect, ..Default::default() };
        let mut output = ctx.run_ui(input, |ui| view.show(ui, egui::TextureId::default()));
        output.textures_delta.clear();
    }

    fn button(pressed: bool) -> egui::Event {
        let (button, modifiers) = (PointerButton::Primary, egui::Modifiers::NONE);
        egui::Event::PointerButton { pos: egui::pos2(150.0, 50.0), button, pressed, modifiers }
    }

    #[test]
    fn a_single_click_picks_once_and_a_double_click_does_not() {
        let (mut view, ctx) = (PlantView::default(), egui::Context::default());
        view.set_bounds(Some(BOX));
        frame(&mut view, &ctx, 0.0, vec![egui::Event::PointerMoved(egui::pos2(150.0, 50.0))]);
        frame(&mut view, &ctx, 0.1, vec![button(true)]);
        frame(&mut view, &ctx, 0.15, vec![button(false)]);
        assert_eq!(view.take_click(), None, "a second click may follow");
        let (click, _) = view.click.unwrap();
        assert!(click.at.x > 0.1 && click.at.y < -0.1 && !click.besides, "{click:?}");
        view.click = Some((click, Instant::now() - DOUBLE_CLICK));
        assert_eq!((view.take_click(), view.take_click()), (Some(click), None));
        frame(&mut view, &ctx, 2.0, vec![button(true)]);
        frame(&mut view, &ctx, 2.05, vec![button(false)]);
        frame(&mut view, &ctx, 2.1, vec![button(true)]);
        frame(&mut view, &ctx, 2.15, vec![button(false)]);
        assert!(view.click.is_none() && view.flight.is_some());
    }

    #[test]
    fn a_plant_that_grows_from_its_beginning_leaves_the_camera_where_it_is() {
        let mut view = PlantView::default();
        view.set_bounds(Some(BOX));
        let whole = view.camera();
        view.keeps_room = true;
        view.set_bounds(Some((BOX.0, BOX.1 * 0.2)));
        assert_eq!(view.camera(), whole);
        view.set_bounds(None);
        assert_eq!(view.camera(), whole);
        view.keeps_room = false;
        view.set_bounds(Some((BOX.0, BOX.1 * 0.2)));
        assert!(view.camera().distance < whole.distance);
    }

    #[test]
    fn a_flight_to_a_plant_that_is_gone_ends() {
        let mut view = PlantView::default();
        view.set_bounds(Some(BOX));
        view.show_front();
        assert!(view.is_moving());
        view.set_bounds(None);
        assert!(!view.is_moving());
    }

    #[test]
    fn drafts_while_moving_and_a_finished_picture_at_rest() {
        let mut view = PlantView::default();
        view.set_bounds(Some(BOX));
        assert_eq!(view.look(egui::Theme::Light).quality, Quality::Draft);
        view.moved = Some(Instant::now() - REST);
        assert_eq!(view.look(egui::Theme::Light).quality, Quality::Full);
        assert_eq!(view.wakes_at(), None);
    }
}
