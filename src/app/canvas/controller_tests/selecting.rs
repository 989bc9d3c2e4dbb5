//! The selection: lasso, taps, handles.

use super::*;

#[test]
fn lasso_move_duplicate_part_and_delete() {
    let mut fixture = Fixture::with_lines(3);
    fixture.act(&Action::SetTool(CanvasTool::Select));
    fixture.drag(PEN, &[(50.0, 50.0), (350.0, 50.0), (350.0, 250.0), (50.0, 250.0)]);
    assert_eq!(fixture.selected(), [1, 2]);
    let overlay = fixture.canvas.overlay();
    assert_eq!(overlay.frame.unwrap()[2], DVec2::new(310.0, 210.0), "10 px outside the strokes");
    assert_eq!(overlay.handles.len(), 9);

    fixture.say(Down, PEN, (200.0, 150.0));
    fixture.say(Move, PEN, (220.0, 180.0));
    assert!(matches!(fixture.canvas.preview(), Preview::Moved { ids, .. } if ids.len() == 2));
    let seen = fixture.canvas.previewed(&fixture.strokes);
    fixture.say(Up, PEN, (220.0, 180.0));
    assert_eq!(fixture.strokes, seen);
    assert_eq!(fixture.strokes[0].points[0].position, Vec2::new(120.0, 130.0));
    assert_eq!(fixture.canvas.overlay().frame.unwrap()[0], DVec2::new(110.0, 120.0));

    fixture.act(&Action::DuplicateSelected);
    assert_eq!((fixture.ids(), fixture.selected()), (vec![1, 2, 3, 4, 5], vec![4, 5]));
    assert_eq!(fixture.strokes[3].points[0].position, Vec2::new(144.0, 154.0));
    fixture.act(&Action::SetPart(Tool::Leaf));
    assert_eq!((fixture.strokes[4].tool, fixture.strokes[1].tool), (Tool::Leaf, Tool::Auto));
    fixture.act(&Action::DeleteSelected);
    assert_eq!((fixture.ids(), fixture.selected().len()), (vec![1, 2, 3], 0));
    assert!(fixture.canvas.overlay().frame.is_none());
}

#[test]
fn a_tap_selects_shift_adds_and_escape_lets_go() {
    let mut fixture = Fixture::with_lines(3);
    fixture.act(&Action::SetTool(CanvasTool::Select));
    fixture.tap(MOUSE, (150.0, 103.0));
    assert_eq!(fixture.selected(), [1]);
    fixture.key(CanvasKey::Shift, true);
    fixture.tap(MOUSE, (150.0, 297.0));
    assert_eq!(fixture.selected(), [1, 3]);
    fixture.tap(MOUSE, (150.0, 100.0));
    assert_eq!(fixture.selected(), [3]);
    fixture.key(CanvasKey::Shift, false);
    fixture.key(CanvasKey::Escape, true);
    assert!(fixture.selected().is_empty());
    fixture.act(&Action::SelectAll);
    assert_eq!(fixture.selected(), [1, 2, 3]);
    fixture.act(&Action::SetTool(CanvasTool::Draw(Tool::Auto)));
    assert!(fixture.selected().is_empty());
}

#[test]
fn a_corner_scales_the_selection() {
    let mut fixture = Fixture::with_lines(2);
    fixture.act(&Action::SelectAll);
    let overlay = fixture.canvas.overlay();
    let corner = overlay.handles.iter().find(|(h, _)| *h == Handle::Scale { x: 1, y: 1 }).unwrap().1;
    fixture.drag(MOUSE, &[corner.into(), (corner + DVec2::new(200.0, 100.0)).into()]);
    assert_eq!(fixture.strokes[1].points[20].position, Vec2::new(500.0, 300.0));
    assert_eq!(fixture.strokes[0].points[0].position, Vec2::new(100.0, 100.0));
}

#[test]
fn a_drag_lets_go_when_the_drawing_changes_under_it() {
    let mut fixture = Fixture::with_lines(2);
    fixture.act(&Action::SelectAll);
    fixture.say(Down, PEN, (200.0, 150.0));
    fixture.say(Move, PEN, (220.0, 180.0));
    fixture.strokes.remove(0);
    fixture.canvas.drawing_changed(&fixture.strokes, &mut fixture.out);
    assert_eq!(fixture.canvas.preview(), Preview::Same);
    assert_eq!(fixture.selected(), [2]);
    assert!(fixture.say(Up, PEN, (220.0, 180.0)).is_empty());
}
