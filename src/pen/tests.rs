//! Sequences of pen events for tests.

use super::{PenButtons, PenEvent, PenPhase, PenSample, PenTool};
use glam::{DVec2, Vec2};
use proptest::prelude::*;

/// Makes events with sound samples.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Hand {
    /// Where the next event happens.
    pub(crate) position: DVec2,
    /// Buttons besides the tip.
    pub(crate) buttons: PenButtons,
}

impl Hand {
    pub(crate) fn event(&mut self, phase: PenPhase, tool: PenTool, time_ms: f64) -> PenEvent {
        let primary = matches!(phase, PenPhase::Down | PenPhase::Move);
        let sample = PenSample {
            position: self.position,
            pressure: if primary { 0.5 } else { 0.0 },
            tilt_deg: Vec2::ZERO,
            twist_deg: 0.0,
            distance: 0.0,
            tool,
            buttons: PenButtons { primary, ..self.buttons },
            time_ms,
        };
        PenEvent { phase, sample }
    }
}

fn tool_of(number: u8) -> PenTool {
    match number % 6 {
        0 => PenTool::Pen,
        1 => PenTool::Eraser,
        2 => PenTool::Mouse,
        n => PenTool::Finger(u64::from(n)),
    }
}

/// Random events of pens, fingers and a mouse that obey the grammar.
pub(crate) fn random_hand(most: usize) -> impl Strategy<Value = Vec<PenEvent>> {
    let step = (any::<u8>(), any::<u8>(), (-50.0..1500.0f64, -50.0..900.0f64), 0.0..120.0f64);
    prop::collection::vec(step, 1..most).prop_map(|steps| {
        let mut stages: Vec<(PenTool, bool)> = Vec::new();
        let (mut hand, mut time_ms) = (Hand::default(), 0.0);
        let mut events = Vec::new();
        for (tool, choice, position, wait_ms) in steps {
            let tool = tool_of(tool);
            let stage = stages.iter().position(|(t, _)| *t == tool);
            let other_end = match tool {
                PenTool::Pen => Some(PenTool::Eraser),
                PenTool::Eraser => Some(PenTool::Pen),
                _ => None,
            };
            if other_end.is_some_and(|other| stages.iter().any(|(t, _)| *t == other)) {
                continue;
            }
            let phase = match (stage.map(|i| stages[i].1), choice % 8) {
                (None, _) => PenPhase::Enter,
                (Some(false), 0..=3) => PenPhase::Down,
                (Some(false), 4..=6) => PenPhase::Hover,
                (Some(false), _) => PenPhase::Leave,
                (Some(true), 0..=5) => PenPhase::Move,
                (Some(true), 6) => PenPhase::Up,
                (Some(true), _) => PenPhase::Cancel,
            };
            match (phase, stage) {
                (PenPhase::Leave | PenPhase::Cancel, Some(i)) => drop(stages.remove(i)),
                (_, Some(i)) => stages[i].1 = matches!(phase, PenPhase::Down | PenPhase::Move),
                (_, None) => stages.push((tool, false)),
            }
            time_ms += wait_ms;
            hand.position = DVec2::from(position);
            hand.buttons.secondary = choice & 0x30 == 0x30;
            hand.buttons.middle = choice & 0xc0 == 0xc0;
            events.push(hand.event(phase, tool, time_ms));
        }
        events
    })
}

proptest! {
    #[test]
    fn random_hands_obey_the_grammar(events in random_hand(200)) {
        let mut grammar = super::grammar::Grammar::default();
        for event in &events {
            prop_assert_eq!(grammar.accept(event), Ok(()));
        }
    }
}
