//! Tests of the machine behind every source that reports states.

use super::*;
use crate::pen::grammar::Grammar;
use crate::pen::mapping::{Rect, Turn};
use PenPhase::*;
use PenTool::{Eraser, Pen};
use glam::DVec2;
use proptest::prelude::*;

const AWAY: RawPen = RawPen {
    in_range: false,
    touches: false,
    eraser: false,
    barrel: [false; 3],
    position: DVec2::ZERO,
    pressure: None,
    tilt_deg: Vec2::ZERO,
    twist_deg: 0.0,
    distance: 0.0,
    serial: 0,
};
const HOVERS: RawPen = RawPen { in_range: true, pressure: Some(0.25), ..AWAY };
const TOUCHES: RawPen = RawPen { touches: true, ..HOVERS };
const TURNED: RawPen = RawPen { eraser: true, ..HOVERS };
const ERASES: RawPen = RawPen { touches: true, ..TURNED };

fn window() -> Mapping {
    Mapping::new(Rect { min: DVec2::ZERO, max: DVec2::new(1000.0, 500.0) })
}

/// Feeds samples 5 ms apart and says what happened.
fn run(samples: &[RawPen]) -> Vec<(PenPhase, PenTool)> {
    let (mut machine, mut grammar, mut out) = (PenMachine::new(window()), Grammar::default(), Vec::new());
    for (number, raw) in samples.iter().enumerate() {
        machine.sample(raw, number as f64 * 5.0, &mut out);
    }
    out.iter().for_each(|event| assert_eq!(grammar.accept(event), Ok(())));
    out.iter().map(|event| (event.phase, event.sample.tool)).collect()
}

#[test]
fn a_stroke_goes_through_all_states() {
    let phases = run(&[HOVERS, HOVERS, TOUCHES, TOUCHES, HOVERS, AWAY, AWAY]);
    assert_eq!(phases, [Enter, Hover, Down, Move, Up, Leave].map(|p| (p, Pen)));
}

#[test]
fn what_slow_tablets_leave_out_is_put_in() {
    assert_eq!(run(&[TOUCHES]), [(Enter, Pen), (Down, Pen)]);
    assert_eq!(run(&[TOUCHES, AWAY])[2..], [(Up, Pen), (Leave, Pen)]);
    assert_eq!(run(&[ERASES, AWAY])[2..], [(Up, Eraser), (Leave, Eraser)]);
    let touching_afar = RawPen { in_range: false, ..TOUCHES };
    assert_eq!(run(&[touching_afar]), [(Enter, Pen), (Down, Pen)], "what touches is in range");
}

#[test]
fn the_ends_of_a_pen_change_over_out_of_range() {
    let jump = [(Up, Pen), (Leave, Pen), (Enter, Eraser), (Down, Eraser)];
    assert_eq!(run(&[TOUCHES, ERASES])[2..], jump);
    assert_eq!(run(&[HOVERS, TURNED])[1..], [(Leave, Pen), (Enter, Eraser)]);
    assert_eq!(run(&[TOUCHES, TURNED])[2..], jump[..3]);
    assert_eq!(run(&[HOVERS, ERASES])[1..], [(Leave, Pen), (Enter, Eraser), (Down, Eraser)]);
}

#[test]
fn a_sample_has_its_place_pressure_and_buttons() {
    let (mut machine, mut out) = (PenMachine::new(window()), Vec::new());
    let raw = RawPen {
        barrel: [true, false, true],
        position: DVec2::new(0.25, 0.5),
        tilt_deg: Vec2::new(30.0, -20.0),
        twist_deg: 10.0,
        distance: 0.5,
        ..TOUCHES
    };
    machine.sample(&RawPen { touches: false, ..raw }, 1.0, &mut out);
    machine.sample(&raw, 2.0, &mut out);
    machine.sample(&RawPen { pressure: None, ..raw }, 3.0, &mut out);
    machine.leave(4.0, &mut out);
    let entered = PenSample {
        position: DVec2::new(250.0, 250.0),
        pressure: 0.0,
        tilt_deg: Vec2::new(30.0, -20.0),
        twist_deg: 10.0,
        distance: 0.5,
        tool: Pen,
        buttons: PenButtons { primary: false, secondary: true, middle: false, third: true },
        time_ms: 1.0,
    };
    assert_eq!(out[0], PenEvent { phase: Enter, sample: entered });
    let buttons = PenButtons { primary: true, ..entered.buttons };
    let down = PenSample { pressure: 0.25, distance: 0.0, buttons, time_ms: 2.0, ..entered };
    assert_eq!(out[1], PenEvent { phase: Down, sample: down });
    assert_eq!(out[2].sample.pressure, StrokePoint::NEUTRAL_PRESSURE);
    assert_eq!(out[4].sample.buttons, PenButtons::default(), "buttons go with the pen");
    assert_eq!(machine.state(), None);
}

#[test]
fn a_silent_pen_leaves_after_100_ms() {
    let (mut machine, mut out) = (PenMachine::new(window()), Vec::new());
    machine.sample(&TOUCHES, 1000.0, &mut out);
    machine.idle(1099.0, Silence::KNOWN, &mut out);
    assert_eq!(out.len(), 2);
    machine.idle(1100.0, Silence::KNOWN, &mut out);
    assert_eq!(out[2..].iter().map(|e| e.phase).collect::<Vec<_>>(), [Up, Leave]);
    machine.idle(1300.0, Silence::KNOWN, &mut out);
    machine.leave(1300.0, &mut out);
    assert_eq!(out.len(), 4, "it leaves once");
}

#[test]
fn where_silence_is_a_guess_only_a_hovering_pen_leaves() {
    let (mut machine, mut out) = (PenMachine::new(window()), Vec::new());
    machine.sample(&TOUCHES, 0.0, &mut out);
    machine.idle(1e6, Silence::LIKELY, &mut out);
    assert_eq!(out.len(), 2, "a pen that rests goes on touching");
    machine.sample(&RawPen { touches: false, ..TOUCHES }, 1e6, &mut out);
    machine.idle(1e6 + Silence::LIKELY.after_ms - 1.0, Silence::LIKELY, &mut out);
    assert_eq!(out.last().map(|e| e.phase), Some(Up));
    machine.idle(1e6 + Silence::LIKELY.after_ms, Silence::LIKELY, &mut out);
    assert_eq!(out.last().map(|e| e.phase), Some(Leave));
}

#[test]
fn time_never_goes_back_and_places_that_are_none_count_as_the_last() {
    let (mut machine, mut out) = (PenMachine::new(window()), Vec::new());
    machine.sample(&RawPen { position: DVec2::NAN, ..TOUCHES }, 0.0, &mut out);
    assert!(out.is_empty(), "a pen that was never anywhere is nowhere");
    machine.sample(&RawPen { position: DVec2::ONE, ..HOVERS }, 10.0, &mut out);
    machine.sample(&RawPen { position: DVec2::NAN, ..TOUCHES }, f64::NAN, &mut out);
    machine.sample(&TOUCHES, 4.0, &mut out);
    let reported: Vec<_> = out.iter().map(|e| (e.phase, e.sample.position.x, e.sample.time_ms)).collect();
    assert_eq!(reported, [(Enter, 1000.0, 10.0), (Down, 1000.0, 10.0), (Move, 0.0, 10.0)]);
}

/// Numbers as broken devices send them.
fn odd() -> impl Strategy<Value = f64> {
    prop_oneof![4 => 0.0..1.0f64, 1 => prop::num::f64::ANY]
}

fn raw_pen() -> impl Strategy<Value = RawPen> {
    let numbers = (odd(), odd(), prop::option::of(odd()), odd(), odd(), odd(), odd());
    (any::<[bool; 6]>(), numbers, any::<u64>()).prop_map(
        |(flags, (x, y, pressure, a, b, twist, z), serial)| {
            let [in_range, touches, eraser, barrel @ ..] = flags;
            RawPen {
                in_range,
                touches,
                eraser,
                barrel,
                position: DVec2::new(x, y),
                pressure: pressure.map(|p| p as f32),
                tilt_deg: Vec2::new(a as f32, b as f32) * 90.0,
                twist_deg: twist as f32 * 720.0 - 180.0,
                distance: z as f32,
                serial,
            }
        },
    )
}

fn any_mapping() -> impl Strategy<Value = Mapping> {
    let number = || prop_oneof![9 => -2e3..2e3f64, 1 => prop::num::f64::ANY];
    ([number(), number(), number(), number()], [odd(), odd()], 0..Turn::ALL.len(), any::<bool>()).prop_map(
        |([a, b, c, d], area, turn, keeps)| {
            let target = Rect { min: DVec2::new(a, b), max: DVec2::new(c, d) };
            let whole = Mapping::turned(target, Turn::ALL[turn]);
            if keeps { whole.keep_aspect(DVec2::from(area)) } else { whole }
        },
    )
}

proptest! {
    #[test]
    fn whatever_a_tablet_says_the_grammar_holds(
        steps in prop::collection::vec((raw_pen(), any::<u8>(), -20.0..200.0f64), 1..200), mapping in any_mapping(),
    ) {
        let (mut machine, mut grammar, mut out) = (PenMachine::new(window()), Grammar::default(), Vec::new());
        let mut time_ms = 0.0;
        for (number, (raw, choice, wait_ms)) in steps.iter().enumerate() {
            time_ms += wait_ms;
            out.clear();
            match choice {
                0..=4 => machine.idle(time_ms, Silence::KNOWN, &mut out),
                5..=9 => machine.idle(time_ms, Silence { after_ms: 50.0, lifts: false }, &mut out),
                10..=14 => machine.leave(f64::NAN, &mut out),
                15..=19 => machine.set_mapping(mapping),
                _ => machine.sample(raw, time_ms, &mut out),
            }
            prop_assert!(out.len() <= 5);
            for event in &out {
                prop_assert_eq!(grammar.accept(event), Ok(()), "step {}", number);
            }
            let touching: Vec<_> = grammar.touching().collect();
            prop_assert_eq!(touching, machine.state().filter(|s| s.1).map(|s| s.0).into_iter().collect::<Vec<_>>());
        }
    }
}
