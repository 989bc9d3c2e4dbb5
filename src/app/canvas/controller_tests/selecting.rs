//! The selection: lasso, taps, handles.

use super::*;

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
