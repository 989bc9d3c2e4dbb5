//! Pointers in the view of the plant.

use super::*;
use crate::pen::PenButtons;
use glam::{DVec2, Vec2, Vec3};
use std::sync::mpsc::{Sender, channel};

fn event(phase: PenPhase, x: f64, pressure: f32, tilt_deg: Vec2) -> PenEvent {
    let sample = PenSample {
        position: DVec2::new(x, 50.0),
        pressure,
        tilt_deg,
        twist_deg: 30.0,
        distance: 0.0,
        tool: PenTool::Pen,
        buttons: PenButtons { primary: true, ..PenButtons::default() },
        time_ms: x,
    };
    PenEvent { phase, sample }
}

/// Down, ten places each a step further, and up.
fn stroke(step: f64) -> Vec<PenEvent> {
    let at = |phase, k: u8| {
        event(phase, 40.0 + step * f64::from(k), f32::from(k) / 10.0, Vec2::new(f32::from(k), -5.0))
    };
    let mut events = vec![at(PenPhase::Down, 0)];
    events.extend((1..10).map(|k| at(PenPhase::Move, k)));
    events.push(at(PenPhase::Up, 10));
    events
}

fn view() -> PlantView {
    let mut view = PlantView::default();
    view.set_bounds(Some((Vec3::splat(-1.0), Vec3::splat(1.0))));
    view
}

fn play(hand: &mut PlantHand, view: &mut PlantView, events: &[PenEvent], shift: bool) {
    let keys = Keys { shift, ..Keys::default() };
    events.iter().for_each(|event| hand.event(event, keys, view));
}

/// Sends on every sample that it gets.
struct Recorder(Sender<(&'static str, PenSample)>);

impl Tool<PlantView> for Recorder {
    fn begin(&mut self, sample: &PenSample, _: &mut PlantView) {
        self.0.send(("begin", *sample)).unwrap();
    }

    fn sample(&mut self, sample: &PenSample, _: &mut PlantView) {
        self.0.send(("sample", *sample)).unwrap();
    }

    fn end(&mut self, sample: &PenSample, _: &mut PlantView) {
        self.0.send(("end", *sample)).unwrap();
    }

    fn cancel(&mut self, _: &mut PlantView) {}
}

#[test]
fn every_sample_reaches_a_tool_with_pressure_and_tilt() {
    let (sender, received) = channel();
    let (mut hand, mut view) = (PlantHand::default(), view());
    hand.take_up(Some(Box::new(Recorder(sender))), &mut view);
    let (events, before) = (stroke(3.0), view.camera());
    play(&mut hand, &mut view, &events, false);
    let received: Vec<_> = received.try_iter().collect();
    let samples: Vec<PenSample> = received.iter().map(|(_, sample)| *sample).collect();
    assert_eq!(samples, events.iter().map(|event| event.sample).collect::<Vec<_>>());
    assert_eq!((received[0].0, received[1].0, received[10].0), ("begin", "sample", "end"));
    assert_eq!((samples[7].pressure, samples[7].tilt_deg), (0.7, Vec2::new(7.0, -5.0)));
    assert_eq!(view.camera(), before, "it works in the place of the camera's tools");
}

#[test]
fn a_drag_turns_with_shift_or_a_button_it_moves_and_a_tap_picks() {
    let turned = |events: &[PenEvent], shift: bool| {
        let (mut hand, mut view) = (PlantHand::default(), view());
        let before = view.camera();
        play(&mut hand, &mut view, events, shift);
        let now = view.camera();
        (now.yaw_deg != before.yaw_deg, now.target != before.target, view.has_click())
    };
    assert_eq!(turned(&stroke(3.0), false), (true, false, false));
    assert_eq!(turned(&stroke(3.0), true), (false, true, false));
    let mut pressed = stroke(3.0);
    pressed.iter_mut().for_each(|event| event.sample.buttons.secondary = true);
    assert_eq!(turned(&pressed, false), (false, true, false));
    assert_eq!(turned(&stroke(0.1), false), (false, false, true));
}

#[test]
fn a_second_tap_shows_the_front_and_a_touch_that_is_taken_away_picks_nothing() {
    let (mut hand, mut view) = (PlantHand::default(), view());
    play(&mut hand, &mut view, &stroke(0.1), false);
    play(&mut hand, &mut view, &stroke(0.1), false);
    assert!(!view.has_click() && view.is_moving());
    let (mut hand, mut view) = (PlantHand::default(), self::view());
    hand.event(&event(PenPhase::Down, 40.0, 0.5, Vec2::ZERO), Keys::default(), &mut view);
    hand.event(&event(PenPhase::Cancel, 40.0, 0.5, Vec2::ZERO), Keys::default(), &mut view);
    hand.event(&event(PenPhase::Up, 40.0, 0.5, Vec2::ZERO), Keys::default(), &mut view);
    assert!(!view.has_click());
}

/// The same stroke by another pointer.
fn by(tool: PenTool, mut events: Vec<PenEvent>) -> Vec<PenEvent> {
    events.iter_mut().for_each(|event| event.sample.tool = tool);
    events
}

#[test]
fn mice_and_fingers_go_the_way_of_pens() {
    for tool in [PenTool::Mouse, PenTool::Finger(3)] {
        let (mut hand, mut view) = (PlantHand::default(), view());
        let before = view.camera();
        play(&mut hand, &mut view, &by(tool, stroke(3.0)), false);
        assert_ne!(view.camera().yaw_deg, before.yaw_deg, "{tool:?}");
        play(&mut hand, &mut view, &by(tool, stroke(0.1)), false);
        assert!(view.has_click(), "{tool:?}");
    }
}

#[test]
fn a_mouse_moves_the_camera_with_its_other_buttons() {
    let (mut hand, mut view) = (PlantHand::default(), view());
    let before = view.camera();
    let mut events = by(PenTool::Mouse, stroke(3.0));
    for (k, event) in events.iter_mut().enumerate() {
        event.phase = PenPhase::Hover;
        event.sample.buttons = PenButtons { secondary: k < 10, ..PenButtons::default() };
    }
    play(&mut hand, &mut view, &events, false);
    let after = view.camera();
    assert!(after.target != before.target && after.yaw_deg == before.yaw_deg);
    play(&mut hand, &mut view, &by(PenTool::Mouse, stroke(0.1)), false);
    assert!(view.has_click(), "the button was let go");
}

#[test]
fn two_fingers_move_zoom_and_turn_together() {
    let (mut hand, mut view) = (PlantHand::default(), view());
    let before = view.camera();
    let at = |phase, finger: u64, x: f64, y: f64| {
        let mut event = event(phase, x, 0.5, Vec2::ZERO);
        (event.sample.tool, event.sample.position, event.sample.time_ms) =
            (PenTool::Finger(finger), DVec2::new(x, y), 0.0);
        event
    };
    let down = [at(PenPhase::Down, 1, 100.0, 100.0), at(PenPhase::Down, 2, 200.0, 100.0)];
    let apart = [at(PenPhase::Move, 2, 280.0, 100.0), at(PenPhase::Move, 2, 300.0, 100.0)];
    play(&mut hand, &mut view, &down, false);
    play(&mut hand, &mut view, &apart, false);
    let zoomed = view.camera();
    assert!(zoomed.distance < before.distance && zoomed.yaw_deg == before.yaw_deg);
    play(&mut hand, &mut view, &[at(PenPhase::Move, 2, 300.0, 160.0)], false);
    assert_ne!(view.camera().yaw_deg, zoomed.yaw_deg);
    play(
        &mut hand,
        &mut view,
        &[at(PenPhase::Up, 2, 300.0, 160.0), at(PenPhase::Up, 1, 100.0, 100.0)],
        false,
    );
    assert!(!view.has_click(), "that was no tap");
}

#[test]
fn what_is_selected_is_carried_and_not_turned() {
    let (mut hand, mut view) = (PlantHand::default(), view());
    let before = view.camera();
    let keys = Keys { over_carried: true, ..Keys::default() };
    for event in stroke(3.0) {
        hand.event(&event, keys, &mut view);
    }
    let (from, to) = view.take_carried().unwrap();
    assert_eq!((from.x, to.x, view.take_carried()), (40.0, 70.0, None));
    assert_eq!(view.camera(), before);
}
