//! What pens do over a window, and what no pen would do.

use super::*;
use crate::pen::grammar::Grammar;
use crate::pen::x11::devices::tests::{any_axes, any_pen, tablet_pen};
use crate::pen::x11::follow::{HOVER_MS, PenFollower};
use crate::pen::{PenEvent, PenPhase, PenTool};
use proptest::prelude::*;
use x11rb::protocol::xinput::Fp3232;

const PEN: u16 = 7;
const ERASER: u16 = 8;

fn press(device: u16, detail: u32, held: u32, time: u32) -> ButtonPressEvent {
    ButtonPressEvent {
        sourceid: device,
        deviceid: device,
        time,
        detail,
        event_x: 100 << 16 | 0x8000,
        event_y: 40 << 16,
        button_mask: vec![held],
        ..ButtonPressEvent::default()
    }
}

fn with_pressure(event: ButtonPressEvent, share: f64) -> ButtonPressEvent {
    let value = Fp3232 { integral: (share * 65536.0) as i32, frac: 0 };
    ButtonPressEvent { valuator_mask: vec![0b100], axisvalues: vec![value], ..event }
}

fn moved(device: u16, held: u32, time: u32) -> Event {
    Event::XinputMotion(press(device, 0, held, time))
}

fn left(device: u16, time: u32) -> Event {
    Event::XinputLeave(EnterEvent { sourceid: device, deviceid: 2, time, ..EnterEvent::default() })
}

fn decoder() -> Decoder {
    let mut decoder = Decoder::default();
    decoder.set_pens(vec![tablet_pen(PEN, "pen"), tablet_pen(ERASER, "eraser")], |_| unreachable!());
    decoder
}

/// What the canvas receives of these events.
fn run(events: &[Event]) -> Vec<PenEvent> {
    let (mut decoder, mut follower, mut out) = (decoder(), PenFollower::default(), Vec::new());
    for reading in events.iter().filter_map(|event| decoder.decode(event)) {
        follower.feed(&reading, f64::from(reading.stamp), &mut out);
    }
    let mut grammar = Grammar::default();
    out.iter().for_each(|event| grammar.accept(event).unwrap());
    out
}

fn phases(events: &[Event]) -> Vec<(PenPhase, PenTool)> {
    run(events).iter().map(|event| (event.phase, event.sample.tool)).collect()
}

use PenPhase::*;

#[test]
fn a_stroke_keeps_every_sample_and_parts_of_pixels() {
    let mut events =
        vec![moved(PEN, 0, 1), Event::XinputButtonPress(with_pressure(press(PEN, 1, 0, 2), 0.25))];
    for i in 0..20 {
        events.push(Event::XinputMotion(with_pressure(press(PEN, 0, 0b10, 2), 0.25 + 0.01 * f64::from(i))));
    }
    events.push(Event::XinputButtonRelease(press(PEN, 1, 0b10, 3)));
    let said = run(&events);
    assert_eq!(said.len(), events.len());
    assert_eq!(said[1].sample.pressure, 0.25);
    assert!((said[21].sample.pressure - 0.44).abs() < 1e-4);
    assert!((said[5].sample.position - DVec2::new(100.5, 40.0)).length() < 1e-6);
    assert_eq!((said[22].phase, said[22].sample.pressure), (Up, 0.0));
}

/// What an Xorg of 1280 by 800 sent for a pen at the step 7351, 7770 that had been at 7000, 7400 before.
fn servers_mix() -> ButtonPressEvent {
    let part = |pixels: i32, part: f64| (pixels << 16) + (part * 65536.0) as i32;
    let steps = [7351, 7770].map(|integral| Fp3232 { integral, frac: 0 });
    let (x, y) = (7351.0f64 * 1280.0 / 44801.0, 7770.0f64 * 800.0 / 29601.0);
    ButtonPressEvent {
        root_x: part(199, x.fract()),
        root_y: part(199, y.fract()),
        event_x: part(189, x.fract()),
        event_y: part(179, y.fract()),
        valuator_mask: vec![0b11],
        axisvalues: steps.to_vec(),
        ..press(PEN, 0, 0, 1)
    }
}

#[test]
fn the_place_is_made_from_the_axes_where_the_server_places_the_pointer_by_them() {
    let mut decoder = decoder();
    decoder.set_desktop(DVec2::new(1280.0, 800.0));
    let there = decoder.decode(&Event::XinputMotion(servers_mix())).unwrap().position;
    assert!((there - DVec2::new(200.024, 189.993)).abs().max_element() < 1e-3, "{there}");
    // Elsewhere the server knows better.
    decoder.set_desktop(DVec2::new(3840.0, 1000.0));
    let there = decoder.decode(&Event::XinputMotion(servers_mix())).unwrap().position;
    assert!((there - DVec2::new(189.024, 179.993)).abs().max_element() < 1e-3, "{there}");
}

#[test]
fn a_button_without_place_happens_where_the_pen_was() {
    let place = Fp3232 { integral: 300, frac: 0 };
    let there = ButtonPressEvent { valuator_mask: vec![1], axisvalues: vec![place], ..press(PEN, 0, 0, 1) };
    let rounded = ButtonPressEvent { event_x: 101 << 16, ..press(PEN, 1, 0, 2) };
    let said = run(&[Event::XinputMotion(there), Event::XinputButtonPress(rounded)]);
    assert_eq!(said[1].phase, Down);
    assert!((said[1].sample.position - DVec2::new(100.5, 40.0)).length() < 1e-6);
}

#[test]
fn barrel_buttons_are_reported_while_hovering() {
    let said = run(&[
        moved(PEN, 0, 1),
        Event::XinputButtonPress(press(PEN, 2, 0, 2)),
        Event::XinputButtonPress(press(PEN, 3, 0b100, 3)),
        Event::XinputButtonRelease(press(PEN, 2, 0b1100, 4)),
        Event::XinputButtonPress(press(PEN, 9, 0b1000, 5)),
    ]);
    let held: Vec<_> =
        said.iter().map(|e| (e.phase, e.sample.buttons.secondary, e.sample.buttons.middle)).collect();
    assert_eq!(
        held,
        [(Enter, false, false), (Hover, true, false), (Hover, true, true), (Hover, false, true)]
    );
}

#[test]
fn turning_the_pen_over_lifts_it_first() {
    let (pen, eraser) = (PenTool::Pen, PenTool::Eraser);
    let events = [
        moved(PEN, 0, 1),
        Event::XinputButtonPress(press(PEN, 1, 0, 2)),
        Event::XinputButtonPress(press(ERASER, 1, 0, 3)),
        moved(ERASER, 0b10, 4),
    ];
    let expected =
        [(Enter, pen), (Down, pen), (Up, pen), (Leave, pen), (Enter, eraser), (Down, eraser), (Move, eraser)];
    assert_eq!(phases(&events), expected);
}

#[test]
fn a_stroke_over_the_edge_of_the_window_goes_on_and_the_pen_leaves_when_lifted() {
    let events = [
        moved(PEN, 0, 1),
        Event::XinputButtonPress(press(PEN, 1, 0, 2)),
        left(PEN, 3),
        moved(PEN, 0b10, 4),
        Event::XinputButtonRelease(press(PEN, 1, 0b10, 5)),
    ];
    let said: Vec<_> = phases(&events).iter().map(|(phase, _)| *phase).collect();
    assert_eq!(said, [Enter, Down, Move, Up, Leave]);
}

#[test]
fn a_lost_release_ends_the_stroke_with_the_next_motion() {
    let events = [moved(PEN, 0, 1), Event::XinputButtonPress(press(PEN, 1, 0, 2)), moved(PEN, 0, 3)];
    assert_eq!(phases(&events).last(), Some(&(Up, PenTool::Pen)));
}

#[test]
fn mice_are_somebody_elses() {
    assert_eq!(phases(&[moved(4, 0, 1), Event::XinputButtonPress(press(4, 1, 0, 2)), left(4, 3)]), []);
}

#[test]
fn an_unplugged_pen_is_lifted_and_leaves() {
    let (mut decoder, mut follower, mut out) = (decoder(), PenFollower::default(), Vec::new());
    let reading = decoder.decode(&Event::XinputButtonPress(press(PEN, 1, 0, 2))).unwrap();
    follower.feed(&reading, 2.0, &mut out);
    let mut gone = Vec::new();
    decoder.set_pens(vec![tablet_pen(ERASER, "eraser")], |reading| gone.push(reading));
    assert_eq!(gone.len(), 1);
    follower.feed(&gone[0], 3.0, &mut out);
    assert_eq!(out.iter().map(|e| e.phase).collect::<Vec<_>>(), [Enter, Down, Up, Leave]);
    assert_eq!(decoder.decode(&moved(PEN, 0, 4)), None);
}

#[test]
fn a_list_of_devices_asked_again_changes_nothing_in_the_hand() {
    let mut decoder = decoder();
    let pressed = with_pressure(press(PEN, 1, 0, 2), 0.75);
    let before = decoder.decode(&Event::XinputButtonPress(pressed)).unwrap();
    decoder.set_pens(vec![tablet_pen(PEN, "pen")], |reading| assert_eq!(reading.device, ERASER));
    let after = decoder.decode(&moved(PEN, 0b10, 3)).unwrap();
    assert_eq!((after.state.pressure, after.state.touches), (before.state.pressure, true));
}

#[test]
fn a_silent_pen_leaves_unless_it_touches() {
    let (mut decoder, mut follower, mut out) = (decoder(), PenFollower::default(), Vec::new());
    let mut handle = |event, time_ms, follower: &mut PenFollower, out: &mut Vec<_>| {
        follower.feed(&decoder.decode(&event).unwrap(), time_ms, out);
    };
    handle(moved(PEN, 0, 1), 10.0, &mut follower, &mut out);
    follower.idle(10.0 + HOVER_MS - 1.0, &mut out);
    assert_eq!(out.len(), 1);
    handle(Event::XinputButtonPress(press(PEN, 1, 0, 2)), 20.0, &mut follower, &mut out);
    assert_eq!(follower.leaves_at(), None);
    follower.idle(1e6, &mut out);
    handle(Event::XinputButtonRelease(press(PEN, 1, 0b10, 3)), 30.0, &mut follower, &mut out);
    assert_eq!(follower.leaves_at(), Some(30.0 + HOVER_MS));
    follower.idle(30.0 + HOVER_MS, &mut out);
    follower.idle(1e6, &mut out);
    assert_eq!(out.iter().map(|e| e.phase).collect::<Vec<_>>(), [Enter, Down, Up, Leave]);
}

#[test]
fn neither_the_mouse_nor_a_pen_that_hovers_ends_another_pens_stroke() {
    let (mut decoder, mut follower, mut out) = (decoder(), PenFollower::default(), Vec::new());
    let mut handle = |event, time_ms, follower: &mut PenFollower, out: &mut Vec<_>| {
        follower.feed(&decoder.decode(&event).unwrap(), time_ms, out);
    };
    handle(Event::XinputButtonPress(press(PEN, 1, 0, 1)), 1.0, &mut follower, &mut out);
    follower.other_device(2.0, &mut out);
    handle(moved(ERASER, 0, 3), 3.0, &mut follower, &mut out);
    handle(Event::XinputButtonRelease(press(PEN, 1, 0b10, 4)), 4.0, &mut follower, &mut out);
    follower.other_device(5.0, &mut out);
    assert_eq!(out.iter().map(|e| e.phase).collect::<Vec<_>>(), [Enter, Down, Up, Leave]);
}

fn any_event() -> impl Strategy<Value = Event> {
    let numbers = (any::<i32>(), any::<i32>(), any::<u32>(), 0..10u32, 0..4u16);
    (0..6u8, numbers, any_axes()).prop_map(|(what, (x, y, time, detail, device), (mask, values))| {
        let event = ButtonPressEvent {
            event_x: x,
            event_y: y,
            valuator_mask: mask,
            axisvalues: values,
            ..press(device, detail, time, time)
        };
        let crossing = EnterEvent { sourceid: device, event_x: x, event_y: y, time, ..EnterEvent::default() };
        match what {
            0 | 1 => Event::XinputMotion(event),
            2 => Event::XinputButtonPress(event),
            3 => Event::XinputButtonRelease(event),
            4 => Event::XinputLeave(crossing),
            _ => Event::XinputEnter(crossing),
        }
    })
}

proptest! {
    #[test]
    fn any_order_of_events_from_any_devices_comes_out_in_order(
        pens in prop::collection::vec((0..4u16).prop_flat_map(any_pen), 0..4),
        steps in prop::collection::vec((any_event(), -500.0..2500.0f64, 0..20u8), 1..200),
    ) {
        let (mut decoder, mut follower, mut grammar) = (Decoder::default(), PenFollower::default(), Grammar::default());
        let (mut out, mut time_ms) = (Vec::new(), 0.0);
        decoder.set_pens(pens.clone(), |_| {});
        decoder.set_desktop(DVec2::new(1280.0, 800.0));
        for (event, wait_ms, also) in steps {
            time_ms += wait_ms;
            out.clear();
            if let Some(reading) = decoder.decode(&event) {
                follower.feed(&reading, time_ms, &mut out);
            }
            match also {
                0 => follower.other_device(time_ms, &mut out),
                1 => follower.idle(time_ms, &mut out),
                2 => decoder.set_pens(Vec::new(), |reading| follower.feed(&reading, time_ms, &mut out)),
                3 => decoder.set_pens(pens.clone(), |reading| follower.feed(&reading, time_ms, &mut out)),
                4 => follower.idle(f64::NAN, &mut out),
                _ => {}
            }
            for said in &out {
                prop_assert_eq!(grammar.accept(said), Ok(()));
            }
        }
    }
}
