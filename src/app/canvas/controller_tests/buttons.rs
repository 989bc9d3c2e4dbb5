//! Buttons of mice and pens, and the pen's other end.

use super::*;

#[test]
fn the_middle_and_the_barrel_button_pan() {
    for (tool, middle) in [(MOUSE, true), (PEN, false)] {
        let mut fixture = Fixture::new();
        fixture.say(Enter, tool, (0.0, 0.0));
        fixture.hand.buttons = PenButtons { secondary: !middle, middle, ..PenButtons::default() };
        fixture.say(Hover, tool, (10.0, 0.0));
        assert_eq!(fixture.canvas.cursor().shape, CursorShape::Grabbing);
        fixture.say(Hover, tool, (40.0, 5.0));
        fixture.hand.buttons = PenButtons::default();
        fixture.say(Hover, tool, (40.0, 5.0));
        fixture.say(Hover, tool, (90.0, 90.0));
        assert_eq!(fixture.canvas.view().to_window(DVec2::ZERO), DVec2::new(30.0, 5.0));
        assert!(!fixture.canvas.is_busy());
    }
}

#[test]
fn the_right_button_and_a_barrel_button_that_picks_ask_about_a_stroke() {
    for tool in [MOUSE, PEN] {
        let mut fixture = Fixture::with_lines(1);
        fixture.canvas.settings.pen.lower = ButtonUse::Pick;
        fixture.say(Enter, tool, (200.0, 95.0));
        fixture.hand.buttons.secondary = true;
        let out = fixture.say(Hover, tool, (200.0, 95.0));
        assert_eq!(out, [CanvasOutcome::TapOnStroke { id: 1, at: DVec2::new(200.0, 95.0) }]);
    }
}

#[test]
fn a_button_that_erases_makes_the_tip_an_eraser() {
    let mut fixture = Fixture::with_lines(2);
    fixture.canvas.settings.pen.lower = ButtonUse::Erase;
    fixture.say(Enter, PEN, (200.0, 95.0));
    fixture.hand.buttons.secondary = true;
    fixture.say(Hover, PEN, (200.0, 105.0));
    assert_eq!(fixture.ids(), [1, 2], "hovering removes nothing");
    fixture.say(Down, PEN, (200.0, 95.0));
    fixture.say(Move, PEN, (200.0, 105.0));
    fixture.say(Up, PEN, (200.0, 105.0));
    assert_eq!(fixture.ids(), [2]);
    fixture.hand.buttons.secondary = false;
    fixture.drag(PEN, &[(400.0, 300.0), (500.0, 300.0)]);
    assert_eq!(fixture.ids().len(), 2, "without the button the tip draws again");
}

#[test]
fn the_third_button_lets_go_and_erases_like_the_others() {
    let mut fixture = Fixture::with_lines(2);
    fixture.canvas.settings.pen.third = ButtonUse::Orbit;
    fixture.say(Enter, PEN, (0.0, 0.0));
    fixture.hand.buttons.third = true;
    fixture.say(Hover, PEN, (10.0, 0.0));
    assert!(fixture.canvas.is_busy());
    fixture.hand.buttons.third = false;
    fixture.say(Hover, PEN, (10.0, 0.0));
    assert!(!fixture.canvas.is_busy());
    fixture.canvas.settings.pen.third = ButtonUse::Erase;
    fixture.hand.buttons.third = true;
    fixture.drag(PEN, &[(200.0, 95.0), (200.0, 105.0)]);
    assert_eq!(fixture.ids(), [2]);
}

#[test]
fn every_use_of_a_button_works_while_the_pen_hovers() {
    for is_third in [false, true] {
        every_use_works_while_hovering(is_third);
    }
}

fn every_use_works_while_hovering(is_third: bool) {
    let pressed = |usage| {
        let mut fixture = Fixture::with_lines(1);
        let uses = &mut fixture.canvas.settings.pen;
        *(if is_third { &mut uses.third } else { &mut uses.upper }) = usage;
        fixture.say(Enter, PEN, (200.0, 95.0));
        fixture.hand.buttons = PenButtons { middle: !is_third, third: is_third, ..PenButtons::default() };
        let mut out = fixture.say(Hover, PEN, (200.0, 95.0));
        out.extend(fixture.say(Hover, PEN, (230.0, 95.0)));
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
    let mut fixture = Fixture::with_lines(1);
    fixture.canvas.settings.pen.eraser = ButtonUse::Pan;
    fixture.drag(PenTool::Eraser, &[(200.0, 95.0), (230.0, 105.0)]);
    assert_eq!(fixture.ids(), [1]);
    assert_eq!(fixture.canvas.view().to_window(DVec2::ZERO), DVec2::new(30.0, 10.0));
    fixture.canvas.settings.pen.eraser = ButtonUse::Undo;
    fixture.say(Enter, PenTool::Eraser, (10.0, 10.0));
    let out = fixture.say(Down, PenTool::Eraser, (10.0, 10.0));
    assert!(out.contains(&CanvasOutcome::Action(Action::Undo)) && !fixture.canvas.is_busy());
}
