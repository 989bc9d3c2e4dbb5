//! Buttons of mice and pens, and the pen's other end.

use super::*;

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
