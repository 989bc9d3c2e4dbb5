//! Pens in the view of the plant.

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
    events.iter().for_each(|event| hand.event(event, shift, view));
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
    let (tell, heard) = channel();
    let (mut hand, mut view) = (PlantHand::default(), view());
    hand.take_up(Some(Box::new(Recorder(tell))), &mut view);
    let (events, before) = (stroke(3.0), view.camera());
    play(&mut hand, &mut view, &events, false);
    let heard: Vec<_> = heard.try_iter().collect();
    let samples: Vec<PenSample> = heard.iter().map(|(_, sample)| *sample).collect();
    assert_eq!(samples, events.iter().map(|event| event.sample).collect::<Vec<_>>());
    assert_eq!((heard[0].0, heard[1].0, heard[10].0), ("begin", "sample", "end"));
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
    hand.event(&event(PenPhase::Down, 40.0, 0.5, Vec2::ZERO), false, &mut view);
    hand.event(&event(PenPhase::Cancel, 40.0, 0.5, Vec2::ZERO), false, &mut view);
    hand.event(&event(PenPhase::Up, 40.0, 0.5, Vec2::ZERO), false, &mut view);
    assert!(!view.has_click());
}
