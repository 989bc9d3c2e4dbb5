//! The palm gate: while a pen is near, touch does not count.
//!
//! A hand that draws rests on the screen. From the moment a pen comes into range until some time after it left, fingers
//! that land are ignored for as long as they touch; fingers that were down already are cancelled. What passes obeys the
//! grammar of pen events again.

use super::{PenEvent, PenPhase, PenSample, PenTool};

/// Milliseconds after the pen left during which touch stays ignored.
pub const AFTER_PEN_MS: f64 = 300.0;

/// Lets events through, or not.
#[derive(Clone, Debug)]
pub struct PalmGate {
    after_pen_ms: f64,
    pen_is_near: bool,
    pen_left_ms: f64,
    fingers: Vec<Finger>,
}

#[derive(Clone, Debug)]
struct Finger {
    sample: PenSample,
    touches: bool,
    ignored: bool,
}

impl Default for PalmGate {
    fn default() -> Self {
        Self::new(AFTER_PEN_MS)
    }
}

impl PalmGate {
    /// A gate that stays closed for `after_pen_ms` after the pen left.
    pub fn new(after_pen_ms: f64) -> Self {
        Self { after_pen_ms, pen_is_near: false, pen_left_ms: f64::NEG_INFINITY, fingers: Vec::new() }
    }

    /// Takes an event and appends what counts to `out`: nothing for a palm, cancelled fingers before the pen that
    /// cancelled them.
    pub fn pass(&mut self, event: PenEvent, out: &mut Vec<PenEvent>) {
        match event.sample.tool {
            PenTool::Pen | PenTool::Eraser => {
                self.pen(&event, out);
                out.push(event);
            }
            PenTool::Finger(_) => self.finger(event, out),
            PenTool::Mouse => out.push(event),
        }
    }

    fn pen(&mut self, event: &PenEvent, out: &mut Vec<PenEvent>) {
        let time_ms = event.sample.time_ms;
        if matches!(event.phase, PenPhase::Leave | PenPhase::Cancel) {
            self.pen_is_near = false;
            self.pen_left_ms = time_ms;
            return;
        }
        self.pen_is_near = true;
        for finger in self.fingers.iter_mut().filter(|f| !f.ignored) {
            finger.ignored = true;
            let mut sample = PenSample { time_ms, pressure: 0.0, ..finger.sample };
            sample.buttons.primary = false;
            let phase = if finger.touches { PenPhase::Cancel } else { PenPhase::Leave };
            out.push(PenEvent { phase, sample });
        }
    }

    fn finger(&mut self, event: PenEvent, out: &mut Vec<PenEvent>) {
        let sample = event.sample;
        let is_gone = matches!(event.phase, PenPhase::Leave | PenPhase::Cancel);
        let place = self.fingers.iter().position(|f| f.sample.tool == sample.tool);
        let ignored = match place {
            Some(i) => self.fingers[i].ignored,
            None => self.pen_is_near || sample.time_ms - self.pen_left_ms < self.after_pen_ms,
        };
        if !ignored {
            out.push(event);
        }
        let touches = matches!(event.phase, PenPhase::Down | PenPhase::Move);
        match place {
            Some(i) if is_gone => drop(self.fingers.swap_remove(i)),
            Some(i) => self.fingers[i] = Finger { sample, touches, ignored },
            None if is_gone => {}
            None => self.fingers.push(Finger { sample, touches, ignored }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pen::grammar::Grammar;
    use crate::pen::tests::{Hand, random_hand};
    use proptest::prelude::*;

    fn passed(gate: &mut PalmGate, events: &[PenEvent]) -> Vec<(PenPhase, PenTool)> {
        let mut out = Vec::new();
        for event in events {
            gate.pass(*event, &mut out);
        }
        out.iter().map(|e| (e.phase, e.sample.tool)).collect()
    }

    #[test]
    fn a_palm_beside_the_pen_is_ignored_for_as_long_as_it_rests() {
        use PenPhase::*;
        let (pen, palm) = (PenTool::Pen, PenTool::Finger(1));
        let mut hand = Hand::default();
        let mut events = vec![hand.event(Enter, pen, 0.0), hand.event(Enter, palm, 10.0)];
        events.extend([hand.event(Down, palm, 10.0), hand.event(Leave, pen, 20.0)]);
        events.extend([
            hand.event(Move, palm, 900.0),
            hand.event(Up, palm, 910.0),
            hand.event(Leave, palm, 910.0),
        ]);
        assert_eq!(passed(&mut PalmGate::default(), &events), [(Enter, pen), (Leave, pen)]);
    }

    #[test]
    fn touch_counts_again_300_ms_after_the_pen_left() {
        use PenPhase::*;
        let (pen, early, late) = (PenTool::Pen, PenTool::Finger(1), PenTool::Finger(2));
        let mut hand = Hand::default();
        let events = [
            hand.event(Enter, pen, 0.0),
            hand.event(Leave, pen, 100.0),
            hand.event(Enter, early, 399.0),
            hand.event(Enter, late, 400.0),
            hand.event(Down, late, 400.0),
        ];
        let expected = [(Enter, pen), (Leave, pen), (Enter, late), (Down, late)];
        assert_eq!(passed(&mut PalmGate::default(), &events), expected);
    }

    #[test]
    fn a_drawing_finger_is_cancelled_when_the_pen_arrives() {
        use PenPhase::*;
        let (pen, drawing) = (PenTool::Pen, PenTool::Finger(7));
        let mut hand = Hand::default();
        let events = [
            hand.event(Enter, drawing, 0.0),
            hand.event(Down, drawing, 0.0),
            hand.event(Enter, pen, 50.0),
            hand.event(Move, drawing, 60.0),
        ];
        let expected = [(Enter, drawing), (Down, drawing), (Cancel, drawing), (Enter, pen)];
        assert_eq!(passed(&mut PalmGate::default(), &events), expected);
    }

    proptest! {
        #[test]
        fn what_passes_obeys_the_grammar_and_no_finger_touches_beside_a_pen(events in random_hand(200)) {
            let (mut gate, mut grammar, mut out) = (PalmGate::default(), Grammar::default(), Vec::new());
            let mut pen_is_near = false;
            for event in events {
                out.clear();
                gate.pass(event, &mut out);
                for passed in &out {
                    prop_assert_eq!(grammar.accept(passed), Ok(()));
                }
                if matches!(event.sample.tool, PenTool::Pen | PenTool::Eraser) {
                    pen_is_near = !matches!(event.phase, PenPhase::Leave | PenPhase::Cancel);
                }
                let fingers = grammar.touching().filter(|t| matches!(t, PenTool::Finger(_))).count();
                prop_assert!(!pen_is_near || fingers == 0);
            }
        }
    }
}
