//! Moving the view: keys, wheel, touchpad and fingers.

use super::*;

#[test]
fn what_is_in_the_middle_stays_there_when_the_layout_moves() {
    let mut fixture = Fixture::with_lines(1);
    fixture.canvas.view.zoom_about(DVec2::new(40.0, 90.0), 3.0);
    let shown = fixture.canvas.view.to_canvas(DVec2::new(500.0, 400.0));
    let mirrored = Rect::new(DVec2::new(1200.0, 30.0), DVec2::new(2000.0, 830.0));
    fixture.canvas.set_viewport(mirrored, 1.0);
    assert!(fixture.canvas.view.to_canvas(mirrored.center()).distance(shown) < 1e-9);
}

#[test]
fn space_pans_with_shift_it_turns_and_with_ctrl_it_zooms() {
    let mut fixture = Fixture::with_lines(1);
    fixture.key(CanvasKey::Space, true);
    assert_eq!(fixture.canvas.cursor().shape, CursorShape::Grab);
    fixture.drag(MOUSE, &[(100.0, 100.0), (150.0, 120.0)]);
    assert!(fixture.canvas.view().to_window(DVec2::ZERO).distance(DVec2::new(50.0, 20.0)) < 1e-9);
    fixture.key(CanvasKey::Shift, true);
    fixture.drag(MOUSE, &[(700.0, 400.0), (500.0, 600.0)]);
    assert!((fixture.canvas.view().rotation_rad().to_degrees() - 90.0).abs() < 1e-9);
    fixture.key(CanvasKey::Shift, false);
    fixture.key(CanvasKey::Ctrl, true);
    fixture.drag(MOUSE, &[(100.0, 100.0), (300.0, 100.0)]);
    assert!((fixture.canvas.view().zoom() - std::f64::consts::E).abs() < 1e-9);
    fixture.canvas.release_keys();
    fixture.drag(MOUSE, &[(100.0, 100.0), (300.0, 100.0)]);
    assert_eq!(fixture.ids(), [1, 2], "nothing but the last drag draws");
}

#[test]
fn a_wheel_zooms_about_the_pointer_and_a_touchpad_pans() {
    let (mut fixture, at) = (Fixture::new(), DVec2::new(400.0, 300.0));
    let held = fixture.canvas.view().to_canvas(at);
    fixture.canvas.wheel(Scroll::Lines(DVec2::new(0.0, 3.0)), at, &mut fixture.out);
    assert!((fixture.canvas.view().zoom() - 1.15f64.powi(3)).abs() < 1e-9);
    assert!(fixture.canvas.view().to_window(held).distance(at) < 1e-9);
    fixture.canvas.wheel(Scroll::Pixels(DVec2::new(7.0, -9.0)), at, &mut fixture.out);
    assert!(fixture.canvas.view().to_window(held).distance(at + DVec2::new(7.0, -9.0)) < 1e-9);
    fixture.canvas.pinch(0.5, 0.0, at, &mut fixture.out);
    assert!((fixture.canvas.view().zoom() - 1.15f64.powi(3) * 1.5).abs() < 1e-9);
    let before = *fixture.canvas.view();
    fixture.out.clear();
    fixture.canvas.wheel(Scroll::Pixels(DVec2::NAN), at, &mut fixture.out);
    fixture.canvas.pinch(f64::NAN, f64::NAN, at, &mut fixture.out);
    assert_eq!((*fixture.canvas.view(), fixture.out.len()), (before, 0));
}

#[test]
fn fingers_tap_to_undo_and_carry_the_canvas() {
    let mut fixture = Fixture::new();
    let (a, b) = (PenTool::Finger(1), PenTool::Finger(2));
    fixture.say(Down, a, (100.0, 100.0));
    fixture.say(Down, b, (200.0, 100.0));
    fixture.say(Up, a, (100.0, 100.0));
    let out = fixture.say(Up, b, (200.0, 100.0));
    assert_eq!(out, [CanvasOutcome::Action(Action::Undo)]);
    fixture.say(Down, a, (100.0, 100.0));
    fixture.say(Down, b, (200.0, 100.0));
    fixture.say(Move, b, (220.0, 100.0));
    fixture.say(Move, b, (340.0, 100.0));
    assert!((fixture.canvas.view().zoom() - 2.0).abs() < 1e-9);
    fixture.say(Up, a, (100.0, 100.0));
    fixture.say(Up, b, (340.0, 100.0));
    assert!(fixture.ids().is_empty(), "gestures draw nothing");
}

#[test]
fn the_pen_takes_the_canvas_from_a_finger_and_the_palm_draws_nothing() {
    let mut fixture = Fixture::new();
    let palm = PenTool::Finger(1);
    fixture.say(Down, palm, (500.0, 500.0));
    fixture.say(Move, palm, (540.0, 500.0));
    fixture.say(Enter, PEN, (100.0, 100.0));
    assert!(!fixture.canvas.is_busy());
    fixture.drag(PEN, &[(100.0, 100.0), (200.0, 100.0)]);
    fixture.say(Move, palm, (560.0, 500.0));
    fixture.say(Up, palm, (560.0, 500.0));
    assert_eq!(fixture.strokes.len(), 1);
    assert_eq!(fixture.strokes[0].points[0].position, Vec2::new(100.0, 100.0));
}

#[test]
fn fingers_that_never_draw_move_the_canvas() {
    let mut fixture = Fixture::new();
    fixture.canvas.settings.fingers_draw = false;
    fixture.drag(PenTool::Finger(1), &[(100.0, 100.0), (300.0, 100.0)]);
    assert!(fixture.strokes.is_empty());
    assert!(fixture.canvas.view().to_window(DVec2::ZERO).x > 150.0);
}

#[test]
fn steps_of_zoom_keep_the_middle_of_the_paper() {
    let mut fixture = Fixture::with_lines(3);
    fixture.act(&Action::FitCanvas);
    let (middle, before) = (DVec2::new(200.0, 200.0), fixture.canvas.view().zoom());
    fixture.act(&Action::Zoom(2));
    assert!(fixture.canvas.view().zoom() > before * 1.2);
    assert!(fixture.canvas.view().to_window(middle).distance(DVec2::new(500.0, 400.0)) < 1e-9);
    fixture.act(&Action::Zoom(-2));
    assert!((fixture.canvas.view().zoom() / before - 1.0).abs() < 1e-9);
}

#[test]
fn fit_shows_all_strokes() {
    let mut fixture = Fixture::with_lines(3);
    fixture.act(&Action::FitCanvas);
    let middle = fixture.canvas.view().to_window(DVec2::new(200.0, 200.0));
    assert!(middle.distance(DVec2::new(500.0, 400.0)) < 1e-9);
    assert!(!fixture.canvas.act(
        &Action::Undo,
        &mut Drawing { strokes: &[], new_id: &mut || 0 },
        &mut Vec::new()
    ));
}
