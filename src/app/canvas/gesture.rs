//! Touch gestures: what several fingers mean together.
//!
//! One finger draws or moves the canvas, as the artist chose; two move, scale and turn it together; a short tap with two
//! fingers takes back, with three does again. A second finger that lands shortly after the first, or before the first has
//! moved, turns the beginning stroke into a gesture: the stroke is cancelled. A finger that lands later, while another
//! draws, is ignored. Distances are logical pixels, so that fingers mean the same on every screen.

use crate::pen::{PenEvent, PenPhase, PenSample, PenTool};
use glam::DVec2;

/// Longest tap, from the first finger's landing to the last one's lifting, in milliseconds.
pub const TAP_MS: f64 = 250.0;

/// Farthest that a finger moves in a tap, in logical pixels.
pub const TAP_SLOP: f64 = 12.0;

/// How long after the first finger a second one still makes a gesture of a stroke, in milliseconds.
pub const SECOND_FINGER_MS: f64 = 200.0;

/// What fingers mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Touch {
    /// One finger draws: its events, as of any other tool. The stroke ends with `Up` or `Cancel`.
    Draw(PenEvent),
    /// One finger moves the canvas by window pixels.
    Pan(DVec2),
    /// Two fingers carry the canvas from one place to another.
    Pair {
        /// Where they were.
        from: [DVec2; 2],
        /// Where they are.
        to: [DVec2; 2],
    },
    /// The canvas was let go.
    Settled,
    /// A short tap with so many fingers, two or more.
    Tap(usize),
}

#[derive(Clone, Copy, Debug)]
struct Finger {
    tool: PenTool,
    start: DVec2,
    last: DVec2,
}

/// What the fingers on the screen do together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Mode {
    /// No finger, or none that counts.
    #[default]
    Idle,
    /// This finger draws.
    Draw(PenTool),
    /// Fingers hold the canvas; it moves once they moved further than a tap.
    Hold { moving: bool },
    /// What remains of the fingers does nothing until all are lifted.
    Spent,
}

/// Follows the fingers.
#[derive(Clone, Debug)]
pub struct TouchGestures {
    /// Whether one finger draws; otherwise it moves the canvas.
    pub one_finger_draws: bool,
    /// Physical pixels per logical pixel.
    pub scale_factor: f64,
    fingers: Vec<Finger>,
    mode: Mode,
    most_fingers: usize,
    began_ms: f64,
    last_drawn: Option<PenSample>,
    /// Whether everything so far could be a tap.
    is_tap: bool,
}

impl Default for TouchGestures {
    fn default() -> Self {
        Self {
            one_finger_draws: true,
            scale_factor: 1.0,
            fingers: Vec::new(),
            mode: Mode::Idle,
            most_fingers: 0,
            began_ms: 0.0,
            last_drawn: None,
            is_tap: false,
        }
    }
}

impl TouchGestures {
    /// Takes an event of a finger and appends what it means to `out`; events of other tools mean nothing here.
    pub fn event(&mut self, event: &PenEvent, out: &mut Vec<Touch>) {
        if !matches!(event.sample.tool, PenTool::Finger(_)) {
            return;
        }
        match event.phase {
            PenPhase::Down => self.down(event, out),
            PenPhase::Move => self.moved(event, out),
            PenPhase::Up | PenPhase::Cancel => self.lifted(event, out),
            PenPhase::Enter | PenPhase::Hover | PenPhase::Leave => {}
        }
    }

    /// Whether fingers draw or hold the canvas.
    pub fn is_busy(&self) -> bool {
        self.mode != Mode::Idle
    }

    /// What was drawn does not count, and fingers that touch do nothing until lifted.
    pub fn forget(&mut self) {
        self.is_tap = false;
        self.mode = if self.fingers.is_empty() { Mode::Idle } else { Mode::Spent };
    }

    fn down(&mut self, event: &PenEvent, out: &mut Vec<Touch>) {
        let PenSample { tool, position, time_ms, .. } = event.sample;
        self.fingers.retain(|f| f.tool != tool);
        if self.fingers.is_empty() {
            (self.most_fingers, self.began_ms, self.is_tap) = (0, time_ms, true);
        }
        self.fingers.push(Finger { tool, start: position, last: position });
        self.most_fingers = self.most_fingers.max(self.fingers.len());
        match self.mode {
            _ if self.fingers.len() == 1 && self.one_finger_draws => {
                self.mode = Mode::Draw(tool);
                self.draw(*event, out);
            }
            Mode::Draw(_) if time_ms - self.began_ms <= SECOND_FINGER_MS || self.is_tap => {
                self.cancel_drawing(time_ms, out);
                self.mode = Mode::Hold { moving: false };
            }
            Mode::Draw(_) | Mode::Spent => {}
            Mode::Idle => self.mode = Mode::Hold { moving: false },
            Mode::Hold { .. } => {}
        }
    }

    fn moved(&mut self, event: &PenEvent, out: &mut Vec<Touch>) {
        let PenSample { tool, position, .. } = event.sample;
        let before = self.pair();
        let Some(finger) = self.fingers.iter_mut().find(|f| f.tool == tool) else { return };
        let from = std::mem::replace(&mut finger.last, position);
        if position.distance(finger.start) > TAP_SLOP * self.scale_factor {
            self.is_tap = false;
        }
        match self.mode {
            Mode::Draw(drawing) if drawing == tool => self.draw(*event, out),
            Mode::Hold { moving: false } if !self.is_tap => self.mode = Mode::Hold { moving: true },
            Mode::Hold { moving: true } => match (before, self.pair()) {
                (Some(from), Some(to)) if from != to => out.push(Touch::Pair { from, to }),
                (None, None) => out.push(Touch::Pan(position - from)),
                _ => {}
            },
            _ => {}
        }
    }

    fn lifted(&mut self, event: &PenEvent, out: &mut Vec<Touch>) {
        let PenSample { tool, position, time_ms, .. } = event.sample;
        let Some(place) = self.fingers.iter().position(|f| f.tool == tool) else { return };
        let finger = self.fingers.remove(place);
        let is_cancelled = event.phase == PenPhase::Cancel;
        let is_far = position.distance(finger.start) > TAP_SLOP * self.scale_factor;
        if is_cancelled || is_far || time_ms - self.began_ms > TAP_MS {
            self.is_tap = false;
        }
        if self.mode == Mode::Draw(tool) {
            self.last_drawn = None;
            out.push(Touch::Draw(*event));
            self.mode = Mode::Spent;
        }
        if self.fingers.is_empty() {
            if let Mode::Hold { moving } = self.mode {
                if moving {
                    out.push(Touch::Settled);
                }
                if self.is_tap && self.most_fingers >= 2 {
                    out.push(Touch::Tap(self.most_fingers));
                }
            }
            self.mode = Mode::Idle;
        }
    }

    fn draw(&mut self, event: PenEvent, out: &mut Vec<Touch>) {
        self.last_drawn = Some(event.sample);
        out.push(Touch::Draw(event));
    }

    fn cancel_drawing(&mut self, time_ms: f64, out: &mut Vec<Touch>) {
        if let Some(last) = self.last_drawn.take() {
            let mut sample = PenSample { time_ms, pressure: 0.0, ..last };
            sample.buttons.primary = false;
            out.push(Touch::Draw(PenEvent { phase: PenPhase::Cancel, sample }));
        }
    }

    /// Where the first two fingers are.
    fn pair(&self) -> Option<[DVec2; 2]> {
        Some([self.fingers.first()?.last, self.fingers.get(1)?.last])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pen::tests::{Hand, random_hand};
    use proptest::prelude::*;

    /// Events as (phase, finger, x, time).
    fn run(gestures: &mut TouchGestures, events: &[(PenPhase, u64, f64, f64)]) -> Vec<Touch> {
        let mut out = Vec::new();
        for (phase, finger, x, time_ms) in events {
            let mut hand = Hand { position: DVec2::new(*x, 10.0), ..Hand::default() };
            gestures.event(&hand.event(*phase, PenTool::Finger(*finger), *time_ms), &mut out);
        }
        out
    }

    use PenPhase::*;

    #[test]
    fn two_fingers_tap_undo_and_three_redo() {
        for count in [2, 3] {
            let lands = (0..count).map(|f| (Down, f, f as f64 * 50.0, f as f64 * 10.0));
            let lifts = (0..count).map(|f| (Up, f, f as f64 * 50.0 + 3.0, 150.0));
            let events: Vec<_> = lands.chain(lifts).collect();
            let said = run(&mut TouchGestures::default(), &events);
            assert_eq!(said.last(), Some(&Touch::Tap(count as usize)));
            let drawn: Vec<_> = said[..said.len() - 1].iter().map(|t| matches!(t, Touch::Draw(_))).collect();
            assert_eq!(drawn, [true, true], "the beginning stroke is drawn and cancelled");
        }
    }

    #[test]
    fn a_long_or_moving_tap_is_none() {
        let long = [(Down, 1, 0.0, 0.0), (Down, 2, 50.0, 10.0), (Up, 1, 0.0, 260.0), (Up, 2, 50.0, 260.0)];
        let far = [(Down, 1, 0.0, 0.0), (Down, 2, 50.0, 10.0), (Up, 1, 0.0, 100.0), (Up, 2, 99.0, 100.0)];
        for events in [long, far] {
            let said = run(&mut TouchGestures::default(), &events);
            assert!(!said.iter().any(|t| matches!(t, Touch::Tap(_))), "{said:?}");
        }
    }

    #[test]
    fn slop_grows_with_the_scale_of_the_screen() {
        let events = [(Down, 1, 0.0, 0.0), (Down, 2, 50.0, 10.0), (Up, 1, 0.0, 100.0), (Up, 2, 70.0, 100.0)];
        let taps = |scale_factor| {
            let said = run(&mut TouchGestures { scale_factor, ..Default::default() }, &events);
            said.contains(&Touch::Tap(2))
        };
        assert!(!taps(1.0) && taps(2.0));
    }

    #[test]
    fn a_second_finger_soon_after_the_first_makes_a_gesture_of_the_stroke() {
        let events = [
            (Down, 1, 0.0, 0.0),
            (Move, 1, 30.0, 50.0),
            (Down, 2, 100.0, 150.0),
            (Move, 2, 120.0, 160.0),
            (Move, 2, 140.0, 170.0),
        ];
        let said = run(&mut TouchGestures::default(), &events);
        let cancelled = matches!(said[2], Touch::Draw(e) if e.phase == Cancel && e.sample.position.x == 30.0);
        assert!(cancelled, "{said:?}");
        let (a, b) = (DVec2::new(30.0, 10.0), DVec2::new(120.0, 10.0));
        assert_eq!(said[3], Touch::Pair { from: [a, b], to: [a, DVec2::new(140.0, 10.0)] });
    }

    #[test]
    fn a_finger_that_lands_late_beside_a_stroke_is_ignored() {
        let events = [
            (Down, 1, 0.0, 0.0),
            (Move, 1, 30.0, 150.0),
            (Down, 2, 100.0, 400.0),
            (Move, 2, 160.0, 410.0),
            (Move, 1, 40.0, 420.0),
            (Up, 1, 40.0, 430.0),
            (Up, 2, 100.0, 440.0),
        ];
        let said = run(&mut TouchGestures::default(), &events);
        let phases: Vec<_> =
            said.iter().map(|t| if let Touch::Draw(e) = t { e.phase } else { Leave }).collect();
        assert_eq!(phases, [Down, Move, Move, Up]);
    }

    #[test]
    fn one_finger_moves_the_canvas_where_fingers_never_draw() {
        let mut gestures = TouchGestures { one_finger_draws: false, ..Default::default() };
        let events = [(Down, 1, 0.0, 0.0), (Move, 1, 20.0, 10.0), (Move, 1, 25.0, 20.0), (Up, 1, 25.0, 30.0)];
        assert_eq!(run(&mut gestures, &events), [Touch::Pan(DVec2::new(5.0, 0.0)), Touch::Settled]);
    }

    #[test]
    fn lifting_one_of_two_fingers_does_not_let_the_canvas_jump() {
        let events = [
            (Down, 1, 0.0, 0.0),
            (Down, 2, 100.0, 10.0),
            (Move, 2, 150.0, 20.0),
            (Move, 2, 151.0, 30.0),
            (Up, 1, 0.0, 500.0),
            (Move, 2, 154.0, 510.0),
            (Up, 2, 154.0, 520.0),
        ];
        let said = run(&mut TouchGestures::default(), &events);
        assert_eq!(said[said.len() - 2..], [Touch::Pan(DVec2::new(3.0, 0.0)), Touch::Settled]);
    }

    proptest! {
        #[test]
        fn what_fingers_draw_begins_once_and_ends_once(
            events in random_hand(300), one_finger_draws in any::<bool>()
        ) {
            let mut gestures = TouchGestures { one_finger_draws, ..Default::default() };
            let (mut out, mut drawing) = (Vec::new(), None);
            for event in events {
                out.clear();
                gestures.event(&event, &mut out);
                for touch in &out {
                    if let Touch::Draw(e) = touch {
                        prop_assert!(one_finger_draws);
                        match e.phase {
                            Down => prop_assert!(drawing.replace(e.sample.tool).is_none()),
                            Move => prop_assert_eq!(drawing, Some(e.sample.tool)),
                            _ => prop_assert_eq!(drawing.take(), Some(e.sample.tool)),
                        }
                    } else {
                        prop_assert!(drawing.is_none());
                    }
                }
            }
        }
    }
}
