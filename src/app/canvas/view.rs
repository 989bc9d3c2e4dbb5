//! How the canvas lies in the window: moved, turned and scaled alike in all directions.
//!
//! `window = R(rotation) · zoom · canvas + offset`, all in `f64`, so that canvas and window map into each other without
//! visible loss at any zoom. A turn that ends close to upright is shown upright; the hand's own angle is kept while it
//! turns, so that it can leave the upright place again.

use glam::{DAffine2, DMat2, DVec2};

/// Furthest out that the artist can zoom, in window pixels per canvas pixel; only showing all of a huge drawing goes
/// beyond.
pub const MIN_ZOOM: f64 = 0.02;

/// Closest that the artist can zoom.
pub const MAX_ZOOM: f64 = 64.0;

/// Zoom that shows the largest possible drawing in the smallest window.
const LEAST_ZOOM: f64 = 1e-6;

/// Turn from upright, in degrees, that is shown as none.
pub const SNAP_DEG: f64 = 5.0;

/// Share of the rectangle left free on each side when the whole drawing is shown.
const FIT_MARGIN: f64 = 0.05;

/// Furthest that the canvas can be moved, in window pixels: beyond it `f64` no longer resolves a small part of a pixel.
const MAX_OFFSET_PX: f64 = 1e11;

/// Least and most width of a line at full pressure, in logical pixels.
const LINE_WIDTHS: (f64, f64) = (1.5, 6.0);

/// A rectangle by its smallest and largest corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Smallest corner.
    pub min: DVec2,
    /// Largest corner.
    pub max: DVec2,
}

impl Rect {
    /// A rectangle from two opposite corners.
    pub fn new(a: DVec2, b: DVec2) -> Self {
        Self { min: a.min(b), max: a.max(b) }
    }

    /// Width and height.
    pub fn size(&self) -> DVec2 {
        self.max - self.min
    }

    /// The middle.
    pub fn center(&self) -> DVec2 {
        (self.min + self.max) * 0.5
    }

    /// Corners, around.
    pub fn corners(&self) -> [DVec2; 4] {
        [self.min, DVec2::new(self.max.x, self.min.y), self.max, DVec2::new(self.min.x, self.max.y)]
    }
}

/// Where the canvas is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CanvasView {
    offset: DVec2,
    zoom: f64,
    /// What is shown, in radians, clockwise on the screen, −π to π.
    rotation_rad: f64,
    /// What the hand turned, before snapping.
    hand_rad: f64,
}

impl Default for CanvasView {
    fn default() -> Self {
        Self { offset: DVec2::ZERO, zoom: 1.0, rotation_rad: 0.0, hand_rad: 0.0 }
    }
}

impl CanvasView {
    /// Window pixels per canvas pixel.
    pub fn zoom(&self) -> f64 {
        self.zoom
    }

    /// Turn of the canvas in radians, clockwise on the screen.
    pub fn rotation_rad(&self) -> f64 {
        self.rotation_rad
    }

    /// Factor on the width of lines, which are `width` canvas pixels wide at full pressure: seen from far away they stay
    /// visible, and from near they do not hide what is traced.
    pub fn line_scale(&self, width: f64, scale_factor: f64) -> f64 {
        let seen = width * self.zoom;
        let (least, most) = LINE_WIDTHS;
        seen.clamp(least * scale_factor, most * scale_factor) / seen
    }

    /// The map from canvas to window.
    pub fn window_from_canvas(&self) -> DAffine2 {
        DAffine2::from_scale_angle_translation(DVec2::splat(self.zoom), self.rotation_rad, self.offset)
    }

    /// Window position of a place on the canvas.
    pub fn to_window(&self, canvas: DVec2) -> DVec2 {
        self.offset + DVec2::from_angle(self.rotation_rad).rotate(canvas) * self.zoom
    }

    /// Place on the canvas at a window position.
    pub fn to_canvas(&self, window: DVec2) -> DVec2 {
        DVec2::from_angle(-self.rotation_rad).rotate(window - self.offset) / self.zoom
    }

    /// A length or direction of the window, on the canvas.
    pub fn vector_to_canvas(&self, window: DVec2) -> DVec2 {
        DVec2::from_angle(-self.rotation_rad).rotate(window) / self.zoom
    }

    /// Moves the canvas by window pixels.
    pub fn pan(&mut self, delta: DVec2) {
        self.set_offset(self.offset + delta);
    }

    /// Scales about a window position, which keeps its place on the canvas.
    pub fn zoom_about(&mut self, window: DVec2, factor: f64) {
        if factor.is_finite() && factor > 0.0 {
            let least = MIN_ZOOM.min(self.zoom);
            self.change(window, window, (self.zoom * factor).clamp(least, MAX_ZOOM), self.hand_rad);
        }
    }

    /// Turns clockwise on the screen about a window position, which keeps its place on the canvas.
    pub fn rotate_about(&mut self, window: DVec2, angle_rad: f64) {
        if angle_rad.is_finite() {
            self.change(window, window, self.zoom, self.hand_rad + angle_rad);
        }
    }

    /// Follows two fingers from one place to another: moves, scales and turns together.
    pub fn follow_pair(&mut self, from: [DVec2; 2], to: [DVec2; 2]) {
        let (before, after) = (from[1] - from[0], to[1] - to[0]);
        let factor = after.length() / before.length();
        let is_sound = factor.is_finite() && factor > 0.0;
        let (factor, turn) = if is_sound { (factor, before.angle_to(after)) } else { (1.0, 0.0) };
        let least = MIN_ZOOM.min(self.zoom);
        let zoom = (self.zoom * factor).clamp(least, MAX_ZOOM);
        let (old, new) = ((from[0] + from[1]) * 0.5, (to[0] + to[1]) * 0.5);
        self.change(old, new, zoom, self.hand_rad + turn);
    }

    /// Ends a turn: the next one starts from what is shown.
    pub fn settle(&mut self) {
        self.hand_rad = self.rotation_rad;
    }

    /// Shows all of `bounds` (canvas) upright in the middle of `rect` (window).
    pub fn fit(&mut self, bounds: Rect, rect: Rect) {
        let room = rect.size() * (1.0 - 2.0 * FIT_MARGIN);
        let zoom = (room / bounds.size().max(DVec2::splat(f64::MIN_POSITIVE))).min_element();
        let middle = bounds.center();
        if !zoom.is_nan() && middle.is_finite() && rect.center().is_finite() {
            (self.rotation_rad, self.hand_rad) = (0.0, 0.0);
            self.zoom = zoom.clamp(LEAST_ZOOM, MAX_ZOOM);
            self.set_offset(rect.center() - middle * self.zoom);
        }
    }

    /// The canvas place under `old` comes to `new` at another zoom and turn.
    fn change(&mut self, old: DVec2, new: DVec2, zoom: f64, hand_rad: f64) {
        if !(old.is_finite() && new.is_finite()) {
            return;
        }
        let held = self.to_canvas(old);
        self.zoom = zoom;
        self.hand_rad = wrapped(hand_rad);
        let is_upright = self.hand_rad.abs() < SNAP_DEG.to_radians();
        self.rotation_rad = if is_upright { 0.0 } else { self.hand_rad };
        self.set_offset(new - DMat2::from_angle(self.rotation_rad) * held * self.zoom);
    }

    fn set_offset(&mut self, offset: DVec2) {
        if offset.is_finite() {
            self.offset = offset.clamp(DVec2::splat(-MAX_OFFSET_PX), DVec2::splat(MAX_OFFSET_PX));
        }
    }
}

/// The same angle between −π and π.
fn wrapped(angle_rad: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    (angle_rad + PI).rem_euclid(TAU) - PI
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn view(x: f64, y: f64, zoom: f64, turn: f64) -> CanvasView {
        let mut view = CanvasView::default();
        view.pan(DVec2::new(x, y));
        view.zoom_about(DVec2::ZERO, zoom);
        view.rotate_about(DVec2::ZERO, turn);
        view
    }

    #[test]
    fn small_turns_stay_upright_until_the_hand_turns_further() {
        let mut view = CanvasView::default();
        view.rotate_about(DVec2::ZERO, 4f64.to_radians());
        assert_eq!(view.rotation_rad(), 0.0);
        view.rotate_about(DVec2::ZERO, 4f64.to_radians());
        assert!((view.rotation_rad() - 8f64.to_radians()).abs() < 1e-12);
        view.rotate_about(DVec2::ZERO, -5f64.to_radians());
        view.settle();
        view.rotate_about(DVec2::ZERO, 4f64.to_radians());
        assert_eq!(view.rotation_rad(), 0.0);
    }

    #[test]
    fn fit_shows_all_in_the_middle() {
        let mut view = view(5.0, 5.0, 3.0, 1.0);
        let (bounds, rect) = (
            Rect::new(DVec2::ZERO, DVec2::new(200.0, 100.0)),
            Rect::new(DVec2::new(100.0, 0.0), DVec2::new(500.0, 400.0)),
        );
        view.fit(bounds, rect);
        assert_eq!(view.to_window(bounds.center()), rect.center());
        assert!((view.zoom() - 1.8).abs() < 1e-12);
        assert_eq!(view.rotation_rad(), 0.0);
        view.fit(Rect::new(DVec2::ZERO, DVec2::ZERO), rect);
        assert_eq!(view.zoom(), MAX_ZOOM);
    }

    #[test]
    fn a_huge_drawing_fits_and_zooms_in_from_there() {
        let mut view = CanvasView::default();
        let huge = Rect::new(DVec2::splat(-1e7), DVec2::splat(1e7));
        view.fit(huge, Rect::new(DVec2::ZERO, DVec2::splat(1000.0)));
        let all = view.zoom();
        assert!(all < MIN_ZOOM && all > LEAST_ZOOM);
        view.zoom_about(DVec2::ZERO, 0.5);
        assert_eq!(view.zoom(), all);
        view.zoom_about(DVec2::ZERO, 2.0);
        assert!((view.zoom() - 2.0 * all).abs() < 1e-15);
    }

    #[test]
    fn lines_are_neither_lost_nor_in_the_way_at_any_zoom() {
        for (zoom, wide) in [(MIN_ZOOM, 1.5), (0.5, 2.0), (1.0, 4.0), (8.0, 6.0), (MAX_ZOOM, 6.0)] {
            let view = view(3.0, 4.0, zoom, 0.0);
            assert!((view.line_scale(4.0, 1.0) * 4.0 * view.zoom() - wide).abs() < 1e-9, "{zoom}");
            assert!(view.line_scale(4.0, 2.0) * 4.0 * view.zoom() <= 12.0 + 1e-9, "{zoom}");
        }
    }

    proptest! {
        #[test]
        fn window_and_canvas_are_inverse(
            x in -2e3..2e3f64, y in -2e3..2e3f64, zoom in MIN_ZOOM..MAX_ZOOM, turn in -9.0..9.0f64,
            px in -1e6..1e6f64, py in -1e6..1e6f64
        ) {
            let (view, place) = (view(x, y, zoom, turn), DVec2::new(px, py));
            prop_assert!(view.to_canvas(view.to_window(place)).distance(place) < 1e-6);
            prop_assert!(view.to_window(place).distance(view.window_from_canvas().transform_point2(place)) < 1e-6);
        }

        #[test]
        fn zoom_and_turn_keep_the_place_under_the_pointer(
            zoom in MIN_ZOOM..MAX_ZOOM, factor in 0.01..100.0f64, turn in -4.0..4.0f64,
            px in -3e3..3e3f64, py in -3e3..3e3f64
        ) {
            let (mut view, at) = (view(12.0, 7.0, zoom, 0.5), DVec2::new(px, py));
            let held = view.to_canvas(at);
            view.zoom_about(at, factor);
            view.rotate_about(at, turn);
            prop_assert!(view.to_window(held).distance(at) < 1e-6);
            prop_assert!((MIN_ZOOM..=MAX_ZOOM).contains(&view.zoom()));
        }

        #[test]
        fn two_fingers_hold_what_they_touch(
            a in (0.0..900.0f64, 0.0..900.0f64), b in (0.0..900.0f64, 0.0..900.0f64), to in (0.0..900.0f64, 0.0..900.0f64)
        ) {
            let mut view = view(3.0, 4.0, 1.0, 1.5);
            let (from, to) = ([DVec2::from(a), DVec2::from(b)], [DVec2::from(a), DVec2::from(to)]);
            let factor = (to[1] - to[0]).length() / (from[1] - from[0]).length();
            let held = from.map(|p| view.to_canvas(p));
            view.follow_pair(from, to);
            let is_free = (MIN_ZOOM..MAX_ZOOM).contains(&factor) && view.rotation_rad() != 0.0;
            // At a limit or snapped upright, what lies between the fingers is still held.
            let middle = (held[0] + held[1]) * 0.5;
            prop_assert!(view.to_window(middle).distance((to[0] + to[1]) * 0.5) < 1e-6);
            if is_free {
                prop_assert!(view.to_window(held[0]).distance(to[0]) < 1e-6);
                prop_assert!(view.to_window(held[1]).distance(to[1]) < 1e-6);
            }
        }

        #[test]
        fn hostile_numbers_leave_a_sound_view(numbers in prop::collection::vec(any::<f64>(), 12)) {
            let mut view = CanvasView::default();
            let place = |i: usize| DVec2::new(numbers[i], numbers[i + 1]);
            view.pan(place(0));
            view.zoom_about(place(2), numbers[4]);
            view.rotate_about(place(5), numbers[7]);
            view.follow_pair([place(0), place(2)], [place(5), place(8)]);
            view.fit(Rect { min: place(0), max: place(2) }, Rect { min: place(4), max: place(6) });
            prop_assert!(view.to_window(DVec2::ONE).is_finite());
            prop_assert!(view.to_canvas(DVec2::ONE).is_finite());
        }
    }
}
