//! The order of pen events, whatever the window says.

use super::*;
use crate::pen::grammar::Grammar;
use proptest::prelude::*;
use winit::event::{FingerId, TabletToolTilt};

fn at(x: f64, y: f64) -> PhysicalPosition<f64> {
    PhysicalPosition::new(x, y)
}

fn moved(x: f64, y: f64, source: PointerSource) -> WindowEvent {
    WindowEvent::PointerMoved { device_id: None, position: at(x, y), primary: true, source }
}

fn button(x: f64, y: f64, button: ButtonSource, pressed: bool) -> WindowEvent {
    let state = if pressed { ElementState::Pressed } else { ElementState::Released };
    WindowEvent::PointerButton {
        device_id: None,
        state,
        position: at(x, y),
        primary: true,
        button,
        is_macos_activation_click: false,
    }
}

fn entered(kind: PointerKind) -> WindowEvent {
    WindowEvent::PointerEntered { device_id: None, position: at(1.0, 1.0), primary: true, kind }
}

fn left(kind: PointerKind) -> WindowEvent {
    WindowEvent::PointerLeft { device_id: None, position: None, primary: true, kind }
}

fn tablet(kind: TabletToolKind, force: Option<f64>) -> (TabletToolKind, TabletToolData) {
    let tilt = Some(TabletToolTilt { x: 30, y: -20 });
    (
        kind,
        TabletToolData { force: force.map(Force::Normalized), tilt, twist: Some(361), ..Default::default() },
    )
}

fn pen_moved(x: f64, force: Option<f64>) -> WindowEvent {
    let (kind, data) = tablet(TabletToolKind::Pen, force);
    moved(x, 5.0, PointerSource::TabletTool { kind, data })
}

fn pen_button(which: TabletToolButton, force: Option<f64>, pressed: bool) -> WindowEvent {
    let (kind, data) = tablet(TabletToolKind::Pen, force);
    button(5.0, 5.0, ButtonSource::TabletTool { kind, button: which, data }, pressed)
}

fn run(events: &[WindowEvent]) -> Vec<PenEvent> {
    let (mut pen, mut out, mut grammar) = (WinitPen::new(), Vec::new(), Grammar::default());
    for (i, event) in events.iter().enumerate() {
        pen.event(event, i as f64, &mut out);
    }
    out.iter().for_each(|event| grammar.accept(event).unwrap());
    out
}

fn phases(events: &[WindowEvent]) -> Vec<PenPhase> {
    run(events).iter().map(|e| e.phase).collect()
}

use PenPhase::*;

#[test]
fn a_mouse_draws_with_its_left_button_and_neutral_pressure() {
    let press = |pressed| button(3.5, 4.0, ButtonSource::Mouse(MouseButton::Left), pressed);
    let events = run(&[
        moved(1.0, 1.0, PointerSource::Mouse),
        press(true),
        press(true),
        moved(9.25, 4.0, PointerSource::Mouse),
        press(false),
        press(false),
    ]);
    let said: Vec<_> = events.iter().map(|e| (e.phase, e.sample.position.x, e.sample.pressure)).collect();
    let expected =
        [(Enter, 1.0, 0.0), (Hover, 1.0, 0.0), (Down, 3.5, 0.5), (Move, 9.25, 0.5), (Up, 3.5, 0.0)];
    assert_eq!(said, expected);
}

#[test]
fn a_mouse_that_leaves_while_drawing_draws_until_it_is_released() {
    let press = |pressed| button(3.0, 4.0, ButtonSource::Mouse(MouseButton::Left), pressed);
    let events = [
        entered(PointerKind::Mouse),
        press(true),
        left(PointerKind::Mouse),
        moved(-20.0, 4.0, PointerSource::Mouse),
        press(false),
    ];
    assert_eq!(phases(&events), [Enter, Down, Move, Up, Leave]);
}

#[test]
fn other_mouse_buttons_are_reported_without_touching() {
    let press = |which, pressed| button(3.0, 4.0, ButtonSource::Mouse(which), pressed);
    let events = run(&[
        entered(PointerKind::Mouse),
        press(MouseButton::Middle, true),
        press(MouseButton::Right, true),
        press(MouseButton::Middle, false),
        press(MouseButton::Back, true),
    ]);
    let held: Vec<_> =
        events.iter().map(|e| (e.phase, e.sample.buttons.secondary, e.sample.buttons.middle)).collect();
    assert_eq!(
        held,
        [(Enter, false, false), (Hover, false, true), (Hover, true, true), (Hover, true, false)]
    );
}

#[test]
fn a_finger_enters_touches_and_leaves() {
    let finger_id = FingerId::from_raw(3);
    let press = |force, pressed| button(3.0, 4.0, ButtonSource::Touch { finger_id, force }, pressed);
    let half = Some(Force::Calibrated { force: 2.0, max_possible_force: 8.0 });
    let events = run(&[
        entered(PointerKind::Touch(finger_id)),
        press(half, true),
        moved(8.0, 4.0, PointerSource::Touch { finger_id, force: None }),
        press(None, false),
        left(PointerKind::Touch(finger_id)),
    ]);
    let said: Vec<_> = events.iter().map(|e| (e.phase, e.sample.pressure)).collect();
    assert_eq!(said, [(Enter, 0.0), (Down, 0.25), (Move, 0.5), (Up, 0.0), (Leave, 0.0)]);
    assert!(events.iter().all(|e| e.sample.tool == PenTool::Finger(3)));
}

#[test]
fn a_finger_that_the_system_takes_away_is_cancelled() {
    let finger_id = FingerId::from_raw(3);
    let press = button(3.0, 4.0, ButtonSource::Touch { finger_id, force: None }, true);
    let kind = PointerKind::Touch(finger_id);
    assert_eq!(
        phases(&[entered(kind), press.clone(), left(kind), left(kind), press]),
        [Enter, Down, Cancel, Enter, Down]
    );
}

#[test]
fn a_pen_reports_pressure_tilt_and_twist() {
    let contact = TabletToolButton::Contact;
    let events = run(&[
        pen_moved(4.0, None),
        pen_button(contact, Some(0.25), true),
        pen_moved(6.0, Some(7.0)),
        pen_moved(6.0, Some(f64::NAN)),
        pen_button(contact, Some(0.0), false),
    ]);
    let said: Vec<_> = events.iter().map(|e| (e.phase, e.sample.pressure)).collect();
    assert_eq!(said, [(Enter, 0.0), (Hover, 0.0), (Down, 0.25), (Move, 1.0), (Move, 0.5), (Up, 0.0)]);
    assert_eq!(events[3].sample.tilt_deg, Vec2::new(30.0, -20.0));
    assert_eq!(events[3].sample.twist_deg, 1.0);
}

#[test]
fn a_contact_without_pressure_is_the_barrel_button() {
    let contact = TabletToolButton::Contact;
    let events = run(&[
        pen_button(contact, None, true),
        pen_button(contact, Some(0.5), true),
        pen_button(contact, Some(0.5), false),
        pen_button(contact, Some(0.5), true),
        pen_button(contact, Some(0.0), false),
        pen_button(contact, Some(0.0), false),
    ]);
    let said: Vec<_> = events.iter().map(|e| (e.phase, e.sample.buttons.secondary)).collect();
    let expected = [
        (Enter, false),
        (Hover, true),
        (Down, true),
        (Move, false),
        (Move, true),
        (Up, true),
        (Hover, false),
    ];
    assert_eq!(said, expected);
}

#[test]
fn the_third_button_of_a_pen_is_reported() {
    const BTN_STYLUS3: u16 = 0x149;
    let press = |pressed| pen_button(TabletToolButton::Other(BTN_STYLUS3), Some(0.0), pressed);
    let said: Vec<_> = run(&[pen_moved(4.0, None), press(true), press(false)])
        .iter()
        .map(|e| (e.phase, e.sample.buttons.third))
        .collect();
    assert_eq!(said[said.len() - 2..], [(Hover, true), (Hover, false)], "{said:?}");
}

#[test]
fn a_tablet_without_pressure_draws_where_that_is_set() {
    let (mut pen, mut out) = (WinitPen { tip_without_pressure: true, ..WinitPen::new() }, Vec::new());
    pen.event(&pen_button(TabletToolButton::Contact, None, true), 0.0, &mut out);
    assert_eq!(
        out.iter().map(|e| (e.phase, e.sample.pressure)).collect::<Vec<_>>(),
        [(Enter, 0.0), (Down, 0.5)]
    );
}

#[test]
fn turning_the_pen_over_ends_the_tip() {
    let (kind, data) = tablet(TabletToolKind::Eraser, Some(0.5));
    let events = run(&[
        pen_button(TabletToolButton::Contact, Some(0.5), true),
        moved(1.0, 1.0, PointerSource::TabletTool { kind, data }),
        left(PointerKind::TabletTool(TabletToolKind::Pen)),
    ]);
    let said: Vec<_> = events.iter().map(|e| (e.phase, e.sample.tool)).collect();
    let (tip, end) = (PenTool::Pen, PenTool::Eraser);
    assert_eq!(said, [(Enter, tip), (Down, tip), (Up, tip), (Leave, tip), (Enter, end), (Hover, end)]);
}

#[test]
fn losing_the_keyboard_keeps_the_stroke() {
    let press = button(3.0, 4.0, ButtonSource::Mouse(MouseButton::Left), true);
    assert_eq!(
        phases(&[press, WindowEvent::Focused(false), moved(4.0, 4.0, PointerSource::Mouse)]),
        [Enter, Down, Up, Hover]
    );
}

#[test]
fn positions_that_are_none_are_dropped() {
    let press = |x, pressed| button(x, 4.0, ButtonSource::Mouse(MouseButton::Left), pressed);
    let events = [
        moved(f64::NAN, 0.0, PointerSource::Mouse),
        press(1e30, true),
        press(5.0, true),
        moved(0.0, f64::INFINITY, PointerSource::Mouse),
        press(f64::NAN, false),
    ];
    assert_eq!(phases(&events), [Enter, Down, Up]);
}

fn any_event() -> impl Strategy<Value = WindowEvent> {
    let place = prop_oneof![8 => -100.0..2000.0f64, 1 => Just(f64::NAN), 1 => Just(1e30)];
    let force = prop_oneof![Just(None), Just(Some(0.0)), (-0.5..2.0f64).prop_map(Some), Just(Some(f64::NAN))];
    let kinds = [TabletToolKind::Pen, TabletToolKind::Eraser, TabletToolKind::Mouse];
    (0..5u8, 0..6usize, 0..6u16, any::<bool>(), place, force).prop_map(
        move |(what, who, which, pressed, x, force)| {
            let finger_id = FingerId::from_raw(who);
            let touch = force.map(Force::Normalized);
            let (kind, data) = tablet(kinds[who % 3], force);
            let (pointer, source, pressed_by) = match which % 3 {
                0 => {
                    let which = [MouseButton::Left, MouseButton::Right, MouseButton::Middle][who % 3];
                    (PointerKind::Mouse, PointerSource::Mouse, ButtonSource::Mouse(which))
                }
                1 => (
                    PointerKind::Touch(finger_id),
                    PointerSource::Touch { finger_id, force: touch },
                    ButtonSource::Touch { finger_id, force: touch },
                ),
                _ => {
                    let button = [
                        TabletToolButton::Contact,
                        TabletToolButton::Barrel,
                        TabletToolButton::Other(BTN_LEFT),
                    ][usize::from(which / 3) + usize::from(pressed && force.is_none())];
                    (
                        PointerKind::TabletTool(kind),
                        PointerSource::TabletTool { kind, data: data.clone() },
                        ButtonSource::TabletTool { kind, button, data },
                    )
                }
            };
            match what {
                0 => entered(pointer),
                1 => left(pointer),
                2 if who == 0 && which == 0 => WindowEvent::Focused(false),
                2 => moved(x, 7.0, source),
                _ => button(x, 7.0, pressed_by, pressed),
            }
        },
    )
}

proptest! {
    #[test]
    fn any_order_of_window_events_comes_out_in_order(
        events in prop::collection::vec((any_event(), -5.0..50.0f64), 1..300)
    ) {
        let (mut pen, mut out, mut grammar) = (WinitPen::new(), Vec::new(), Grammar::default());
        let mut time_ms = 0.0;
        for (event, wait_ms) in events {
            time_ms += wait_ms;
            out.clear();
            pen.event(&event, time_ms, &mut out);
            prop_assert!(out.len() <= 5, "{out:?}");
            for said in &out {
                prop_assert_eq!(grammar.accept(said), Ok(()));
            }
        }
    }
}

/// What winit's Windows backend sends for a pen that touches, moves and is lifted.
fn windows_stroke(which: TabletToolButton, force: Option<f64>) -> Vec<PenEvent> {
    let pen = PointerKind::TabletTool(TabletToolKind::Pen);
    let said = [
        pen_moved(1.0, None),
        entered(pen),
        pen_button(which, force, true),
        pen_moved(2.0, force),
        // What is held is not named again when the pen is lifted.
        pen_button(TabletToolButton::Contact, None, false),
        left(pen),
        pen_moved(3.0, None),
    ];
    let mut source = WinitPen { tablet_reports: TabletReports::Contacts, ..WinitPen::new() };
    let (mut out, mut grammar) = (Vec::new(), Grammar::default());
    said.iter().enumerate().for_each(|(i, event)| source.event(event, i as f64, &mut out));
    out.iter().for_each(|event| grammar.accept(event).unwrap());
    out
}

#[test]
fn on_windows_the_eraser_end_erases_until_it_leaves() {
    let said = windows_stroke(TabletToolButton::Other(PEN_FLAG_ERASER), Some(0.4));
    let said: Vec<_> = said.iter().map(|e| (e.phase, e.sample.tool)).collect();
    let (pen, eraser) = (PenTool::Pen, PenTool::Eraser);
    let touching = [(Enter, eraser), (Down, eraser), (Move, eraser), (Up, eraser), (Leave, eraser)];
    let expected =
        [vec![(Enter, pen), (Hover, pen), (Leave, pen)], touching.into(), vec![(Enter, pen), (Hover, pen)]];
    assert_eq!(said, expected.concat());
}

#[test]
fn on_windows_a_pen_draws_with_its_barrel_button_held_and_without_pressure() {
    for (which, force, held) in
        [(TabletToolButton::Barrel, Some(0.4), true), (TabletToolButton::Contact, None, false)]
    {
        let said = windows_stroke(which, force);
        let stroke: Vec<_> = said
            .iter()
            .filter(|e| matches!(e.phase, Down | Move | Up))
            .map(|e| (e.phase, e.sample))
            .collect();
        assert_eq!(stroke.iter().map(|(phase, _)| *phase).collect::<Vec<_>>(), [Down, Move, Up], "{which:?}");
        assert_eq!(stroke[0].1.buttons.secondary, held);
        assert!((stroke[1].1.pressure - force.unwrap_or(0.5) as f32).abs() < 1e-6);
        assert!(!stroke[2].1.buttons.secondary);
    }
}
