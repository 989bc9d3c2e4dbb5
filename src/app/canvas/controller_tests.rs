//! The canvas in the hand: whole gestures from events to outcomes, with a drawing that takes the changes.

use super::*;
use crate::app::canvas::overlay::{CursorShape, Preview};
use crate::app::canvas::stroke_builder::Stabiliser;
use crate::app::canvas::transform::Handle;
use crate::pen::tests::{Hand, random_hand};
use crate::sketch::change::StrokeChange;
use crate::sketch::{StrokeId, StrokePoint};
use glam::Vec2;
use proptest::prelude::*;

use PenPhase::*;

/// A canvas with a drawing that takes its changes.
struct Desk {
    canvas: Canvas,
    strokes: Vec<Arc<Stroke>>,
    next_id: StrokeId,
    time_ms: f64,
    hand: Hand,
    out: Vec<CanvasOutcome>,
    applies: bool,
}

impl Desk {
    fn new() -> Self {
        let mut canvas = Canvas::default();
        canvas.set_viewport(Rect::new(DVec2::ZERO, DVec2::new(1000.0, 800.0)), 1.0);
        let hand = Hand::default();
        Self { canvas, strokes: Vec::new(), next_id: 0, time_ms: 0.0, hand, out: Vec::new(), applies: true }
    }

    /// Horizontal lines of ids 1, 2, … at y = 100, 200, …, from x = 100 to 300.
    fn with_lines(count: u64) -> Self {
        let mut desk = Self::new();
        for id in 1..=count {
            let points =
                (0..=20).map(|i| StrokePoint::at(Vec2::new(100.0 + i as f32 * 10.0, id as f32 * 100.0)));
            desk.strokes.push(Arc::new(Stroke { id, tool: Tool::Auto, points: points.collect() }));
        }
        desk.next_id = count;
        desk
    }

    fn event(&mut self, event: &PenEvent) -> Vec<CanvasOutcome> {
        let mut out = Vec::new();
        let next = &mut self.next_id;
        let mut new_id = || {
            *next += 1;
            *next
        };
        self.canvas.pen(event, &mut Drawing { strokes: &self.strokes, new_id: &mut new_id }, &mut out);
        self.take(&out);
        out
    }

    fn act(&mut self, action: &Action) -> Vec<CanvasOutcome> {
        let mut out = Vec::new();
        let next = &mut self.next_id;
        let mut new_id = || {
            *next += 1;
            *next
        };
        self.canvas.act(action, &mut Drawing { strokes: &self.strokes, new_id: &mut new_id }, &mut out);
        self.take(&out);
        out
    }

    fn take(&mut self, out: &[CanvasOutcome]) {
        self.out.extend_from_slice(out);
        let mut changed = false;
        for outcome in out.iter().filter(|_| self.applies) {
            match outcome {
                CanvasOutcome::StrokeFinished(stroke) => self.strokes.push(Arc::clone(stroke)),
                CanvasOutcome::Changed(changes) | CanvasOutcome::Nudged(changes) => {
                    for change in changes {
                        let id = match change {
                            StrokeChange::Put(stroke) => stroke.id,
                            StrokeChange::Remove(id) => *id,
                        };
                        let place = self.strokes.iter().position(|s| s.id == id);
                        match (change, place) {
                            (StrokeChange::Put(stroke), Some(i)) => self.strokes[i] = Arc::clone(stroke),
                            (StrokeChange::Put(stroke), None) => self.strokes.push(Arc::clone(stroke)),
                            (StrokeChange::Remove(id), None) => panic!("stroke {id} is not there to remove"),
                            (StrokeChange::Remove(_), Some(i)) => drop(self.strokes.remove(i)),
                        }
                    }
                }
                _ => continue,
            }
            changed = true;
        }
        if changed {
            let mut more = Vec::new();
            self.canvas.drawing_changed(&self.strokes, &mut more);
            self.out.extend(more);
        }
    }

    fn say(&mut self, phase: PenPhase, tool: PenTool, place: (f64, f64)) -> Vec<CanvasOutcome> {
        self.time_ms += 5.0;
        self.hand.position = DVec2::from(place);
        let event = self.hand.event(phase, tool, self.time_ms);
        self.event(&event)
    }

    /// Down, along a way in steps, up.
    fn drag(&mut self, tool: PenTool, way: &[(f64, f64)]) -> Vec<CanvasOutcome> {
        self.out.clear();
        self.say(Down, tool, way[0]);
        for pair in way.windows(2) {
            for k in 1..=10 {
                let place = DVec2::from(pair[0]).lerp(DVec2::from(pair[1]), f64::from(k) / 10.0);
                self.say(Move, tool, place.into());
            }
        }
        self.say(Up, tool, way[way.len() - 1]);
        std::mem::take(&mut self.out)
    }

    fn tap(&mut self, tool: PenTool, place: (f64, f64)) -> Vec<CanvasOutcome> {
        self.drag(tool, &[place])
    }

    fn key(&mut self, key: CanvasKey, pressed: bool) {
        self.canvas.key(key, pressed, &mut self.out);
    }

    fn ids(&self) -> Vec<StrokeId> {
        self.strokes.iter().map(|s| s.id).collect()
    }

    fn selected(&self) -> Vec<StrokeId> {
        self.canvas.selection().ids().iter().copied().collect()
    }
}

const PEN: PenTool = PenTool::Pen;
const MOUSE: PenTool = PenTool::Mouse;

#[test]
fn a_stroke_begins_grows_and_ends_with_every_sample() {
    let mut desk = Desk::new();
    desk.canvas.settings.stabiliser = Stabiliser::Strong;
    let out = desk.drag(PEN, &[(10.0, 10.0), (110.0, 60.0)]);
    assert_eq!(out[0], CanvasOutcome::StrokeBegan(1));
    let grew = out.iter().filter(|o| matches!(o, CanvasOutcome::StrokeGrew { .. })).count();
    assert_eq!(grew, 10);
    let stroke = &desk.strokes[0];
    assert_eq!((stroke.id, stroke.tool, stroke.points.len()), (1, Tool::Auto, 11));
    assert_eq!(stroke.points[10].position, Vec2::new(110.0, 60.0));
    assert!(desk.canvas.growing().is_none());
}

#[test]
fn strokes_lie_where_they_were_drawn_on_a_turned_and_zoomed_canvas() {
    let mut desk = Desk::new();
    let mut view = CanvasView::default();
    view.rotate_about(DVec2::new(300.0, 300.0), 1.0);
    view.zoom_about(DVec2::ZERO, 2.5);
    desk.canvas.set_view(view);
    desk.drag(MOUSE, &[(10.0, 10.0), (110.0, 60.0)]);
    let last = desk.strokes[0].points.last().unwrap().position.as_dvec2();
    assert!(view.to_window(last).distance(DVec2::new(110.0, 60.0)) < 1e-3);
}

#[test]
fn a_tap_on_a_stroke_asks_what_it_is_and_leaves_no_dot() {
    for (tool, place) in
        [(PEN, (200.0, 104.0)), (MOUSE, (150.0, 199.0)), (PenTool::Finger(4), (150.0, 195.0))]
    {
        let mut desk = Desk::with_lines(2);
        let out = desk.tap(tool, place);
        let id = if place.1 < 150.0 { 1 } else { 2 };
        assert!(out.contains(&CanvasOutcome::TapOnStroke { id, at: DVec2::from(place) }), "{out:?}");
        assert!(out.contains(&CanvasOutcome::StrokeCancelled(3)));
        assert_eq!(desk.ids(), [1, 2]);
    }
}

#[test]
fn a_touch_that_goes_nowhere_asks_about_a_near_stroke_and_is_never_drawn() {
    // However late a busy machine hears that the pen was lifted.
    for (tool, beside, held_ms) in [(PEN, 5.0, 5.0), (MOUSE, 5.0, 900.0), (PenTool::Finger(1), 18.0, 400.0)] {
        let mut desk = Desk::with_lines(1);
        let place = (200.0, 100.0 + beside);
        desk.say(Down, tool, place);
        desk.time_ms += held_ms;
        desk.say(Up, tool, place);
        let at = DVec2::from(place);
        assert!(desk.out.contains(&CanvasOutcome::TapOnStroke { id: 1, at }), "{tool:?}: {:?}", desk.out);
        assert_eq!(desk.ids(), [1], "{tool:?}");
    }
    for held_ms in [5.0, 900.0] {
        let mut desk = Desk::with_lines(1);
        desk.say(Down, PEN, (200.0, 150.0));
        desk.time_ms += held_ms;
        desk.say(Up, PEN, (200.0, 150.0));
        assert!(!desk.out.iter().any(|o| matches!(o, CanvasOutcome::StrokeFinished(_))), "{:?}", desk.out);
        assert_eq!(desk.ids(), [1], "no dot on empty paper");
    }
    let mut desk = Desk::with_lines(1);
    desk.drag(PEN, &[(200.0, 100.0), (206.0, 100.0)]);
    assert_eq!(desk.ids(), [1, 2], "a short stroke is one");
}

#[test]
fn what_is_in_the_middle_stays_there_when_the_layout_moves() {
    let mut desk = Desk::with_lines(1);
    desk.canvas.view.zoom_about(DVec2::new(40.0, 90.0), 3.0);
    let shown = desk.canvas.view.to_canvas(DVec2::new(500.0, 400.0));
    let mirrored = Rect::new(DVec2::new(1200.0, 30.0), DVec2::new(2000.0, 830.0));
    desk.canvas.set_viewport(mirrored, 1.0);
    assert!(desk.canvas.view.to_canvas(mirrored.center()).distance(shown) < 1e-9);
}

#[test]
fn the_eraser_end_erases_whatever_the_tool_and_is_one_change() {
    let mut desk = Desk::with_lines(3);
    let out = desk.drag(PenTool::Eraser, &[(200.0, 80.0), (200.0, 220.0)]);
    let changes: Vec<_> = out.iter().filter(|o| matches!(o, CanvasOutcome::Changed(_))).collect();
    assert_eq!(changes.len(), 1);
    assert_eq!(desk.ids(), [3]);
    assert_eq!(desk.canvas.preview(), Preview::Same);
}

#[test]
fn what_is_being_erased_is_seen_before_it_is_handed_over() {
    let mut desk = Desk::with_lines(2);
    desk.act(&Action::SetTool(CanvasTool::Erase { partial: true }));
    desk.say(Down, PEN, (200.0, 100.0));
    let seen = desk.canvas.previewed(&desk.strokes);
    assert_eq!(seen.len(), 3);
    assert_eq!(seen.iter().map(|s| s.id).collect::<Vec<_>>(), [1, 2, 3]);
    assert_eq!(desk.ids(), [1, 2]);
    desk.say(Up, PEN, (200.0, 100.0));
    assert_eq!(desk.strokes, seen);
}

#[test]
fn a_cancelled_eraser_changes_nothing() {
    let mut desk = Desk::with_lines(2);
    desk.act(&Action::SetTool(CanvasTool::Erase { partial: false }));
    desk.say(Down, PEN, (200.0, 100.0));
    desk.say(Cancel, PEN, (200.0, 100.0));
    assert_eq!(desk.canvas.preview(), Preview::Same);
    desk.out.clear();
    desk.tap(PEN, (200.0, 100.0));
    assert_eq!(desk.ids(), [2], "the index knows the stroke again");
}

#[test]
fn space_pans_with_shift_it_turns_and_with_ctrl_it_zooms() {
    let mut desk = Desk::with_lines(1);
    desk.key(CanvasKey::Space, true);
    assert_eq!(desk.canvas.cursor().shape, CursorShape::Grab);
    desk.drag(MOUSE, &[(100.0, 100.0), (150.0, 120.0)]);
    assert!(desk.canvas.view().to_window(DVec2::ZERO).distance(DVec2::new(50.0, 20.0)) < 1e-9);
    desk.key(CanvasKey::Shift, true);
    desk.drag(MOUSE, &[(700.0, 400.0), (500.0, 600.0)]);
    assert!((desk.canvas.view().rotation_rad().to_degrees() - 90.0).abs() < 1e-9);
    desk.key(CanvasKey::Shift, false);
    desk.key(CanvasKey::Ctrl, true);
    desk.drag(MOUSE, &[(100.0, 100.0), (300.0, 100.0)]);
    assert!((desk.canvas.view().zoom() - std::f64::consts::E).abs() < 1e-9);
    desk.canvas.release_keys();
    desk.drag(MOUSE, &[(100.0, 100.0), (300.0, 100.0)]);
    assert_eq!(desk.ids(), [1, 2], "nothing but the last drag draws");
}

#[test]
fn the_middle_and_the_barrel_button_pan() {
    for (tool, middle) in [(MOUSE, true), (PEN, false)] {
        let mut desk = Desk::new();
        desk.say(Enter, tool, (0.0, 0.0));
        desk.hand.buttons = PenButtons { secondary: !middle, middle, ..PenButtons::default() };
        desk.say(Hover, tool, (10.0, 0.0));
        assert_eq!(desk.canvas.cursor().shape, CursorShape::Grabbing);
        desk.say(Hover, tool, (40.0, 5.0));
        desk.hand.buttons = PenButtons::default();
        desk.say(Hover, tool, (40.0, 5.0));
        desk.say(Hover, tool, (90.0, 90.0));
        assert_eq!(desk.canvas.view().to_window(DVec2::ZERO), DVec2::new(30.0, 5.0));
        assert!(!desk.canvas.is_busy());
    }
}

#[test]
fn the_right_button_and_a_barrel_button_that_picks_ask_about_a_stroke() {
    for tool in [MOUSE, PEN] {
        let mut desk = Desk::with_lines(1);
        desk.canvas.settings.pen.lower = ButtonUse::Pick;
        desk.say(Enter, tool, (200.0, 95.0));
        desk.hand.buttons.secondary = true;
        let out = desk.say(Hover, tool, (200.0, 95.0));
        assert_eq!(out, [CanvasOutcome::TapOnStroke { id: 1, at: DVec2::new(200.0, 95.0) }]);
    }
}

#[test]
fn a_button_that_erases_makes_the_tip_an_eraser() {
    let mut desk = Desk::with_lines(2);
    desk.canvas.settings.pen.lower = ButtonUse::Erase;
    desk.say(Enter, PEN, (200.0, 95.0));
    desk.hand.buttons.secondary = true;
    desk.say(Hover, PEN, (200.0, 105.0));
    assert_eq!(desk.ids(), [1, 2], "hovering removes nothing");
    desk.say(Down, PEN, (200.0, 95.0));
    desk.say(Move, PEN, (200.0, 105.0));
    desk.say(Up, PEN, (200.0, 105.0));
    assert_eq!(desk.ids(), [2]);
    desk.hand.buttons.secondary = false;
    desk.drag(PEN, &[(400.0, 300.0), (500.0, 300.0)]);
    assert_eq!(desk.ids().len(), 2, "without the button the tip draws again");
}

#[test]
fn the_third_button_lets_go_and_erases_like_the_others() {
    let mut desk = Desk::with_lines(2);
    desk.canvas.settings.pen.third = ButtonUse::Orbit;
    desk.say(Enter, PEN, (0.0, 0.0));
    desk.hand.buttons.third = true;
    desk.say(Hover, PEN, (10.0, 0.0));
    assert!(desk.canvas.is_busy());
    desk.hand.buttons.third = false;
    desk.say(Hover, PEN, (10.0, 0.0));
    assert!(!desk.canvas.is_busy());
    desk.canvas.settings.pen.third = ButtonUse::Erase;
    desk.hand.buttons.third = true;
    desk.drag(PEN, &[(200.0, 95.0), (200.0, 105.0)]);
    assert_eq!(desk.ids(), [2]);
}

#[test]
fn every_use_of_a_button_works_while_the_pen_hovers() {
    for is_third in [false, true] {
        every_use_works_while_hovering(is_third);
    }
}

fn every_use_works_while_hovering(is_third: bool) {
    let pressed = |usage| {
        let mut desk = Desk::with_lines(1);
        let uses = &mut desk.canvas.settings.pen;
        *(if is_third { &mut uses.third } else { &mut uses.upper }) = usage;
        desk.say(Enter, PEN, (200.0, 95.0));
        desk.hand.buttons = PenButtons { middle: !is_third, third: is_third, ..PenButtons::default() };
        let mut out = desk.say(Hover, PEN, (200.0, 95.0));
        out.extend(desk.say(Hover, PEN, (230.0, 95.0)));
        out
    };
    let at = DVec2::new(200.0, 95.0);
    assert!(pressed(ButtonUse::Pan).contains(&CanvasOutcome::ViewChanged));
    assert!(pressed(ButtonUse::Orbit).contains(&CanvasOutcome::Orbit(DVec2::new(30.0, 0.0))));
    assert!(pressed(ButtonUse::Pick).contains(&CanvasOutcome::TapOnStroke { id: 1, at }));
    assert!(pressed(ButtonUse::Menu).contains(&CanvasOutcome::AskWhatToDraw { at }));
    assert!(pressed(ButtonUse::Undo).contains(&CanvasOutcome::Action(Action::Undo)));
    assert!(pressed(ButtonUse::Redo).contains(&CanvasOutcome::Action(Action::Redo)));
    let quiet = pressed(ButtonUse::Nothing);
    assert!(quiet.iter().all(|o| *o == CanvasOutcome::OverlayChanged), "{quiet:?}");
}

#[test]
fn the_eraser_end_does_what_was_chosen_for_it() {
    let mut desk = Desk::with_lines(1);
    desk.canvas.settings.pen.eraser = ButtonUse::Pan;
    desk.drag(PenTool::Eraser, &[(200.0, 95.0), (230.0, 105.0)]);
    assert_eq!(desk.ids(), [1]);
    assert_eq!(desk.canvas.view().to_window(DVec2::ZERO), DVec2::new(30.0, 10.0));
    desk.canvas.settings.pen.eraser = ButtonUse::Undo;
    desk.say(Enter, PenTool::Eraser, (10.0, 10.0));
    let out = desk.say(Down, PenTool::Eraser, (10.0, 10.0));
    assert!(out.contains(&CanvasOutcome::Action(Action::Undo)) && !desk.canvas.is_busy());
}

#[test]
fn a_wheel_zooms_about_the_pointer_and_a_touchpad_pans() {
    let (mut desk, at) = (Desk::new(), DVec2::new(400.0, 300.0));
    let held = desk.canvas.view().to_canvas(at);
    desk.canvas.wheel(Scroll::Lines(DVec2::new(0.0, 3.0)), at, &mut desk.out);
    assert!((desk.canvas.view().zoom() - 1.15f64.powi(3)).abs() < 1e-9);
    assert!(desk.canvas.view().to_window(held).distance(at) < 1e-9);
    desk.canvas.wheel(Scroll::Pixels(DVec2::new(7.0, -9.0)), at, &mut desk.out);
    assert!(desk.canvas.view().to_window(held).distance(at + DVec2::new(7.0, -9.0)) < 1e-9);
    desk.canvas.pinch(0.5, 0.0, at, &mut desk.out);
    assert!((desk.canvas.view().zoom() - 1.15f64.powi(3) * 1.5).abs() < 1e-9);
    let before = *desk.canvas.view();
    desk.out.clear();
    desk.canvas.wheel(Scroll::Pixels(DVec2::NAN), at, &mut desk.out);
    desk.canvas.pinch(f64::NAN, f64::NAN, at, &mut desk.out);
    assert_eq!((*desk.canvas.view(), desk.out.len()), (before, 0));
}

#[test]
fn lasso_move_duplicate_part_and_delete() {
    let mut desk = Desk::with_lines(3);
    desk.act(&Action::SetTool(CanvasTool::Select));
    desk.drag(PEN, &[(50.0, 50.0), (350.0, 50.0), (350.0, 250.0), (50.0, 250.0)]);
    assert_eq!(desk.selected(), [1, 2]);
    let overlay = desk.canvas.overlay();
    assert_eq!(overlay.frame.unwrap()[2], DVec2::new(310.0, 210.0), "10 px outside the strokes");
    assert_eq!(overlay.handles.len(), 9);

    desk.say(Down, PEN, (200.0, 150.0));
    desk.say(Move, PEN, (220.0, 180.0));
    assert!(matches!(desk.canvas.preview(), Preview::Moved { ids, .. } if ids.len() == 2));
    let seen = desk.canvas.previewed(&desk.strokes);
    desk.say(Up, PEN, (220.0, 180.0));
    assert_eq!(desk.strokes, seen);
    assert_eq!(desk.strokes[0].points[0].position, Vec2::new(120.0, 130.0));
    assert_eq!(desk.canvas.overlay().frame.unwrap()[0], DVec2::new(110.0, 120.0));

    desk.act(&Action::DuplicateSelected);
    assert_eq!((desk.ids(), desk.selected()), (vec![1, 2, 3, 4, 5], vec![4, 5]));
    assert_eq!(desk.strokes[3].points[0].position, Vec2::new(144.0, 154.0));
    desk.act(&Action::SetPart(Tool::Leaf));
    assert_eq!((desk.strokes[4].tool, desk.strokes[1].tool), (Tool::Leaf, Tool::Auto));
    desk.act(&Action::DeleteSelected);
    assert_eq!((desk.ids(), desk.selected().len()), (vec![1, 2, 3], 0));
    assert!(desk.canvas.overlay().frame.is_none());
}

#[test]
fn a_tap_selects_shift_adds_and_escape_lets_go() {
    let mut desk = Desk::with_lines(3);
    desk.act(&Action::SetTool(CanvasTool::Select));
    desk.tap(MOUSE, (150.0, 103.0));
    assert_eq!(desk.selected(), [1]);
    desk.key(CanvasKey::Shift, true);
    desk.tap(MOUSE, (150.0, 297.0));
    assert_eq!(desk.selected(), [1, 3]);
    desk.tap(MOUSE, (150.0, 100.0));
    assert_eq!(desk.selected(), [3]);
    desk.key(CanvasKey::Shift, false);
    desk.key(CanvasKey::Escape, true);
    assert!(desk.selected().is_empty());
    desk.act(&Action::SelectAll);
    assert_eq!(desk.selected(), [1, 2, 3]);
    desk.act(&Action::SetTool(CanvasTool::Draw(Tool::Auto)));
    assert!(desk.selected().is_empty());
}

#[test]
fn a_corner_scales_the_selection() {
    let mut desk = Desk::with_lines(2);
    desk.act(&Action::SelectAll);
    let overlay = desk.canvas.overlay();
    let corner = overlay.handles.iter().find(|(h, _)| *h == Handle::Scale { x: 1, y: 1 }).unwrap().1;
    desk.drag(MOUSE, &[corner.into(), (corner + DVec2::new(200.0, 100.0)).into()]);
    assert_eq!(desk.strokes[1].points[20].position, Vec2::new(500.0, 300.0));
    assert_eq!(desk.strokes[0].points[0].position, Vec2::new(100.0, 100.0));
}

#[test]
fn a_drag_lets_go_when_the_drawing_changes_under_it() {
    let mut desk = Desk::with_lines(2);
    desk.act(&Action::SelectAll);
    desk.say(Down, PEN, (200.0, 150.0));
    desk.say(Move, PEN, (220.0, 180.0));
    desk.strokes.remove(0);
    desk.canvas.drawing_changed(&desk.strokes, &mut desk.out);
    assert_eq!(desk.canvas.preview(), Preview::Same);
    assert_eq!(desk.selected(), [2]);
    assert!(desk.say(Up, PEN, (220.0, 180.0)).is_empty());
}

#[test]
fn fingers_tap_to_undo_and_carry_the_canvas() {
    let mut desk = Desk::new();
    let (a, b) = (PenTool::Finger(1), PenTool::Finger(2));
    desk.say(Down, a, (100.0, 100.0));
    desk.say(Down, b, (200.0, 100.0));
    desk.say(Up, a, (100.0, 100.0));
    let out = desk.say(Up, b, (200.0, 100.0));
    assert_eq!(out, [CanvasOutcome::Action(Action::Undo)]);
    desk.say(Down, a, (100.0, 100.0));
    desk.say(Down, b, (200.0, 100.0));
    desk.say(Move, b, (220.0, 100.0));
    desk.say(Move, b, (340.0, 100.0));
    assert!((desk.canvas.view().zoom() - 2.0).abs() < 1e-9);
    desk.say(Up, a, (100.0, 100.0));
    desk.say(Up, b, (340.0, 100.0));
    assert!(desk.ids().is_empty(), "gestures draw nothing");
}

#[test]
fn the_pen_takes_the_canvas_from_a_finger_and_the_palm_draws_nothing() {
    let mut desk = Desk::new();
    let palm = PenTool::Finger(1);
    desk.say(Down, palm, (500.0, 500.0));
    desk.say(Move, palm, (540.0, 500.0));
    desk.say(Enter, PEN, (100.0, 100.0));
    assert!(!desk.canvas.is_busy());
    desk.drag(PEN, &[(100.0, 100.0), (200.0, 100.0)]);
    desk.say(Move, palm, (560.0, 500.0));
    desk.say(Up, palm, (560.0, 500.0));
    assert_eq!(desk.strokes.len(), 1);
    assert_eq!(desk.strokes[0].points[0].position, Vec2::new(100.0, 100.0));
}

#[test]
fn fingers_that_never_draw_move_the_canvas() {
    let mut desk = Desk::new();
    desk.canvas.settings.fingers_draw = false;
    desk.drag(PenTool::Finger(1), &[(100.0, 100.0), (300.0, 100.0)]);
    assert!(desk.strokes.is_empty());
    assert!(desk.canvas.view().to_window(DVec2::ZERO).x > 150.0);
}

#[test]
fn steps_of_zoom_keep_the_middle_of_the_paper() {
    let mut desk = Desk::with_lines(3);
    desk.act(&Action::FitCanvas);
    let (middle, before) = (DVec2::new(200.0, 200.0), desk.canvas.view().zoom());
    desk.act(&Action::Zoom(2));
    assert!(desk.canvas.view().zoom() > before * 1.2);
    assert!(desk.canvas.view().to_window(middle).distance(DVec2::new(500.0, 400.0)) < 1e-9);
    desk.act(&Action::Zoom(-2));
    assert!((desk.canvas.view().zoom() / before - 1.0).abs() < 1e-9);
}

#[test]
fn fit_shows_all_strokes() {
    let mut desk = Desk::with_lines(3);
    desk.act(&Action::FitCanvas);
    let middle = desk.canvas.view().to_window(DVec2::new(200.0, 200.0));
    assert!(middle.distance(DVec2::new(500.0, 400.0)) < 1e-9);
    assert!(!desk.canvas.act(
        &Action::Undo,
        &mut Drawing { strokes: &[], new_id: &mut || 0 },
        &mut Vec::new()
    ));
}

#[test]
fn positions_that_are_none_end_no_stroke_and_spoil_none() {
    let mut desk = Desk::new();
    desk.say(Down, PEN, (10.0, 10.0));
    desk.say(Move, PEN, (f64::NAN, 10.0));
    desk.say(Move, PEN, (1e30, 10.0));
    desk.say(Move, PEN, (50.0, 10.0));
    desk.say(Up, PEN, (f64::NAN, f64::INFINITY));
    let places: Vec<_> = desk.strokes[0].points.iter().map(|p| p.position.x).collect();
    assert_eq!(places, [10.0, 50.0]);
}

#[test]
fn the_eraser_shows_its_circle() {
    let mut desk = Desk::new();
    desk.act(&Action::SetTool(CanvasTool::Erase { partial: true }));
    desk.say(Enter, PEN, (40.0, 50.0));
    let out = desk.say(Hover, PEN, (42.0, 50.0));
    assert_eq!(out, [CanvasOutcome::OverlayChanged]);
    assert_eq!(desk.canvas.cursor().circle, Some((DVec2::new(42.0, 50.0), 10.0)));
    desk.canvas.wheel(Scroll::Lines(DVec2::new(0.0, 5.0)), DVec2::ZERO, &mut desk.out);
    assert!(
        (desk.canvas.cursor().circle.unwrap().1 - 10.0).abs() < 1e-9,
        "as large on the screen at any zoom"
    );
}

const TOOLS: [CanvasTool; 5] = [
    CanvasTool::Draw(Tool::Petal),
    CanvasTool::Erase { partial: true },
    CanvasTool::Erase { partial: false },
    CanvasTool::Select,
    CanvasTool::Pan,
];

proptest! {
    #[test]
    fn whatever_hands_do_the_drawing_stays_sound(
        events in random_hand(150), choices in prop::collection::vec(any::<u16>(), 150), fingers_draw in any::<bool>()
    ) {
        let mut desk = Desk::with_lines(6);
        desk.canvas.settings.fingers_draw = fingers_draw;
        let mut growing = None;
        for (event, choice) in events.iter().zip(&choices) {
            desk.out.clear();
            match choice % 23 {
                n @ 0..=4 => drop(desk.act(&Action::SetTool(TOOLS[usize::from(n)]))),
                5 => drop(desk.act(&Action::SelectAll)),
                6 => drop(desk.act(&Action::DuplicateSelected)),
                7 => drop(desk.act(&Action::DeleteSelected)),
                8 => drop(desk.act(&Action::SetPart(Tool::Leaf))),
                9 => desk.key(CanvasKey::Escape, true),
                10 => desk.key(CanvasKey::Space, choice & 64 != 0),
                11 => desk.key(CanvasKey::Shift, choice & 64 != 0),
                12 => desk.canvas.wheel(Scroll::Lines(DVec2::new(0.0, f64::from(*choice % 7) - 3.0)), event.sample.position, &mut desk.out),
                _ => {}
            }
            desk.event(event);
            for outcome in &desk.out {
                match outcome {
                    CanvasOutcome::StrokeBegan(id) => prop_assert!(growing.replace(*id).is_none()),
                    CanvasOutcome::StrokeGrew { .. } => prop_assert!(growing.is_some()),
                    CanvasOutcome::StrokeFinished(stroke) => prop_assert_eq!(growing.take(), Some(stroke.id)),
                    CanvasOutcome::StrokeCancelled(id) => prop_assert_eq!(growing.take(), Some(*id)),
                    CanvasOutcome::Changed(changes) => prop_assert!(!changes.is_empty()),
                    _ => {}
                }
            }
            prop_assert_eq!(desk.canvas.growing().map(|s| s.id()), growing);
            let overlay = desk.canvas.overlay();
            prop_assert!(overlay.frame.is_none_or(|f| f.iter().all(|p| p.is_finite())));
            let seen = desk.canvas.previewed(&desk.strokes);
            let sketch = crate::sketch::Sketch { strokes: seen, ..crate::sketch::Sketch::empty() };
            prop_assert_eq!(sketch.check_invariants(), Ok(()));
            prop_assert!(desk.selected().iter().all(|id| desk.ids().contains(id)));
        }
    }

    #[test]
    fn hostile_numbers_do_no_harm(
        events in prop::collection::vec((any::<u8>(), any::<u8>(), prop::array::uniform5(any::<f64>())), 1..60)
    ) {
        let phases = [Enter, Hover, Down, Move, Up, Leave, Cancel];
        let tools = [PEN, PenTool::Eraser, MOUSE, PenTool::Finger(1), PenTool::Finger(2)];
        let mut desk = Desk::with_lines(2);
        for (phase, tool, [x, y, pressure, tilt, time]) in events {
            desk.canvas.tool = TOOLS[usize::from(phase / 50).min(4)];
            let mut event = desk.hand.event(phases[usize::from(phase) % 7], tools[usize::from(tool) % 5], time);
            event.sample.position = DVec2::new(x, y) * if tool > 128 { 1e-300 } else { 1.0 };
            event.sample.pressure = pressure as f32;
            event.sample.tilt_deg = Vec2::splat(tilt as f32);
            desk.event(&event);
        }
        for stroke in &desk.strokes {
            prop_assert!(stroke.points.iter().all(|p| p.position.is_finite() && (0.0..=1.0).contains(&p.pressure)));
            prop_assert!(stroke.points.iter().all(|p| p.tilt_deg.abs().max_element() <= 90.0 && p.time_ms >= 0.0));
        }
    }
}
