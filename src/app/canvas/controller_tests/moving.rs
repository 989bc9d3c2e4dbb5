//! Moving the view: keys, wheel, touchpad and fingers.

use super::*;

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
