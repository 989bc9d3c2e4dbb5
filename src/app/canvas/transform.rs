//! The box around the selection: handles that move, scale and turn it.
//!
//! The box stands upright on the canvas. Its corners scale evenly, or freely with Shift; its edges stretch one way; the
//! handle above turns, in steps with Shift; inside the box it moves. The frame lies a little outside the strokes, and
//! where the box is small its middle moves rather than its handles. Scaling is about the opposite corner or edge and
//! never turns the selection inside out. Handles have a size on the screen, not on the canvas.

use super::view::{CanvasView, Rect};
use crate::app::canvas_tool::Mirror;
use crate::sketch::{Brush, Stroke, StrokePoint, limits};
use glam::{DAffine2, DVec2, Vec2};

/// Distance from which a pen or mouse takes hold of a handle, in logical pixels.
pub const HANDLE_REACH: f64 = 10.0;

/// Distance from which a finger takes hold of a handle, in logical pixels.
pub const FINGER_HANDLE_REACH: f64 = 20.0;

/// Distance of the frame from the strokes, in logical pixels.
pub const FRAME_MARGIN: f64 = 10.0;

/// Distance of the turning handle from the top edge in logical pixels.
pub const TURN_HANDLE_DISTANCE: f64 = 32.0;

/// Steps of turning with Shift, in degrees.
pub const TURN_STEP_DEG: f64 = 15.0;

/// Smallest scale that one drag can give.
const LEAST_SCALE: f64 = 0.01;

/// Largest scale that one drag can give.
const MOST_SCALE: f64 = 100.0;

/// What can be dragged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Handle {
    /// The selection itself.
    Inside,
    /// Corner or edge; each coordinate −1, 0 or 1: left or top, middle, right or bottom.
    Scale {
        /// Left, middle, right.
        x: i8,
        /// Top, middle, bottom.
        y: i8,
    },
    /// The handle above the box.
    Turn,
}

impl Handle {
    /// Every handle that is drawn.
    pub const ALL: [Handle; 9] = [
        Handle::Turn,
        Handle::Scale { x: -1, y: -1 },
        Handle::Scale { x: 1, y: -1 },
        Handle::Scale { x: 1, y: 1 },
        Handle::Scale { x: -1, y: 1 },
        Handle::Scale { x: 0, y: -1 },
        Handle::Scale { x: 1, y: 0 },
        Handle::Scale { x: 0, y: 1 },
        Handle::Scale { x: -1, y: 0 },
    ];

    /// Where it is on the canvas. `per_logical_px` is canvas pixels per logical pixel.
    pub fn place(self, bounds: Rect, per_logical_px: f64) -> DVec2 {
        let half = frame(bounds, per_logical_px).size() * 0.5;
        match self {
            Handle::Inside => bounds.center(),
            Handle::Scale { x, y } => bounds.center() + half * DVec2::new(x.into(), y.into()),
            Handle::Turn => bounds.center() - DVec2::new(0.0, half.y + TURN_HANDLE_DISTANCE * per_logical_px),
        }
    }

    /// The handle at a window position: the nearest within `reach` logical pixels, else the inside of the box; `None`
    /// outside.
    pub fn at(
        window: DVec2,
        bounds: Rect,
        view: &CanvasView,
        (scale_factor, reach): (f64, f64),
    ) -> Option<Handle> {
        let per_logical_px = scale_factor / view.zoom();
        let gap = |handle: Handle| view.to_window(handle.place(bounds, per_logical_px)).distance(window);
        let most = (reach * scale_factor).min(gap(Handle::Inside));
        let within = Self::ALL.into_iter().filter(|h| gap(*h) <= most);
        let nearest = within.min_by(|a, b| gap(*a).total_cmp(&gap(*b)));
        let (place, frame) = (view.to_canvas(window), frame(bounds, per_logical_px));
        let is_inside = place.cmpge(frame.min).all() && place.cmple(frame.max).all();
        nearest.or(is_inside.then_some(Handle::Inside))
    }
}

/// The frame around the box of the strokes, on the canvas.
pub fn frame(bounds: Rect, per_logical_px: f64) -> Rect {
    let margin = FRAME_MARGIN * per_logical_px;
    Rect { min: bounds.min - margin, max: bounds.max + margin }
}

/// A handle being dragged.
#[derive(Clone, Copy, Debug)]
pub struct Drag {
    /// Which.
    pub handle: Handle,
    bounds: Rect,
    start: DVec2,
    to: DVec2,
}

impl Drag {
    /// Takes hold of a handle at a place of the canvas.
    pub fn begin(handle: Handle, bounds: Rect, place: DVec2) -> Self {
        Self { handle, bounds, start: place, to: place }
    }

    /// Drags to a place of the canvas.
    pub fn drag_to(&mut self, place: DVec2) {
        if place.is_finite() {
            self.to = place;
        }
    }

    /// What it does to the selection, on the canvas. Shift scales corners freely and turns in steps.
    pub fn transform(&self, shift: bool) -> DAffine2 {
        let delta = self.to - self.start;
        match self.handle {
            Handle::Inside => DAffine2::from_translation(delta),
            Handle::Scale { x, y } => self.scaled(DVec2::new(x.into(), y.into()), shift),
            Handle::Turn => {
                let middle = self.bounds.center();
                let (from, to) = (self.start - middle, self.to - middle);
                let turn = if from.length() * to.length() > 0.0 { from.angle_to(to) } else { 0.0 };
                let step = TURN_STEP_DEG.to_radians();
                let turn = if shift { (turn / step).round() * step } else { turn };
                about(middle, DAffine2::from_angle(turn))
            }
        }
    }

    fn scaled(&self, side: DVec2, free: bool) -> DAffine2 {
        let size = self.bounds.size();
        let fixed = self.bounds.center() - side * size * 0.5;
        let delta = (self.to - self.start) * side;
        let stretch = |delta: f64, size: f64| {
            let scale = (size + delta) / size;
            if scale.is_finite() { scale.clamp(LEAST_SCALE, MOST_SCALE) } else { 1.0 }
        };
        let mut scale = DVec2::new(stretch(delta.x, size.x), stretch(delta.y, size.y));
        if side.x != 0.0 && side.y != 0.0 && !free {
            // Evenly: as far along the diagonal as the hand went.
            let diagonal = size.length();
            let along = if diagonal > 0.0 { delta.dot(size) / diagonal } else { 0.0 };
            scale = DVec2::splat(stretch(along, diagonal));
        }
        about(fixed, DAffine2::from_scale(scale))
    }
}

fn about(center: DVec2, what: DAffine2) -> DAffine2 {
    DAffine2::from_translation(center) * what * DAffine2::from_translation(-center)
}

/// The stroke moved; points stay within the largest canvas.
pub fn transformed(stroke: &Stroke, transform: &DAffine2) -> Stroke {
    let most = Vec2::splat(limits::MAX_COORDINATE);
    // What lies in front of the sheet grows with what lies on it.
    let growth = transform.matrix2.determinant().abs().sqrt() as f32;
    let moved = |p: &StrokePoint| {
        let position = transform.transform_point2(p.position.as_dvec2()).as_vec2();
        let position = if position.is_nan() { p.position } else { position.clamp(-most, most) };
        let depth = (p.depth * growth).clamp(-limits::MAX_COORDINATE, limits::MAX_COORDINATE);
        StrokePoint { position, depth: if depth.is_nan() { p.depth } else { depth }, ..*p }
    };
    let brush = stroke.brush.map(|brush| Brush { radius: brush.radius * growth, ..brush });
    Stroke { id: stroke.id, tool: stroke.tool, points: stroke.points.iter().map(moved).collect(), brush }
}

/// The stroke mirrored about a place; the pen leans the other way, too.
pub fn mirrored(stroke: &Stroke, about: DVec2, mirror: Mirror) -> Stroke {
    let sides = match mirror {
        Mirror::LeftRight => DVec2::new(-1.0, 1.0),
        Mirror::TopBottom => DVec2::new(1.0, -1.0),
    };
    let mut stroke = transformed(stroke, &self::about(about, DAffine2::from_scale(sides)));
    stroke.points.iter_mut().for_each(|p| p.tilt_deg *= sides.as_vec2());
    stroke
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn bounds() -> Rect {
        Rect::new(DVec2::new(10.0, 20.0), DVec2::new(110.0, 70.0))
    }

    fn dragged(handle: Handle, by: DVec2, shift: bool) -> DAffine2 {
        let start = handle.place(bounds(), 1.0);
        let mut drag = Drag::begin(handle, bounds(), start);
        drag.drag_to(start + by);
        drag.transform(shift)
    }

    #[test]
    fn every_handle_is_hit_where_it_is_drawn() {
        let mut view = CanvasView::default();
        view.rotate_about(DVec2::ZERO, 0.7);
        view.zoom_about(DVec2::ZERO, 3.0);
        for handle in Handle::ALL {
            let window = view.to_window(handle.place(bounds(), 2.0 / view.zoom()));
            assert_eq!(Handle::at(window, bounds(), &view, (2.0, 10.0)), Some(handle));
        }
        let inside = view.to_window(DVec2::new(40.0, 40.0));
        assert_eq!(Handle::at(inside, bounds(), &view, (1.0, 10.0)), Some(Handle::Inside));
        let dot = Rect::new(DVec2::ONE, DVec2::ONE);
        assert_eq!(Handle::at(view.to_window(DVec2::ONE), dot, &view, (1.0, 20.0)), Some(Handle::Inside));
        assert_eq!(Handle::at(DVec2::splat(-500.0), bounds(), &view, (1.0, 10.0)), None);
    }

    #[test]
    fn corners_scale_evenly_and_freely_with_shift() {
        let corner = Handle::Scale { x: 1, y: 1 };
        let even = dragged(corner, DVec2::new(100.0, 50.0), false);
        assert!(even.transform_point2(DVec2::new(110.0, 70.0)).distance(DVec2::new(210.0, 120.0)) < 1e-9);
        assert!(even.transform_point2(bounds().min).distance(bounds().min) < 1e-9);
        let free = dragged(corner, DVec2::new(100.0, 0.0), true);
        assert!(free.transform_point2(DVec2::new(110.0, 70.0)).distance(DVec2::new(210.0, 70.0)) < 1e-9);
    }

    #[test]
    fn edges_stretch_one_way_and_the_inside_moves() {
        let edge = dragged(Handle::Scale { x: -1, y: 0 }, DVec2::new(-50.0, 33.0), false);
        assert!(edge.transform_point2(bounds().min).distance(DVec2::new(-40.0, 20.0)) < 1e-9);
        assert!(edge.transform_point2(bounds().max).distance(bounds().max) < 1e-9);
        let moved = dragged(Handle::Inside, DVec2::new(3.0, 4.0), false);
        assert_eq!(moved.transform_point2(DVec2::ZERO), DVec2::new(3.0, 4.0));
    }

    #[test]
    fn mirrored_twice_a_stroke_is_itself_and_its_pen_leans_the_other_way_between() {
        let point = StrokePoint { tilt_deg: Vec2::new(30.0, 10.0), ..StrokePoint::at(Vec2::new(15.0, 40.0)) };
        let stroke = Stroke { id: 3, tool: Default::default(), points: vec![point], brush: None };
        for (mirror, place, tilt) in [
            (Mirror::LeftRight, Vec2::new(105.0, 40.0), Vec2::new(-30.0, 10.0)),
            (Mirror::TopBottom, Vec2::new(15.0, 50.0), Vec2::new(30.0, -10.0)),
        ] {
            let once = mirrored(&stroke, bounds().center(), mirror);
            assert_eq!((once.points[0].position, once.points[0].tilt_deg), (place, tilt));
            assert_eq!(mirrored(&once, bounds().center(), mirror), stroke);
        }
    }

    #[test]
    fn what_lies_in_front_of_the_sheet_grows_along() {
        let point = StrokePoint { depth: 12.0, ..StrokePoint::at(Vec2::new(15.0, 40.0)) };
        let stroke = Stroke { id: 3, tool: Default::default(), points: vec![point], brush: None };
        let depth = |transform: DAffine2| transformed(&stroke, &transform).points[0].depth;
        assert_eq!(depth(DAffine2::from_scale(DVec2::splat(2.0))), 24.0);
        assert!((depth(DAffine2::from_angle(0.7)) - 12.0).abs() < 1e-5);
        assert_eq!(mirrored(&stroke, DVec2::ZERO, Mirror::LeftRight).points[0].depth, 12.0);
    }

    #[test]
    fn turning_steps_with_shift() {
        let turned = dragged(Handle::Turn, DVec2::new(20.0, 0.0), true);
        let angle = turned.matrix2.x_axis.to_angle().to_degrees();
        assert!((angle - 15.0).abs() < 1e-9, "{angle}");
        assert!(turned.transform_point2(bounds().center()).distance(bounds().center()) < 1e-9);
    }

    proptest! {
        #[test]
        fn any_drag_of_any_box_gives_sound_numbers(
            a in (any::<f32>(), any::<f32>()), size in (prop_oneof![Just(0.0), 0.0..1e7f64], prop_oneof![Just(0.0), 0.0..1e7f64]),
            to in (any::<f64>(), any::<f64>()), which in 0..10usize, shift in any::<bool>()
        ) {
            let corner = Vec2::from(a).clamp(Vec2::splat(-1e7), Vec2::splat(1e7)).as_dvec2();
            prop_assume!(corner.is_finite());
            let bounds = Rect::new(corner, corner + DVec2::from(size));
            let handle = Handle::ALL.get(which).copied().unwrap_or(Handle::Inside);
            let mut drag = Drag::begin(handle, bounds, handle.place(bounds, 1.0));
            drag.drag_to(DVec2::from(to));
            let dot = Stroke { id: 1, tool: Default::default(), points: vec![StrokePoint::at(corner.as_vec2())], brush: None };
            let moved = transformed(&dot, &drag.transform(shift));
            prop_assert!(moved.points[0].position.abs().max_element() <= limits::MAX_COORDINATE);
        }
    }
}
