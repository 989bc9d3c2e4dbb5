//! Anything a device may send: the drawing stays sound.

use super::*;

#[test]
fn positions_that_are_none_end_no_stroke_and_spoil_none() {
    let mut fixture = Fixture::new();
    fixture.say(Down, PEN, (10.0, 10.0));
    fixture.say(Move, PEN, (f64::NAN, 10.0));
    fixture.say(Move, PEN, (1e30, 10.0));
    fixture.say(Move, PEN, (50.0, 10.0));
    fixture.say(Up, PEN, (f64::NAN, f64::INFINITY));
    let places: Vec<_> = fixture.strokes[0].points.iter().map(|p| p.position.x).collect();
    assert_eq!(places, [10.0, 50.0]);
}

const TOOLS: [CanvasTool; 5] = [
    CanvasTool::Draw(Tool::Petal),
    CanvasTool::Erase { partial: true },
    CanvasTool::Erase { partial: false },
    CanvasTool::Select,
    CanvasTool::Pan,
];

proptest! {
    #[test]
    fn whatever_hands_do_the_drawing_stays_sound(
        events in random_hand(150), choices in prop::collection::vec(any::<u16>(), 150), fingers_draw in any::<bool>()
    ) {
        let mut fixture = Fixture::with_lines(6);
        fixture.canvas.settings.fingers_draw = fingers_draw;
        let mut growing = None;
        for (event, choice) in events.iter().zip(&choices) {
            fixture.out.clear();
            match choice % 23 {
                n @ 0..=4 => drop(fixture.act(&Action::SetTool(TOOLS[usize::from(n)]))),
                5 => drop(fixture.act(&Action::SelectAll)),
                6 => drop(fixture.act(&Action::DuplicateSelected)),
                7 => drop(fixture.act(&Action::DeleteSelected)),
                8 => drop(fixture.act(&Action::SetPart(Tool::Leaf))),
                9 => fixture.key(CanvasKey::Escape, true),
                10 => fixture.key(CanvasKey::Space, choice & 64 != 0),
                11 => fixture.key(CanvasKey::Shift, choice & 64 != 0),
                12 => fixture.canvas.wheel(Scroll::Lines(DVec2::new(0.0, f64::from(*choice % 7) - 3.0)), event.sample.position, &mut fixture.out),
                _ => {}
            }
            fixture.event(event);
            for outcome in &fixture.out {
                match outcome {
                    CanvasOutcome::StrokeBegan(id) => prop_assert!(growing.replace(*id).is_none()),
                    CanvasOutcome::StrokeGrew { .. } => prop_assert!(growing.is_some()),
                    CanvasOutcome::StrokeFinished(stroke) => prop_assert_eq!(growing.take(), Some(stroke.id)),
                    CanvasOutcome::StrokeCancelled(id) => prop_assert_eq!(growing.take(), Some(*id)),
                    CanvasOutcome::Changed(changes) => prop_assert!(!changes.is_empty()),
                    _ => {}
                }
            }
            prop_assert_eq!(fixture.canvas.growing().map(|s| s.id()), growing);
            let overlay = fixture.canvas.overlay();
            prop_assert!(overlay.frame.is_none_or(|f| f.iter().all(|p| p.is_finite())));
            let seen = fixture.canvas.previewed(&fixture.strokes);
            let sketch = crate::sketch::Sketch { strokes: seen, ..crate::sketch::Sketch::empty() };
            prop_assert_eq!(sketch.check_invariants(), Ok(()));
            prop_assert!(fixture.selected().iter().all(|id| fixture.ids().contains(id)));
        }
    }

    #[test]
    fn hostile_numbers_do_no_harm(
        events in prop::collection::vec((any::<u8>(), any::<u8>(), prop::array::uniform5(any::<f64>())), 1..60)
    ) {
        let phases = [Enter, Hover, Down, Move, Up, Leave, Cancel];
        let tools = [PEN, PenTool::Eraser, MOUSE, PenTool::Finger(1), PenTool::Finger(2)];
        let mut fixture = Fixture::with_lines(2);
        for (phase, tool, [x, y, pressure, tilt, time]) in events {
            fixture.canvas.tool = TOOLS[usize::from(phase / 50).min(4)];
            let mut event = fixture.hand.event(phases[usize::from(phase) % 7], tools[usize::from(tool) % 5], time);
            event.sample.position = DVec2::new(x, y) * if tool > 128 { 1e-300 } else { 1.0 };
            event.sample.pressure = pressure as f32;
            event.sample.tilt_deg = Vec2::splat(tilt as f32);
            fixture.event(&event);
        }
        for stroke in &fixture.strokes {
            prop_assert!(stroke.points.iter().all(|p| p.position.is_finite() && (0.0..=1.0).contains(&p.pressure)));
            prop_assert!(stroke.points.iter().all(|p| p.tilt_deg.abs().max_element() <= 90.0 && p.time_ms >= 0.0));
        }
    }
}
