//! Strokes and the eraser: from the first sample to the outcome.

use super::*;

#[test]
fn a_stroke_begins_grows_and_ends_with_every_sample() {
    let mut fixture = Fixture::new();
    fixture.canvas.settings.stabiliser = Stabiliser::Strong;
    let out = fixture.drag(PEN, &[(10.0, 10.0), (110.0, 60.0)]);
    assert_eq!(out[0], CanvasOutcome::StrokeBegan(1));
    let grew = out.iter().filter(|o| matches!(o, CanvasOutcome::StrokeGrew { .. })).count();
    assert_eq!(grew, 10);
    let stroke = &fixture.strokes[0];
    assert_eq!((stroke.id, stroke.tool, stroke.points.len()), (1, Tool::Auto, 11));
    assert_eq!(stroke.points[10].position, Vec2::new(110.0, 60.0));
    assert!(fixture.canvas.growing().is_none());
}

#[test]
fn strokes_lie_where_they_were_drawn_on_a_turned_and_zoomed_canvas() {
    let mut fixture = Fixture::new();
    let mut view = CanvasView::default();
    view.rotate_about(DVec2::new(300.0, 300.0), 1.0);
    view.zoom_about(DVec2::ZERO, 2.5);
    fixture.canvas.set_view(view);
    fixture.drag(MOUSE, &[(10.0, 10.0), (110.0, 60.0)]);
    let last = fixture.strokes[0].points.last().unwrap().position.as_dvec2();
    assert!(view.to_window(last).distance(DVec2::new(110.0, 60.0)) < 1e-3);
}

#[test]
fn a_tap_on_a_stroke_asks_what_it_is_and_leaves_no_dot() {
    for (tool, place) in
        [(PEN, (200.0, 104.0)), (MOUSE, (150.0, 199.0)), (PenTool::Finger(4), (150.0, 195.0))]
    {
        let mut fixture = Fixture::with_lines(2);
        let out = fixture.tap(tool, place);
        let id = if place.1 < 150.0 { 1 } else { 2 };
        assert!(out.contains(&CanvasOutcome::TapOnStroke { id, at: DVec2::from(place) }), "{out:?}");
        assert!(out.contains(&CanvasOutcome::StrokeCancelled(3)));
        assert_eq!(fixture.ids(), [1, 2]);
    }
}

#[test]
fn a_touch_that_goes_nowhere_asks_about_a_near_stroke_and_is_never_drawn() {
    // However late a busy machine learns that the pen was lifted.
    for (tool, beside, held_ms) in [(PEN, 5.0, 5.0), (MOUSE, 5.0, 900.0), (PenTool::Finger(1), 18.0, 400.0)] {
        let mut fixture = Fixture::with_lines(1);
        let place = (200.0, 100.0 + beside);
        fixture.say(Down, tool, place);
        fixture.time_ms += held_ms;
        fixture.say(Up, tool, place);
        let at = DVec2::from(place);
        assert!(
            fixture.out.contains(&CanvasOutcome::TapOnStroke { id: 1, at }),
            "{tool:?}: {:?}",
            fixture.out
        );
        assert_eq!(fixture.ids(), [1], "{tool:?}");
    }
    for held_ms in [5.0, 900.0] {
        let mut fixture = Fixture::with_lines(1);
        fixture.say(Down, PEN, (200.0, 150.0));
        fixture.time_ms += held_ms;
        fixture.say(Up, PEN, (200.0, 150.0));
        assert!(
            !fixture.out.iter().any(|o| matches!(o, CanvasOutcome::StrokeFinished(_))),
            "{:?}",
            fixture.out
        );
        assert_eq!(fixture.ids(), [1], "no dot on empty paper");
    }
    let mut fixture = Fixture::with_lines(1);
    fixture.drag(PEN, &[(200.0, 100.0), (206.0, 100.0)]);
    assert_eq!(fixture.ids(), [1, 2], "a short stroke is one");
}

#[test]
fn the_eraser_end_erases_whatever_the_tool_and_is_one_change() {
    let mut fixture = Fixture::with_lines(3);
    let out = fixture.drag(PenTool::Eraser, &[(200.0, 80.0), (200.0, 220.0)]);
    let changes: Vec<_> = out.iter().filter(|o| matches!(o, CanvasOutcome::Changed(_))).collect();
    assert_eq!(changes.len(), 1);
    assert_eq!(fixture.ids(), [3]);
    assert_eq!(fixture.canvas.preview(), Preview::Same);
}

#[test]
fn what_is_being_erased_is_seen_before_it_is_handed_over() {
    let mut fixture = Fixture::with_lines(2);
    fixture.act(&Action::SetTool(CanvasTool::Erase { partial: true }));
    fixture.say(Down, PEN, (200.0, 100.0));
    let seen = fixture.canvas.previewed(&fixture.strokes);
    assert_eq!(seen.len(), 3);
    assert_eq!(seen.iter().map(|s| s.id).collect::<Vec<_>>(), [1, 2, 3]);
    assert_eq!(fixture.ids(), [1, 2]);
    fixture.say(Up, PEN, (200.0, 100.0));
    assert_eq!(fixture.strokes, seen);
}

#[test]
fn a_cancelled_eraser_changes_nothing() {
    let mut fixture = Fixture::with_lines(2);
    fixture.act(&Action::SetTool(CanvasTool::Erase { partial: false }));
    fixture.say(Down, PEN, (200.0, 100.0));
    fixture.say(Cancel, PEN, (200.0, 100.0));
    assert_eq!(fixture.canvas.preview(), Preview::Same);
    fixture.out.clear();
    fixture.tap(PEN, (200.0, 100.0));
    assert_eq!(fixture.ids(), [2], "the index knows the stroke again");
}

#[test]
fn the_eraser_shows_its_circle() {
    let mut fixture = Fixture::new();
    fixture.act(&Action::SetTool(CanvasTool::Erase { partial: true }));
    fixture.say(Enter, PEN, (40.0, 50.0));
    let out = fixture.say(Hover, PEN, (42.0, 50.0));
    assert_eq!(out, [CanvasOutcome::OverlayChanged]);
    assert_eq!(fixture.canvas.cursor().circle, Some((DVec2::new(42.0, 50.0), 10.0)));
    fixture.canvas.wheel(Scroll::Lines(DVec2::new(0.0, 5.0)), DVec2::ZERO, &mut fixture.out);
    assert!(
        (fixture.canvas.cursor().circle.unwrap().1 - 10.0).abs() < 1e-9,
        "as large on the screen at any zoom"
    );
}
