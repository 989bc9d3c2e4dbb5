//! What any sequence of pen events must obey, as a checker for tests of every source.
//!
//! Every tool is out of range until it enters. In range it hovers, comes down or leaves; touching it moves, is lifted or
//! is cancelled, and a cancelled tool is out of range. Pen and eraser are two ends of one thing: only one of them is in
//! range. Numbers are finite and in range, and time never goes back.

use super::{MAX_POSITION_PX, PenEvent, PenPhase, PenSample, PenTool};

/// Follows a sequence of events.
#[derive(Clone, Debug, Default)]
pub struct Grammar {
    tools: Vec<(PenTool, bool)>,
    time_ms: f64,
}

impl Grammar {
    /// Takes the next event.
    ///
    /// # Errors
    /// The first rule that the event breaks, in words.
    pub fn accept(&mut self, event: &PenEvent) -> Result<(), String> {
        check_sample(event)?;
        let tool = event.sample.tool;
        if event.sample.time_ms < self.time_ms {
            return Err(format!("time goes back from {} to {}", self.time_ms, event.sample.time_ms));
        }
        self.time_ms = event.sample.time_ms;
        let place = self.tools.iter().position(|(t, _)| *t == tool);
        match (event.phase, place.map(|i| self.tools[i].1)) {
            (PenPhase::Enter, None) => {
                let other = self.tools.iter().find(|(t, _)| are_ends_of_one_pen(*t, tool));
                if let Some((other, _)) = other {
                    return Err(format!("{tool:?} enters while {other:?} is in range"));
                }
                self.tools.push((tool, false));
            }
            (PenPhase::Hover, Some(false)) | (PenPhase::Move, Some(true)) => {}
            (PenPhase::Down, Some(false)) => self.touch(place, true),
            (PenPhase::Up, Some(true)) => self.touch(place, false),
            (PenPhase::Leave, Some(false)) | (PenPhase::Cancel, Some(true)) => {
                self.tools.retain(|(t, _)| *t != tool);
            }
            (phase, stage) => return Err(format!("{tool:?}: {phase:?} while touching is {stage:?}")),
        }
        Ok(())
    }

    /// Tools that touch now.
    pub fn touching(&self) -> impl Iterator<Item = PenTool> + '_ {
        self.tools.iter().filter(|(_, touches)| *touches).map(|(tool, _)| *tool)
    }

    fn touch(&mut self, place: Option<usize>, touches: bool) {
        if let Some(entry) = place.and_then(|i| self.tools.get_mut(i)) {
            entry.1 = touches;
        }
    }
}

fn are_ends_of_one_pen(a: PenTool, b: PenTool) -> bool {
    let is_pen = |tool| matches!(tool, PenTool::Pen | PenTool::Eraser);
    a != b && is_pen(a) && is_pen(b)
}

fn check_sample(event: &PenEvent) -> Result<(), String> {
    let PenSample { position, pressure, tilt_deg, twist_deg, distance, buttons, time_ms, .. } = event.sample;
    let fault = if !position.is_finite() || position.abs().max_element() > MAX_POSITION_PX {
        "position out of range"
    } else if !(0.0..=1.0).contains(&pressure) {
        "pressure out of range"
    } else if !tilt_deg.is_finite() || tilt_deg.abs().max_element() > 90.0 {
        "tilt out of range"
    } else if !(0.0..360.0).contains(&twist_deg) {
        "twist out of range"
    } else if !(0.0..=1.0).contains(&distance) {
        "distance out of range"
    } else if !time_ms.is_finite() {
        "time is no number"
    } else if matches!(event.phase, PenPhase::Down | PenPhase::Move) != buttons.primary {
        "the primary button disagrees with the phase"
    } else if !buttons.primary && pressure != 0.0 {
        "pressure without contact"
    } else {
        return Ok(());
    };
    Err(format!("{fault}: {event:?}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pen::PenButtons;
    use glam::{DVec2, Vec2};

    fn event(phase: PenPhase, tool: PenTool, time_ms: f64) -> PenEvent {
        let primary = matches!(phase, PenPhase::Down | PenPhase::Move);
        let sample = PenSample {
            position: DVec2::ONE,
            pressure: if primary { 0.5 } else { 0.0 },
            tilt_deg: Vec2::ZERO,
            twist_deg: 0.0,
            distance: 0.0,
            tool,
            buttons: PenButtons { primary, ..PenButtons::default() },
            time_ms,
        };
        PenEvent { phase, sample }
    }

    fn run(events: &[(PenPhase, PenTool)]) -> Result<(), String> {
        let mut grammar = Grammar::default();
        events.iter().enumerate().try_for_each(|(i, (p, t))| grammar.accept(&event(*p, *t, i as f64)))
    }

    #[test]
    fn a_stroke_is_accepted() {
        use PenPhase::*;
        let phases = [Enter, Hover, Down, Move, Up, Hover, Leave, Enter, Down, Cancel];
        assert_eq!(run(&phases.map(|p| (p, PenTool::Pen))), Ok(()));
    }

    #[test]
    fn broken_sequences_are_refused() {
        use PenPhase::*;
        for phases in
            [&[Hover][..], &[Enter, Down, Down], &[Enter, Move], &[Enter, Leave, Hover], &[Enter, Up]]
        {
            let events: Vec<_> = phases.iter().map(|p| (*p, PenTool::Mouse)).collect();
            assert!(run(&events).is_err(), "{phases:?}");
        }
        assert!(run(&[(Enter, PenTool::Pen), (Enter, PenTool::Eraser)]).is_err());
        let mut grammar = Grammar::default();
        assert!(grammar.accept(&event(Enter, PenTool::Pen, 5.0)).is_ok());
        assert!(grammar.accept(&event(Hover, PenTool::Pen, 4.0)).is_err());
        let mut odd = event(Hover, PenTool::Pen, 6.0);
        odd.sample.position.x = f64::NAN;
        assert!(grammar.accept(&odd).is_err());
    }
}
